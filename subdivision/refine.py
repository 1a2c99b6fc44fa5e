"""Refinement in closed form: child indices are arithmetic on parent indices.

No searching, no hashing, no mutation: each rule is the table of its paper, written as
columns.  A negative twin stays negative, so the boundary takes care of itself.
Sharpness wears off by one per level along the children of an edge [DKT98]_.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from subdivision.arrays import Floats, Indices, columns, frozen, taken
from subdivision.topology import INFINITELY_SHARP, Topology


@dataclass(frozen=True)
class Refinement:
    """How schemes of one family split a mesh, whatever their weights.

    Attributes
    ----------
    size : int
        How many corners the faces have that it makes; 0 where they differ.
    faces : (Topology, levels) -> int
        How many there are after ``levels`` steps, 1 or more, told without making them.
    """

    size: int
    faces: Callable[[Topology, int], int]


def quads(t: Topology) -> Topology:
    """Split every n-gon into n quads [DV21]_; vertices are numbered V, then F, then E.

    Half-edge ``h`` becomes the quad ``4h .. 4h + 3`` round the corner it leaves.
    """
    H, V, F, E = t.n_halfedges, t.n_vertices, t.n_faces, t.n_edges
    h, prev, across, behind = np.arange(H), t.prev, t.twin, taken(t.twin, t.prev)
    beyond, k = taken(t.next, across), 4 * h
    return Topology(
        origin=quad_corners(t),
        next=columns(k + 1, k + 2, k + 3, k),
        twin=columns(_child(across, 4 * beyond + 3), 4 * t.next + 2, 4 * prev + 1, _child(behind, 4 * behind)),
        edge=columns(2 * t.edge + (h <= across), 2 * E + h, 2 * E + prev, 2 * taken(t.edge, prev) + (prev > behind)),
        face=np.repeat(h, 4),
        n_vertices=V + F + E,
        edge_sharpness=_halves(t, inner=H),
        vertex_sharpness=np.r_[worn(t.vertex_sharpness), np.zeros(F + E)],
        hidden=t.hidden[t.face],
    )


def triangles(t: Topology) -> Topology:
    """Split every triangle into four [VD22]_; vertices are numbered V, then E.

    Half-edge ``h`` becomes the corner triangle ``3h .. 3h + 2``, and half-edge ``3H + h``
    of the central triangle of its face.
    """
    H, V, E = t.n_halfedges, t.n_vertices, t.n_edges
    h, prev, across, behind = np.arange(H), t.prev, t.twin, taken(t.twin, t.prev)
    beyond, k = taken(t.next, across), 3 * h
    outer_twin = columns(_child(across, 3 * beyond + 2), 3 * H + h, _child(behind, 3 * behind))
    outer_edge = columns(2 * t.edge + (h <= across), 2 * E + h, 2 * taken(t.edge, prev) + (prev > behind))
    return Topology(
        origin=triangle_corners(t),
        next=np.concatenate([columns(k + 1, k + 2, k), 3 * H + t.next]),
        twin=np.concatenate([outer_twin, 3 * h + 1]),
        edge=np.concatenate([outer_edge, 2 * E + h]),
        face=np.concatenate([np.repeat(h, 3), H + t.face]),
        n_vertices=V + E,
        edge_sharpness=_halves(t, inner=H),
        vertex_sharpness=np.r_[worn(t.vertex_sharpness), np.zeros(E)],
        hidden=np.r_[t.hidden[t.face], t.hidden],
    )


def quad_corners(t: Topology) -> Indices:
    """``quads(t).origin``, and nothing else."""
    edge_point = t.n_vertices + t.n_faces + t.edge
    return columns(t.origin, edge_point, t.n_vertices + t.face, taken(edge_point, t.prev))


def triangle_corners(t: Topology) -> Indices:
    """``triangles(t).origin``, and nothing else."""
    middle = t.n_vertices + t.edge
    before = taken(middle, t.prev)
    return np.concatenate([columns(t.origin, middle, before), before])


QUADS = Refinement(size=4, faces=lambda t, levels: t.n_halfedges * 4 ** (levels - 1))
TRIANGLES = Refinement(size=3, faces=lambda t, levels: t.n_faces * 4**levels)


def deferred(coarse: Topology, build: Callable[[], Topology], origin: Indices, size: int, n_vertices: int) -> Topology:
    """A refined mesh with faces of ``size`` of which only the corners are made; ``build`` makes the rest if needed."""
    n_faces = len(origin) // size
    known = {} if coarse.hidden.any() else {"hidden": frozen(np.zeros(n_faces, dtype=bool))}
    sizes = frozen(np.full(n_faces, size))
    return Topology.deferred(build, origin=frozen(origin), n_vertices=n_vertices, face_sizes=sizes, **known)


def worn(sharpness: Floats) -> Floats:
    """Sharpness one level on: one less, never below 0; infinite stays infinite [DKT98]_."""
    return np.where(sharpness >= INFINITELY_SHARP, sharpness, np.maximum(sharpness - 1, 0))


def _halves(t: Topology, inner: int) -> Floats:
    """Edge ``e`` becomes edges ``2e`` and ``2e + 1``; ``inner`` smooth edges follow."""
    return np.concatenate([np.repeat(worn(t.edge_sharpness), 2), np.zeros(inner)])


def _child(parent: Indices, child: Indices) -> Indices:
    """Where there is no parent half-edge (-1) there is no child: arithmetic on -1 must not leak out."""
    return np.where(parent < 0, -1, child)

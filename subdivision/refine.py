"""Refinement in closed form: child indices are arithmetic on parent indices.

No searching, no hashing, no mutation: each rule is the table of its paper, written as
columns, and a column is made when it is asked for.  A negative twin stays negative, so the
boundary takes care of itself.  Sharpness wears off by one per level along the children of an
edge [DKT98]_.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from subdivision.arrays import Floats, Indices, columns, constant, next_corners, short, taken, turned
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
    make = {
        "twin": lambda: _quad_twins(t),
        "edge": lambda: _quad_edges(t),
        "edge_sharpness": lambda: _halves(t),
        "vertex_sharpness": lambda: _faded(t, t.n_faces + t.n_edges),
        "hidden": lambda: t.hidden[t.face],
    }
    return deferred(t, make, quad_corners(t), 4, t.n_vertices + t.n_faces + t.n_edges)


def triangles(t: Topology) -> Topology:
    """Split every triangle into four [VD22]_; vertices are numbered V, then E.

    Half-edge ``h`` becomes the corner triangle ``3h .. 3h + 2``, and half-edge ``3H + h``
    of the central triangle of its face.
    """
    make = {
        "twin": lambda: _triangle_twins(t),
        "edge": lambda: _triangle_edges(t),
        "edge_sharpness": lambda: _halves(t),
        "vertex_sharpness": lambda: _faded(t, t.n_edges),
        "hidden": lambda: np.r_[t.hidden[t.face], t.hidden],
    }
    return deferred(t, make, triangle_corners(t), 3, t.n_vertices + t.n_edges)


def quad_corners(t: Topology) -> Indices:
    """``quads(t).origin``, and nothing else."""
    V, F, E = t.n_vertices, t.n_faces, t.n_edges
    corners = np.empty((t.n_halfedges, 4), dtype=short(V + F + E))
    corners[:, 0] = t.origin
    np.add(t.edge, V + F, out=corners[:, 1], casting="same_kind")
    np.add(t.face, V, out=corners[:, 2], casting="same_kind")
    corners[:, 3] = before(t, corners[:, 1])
    return corners.ravel()


def triangle_corners(t: Topology) -> Indices:
    """``triangles(t).origin``, and nothing else."""
    V, H = t.n_vertices, t.n_halfedges
    corners = np.empty(4 * H, dtype=short(V + t.n_edges))
    outer, inner = corners[: 3 * H].reshape(H, 3), corners[3 * H :]
    outer[:, 0] = t.origin
    np.add(t.edge, V, out=outer[:, 1], casting="same_kind")
    inner[:] = before(t, outer[:, 1])
    outer[:, 2] = inner
    return corners


def before(t: Topology, of_halfedges: Indices) -> Indices:
    """``of_halfedges[t.prev]``, without gathering where all faces are alike."""
    k, odd = divmod(t.n_halfedges, t.n_faces)
    if not odd and (t.face_sizes == k).all():
        return turned(of_halfedges.reshape(-1, k), -1).ravel()
    return taken(of_halfedges, t.prev)


QUADS = Refinement(size=4, faces=lambda t, levels: t.n_halfedges * 4 ** (levels - 1))
TRIANGLES = Refinement(size=3, faces=lambda t, levels: t.n_faces * 4**levels)


def deferred(
    coarse: Topology, make: Mapping[str, Callable[[], Any]], origin: Indices, size: int, n_vertices: int
) -> Topology:
    """A refined mesh with faces of ``size`` of which only the corners are made; ``make`` the rest when it is needed."""
    n_faces = len(origin) // size
    known: dict[str, Any] = {"origin": origin, "n_vertices": n_vertices, "face_sizes": constant(size, n_faces)}
    if coarse.is_smooth:
        known["is_smooth"] = True
    if not coarse.hidden.any():
        known["hidden"] = constant(False, n_faces)
    alike = {"next": lambda: next_corners(known["face_sizes"]), "face": lambda: np.repeat(np.arange(n_faces), size)}
    return Topology.deferred({**alike, **make}, **known)


def worn(sharpness: Floats) -> Floats:
    """Sharpness one level on: one less, never below 0; infinite stays infinite [DKT98]_."""
    return np.where(sharpness >= INFINITELY_SHARP, sharpness, np.maximum(sharpness - 1, 0))


def _quad_twins(t: Topology) -> Indices:
    across, behind = t.twin, before(t, t.twin)
    beyond = taken(t.next, across)
    return columns(_child(across, 4 * beyond + 3), 4 * t.next + 2, 4 * t.prev + 1, _child(behind, 4 * behind))


def _quad_edges(t: Topology) -> Indices:
    halves, inner = half_edges(t), 2 * t.n_edges + np.arange(t.n_halfedges)
    edges = np.empty((t.n_halfedges, 4), dtype=short(2 * t.n_edges + t.n_halfedges))
    edges[:, 0], edges[:, 1], edges[:, 2] = halves, inner, before(t, inner)
    edges[:, 3] = before(t, halves ^ 1)
    return edges.ravel()


def _triangle_twins(t: Topology) -> Indices:
    H, h, across, behind = t.n_halfedges, np.arange(t.n_halfedges), t.twin, before(t, t.twin)
    beyond = taken(t.next, across)
    outer = columns(_child(across, 3 * beyond + 2), 3 * H + h, _child(behind, 3 * behind))
    return np.concatenate([outer, 3 * h + 1])


def _triangle_edges(t: Topology) -> Indices:
    H, E = t.n_halfedges, t.n_edges
    edges, halves = np.empty(4 * H, dtype=short(2 * E + H)), half_edges(t)
    outer, inner = edges[: 3 * H].reshape(H, 3), edges[3 * H :]
    inner[:] = np.arange(2 * E, 2 * E + H)
    outer[:, 0], outer[:, 1], outer[:, 2] = halves, inner, before(t, halves ^ 1)
    return edges


def half_edges(t: Topology) -> Indices:
    """(n_halfedges,) int: the half, at its origin, of the edge of each half-edge: edge ``e`` becomes 2e and 2e + 1."""
    return 2 * t.edge + (np.arange(t.n_halfedges) <= t.twin)


def _halves(t: Topology) -> Floats:
    """Edge ``e`` becomes edges ``2e`` and ``2e + 1``; one smooth edge for each half-edge follows."""
    if t.is_smooth:
        return constant(0.0, 2 * t.n_edges + t.n_halfedges)
    return np.concatenate([np.repeat(worn(t.edge_sharpness), 2), np.zeros(t.n_halfedges)])


def _faded(t: Topology, new: int) -> Floats:
    if t.is_smooth:
        return constant(0.0, t.n_vertices + new)
    return np.concatenate([worn(t.vertex_sharpness), np.zeros(new)])


def _child(parent: Indices, child: Indices) -> Indices:
    """Where there is no parent half-edge (-1) there is no child: arithmetic on -1 must not leak out."""
    return np.where(parent < 0, -1, child)

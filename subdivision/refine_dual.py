"""Dual refinement in closed form: vertices become faces.  Nothing is searched, as in ``refine``.

A dual scheme has no face where a vertex or an edge is not surrounded: an open mesh shrinks from
its boundary as an open net does, and its outline has no sharpness left.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from subdivision.arrays import Indices, constant, next_corners, taken
from subdivision.cycles import vertex_slots
from subdivision.refine import Refinement, before
from subdivision.topology import Topology

Links: TypeAlias = tuple[Indices, Indices]
"""Twin and edge of every half-edge."""


def corners(t: Topology) -> Topology:
    """A vertex for every corner [DS78]_; a face for every face, then every inner edge, then every inner vertex.

    Half-edge ``h`` stays in its face, and vertex ``h`` is the corner it leaves.  The quad of an
    edge holds two half-edges for each of its halves; the face of a vertex one for each corner.
    """
    H = t.n_halfedges
    slots, sizes = vertex_slots(t, ~t.on_boundary)
    lower = np.flatnonzero(np.arange(H) < t.twin)
    upper = t.twin[lower]
    quads = np.empty((len(lower), 4), dtype=np.intp)
    quads[_quad_of(t)[lower]] = np.stack([t.next[lower], lower, t.next[upper], upper], axis=1)
    return _dual(
        origin=np.concatenate([np.arange(H), quads.ravel(), _listed(slots)]),
        face_sizes=np.concatenate([t.face_sizes, np.full(len(quads), 4), sizes[sizes > 0]]),
        n_vertices=H,
        n_edges=H + 2 * len(quads),
        links=lambda: _corner_links(t, slots),
    )


def _corner_links(t: Topology, slots: Indices) -> Links:
    """Twin and edge of ``corners(t)``."""
    H, h, inner = t.n_halfedges, np.arange(t.n_halfedges), t.twin >= 0
    quad = _quad_of(t)
    along = np.where(inner, H + 4 * quad + 2 * (h > t.twin), -1)
    half, corner = np.flatnonzero(inner), np.flatnonzero(slots >= 0)
    base = H + 2 * len(half)
    about = np.where(slots >= 0, base + slots, -1)
    ahead = t.twin[t.prev[corner]]
    twin, edge = (np.full(base + len(corner), -1) for _ in range(2))
    twin[:H], edge[:H] = along, h
    k = along[half]
    twin[k], edge[k] = half, half
    twin[k + 1], edge[k + 1] = about[t.next[t.twin[half]]], H + np.arange(len(half))
    k = about[corner]
    twin[k], edge[k] = along[ahead] + 1, edge[along[ahead] + 1]
    return twin, edge


def midpoints(t: Topology) -> Topology:
    """A vertex for every edge of a closed mesh [PR97]_; a face for every face, then every vertex.

    Half-edge ``h`` cuts off the corner it leaves: it runs inside the face, and its twin, along the
    same edge ``h``, round the vertex.
    """
    H, h = t.n_halfedges, np.arange(t.n_halfedges)
    slots, sizes = vertex_slots(t, t.valence > 0)
    return _dual(
        origin=np.concatenate([before(t, t.edge), t.edge[_listed(slots)]]),
        face_sizes=np.concatenate([t.face_sizes, sizes[sizes > 0]]),
        n_vertices=t.n_edges,
        n_edges=H,
        links=lambda: (np.concatenate([H + slots, _listed(slots)]), np.concatenate([h, _listed(slots)])),
    )


def _quad_of(t: Topology) -> Indices:
    """(n_halfedges,) int: which of the quads between faces lies on each half-edge."""
    return taken(np.cumsum(~t.boundary) - 1, t.edge)


def _listed(slots: Indices) -> Indices:
    """What has the slots 0, 1, 2, ..."""
    listed = np.empty(int(slots.max(initial=-1)) + 1, dtype=np.intp)
    some = np.flatnonzero(slots >= 0)
    listed[slots[some]] = some
    return listed


def _corner_faces(t: Topology, levels: int) -> int:
    """V, E and the boundary by their laws; what remains is the Euler characteristic, which stays."""
    V, E, B = int((t.valence > 0).sum()), t.n_edges, int(t.boundary.sum())
    outer, euler = int(t.on_boundary[t.origin].sum()), V - E + t.n_faces
    for _ in range(levels):
        V, E, B, outer = 2 * E - B, 4 * E - 3 * B, outer, 3 * outer - 2 * B
    return euler + E - V


def _midpoint_faces(t: Topology, levels: int) -> int:
    V, E = int((t.valence > 0).sum()), t.n_edges
    euler = V - E + t.n_faces
    for _ in range(levels):
        V, E = E, 2 * E
    return euler + E - V


def _dual(origin: Indices, face_sizes: Indices, n_vertices: int, n_edges: int, links: Callable[[], Links]) -> Topology:
    """The mesh, without any sharpness; ``links`` are made when they are needed."""
    once, n = lru_cache(links), len(face_sizes)
    make = {
        "next": lambda: next_corners(face_sizes),
        "twin": lambda: once()[0],
        "edge": lambda: once()[1],
        "face": lambda: np.repeat(np.arange(n), face_sizes),
    }
    return Topology.deferred(
        make, origin=origin, face_sizes=face_sizes, n_vertices=n_vertices, is_smooth=True,
        edge_sharpness=constant(0.0, n_edges), vertex_sharpness=constant(0.0, n_vertices), hidden=constant(False, n),
    )  # fmt: skip


CORNERS = Refinement(size=0, faces=_corner_faces)
MIDPOINTS = Refinement(size=0, faces=_midpoint_faces)

"""Dual refinement in closed form: vertices become faces.  Nothing is searched, as in ``refine``.

A dual scheme has no face where a vertex or an edge is not surrounded: an open mesh shrinks from
its boundary as an open net does, and its outline has no sharpness left.
"""

import numpy as np

from subdivision.arrays import Indices
from subdivision.cycles import vertex_slots
from subdivision.refine import Refinement
from subdivision.topology import Topology


def corners(t: Topology) -> Topology:
    """A vertex for every corner [DS78]_; a face for every face, then every inner edge, then every inner vertex.

    Half-edge ``h`` stays in its face, and vertex ``h`` is the corner it leaves.  The quad of an
    edge holds two half-edges for each of its halves; the face of a vertex one for each corner.
    """
    H, F, h = t.n_halfedges, t.n_faces, np.arange(t.n_halfedges)
    inner = t.twin >= 0
    quad = np.cumsum(~t.boundary) - 1
    along = np.where(inner, H + 4 * quad[t.edge] + 2 * (h > t.twin), -1)
    slots, sizes = vertex_slots(t, ~t.on_boundary)
    base = H + 2 * int(inner.sum())
    about = np.where(slots >= 0, base + slots, -1)
    half, corner = np.flatnonzero(inner), np.flatnonzero(slots >= 0)
    ahead = t.twin[t.prev[corner]]
    n = base + len(corner)
    origin, next_, twin, edge = (np.full(n, -1) for _ in range(4))
    origin[:H], next_[:H], twin[:H], edge[:H] = h, t.next, along, h
    k = along[half]
    origin[k], next_[k], twin[k], edge[k] = t.next[half], k + 1, half, half
    k, pair = k + 1, H + 4 * quad[t.edge[half]]
    origin[k], next_[k], twin[k] = half, pair + (k + 1 - pair) % 4, about[t.next[t.twin[half]]]
    edge[k] = H + np.arange(len(half))
    k = about[corner]
    origin[k], next_[k], twin[k], edge[k] = corner, about[ahead], along[ahead] + 1, edge[along[ahead] + 1]
    quads, vertices = np.repeat(np.arange(len(half) // 2), 4), np.repeat(np.arange((sizes > 0).sum()), sizes[sizes > 0])
    face = np.concatenate([t.face, F + quads, F + len(half) // 2 + vertices])
    return _smooth(origin, next_, twin, edge, face, n_vertices=H)


def midpoints(t: Topology) -> Topology:
    """A vertex for every edge of a closed mesh [PR97]_; a face for every face, then every vertex.

    Half-edge ``h`` cuts off the corner it leaves: it runs inside the face, and its twin, along the
    same edge ``h``, round the vertex.
    """
    H, h = t.n_halfedges, np.arange(t.n_halfedges)
    slots, sizes = vertex_slots(t, t.valence > 0)
    ahead = t.twin[t.prev]
    origin, next_, twin, edge = (np.empty(2 * H, dtype=np.intp) for _ in range(4))
    origin[:H], next_[:H], twin[:H], edge[:H] = t.edge[t.prev], t.next, H + slots, h
    k = H + slots
    origin[k], next_[k], twin[k], edge[k] = t.edge, k[ahead], h, h
    vertices = np.repeat(np.arange((sizes > 0).sum()), sizes[sizes > 0])
    face = np.concatenate([t.face, t.n_faces + vertices])
    return _smooth(origin, next_, twin, edge, face, n_vertices=t.n_edges)


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


def _smooth(origin: Indices, next_: Indices, twin: Indices, edge: Indices, face: Indices, n_vertices: int) -> Topology:
    """The mesh without any sharpness."""
    return Topology(
        origin, next_, twin, edge, face, n_vertices,
        edge_sharpness=np.zeros(int(edge.max()) + 1), vertex_sharpness=np.zeros(n_vertices),
        hidden=np.zeros(int(face.max()) + 1, dtype=bool),
    )  # fmt: skip


CORNERS = Refinement(size=0, faces=_corner_faces)
MIDPOINTS = Refinement(size=0, faces=_midpoint_faces)

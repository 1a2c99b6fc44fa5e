"""Refinement by face centroids and edge flips in closed form [Kob00]_: three triangles of each, on closed meshes.

Vertices are numbered V, then F.  Two steps cut every edge in three.
"""

import numpy as np

from subdivision.arrays import Indices, columns
from subdivision.refine import Refinement
from subdivision.topology import Topology


def inserted(t: Topology) -> Topology:
    """Every triangle split at its middle: half-edge ``h`` becomes the triangle ``3h .. 3h + 2`` on its own edge."""
    H, h = t.n_halfedges, np.arange(t.n_halfedges)
    return Topology(
        origin=columns(t.origin, t.origin[t.next], t.n_vertices + t.face),
        next=_round(H),
        twin=columns(3 * t.twin, 3 * t.next + 2, 3 * t.prev + 1),
        edge=columns(t.edge, t.n_edges + t.next, t.n_edges + h),
        face=np.arange(3 * H) // 3,
        n_vertices=t.n_vertices + t.n_faces,
        edge_sharpness=np.zeros(t.n_edges + t.n_halfedges),
        vertex_sharpness=np.zeros(t.n_vertices + t.n_faces),
        hidden=np.zeros(t.n_halfedges, dtype=bool),
    )


def flipped(t: Topology) -> Topology:
    """... and every old edge flipped: the triangle of half-edge ``h`` runs from its origin to the middles on its sides.

    Flipped, edge ``e`` keeps its number; the edge from corner ``h`` to its middle is ``E + h``.
    """
    H, E, h = t.n_halfedges, t.n_edges, np.arange(t.n_halfedges)
    middle = t.n_vertices + t.face
    return Topology(
        origin=columns(t.origin, middle[t.twin], middle),
        next=_round(H),
        twin=columns(3 * t.next[t.twin] + 2, 3 * t.twin + 1, 3 * t.twin[t.prev]),
        edge=columns(E + t.next[t.twin], t.edge, E + h),
        face=np.arange(3 * H) // 3,
        n_vertices=t.n_vertices + t.n_faces,
        edge_sharpness=np.zeros(t.n_edges + t.n_halfedges),
        vertex_sharpness=np.zeros(t.n_vertices + t.n_faces),
        hidden=np.zeros(t.n_halfedges, dtype=bool),
    )


def _round(n: int) -> Indices:
    """(3 n,) int: each half-edge of ``n`` triangles to the next."""
    k = np.arange(3 * n)
    return k - k % 3 + (k + 1) % 3


THIRDS = Refinement(size=3, faces=lambda t, levels: t.n_faces * 3**levels)

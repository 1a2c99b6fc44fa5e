"""Refinement by face centroids and edge flips in closed form [Kob00]_: three triangles of each, on closed meshes.

Vertices are numbered V, then F.  Two steps cut every edge in three.
"""

from collections.abc import Callable, Mapping

import numpy as np

from subdivision.arrays import Indices, columns, constant, taken
from subdivision.refine import Refinement, before, following
from subdivision.topology import Topology


def inserted(t: Topology) -> Topology:
    """Every triangle split at its middle: half-edge ``h`` becomes the triangle ``3h .. 3h + 2`` on its own edge."""
    H, h, E = t.n_halfedges, np.arange(t.n_halfedges), t.n_edges
    make = {
        "origin": lambda: columns(t.origin, taken(t.origin, t.next), t.n_vertices + t.face),
        "twin": lambda: columns(3 * t.twin, 3 * t.next + 2, 3 * t.prev + 1),
        "edge": lambda: columns(t.edge, E + t.next, E + h),
    }
    return _smooth(make, H, E + H, t.n_vertices + t.n_faces)


def flipped(t: Topology) -> Topology:
    """... and every old edge flipped: the triangle of half-edge ``h`` runs from its origin to the middles on its sides.

    Flipped, edge ``e`` keeps its number; the edge from corner ``h`` to its middle is ``E + h``.
    """
    H, h, E, middle = t.n_halfedges, np.arange(t.n_halfedges), t.n_edges, t.n_vertices + t.face
    make = {
        "origin": lambda: columns(t.origin, taken(middle, t.twin), middle),
        "twin": lambda: columns(3 * taken(t.next, t.twin) + 2, 3 * t.twin + 1, 3 * before(t, t.twin)),
        "edge": lambda: columns(E + taken(t.next, t.twin), t.edge, E + h),
    }
    return _smooth(make, H, E + H, t.n_vertices + t.n_faces)


def _smooth(make: Mapping[str, Callable[[], Indices]], n_faces: int, n_edges: int, n_vertices: int) -> Topology:
    """Triangles without any sharpness."""
    sizes = constant(3, n_faces)
    alike = {"next": lambda: following(sizes), "face": lambda: np.repeat(np.arange(n_faces), 3)}
    return Topology.deferred(
        {**alike, **make}, n_vertices=n_vertices, is_smooth=True, face_sizes=sizes,
        edge_sharpness=constant(0.0, n_edges), vertex_sharpness=constant(0.0, n_vertices),
        hidden=constant(False, n_faces),
    )  # fmt: skip


THIRDS = Refinement(size=3, faces=lambda t, levels: t.n_faces * 3**levels)

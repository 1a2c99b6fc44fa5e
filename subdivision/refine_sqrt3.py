"""Refinement by face centroids and edge flips in closed form [Kob00]_: three triangles of each, on closed meshes.

Vertices are numbered V, then F.  Two steps cut every edge in three.
"""

from collections.abc import Callable, Mapping

import numpy as np

from subdivision.arrays import Indices, columns, constant, next_corners, short, taken, turned
from subdivision.refine import Refinement
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
    H, h, E = t.n_halfedges, np.arange(t.n_halfedges), t.n_edges
    make = {
        "origin": lambda: _flipped_corners(t),
        "twin": lambda: _flipped_twins(t),
        "edge": lambda: columns(E + taken(t.next, t.twin), t.edge, E + h),
    }
    return _smooth(make, H, E + H, t.n_vertices + t.n_faces)


def _flipped_corners(t: Topology) -> Indices:
    V, F = t.n_vertices, t.n_faces
    corners = np.empty((F, 3, 3), dtype=short(V + F))
    corners[:, :, 0] = t.origin.reshape(F, 3)
    np.add(t.twin.reshape(F, 3) // 3, V, out=corners[:, :, 1], casting="same_kind")
    corners[:, :, 2] = np.arange(V, V + F)[:, None]
    return corners.ravel()


def _flipped_twins(t: Topology) -> Indices:
    F, H = t.n_faces, t.n_halfedges
    twins = np.empty((F, 3, 3), dtype=short(3 * H))
    across = t.twin.reshape(F, 3).astype(twins.dtype, copy=False)
    last = across // 3 * 3 + 2
    twins[:, :, 0] = 3 * np.where(across == last, last - 2, across + 1) + 2
    twins[:, :, 1] = 3 * across + 1
    twins[:, :, 2] = 3 * turned(across, -1)
    return twins.ravel()


def _smooth(make: Mapping[str, Callable[[], Indices]], n_faces: int, n_edges: int, n_vertices: int) -> Topology:
    """Triangles without any sharpness."""
    sizes = constant(3, n_faces)
    alike = {"next": lambda: next_corners(sizes), "face": lambda: np.repeat(np.arange(n_faces), 3)}
    return Topology.deferred(
        {**alike, **make}, n_vertices=n_vertices, is_smooth=True, face_sizes=sizes,
        edge_sharpness=constant(0.0, n_edges), vertex_sharpness=constant(0.0, n_vertices),
        hidden=constant(False, n_faces),
    )  # fmt: skip


THIRDS = Refinement(size=3, faces=lambda t, levels: t.n_faces * 3**levels)

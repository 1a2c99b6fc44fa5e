"""Triangles of a mesh, for formats that know no polygons."""

import numpy as np

from subdivision.arrays import Floats, Indices
from subdivision.rows import shown_faces
from subdivision.trace import Mesh


def triangles(mesh: Mesh) -> tuple[Floats, Indices]:
    """Points (n, 3) and triangles (m, 3), turned as the faces were.

    A quad is cut along its shorter diagonal; a larger polygon round its middle, which is one point more.
    """
    sizes, corners = shown_faces(mesh.topology)
    start = np.cumsum(sizes) - sizes
    whole = corners[start[sizes == 3][:, None] + np.arange(3)]
    quads = corners[start[sizes == 4][:, None] + np.arange(4)]
    middles, fans = _round_middles(mesh, sizes, corners, start)
    return np.concatenate([mesh.points, middles]), np.concatenate([whole, _halves(mesh.points, quads), fans])


def _halves(points: Floats, quads: Indices) -> Indices:
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    is_first = np.linalg.norm(c - a, axis=1) <= np.linalg.norm(d - b, axis=1)
    quads = np.where(is_first[:, None], quads, np.roll(quads, -1, axis=1))
    return quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def _round_middles(mesh: Mesh, sizes: Indices, corners: Indices, start: Indices) -> tuple[Floats, Indices]:
    large = np.flatnonzero(sizes > 4)
    count = sizes[large]
    owner = np.repeat(np.arange(len(large)), count)
    k = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    here = corners[start[large][owner] + k]
    following = corners[start[large][owner] + (k + 1) % count[owner]]
    middles = np.zeros((len(large), 3))
    np.add.at(middles, owner, mesh.points[here])
    middles /= count[:, None]
    return middles, np.stack([here, following, len(mesh.points) + owner], axis=1)


def normals(points: Floats, cut: Indices) -> Floats:
    """(m, 3): unit vectors across the triangles; zero where one has no area."""
    a, b, c = (points[cut[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    length = np.linalg.norm(across, axis=1, keepdims=True)
    return np.asarray(np.divide(across, length, out=np.zeros_like(across), where=length > 0))

"""What painters share: polygons as shaded triangles, strokes as dashes."""

from dataclasses import dataclass

import numpy as np

from app.draw.picture import Faces, Lines
from subdivision.arrays import Floats, Indices

SMOOTH, CREASED = np.cos(np.radians([9.0, 17.0]))
"""Cosines: a polygon that leans less from the mean round its corner is shaded smoothly there, one that leans more
flatly; between the two the one passes into the other, so that nothing flickers while points move."""


@dataclass(frozen=True, eq=False)
class Facets:
    """Triangles of polygons: a bent quad does not look creased, and where neighbours nearly agree they look smooth.

    ``points`` and ``normals`` (n, 3); ``triangles`` (m, 3).
    """

    points: Floats
    normals: Floats
    triangles: Indices


def normals(faces: Faces) -> Floats:
    """(n_faces, 3): the unit normal of every polygon, also a bent one.

    Source: Newell's formula, half the sum of the cross products of consecutive corners; it needs no plane.
    """
    corners, start, follower, owner = _walk(faces)
    centred = corners - _means(faces)[owner]
    area = np.add.reduceat(np.cross(centred, centred[follower]), start) if len(start) else np.zeros((0, 3))
    length = np.linalg.norm(area, axis=1, keepdims=True)
    return np.asarray(np.where(length > 0, area / np.maximum(length, 1e-300), [0.0, 0.0, 1.0]), dtype=float)


def shading(faces: Faces) -> Floats:
    """(n_corners, 3): the normal each polygon wears at each of its corners."""
    own = normals(faces)[np.repeat(np.arange(len(faces.sizes)), faces.sizes)]
    n = len(faces.points)
    mean = _unit(np.stack([np.bincount(faces.corners, own[:, k], n) for k in range(3)], axis=1))[faces.corners]
    agree = np.clip(((own * mean).sum(axis=1, keepdims=True) - CREASED) / (SMOOTH - CREASED), 0.0, 1.0)
    return _unit(own + agree * agree * (3 - 2 * agree) * (mean - own))


def facets(faces: Faces) -> Facets:
    """Triangles round the middle of every polygon: symmetric, and the same at every instant of a stage.

    A triangle stays one; a polygon too concave for its middle is cut by its ears.
    """
    corners, start, follower, owner = _walk(faces)
    middle, normal = _means(faces), normals(faces)
    n = len(corners)
    fan = np.stack([np.arange(n), follower, n + owner], axis=1)
    triangle = faces.sizes == 3
    turned = np.cross(corners[follower] - corners, middle[owner] - corners)
    bad = np.zeros(len(faces.sizes), dtype=bool)
    bad[owner[(turned * normal[owner]).sum(axis=1) < -1e-12 * np.abs(turned).max(initial=0.0)]] = True
    whole = start[triangle][:, None] + np.arange(3)
    ears = [_ears(corners, start[f], faces.sizes[f]) for f in np.flatnonzero(bad & ~triangle)]
    parts = [fan[~(triangle | bad)[owner]], whole, *ears]
    return Facets(np.vstack([corners, middle]), np.vstack([shading(faces), normal]), np.vstack(parts))


def dashes(lines: Lines, length: float) -> Lines:
    """The same strokes cut into dashes of about ``length``, each stroke with a dash at both its ends."""
    a, b = lines.points[lines.pairs[:, 0]], lines.points[lines.pairs[:, 1]]
    span = np.linalg.norm(b - a, axis=1)
    count = np.clip(np.round((span / max(length, 1e-300) + 1) / 2), 1, 500).astype(np.intp)
    owner = np.repeat(np.arange(len(span)), count)
    k = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    unit = 1 / (2 * count[owner] - 1)
    at = np.stack([2 * k * unit, (2 * k + 1) * unit], axis=1).reshape(-1, 1)
    both = np.repeat(owner, 2)
    points = (1 - at) * a[both] + at * b[both]
    return Lines(points, np.arange(len(points)).reshape(-1, 2), lines.colour, lines.width, lines.opacity)


def _walk(faces: Faces) -> tuple[Floats, Indices, Indices, Indices]:
    """The corners' places; where each face starts; the next corner round the face; the face of each corner."""
    sizes = np.asarray(faces.sizes, dtype=np.intp)
    start = np.cumsum(sizes) - sizes
    owner = np.repeat(np.arange(len(sizes)), sizes)
    follower = np.arange(len(faces.corners)) + 1
    ends = start + sizes
    follower[ends - 1] = start
    return np.asarray(faces.points, dtype=float)[faces.corners], start, follower, owner


def _unit(vectors: Floats) -> Floats:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.maximum(length, 1e-300), dtype=float)


def _means(faces: Faces) -> Floats:
    corners = np.asarray(faces.points, dtype=float)[faces.corners]
    if not len(faces.sizes):
        return np.zeros((0, 3))
    start = np.cumsum(faces.sizes) - faces.sizes
    return np.asarray(np.add.reduceat(corners, start) / np.asarray(faces.sizes)[:, None], dtype=float)


def _ears(corners: Floats, start: int, size: int) -> Indices:
    from vtkmodules.vtkCommonCore import vtkIdList
    from vtkmodules.vtkCommonDataModel import vtkPolygon

    polygon, found = vtkPolygon(), vtkIdList()
    for k in range(size):
        polygon.GetPointIds().InsertNextId(k)
        polygon.GetPoints().InsertNextPoint(corners[start + k])
    polygon.EarCutTriangulation(found, 0)
    ids = np.array([found.GetId(k) for k in range(found.GetNumberOfIds())], dtype=np.intp)
    return np.asarray(start + ids.reshape(-1, 3))

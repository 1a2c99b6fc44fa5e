"""What painters share: polygons as shaded triangles, strokes as dashes."""

import numpy as np

from app.draw import regular
from app.draw.picture import Faces, Lines
from app.draw.regular import CREASED, SMOOTH, Facets
from subdivision.arrays import Floats, Indices, next_corners, stretches

MANY = 256
"""From so many polygons on it is worth to know connectivity again."""


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
    return _shading(faces, normals(faces))


def facets(faces: Faces, *, is_hasty: bool = False) -> Facets:
    """Triangles round the middle of every polygon: symmetric, and the same at every instant of a stage.

    A triangle stays one; a polygon too concave for its middle is cut by its ears.  In haste many quads are cut in two.
    """
    quick = regular.facets(faces, is_hasty=is_hasty) if len(faces.sizes) >= MANY else None
    return quick if quick is not None else any_facets(faces)


def any_facets(faces: Faces) -> Facets:
    """The same for polygons of all kinds, corner by corner."""
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
    triangles = np.vstack([fan[~(triangle | bad)[owner]], whole, *ears])
    shades = np.vstack([_shading(faces, normal), normal])
    return Facets(np.vstack([corners, middle]), shades, triangles, faces.corners, owner[triangles[:, 0]])


def shells(faces: Faces) -> Indices | None:
    """(n,): the connected part that each point is of; None where the surface has a rim or two sides.

    It has neither where every edge is walked as often one way as the other.
    """
    walk, n = np.asarray(faces.corners, dtype=np.int64), len(faces.points)
    ahead = walk[next_corners(faces.sizes)]
    if not np.array_equal(np.sort(n * walk + ahead), np.sort(n * ahead + walk)):
        return None
    return _parts(n, walk, ahead)


def _parts(n: int, ends: Indices, others: Indices) -> Indices:
    """(n,): the least of the points that each point is connected with, by links between ``ends`` and ``others``.

    Written out: scipy's graphs take as long to load as some pictures take to draw.
    """
    part = np.arange(n)
    while True:
        least, found = np.minimum(part[ends], part[others]), part.copy()
        np.minimum.at(found, part[ends], least)
        np.minimum.at(found, part[others], least)
        found = found[found]
        if np.array_equal(found, part):
            return part
        part = found


def is_outward(cut: Facets, shell: Indices) -> bool:
    """Whether every one of the ``shells`` has its front outside: all of them have a positive volume.

    Source: the divergence theorem, for the field that grows along the last axis.
    """
    x, y, z = (column[cut.triangles] for column in cut.points.T)
    area = (x[:, 1] - x[:, 0]) * (y[:, 2] - y[:, 0]) - (x[:, 2] - x[:, 0]) * (y[:, 1] - y[:, 0])
    part = shell[cut.vertices[cut.triangles[:, 0]]]
    volume = np.bincount(part, area * z.sum(axis=1))
    return bool((volume[np.unique(part)] > 0).all())


def worn(faces: Faces, cut: Facets) -> Floats | None:
    """(n, 3): the colour of every point of the facets; None where all have one."""
    if faces.colours is None:
        return None
    at_points = faces.colours[cut.vertices]
    has_middles = len(cut.points) > len(cut.vertices)
    return np.concatenate([at_points, face_colours(faces, faces.colours)]) if has_middles else at_points


def face_colours(faces: Faces, colours: Floats) -> Floats:
    """(n_faces, 3): the mean of the colours at the corners."""
    start = np.cumsum(faces.sizes) - faces.sizes
    return np.asarray(np.add.reduceat(colours[faces.corners], start) / np.asarray(faces.sizes)[:, None])


def dashes(lines: Lines, length: float) -> Lines:
    """The same strokes cut into dashes of about ``length``, each stroke with a dash at both its ends."""
    a, b = lines.points[lines.pairs[:, 0]], lines.points[lines.pairs[:, 1]]
    span = np.linalg.norm(b - a, axis=1)
    count = np.clip(np.round((span / max(length, 1e-300) + 1) / 2), 1, 500).astype(np.intp)
    owner = np.repeat(np.arange(len(span)), count)
    k = stretches(np.zeros_like(count), count)
    unit = 1 / (2 * count[owner] - 1)
    at = np.stack([2 * k * unit, (2 * k + 1) * unit], axis=1).reshape(-1, 1)
    both = np.repeat(owner, 2)
    points = (1 - at) * a[both] + at * b[both]
    return Lines(points, np.arange(len(points)).reshape(-1, 2), lines.colour, lines.width, lines.opacity)


def _shading(faces: Faces, normal: Floats) -> Floats:
    """``shading``, where the polygons have these normals."""
    own = normal[np.repeat(np.arange(len(faces.sizes)), faces.sizes)]
    n = len(faces.points)
    mean = _unit(np.stack([np.bincount(faces.corners, own[:, k], n) for k in range(3)], axis=1))[faces.corners]
    agree = np.clip(((own * mean).sum(axis=1, keepdims=True) - CREASED) / (SMOOTH - CREASED), 0.0, 1.0)
    return _unit(own + agree * agree * (3 - 2 * agree) * (mean - own))


def _walk(faces: Faces) -> tuple[Floats, Indices, Indices, Indices]:
    """The corners' places; where each face starts; the next corner round the face; the face of each corner."""
    sizes = np.asarray(faces.sizes, dtype=np.intp)
    start = np.cumsum(sizes) - sizes
    owner = np.repeat(np.arange(len(sizes)), sizes)
    return np.asarray(faces.points, dtype=float)[faces.corners], start, next_corners(sizes), owner


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

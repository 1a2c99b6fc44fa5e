"""Triangles of many polygons that are all triangles or all quads: the usual case, and fast enough to drag.

Connectivity is worked out once and known again by the array of corners being the same object.  Corners at a vertex
where all polygons agree share one point; only where they do not has a corner a point of its own.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csr_array

from app.draw.picture import Faces
from subdivision.arrays import Floats, Indices, Mask

SMOOTH, CREASED = np.cos(np.radians([9.0, 17.0]))
"""Cosines: a polygon that leans less from the mean round its corner is shaded smoothly there, one that leans more
flatly; between the two the one passes into the other, so that nothing flickers while points move."""

KEPT = 6
"""How many connectivities are remembered."""


@dataclass(frozen=True, eq=False)
class Facets:
    """Triangles of polygons: a bent quad does not look creased, and where neighbours nearly agree they look smooth.

    ``points`` and ``normals`` (n, 3): first points that are vertices, ``vertices`` tells which, then the middle of
    every polygon, if any triangle has it; ``triangles`` (m, 3), and ``owner`` (m,) the polygon each is part of.
    """

    points: Floats
    normals: Floats
    triangles: Indices
    vertices: Indices
    owner: Indices


@dataclass(eq=False)
class _Known:
    """What depends on connectivity only: ``columns`` (size, n_faces) are the corners, first of all, second of all ...

    ``gather`` (n_vertices, n_faces) sums over the faces round each vertex.  ``split`` are the corners with a point of
    their own, numbered as in ``columns`` laid end to end, and ``cut`` the triangles that go with them.
    """

    corners: Indices
    n_vertices: int
    columns: Indices
    gather: csr_array
    owner: Indices
    split: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    cut: Indices | None = None
    vertices: Indices | None = None


_known: list[_Known] = []


def facets(faces: Faces) -> Facets | None:
    """As ``app.draw.geometry.facets``; None where polygons differ in size, or one is too concave for its middle."""
    known = _recalled(faces)
    if known is None:
        return None
    places: Floats = np.ascontiguousarray(np.asarray(faces.points, dtype=float).T)
    corners = [places[:, column] for column in known.columns]
    area = _areas(corners)
    if len(corners) == 4 and _is_any_too_concave(corners, area):
        return None
    own = _unit(area, otherwise=(0.0, 0.0, 1.0))
    mean = _unit(np.stack([known.gather @ each for each in own]))
    split = _split(known.columns, own, mean)
    triangles, vertices = _cut(known, split)
    shades = [mean, _blended(known, split, own, mean)]
    points = [places, places[:, known.columns.ravel()[split]]]
    if len(corners) == 4:
        shades.append(own)
        points.append(sum(corners[1:], start=corners[0]) / 4)
    return Facets(np.hstack(points).T, np.hstack(shades).T, triangles, vertices, known.owner)


def _recalled(faces: Faces) -> _Known | None:
    """The connectivity, known already or from now on."""
    for known in _known:
        if known.corners is faces.corners and known.n_vertices == len(faces.points):
            return known
    size = int(faces.sizes[0])
    if size not in (3, 4) or (faces.sizes != size).any():
        return None
    n, m = len(faces.points), len(faces.sizes)
    columns = np.ascontiguousarray(np.asarray(faces.corners, dtype=np.intp).reshape(-1, size).T)
    face = np.tile(np.arange(m), size)
    gather = csr_array((np.ones(size * m), (columns.ravel(), face)), (n, m))
    _known[:] = [_Known(faces.corners, n, columns, gather, face if size == 4 else np.arange(m)), *_known[: KEPT - 1]]
    return _known[0]


def _areas(corners: list[Floats]) -> Floats:
    """(3, n_faces): along the normals; of a quad the cross product of its diagonals, which is Newell's formula."""
    if len(corners) == 3:
        return _cross(corners[1] - corners[0], corners[2] - corners[0])
    return _cross(corners[2] - corners[0], corners[3] - corners[1])


def _is_any_too_concave(corners: list[Floats], area: Floats) -> bool:
    """Whether a triangle from an edge to the middle is turned away, by the signed areas of the four of each quad."""
    u, v, w = (corner - corners[0] for corner in corners[1:])
    before, whole, across = ((_cross(*pair) * area).sum(axis=0) for pair in ((u, v), (v, w), (u, w)))
    parts = (before + across, whole + across, whole + 2 * before - across, before + 2 * whole - across)
    least = min(float(part.min()) for part in parts)
    return least < -1e-12 * max(float((before + whole).max()), 0.0)


def _split(columns: Indices, own: Floats, mean: Floats) -> Indices:
    """The corners whose polygon leans so much from the mean that the two are told apart."""
    found = [
        k * columns.shape[1] + np.flatnonzero((mean[:, column] * own).sum(axis=0) < SMOOTH)
        for k, column in enumerate(columns)
    ]
    return np.concatenate(found)


def _cut(known: _Known, split: Indices) -> tuple[Indices, Indices]:
    """The triangles, and the vertex that each point but the middles is."""
    if known.cut is None or known.vertices is None or not np.array_equal(split, known.split):
        size, m = known.columns.shape
        number = known.columns.ravel().copy()
        number[split] = known.n_vertices + np.arange(len(split))
        corner = number.reshape(size, m)
        middle = known.n_vertices + len(split) + np.arange(m)
        sides = [(corner[k], corner[(k + 1) % 4], middle) for k in range(4)] if size == 4 else [tuple(corner)]
        known.split, known.cut = split, np.concatenate([np.stack(side, axis=1) for side in sides])
        known.vertices = np.concatenate([np.arange(known.n_vertices), known.columns.ravel()[split]])
    return known.cut, known.vertices


def _blended(known: _Known, split: Indices, own: Floats, mean: Floats) -> Floats:
    """(3, n_split): the normals of the corners that have a point of their own."""
    flat, round_ = own[:, split % known.columns.shape[1]], mean[:, known.columns.ravel()[split]]
    agree = np.clip(((flat * round_).sum(axis=0) - CREASED) / (SMOOTH - CREASED), 0.0, 1.0)
    return _unit(flat + agree * agree * (3 - 2 * agree) * (round_ - flat))


def _cross(a: Floats, b: Floats) -> Floats:
    """Of vectors that stand in columns."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def _unit(vectors: Floats, otherwise: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Floats:
    """Of length 1, in columns."""
    length = np.sqrt((vectors * vectors).sum(axis=0))
    nothing: Mask = length <= 0
    found = vectors / np.maximum(length, 1e-300)
    if nothing.any():
        found[:, nothing] = np.array(otherwise)[:, None]
    return np.asarray(found, dtype=float)

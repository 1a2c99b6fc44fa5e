"""Triangles of many polygons that are all triangles or all quads: the usual case, and fast enough to drag.

Connectivity is worked out once and known again by the array of corners being the same object.  Corners at a vertex
where all polygons agree share one point; only where they do not has a corner a point of its own.
"""

from dataclasses import dataclass

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

    ``gather`` (n_vertices, n_faces) sums over the faces round each vertex.  ``last`` is how it was cut last, ``made``
    what was made last, of which points, and whether in haste.
    """

    corners: Indices
    n_vertices: int
    columns: Indices
    gather: csr_array
    last: "_Cut | None" = None
    made: tuple[Facets, Floats, bool] | None = None


@dataclass(frozen=True, eq=False)
class _Cut:
    """Triangles, the polygon of each, and the vertex that each point but the middles is.

    ``split`` are the corners with a point of their own, numbered as in ``columns`` laid end to end; ``darts`` the quads
    too concave for their middle, and ``turn`` (0 or 1) the corner from which each of those is cut.
    """

    split: Indices
    darts: Indices
    turn: Indices
    triangles: Indices
    owner: Indices
    vertices: Indices


_known: list[_Known] = []

NONE: Indices = np.zeros(0, dtype=np.intp)


def facets(faces: Faces, *, is_hasty: bool = False) -> Facets | None:
    """As ``app.draw.geometry.facets``; None where polygons differ in size."""
    known = _recalled(faces)
    if known is None:
        return None
    made = known.made
    if made is None or made[2] != is_hasty or not np.array_equal(made[1], faces.points):
        known.made = made = _made(known, faces, is_hasty=is_hasty), faces.points, is_hasty
    return made[0]


def _made(known: _Known, faces: Faces, *, is_hasty: bool) -> Facets:
    places: Floats = np.ascontiguousarray(np.asarray(faces.points, dtype=float).T)
    corners = [places[:, column] for column in known.columns]
    area = _areas(corners)
    darts, turn = _darts(corners, area) if len(corners) == 4 else (NONE, NONE)
    if is_halved := is_hasty and len(corners) == 4:
        darts, turn = _halved(darts, turn, area.shape[1])
    own = _unit(area, otherwise=(0.0, 0.0, 1.0))
    mean = _unit(np.stack([known.gather @ each for each in own]))
    split = _split(known.columns, own, mean)
    known.last = cut = _cut(known, split, darts, turn)
    shades = [mean, _blended(known, split, own, mean)]
    points = [places, places[:, known.columns.ravel()[split]]]
    if len(corners) == 4 and not is_halved:
        shades.append(own)
        points.append(sum(corners[1:], start=corners[0]) / 4)
    return Facets(np.hstack(points).T, np.hstack(shades).T, cut.triangles, cut.vertices, cut.owner)


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
    _known[:] = [_Known(faces.corners, n, columns, gather), *_known[: KEPT - 1]]
    return _known[0]


def _areas(corners: list[Floats]) -> Floats:
    """(3, n_faces): along the normals; of a quad the cross product of its diagonals, which is Newell's formula."""
    if len(corners) == 3:
        return _cross(corners[1] - corners[0], corners[2] - corners[0])
    return _cross(corners[2] - corners[0], corners[3] - corners[1])


def _darts(corners: list[Floats], area: Floats) -> tuple[Indices, Indices]:
    """The quads with an edge whose triangle to the middle is turned away, and the corner, 0 or 1, to cut them from.

    By the signed areas of triangles: of those at the corners 1 and 3, which a cut from corner 0 makes, of the one that
    lies across, and of the four to the middle.
    """
    u, v, w = (corner - corners[0] for corner in corners[1:])
    before, whole, across = (_dotted(_cross(*pair), area) for pair in ((u, v), (v, w), (u, w)))
    parts = (before + across, whole + across, whole + 2 * before - across, before + 2 * whole - across)
    least = np.minimum(np.minimum(parts[0], parts[1]), np.minimum(parts[2], parts[3]))
    found = np.flatnonzero(least < -1e-12 * max(float((before + whole).max()), 0.0))
    return found, (np.minimum(before, whole)[found] < 0).astype(np.intp)


def _halved(darts: Indices, turn: Indices, n: int) -> tuple[Indices, Indices]:
    """All of ``n`` quads cut as darts are: along a diagonal."""
    turns: Indices = np.zeros(n, dtype=np.intp)
    turns[darts] = turn
    return np.arange(n), turns


def _split(columns: Indices, own: Floats, mean: Floats) -> Indices:
    """The corners whose polygon leans so much from the mean that the two are told apart."""
    found = [
        k * columns.shape[1] + np.flatnonzero((mean[:, column] * own).sum(axis=0) < SMOOTH)
        for k, column in enumerate(columns)
    ]
    return np.concatenate(found)


def _cut(known: _Known, split: Indices, darts: Indices, turn: Indices) -> _Cut:
    """As it was cut last, if nothing has changed."""
    last = known.last
    if last is not None and all(map(np.array_equal, (split, darts, turn), (last.split, last.darts, last.turn))):
        return last
    size, m = known.columns.shape
    number = known.columns.ravel().copy()
    number[split] = known.n_vertices + np.arange(len(split))
    vertices = np.concatenate([np.arange(known.n_vertices), known.columns.ravel()[split]])
    corner, faces = number.reshape(size, m), np.arange(m)
    if size == 3:
        return _Cut(split, darts, turn, np.ascontiguousarray(corner.T), faces, vertices)
    middle = known.n_vertices + len(split) + faces
    fan = np.delete(np.arange(m), darts) if len(darts) else faces
    parts = [np.stack([corner[k, fan], corner[(k + 1) % 4, fan], middle[fan]], axis=1) for k in range(4)]
    for k in (1, 2):
        parts.append(np.stack([corner[(turn + j) % 4, darts] for j in (0, k, k + 1)], axis=1))
    owner = np.concatenate([np.tile(fan, 4), np.tile(darts, 2)])
    return _Cut(split, darts, turn, np.concatenate(parts), owner, vertices)


def _blended(known: _Known, split: Indices, own: Floats, mean: Floats) -> Floats:
    """(3, n_split): the normals of the corners that have a point of their own."""
    flat, round_ = own[:, split % known.columns.shape[1]], mean[:, known.columns.ravel()[split]]
    agree = np.clip(((flat * round_).sum(axis=0) - CREASED) / (SMOOTH - CREASED), 0.0, 1.0)
    return _unit(flat + agree * agree * (3 - 2 * agree) * (round_ - flat))


def _dotted(a: Floats, b: Floats) -> Floats:
    """(n,): of vectors that stand in columns."""
    return np.asarray(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


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

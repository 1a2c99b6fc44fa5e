"""How a surface bends, from its polygons alone: Gauss and mean curvature at vertices, and normals.

The discretisation is that of [MDSB03]_ for triangles: the angle that is missing round a vertex, and the cotangent
formula, both divided by the area of the vertex.  Ours is how polygons become triangles: each is cut into a fan from
every one of its corners, and the mean of all these cuts is taken, so that no diagonal is preferred and the sum of the
missing angles is still 2 pi times the Euler characteristic.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.sparse import csr_array

from subdivision.arrays import Floats, Indices, Mask, frozen
from subdivision.rows import Connectivity, Polyline
from subdivision.trace import Mesh

NOTHING = 1e-300
"""Areas and lengths below this are none."""


def angle_defects(mesh: Mesh) -> Floats:
    """(n_vertices,) radians: 2 pi less the angles round a vertex, pi less them on the boundary; their sum is 2 pi chi.

    Vertices without faces have none: 0.
    """
    t, cut = mesh.topology, _fans(mesh)
    angles = np.stack([np.arctan2(cut.double, dot) for dot in cut.dots])
    whole = np.where(_rim(t), np.pi, 2 * np.pi)
    return np.where(_used(t), whole - cut.summed(angles), 0.0)


def gauss_curvature(mesh: Mesh) -> Floats:
    """(n_vertices,) 1 / length ** 2: the angle defect by area; nan on the boundary, where a surface has only a side."""
    return _inside(mesh.topology, _divided(angle_defects(mesh), _areas(_fans(mesh))))


def mean_curvature(mesh: Mesh) -> Floats:
    """(n_vertices,) 1 / length: half the length of the mean curvature normal, positive where the surface is convex.

    That normal is the sum of (cot a + cot b)(p - q) over the neighbours q of p, by twice the area; a and b are the
    angles opposite to the edge pq.  nan on the boundary.
    """
    cut = _fans(mesh)
    # at corner i, along the edge to j, with the angle at the third corner k; and the same with j and k exchanged
    push = [cut.cotangents[(i + 1) % 3] * cut.sides[(i + 2) % 3] - cut.cotangents[(i + 2) % 3] * cut.sides[i]
            for i in range(3)]  # fmt: skip
    across = np.stack([cut.summed(np.stack([each[axis] for each in push])) for axis in range(3)])
    outward = np.sign((across * _leaning(cut)).sum(axis=0))
    size = np.sqrt((across * across).sum(axis=0))
    return _inside(mesh.topology, outward * _divided(size, 4 * _areas(cut)))


def areas(mesh: Mesh) -> Floats:
    """(n_vertices,) length ** 2: of the part of the surface that is nearest to each vertex: its Voronoi area.

    The source gives half of an obtuse triangle to its obtuse corner and a quarter to both others, so that no part is
    negative.  But then a vertex of valence 3, where quads are obtuse, looks as if it bent by a third more than it does:
    here that holds only for vertices whose Voronoi area is not half as large as their area by this rule.
    """
    return _areas(_fans(mesh))


def vertex_normals(mesh: Mesh) -> Floats:
    """(n_vertices, 3): the mean direction of the polygons round each vertex, of length 1; 0 where there is none."""
    leaning = _leaning(_fans(mesh))
    return np.ascontiguousarray((leaning / np.maximum(np.sqrt((leaning * leaning).sum(axis=0)), NOTHING)).T)


@dataclass(frozen=True, eq=False)
class _Fans:
    """Triangles that polygons are cut into, in columns.

    ``sides`` are three of (3, m): from each corner to the next.  ``normal`` (3, m) is twice as long as the triangle is
    large, ``double``; ``dots`` and ``cotangents`` are those of the angles at the corners.
    """

    sides: list[Floats]
    normal: Floats
    double: Floats
    dots: list[Floats]
    cotangents: list[Floats]
    gather: csr_array

    def summed(self, at_corners: Floats) -> Floats:
        """(n_vertices,): values (3, m) of corners summed at vertices, each cut counting equally."""
        return np.asarray(self.gather @ at_corners.ravel(), dtype=float)


def _fans(mesh: Mesh) -> _Fans:
    corners, gather = _triangles(mesh.topology)
    columns = np.ascontiguousarray(mesh.points.T)
    a, b, c = (columns[:, corner] for corner in corners)
    sides = [b - a, c - b, a - c]
    (x, y, z), (u, v, w) = sides[0], sides[2]
    normal = np.stack([z * v - y * w, x * w - z * u, y * u - x * v])
    double = np.sqrt((normal * normal).sum(axis=0))
    dots = [-(sides[k] * sides[k - 1]).sum(axis=0) for k in range(3)]
    return _Fans(sides, normal, double, dots, [_divided(dot, double) for dot in dots], gather)


def _areas(cut: _Fans) -> Floats:
    """``areas`` of the triangles' vertices."""
    obtuse = np.stack([dot < 0 for dot in cut.dots])
    long = [(side * side).sum(axis=0) for side in cut.sides]
    # side k leads from corner k to the next; the angle at the one before is opposite to it
    parts = [long[k] * cut.cotangents[k - 1] / 8 for k in range(3)]
    voronoi = np.stack([parts[k] + parts[k - 1] for k in range(3)])
    mixed = np.where(obtuse.any(axis=0), np.where(obtuse, cut.double / 4, cut.double / 8), voronoi)
    nearest, safe = cut.summed(voronoi), cut.summed(mixed)
    return np.where(nearest < safe / 2, safe, nearest)


def _leaning(cut: _Fans) -> Floats:
    """(3, n_vertices): the normals of the triangles round each vertex, larger ones counting more."""
    return np.stack([cut.summed(np.tile(axis, (3, 1))) for axis in cut.normal])


@lru_cache(maxsize=8)
def _triangles(t: Connectivity) -> tuple[Indices, csr_array]:
    """Corners (3, m) of every polygon cut from each of its corners, both cuts of a quad once; and how they are summed.

    The sum (n_vertices, 3 m) counts every cut of a polygon equally.
    """
    found, counts = [np.zeros((0, 3), dtype=np.intp)], [np.zeros(0)]
    start = np.cumsum(t.face_sizes) - t.face_sizes
    for size in np.unique(t.face_sizes).tolist():
        loops = t.origin[start[t.face_sizes == size][:, None] + np.arange(size)]
        cuts = {3: 1, 4: 2}.get(size, size)
        for first in range(cuts):
            for k in range(1, size - 1):
                found.append(loops[:, [first, (first + k) % size, (first + k + 1) % size]])
                counts.append(np.full(len(loops), 1 / cuts))
    corners = np.ascontiguousarray(np.concatenate(found).T)
    each, m = np.tile(np.concatenate(counts), 3), corners.shape[1]
    return frozen(corners), csr_array((each, (corners.ravel(), np.arange(3 * m))), (t.n_vertices, 3 * m))


def _divided(a: Floats, b: Floats) -> Floats:
    """The quotient; 0 where there is nothing to divide by."""
    return np.where(b > NOTHING, a / np.maximum(b, NOTHING), 0.0)


def _used(t: Connectivity) -> Mask:
    """(n_vertices,) bool: corners of faces."""
    return np.asarray(np.bincount(t.origin, minlength=t.n_vertices) > 0)


def _rim(t: Connectivity) -> Mask:
    """(n_vertices,) bool: vertices on the boundary."""
    found = np.zeros(t.n_vertices, dtype=np.bool_)
    if not isinstance(t, Polyline):
        found[t.ends[t.boundary]] = True
    return found


def _inside(t: Connectivity, values: Floats) -> Floats:
    """nan on the boundary and at vertices without faces."""
    return np.where(_rim(t) | ~_used(t), np.nan, values)

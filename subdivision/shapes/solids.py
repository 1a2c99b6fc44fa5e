"""Closed control meshes that one can count by hand."""

from itertools import product

import numpy as np

from subdivision import refine
from subdivision.averages import edge_midpoints, face_centroids
from subdivision.shapes.build import mesh, meshed, turns
from subdivision.shapes.nets import torus_net
from subdivision.trace import Mesh


def cube() -> Mesh:
    """[-1, 1]^3 in quads: V/E/F 8/12/6, valence 3 everywhere.  Vertices in binary order, so 7 is (1, 1, 1)."""
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return mesh(list(product((-1.0, 1.0), repeat=3)), faces)


def plus_sign() -> Mesh:
    """Seven cubes, a plus sign in all three directions: V/E/F 32/60/30; valence 3 at 24 vertices, 6 at 8."""
    corners = [p for p in product((-1.5, -0.5, 0.5, 1.5), repeat=3) if sum(abs(x) > 1 for x in p) < 2]
    number = {p: k for k, p in enumerate(corners)}
    squares = [
        (centre, axis, sign)
        for centre in product((-1.0, 0.0, 1.0), repeat=3)
        if sum(map(abs, centre)) == 1
        for axis, sign in product(range(3), (-1, 1))
        if centre[axis] != -sign
    ]
    return mesh(corners, [[number[p] for p in _square(*square)] for square in squares])


def tetrahedron() -> Mesh:
    """Four triangles, standing on one: V/E/F 4/6/4, valence 3 everywhere."""
    base = [(np.sqrt(2) * np.cos(a), np.sqrt(2) * np.sin(a), -0.5) for a in turns(3, start=0.5)]
    return mesh([*base, (0.0, 0.0, 1.5)], [[0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 2, 1]])


def octahedron() -> Mesh:
    """Eight triangles with corners on the axes: V/E/F 6/12/8, valence 4 everywhere."""
    return bipyramid(4)


def icosahedron() -> Mesh:
    """Twenty triangles: V/E/F 12/30/20, valence 5 everywhere; the poles are the first and the last vertex."""
    r, h = 2 / np.sqrt(5), 1 / np.sqrt(5)
    upper = [(r * np.cos(a), r * np.sin(a), h) for a in turns(5)]
    lower = [(r * np.cos(a), r * np.sin(a), -h) for a in turns(5, start=0.5)]
    faces = []
    for k in range(5):
        a, b, c, d = 1 + k, 1 + (k + 1) % 5, 6 + k, 6 + (k + 1) % 5
        faces += [[0, a, b], [a, c, b], [b, c, d], [c, 11, d]]
    return mesh([(0.0, 0.0, 1.0), *upper, *lower, (0.0, 0.0, -1.0)], faces)


def bipyramid(n: int = 8) -> Mesh:
    """``2n`` triangles from a regular n-gon to the poles, vertices ``n`` and ``n + 1``.

    V/E/F n+2/3n/2n: 10/24/16 at n = 8.  The poles have valence ``n``, the others 4.
    """
    ring = [(np.cos(a), np.sin(a), 0.0) for a in turns(n)]
    faces = [[k, (k + 1) % n, n] for k in range(n)] + [[(k + 1) % n, k, n + 1] for k in range(n)]
    return mesh([*ring, (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)], faces)


def quad_bipyramid(n: int = 5) -> Mesh:
    """The bipyramid with every triangle cut into three quads.

    V/E/F 6n+2/12n/6n: 32/60/30 at n = 5.  The poles, vertices ``n`` and ``n + 1``, have valence
    ``n``; the ``2n`` face points have 3, all others 4.
    """
    triangles = bipyramid(n)
    t, points = triangles.surface, triangles.points
    centroids, midpoints = face_centroids(t).apply(points), edge_midpoints(t).apply(points)
    return Mesh(refine.quads(t), np.concatenate([points, centroids, midpoints]))


def torus(n: int = 5, m: int = 4) -> Mesh:
    """A ring of ``n`` boxes, ``m`` quads round each: V/E/F 20/40/20 at 5 by 4, valence 4 everywhere; V - E + F = 0."""
    return meshed(torus_net(n, m))


def triangle_torus(n: int = 5, m: int = 4) -> Mesh:
    """The same with every quad cut in two: V/E/F 20/60/40 at 5 by 4, valence 6 everywhere."""
    return meshed(torus_net(n, m, diagonal=True))


def _square(centre: tuple[float, ...], axis: int, sign: int) -> list[tuple[float, ...]]:
    """Corners of one side of the unit cube about ``centre``, counter-clockwise from outside."""
    corners = []
    for u, v in ((-sign, -1), (sign, -1), (sign, 1), (-sign, 1)):
        corner = list(centre)
        for k, step in ((axis, sign), ((axis + 1) % 3, u), ((axis + 2) % 3, v)):
            corner[k] += step / 2
        corners.append(tuple(corner))
    return corners

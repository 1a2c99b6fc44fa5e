"""Subdivision as a student would first write it: dictionaries, and loops over faces.

It shares nothing with the engine: points have names instead of numbers (a vertex ``v``, an edge
``frozenset({a, b})``, a face ``("face", k)``), and every cell of the refined mesh is a list of names.
"""

from collections import defaultdict
from collections.abc import Callable, Hashable, Sequence
from math import cos, pi
from typing import TypeAlias

import numpy as np

from subdivision import Topology
from subdivision.arrays import Floats

Faces: TypeAlias = Sequence[Sequence[int]]
Points: TypeAlias = dict[Hashable, Floats]
Cells: TypeAlias = list[list[Hashable]]


def loop_beta(n: int) -> float:
    return (5 / 8 - (3 / 8 + cos(2 * pi / n) / 4) ** 2) / n


def warren_beta(n: int) -> float:
    return 3 / 16 if n == 3 else 3 / 8 / n


def centroid_beta(n: int) -> float:
    return 3 / 8 / n


BETAS = {"triangle-centroid": centroid_beta, "loop": loop_beta, "loop-warren": warren_beta}

QUAD_WEIGHTS: dict[str, Callable[[int], tuple[float, float, float]]] = {
    "quad-centroid": lambda n: (9 / 16, 6 / 16 / n, 1 / 16 / n),
    "catmull-clark": lambda n: (1 - 7 / 4 / n, 3 / 2 / n**2, 1 / 4 / n**2),
}


def faces_at_edges(faces: Faces) -> dict[frozenset[int], list[int]]:
    table = defaultdict(list)
    for k, loop in enumerate(faces):
        for a, b in zip(loop, [*loop[1:], loop[0]], strict=True):
            table[frozenset((a, b))].append(k)
    return dict(table)


def valences(faces: Faces) -> dict[int, int]:
    count: dict[int, int] = defaultdict(int)
    for edge in faces_at_edges(faces):
        for v in edge:
            count[v] += 1
    return dict(count)


def boundary_edges(faces: Faces) -> list[frozenset[int]]:
    return [edge for edge, beside in faces_at_edges(faces).items() if len(beside) == 1]


def split(points: Floats, faces: Faces) -> tuple[Points, Cells]:
    """The topological stage: new points in the middle, quads or (of triangles) triangles."""
    X: Points = dict(enumerate(points))
    for edge in faces_at_edges(faces):
        X[edge] = sum(points[v] for v in edge) / 2
    cells: Cells = []
    for k, loop in enumerate(faces):
        n = len(loop)
        middles = [frozenset((loop[i], loop[(i + 1) % n])) for i in range(n)]
        if n == 3:
            cells += [[loop[i], middles[i], middles[i - 1]] for i in range(3)] + [list(middles)]
        else:
            X["face", k] = sum(points[v] for v in loop) / n
            cells += [[loop[i], middles[i], ("face", k), middles[i - 1]] for i in range(n)]
    return X, cells


def averaged(
    X: Points, cells: Cells, curves: Sequence[Sequence[Hashable]] = (), pins: Sequence[Hashable] = ()
) -> Points:
    """The geometric stage: every point to the mean of the centroids of its cells of lowest dimension."""
    centroids: dict[Hashable, dict[int, list[Floats]]] = defaultdict(lambda: {0: [], 1: [], 2: []})
    for v in pins:
        centroids[v][0].append(X[v])
    for a, b in curves:
        for v in (a, b):
            centroids[v][1].append((X[a] + X[b]) / 2)
    for cell in cells:
        for i, v in enumerate(cell):
            if len(cell) == 4:
                centroids[v][2].append(sum(X[w] for w in cell) / 4)
            else:
                centroids[v][2].append(2 / 8 * X[v] + 3 / 8 * X[cell[i - 1]] + 3 / 8 * X[cell[i - 2]])
    found = {}
    for v, by_dimension in centroids.items():
        lowest = next(cells for cells in by_dimension.values() if cells)
        found[v] = sum(lowest) / len(lowest)
    return found


def halves(edges: Sequence[frozenset[int]]) -> list[tuple[Hashable, Hashable]]:
    return [(v, edge) for edge in edges for v in edge]


def stencilled(points: Floats, faces: Faces, scheme: str) -> Points:
    """The same level in one go, by the published stencils; closed meshes only."""
    found: Points = {}
    neighbours: dict[int, set[int]] = defaultdict(set)
    opposite: dict[int, list[int]] = defaultdict(list)
    for k, loop in enumerate(faces):
        for i, v in enumerate(loop):
            neighbours[v] |= {loop[i - 1], loop[(i + 1) % len(loop)]}
            opposite[v].append(loop[i - 2])
        if len(loop) == 4:
            found["face", k] = sum(points[v] for v in loop) / 4
    for edge, beside in faces_at_edges(faces).items():
        others = sum(points[v] for k in beside for v in faces[k] if v not in edge)
        ends = sum(points[v] for v in edge)
        found[edge] = 6 / 16 * ends + 1 / 16 * others if len(faces[0]) == 4 else 3 / 8 * ends + 1 / 8 * others
    for v, around in neighbours.items():
        n, ring = len(around), sum(points[w] for w in around)
        if scheme in BETAS:
            beta = BETAS[scheme](n)
            found[v] = (1 - n * beta) * points[v] + beta * ring
        else:
            a, b, c = QUAD_WEIGHTS[scheme](n)
            found[v] = a * points[v] + b * ring + c * sum(points[w] for w in opposite[v])
    return found


def named(t: Topology, rows: Floats) -> Points:
    """What the engine made of ``t`` (vertices, then faces of quads, then edges), by name."""
    V, F = t.n_vertices, 0 if t.is_triangular else t.n_faces
    found: Points = {v: rows[v] for v in range(V)}
    found |= {("face", k): rows[V + k] for k in range(F)}
    found |= {frozenset(map(int, ends)): rows[V + F + e] for e, ends in enumerate(t.ends)}
    return found


def difference(a: Points, b: Points) -> float:
    assert a.keys() == b.keys()
    return max(float(np.abs(a[name] - b[name]).max()) for name in a)

"""Limit positions on meshes, as scheme files tell them: left eigenvectors in closed form.

The meshes here are *settled*: all faces have the size that the scheme makes, and sharpness is
either none or never wears off (``limit.py`` refines until that is so).

With ``p`` the pull of a vertex, a quad scheme's limit is ``(4 V + 4 p mean(E) + p mean(F))/(4 + 5 p)``,
which is the published (n^2, 4, 1)/(n (n + 5)) for Catmull-Clark's ``p = 4/n`` [HKD93]_; a triangle
scheme's is ``(3 V + 8 n beta mean(N))/(3 + 8 n beta)`` [Loop87]_.  Creases end at (2/3, 1/6, 1/6).
"""

from collections.abc import Callable
from fractions import Fraction

import numpy as np

from subdivision.arrays import Floats
from subdivision.averages import neighbours, vertex_corners
from subdivision.exact import Exact, Formula, quotient
from subdivision.fans import Corner, dart_ends, weighed
from subdivision.meshes import as_mesh
from subdivision.operators import Mean, Operator, Pick, identity, mix
from subdivision.rows import Connectivity
from subdivision.sharpness import blend, vertex_rules
from subdivision.stage import Role, Stage
from subdivision.topology import Topology
from subdivision.weights import by_count, by_value


def quad_limit(t: Topology, pull: Callable[[int], Exact | int]) -> Stage:
    """Every vertex to its limit; ``pull`` as in ``centroids.quad_averaging``."""
    opposite = Mean(t.origin, t.origin[t.next[t.next]], (t.n_vertices, t.n_vertices))
    away = by_count(lambda n: quotient(5 * pull(n), 4 + 5 * pull(n)), t.valence)
    smooth = mix(away, Fraction(4, 5) * neighbours(t) + Fraction(1, 5) * opposite, identity(t.n_vertices))
    return _told(t, smooth, lambda n: quad_dart(n, float(pull(n)) / 4))


def triangle_limit(t: Topology, beta: Callable[[int], Exact | int]) -> Stage:
    """Every vertex to its limit; ``beta`` as in ``centroids.triangle_stencils``."""
    away = by_count(lambda n: quotient(8 * n * beta(n), 3 + 8 * n * beta(n)), t.valence)
    smooth = mix(away, neighbours(t), identity(t.n_vertices))
    return _told(t, smooth, lambda n: triangle_dart(n, float(beta(n))))


def dual_limit(t: Topology, corners: Callable[[Topology], Operator]) -> Stage:
    """Every vertex of a closed mesh to the limit of the face it becomes: its centroid, which stays where it is.

    ``corners(t)`` (n_halfedges, n_halfedges) is the rule of the corner points.
    """
    around = vertex_corners(t) @ (corners(t) @ Pick(t.origin, t.n_vertices))
    return vertices_to(t, around)


def vertices_to(t: Topology, limits: Operator) -> Stage:
    """The stage that moves every vertex to its limit; isolated ones stay."""
    V = t.n_vertices
    if (t.valence == 0).any():
        limits = mix(by_value(t.valence > 0), limits, identity(V))
    return Stage("limit", limits, t, np.arange(V), np.full(V, Role.MOVED))


def every_vertex_stays(topology: Connectivity) -> Stage:
    """The limit stage of a scheme that interpolates."""
    t = as_mesh(topology)
    return vertices_to(t, identity(t.n_vertices))


def quad_dart(n: int, w: float) -> Floats:
    """(2 n + 1, 2 n + 1): vertex, neighbours, opposite corners to the same one level on; the first edge is sharp."""
    S = np.zeros((2 * n + 1, 2 * n + 1))
    S[0] = [1 - 7 * w / 4, *[3 * w / (2 * n)] * n, *[w / (4 * n)] * n]
    for i in range(n):
        after, before = (i + 1) % n, (i - 1) % n
        for column in (0, 1 + i):
            S[1 + i, column] += 6 / 16
        for column in (1 + after, 1 + before, 1 + n + i, 1 + n + before):
            S[1 + i, column] += 1 / 16
        for column in (0, 1 + i, 1 + after, 1 + n + i):
            S[1 + n + i, column] += 1 / 4
    S[1] = [1 / 2, 1 / 2, *[0] * (2 * n - 1)]
    return S


def triangle_dart(n: int, beta: float) -> Floats:
    """(n + 1, n + 1): vertex and neighbours to the same one level on; the first edge is sharp."""
    S = np.zeros((n + 1, n + 1))
    S[0] = [1 - n * beta, *[beta] * n]
    for i in range(n):
        for column, weight in ((0, 3), (1 + i, 3), (1 + (i + 1) % n, 1), (1 + (i - 1) % n, 1)):
            S[1 + i, column] += weight / 8
    S[1] = [1 / 2, 1 / 2, *[0] * (n - 1)]
    return S


def corners_of(row: Floats, n: int, text: str) -> list[Corner]:
    """A row over vertex, neighbours (and opposite corners), as weights of the ``n`` corners of a fan."""
    words: list[Exact] = [Formula(f"{text}, weight {k}", float(weight)) for k, weight in enumerate(row)]
    opposite = words[1 + n :] or [Fraction(0)] * n
    return [(words[0] if i == 0 else 0, words[1 + i], opposite[i], 0) for i in range(n)]


def _told(t: Topology, smooth: Operator, dart: Callable[[int], Floats]) -> Stage:
    V = t.n_vertices
    if (ends := dart_ends(t)).any():
        darts = np.zeros(V, dtype=np.intp)
        darts[t.origin[ends]] = 1
        around = weighed(t, darts, lambda _, n: corners_of(_fixed(dart(n)), n, f"fixed row of a dart of valence {n}"))
        smooth = mix(by_value(darts > 0), around, smooth)
    moved = blend(
        vertex_rules(t), smooth,
        lambda sharp: Fraction(2, 3) * identity(V) + Fraction(1, 3) * neighbours(t, sharp), identity(V),
    )  # fmt: skip
    return vertices_to(t, moved)


def _fixed(S: Floats) -> Floats:
    """The row ``l`` with ``l S = l`` that sums to one.

    A dart's edge point is a midpoint on one side, so its ring is no circle and has no closed form.
    """
    n = len(S)
    system = np.concatenate([S.T - np.eye(n), np.ones((1, n))])
    return np.asarray(np.linalg.lstsq(system, np.r_[np.zeros(n), 1.0])[0])

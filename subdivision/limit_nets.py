"""Limits of polygons and rectangular nets, as scheme files tell them: values of their basis functions.

Point ``j`` of a level tends to the surface point at its own parameter.  Only points all of whose
parents exist have one: the rim of an open net supports the surface without being on it.
"""

from collections.abc import Mapping
from fractions import Fraction
from functools import cache, reduce
from itertools import product

import numpy as np

from subdivision.arrays import Indices
from subdivision.continuity import mask, promise, smoothness
from subdivision.manifold import TopologyError
from subdivision.operators import Operator, Pick
from subdivision.passes import Vector
from subdivision.rows import Connectivity, Grid, Polyline
from subdivision.stage import Role, Stage
from subdivision.words import phrase


def curve_limit(t: Connectivity, degree: int) -> Stage:
    """Every point of a polygon that has one to its limit on the B-spline curve of that ``degree``."""
    if not isinstance(t, Polyline):
        raise TopologyError("this scheme has limits of polygons only")
    weights = b_spline(degree)
    reach = max(weights)
    kept = np.arange(t.n_vertices) if t.closed else np.arange(reach, t.n_vertices - reach)
    if len(kept) == 0:
        raise TopologyError(
            phrase("{n} points are too few: a limit needs {reach} of them on either side", n=t.n_vertices, reach=reach)
        )
    parts = [w * Pick((kept + k) % t.n_vertices, t.n_vertices) for k, w in weights.items()]
    return _told(reduce(Operator.__add__, parts), Polyline(len(kept), t.closed), kept)


def net_limit(t: Connectivity, weights: Mapping[Vector, Fraction]) -> Stage:
    """Every point of a net that has one to its limit; ``weights`` are those of the points around it."""
    if not isinstance(t, Grid):
        raise TopologyError("this scheme has limits of rectangular nets only")
    reach_s, reach_t = max(i for i, _ in weights), max(j for _, j in weights)
    low_s, low_t = -min(i for i, _ in weights), -min(j for _, j in weights)
    rows = np.arange(t.n_s) if t.wrap_s else np.arange(low_s, t.n_s - reach_s)
    columns = np.arange(t.n_t) if t.wrap_t else np.arange(low_t, t.n_t - reach_t)
    if min(len(rows), len(columns)) == 0:
        needed = phrase("{n_s} by {n_t}", n_s=low_s + reach_s + 1, n_t=low_t + reach_t + 1)
        raise TopologyError(
            phrase(
                "a net of {n_s} by {n_t} points is too small: limits need {needed}", n_s=t.n_s, n_t=t.n_t, needed=needed
            )
        )
    parts = [
        w * Pick(t.numbers[np.ix_((rows + i) % t.n_s, (columns + j) % t.n_t)].ravel(), t.n_vertices)
        for (i, j), w in weights.items()
    ]
    kept = t.numbers[np.ix_(rows, columns)].ravel()
    shape = Grid(len(rows), len(columns), t.wrap_s, t.wrap_t, t.diagonal)
    return _told(reduce(Operator.__add__, parts), shape, kept)


def interpolated(t: Connectivity, lost: int = 0) -> Stage:
    """Every point is its own limit; an open polygon has ``lost`` points at either end that have none."""
    if not isinstance(t, Polyline):
        raise TopologyError("this scheme has limits of polygons only")
    kept = np.arange(t.n_vertices) if t.closed else np.arange(lost, t.n_vertices - lost)
    return _told(Pick(kept, t.n_vertices), Polyline(len(kept), t.closed), kept)


def b_spline(degree: int) -> dict[int, Fraction]:
    """Weights of the points ``k`` further on in the limit of a point: the B-spline at ``k``, by Cox and de Boor."""
    reach = degree // 2
    return {k: _centred(degree, Fraction(k)) for k in range(-reach, reach + 1)}


def tensor_weights(m: int, n: int) -> dict[Vector, Fraction]:
    """Weights of the points ``(i, j)`` further on, for bidegree ``(m, n)``."""
    return {(i, j): a * b for (i, a), (j, b) in product(b_spline(m).items(), b_spline(n).items())}


@cache
def box_weights(vectors: tuple[Vector, ...]) -> dict[Vector, Fraction]:
    """Weights of the points ``k`` further on, for a box spline: its values there, read off its mask.

    The box spline refines itself, ``phi(x) = sum of c_j phi(2 x - j)``; at the integers these are
    linear equations with one solution, and half-integers follow.

    Raises
    ------
    TopologyError
        Where the limit jumps, so that it has no value at its points.
    """
    if smoothness(vectors) < 0:
        raise TopologyError(promise(vectors))
    c = mask(vectors)
    inside = [(i + c.origin[0], j + c.origin[1]) for i in range(len(c.rows)) for j in range(len(c.rows[0]))]
    refines = [[c[2 * x[0] - y[0], 2 * x[1] - y[1]] for y in inside] for x in inside]
    at_integers = dict(zip(inside, _fixed(refines), strict=True))

    def value(twice: Vector) -> Fraction:
        if twice[0] % 2 == twice[1] % 2 == 0:
            return at_integers.get((twice[0] // 2, twice[1] // 2), Fraction(0))
        around = {y: (twice[0] - y[0], twice[1] - y[1]) for y in inside}
        return sum((c[y] * at_integers[x] for y, x in around.items() if x in at_integers), Fraction(0))

    across = [sum(v[axis] for v in vectors) for axis in (0, 1)]
    steps = product(*(range(-len(line), len(line) + 1) for line in (c.rows, c.rows[0])))
    weights = {(i, j): value((across[0] - 2 * i, across[1] - 2 * j)) for i, j in steps}
    return {step: weight for step, weight in weights.items() if weight}


def _centred(degree: int, x: Fraction) -> Fraction:
    """The uniform B-spline with knots 1 apart, centred at 0."""
    half = Fraction(1, 2)
    if degree == 0:
        return Fraction(int(-half <= x < half))
    reach = (degree + 1) * half
    left, right = _centred(degree - 1, x + half), _centred(degree - 1, x - half)
    return ((reach + x) * left + (reach - x) * right) / degree


def _fixed(matrix: list[list[Fraction]]) -> list[Fraction]:
    """The only ``v`` with ``matrix v = v`` whose entries sum to one, by elimination in fractions."""
    n = len(matrix)
    rows = [[w - int(i == j) for j, w in enumerate(row)] + [Fraction(0)] for i, row in enumerate(matrix)]
    rows.append([Fraction(1)] * (n + 1))
    for column in range(n):
        pivot = next((k for k in range(column, n + 1) if rows[k][column]), None)
        if pivot is None:
            raise TopologyError("the values of this box spline at its points are not told by its mask alone")
        rows[column], rows[pivot] = rows[pivot], rows[column]
        rows[column] = [w / rows[column][column] for w in rows[column]]
        for k in range(n + 1):
            if k != column and rows[k][column]:
                factor = rows[k][column]
                rows[k] = [w - factor * p for w, p in zip(rows[k], rows[column], strict=True)]
    return [row[n] for row in rows[:n]]


def _told(operator: Operator, topology: Connectivity, kept: Indices) -> Stage:
    return Stage("limit", operator, topology, kept, np.full(len(kept), Role.MOVED))

"""The four-point scheme [DGL87]_: a curve through all points of its polygon.

Between two points comes ``(1/2 + w)`` of each of them and ``-w`` of each of the two beyond.  The
tension ``w`` is 0 for the polygon itself and 1/16 for the rule that keeps points of a cubic on it.
The curve is C1 for ``0 < w < (sqrt(5) - 1)/8``, but has no second derivative even at 1/16.

At the ends of an open polygon four points are not to be had.  The paper's own way is to give two
points more at either end, which steer the curve without being on it: N points become ``2 N - 5``.
"""

from enum import Enum
from fractions import Fraction
from functools import partial

import numpy as np

from subdivision.arrays import Indices
from subdivision.four_points import CUBIC, along, pushed, reflected
from subdivision.limit_nets import interpolated
from subdivision.operators import MeanOf, Operator, Pick, identity, stack
from subdivision.passes import as_polygon, room
from subdivision.rows import Connectivity, Polyline
from subdivision.scheme import Scheme
from subdivision.stage import Role, Stage, Step
from subdivision.weights import Weights
from subdivision.words import phrase


class Ends(Enum):
    """What happens at the ends of an open polygon."""

    SHORTENED = "shortened"
    """A new point needs four old ones: the outermost point and edge at either end are lost at every level [DGL87]_."""
    REFLECTED = "reflected"
    """A phantom point ``2 p0 - p1`` beyond either end: the curve begins and ends with the polygon (ours)."""


def four_point(tension: Fraction | float = CUBIC, ends: Ends = Ends.SHORTENED) -> Scheme:
    """The scheme of a ``tension``; a float is taken as the binary fraction that it is."""
    w = Fraction(tension)
    is_usual = ends is Ends.SHORTENED
    title = "Four-point scheme, tension {w}" if is_usual else "Four-point scheme, tension {w}, {ends} ends"
    return Scheme(
        name=f"four-point {w}" if is_usual else f"four-point {w}, {ends.value} ends",
        title=phrase(title, w=w, ends=ends.value),
        paper="DGL87",
        refuses=partial(_refuses, ends=ends),
        tellings={
            "edge points": partial(by_edge_points, w=w, ends=ends),
            "midpoints, then push": partial(by_pushing, w=w, ends=ends),
        },
        limit=partial(interpolated, lost=2 if ends is Ends.SHORTENED else 0),
    )


def by_edge_points(t: Connectivity, w: Fraction, ends: Ends) -> Step:
    """A point for every edge from four old ones; then they are connected."""
    polygon = as_polygon(t)
    n, between = polygon.n_vertices, _edges(polygon, ends)
    kept, m = _kept(polygon, ends), len(between)
    order = np.empty(len(kept) + m, dtype=np.intp)
    order[0::2], order[1::2] = kept, n + np.arange(m)
    roles = np.repeat([Role.ORIGINAL, Role.EDGE], [n, m])
    fine = Polyline(len(order), polygon.closed)
    return Step((
        Stage(
            "edge points", stack(identity(n), _edge_points(polygon, between, w)), polygon,
            np.r_[np.arange(n), np.full(m, -1)], roles,
        ),
        Stage("connect", Pick(order, n + m), fine, order, roles[order]),
    ))  # fmt: skip


def by_pushing(t: Connectivity, w: Fraction, ends: Ends) -> Step:
    """Topology: a midpoint on every edge.  Geometry: it is pushed away from the mean of the two points beyond."""
    polygon = as_polygon(t)
    n, m = polygon.n_vertices, polygon.n_edges
    k = np.arange(n + m)
    order = np.where(k % 2, n + k // 2, k // 2)
    left = k if ends is Ends.REFLECTED or polygon.closed else k[2:-2]
    roles = np.where(k % 2, Role.EDGE, Role.ORIGINAL)
    split = stack(identity(n), MeanOf(polygon.ends, n))[order]
    fine = Polyline(len(k), polygon.closed)
    born = np.where(k % 2, -1, k // 2)
    return Step((
        Stage("midpoints", split, fine, born, roles),
        Stage("push", _push(fine, w)[left], Polyline(len(left), polygon.closed), left, _pushed_roles(left)),
    ))  # fmt: skip


def _push(fine: Polyline, w: Fraction) -> Operator:
    """(2 n, 2 n): every second point away from the two that are three further on and three back."""
    n = fine.n_vertices
    k = np.arange(n)
    back, ahead = (k - 3, k + 3) if not fine.closed else ((k - 3) % n, (k + 3) % n)
    before = reflected(back, back >= 0, np.maximum(k - 1, 0), np.minimum(k + 1, n - 1), n)
    after = reflected(ahead, ahead < n, np.minimum(k + 1, n - 1), np.maximum(k - 1, 0), n)
    away = pushed(identity(n), Fraction(1, 2) * before + Fraction(1, 2) * after, w)
    odd = Weights((Fraction(0), Fraction(1)), k % 2)
    return odd * away + (1 - odd) * identity(n)


def _edge_points(polygon: Polyline, between: Indices, w: Fraction) -> Operator:
    n = polygon.n_vertices
    a, b = polygon.ends[between].T
    back, ahead = (a - 1) % n, (b + 1) % n
    before = reflected(back, polygon.closed | (a > 0), a, b, n)
    after = reflected(ahead, polygon.closed | (b < n - 1), b, a, n)
    return along(before, np.stack([a, b], axis=1), after, w)


def _edges(polygon: Polyline, ends: Ends) -> Indices:
    """Edges that get a point."""
    all_ = np.arange(polygon.n_edges)
    return all_ if polygon.closed or ends is Ends.REFLECTED else all_[1:-1]


def _kept(polygon: Polyline, ends: Ends) -> Indices:
    """Points that stay."""
    all_ = np.arange(polygon.n_vertices)
    return all_ if polygon.closed or ends is Ends.REFLECTED else all_[1:-1]


def _pushed_roles(left: Indices) -> Indices:
    return np.where(left % 2, Role.MOVED, Role.ORIGINAL)


def _refuses(t: Connectivity, ends: Ends) -> str:
    if not isinstance(t, Polyline):
        return "it is not a polygon"
    if ends is Ends.SHORTENED:
        return room(t, (5, 0))
    return "" if t.n_vertices > 1 else "a single point has no edge; it needs at least 2 points"

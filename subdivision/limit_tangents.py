"""Tangents in the limit, as scheme files tell them: left eigenvectors of the ring that shrinks slowest.

Neither the pull of a quad scheme nor a triangle scheme's beta enters them, but for the first one at a dart.
Along a boundary the first tangent is the curve's own; the second solves the same equations with
the two boundary edges held to the curve (ours; for two quads and three triangles it is [BLZ00]_).
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import TypeAlias

import numpy as np

from subdivision.arrays import Floats, Indices, Mask
from subdivision.exact import Exact, cosine, quotient, sine
from subdivision.fans import Corner, dart_ends, weighed
from subdivision.limit_rules import corners_of, quad_dart, triangle_dart
from subdivision.operators import Operator
from subdivision.sharpness import CORNER, CREASE, SMOOTH, vertex_rules
from subdivision.smoothness import are_quads_smooth, are_triangles_smooth, quad_lambda, triangle_lambda
from subdivision.topology import Topology
from subdivision.weights import by_count

AROUND, DART, ALONG, PINNED = 1, 2, 3, 4
"""Where there is one tangent plane: smooth vertices, darts, boundary curves, the pinned corner of a single face."""


Rows: TypeAlias = Callable[[int], list[Corner]]
"""Number of corners round a vertex -> what each of them weighs."""


@dataclass(frozen=True)
class Ring:
    """How the tangents of a kind of mesh weigh a wave (cosine or sine) that runs round a vertex.

    Attributes
    ----------
    edge : int
        A neighbour weighs ``edge * wave``.
    face : m -> Exact
        An opposite corner weighs ``face * (wave on one side + wave on the other)``; ``m`` edges make a full turn.
    shrinks : m -> Exact
        What the wave is multiplied by in a step.
    beside : Fraction
        What an edge point takes of the neighbours beside its edge.
    """

    edge: int
    face: Callable[[int], Exact]
    shrinks: Callable[[int], Exact]
    beside: Fraction


def quad_tangents(t: Topology, pull: Callable[[int], Exact | int]) -> tuple[Operator, Operator]:
    """Two directions that span the tangent plane of every vertex; zero where there is not one such plane (at tips)."""
    smooth = by_count(lambda n: int(are_quads_smooth(n, pull(n))), t.valence).values > 0
    return _tangents(t, QUADS, smooth, lambda n: quad_dart(n, float(pull(n)) / 4))


def triangle_tangents(t: Topology, beta: Callable[[int], Exact | int]) -> tuple[Operator, Operator]:
    """Likewise; there is none where ``beta`` makes a tip (centroid averaging at valence 3)."""
    smooth = by_count(lambda n: int(are_triangles_smooth(n, beta(n))), t.valence).values > 0
    return _tangents(t, TRIANGLES, smooth, lambda n: triangle_dart(n, float(beta(n))))


QUADS = Ring(4, lambda m: quotient(1, 4 * quad_lambda(m) - 1), quad_lambda, Fraction(1, 16))
TRIANGLES = Ring(1, lambda m: Fraction(0), triangle_lambda, Fraction(1, 8))


def _tangents(t: Topology, ring: Ring, smooth: Mask, dart: Callable[[int], Floats]) -> tuple[Operator, Operator]:
    kinds = _kinds(t, smooth)
    first: dict[int, Rows] = {AROUND: lambda n: _wave(ring, n, n, cosine), ALONG: _along, PINNED: _leg(1)}
    second: dict[int, Rows] = {AROUND: lambda n: _wave(ring, n, n, sine), ALONG: partial(_across, ring)}
    first[DART] = lambda n: _dart(dart(n), n)
    second[PINNED], second[DART] = _leg(3), second[AROUND]  # it vanishes on the sharp edge, which is then no exception
    return weighed(t, kinds, lambda k, n: first[k](n)), weighed(t, kinds, lambda k, n: second[k](n))


def _kinds(t: Topology, smooth: Mask) -> Indices:
    rule, corners = vertex_rules(t).now, np.bincount(t.origin, minlength=t.n_vertices)
    dart = np.zeros(t.n_vertices, dtype=bool)
    dart[t.origin[dart_ends(t)]] = True
    inner = ~t.on_boundary & (rule == SMOOTH) & smooth
    along, pinned = t.on_boundary & (rule == CREASE), t.on_boundary & (rule == CORNER) & (corners == 1)
    return np.select([inner & ~dart, inner, along, pinned], [AROUND, DART, ALONG, PINNED])


def _wave(ring: Ring, n: int, m: int, wave: Callable[[int, int], Exact]) -> list[Corner]:
    """A wave over ``n`` corners, ``m`` of which would make a full turn."""
    face = ring.face(m)
    return [(0, ring.edge * wave(m, i), face * (wave(m, i) + wave(m, i + 1)), 0) for i in range(n)]


def _dart(S: Floats, n: int) -> list[Corner]:
    """The slowest row that looks the same from both sides of the sharp edge."""
    mirrored = [0, *(1 + -np.arange(n) % n), *(n + 1 + (-1 - np.arange(len(S) - n - 1)) % n)]
    values, rows = np.linalg.eig((S + S[:, mirrored]).T / 2)
    slowest = rows[:, np.argsort(-np.abs(values))[1]].real
    return corners_of(slowest / slowest[1], n, f"second row of a dart of valence {n}")


def _along(n: int) -> list[Corner]:
    """The first boundary neighbour minus the last."""
    return [(0, int(i == 0), 0, -int(i == n - 1)) for i in range(n)]


def _leg(corner: int) -> Rows:
    """From a pinned vertex to its next (1) or previous (3) neighbour."""
    return lambda n: [(-1, int(corner == 1), 0, int(corner == 3))]


def _across(ring: Ring, n: int) -> list[Corner]:
    """Half a turn of sines over ``n`` faces; boundary neighbours and vertex weigh what makes it an eigenvector."""
    if n == 1:
        return [(-2, 1, 0, 1)]
    inside = _wave(ring, n, 2 * n, sine)
    total = sum((edge + opposite for _, edge, opposite, _ in inside[1:]), inside[0][2])
    handed = ring.beside * inside[1][1] + Fraction(int(ring.edge == 4), 4) * inside[0][2]
    end = quotient(handed - total * Fraction(1, 8), ring.shrinks(2 * n) - Fraction(1, 4))
    vertex = -2 * end - total
    return [
        (vertex if i == 0 else 0, end if i == 0 else edge, opposite, end if i == n - 1 else 0)
        for i, (_, edge, opposite, _) in enumerate(inside)
    ]

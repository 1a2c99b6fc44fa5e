"""Lane-Riesenfeld curves: masks, sizes, pieces, stencils, convergence; beside polynomials in fractions."""

from fractions import Fraction
from itertools import pairwise
from math import comb

import numpy as np
import pytest
from scipy.interpolate import BSpline

from subdivision import Mesh, Polyline, TopologyError, subdivide
from subdivision.arrays import Floats
from subdivision.limit import limit_points, limit_stencil
from subdivision.schemes import lane_riesenfeld

degrees = pytest.mark.parametrize("degree", range(1, 8))


def control(n: int, seed: int = 0) -> Floats:
    return np.random.default_rng(seed).normal(size=(n, 3))


def split_and_average(rows: list[dict[int, Fraction]], degree: int) -> list[dict[int, Fraction]]:
    rows = [row for row in rows for _ in range(2)]
    for _ in range(degree):
        rows = [{k: (a.get(k, 0) + b.get(k, 0)) / Fraction(2) for k in a | b} for a, b in pairwise(rows)]
    return rows


@degrees
def test_rows_are_those_of_splitting_and_averaging_fractions(degree: int) -> None:
    step = lane_riesenfeld(degree).step(Polyline(10))
    expected = split_and_average([{k: Fraction(1)} for k in range(10)], degree)
    assert [dict(step.stencil(k).terms) for k in range(step.topology.n_vertices)] == expected


@degrees
def test_rows_are_alternate_entries_of_the_binomials_over_2_to_the_n(degree: int) -> None:
    binomials = [Fraction(comb(degree + 1, k), 2**degree) for k in range(degree + 2)]
    step = lane_riesenfeld(degree).step(Polyline(12))
    for k in range(step.topology.n_vertices):
        row = [weight for _, weight in sorted(step.stencil(k).terms)]
        assert row in (binomials[::2], binomials[1::2], binomials[::-1][::2], binomials[::-1][1::2])
        assert sum(row) == 1


@degrees
def test_an_open_polygon_of_N_points_becomes_2N_minus_degree_and_its_pieces_double(degree: int) -> None:
    t = Polyline(degree + 3)
    for _ in range(4):
        finer = lane_riesenfeld(degree).step(t).topology
        assert finer.n_vertices == 2 * t.n_vertices - degree
        assert finer.n_vertices - degree == 2 * (t.n_vertices - degree)
        t = finer


@degrees
def test_a_closed_polygon_doubles_and_agrees_with_a_long_open_one(degree: int) -> None:
    points = control(7)
    closed = lane_riesenfeld(degree).step(Polyline(7, closed=True)).apply(points)
    opened = lane_riesenfeld(degree).step(Polyline(21)).apply(np.tile(points, (3, 1)))
    assert len(closed) == 14
    assert np.abs(closed - opened[: len(closed)]).max() < 1e-12


def test_cubic_rows_are_the_edge_and_vertex_stencils_in_turns() -> None:
    step = lane_riesenfeld(3).step(Polyline(6))
    edge, vertex = [Fraction(1, 2)] * 2, [Fraction(1, 8), Fraction(6, 8), Fraction(1, 8)]
    for k in range(step.topology.n_vertices):
        terms = sorted(step.stencil(k).terms)
        assert [w for _, w in terms] == (vertex if k % 2 else edge)
        assert [p for p, _ in terms] == list(range(k // 2, k // 2 + 2 + k % 2))


def test_cubic_is_linear_then_a_quarter_a_half_a_quarter() -> None:
    points = control(9)
    linear = lane_riesenfeld(1).step(Polyline(9)).apply(points)
    midpoints_of_midpoints = (linear[:-2] + 2 * linear[1:-1] + linear[2:]) / 4
    assert np.abs(lane_riesenfeld(3).step(Polyline(9)).apply(points) - midpoints_of_midpoints).max() < 1e-12


def test_linear_keeps_the_points_and_inserts_midpoints() -> None:
    points = control(5)
    linear = lane_riesenfeld(1).step(Polyline(5)).apply(points)
    assert np.array_equal(linear[::2], points)
    assert np.array_equal(linear[1::2], (points[1:] + points[:-1]) / 2)


def test_cubic_polygons_approach_the_b_spline_four_times_closer_each_level() -> None:
    mesh = Mesh(Polyline(7), control(7))
    curve = BSpline(np.arange(-3.0, 8.0), mesh.points, 3)  # the piece from point 1 to point 2 begins at 0
    errors = []
    for level in range(1, 7):
        points = subdivide(mesh, lane_riesenfeld(3), level).points
        at = (np.arange(len(points)) - 1) / 2**level
        inside = (at >= 0) & (at <= 4)
        errors.append(np.abs(points[inside] - curve(at[inside])).max())
    assert errors[-2] / errors[-1] == pytest.approx(4, abs=0.05)


@degrees
def test_limits_are_values_of_the_b_spline(degree: int) -> None:
    n = 12
    points = control(n)
    knots = np.arange(n + degree + 1) - degree
    reach = degree // 2
    at = np.arange(reach, n - reach) + (1 - degree) / 2
    expected = BSpline(knots.astype(float), points, degree)(at)
    limits = limit_points(Mesh(Polyline(n), points), lane_riesenfeld(degree))
    assert np.abs(limits - expected).max() < 1e-12


@degrees
@pytest.mark.parametrize("closed", [False, True])
def test_limits_are_the_same_from_every_level_they_survive_to(degree: int, closed: bool) -> None:
    mesh = Mesh(Polyline(11, closed), control(11))
    coarse = limit_points(mesh, lane_riesenfeld(degree))
    fine = limit_points(subdivide(mesh, lane_riesenfeld(degree), 1), lane_riesenfeld(degree))
    gaps = np.linalg.norm(coarse[:, None] - fine[None], axis=2).min(axis=1)
    if degree % 2:  # points of even degree end between those of the next level
        assert gaps.max() < 1e-12


def test_a_cubic_point_tends_to_a_sixth_four_sixths_a_sixth() -> None:
    stencil = limit_stencil(lane_riesenfeld(3), Polyline(6), 2)
    assert dict(stencil.terms) == {1: Fraction(1, 6), 2: Fraction(4, 6), 3: Fraction(1, 6)}
    with pytest.raises(TopologyError, match="point 0 has no limit of its own"):
        limit_stencil(lane_riesenfeld(3), Polyline(6), 0)


def test_degree_and_size_are_refused_with_a_sentence() -> None:
    with pytest.raises(TopologyError, match="choose degree 1 or more"):
        lane_riesenfeld(0)
    with pytest.raises(TopologyError, match="it needs at least 4 points"):
        lane_riesenfeld(3).step(Polyline(3))

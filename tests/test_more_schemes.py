"""Schemes beyond the lecture: every one beside a known mask, a tensor product, or loops written without the engine."""

from fractions import Fraction

import numpy as np
import pytest

from subdivision import Mesh, Polyline, Scheme, TopologyError, shapes, subdivide
from subdivision.arrays import Floats
from subdivision.limit import limit_points
from subdivision.rows import Connectivity
from subdivision.schemes import lane_riesenfeld
from subdivision.schemes.chaikin import CHAIKIN
from subdivision.schemes.four_point import Ends, four_point

POLYGONS = [Polyline(7), Polyline(6, closed=True), Polyline(3, closed=True), Polyline(11)]
REFLECTED = four_point(ends=Ends.REFLECTED)
CURVES = [CHAIKIN, four_point(), REFLECTED, four_point(Fraction(1, 10)), four_point(0.1, Ends.REFLECTED)]
curves = pytest.mark.parametrize("scheme", CURVES, ids=lambda s: s.name)
polygons = pytest.mark.parametrize("polygon", POLYGONS, ids=str)


def positions(n: int) -> Floats:
    return np.random.default_rng(n).normal(size=(n, 3))


def dense(scheme: Scheme, t: Connectivity, telling: str | None = None) -> Floats:
    return scheme.step(t, telling).matrix.toarray()


def assert_all_readings_agree(scheme: Scheme, t: Connectivity) -> None:
    """Rows sum to one; tellings multiply to one matrix; applied, assembled and exact readings are the same."""
    first = dense(scheme, t)
    points = positions(t.n_vertices)
    for telling in scheme.tellings:
        step = scheme.step(t, telling)
        matrix = step.matrix.toarray()
        assert matrix.shape == first.shape == (step.topology.n_vertices, t.n_vertices)
        assert np.abs(matrix - first).max() < 1e-12
        assert np.abs(matrix.sum(axis=1) - 1).max() < 1e-12
        assert np.abs(step.apply(points) - matrix @ points).max() < 1e-12
        for stage in step.stages:
            assert len(stage.carries) == len(stage.roles) == stage.n_points >= stage.topology.n_vertices
            kept = stage.carries[stage.carries >= 0]
            assert kept.max(initial=0) < stage.operator.shape[1]
        for point in range(0, len(matrix), 7):
            stencil = step.stencil(point)
            row = np.zeros(t.n_vertices)
            row[stencil.parents] = stencil.weights
            assert np.abs(row - matrix[point]).max() < 1e-12


@curves
@polygons
def test_every_telling_of_a_curve_is_the_same_matrix(scheme: Scheme, polygon: Polyline) -> None:
    assert_all_readings_agree(scheme, polygon)


@polygons
def test_cutting_corners_at_the_quarters_is_averaging_twice(polygon: Polyline) -> None:
    assert np.abs(dense(CHAIKIN, polygon) - dense(lane_riesenfeld(2), polygon)).max() < 1e-15
    assert CHAIKIN.step(polygon).topology == lane_riesenfeld(2).step(polygon).topology


@curves
@polygons
def test_a_polygon_read_backwards_makes_the_same_curve_backwards(scheme: Scheme, polygon: Polyline) -> None:
    there, back = dense(scheme, polygon), dense(scheme, polygon)[::-1, ::-1]
    if polygon.closed:  # the last edge comes first then; turn it back
        turns = (np.abs(there - np.roll(back, k, axis=0)).max() for k in range(len(there)))
        assert min(turns) < 1e-12
    else:
        assert np.abs(there - back).max() < 1e-12


@polygons
@pytest.mark.parametrize("w", [Fraction(1, 16), Fraction(1, 10), Fraction(0)])
def test_the_four_point_scheme_is_its_loop_over_edges(polygon: Polyline, w: Fraction) -> None:
    n = polygon.n_vertices
    P = np.eye(n)
    if polygon.closed:
        rows = [row for i in range(n) for row in (P[i], rule(*(P[(i + k) % n] for k in (-1, 0, 1, 2)), w=float(w)))]
    else:
        rows = [row for i in range(1, n - 2) for row in (P[i], rule(*P[i - 1 : i + 3], w=float(w)))] + [P[n - 2]]
        Q = np.concatenate([[2 * P[0] - P[1]], P, [2 * P[-1] - P[-2]]])
        both = [row for i in range(n - 1) for row in (P[i], rule(*Q[i : i + 4], w=float(w)))] + [P[-1]]
        assert np.abs(dense(four_point(w, Ends.REFLECTED), polygon) - np.array(both)).max() < 1e-12
    assert np.abs(dense(four_point(w), polygon) - np.array(rows)).max() < 1e-12


def rule(a: Floats, b: Floats, c: Floats, d: Floats, w: float) -> Floats:
    return (1 / 2 + w) * (b + c) - w * (a + d)


def test_at_a_sixteenth_points_of_a_cubic_stay_on_it_and_otherwise_of_a_line_only() -> None:
    x = np.arange(9.0)
    finer = np.arange(1, 7.25, 0.5)
    for degree in range(6):
        off = np.abs(dense(four_point(), Polyline(9)) @ x**degree - finer**degree).max()
        assert (off < 1e-10) == (degree <= 3)
        off = np.abs(dense(four_point(Fraction(1, 10)), Polyline(9)) @ x**degree - finer**degree).max()
        assert (off < 1e-10) == (degree <= 1)


def test_the_four_point_curve_goes_through_its_points_and_from_end_to_end_if_reflected() -> None:
    mesh = Mesh(Polyline(8), positions(8))
    fine = subdivide(mesh, REFLECTED, 4)
    assert np.abs(fine.points[::16] - mesh.points).max() < 1e-15
    assert np.abs(limit_points(fine, REFLECTED) - fine.points).max() == 0
    fine = subdivide(mesh, four_point(), 4)
    assert len(fine.points) == 2**4 * (8 - 5) + 5
    assert np.abs(limit_points(mesh, four_point()) - mesh.points[2:-2]).max() == 0


def test_four_points_are_too_few_to_grow_and_a_mesh_is_no_polygon() -> None:
    with pytest.raises(TopologyError, match="at least 6 points"):
        four_point().step(Polyline(5))
    with pytest.raises(TopologyError, match="at least 2 points"):
        REFLECTED.step(Polyline(1))
    for scheme in CURVES:
        with pytest.raises(TopologyError, match="not a polygon"):
            scheme.step(shapes.cube().topology)

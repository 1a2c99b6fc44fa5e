"""Where meshes end: the lowest-dimensional cells, their curves, and nets beside the meshes made of them."""

from collections.abc import Callable, Hashable
from fractions import Fraction
from typing import Any

import naive
import numpy as np
import pytest
from test_limits import halved, notched

from subdivision import Boundary, Grid, Mesh, Polyline, Scheme, Topology, TopologyError, shapes, subdivide
from subdivision.arrays import Floats
from subdivision.schemes import (
    CATMULL_CLARK,
    LECTURE,
    LOOP,
    LOOP_WARREN,
    QUAD_CENTROID,
    THREE_DIRECTION_QUARTIC,
    TRIANGLE_CENTROID,
    box_spline,
    lane_riesenfeld,
    tensor_product,
)

CENTROIDS = pytest.mark.parametrize("scheme", [QUAD_CENTROID, TRIANGLE_CENTROID], ids=lambda s: s.name)
schemes = pytest.mark.parametrize("scheme", LECTURE, ids=lambda s: s.name)


def faces_for(scheme: Scheme) -> list[list[int]]:
    return notched() if scheme in (QUAD_CENTROID, CATMULL_CLARK) else halved(notched())


def sheet(scheme: Scheme) -> Topology:
    return Topology.from_faces(faces_for(scheme), 30)


def rows(scheme: Scheme, t: Topology, telling: str | None = None) -> naive.Points:
    return naive.named(t, scheme.step(t, telling).matrix.toarray())


def corners(faces: list[list[int]]) -> list[int]:
    flat = [v for loop in faces for v in loop]
    return [v for v in set(flat) if flat.count(v) == 1]


@CENTROIDS
@pytest.mark.parametrize("rule", [Boundary.EDGE, Boundary.EDGE_AND_CORNER, Boundary.HIDE])
def test_boundary_points_average_the_cells_of_lowest_dimension(scheme: Scheme, rule: Boundary) -> None:
    faces, t = faces_for(scheme), sheet(scheme).with_boundary(rule)
    X, cells = naive.split(np.eye(30), faces)
    pins = corners(faces) if rule is Boundary.EDGE_AND_CORNER else []
    expected = naive.averaged(X, cells, naive.halves(naive.boundary_edges(faces)), pins)
    assert naive.difference(rows(scheme, t), expected) < 1e-12


@schemes
def test_boundary_rows_are_the_cubic_curve_and_read_only_the_boundary(scheme: Scheme) -> None:
    faces, t = faces_for(scheme), sheet(scheme)
    rim = naive.boundary_edges(faces)
    step = scheme.step(t)
    numbers = {name: k for k, name in enumerate(naive.named(t, np.zeros((step.topology.n_vertices, 1))))}
    for edge in rim:
        assert dict(step.stencil(numbers[edge]).terms) == dict.fromkeys(edge, Fraction(1, 2))
    for v in {v for edge in rim for v in edge}:
        beside = [next(iter(edge - {v})) for edge in rim if v in edge]
        assert dict(step.stencil(v).terms) == {v: Fraction(6, 8)} | dict.fromkeys(beside, Fraction(1, 8))


@schemes
def test_the_boundary_of_a_sheet_is_the_closed_cubic_polygon(scheme: Scheme) -> None:
    make = shapes.quad_sheet if scheme in (QUAD_CENTROID, CATMULL_CLARK) else shapes.triangle_sheet
    mesh = make()
    ring = outline(mesh.topology)
    curve = Mesh(Polyline(len(ring), closed=True), mesh.points[ring])
    for level in (1, 2, 3):
        finer, curved = subdivide(mesh, scheme, level), subdivide(curve, lane_riesenfeld(3), level)
        ours = finer.points[np.flatnonzero(finer.topology.on_boundary)]
        gaps = np.linalg.norm(ours[:, None] - curved.points[None], axis=2)
        assert len(ours) == len(curved.points)
        assert gaps.min(axis=0).max() < 1e-12
        assert gaps.min(axis=1).max() < 1e-12


def outline(t: Topology) -> list[int]:
    after = {a: b for loop in t.loops() for a, b in zip(loop, [*loop[1:], loop[0]], strict=True)
             if frozenset((a, b)) in set(naive.boundary_edges(t.loops()))}  # fmt: skip
    ring = [min(after)]
    while after[ring[-1]] != ring[0]:
        ring.append(after[ring[-1]])
    return ring


@schemes
def test_edge_and_corner_pins_the_corners_and_changes_nothing_else(scheme: Scheme) -> None:
    t, faces = sheet(scheme), faces_for(scheme)
    edge, both = rows(scheme, t), rows(scheme, t.with_boundary(Boundary.EDGE_AND_CORNER))
    for name, row in both.items():
        if name in corners(faces):
            assert row == pytest.approx(np.eye(30)[name], abs=1e-15)
        else:
            assert np.array_equal(row, edge[name])


def flat(make: Callable[[], Mesh], rule: Boundary) -> Mesh:
    t = make().topology.with_boundary(rule)
    return Mesh(t, [(i, j, 0) for i in range(5) for j in range(5)])  # type: ignore[arg-type]


def width(mesh: Mesh) -> float:
    return float(np.ptp(mesh.points[:, 0]))


def test_the_literal_rule_shrinks_a_flat_sheet_as_stated() -> None:
    mesh, widths = flat(shapes.quad_sheet, Boundary.LITERAL), []
    for _ in range(12):
        mesh = subdivide(mesh, QUAD_CENTROID, 1) if mesh.topology.n_faces < 20_000 else mesh
        widths.append(width(mesh))
    assert widths[:3] == pytest.approx([3.5, 3.375, 3.34375], abs=1e-12)
    assert all(w > 10 / 3 for w in widths)
    assert widths[5] == pytest.approx(10 / 3, abs=1e-3)


def test_edge_and_corner_keeps_the_width_and_edge_only_rounds_the_corners_alone() -> None:
    for scheme, make in ((QUAD_CENTROID, shapes.quad_sheet), (LOOP, shapes.triangle_sheet)):
        kept = subdivide(flat(make, Boundary.EDGE_AND_CORNER), scheme, 3)
        assert width(kept) == pytest.approx(4, abs=1e-12)
        rounded = subdivide(flat(make, Boundary.EDGE), scheme, 3)
        assert width(rounded) == pytest.approx(4, abs=1e-12)
        assert not (np.abs(rounded.points[:, :2] - 2) > 1.9).all(axis=1).any()


@CENTROIDS
def test_the_literal_rule_averages_the_faces_that_exist(scheme: Scheme) -> None:
    t = sheet(scheme).with_boundary(Boundary.LITERAL)
    expected = naive.averaged(*naive.split(np.eye(30), faces_for(scheme)))
    assert naive.difference(rows(scheme, t), expected | {}) < 1e-12
    with pytest.raises(TopologyError, match="centroid averaging only"):
        scheme.step(t, "stencils")


def test_the_literal_rule_weighs_a_boundary_vertex_9_3_3_and_1_as_stated() -> None:
    t = shapes.quad_sheet().topology.with_boundary(Boundary.LITERAL)
    weights = sorted(QUAD_CENTROID.step(t).stencil(2).terms, key=lambda term: -float(term[1]))
    assert [str(w) for _, w in weights] == ["9/16", "3/16", "3/32", "3/32", "1/32", "1/32"]


def test_hidden_faces_are_those_that_touch_the_boundary_and_so_are_their_children() -> None:
    t = shapes.quad_sheet(4).topology.with_boundary(Boundary.HIDE)
    rim = {v for edge in naive.boundary_edges(t.loops()) for v in edge}
    assert t.hidden.tolist() == [bool(rim & set(loop)) for loop in t.loops()]
    fine = CATMULL_CLARK.step(t).topology
    assert fine.hidden.sum() == 4 * t.hidden.sum()
    assert abs(CATMULL_CLARK.step(t).matrix - CATMULL_CLARK.step(t.with_boundary(Boundary.EDGE)).matrix).max() == 0


NETS: list[Any] = [(QUAD_CENTROID, tensor_product(3, 3), False), (CATMULL_CLARK, tensor_product(3, 3), False)]
NETS += [(s, box_spline(THREE_DIRECTION_QUARTIC), True) for s in (TRIANGLE_CENTROID, LOOP, LOOP_WARREN)]
nets = pytest.mark.parametrize(("on_mesh", "on_net", "diagonal"), NETS, ids=[s.name for s, *_ in NETS])


def same_points(a: Floats, b: Floats) -> bool:
    gaps = np.linalg.norm(a[:, None] - b[None], axis=2)
    return len(a) == len(b) and gaps.min(axis=0).max() < 1e-12 and gaps.min(axis=1).max() < 1e-12


@nets
def test_the_net_is_the_inside_of_the_mesh(on_mesh: Scheme, on_net: Scheme, diagonal: bool) -> None:
    net = Grid(5, 6, diagonal=diagonal)
    step = on_mesh.step(net.mesh())
    inside = ~step.topology.on_boundary
    assert inside.sum() == (2 * 5 - 3) * (2 * 6 - 3)
    assert same_points(step.matrix.toarray()[inside], on_net.step(net).matrix.toarray())


@nets
def test_wrapped_nets_are_torus_meshes(on_mesh: Scheme, on_net: Scheme, diagonal: bool) -> None:
    net = Grid(5, 4, wrap_s=True, wrap_t=True, diagonal=diagonal)
    points = np.random.default_rng(5).normal(size=(20, 3))
    ours = subdivide(Mesh(net.mesh(), points), on_mesh, 2)
    assert ours.topology.euler == 0
    assert same_points(ours.points, subdivide(Mesh(net, points), on_net, 2).points)


def test_half_wrapped_nets_are_the_inside_of_cylinders() -> None:
    net = Grid(6, 5, wrap_s=True)
    step = CATMULL_CLARK.step(net.mesh())
    inside = ~step.topology.on_boundary
    assert same_points(step.matrix.toarray()[inside], tensor_product(3, 3).step(net).matrix.toarray())


def test_phantom_rows_make_the_bicubic_net_edge_and_corner_level_after_level() -> None:
    A = np.random.default_rng(6).normal(size=(5, 6, 3))
    mesh = Mesh(Grid(5, 6).mesh().with_boundary(Boundary.EDGE_AND_CORNER), A.reshape(-1, 3))
    for _ in range(3):
        mesh = subdivide(mesh, QUAD_CENTROID, 1)
        A = extended(extended(A).swapaxes(0, 1)).swapaxes(0, 1)
        step = tensor_product(3, 3).step(Grid(*A.shape[:2]))
        A = step.apply(A.reshape(-1, 3)).reshape(*step.topology.shape, 3)[1:-1, 1:-1]
        assert same_points(mesh.points, A.reshape(-1, 3))


def extended(A: Floats) -> Floats:
    """A row before the first and one behind the last, by P(-1) = 2 P(0) - P(1)."""
    return np.concatenate([2 * A[:1] - A[1:2], A, 2 * A[-1:] - A[-2:-1]])


def test_phantom_parallelograms_make_the_quartic_net_edge_only_but_for_the_corners() -> None:
    A = np.random.default_rng(7).normal(size=(5, 6, 3))
    B = np.full((7, 8, 3), np.nan)
    B[1:-1, 1:-1] = A
    B[1:-2, 0] = A[:-1, 0] + A[1:, 0] - A[1:, 1]
    B[2:-1, -1] = A[:-1, -1] + A[1:, -1] - A[:-1, -2]
    B[0, 1:-2] = A[0, :-1] + A[0, 1:] - A[1, 1:]
    B[-1, 2:-1] = A[-1, :-1] + A[-1, 1:] - A[-2, :-1]
    step = box_spline(THREE_DIRECTION_QUARTIC).step(Grid(7, 8))
    Q = step.apply(B.reshape(-1, 3)).reshape(*step.topology.shape, 3)[1:-1, 1:-1].reshape(-1, 3)
    known = Q[~np.isnan(Q).any(axis=1)]
    ours = subdivide(Mesh(Grid(5, 6, diagonal=True).mesh(), A.reshape(-1, 3)), TRIANGLE_CENTROID, 1).points
    assert len(known) >= len(ours) - 8
    assert np.linalg.norm(known[:, None] - ours[None], axis=2).min(axis=1).max() < 1e-12


def test_new_boundary_points_have_no_part_in_names() -> None:
    """The oracle names every point once, so that comparing by name compares all points."""
    names: set[Hashable] = set(rows(QUAD_CENTROID, sheet(QUAD_CENTROID)))
    assert len(names) == QUAD_CENTROID.step(sheet(QUAD_CENTROID)).topology.n_vertices

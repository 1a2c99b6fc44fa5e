"""Grids are what the stages of interpolating quads make, point by point and face by face, at any depth."""

import sys
from fractions import Fraction

import numpy as np
import pytest

from subdivision import Mesh, Polyline, Scheme, Topology, plan, shapes, subdivide
from subdivision.plans.grid_steps import curve
from subdivision.plans.grids import Grids, small_quads
from subdivision.schemes import CATMULL_CLARK, KOBBELT
from subdivision.schemes.four_point import four_point
from subdivision.schemes.kobbelt import kobbelt
from subdivision.stage import Step
from tests.test_tables import QUADS, assert_same, staged

PLANS = sys.modules["subdivision.plans.plan"]


@pytest.fixture
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """Grids however small the mesh is."""
    for name in ("WORTH_TABLES", "SMALL"):
        monkeypatch.setattr(PLANS, name, 0)


def closed() -> dict[str, Mesh]:
    """Valences from 2 to 9, extraordinary vertices beside each other, all of it numbered by chance, too."""
    draw = np.random.default_rng(1)
    found = {name: shapes.SHAPES[name]() for name in QUADS}
    found = {name: mesh for name, mesh in found.items() if not mesh.surface.boundary.any()}
    found["spindle"] = shapes.quad_bipyramid(9)
    found["two faces"] = Mesh(Topology.from_faces([[0, 1, 2, 3], [3, 2, 1, 0]]), draw.normal(size=(4, 3)))
    found["quads of a bipyramid"] = subdivide(shapes.bipyramid(5), CATMULL_CLARK, 1)
    for name in list(found):
        t, n = found[name].surface, found[name].surface.n_vertices
        number = draw.permutation(n + 2)
        faces = [np.roll(number[face], draw.integers(4)).tolist() for face in t.loops()]
        points = np.zeros((n + 2, 3))
        points[number[:n]] = found[name].points
        mixed = [faces[f] for f in draw.permutation(len(faces))]
        found[f"{name}, numbered by chance"] = Mesh(Topology.from_faces(mixed, n + 2), points)
    return found


@pytest.mark.usefixtures("eager")
@pytest.mark.parametrize("scheme", [KOBBELT, kobbelt(Fraction(1, 20))], ids=lambda s: s.name)
def test_grids_are_what_the_stages_make(scheme: Scheme) -> None:
    for name, mesh in closed().items():
        for levels in range(1, 5 if mesh.surface.n_faces < 20 else 4):
            made = plan(mesh.topology, scheme, levels)
            assert isinstance(made.steps[0], Grids)
            assert len(made.steps[0].steps) == levels
            assert_same(made, made.apply(mesh.points), staged(mesh, scheme, levels), f"{name}, {levels} levels")
            fine = subdivide(mesh, scheme, levels).points  # without the matrix, which is for many uses
            assert np.abs(fine - made.apply(mesh.points)).max() < 1e-12
            if levels == 1:
                assert np.array_equal(made.numbers, np.arange(len(made.numbers)))


def test_a_deep_mesh_is_made_of_grids_by_itself_and_control_points_stay() -> None:
    mesh, levels = shapes.mug(), 5
    made, fine = plan(mesh.topology, KOBBELT, levels), subdivide(mesh, KOBBELT, levels)
    assert isinstance(made.steps[0], Grids)
    assert_same(made, fine.points, staged(mesh, KOBBELT, levels), "mug")
    assert np.array_equal(fine.points[: len(mesh.points)], mesh.points)
    moved = Mesh(mesh.topology, np.random.default_rng(2).normal(size=mesh.points.shape))
    out = np.empty_like(fine.points)
    expected = staged(moved, KOBBELT, levels).points
    assert made.apply(moved.points, out) is out
    for d, points in ((3, out), (2, made.apply(moved.points[:, :2])), (1, made.apply(moved.points[:, :1]))):
        assert np.abs(points[made.numbers] - expected[:, :d]).max() < 1e-12


@pytest.mark.usefixtures("eager")
def test_an_open_mesh_and_a_very_large_fan_are_told_in_stages() -> None:
    for mesh in (shapes.quad_sheet(), shapes.quad_bipyramid(70)):
        laid_out = PLANS.once(mesh.topology, KOBBELT, 2)
        assert all(isinstance(step, Step) for step in laid_out.steps)
        assert_same(laid_out, laid_out.apply(mesh.points), staged(mesh, KOBBELT, 2), "in stages")


@pytest.mark.parametrize("w", [Fraction(1, 16), Fraction(1, 20)])
def test_a_row_of_a_grid_is_the_four_point_curve(w: Fraction) -> None:
    t = Polyline(9, closed=True)
    whole = four_point(w).step(t).matrix.toarray()
    assert np.abs(curve(4, w) - whole[3:10:2, :7]).max() < 1e-15


@pytest.mark.parametrize("depth", [1, 3])
def test_small_quads_fill_the_grid(depth: int) -> None:
    quads, n = small_quads(depth), 1 << depth
    i, j = np.divmod(quads, n + 1)
    area = (i * np.roll(j, -1, axis=1) - j * np.roll(i, -1, axis=1)).sum(axis=1) / 2
    assert np.array_equal(area, np.ones(4**depth))
    assert len(np.unique(quads.min(axis=1))) == 4**depth

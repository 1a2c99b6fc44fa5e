"""The butterfly on whole arrays and by tables makes what the stages make, for every valence."""

import sys

import numpy as np
import pytest

from subdivision import Boundary, Mesh, Topology, plan, shapes, subdivide
from subdivision.plans.butterfly_later import ButterflyLater
from subdivision.plans.butterfly_steps import ButterflyStep
from subdivision.plans.butterfly_tables import DEPTHS
from subdivision.plans.kernels import Rows
from subdivision.plans.poles import VALENCES
from subdivision.plans.tables import Tables
from subdivision.schemes import MODIFIED_BUTTERFLY
from tests.test_middle_tables import closed
from tests.test_tables import assert_same, staged

PLANS = sys.modules["subdivision.plans.plan"]


@pytest.fixture
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """Tables however small the mesh is."""
    for name, value in (("WORTH_TABLES", 0), ("SMALL", 0), ("FACES_A_KIND", 0.01), ("FINE_FACES_A_KIND", 0.01)):
        monkeypatch.setattr(PLANS, name, value)


def test_steps_make_the_points_of_the_stages() -> None:
    for name, mesh in closed().items():
        made = PLANS.once(mesh.topology, MODIFIED_BUTTERFLY, 3)
        assert [type(step) for step in made.steps] == [ButterflyStep, ButterflyLater, ButterflyLater]
        expected = staged(mesh, MODIFIED_BUTTERFLY, 3)
        assert_same(made, made.apply(mesh.points), expected, name)
        assert np.array_equal(made.numbers, np.arange(len(made.numbers)))
        kept = plan(mesh.topology, MODIFIED_BUTTERFLY, 3)
        assert_same(kept, kept.apply(mesh.points), expected, f"{name}, kept")


@pytest.mark.usefixtures("eager")
def test_tables_make_the_points_of_the_stages() -> None:
    for name, mesh in closed().items():
        for levels in (4, 5) if mesh.surface.n_faces < 20 else (4,):
            made = plan(mesh.topology, MODIFIED_BUTTERFLY, levels)
            assert isinstance(made.steps[-1], Tables)
            assert made.steps[-1].depth == levels - 1
            assert_same(made, made.apply(mesh.points), staged(mesh, MODIFIED_BUTTERFLY, levels), f"{name}, {levels}")


@pytest.mark.usefixtures("eager")
def test_tables_after_several_steps_are_those_of_the_stages() -> None:
    mesh = shapes.bipyramid(5)
    levels = max(DEPTHS) + 2
    made = plan(mesh.topology, MODIFIED_BUTTERFLY, levels)
    assert [type(step) for step in made.steps] == [Rows] * 3 + [Tables]
    assert_same(made, made.apply(mesh.points), staged(mesh, MODIFIED_BUTTERFLY, levels), "deep")


@pytest.mark.usefixtures("eager")
def test_points_move_in_any_number_of_dimensions() -> None:
    t, draw = shapes.bipyramid(7).surface, np.random.default_rng(2)
    made = plan(t, MODIFIED_BUTTERFLY, 4)
    steps = PLANS.once(t, MODIFIED_BUTTERFLY, 2)
    for d in (1, 2, 4):
        points = draw.normal(size=(9, d))
        out = np.empty((made.topology.n_vertices, d))
        assert made.apply(points, out) is out
        for each in (made, steps):
            alone = [each.apply(column[:, None]) for column in points.T]
            assert np.abs(each.apply(points) - np.concatenate(alone, axis=1)).max() < 1e-13
    assert np.array_equal(out[:9], points)


def test_large_meshes_have_tables_without_being_asked() -> None:
    mesh = shapes.icosahedron()
    fine, made = subdivide(mesh, MODIFIED_BUTTERFLY, 6), plan(mesh.topology, MODIFIED_BUTTERFLY, 6)
    assert isinstance(made.steps[-1], Tables)
    assert_same(made, fine.points, staged(mesh, MODIFIED_BUTTERFLY, 6), "icosahedron")


@pytest.mark.usefixtures("eager")
def test_a_pole_of_too_many_triangles_is_made_step_by_step() -> None:
    mesh = shapes.bipyramid(VALENCES.stop)
    made = plan(mesh.topology, MODIFIED_BUTTERFLY, 4)
    assert all(isinstance(step, Rows) for step in made.steps)
    assert_same(made, made.apply(mesh.points), staged(mesh, MODIFIED_BUTTERFLY, 4), "pole")


@pytest.mark.usefixtures("eager")
def test_open_meshes_are_made_step_by_step() -> None:
    for name, mesh in opened().items():
        for rule in (Boundary.EDGE, Boundary.EDGE_AND_CORNER, Boundary.HIDE):
            control = Mesh(mesh.surface.with_boundary(rule), mesh.points)
            expected = staged(control, MODIFIED_BUTTERFLY, 4)
            once, kept = (lay(control.topology, MODIFIED_BUTTERFLY, 4) for lay in (PLANS.once, plan))
            assert [type(step) for step in once.steps] == [ButterflyStep] + [ButterflyLater] * 3
            for made in (once, kept):
                assert_same(made, made.apply(control.points), expected, f"{name}, {rule.value}")


def opened() -> dict[str, Mesh]:
    """Sheets, fans and closed meshes without a vertex, down to one triangle, in any order; and sharp corners."""
    found = {name: shapes.SHAPES[name]() for name in ("triangle-sheet", "triangle-fan")}
    assert all(mesh.surface.boundary.any() for mesh in found.values())
    draw = np.random.default_rng(4)
    for name, mesh in closed().items():
        faces, gone = mesh.surface.loops(), draw.choice(mesh.surface.origin)
        kept = [faces[f] for f in draw.permutation(len(faces)) if gone not in faces[f]]
        found[f"{name}, open"] = Mesh(Topology.from_faces(kept, len(mesh.points)), mesh.points)
    corners = {int(v): 10.0 for v in np.flatnonzero(found["ball, open"].surface.on_boundary)[:2]}
    pinned = Topology.from_faces(found["ball, open"].surface.loops(), 30, corners=corners)
    return found | {"ball, pinned": Mesh(pinned, found["ball, open"].points)}

"""Blocks of triangles are what the stages of the square root of three make, point by point and face by face."""

import sys

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from subdivision import Mesh, Topology, plan, shapes, subdivide
from subdivision.arrays import Floats
from subdivision.plans.kernels import Rows
from subdivision.plans.middle_steps import MiddleStep
from subdivision.plans.middle_tables import DEPTHS, MiddleTables
from subdivision.plans.poles import VALENCES
from subdivision.schemes import SQRT3
from tests.test_tables import TRIANGLES, assert_same, staged

PLANS = sys.modules["subdivision.plans.plan"]


@pytest.fixture
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks however small the mesh is."""
    for name, value in (("WORTH_TABLES", 0), ("SMALL", 0), ("FINE_FACES_A_KIND", 0.01)):
        monkeypatch.setattr(PLANS, name, value)


def closed() -> dict[str, Mesh]:
    """All valences beside each other and apart, wrapped round a torus, in any order, and a vertex of no face."""
    found = {name: shapes.SHAPES[name]() for name in [*TRIANGLES, "icosahedron"]}
    found = {name: mesh for name, mesh in found.items() if SQRT3.accepts(mesh.topology)}
    found |= {f"bipyramid {n}": shapes.bipyramid(n) for n in (3, 9)}
    draw = np.random.default_rng(1)
    chance = draw.normal(size=(30, 3))
    found["ball"] = Mesh(Topology.from_faces(_outside(chance / np.linalg.norm(chance, axis=1)[:, None])), chance)
    for name in ("bipyramid 9", "triangle-torus"):
        t, n = found[name].surface, found[name].surface.n_vertices
        number = draw.permutation(n + 1)
        faces = [np.roll(number[face], draw.integers(3)).tolist() for face in t.loops()]
        mixed = Topology.from_faces([faces[f] for f in draw.permutation(len(faces))], n + 1)
        found[f"{name}, numbered by chance"] = Mesh(mixed, draw.normal(size=(n + 1, 3)))
    return found


def _outside(points: Floats) -> list[list[int]]:
    """The triangles of the hull of points round the origin, seen from outside."""
    faces = ConvexHull(points).simplices
    return [list(face) if np.linalg.det(points[face]) > 0 else list(face[::-1]) for face in faces]


@pytest.mark.usefixtures("eager")
def test_blocks_are_what_the_stages_make() -> None:
    meshes = closed()
    assert len(meshes) > 6
    for name, mesh in meshes.items():
        for levels in range(1, 8 if mesh.surface.n_faces < 10 else 6):
            made = plan(mesh.topology, SQRT3, levels)
            deep = [step.depth for step in made.steps if isinstance(step, MiddleTables)]
            assert deep == [min(levels - 1, max(DEPTHS))] * (levels > min(DEPTHS)), f"{name}, {levels} levels"
            assert_same(made, made.apply(mesh.points), staged(mesh, SQRT3, levels), f"{name}, {levels} levels")
            assert np.array_equal(made.numbers, np.arange(len(made.numbers)))  # the stages' own numbers


@pytest.mark.usefixtures("eager")
def test_blocks_follow_points_that_move_in_any_number_of_dimensions() -> None:
    mesh = shapes.bipyramid(7)
    made, draw = plan(mesh.topology, SQRT3, 5), np.random.default_rng(2)
    assert isinstance(made.steps[-1], MiddleTables)
    for d in (1, 2, 3, 4):
        points = draw.normal(size=(9, d))
        out = np.empty((made.topology.n_vertices, d))
        assert made.apply(points, out) is out
        alone = [made.apply(column[:, None]) for column in points.T]
        assert np.abs(out - np.concatenate(alone, axis=1)).max() < 1e-13
    assert np.abs(made.apply(np.ones((9, 1))) - 1).max() < 1e-13


def test_large_meshes_have_blocks_and_shallow_ones_steps() -> None:
    mesh = shapes.icosahedron()
    made = plan(mesh.topology, SQRT3, 7)
    assert [type(step) for step in made.steps] == [Rows] * 4 + [MiddleTables]
    assert_same(made, subdivide(mesh, SQRT3, 7).points, staged(mesh, SQRT3, 7), "icosahedron")
    assert all(isinstance(step, MiddleStep) for step in PLANS.once(mesh.topology, SQRT3, 4).steps)


@pytest.mark.usefixtures("eager")
def test_vertices_of_two_triangles_and_of_very_many_are_made_step_by_step() -> None:
    pillow = Mesh(Topology.from_faces([[0, 1, 2], [2, 1, 0]]), np.random.default_rng(3).normal(size=(3, 3)))
    for mesh in (pillow, shapes.bipyramid(VALENCES.stop)):
        made = plan(mesh.topology, SQRT3, 4)
        assert not any(isinstance(step, MiddleTables) for step in made.steps)
        assert_same(made, made.apply(mesh.points), staged(mesh, SQRT3, 4), "step by step")

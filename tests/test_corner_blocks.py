"""Blocks of corners are what the stages of dual schemes make, point by point and face by face, at any depth."""

import sys

import numpy as np
import pytest

from subdivision import Connectivity, Mesh, Polyline, Scheme, Topology, plan, shapes, subdivide
from subdivision.plans.corner_blocks import Blocks, table
from subdivision.plans.corner_numbers import BY_MIDPOINTS
from subdivision.plans.corner_steps import CornerStep
from subdivision.plans.kernels import Rows
from subdivision.schemes import CHAIKIN, MID_EDGE, SCHEMES
from subdivision.schemes.doo_sabin import cosine_weights
from subdivision.schemes.mid_edge import two_steps
from tests.test_tables import QUADS, TRIANGLES, assert_same, staged

PLANS = sys.modules["subdivision.plans.plan"]
DUAL = [scheme for scheme in SCHEMES if scheme.corners]
schemes = pytest.mark.parametrize("scheme", DUAL, ids=lambda s: s.name)
PRISM = [[4, 3, 2, 1, 0], [5, 6, 7, 8, 9], *([k, (k + 1) % 5, (k + 1) % 5 + 5, k + 5] for k in range(5))]


@pytest.fixture
def eager(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks however small the mesh is."""
    for name in ("WORTH_TABLES", "SMALL"):
        monkeypatch.setattr(PLANS, name, 0)
    monkeypatch.setattr(sys.modules["subdivision.plans.corner_blocks"], "BLOCKS_A_KIND", 0)


def steps_that_double(scheme: Scheme) -> int:
    assert scheme.numbering
    return scheme.numbering.steps


def closed() -> dict[str, Mesh]:
    """Faces and vertices of three and more corners, in several orders, and vertices of no face."""
    draw = np.random.default_rng(1)
    found = {name: shapes.SHAPES[name]() for name in QUADS + TRIANGLES}
    found = {name: mesh for name, mesh in found.items() if not mesh.surface.boundary.any()}
    found["prism"] = Mesh(Topology.from_faces(PRISM), draw.normal(size=(10, 3)))
    for name in ("prism", "mug", "bipyramid"):
        t, n = found[name].surface, found[name].surface.n_vertices
        number = draw.permutation(n + 3)
        faces = [np.roll(number[face], draw.integers(len(face))).tolist() for face in t.loops()]
        points = np.zeros((n + 3, 3))
        points[number[:n]] = found[name].points
        mixed = [faces[f] for f in draw.permutation(len(faces))]
        found[f"{name}, numbered by chance"] = Mesh(Topology.from_faces(mixed, n + 3), points)
    return found


@schemes
@pytest.mark.usefixtures("eager")
def test_blocks_are_what_the_stages_make(scheme: Scheme) -> None:
    each = steps_that_double(scheme)
    for name, mesh in closed().items():
        for levels in range(2 * each, 5 * each if mesh.surface.n_faces < 20 else 3 * each + 1):
            made = plan(mesh.topology, scheme, levels)
            assert isinstance(made.steps[-1], Blocks)
            assert made.steps[-1].depth == levels // each - 1
            assert_same(made, made.apply(mesh.points), staged(mesh, scheme, levels), f"{name}, {levels} levels")


@schemes
def test_a_deep_mesh_is_made_of_blocks_by_itself(scheme: Scheme) -> None:
    mesh, levels = shapes.duck(), 5 * steps_that_double(scheme)
    made, fine = plan(mesh.topology, scheme, levels), subdivide(mesh, scheme, levels)
    assert isinstance(made.steps[-1], Blocks)
    assert_same(made, fine.points, staged(mesh, scheme, levels), "duck")
    out = np.empty_like(fine.points)
    moved = Mesh(mesh.topology, np.random.default_rng(2).normal(size=mesh.points.shape))
    expected = staged(moved, scheme, levels).points
    assert made.apply(moved.points, out) is out
    for d, points in ((3, out), (2, made.apply(moved.points[:, :2])), (1, made.apply(moved.points[:, :1]))):
        assert np.abs(points[made.numbers] - expected[:, :d]).max() < 1e-12


@schemes
@pytest.mark.usefixtures("eager")
def test_what_is_no_block_is_made_step_by_step(scheme: Scheme) -> None:
    two_faces = Mesh(Topology.from_faces([[0, 1, 2, 3], [3, 2, 1, 0]]), np.random.default_rng(5).normal(size=(4, 3)))
    levels = 3 * steps_that_double(scheme)
    for mesh in (two_faces, shapes.quad_sheet(), shapes.triangle_fan(), shapes.bipyramid(70)):
        if scheme.accepts(mesh.topology):
            made = plan(mesh.topology, scheme, levels)
            assert all(isinstance(step, CornerStep | Rows) for step in made.steps)
            assert_same(made, made.apply(mesh.points), staged(mesh, scheme, levels), "step by step")


@schemes
def test_a_block_is_linear_and_turns_with_its_faces(scheme: Scheme) -> None:
    """A table is an affine combination; of a regular point it is the same from all four sides."""
    assert scheme.corners
    for sizes in ((4, 4, 4, 4), (3, 4, 7, 4)):
        assert np.abs(table(sizes, scheme.corners, 3).sum(axis=1) - 1).max() < 1e-12
    block = table((4, 4, 4, 4), scheme.corners, 3)
    turned_points = [0, 2, 3, 4, 1, 6, 7, 8, 5]
    digits = np.arange(64)[:, None] // [16, 4, 1] % 4
    turned_rows = ((digits + 1) % 4) @ [16, 4, 1]
    assert np.abs(block[turned_rows][:, turned_points] - block).max() < 1e-12


def test_a_regular_block_is_the_tensor_product_of_chaikins_curve() -> None:
    """Nine points in rows of three, refined as two curves are."""
    t: Connectivity = Polyline(3)
    matrix = np.eye(3)
    for _ in range(3):
        step = CHAIKIN.step(t)
        matrix, t = step.matrix @ matrix, step.topology
    middle = matrix[(len(matrix) - 8) // 2 :][:8]
    rows = np.array([[5, 1, 8], [2, 0, 4], [6, 3, 7]])
    tensor = np.zeros((8, 8, 9))
    tensor[:, :, rows.ravel()] = np.einsum("ia,jb->ijab", middle, middle).reshape(8, 8, 9)
    ours, theirs = table((4, 4, 4, 4), cosine_weights, 3), tensor.reshape(64, 9)
    assert np.abs(ours[:, None] - theirs).max(axis=2).min(axis=1).max() < 1e-12


def test_two_steps_of_mid_edge_are_one_of_corners() -> None:
    t = shapes.mug().surface
    first = MID_EDGE.step(t)
    once, two = CornerStep(t, two_steps, BY_MIDPOINTS), MID_EDGE.step(first.topology).matrix @ first.matrix
    assert np.abs(once.assembled().matrix - two).max() < 1e-12

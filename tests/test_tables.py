"""The fast way makes what the stages make: the same points, on the same half-edges, for every rule there is."""

import sys
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from subdivision import Boundary, Grid, Mesh, Plan, Polyline, Scheme, Topology, TopologyError, plan, shapes, subdivide
from subdivision.arrays import Floats
from subdivision.plans.kernels import Kernel, Rows
from subdivision.plans.later import Later
from subdivision.plans.mirrors import seen_mirrored
from subdivision.plans.nearby import Nearby, nearby
from subdivision.plans.sorted_faces import sorted_faces
from subdivision.plans.tables import Tables
from subdivision.plans.templates import descendants, template
from subdivision.schemes import CATMULL_CLARK, LOOP, QUAD_CENTROID, SCHEMES, lane_riesenfeld, tensor_product
from subdivision.stage import Step

PLANS, TABLES = (sys.modules[f"subdivision.plans.{name}"] for name in ("plan", "tables"))
FAST = [scheme for scheme in SCHEMES if scheme.reach]
QUADS, TRIANGLES = (["cube", "plus-sign", "quad-bipyramid", "quad-fan", "quad-sheet", "torus", "mug"],
                    ["tetrahedron", "octahedron", "bipyramid", "triangle-fan", "triangle-sheet", "triangle-torus"])
Patch = pytest.MonkeyPatch
schemes = pytest.mark.parametrize("scheme", FAST, ids=lambda s: s.name)


@pytest.fixture
def eager(monkeypatch: Patch) -> None:
    """Tables however small the mesh is."""
    for name, value in (("WORTH_TABLES", 0), ("SMALL", 0), ("FACES_A_KIND", 0.01), ("FINE_FACES_A_KIND", 0.01)):
        monkeypatch.setattr(PLANS, name, value)


def meshes(scheme: Scheme) -> Iterator[tuple[str, Mesh]]:
    """Closed, open, creased, pinned and hidden; polygons where the scheme takes them."""
    draw = np.random.default_rng(1)
    for name in QUADS + TRIANGLES:
        mesh = shapes.SHAPES[name]()
        t = mesh.surface
        if not scheme.accepts(t):
            continue
        yield name, mesh
        for rule in (Boundary.EDGE, Boundary.EDGE_AND_CORNER, Boundary.HIDE):
            sharp = t.ends[draw.random(t.n_edges) < 0.3].tolist()
            creases = {(a, b): float(draw.choice([0.25, 1, 1.75, 3, 10])) for a, b in sharp}
            corners = {int(v): float(draw.choice([0.5, 10])) for v in draw.integers(t.n_vertices, size=2)}
            creased = Topology.from_faces(t.loops(), t.n_vertices, boundary=rule, creases=creases, corners=corners)
            yield f"{name}, creased, {rule.value}", Mesh(creased, mesh.points)


def staged(mesh: Mesh, scheme: Scheme, levels: int) -> Mesh:
    topology, points = mesh.topology, mesh.points
    for _ in range(levels):
        step = scheme.step(topology, "stencils" if "stencils" in scheme.tellings else None)
        topology, points = step.topology, step.apply(points)
    return Mesh(topology, points)


def assert_same(found: Plan, points: Floats, expected: Mesh, case: str) -> None:
    assert np.abs(points[found.numbers] - expected.points).max() < 1e-12, case
    assert np.array_equal(np.sort(found.numbers), np.arange(len(points))), case
    ours, theirs = found.topology, expected.topology
    assert isinstance(ours, Topology)
    assert isinstance(theirs, Topology)
    assert np.array_equal(ours.origin, found.numbers[theirs.origin]), case
    for name in ("next", "twin", "edge", "face", "edge_sharpness", "vertex_sharpness", "hidden", "face_sizes"):
        assert np.array_equal(getattr(ours, name), getattr(theirs, name)), f"{case}: {name}"


@schemes
def test_kernels_make_the_points_of_the_stages(scheme: Scheme) -> None:
    for name, mesh in meshes(scheme):
        for levels in (0, 1, 3):
            made = plan(mesh.topology, scheme, levels)
            assert all(isinstance(step, Kernel | Later | Rows) for step in made.steps)
            assert_same(made, made.apply(mesh.points), staged(mesh, scheme, levels), f"{name}, {levels} levels")
            assert np.array_equal(made.numbers, np.arange(len(made.numbers)))
            fine = subdivide(mesh, scheme, levels).points  # by kernels, which are not assembled for one use
            assert np.abs(fine - made.apply(mesh.points)).max() < 1e-12


@schemes
@pytest.mark.usefixtures("eager")
def test_tables_make_the_points_of_the_stages(scheme: Scheme) -> None:
    for name, mesh in meshes(scheme):
        for levels in (3, 4):
            made = plan(mesh.topology, scheme, levels)
            assert isinstance(made.steps[-1], Tables)
            case = f"{name}, {levels} levels, the last {made.steps[-1].depth} at once"
            assert_same(made, made.apply(mesh.points), staged(mesh, scheme, levels), case)


@schemes
@pytest.mark.usefixtures("eager")
def test_numbering_a_mesh_along_its_surface_first_moves_no_point(scheme: Scheme, monkeypatch: Patch) -> None:
    monkeypatch.setattr(PLANS, "SCATTERED", 0)
    some = shapes.icosahedron()
    points = np.vstack([some.points, np.eye(3)])
    lonely = "isolated vertices", Mesh(Topology.from_faces(some.surface.loops(), len(points)), points)
    for name, mesh in (*meshes(scheme), *([lonely] if scheme.accepts(lonely[1].topology) else [])):
        for levels in (1, 2, 3):
            made = plan(mesh.topology, scheme, levels)
            assert isinstance(made.steps[0], Nearby)
            assert isinstance(made.steps[-1], Tables) == (levels == 3)
            assert_same(made, made.apply(mesh.points), staged(mesh, scheme, levels), f"{name}, {levels} levels")


def test_neighbours_are_near_in_memory() -> None:
    mesh = subdivide(shapes.icosahedron(), LOOP, 4)
    scattered = np.random.default_rng(4).permutation(mesh.topology.n_vertices)
    t = Topology.from_faces([[int(scattered[v]) for v in loop] for loop in mesh.surface.loops()])
    span, far = (np.abs(np.diff(x.ends)).max() for x in (nearby(t).topology, t))
    assert span < 2 * np.sqrt(3 * t.n_vertices) < far / 10  # no more than the vertices on two rings round the middle


@pytest.mark.usefixtures("eager")
@given(data=st.data())
def test_tables_follow_any_sharpness(data: st.DataObject) -> None:
    scheme, mesh = data.draw(st.sampled_from([(QUAD_CENTROID, shapes.cube()), (LOOP, shapes.bipyramid(5))]))
    t = mesh.surface
    sharpness = st.sampled_from([0.0, 0.25, 1.0, 1.75, 2.5, 10.0])
    creases = {(int(a), int(b)): data.draw(sharpness) for a, b in t.ends}
    corners = data.draw(st.dictionaries(st.integers(0, 6), sharpness, max_size=2))
    control = Mesh(Topology.from_faces(t.loops(), creases=creases, corners=corners), mesh.points)
    made = plan(control.topology, scheme, 3)
    assert_same(made, made.apply(control.points), staged(control, scheme, 3), "any sharpness")


@pytest.mark.parametrize("scheme", [QUAD_CENTROID, LOOP], ids=lambda s: s.name)
def test_a_kind_of_face_and_its_image_in_a_mirror_have_one_table(scheme: Scheme) -> None:
    taken = 0
    for name, mesh in meshes(scheme):
        t = scheme.step(mesh.topology).topology
        found, rule = sorted_faces(t, np.zeros(t.n_faces, dtype=bool), t.n_faces), PLANS._rule(t, scheme)
        for kind, image in zip(found.kinds, found.images, strict=True) if found else ():
            if image >= 0 and kind != found.kinds[image]:
                one, other = (TABLES._computed((x,), 2, rule)[0] for x in (kind, found.kinds[image]))
                assert np.abs(seen_mirrored(other, kind, 2) - one).max() < 1e-12, name
                taken += any(fan.sharpness and not fan.closed for fan in kind.fans)
    assert taken


def test_control_faces_of_any_size_go_through_tables() -> None:
    prism = [[4, 3, 2, 1, 0], [5, 6, 7, 8, 9], *([k, (k + 1) % 5, (k + 1) % 5 + 5, k + 5] for k in range(5))]
    mesh = Mesh(Topology.from_faces(prism), np.random.default_rng(2).normal(size=(10, 3)))
    made = plan(mesh.topology, CATMULL_CLARK, 6)
    assert isinstance(made.steps[-1], Tables)
    assert_same(made, made.apply(mesh.points), staged(mesh, CATMULL_CLARK, 6), "prism")


@schemes
def test_a_deep_mesh_is_the_staged_one_and_control_points_keep_their_numbers(scheme: Scheme) -> None:
    mesh = shapes.duck() if scheme.accepts(shapes.duck().topology) else shapes.icosahedron()
    levels = 5 if mesh.surface.n_faces > 20 else 6
    fine, expected = subdivide(mesh, scheme, levels), staged(mesh, scheme, levels)
    made = plan(mesh.topology, scheme, levels)
    assert isinstance(made.steps[-1], Tables)
    assert_same(made, fine.points, expected, "deep")
    n = mesh.topology.n_vertices
    assert np.abs(fine.points[:n] - expected.points[:n]).max() < 1e-12


@schemes
def test_a_plan_is_applied_to_moved_points_and_to_any_number_of_coordinates(scheme: Scheme) -> None:
    t = next(iter(meshes(scheme)))[1].surface
    for levels in (2, 6):
        made = plan(t, scheme, levels)
        draw = np.random.default_rng(3)
        one, other, flat = (draw.normal(size=(t.n_vertices, d)) for d in (3, 3, 2))
        out = np.empty((made.topology.n_vertices, 3))
        assert made.apply(one + other, out) is out
        assert np.abs(out - made.apply(one) - made.apply(other)).max() < 1e-12
        assert np.abs(made.apply(flat) - made.apply(np.column_stack([flat, flat]))[:, :2]).max() < 1e-12
        assert np.abs(made.apply(np.ones((t.n_vertices, 3))) - 1).max() < 1e-12


def test_a_small_control_mesh_has_one_matrix_and_a_large_one_steps() -> None:
    assert plan(shapes.cube().topology, CATMULL_CLARK, 4).whole is not None
    assert plan(shapes.cube().topology, CATMULL_CLARK, 8).whole is None
    assert plan(shapes.duck().topology, CATMULL_CLARK, 2).whole is None


def test_what_has_no_kernel_is_told_in_stages() -> None:
    literal = shapes.quad_sheet().surface.with_boundary(Boundary.LITERAL)
    others = [(literal, QUAD_CENTROID), (Grid(5, 6), tensor_product(3, 3)), (Polyline(7), lane_riesenfeld(3))]
    for topology, scheme in others:
        made = plan(topology, scheme, 2)
        assert all(isinstance(step, Step) for step in PLANS.once(topology, scheme, 2).steps)
        points = np.random.default_rng(4).normal(size=(topology.n_vertices, 3))
        expected = scheme.step(scheme.step(topology).topology).apply(scheme.step(topology).apply(points))
        assert np.abs(made.apply(points) - expected).max() < 1e-12
        assert np.abs(made.apply(points, np.empty_like(expected)) - expected).max() < 1e-12
    with pytest.raises(TopologyError, match="cannot subdivide"):
        plan(Grid(5, 6), LOOP, 2)


@pytest.mark.parametrize("scheme", [scheme for scheme in SCHEMES if not scheme.reach], ids=lambda s: s.name)
def test_plans_of_the_schemes_beyond_make_the_points_of_the_stages(scheme: Scheme) -> None:
    taken = 0
    for name in QUADS + TRIANGLES:
        for rule in (Boundary.EDGE, Boundary.LITERAL):
            mesh = Mesh(shapes.SHAPES[name]().surface.with_boundary(rule), shapes.SHAPES[name]().points)
            if not scheme.accepts(mesh.topology):
                continue
            expected, taken = staged(mesh, scheme, 2), taken + 1
            made = plan(mesh.topology, scheme, 2)
            assert_same(made, made.apply(mesh.points), expected, name)
            assert np.abs(subdivide(mesh, scheme, 2).points - expected.points).max() < 1e-12
    assert taken


def test_meshes_no_table_can_unfold_are_made_step_by_step() -> None:
    two_faces = Mesh(Topology.from_faces([[0, 1, 2, 3], [3, 2, 1, 0]]), np.random.default_rng(5).normal(size=(4, 3)))
    spindle = shapes.quad_bipyramid(40)
    for mesh in (two_faces, spindle):
        made = plan(mesh.topology, CATMULL_CLARK, 5)
        assert all(isinstance(step, Kernel | Later | Rows) for step in made.steps)
        assert_same(made, made.apply(mesh.points), staged(mesh, CATMULL_CLARK, 5), "step by step")


def test_isolated_vertices_stay() -> None:
    mesh = Mesh(Topology.from_faces(shapes.cube().surface.loops(), 10), np.random.default_rng(6).normal(size=(10, 3)))
    fine = subdivide(mesh, CATMULL_CLARK, 6)
    assert np.array_equal(fine.points[8:10], mesh.points[8:10])


def test_the_rest_of_a_topology_is_made_when_it_is_asked_for() -> None:
    fine = subdivide(shapes.cube(), CATMULL_CLARK, 7).surface
    assert {"origin", "face_sizes", "hidden"} <= set(vars(fine))
    assert not {"twin", "edge", "next"} & set(vars(fine))
    assert fine.euler == 2
    assert not {"twin", "edge", "next"} & set(vars(fine))
    assert np.array_equal(fine.twin[fine.twin], np.arange(fine.n_halfedges))
    assert fine.with_boundary(Boundary.HIDE).n_faces == fine.n_faces
    with pytest.raises(AttributeError, match="nonsense"):
        _ = fine.nonsense  # type: ignore[attr-defined]


@pytest.mark.parametrize("k", [3, 4])
def test_a_split_face_has_every_point_once_and_every_small_face(k: int) -> None:
    for depth in (1, 2, 4):
        split, n = template(k, depth), 2**depth
        assert len(split.first) == ((n + 1) ** 2 if k == 4 else (n + 1) * (n + 2) // 2)
        assert split.corners.shape == (4**depth, k)
        assert sorted(np.unique(split.corners)) == list(range(len(split.first)))
        first, each = descendants(k, 7, depth)
        numbers = first + each * np.arange(7)[:, None]
        assert np.array_equal(np.sort(numbers.ravel()), np.arange(7 * 4**depth))

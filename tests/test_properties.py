"""What holds for any mesh: numbering does not matter, neither does telling; rules are local; rows are affine."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from subdivision import Boundary, Mesh, Scheme, Topology, TopologyError, subdivide, trace
from subdivision.arrays import Floats
from subdivision.schemes import CATMULL_CLARK, LECTURE, QUAD_CENTROID

Faces = list[list[int]]
Drawn = tuple[Faces, int, dict[tuple[int, int], float], dict[int, float], Boundary]

schemes = pytest.mark.parametrize("scheme", LECTURE, ids=lambda s: s.name)


@st.composite
def meshes(draw: st.DrawFn, scheme: Scheme) -> Drawn:
    """A patch of a grid, a torus or a fan, some faces missing, some edges and vertices sharp."""
    kind = draw(st.sampled_from(["grid", "torus", "fan"]))
    if kind == "fan":
        n = draw(st.integers(3, 9))
        faces = [[0, 1 + k, 1 + n + k, 1 + (k + 1) % n] for k in range(n)]
    else:
        n, m = draw(st.integers(3, 5)), draw(st.integers(3, 5))
        wrap = kind == "torus"
        cells = product(range(n if wrap else n - 1), range(m if wrap else m - 1))
        faces = [
            [i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m] for i, j in cells
        ]  # fmt: skip
    if scheme not in (QUAD_CENTROID, CATMULL_CLARK):
        faces = [triangle for a, b, c, d in faces for triangle in ([a, b, c], [a, c, d])]
    faces = without_bow_ties(faces, draw(st.sets(st.integers(0, len(faces) - 1), max_size=2)))
    edges = sorted({(min(a, b), max(a, b)) for loop in faces for a, b in zip(loop, loop[1:] + loop[:1], strict=True)})
    sharp = st.sampled_from([0.5, 1.0, 1.75, 10.0])
    creases = draw(st.dictionaries(st.sampled_from(edges), sharp, max_size=5))
    corners = draw(st.dictionaries(st.sampled_from(sorted({v for loop in faces for v in loop})), sharp, max_size=2))
    rules = [Boundary.EDGE, Boundary.EDGE_AND_CORNER, Boundary.HIDE]
    return faces, max(map(max, faces)) + 1, creases, corners, draw(st.sampled_from(rules))


def without_bow_ties(faces: Faces, missing: set[int]) -> Faces:
    left = [loop for k, loop in enumerate(faces) if k not in missing]
    try:
        Topology.from_faces(left)
    except TopologyError:
        return faces
    return left


def topology(drawn: Drawn) -> Topology:
    faces, n, creases, corners, rule = drawn
    return Topology.from_faces(faces, n, creases=creases, corners=corners, boundary=rule)


def positions(n: int) -> Floats:
    return np.random.default_rng(n).normal(size=(n, 3))


@schemes
@given(data=st.data())
def test_all_tellings_multiply_to_one_matrix_whose_rows_sum_to_one(scheme: Scheme, data: st.DataObject) -> None:
    t = topology(data.draw(meshes(scheme)))
    first, *others = (scheme.step(t, telling).matrix for telling in scheme.tellings)
    for other in others:
        assert abs(first - other).max() < 1e-12
    assert np.abs(first.sum(axis=1) - 1).max() < 1e-12


@schemes
@given(data=st.data())
def test_applying_assembling_and_walking_back_agree_stage_by_stage(scheme: Scheme, data: st.DataObject) -> None:
    t = topology(data.draw(meshes(scheme)))
    points = positions(t.n_vertices)
    for telling in scheme.tellings:
        step = scheme.step(t, telling)
        before = points
        for stage in step.stages:
            after = stage.operator.apply(before)
            assert np.abs(stage.matrix @ before - after).max() < 1e-12
            before = after
        assert np.abs(step.apply(points) - step.matrix @ points).max() < 1e-12
        dense = step.matrix.toarray()
        for point in range(0, len(dense), 5):
            exact = np.zeros(t.n_vertices)
            stencil = step.stencil(point)
            exact[stencil.parents] = stencil.weights
            assert np.abs(exact - dense[point]).max() < 1e-12
            assert float(sum(weight for _, weight in stencil.terms)) == pytest.approx(1, abs=1e-15)


@schemes
@given(data=st.data())
def test_relabelling_the_vertices_commutes_with_subdivision(scheme: Scheme, data: st.DataObject) -> None:
    faces, n, creases, corners, rule = data.draw(meshes(scheme))
    new = data.draw(st.permutations(range(n)))
    t = topology((faces, n, creases, corners, rule))
    renamed = topology((
        [[new[v] for v in loop] for loop in faces], n,
        {(new[a], new[b]): s for (a, b), s in creases.items()}, {new[v]: s for v, s in corners.items()}, rule,
    ))  # fmt: skip
    points = positions(n)
    moved = np.empty_like(points)
    moved[new] = points
    ours, theirs = (subdivide(Mesh(*pair), scheme, 2) for pair in ((t, points), (renamed, moved)))
    assert np.abs(theirs.points[new] - ours.points[:n]).max() < 1e-12
    assert_same_faces(ours, theirs)


@schemes
@given(data=st.data())
def test_rotating_face_loops_and_reordering_faces_changes_nothing(scheme: Scheme, data: st.DataObject) -> None:
    faces, n, *rest = data.draw(meshes(scheme))
    turns = data.draw(st.lists(st.integers(0, 3), min_size=len(faces), max_size=len(faces)))
    turned = [loop[k:] + loop[:k] for loop, k in zip(faces, turns, strict=True)]
    shuffled = data.draw(st.permutations(turned))
    points = positions(n)
    ours, theirs = (subdivide(Mesh(topology((f, n, *rest)), points), scheme, 2) for f in (faces, shuffled))
    assert np.abs(theirs.points[:n] - ours.points[:n]).max() < 1e-12
    assert_same_faces(ours, theirs)


def assert_same_faces(a: Mesh, b: Mesh) -> None:
    """The centroids of the faces are the same points, in some order; likewise how sharp edges are."""
    one, other = (np.array([m.points[loop].mean(axis=0) for loop in m.topology.loops()]) for m in (a, b))
    gaps = np.linalg.norm(one[:, None] - other[None], axis=2)
    assert gaps.min(axis=0).max() < 1e-12
    assert gaps.min(axis=1).max() < 1e-12
    assert sorted(a.topology.edge_sharpness) == pytest.approx(sorted(b.topology.edge_sharpness), abs=0)


@schemes
@given(data=st.data())
def test_deleting_a_face_leaves_the_rows_of_other_neighbourhoods_alone(scheme: Scheme, data: st.DataObject) -> None:
    faces, n, creases, corners, rule = data.draw(meshes(scheme))
    gone = data.draw(st.integers(0, len(faces) - 1))
    left = without_bow_ties(faces, {gone}) if len(faces) > 1 else faces
    edges = {frozenset(pair) for loop in left for pair in zip(loop, loop[1:] + loop[:1], strict=True)}
    fewer = {pair: s for pair, s in creases.items() if frozenset(pair) in edges}
    before, after = topology((faces, n, creases, corners, rule)), topology((left, n, fewer, corners, rule))
    touched = {v for loop in faces if set(loop) & set(faces[gone]) for v in loop}
    a, b = scheme.step(before).matrix.toarray(), scheme.step(after).matrix.toarray()
    for v in set(range(n)) - touched:
        assert np.abs(a[v] - b[v]).max() < 1e-12


@schemes
@given(data=st.data())
def test_subdivision_commutes_with_affine_maps_and_keeps_the_hull(scheme: Scheme, data: st.DataObject) -> None:
    t = topology(data.draw(meshes(scheme)))
    points, A, shift = positions(t.n_vertices), positions(3), np.array([3.0, -1, 2])
    step = scheme.step(t)
    assert np.abs(step.apply(points @ A + shift) - (step.apply(points) @ A + shift)).max() < 1e-12
    assert step.matrix.min() >= -1e-15


@schemes
@given(data=st.data())
def test_the_refined_half_edges_are_those_built_from_the_refined_faces(scheme: Scheme, data: st.DataObject) -> None:
    fine = scheme.step(topology(data.draw(meshes(scheme)))).topology
    assert isinstance(fine, Topology)
    built = Topology.from_faces(fine.loops(), fine.n_vertices)
    assert np.array_equal(fine.twin, built.twin)
    assert np.array_equal(fine.next[fine.prev], np.arange(fine.n_halfedges))
    assert np.array_equal(fine.valence, built.valence)
    assert np.array_equal(fine.origin[fine.twin[fine.twin >= 0]], fine.origin[fine.next[fine.twin >= 0]])
    assert fine.n_edges == built.n_edges == len(set(fine.edge))


@schemes
@given(data=st.data())
def test_a_trace_is_the_same_as_subdividing_and_survives_dragging(scheme: Scheme, data: st.DataObject) -> None:
    t = topology(data.draw(meshes(scheme)))
    mesh = Mesh(t, positions(t.n_vertices))
    told = trace(scheme, mesh, levels=2)
    assert np.abs(told.points[-1] - subdivide(mesh, scheme, 2).points).max() < 1e-12
    dragged = mesh.moved(0, np.array([5.0, 5, 5]))
    shift = told.with_control(dragged).points[-1] - told.points[-1]
    expected = np.outer(told.whole.influence(0), np.array([5.0, 5, 5]) - mesh.points[0])
    assert np.abs(shift - expected).max() < 1e-12

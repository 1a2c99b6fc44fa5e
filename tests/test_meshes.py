"""Meshes: centroid averaging, stencils, counts and numbers, beside loops over faces written without the engine."""

from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise, product
from math import cos, pi

import naive
import numpy as np
import pytest

from subdivision import Mesh, Scheme, Topology, TopologyError, shapes, subdivide
from subdivision.arrays import Floats
from subdivision.schemes import CATMULL_CLARK, LECTURE, LOOP, LOOP_WARREN, QUAD_CENTROID, SCHEMES, TRIANGLE_CENTROID


def double_torus() -> Mesh:
    """The boundary of a slab of unit cubes with two holes: Euler characteristic -2."""
    solid = {(x, y, 0) for x, y in product(range(5), range(3)) if (x, y) not in ((1, 1), (3, 1))}
    number: dict[tuple[int, ...], int] = {}
    faces = []
    for cell in sorted(solid):
        for axis, side in product(range(3), (0, 1)):
            if tuple(np.add(cell, np.eye(3, dtype=int)[axis] * (2 * side - 1))) in solid:
                continue
            u, w = np.eye(3, dtype=int)[[axis - 2, axis - 1]]
            start = np.add(cell, np.eye(3, dtype=int)[axis] * side)
            loop = [tuple(map(int, start + a * u + b * w)) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            faces.append([number.setdefault(p, len(number)) for p in (loop if side else loop[::-1])])
    return Mesh(Topology.from_faces(faces), np.array(list(number), dtype=float))


QUADS: dict[str, Callable[[], Mesh]] = {
    "cube": shapes.cube, "plus sign": shapes.plus_sign, "torus": shapes.torus, "double torus": double_torus,
    "valence 5": lambda: shapes.quad_bipyramid(5), "valence 8": lambda: shapes.quad_bipyramid(8),
}  # fmt: skip
TRIANGLES: dict[str, Callable[[], Mesh]] = {
    "tetrahedron": shapes.tetrahedron, "octahedron": shapes.octahedron, "icosahedron": shapes.icosahedron,
    "triangle torus": shapes.triangle_torus, "valence 3": lambda: shapes.bipyramid(3),
    "valence 7": lambda: shapes.bipyramid(7), "valence 12": lambda: shapes.bipyramid(12),
}  # fmt: skip
CLOSED = [(QUADS[name], name, s) for name in QUADS for s in (QUAD_CENTROID, CATMULL_CLARK)] + [
    (TRIANGLES[name], name, s) for name in TRIANGLES for s in (TRIANGLE_CENTROID, LOOP, LOOP_WARREN)
]
IDS = [f"{name}, {scheme.name}" for _, name, scheme in CLOSED]
closed = pytest.mark.parametrize(("make", "scheme"), [(make, scheme) for make, _, scheme in CLOSED], ids=IDS)


def one_row_per_vertex(mesh: Mesh) -> tuple[Floats, list[list[int]]]:
    return np.eye(mesh.topology.n_vertices), mesh.topology.loops()


def rows_of(scheme: Scheme, mesh: Mesh) -> naive.Points:
    return naive.named(mesh.topology, scheme.step(mesh.topology).matrix.toarray())


@closed
def test_every_telling_is_the_published_stencils(make: Callable[[], Mesh], scheme: Scheme) -> None:
    t = make().topology
    expected = naive.stencilled(*one_row_per_vertex(make()), scheme.name)
    for telling in scheme.tellings:
        assert naive.difference(naive.named(t, scheme.step(t, telling).matrix.toarray()), expected) < 1e-12


@closed
def test_rows_sum_to_one_and_no_weight_is_negative(make: Callable[[], Mesh], scheme: Scheme) -> None:
    for telling in scheme.tellings:
        S = scheme.step(make().topology, telling).matrix.toarray()
        assert np.abs(S.sum(axis=1) - 1).max() < 1e-12
        assert S.min() >= -1e-15


@pytest.mark.parametrize("name", QUADS)
def test_centroid_averaging_of_quads_is_the_mean_of_the_centroids_of_the_split_faces(name: str) -> None:
    mesh = QUADS[name]()
    rows, faces = one_row_per_vertex(mesh)
    expected = naive.averaged(*naive.split(rows, faces))
    assert naive.difference(rows_of(QUAD_CENTROID, mesh), expected) < 1e-12


@pytest.mark.parametrize("name", TRIANGLES)
def test_centroid_averaging_of_triangles_is_the_mean_of_the_weighted_centroids(name: str) -> None:
    mesh = TRIANGLES[name]()
    rows, faces = one_row_per_vertex(mesh)
    expected = naive.averaged(*naive.split(rows, faces))
    assert naive.difference(rows_of(TRIANGLE_CENTROID, mesh), expected) < 1e-12


@pytest.mark.parametrize("name", QUADS)
def test_catmull_clark_goes_four_nths_of_the_way_to_the_centroids(name: str) -> None:
    mesh = QUADS[name]()
    X, cells = naive.split(*one_row_per_vertex(mesh))
    A, n = naive.averaged(X, cells), naive.valences(mesh.topology.loops())
    expected = {v: X[v] + 4 / n.get(v, 4) * (A[v] - X[v]) for v in X}
    assert naive.difference(rows_of(CATMULL_CLARK, mesh), expected) < 1e-12


@pytest.mark.parametrize("name", TRIANGLES)
def test_loop_goes_w_of_the_way_to_the_centroids_and_each_neighbour_weighs_three_quarters_over_n(name: str) -> None:
    mesh = TRIANGLES[name]()
    X, cells = naive.split(*one_row_per_vertex(mesh))
    A, n = naive.averaged(X, cells), naive.valences(mesh.topology.loops())
    expected = {v: X[v] + (5 / 3 - 8 / 3 * (3 / 8 + cos(2 * pi / n.get(v, 6)) / 4) ** 2) * (A[v] - X[v]) for v in X}
    assert naive.difference(rows_of(LOOP, mesh), expected) < 1e-12
    for v in X:
        around = {w for cell in cells if v in cell for w in cell} - {v}
        ring = X[v] / 4 + 3 / 4 / len(around) * sum(X[w] for w in around)
        assert np.abs(A[v] - ring).max() < 1e-12


@pytest.mark.parametrize("name", QUADS)
def test_three_published_forms_of_the_catmull_clark_vertex_agree(name: str) -> None:
    mesh = QUADS[name]()
    rows, faces = one_row_per_vertex(mesh)
    S = CATMULL_CLARK.step(mesh.topology).matrix.toarray()
    for v in range(len(rows)):
        around = [loop for loop in faces if v in loop]
        n, Q = len(around), sum(rows[loop].mean(axis=0) for loop in around) / len(around)
        neighbours = [next(iter(edge - {v})) for edge in naive.faces_at_edges(faces) if v in edge]
        E = rows[neighbours].mean(axis=0)
        assert np.abs(S[v] - (Q + 2 * (rows[v] + E) / 2 + (n - 3) * rows[v]) / n).max() < 1e-12
        assert np.abs(S[v] - ((n - 2) / n * rows[v] + E / n + Q / n)).max() < 1e-12


def test_simple_and_catmull_clark_agree_at_valence_four_and_loops_at_six() -> None:
    torus = shapes.torus().topology
    assert abs(QUAD_CENTROID.step(torus).matrix - CATMULL_CLARK.step(torus).matrix).max() < 1e-15
    torus = shapes.triangle_torus().topology
    for scheme in (LOOP, LOOP_WARREN):
        assert abs(TRIANGLE_CENTROID.step(torus).matrix - scheme.step(torus).matrix).max() < 1e-15


@closed
def test_counts_valences_and_euler_follow_their_laws(make: Callable[[], Mesh], scheme: Scheme) -> None:
    mesh = make()
    quads, chi, F0 = mesh.topology.is_quadrilateral, mesh.topology.euler, mesh.topology.n_faces
    regular = 4 if quads else 6
    odd = sum(n != regular for n in naive.valences(mesh.topology.loops()).values())
    for level in range(1, 4):
        V, E, F = mesh.topology.n_vertices, mesh.topology.n_edges, mesh.topology.n_faces
        before = naive.valences(mesh.topology.loops())
        mesh = subdivide(mesh, scheme, 1)
        faces = mesh.topology.loops()
        after = naive.valences(faces)
        counts = len(after), len(naive.faces_at_edges(faces)), len(faces)
        assert counts == ((V + E + F, 2 * E + 4 * F, 4 * F) if quads else (V + E, 2 * E + 3 * F, 4 * F))
        assert counts[0] - counts[1] + counts[2] == chi
        assert counts[2] == 4**level * F0
        assert counts[1] == 2 * counts[2] if quads else 2 * counts[1] == 3 * counts[2]
        assert {v: after[v] for v in before} == before
        assert all(n == regular for v, n in after.items() if v not in before)
        assert sum(n != regular for n in after.values()) == odd
        assert sum(regular - n for n in after.values()) == (4 if quads else 6) * chi


@pytest.mark.parametrize(("make", "scheme", "faces_per_edge"), [
    (shapes.quad_sheet, QUAD_CENTROID, Fraction(2)), (shapes.triangle_sheet, LOOP, Fraction(3, 2)),
])  # fmt: skip
def test_open_meshes_double_their_boundary_and_count_as_predicted(
    make: Callable[[], Mesh], scheme: Scheme, faces_per_edge: Fraction
) -> None:
    mesh = make()
    E, F, rim = mesh.topology.n_edges, mesh.topology.n_faces, len(naive.boundary_edges(mesh.topology.loops()))
    for k in range(1, 4):
        V = mesh.topology.n_vertices
        mesh = subdivide(mesh, scheme, 1)
        faces = mesh.topology.loops()
        edges, around = naive.faces_at_edges(faces), naive.valences(faces)
        assert len(edges) == 2**k * (E - faces_per_edge * F) + faces_per_edge * F * 4**k
        assert len(naive.boundary_edges(faces)) == 2**k * rim
        new = {v for edge in naive.boundary_edges(faces) for v in edge if v >= V}
        assert {around[v] for v in new} == {3 if scheme is QUAD_CENTROID else 4}
        assert mesh.topology.euler == 1


def area(points: Floats, faces: list[list[int]]) -> float:
    fans = [(loop[0], b, c) for loop in faces for b, c in pairwise(loop[1:])]
    return sum(float(np.linalg.norm(np.cross(points[b] - points[a], points[c] - points[a]))) / 2 for a, b, c in fans)


@pytest.mark.parametrize(("make", "scheme"), [
    (shapes.cube, QUAD_CENTROID), (shapes.icosahedron, TRIANGLE_CENTROID), (shapes.plus_sign, CATMULL_CLARK),
])  # fmt: skip
def test_the_topological_stage_keeps_the_area(make: Callable[[], Mesh], scheme: Scheme) -> None:
    mesh = make()
    stage = scheme.step(mesh.topology, "centroid averaging").stages[0]
    finer = area(stage.operator.apply(mesh.points), stage.topology.loops())
    assert finer == pytest.approx(area(mesh.points, mesh.topology.loops()), abs=1e-12)
    assert not stage.moves


def distinct(points: Floats) -> set[tuple[float, ...]]:
    return {tuple(np.round(np.sort(np.abs(p)), 12) + 0.0) for p in points}


def cube() -> Mesh:
    return Mesh(shapes.cube().topology, np.sign(shapes.cube().points))


@pytest.mark.parametrize(("scheme", "corner"), [(QUAD_CENTROID, 2 / 3), (CATMULL_CLARK, 5 / 9)])
def test_the_cube_goes_to_its_known_numbers(scheme: Scheme, corner: float) -> None:
    level = subdivide(cube(), scheme, 1).points
    assert np.abs(np.abs(level[:8]) - corner).max() < 1e-12
    assert distinct(level[8:14]) == {(0.0, 0.0, 1.0)}
    assert distinct(level[14:]) == {(0.0, 0.75, 0.75)}


def test_octahedron_and_tetrahedron_go_to_their_known_numbers() -> None:
    octahedron = Mesh(shapes.octahedron().topology, np.round(shapes.octahedron().points))
    for scheme, vertex in ((TRIANGLE_CENTROID, 5 / 8), (LOOP, 0.515625)):
        level = subdivide(octahedron, scheme, 1).points
        assert np.abs(level[:6] - vertex * octahedron.points).max() < 1e-12
        assert distinct(level[6:]) == {(0.0, 0.375, 0.375)}
    tetrahedron = shapes.tetrahedron()
    for scheme, vertex in ((TRIANGLE_CENTROID, 1 / 2), (LOOP, 1 / 4), (LOOP_WARREN, 1 / 4)):
        assert np.abs(subdivide(tetrahedron, scheme, 1).points[:4] - vertex * tetrahedron.points).max() < 1e-12


@pytest.mark.parametrize(("make", "centroid", "loop"), [
    (shapes.octahedron, 1.202, 1.067), (shapes.icosahedron, 1.031, 1.011), (shapes.tetrahedron, 2.06, 1.32),
])  # fmt: skip
def test_loop_is_rounder_than_centroid_averaging_by_the_stated_ratios(
    make: Callable[[], Mesh], centroid: float, loop: float
) -> None:
    for scheme, ratio in ((TRIANGLE_CENTROID, centroid), (LOOP, loop)):
        radius = np.linalg.norm(subdivide(make(), scheme, 4).points, axis=1)
        assert radius.max() / radius.min() == pytest.approx(ratio, abs=10 ** -len(str(ratio).split(".")[1]))


def test_every_scheme_has_its_stencils_tested_here() -> None:
    assert {scheme.name for scheme in LECTURE} == set(naive.BETAS) | set(naive.QUAD_WEIGHTS)


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda each: each.name)
@pytest.mark.parametrize("name", ["cube", "icosahedron", "plus-sign", "triangle-fan", "quad-fan"])
def test_faces_are_counted_before_they_are_made(scheme: Scheme, name: str) -> None:
    topology = shapes.SHAPES[name]().surface
    if not scheme.accepts(topology):
        with pytest.raises(TopologyError, match="cannot subdivide"):
            scheme.faces_after(topology, 2)
        return
    made = topology
    for levels in range(4):
        assert scheme.faces_after(topology, levels) == made.n_faces
        made = scheme.step(made).topology


@pytest.mark.parametrize("n", [3, 31, 33, 70])
def test_two_fans_at_a_vertex_are_refused_however_large_they_are(n: int) -> None:
    one = shapes.quad_bipyramid(n).surface
    tip, V = int(np.argmax(one.valence)), one.n_vertices
    faces = one.loops()
    closed = [[v if v == tip else v + V for v in face] for face in faces]
    for other in (closed, [[tip, V, V + 1, V + 2]]):
        with pytest.raises(TopologyError, match="bow tie") as refused:
            Topology.from_faces(faces + other, 2 * V + 3)
        assert refused.value.vertices == (tip,)

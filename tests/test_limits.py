"""Limit positions, tangents and normals: closed forms, and the same limits from every level."""

from collections.abc import Callable
from fractions import Fraction
from math import cos, pi, sin, sqrt

import naive
import numpy as np
import pytest
from test_meshes import QUADS, TRIANGLES, cube, distinct
from test_spectrum import quad_lambda, ring_matrix

from subdivision import Boundary, Grid, Mesh, Scheme, Topology, TopologyError, shapes, subdivide
from subdivision.arrays import Floats
from subdivision.exact import Formula, cosine, sine
from subdivision.limit import (
    MOST_FACES,
    levels_to_settle,
    limit,
    limit_mesh,
    limit_points,
    limit_stencil,
    normals,
    tangents,
)
from subdivision.schemes import (
    CATMULL_CLARK,
    LECTURE,
    LOOP,
    LOOP_WARREN,
    QUAD_CENTROID,
    TRIANGLE_CENTROID,
    tensor_product,
)
from subdivision.spectrum import fan

QUAD_SCHEMES, TRIANGLE_SCHEMES = (QUAD_CENTROID, CATMULL_CLARK), (TRIANGLE_CENTROID, LOOP, LOOP_WARREN)
MESHES = [(make, s) for make in QUADS.values() for s in QUAD_SCHEMES]
MESHES += [(make, s) for make in TRIANGLES.values() for s in TRIANGLE_SCHEMES]
schemes = pytest.mark.parametrize("scheme", LECTURE, ids=lambda s: s.name)


def notched() -> list[list[int]]:
    """A 5 by 6 grid of points without two of its boundary quads: boundary vertices of one to three faces."""
    quads = [[6 * i + j, 6 * i + j + 6, 6 * i + j + 7, 6 * i + j + 1] for i in range(4) for j in range(5)]
    return [loop for k, loop in enumerate(quads) if k not in (2, 14)]


def halved(faces: list[list[int]]) -> list[list[int]]:
    return [triangle for a, b, c, d in faces for triangle in ([a, b, c], [a, c, d])]


def star(n: int, scheme: Scheme) -> Topology:
    return fan(n, 4 if scheme in QUAD_SCHEMES else 3)


@pytest.mark.parametrize("n", [3, 4, 5, 6, 8])
@schemes
def test_limit_rows_are_fixed_by_a_step(scheme: Scheme, n: int) -> None:
    row = limit(scheme, star(n, scheme)).assemble().toarray()[0]
    assert np.abs(row @ ring_matrix(scheme, n) - row).max() < 1e-12
    assert row.sum() == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("n", [3, 4, 5, 6, 8])
def test_limit_rows_are_the_closed_forms(n: int) -> None:
    def weights(scheme: Scheme) -> list[object]:
        stencil = limit_stencil(scheme, star(n, scheme), 0)
        return [stencil.weight(v) for v in range(len(stencil.terms))]

    simple = [Fraction(4, 9), *[Fraction(4, 9 * n)] * n, *[Fraction(1, 9 * n)] * n]
    assert weights(QUAD_CENTROID) == simple
    over = Fraction(1, n * (n + 5))
    assert weights(CATMULL_CLARK) == [n * n * over, *[4 * over] * n, *[over] * n]
    assert weights(TRIANGLE_CENTROID) == [Fraction(1, 2), *[Fraction(1, 2 * n)] * n]
    for scheme in TRIANGLE_SCHEMES:
        beta = naive.BETAS[scheme.name](n)
        expected = [3 / (3 + 8 * n * beta), *[8 * beta / (3 + 8 * n * beta)] * n]
        assert [float(w) for w in weights(scheme)] == pytest.approx(expected, abs=1e-12)  # type: ignore[arg-type]


@pytest.mark.parametrize(("make", "scheme"), MESHES)
def test_limits_are_the_same_from_every_level(make: Callable[[], Mesh], scheme: Scheme) -> None:
    mesh = make()
    n, expected = mesh.topology.n_vertices, limit_points(mesh, scheme)
    for level in range(1, 4):
        mesh = subdivide(mesh, scheme, 1)
        assert np.abs(limit_points(mesh, scheme)[:n] - expected).max() < 1e-12, level


@schemes
def test_six_levels_agree_on_their_limits_and_come_as_close_as_eigenvalues_say(scheme: Scheme) -> None:
    mesh = shapes.cube() if scheme in QUAD_SCHEMES else shapes.icosahedron()
    n, expected = mesh.topology.n_vertices, limit_points(mesh, scheme)
    distance = [np.linalg.norm(mesh.points - expected, axis=1).max()]
    for _ in range(6):
        mesh = subdivide(mesh, scheme, 1)
        assert np.abs(limit_points(mesh, scheme)[:n] - expected).max() < 1e-12
        distance.append(np.linalg.norm(mesh.points[:n] - expected, axis=1).max())
    # on these symmetric solids only mode 0 moves the vertices: one or two eigenvalues besides 1
    eigenvalues = np.sort(np.abs(np.linalg.eigvals(ring_matrix(scheme, 3 if scheme in QUAD_SCHEMES else 5))))
    others = eigenvalues[eigenvalues < 1 - 1e-9]
    assert distance[6] / distance[5] < others.max()
    everywhere = np.linalg.norm(mesh.points - limit_points(mesh, scheme), axis=1).max()
    assert everywhere < distance[0] * others.max() ** 6 * 4


def test_the_cubes_limits_are_the_known_numbers() -> None:
    known = ((QUAD_CENTROID, 5 / 9, 0.634259, 0.851852), (CATMULL_CLARK, 1 / 2, 0.609568, 0.839506))
    for scheme, corner, edge, face in known:
        limits = limit_points(subdivide(cube(), scheme, 1), scheme)
        assert np.abs(np.abs(limits[:8]) - corner).max() < 1e-12
        assert np.abs(limits[8:14]).max(axis=1) == pytest.approx([face] * 6, abs=5e-7)
        assert {row[0] for row in distinct(limits[14:])} == {0.0}
        assert np.sort(np.abs(limits[14:]))[:, 1:] == pytest.approx(np.full((12, 2), edge), abs=5e-7)


def test_catmull_clark_makes_the_cube_rounder_than_the_simple_rule() -> None:
    for scheme, ratio in ((QUAD_CENTROID, 1.130), (CATMULL_CLARK, 1.032)):
        radius = np.linalg.norm(limit_points(subdivide(cube(), scheme, 1), scheme), axis=1)
        assert radius.max() / radius.min() == pytest.approx(ratio, abs=5e-4)


def test_the_tetrahedrons_corners_tend_to_a_third_or_a_fifth() -> None:
    mesh = shapes.tetrahedron()
    for scheme, part in ((TRIANGLE_CENTROID, 3), (LOOP, 5), (LOOP_WARREN, 5)):
        assert np.abs(limit_points(mesh, scheme) - mesh.points / part).max() < 1e-12


@schemes
@pytest.mark.parametrize("rule", [Boundary.EDGE, Boundary.EDGE_AND_CORNER, Boundary.HIDE])
@pytest.mark.parametrize(("creases", "corners"), [
    ({}, {}), ({(8, 9): 10}, {}), ({(8, 9): 10, (9, 10): 10, (9, 15): 10}, {}), ({(8, 9): 10, (9, 10): 10}, {20: 10}),
    ({(8, 9): 1.5, (9, 15): 0.25, (15, 16): 10}, {21: 0.75}),
])  # fmt: skip
def test_limits_and_tangents_survive_a_step_at_boundaries_creases_darts_and_corners(
    scheme: Scheme, rule: Boundary, creases: dict[tuple[int, int], float], corners: dict[int, float]
) -> None:
    faces = notched() if scheme in QUAD_SCHEMES else halved(notched())
    t = Topology.from_faces(faces, boundary=rule, creases=creases, corners=corners)
    step, V = scheme.step(t), t.n_vertices
    S = step.matrix.toarray()
    coarse, fine = (limit(scheme, mesh).assemble().toarray() for mesh in (t, step.topology))
    assert np.abs(fine[:V] @ S - coarse).max() < 1e-12
    assert np.abs(coarse.sum(axis=1) - 1).max() < 1e-12
    for before, after in zip(tangents(scheme, t), tangents(scheme, step.topology), strict=True):  # type: ignore[arg-type]
        row, image = before.assemble().toarray(), after.assemble().toarray()[:V] @ S
        assert np.abs(row.sum(axis=1)).max() < 1e-12
        size = (row**2).sum(axis=1)
        ratio = (row * image).sum(axis=1) / np.where(size > 0, size, 1)
        assert np.abs(image - ratio[:, None] * row).max() < 1e-12  # an eigenvector, or zero


def test_a_boundary_ends_at_two_thirds_and_two_sixths_and_a_pinned_corner_stays() -> None:
    t = shapes.quad_sheet(4).topology
    pinned = t.with_boundary(Boundary.EDGE_AND_CORNER)
    for v in np.flatnonzero(t.on_boundary):
        rim = [int(next(iter(e - {v}))) for e in naive.boundary_edges(t.loops()) if v in e]
        for scheme in QUAD_SCHEMES:
            crease = {int(v): Fraction(2, 3)} | dict.fromkeys(rim, Fraction(1, 6))
            assert dict(limit_stencil(scheme, t, int(v)).terms) == crease
            corner = {int(v): Fraction(1)} if t.valence[v] == 2 else crease
            assert dict(limit_stencil(scheme, pinned, int(v)).terms) == corner


@pytest.mark.parametrize("n", [3, 4, 5, 6, 7, 8])
def test_tangents_are_the_published_waves_and_shrink_by_lambda(n: int) -> None:
    for scheme in LECTURE:
        for wave, operator in zip((cos, sin), tangents(scheme, star(n, scheme)), strict=True):
            row = operator.assemble().toarray()[0]
            around = [wave(2 * pi * i / n) for i in range(n + 1)]
            if scheme in QUAD_SCHEMES:
                lam = quad_lambda(n)
                faces = [(around[i] + around[i + 1]) / (4 * lam - 1) for i in range(n)]
                expected = [0, *(4 * w for w in around[:n]), *faces]
            else:
                lam, expected = 3 / 8 + cos(2 * pi / n) / 4, [0, *around[:n]]
            if scheme is TRIANGLE_CENTROID and n == 3:
                assert not row.any()  # a tip has no tangent plane
                continue
            assert row == pytest.approx(np.array(expected), abs=1e-12)
            assert np.abs(row @ ring_matrix(scheme, n) - lam * row).max() < 1e-12


def test_across_a_regular_boundary_the_tangent_is_the_published_one() -> None:
    _, across = tangents(CATMULL_CLARK, shapes.quad_sheet(4).topology)
    row = across.assemble().toarray()[2]
    assert sorted(row[row != 0]) == pytest.approx([-4, -1, -1, 1, 1, 4], abs=1e-12)
    _, across = tangents(LOOP, shapes.triangle_sheet(4).topology)
    row = across.assemble().toarray()[2] / (sqrt(3) / 4)
    assert sorted(row[row != 0]) == pytest.approx([-2, -1, -1, 2, 2], abs=1e-12)


@schemes
def test_normals_are_those_of_deep_levels_and_point_outwards(scheme: Scheme) -> None:
    mesh = shapes.cube() if scheme in QUAD_SCHEMES else shapes.icosahedron()
    found = normals(mesh, scheme)
    assert np.abs(found - mesh.points / np.linalg.norm(mesh.points, axis=1, keepdims=True)).max() < 1e-12
    lopsided = Mesh(mesh.topology, mesh.points * (1, 2, 3) + mesh.points[:, [1, 2, 0]] ** 2 / 4)
    coarse, fine = normals(lopsided, scheme), normals(subdivide(lopsided, scheme, 2), scheme)
    assert np.abs(fine[: len(coarse)] - coarse).max() < 1e-9  # differences of close points cost digits
    assert np.abs(np.linalg.norm(coarse, axis=1) - 1).max() < 1e-12


def test_normals_of_a_flat_sheet_are_up_also_at_its_rim_and_its_corners() -> None:
    for rule in (Boundary.EDGE, Boundary.EDGE_AND_CORNER):
        for faces, scheme in ((notched(), CATMULL_CLARK), (halved(notched()), LOOP)):
            points = np.array([[i, j + i / 5, 0] for i in range(5) for j in range(6)], dtype=float)
            mesh = Mesh(Topology.from_faces(faces, 30, boundary=rule), points)
            used = mesh.topology.valence > 0
            assert normals(mesh, scheme)[used] == pytest.approx(np.tile([0, 0, 1], (used.sum(), 1)), abs=1e-12)


def test_there_is_no_normal_on_a_crease_inside_or_at_a_tip() -> None:
    assert not normals(shapes.tetrahedron(), TRIANGLE_CENTROID).any()
    assert normals(shapes.tetrahedron(), LOOP).any(axis=1).all()
    cubes = shapes.cube()
    loop = cubes.topology.loops()[0]
    ridge = {(loop[i], loop[i - 1]): 10.0 for i in range(4)}
    creased = Mesh(Topology.from_faces(cubes.topology.loops(), creases=ridge), cubes.points)
    assert set(np.flatnonzero(~normals(creased, CATMULL_CLARK).any(axis=1))) == set(loop)


def test_polygons_and_semi_sharp_edges_are_refined_before_their_limits_are_read() -> None:
    t = shapes.bipyramid(5).topology
    assert levels_to_settle(CATMULL_CLARK, t) == 1
    assert levels_to_settle(LOOP, t) == 0
    creased = Topology.from_faces(t.loops(), creases={(0, 5): 2.25}, corners={1: 0.5})
    assert levels_to_settle(LOOP, creased) == 3
    mesh = Mesh(creased, shapes.bipyramid(5).points)
    expected = limit_points(subdivide(mesh, LOOP, 3), LOOP)[:7]
    assert np.abs(limit_points(mesh, LOOP) - expected).max() < 1e-12
    assert sum(limit_stencil(CATMULL_CLARK, t, 0).weights) == pytest.approx(1, abs=1e-12)


def test_limits_that_would_take_too_many_faces_are_refused_with_numbers() -> None:
    t = Topology.from_faces(shapes.plus_sign().topology.loops(), creases={(0, 1): 9.5})
    numbers = f"takes 10 levels to wear off, which makes 31,457,280 faces.*{MOST_FACES:,}"
    with pytest.raises(TopologyError, match=numbers):
        limit(CATMULL_CLARK, t)


def test_the_literal_boundary_has_no_limit_rule() -> None:
    t = shapes.quad_sheet().topology.with_boundary(Boundary.LITERAL)
    for call in (limit, tangents):
        with pytest.raises(TopologyError, match="the sheet shrinks at every level"):
            call(QUAD_CENTROID, t)
    with pytest.raises(TopologyError, match="tells no tangents"):
        tangents(tensor_product(3, 3), Grid(4, 4))


@schemes
def test_limit_rows_are_exact_and_the_matrix_is_their_value(scheme: Scheme) -> None:
    make = (lambda: shapes.quad_bipyramid(5)) if scheme in QUAD_SCHEMES else (lambda: shapes.bipyramid(5))
    t = make().topology
    for operator in (limit(scheme, t), *tangents(scheme, t)):
        dense, applied = operator.assemble().toarray(), operator.apply(np.eye(t.n_vertices))
        exact: Floats = np.zeros_like(dense)
        for v in range(t.n_vertices):
            for parent, weight in operator.row(v).items():
                exact[v, parent] = float(weight)
        assert np.abs(exact - dense).max() < 1e-12
        assert np.abs(applied - dense).max() < 1e-12


def test_isolated_vertices_stay_where_they_are() -> None:
    t = Topology.from_faces([[0, 1, 2, 3]], 5)
    assert dict(limit_stencil(CATMULL_CLARK, t, 4).terms) == {4: 1}


def test_the_limit_mesh_of_a_net_is_the_smaller_net_of_its_limits() -> None:
    small = limit_mesh(shapes.net(5, 6), tensor_product(3, 3))
    assert small.topology.shape == (3, 4)
    assert limit_mesh(shapes.cube(), QUAD_CENTROID).topology.n_vertices == 8


def test_sines_cosines_and_formulas_add_and_multiply_as_numbers_do() -> None:
    for n in range(1, 13):
        for k in range(-n, 2 * n):
            assert float(cosine(n, k)) == pytest.approx(cos(2 * pi * k / n), abs=1e-14)
            assert float(sine(n, k)) == pytest.approx(sin(2 * pi * k / n), abs=1e-14)
    root = Formula("√2", sqrt(2))
    total = (cosine(5) * root + 3 - root / 2) * (root - cosine(5, 2)) ** 2
    expected = (cos(2 * pi / 5) * sqrt(2) + 3 - sqrt(2) / 2) * (sqrt(2) - cos(4 * pi / 5)) ** 2
    assert float(total) == pytest.approx(expected, abs=1e-12)
    assert root - root == 0
    assert str(root * 3) == "3·(√2)"
    assert str(cosine(5, 2)) == "1 cos(4π/5)"

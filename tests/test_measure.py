"""Angles, distances and counts, beside the lecture's table and what one can count by hand."""

import numpy as np
import pytest

from subdivision import Grid, Mesh, Scheme, Topology, TopologyError, shapes, subdivide, trace
from subdivision.arrays import Floats
from subdivision.measure import angle_sum, counts, edges_apart, largest_distance, largest_gap, normal_spread
from subdivision.schemes import CATMULL_CLARK, LOOP, LOOP_WARREN, QUAD_CENTROID, TRIANGLE_CENTROID
from subdivision.shapes import build

SPREAD = [  # largest angle between face normals at the pole of a bipyramid, level by level
    (shapes.bipyramid, 3, TRIANGLE_CENTROID, [101.5, 101.5, 101.5, 101.5, 101.5]),
    (shapes.bipyramid, 3, LOOP, [101.5, 45.6, 12.3, 3.1, 0.8]),
    (shapes.bipyramid, 3, LOOP_WARREN, [101.5, 45.6, 12.3, 3.1, 0.8]),
    (shapes.bipyramid, 4, TRIANGLE_CENTROID, [109.5, 86.6, 64.3, 45.5, 31.2]),
    (shapes.bipyramid, 4, LOOP, [109.5, 55.9, 22.5, 8.5, 3.2]),
    (shapes.quad_bipyramid, 3, QUAD_CENTROID, [101.5, 82.6, 61.0, 41.3, 26.4]),
    (shapes.quad_bipyramid, 3, CATMULL_CLARK, [101.5, 30.1, 13.4, 5.6, 2.3]),
    (shapes.quad_bipyramid, 5, QUAD_CENTROID, [95.4, 49.7, 23.1, 10.5, 4.8]),
    (shapes.quad_bipyramid, 5, CATMULL_CLARK, [95.4, 66.8, 42.6, 25.8, 15.3]),
]


@pytest.mark.parametrize(("shape", "n", "scheme", "expected"), SPREAD, ids=[f"{s.name}-{n}" for _, n, s, _ in SPREAD])
def test_the_normals_at_a_pole_spread_as_in_the_table(shape, n: int, scheme: Scheme, expected: list[float]) -> None:
    for level, angle in enumerate(expected):
        assert normal_spread(subdivide(shape(n), scheme, level), n) == pytest.approx(angle, abs=0.051)


def test_the_normals_of_a_plane_do_not_spread_and_those_of_a_cube_stand_square() -> None:
    flat = Mesh(Grid(3, 3), np.array([(x, y, 0.0) for x in range(3) for y in range(3)]))
    assert normal_spread(flat, 4) == 0
    assert [normal_spread(shapes.cube(), v) for v in range(8)] == pytest.approx([90] * 8, abs=1e-12)


@pytest.mark.parametrize(("mesh", "degrees"), [
    (shapes.cube(), 270), (shapes.tetrahedron(), 180), (shapes.octahedron(), 240), (shapes.icosahedron(), 300),
])  # fmt: skip
def test_the_corners_of_a_regular_solid_add_up_to_valence_times_one_corner(mesh: Mesh, degrees: float) -> None:
    n = len(mesh.points)
    assert [angle_sum(mesh, v) for v in range(n)] == pytest.approx([degrees] * n, abs=1e-11)


def test_all_that_the_angles_of_a_closed_mesh_of_triangles_lack_is_two_turns_for_each_euler_characteristic() -> None:
    """Descartes: 360 degrees less the angle sum, over all vertices, is 360 times V - E + F."""
    for mesh in (shapes.bipyramid(7), shapes.triangle_torus(), subdivide(shapes.octahedron(), LOOP, 2)):
        lacking = sum(360 - angle_sum(mesh, v) for v in range(len(mesh.points)))
        assert lacking == pytest.approx(360 * counts(mesh.topology).euler, abs=1e-8)


def test_angles_are_those_of_mixed_faces_and_of_nets_too() -> None:
    house = build.mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, -1, 0)], [[0, 1, 2, 3], [0, 4, 1]])
    assert angle_sum(house, 0) == pytest.approx(90 + np.degrees(np.arctan2(1, 0.5)), abs=1e-12)
    assert angle_sum(shapes.torus_net(), 0) == pytest.approx(angle_sum(shapes.torus(), 0), abs=1e-12)


def test_a_vertex_without_faces_is_told() -> None:
    for measure in (angle_sum, normal_spread):
        with pytest.raises(TopologyError, match="no face at vertex 2"):
            measure(shapes.polygon(), 2)


def test_points_that_fall_together_while_a_stage_plays_have_no_angle_and_raise_nothing() -> None:
    stacked = Mesh(Topology.from_faces([[0, 1, 2]]), np.zeros((3, 3)))
    assert angle_sum(stacked, 0) == normal_spread(stacked, 0) == 0


def test_the_largest_distance_is_that_of_the_point_that_moved_farthest() -> None:
    mesh = shapes.cube()
    assert largest_distance(mesh, mesh) == 0
    assert largest_distance(mesh, mesh.moved(7, mesh.points[7] + (3.0, 4.0, 0.0))) == pytest.approx(5, abs=1e-12)
    with pytest.raises(ValueError, match="8 points have no partners among 26"):
        largest_distance(mesh, subdivide(mesh, QUAD_CENTROID, 1))


def test_a_gap_asks_for_the_nearest_point_whatever_its_number() -> None:
    points: Floats = np.array([[0.0, 0, 0], [1, 0, 0], [4, 0, 0]])
    assert largest_gap(points[::-1], points) == 0
    assert largest_gap(points, points[:2]) == 3
    assert largest_gap(points[:2], points) == 0


def test_counts_are_those_of_the_lectures_table() -> None:
    assert counts(subdivide(shapes.cube(), QUAD_CENTROID, 3).topology) == (386, 768, 384, 2)
    assert counts(subdivide(shapes.triangle_sheet(4), TRIANGLE_CENTROID, 2).topology) == (289, 800, 512, 1)
    assert counts(shapes.polygon(5).topology) == (5, 4, 0, 1)


def test_edges_apart_counts_the_shortest_way() -> None:
    cube, corners = shapes.cube().topology, np.arange(8)
    bits = corners[:, None] ^ corners[None, :]  # vertices are in binary order
    assert np.array_equal(edges_apart(cube, corners), np.bitwise_count(bits))
    told = trace(QUAD_CENTROID, shapes.cube(), levels=3)
    nearest = [edges_apart(told.topology_at(told.begins(k)), corners)[0, 1] for k in range(4)]
    assert nearest == [1, 2, 4, 8]
    assert edges_apart(Topology.from_faces([[0, 1, 2], [3, 4, 5]]), np.array([0, 3]))[0, 1] == np.inf

"""Many alike polygons take a fast way to triangles: the same triangles, normals and colours as by the general one."""

from dataclasses import replace

import numpy as np
import pytest

from app.draw import regular
from app.draw.geometry import any_facets, facets, worn
from app.draw.picture import Faces
from subdivision import shapes, trace
from subdivision.rows import shown_faces
from subdivision.schemes import CATMULL_CLARK, LOOP, QUAD_CENTROID, TRIANGLE_CENTROID

CASES = {
    "smooth quads": (CATMULL_CLARK, "torus", 3),
    "creased quads": (QUAD_CENTROID, "cube", 3),
    "open quads": (QUAD_CENTROID, "quad-sheet", 3),
    "triangles": (LOOP, "icosahedron", 3),
    "creased triangles": (TRIANGLE_CENTROID, "bipyramid", 4),
}


def faces(name):
    scheme, shape, levels = CASES[name]
    told = trace(scheme, shapes.SHAPES[shape](), levels=levels)
    mesh = told.mesh_at(len(told.stages))
    colours = np.linspace(0, 1, 3 * len(mesh.points)).reshape(-1, 3)
    return Faces(mesh.points, *shown_faces(mesh.topology), (1.0, 1.0, 1.0), colours=colours)


def sorted_corners(polygons, cut):
    """Place, normal and colour of every corner of every triangle, in an order that is the same for both ways."""
    each = np.hstack([cut.points, cut.normals, worn(polygons, cut)])[cut.triangles]
    middle = np.round(each[:, :, :3].mean(axis=1), 9)
    return each[np.lexsort([*middle.T, cut.owner])], np.sort(cut.owner)


@pytest.mark.parametrize("name", CASES)
def test_the_fast_way_leads_to_the_same_triangles(name):
    polygons = faces(name)
    fast, slow = regular.facets(polygons), any_facets(polygons)
    (a, own), (b, owner) = sorted_corners(polygons, fast), sorted_corners(polygons, slow)
    assert np.array_equal(own, owner)
    assert np.abs(a - b).max() < 1e-12


def test_some_corners_of_a_creased_surface_have_a_point_of_their_own_and_most_share_one():
    polygons = faces("creased triangles")
    split = len(regular.facets(polygons).vertices) - len(polygons.points)
    assert 0 < split < 0.2 * len(polygons.corners)


def test_moved_points_keep_the_triangles_they_had():
    polygons = faces("smooth quads")
    moved = replace(polygons, points=1.1 * polygons.points)
    assert facets(moved).triangles is facets(polygons).triangles


def test_the_faces_of_a_topology_are_the_same_arrays_every_time():
    topology = shapes.SHAPES["quad-sheet"]().topology
    assert shown_faces(topology)[1] is shown_faces(topology)[1]


@pytest.mark.parametrize("k", range(4))
def test_a_quad_too_concave_for_its_middle_is_cut_from_its_reflex_corner(k):
    polygons = faces("open quads")
    points = polygons.points.copy()
    a, b, c, d = np.roll(polygons.corners[4 * 37 : 4 * 38], k)
    points[c] = 0.9 * points[a] + 0.05 * (points[b] + points[d])
    dart = replace(polygons, points=points)
    fast, slow = regular.facets(dart), any_facets(dart)
    cut = fast.owner == 37
    assert cut.sum() == 2
    assert {*fast.vertices[fast.triangles[cut]].ravel().tolist()} == {a, b, c, d}
    assert all(c in fast.vertices[row] for row in fast.triangles[cut])
    assert len(fast.triangles) == len(slow.triangles) < 4 * len(dart.sizes)
    (left, _), (right, _) = sorted_corners(dart, fast), sorted_corners(dart, slow)
    assert np.abs(left.mean(axis=1) - right.mean(axis=1)).max() < 1e-12


@pytest.mark.parametrize("name", CASES)
def test_in_haste_quads_are_two_triangles_with_the_same_normals_at_their_corners(name):
    polygons = faces(name)
    slow, hasty = regular.facets(polygons), regular.facets(polygons, is_hasty=True)
    size, n = polygons.sizes[0], len(slow.vertices)
    assert len(hasty.triangles) == (size - 2) * len(polygons.sizes)
    assert np.array_equal(hasty.points, slow.points[:n])
    assert np.array_equal(hasty.normals, slow.normals[:n])
    corners = hasty.vertices[hasty.triangles][np.argsort(hasty.owner, kind="stable")].reshape(len(polygons.sizes), -1)
    assert all({*a} == {*b} for a, b in zip(corners.tolist(), polygons.corners.reshape(-1, size).tolist(), strict=True))


def test_polygons_of_mixed_sizes_leave_the_fast_way():
    square, corner = np.array([4, 3]), np.array([0, 1, 2, 3, 0, 1, 2])
    assert regular.facets(Faces(np.eye(4, 3), square, corner, (1.0, 1.0, 1.0))) is None

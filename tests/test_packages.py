"""Loop subdivision by two independent packages: trimesh in double precision, VTK in single."""

from collections.abc import Callable

import numpy as np
import pytest
import pyvista as pv
import trimesh
from scipy.spatial import KDTree

from subdivision import Mesh, shapes, subdivide
from subdivision.arrays import Floats
from subdivision.schemes import LOOP, TRIANGLE_CENTROID

CLOSED = {
    "tetrahedron": shapes.tetrahedron,
    "octahedron": shapes.octahedron,
    "icosahedron": shapes.icosahedron,
    "bipyramid": shapes.bipyramid,
    "torus": shapes.triangle_torus,
}


def assert_same_points(ours: Floats, theirs: Floats, tolerance: float) -> None:
    assert len(ours) == len(theirs)
    distance, nearest = KDTree(theirs).query(ours)
    assert sorted(nearest) == list(range(len(theirs)))
    assert distance.max() < tolerance


def by_vtk(mesh: Mesh, levels: int) -> Floats:
    faces = np.insert(mesh.topology.origin.reshape(-1, 3), 0, 3, axis=1).ravel()
    return np.array(pv.PolyData(mesh.points.copy(), faces).subdivide(levels, "loop").points, dtype=float)


@pytest.mark.parametrize("make", CLOSED.values(), ids=CLOSED)
def test_closed_meshes_are_those_of_trimesh(make: Callable[[], Mesh]) -> None:
    mesh = make()
    points, _ = trimesh.remesh.subdivide_loop(mesh.points, mesh.topology.origin.reshape(-1, 3), iterations=2)
    assert_same_points(subdivide(mesh, LOOP, 2).points, points, 1e-12)


@pytest.mark.parametrize("make", [*CLOSED.values(), shapes.triangle_sheet], ids=[*CLOSED, "sheet"])
def test_meshes_are_those_of_vtk_to_single_precision_boundaries_included(make: Callable[[], Mesh]) -> None:
    mesh = make()
    assert_same_points(subdivide(mesh, LOOP, 2).points, by_vtk(mesh, 2), 2e-6)


def test_centroid_averaging_is_vtks_loop_only_where_every_valence_is_six() -> None:
    torus, octahedron = shapes.triangle_torus(), shapes.octahedron()
    assert_same_points(subdivide(torus, TRIANGLE_CENTROID, 2).points, by_vtk(torus, 2), 2e-6)
    distance, _ = KDTree(by_vtk(octahedron, 1)).query(subdivide(octahedron, TRIANGLE_CENTROID, 1).points)
    assert distance.max() > 0.01

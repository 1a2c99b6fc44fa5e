"""The Sierpinski triangle: three contractions, no search, and no smoothness."""

import numpy as np
import pytest

from subdivision import Mesh, Role, TopologyError, shapes, trace
from subdivision.arrays import Floats
from subdivision.fractal import SIERPINSKI, separate_triangles

CORNERS = np.array([[0.0, 0, 0], [1, 0, 0], [0.25, 1, 0]])
START = Mesh(separate_triangles(1), CORNERS)


def contracted(points: Floats) -> Floats:
    """The union of w_i(C) by its definition, copy after copy."""
    return np.concatenate([(points + corner) / 2 for corner in CORNERS])


def test_every_level_is_the_union_of_three_contractions_of_the_level_before() -> None:
    told = trace(SIERPINSKI, START, levels=6)
    expected = CORNERS
    for level in range(1, 7):
        expected = contracted(expected)
        assert np.array_equal(told.points[told.begins(level)], expected)


def test_the_corners_stay_where_they_are_and_keep_their_arithmetic_number() -> None:
    told = trace(SIERPINSKI, START, levels=5)
    for level in range(6):
        points = told.points[told.begins(level)]
        assert np.array_equal(points[np.arange(3) * (len(points) - 1) // 2], CORNERS)


def test_copying_moves_nothing_and_contracting_brings_nothing() -> None:
    copy, contract = trace(SIERPINSKI, START).stages
    assert not copy.moves
    assert contract.moves
    assert not len(copy.born)
    assert not len(contract.born)
    assert set(contract.roles) == {Role.MOVED}
    assert [str(contract.stencil(k)) for k in (0, 1)] == ["1 v0", "1/2 v0 + 1/2 v1"]


def test_triangles_are_three_times_as_many_and_half_as_long_so_the_area_goes() -> None:
    told = trace(SIERPINSKI, START, levels=5)
    meshes = [told.mesh_at(told.begins(level)) for level in range(6)]
    areas = []
    for level, mesh in enumerate(meshes):
        a, b, c = mesh.points.reshape(-1, 3, 3).transpose(1, 0, 2)
        areas.append(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
        assert mesh.topology.n_faces == 3**level
        assert np.ptp(mesh.points[:3], axis=0) == pytest.approx(np.ptp(CORNERS, axis=0) / 2**level, abs=1e-15)
    assert areas == pytest.approx([areas[0] * 0.75**level for level in range(6)], abs=1e-15)


def test_rows_sum_to_one_and_triangles_share_no_vertex() -> None:
    told = trace(SIERPINSKI, START, levels=4)
    assert np.abs(told.whole.matrix.sum(axis=1) - 1).max() < 1e-12
    topology = told.whole.topology
    assert topology.n_vertices == 3 * topology.n_faces == topology.n_edges


@pytest.mark.parametrize("other", [shapes.octahedron(), shapes.polygon(3), shapes.net(3, 3)])
def test_what_is_no_level_of_the_iteration_is_refused(other: Mesh) -> None:
    with pytest.raises(TopologyError, match="not one triangle"):
        trace(SIERPINSKI, other)
    with pytest.raises(TopologyError, match="not one triangle"):
        trace(SIERPINSKI, Mesh(separate_triangles(2), np.zeros((6, 3))))

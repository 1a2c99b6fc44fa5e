"""STL and binary glTF, read back by other readers than wrote them."""

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh

from subdivision import Mesh, Topology, files, shapes, subdivide
from subdivision.files.triangles import triangles
from subdivision.schemes import CATMULL_CLARK, LOOP
from subdivision.shapes.build import mesh as built

RIM = [[np.cos(k * 2 * np.pi / 5), np.sin(k * 2 * np.pi / 5), 0.0] for k in range(5)]
PYRAMID = built([*RIM, [0.0, 0.0, 1.0]], [[4, 3, 2, 1, 0], *([k, (k + 1) % 5, 5] for k in range(5))])

MESHES = {
    "triangles": shapes.icosahedron(), "quads": subdivide(shapes.cube(), CATMULL_CLARK, 2),
    "a pentagon": PYRAMID, "sheet": shapes.triangle_sheet(),
}  # fmt: skip
each = pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)


def glb(path: Path) -> tuple[dict, bytes]:
    """The table and the arrays of a file, by the words of its specification."""
    data = path.read_bytes()
    magic, version, length, size, kind = data[:4], *np.frombuffer(data, "<u4", 4, 4)
    assert (magic, version, length, kind) == (b"glTF", 2, len(data), 0x4E4F534A)
    arrays, word = np.frombuffer(data, "<u4", 2, 20 + int(size))
    assert (word, 28 + int(size) + int(arrays)) == (0x004E4942, len(data))
    return json.loads(data[20 : 20 + int(size)]), data[28 + int(size) :]


def read_array(table: dict, arrays: bytes, number: int) -> np.ndarray:
    accessor = table["accessors"][number]
    view = table["bufferViews"][accessor["bufferView"]]
    wide = {"VEC3": 3, "SCALAR": 1}[accessor["type"]]
    kind = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
    assert view["byteOffset"] % 4 == 0
    found = np.frombuffer(arrays, kind, accessor["count"] * wide, view["byteOffset"]).reshape(-1, wide)
    assert found.nbytes == view["byteLength"]
    return found


def volume(points: np.ndarray, cut: np.ndarray) -> float:
    a, b, c = (points[cut[:, k]] for k in range(3))
    return float((np.cross(a, b) * c).sum() / 6)


@each
def test_triangles_are_turned_as_the_faces_were_and_leave_no_gap(mesh: Mesh) -> None:
    points, cut = triangles(mesh)
    sizes = mesh.topology.face_sizes
    assert len(cut) == np.where(sizes > 4, sizes, sizes - 2).sum()
    edges = [tuple(edge) for t in cut for edge in zip(t, np.roll(t, -1), strict=True)]
    assert len(set(edges)) == len(edges)  # no edge is walked twice in the same direction
    assert all(edge[::-1] in set(edges) for edge in edges) == (not mesh.topology.boundary.any())
    assert set(cut.ravel()) == set(range(len(points)))


@each
def test_an_stl_file_read_back_has_the_same_triangles(tmp_path: Path, mesh: Mesh) -> None:
    files.write(tmp_path / "m.stl", mesh)
    points, cut = triangles(mesh)
    ours, theirs = files.read(tmp_path / "m.stl"), trimesh.load(tmp_path / "m.stl")
    assert isinstance(ours.topology, Topology)
    assert np.abs(ours.points[ours.topology.origin.reshape(-1, 3)] - points[cut]).max() < 1e-6
    assert len(theirs.faces) == len(cut)
    across = trimesh.Trimesh(points, cut, process=False).face_normals
    assert np.abs(theirs.face_normals - across).max() < 1e-5


@each
def test_a_glb_file_holds_what_its_table_says(tmp_path: Path, mesh: Mesh) -> None:
    files.write(tmp_path / "m.glb", mesh)
    table, arrays = glb(tmp_path / "m.glb")
    points, cut = triangles(mesh)
    assert table["asset"]["version"] == "2.0"
    assert table["buffers"] == [{"byteLength": len(arrays)}]
    there, across, corners = (read_array(table, arrays, k) for k in range(3))
    assert np.array_equal(there, points.astype("f4"))
    assert np.array_equal(corners.reshape(-1, 3), cut)
    assert np.abs(np.linalg.norm(across, axis=1) - 1).max() < 1e-6
    assert table["accessors"][0]["min"] == there.min(axis=0).tolist()
    assert table["accessors"][0]["max"] == there.max(axis=0).tolist()


def test_up_is_up_in_a_glb_and_the_normals_of_a_ball_point_away_from_its_middle(tmp_path: Path) -> None:
    mesh = subdivide(shapes.icosahedron(), LOOP, 2)
    files.write(tmp_path / "m.glb", mesh)
    table, arrays = glb(tmp_path / "m.glb")
    x, y, z, w = table["nodes"][0]["rotation"]
    up = np.array([2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)])  # of the z axis
    assert np.abs(up - [0, 1, 0]).max() < 1e-12
    points, across = read_array(table, arrays, 0), read_array(table, arrays, 1)
    assert ((points * across).sum(axis=1) > 0.9 * np.linalg.norm(points, axis=1)).all()


def test_another_reader_of_glb_finds_the_same_body(tmp_path: Path) -> None:
    mesh = MESHES["quads"]
    files.write(tmp_path / "m.glb", mesh)
    (theirs,) = trimesh.load(tmp_path / "m.glb").geometry.values()
    assert theirs.is_watertight
    assert theirs.volume == pytest.approx(volume(*triangles(mesh)), rel=1e-6)

"""Counts by hand, valences and orientation of the control objects; and the papers that docstrings cite."""

import re
from collections import Counter
from collections.abc import Callable
from itertools import pairwise, product
from pathlib import Path

import numpy as np
import pytest

from subdivision import Grid, Mesh, Polyline, Scheme, Topology, TopologyError, shapes, subdivide
from subdivision.schemes import (
    CATMULL_CLARK,
    LOOP,
    SCHEMES,
    THREE_DIRECTION_QUARTIC,
    box_spline,
    lane_riesenfeld,
    tensor_product,
)

ROOT = Path(__file__).parent.parent

# V, E, F at levels 0 to 4: counted on paper, not by the engine
COUNTS = {
    "cube": [(8, 12, 6), (26, 48, 24), (98, 192, 96), (386, 768, 384), (1538, 3072, 1536)],
    "plus-sign": [(32, 60, 30), (122, 240, 120), (482, 960, 480), (1922, 3840, 1920), (7682, 15360, 7680)],
    "torus": [(20, 40, 20), (80, 160, 80), (320, 640, 320), (1280, 2560, 1280), (5120, 10240, 5120)],
    "quad-sheet": [(25, 40, 16), (81, 144, 64), (289, 544, 256), (1089, 2112, 1024), (4225, 8320, 4096)],
    "tetrahedron": [(4, 6, 4), (10, 24, 16), (34, 96, 64), (130, 384, 256), (514, 1536, 1024)],
    "octahedron": [(6, 12, 8), (18, 48, 32), (66, 192, 128), (258, 768, 512), (1026, 3072, 2048)],
    "icosahedron": [(12, 30, 20), (42, 120, 80), (162, 480, 320), (642, 1920, 1280), (2562, 7680, 5120)],
    "triangle-sheet": [(25, 56, 32), (81, 208, 128), (289, 800, 512), (1089, 3136, 2048), (4225, 12416, 8192)],
}

VALENCES = {
    "cube": {3: 8},
    "plus-sign": {3: 24, 6: 8},
    "torus": {4: 20},
    "quad-bipyramid": {3: 10, 4: 20, 5: 2},
    "tetrahedron": {3: 4},
    "octahedron": {4: 6},
    "icosahedron": {5: 12},
    "bipyramid": {4: 8, 8: 2},
    "triangle-torus": {6: 20},
    "duck": {3: 26, 4: 40, 5: 10, 6: 4},
    "mug": {3: 8, 4: 86, 5: 8},
    "pawn": {3: 8, 4: 82},
}

EULER = dict.fromkeys(VALENCES, 2) | {"torus": 0, "triangle-torus": 0, "mug": 0}

FRAGMENTS: dict[str, Callable[[], Mesh]] = {
    "a quad and its ring": shapes.face_and_ring,
    "six quads": shapes.quad_fan,
    "two triangles and their ring": shapes.two_triangles_and_ring,
    "eight triangles": shapes.triangle_fan,
}

MAKERS = {**shapes.SHAPES, **FRAGMENTS}

everything = pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
closed = pytest.mark.parametrize("name", VALENCES)
valences = pytest.mark.parametrize("n", [3, 4, 5, 6, 8, 12])


def natural_scheme(mesh: Mesh) -> Scheme:
    if isinstance(mesh.topology, Polyline):
        return lane_riesenfeld(3)
    if isinstance(mesh.topology, Grid):
        return box_spline(THREE_DIRECTION_QUARTIC) if mesh.topology.diagonal else tensor_product(3, 3)
    return LOOP if mesh.topology.is_triangular else CATMULL_CLARK


def volume(mesh: Mesh) -> float:
    """A sixth of the sum of the determinants of fan triangles: positive if faces are counter-clockwise from outside."""
    total = 0.0
    for loop in mesh.surface.loops():
        corners = mesh.points[loop]
        for b, c in pairwise(corners[1:]):
            total += float(corners[0] @ np.cross(b, c)) / 6
    return total


def flatness(mesh: Mesh) -> float:
    """The smallest extent of any face: 0 where all are planar."""
    return max(
        float(np.linalg.svd(mesh.points[loop] - mesh.points[loop].mean(axis=0), compute_uv=False)[-1])
        for loop in mesh.surface.loops()
    )


def counts(t: Topology) -> tuple[int, int, int]:
    return t.n_vertices, t.n_edges, t.n_faces


@pytest.mark.parametrize("name", COUNTS)
def test_counts_by_level_are_those_of_the_table(name: str) -> None:
    mesh = shapes.SHAPES[name]()
    for expected in COUNTS[name]:
        assert counts(mesh.surface) == expected
        mesh = subdivide(mesh, natural_scheme(mesh), 1)


@closed
def test_valences_are_those_promised(name: str) -> None:
    assert Counter(shapes.SHAPES[name]().surface.valence.tolist()) == VALENCES[name]


@closed
def test_closed_meshes_have_no_boundary_and_the_euler_number_of_their_genus(name: str) -> None:
    t = shapes.SHAPES[name]().surface
    assert not t.boundary.any()
    assert t.euler == EULER[name]


@closed
def test_faces_are_counter_clockwise_from_outside_at_every_level(name: str) -> None:
    mesh = shapes.SHAPES[name]()
    assert volume(mesh) > 0
    assert volume(subdivide(mesh, natural_scheme(mesh), 2)) > 0


@everything
def test_open_meshes_look_up(make: Callable[[], Mesh]) -> None:
    mesh = make()
    if isinstance(mesh.topology, Topology) and mesh.surface.boundary.any():
        for loop in mesh.surface.loops():
            a, b, c = mesh.points[loop[:3]]
            assert np.cross(b - a, c - a)[2] > 0


@everything
def test_points_are_distinct_and_of_about_unit_size(make: Callable[[], Mesh]) -> None:
    points = make().points
    gaps = np.linalg.norm(points[:, None] - points[None], axis=2) + np.eye(len(points))
    assert gaps.min() > 0.05
    assert 0.95 <= np.linalg.norm(points, axis=1).max() <= 1.8


@everything
def test_shapes_are_centred(make: Callable[[], Mesh]) -> None:
    points = make().points
    box, mean = (points.min(axis=0) + points.max(axis=0)) / 2, points.mean(axis=0)
    assert min(np.linalg.norm(box), np.linalg.norm(mean)) < 0.15


@everything
def test_the_natural_scheme_subdivides_twice(make: Callable[[], Mesh]) -> None:
    mesh = make()
    fine = subdivide(mesh, natural_scheme(mesh), 2)
    assert fine.topology.n_edges > mesh.topology.n_edges
    assert np.isfinite(fine.points).all()
    assert abs(fine.points).max() <= abs(mesh.points).max() + 1e-12, "averages stay in the box"


@pytest.mark.parametrize("name", ["cube", "plus-sign", "torus", "quad-bipyramid"])
def test_faces_of_the_simple_quad_meshes_are_planar(name: str) -> None:
    assert flatness(shapes.SHAPES[name]()) < 1e-12


def test_the_sheet_is_not_planar() -> None:
    assert flatness(shapes.quad_sheet()) > 0.01


def test_cube_vertices_are_numbered_in_binary() -> None:
    assert shapes.cube().points.tolist() == [list(p) for p in product((-1, 1), repeat=3)]


@valences
def test_a_quad_fan_has_one_vertex_of_valence_n(n: int) -> None:
    for rings in (1, 2, 3):
        t = shapes.quad_fan(n, rings).surface
        assert counts(t) == (1 + n * rings * (rings + 1), n * rings * (2 * rings + 1), n * rings**2)
        inner = t.valence[~t.on_boundary]
        assert inner[0] == n
        assert set(inner[1:]) <= {4}
        assert all(0 in loop for loop in t.loops()[:n]), "the fan comes first"
        assert (~t.on_boundary).sum() == 1 + n * rings * (rings - 1), "outer rings complete the inner ones"


@valences
def test_a_triangle_fan_has_one_vertex_of_valence_n(n: int) -> None:
    for rings in (1, 2, 3):
        t = shapes.triangle_fan(n, rings).surface
        assert counts(t) == (1 + n * rings * (rings + 1) // 2, n * rings * (3 * rings + 1) // 2, n * rings**2)
        inner = t.valence[~t.on_boundary]
        assert inner[0] == n
        assert set(inner[1:]) <= {6}
        assert all(0 in loop for loop in t.loops()[:n]), "the fan comes first"
        assert (~t.on_boundary).sum() == 1 + n * rings * (rings - 1) // 2, "outer rings complete the inner ones"


@pytest.mark.parametrize("fan", [shapes.quad_fan, shapes.triangle_fan])
def test_a_further_ring_changes_no_number_of_the_inner_ones(fan: Callable[[int, int], Mesh]) -> None:
    for rings in (1, 2):
        inner, outer = fan(5, rings).surface.loops(), fan(5, rings + 1).surface.loops()
        assert outer[: len(inner)] == inner


@valences
def test_bipyramids_have_poles_of_valence_n(n: int) -> None:
    t = shapes.bipyramid(n).surface
    assert counts(t) == (n + 2, 3 * n, 2 * n)
    assert t.valence.tolist() == [4] * n + [n, n]
    quads = shapes.quad_bipyramid(n).surface
    assert counts(quads) == (6 * n + 2, 12 * n, 6 * n)
    assert quads.valence[[n, n + 1]].tolist() == [n, n]


@pytest.mark.parametrize(("n", "m"), [(3, 3), (5, 4), (8, 5)])
def test_tori_are_regular_everywhere(n: int, m: int) -> None:
    assert counts(shapes.torus(n, m).surface) == (n * m, 2 * n * m, n * m)
    assert counts(shapes.triangle_torus(n, m).surface) == (n * m, 3 * n * m, 2 * n * m)
    assert not shapes.torus(n, m).surface.extraordinary.any()
    assert not shapes.triangle_torus(n, m).surface.extraordinary.any()


def test_the_middle_quad_has_all_its_faces() -> None:
    t = shapes.face_and_ring().surface
    assert counts(t) == (16, 24, 9)
    assert sorted(t.loops()[0]) == [0, 1, 2, 3]
    assert not t.on_boundary[:4].any()
    assert t.valence[:4].tolist() == [4, 4, 4, 4]
    assert np.array_equal(t.on_boundary[4:], np.ones(12, dtype=bool))


def test_the_middle_triangles_have_all_their_faces() -> None:
    t = shapes.two_triangles_and_ring().surface
    assert counts(t) == (14, 29, 16)
    assert [sorted(loop) for loop in t.loops()[:2]] == [[0, 1, 2], [0, 2, 3]]
    assert not t.on_boundary[:4].any()
    assert t.valence[:4].tolist() == [6, 6, 6, 6]


@pytest.mark.parametrize("fan", [shapes.quad_fan, shapes.triangle_fan])
def test_a_fan_of_two_is_refused(fan: Callable[[int], Mesh]) -> None:
    with pytest.raises(TopologyError, match="three faces and one ring or more, not 2 faces"):
        fan(2)


def test_nets_are_not_flat_and_have_no_accidental_symmetry() -> None:
    z = shapes.net(5, 5).points[:, 2].reshape(5, 5)
    assert np.ptp(z[1:-1, 1:-1]) > 0.3
    for mirrored in (z[::-1], z[:, ::-1], z[::-1, ::-1], z.T):
        assert abs(z - mirrored).mean() > 0.05


def test_nets_subdivide_at_the_size_that_just_makes_a_surface() -> None:
    assert subdivide(shapes.net(4, 4), tensor_product(3, 3), 3).topology == Grid(11, 11)
    quartic = box_spline(THREE_DIRECTION_QUARTIC)
    assert subdivide(shapes.net(4, 4, diagonal=True), quartic, 3).topology == Grid(11, 11, diagonal=True)


@pytest.mark.parametrize("n", range(4, 9))
def test_polygons_lie_in_the_plane(n: int) -> None:
    for made in (shapes.polygon(n), shapes.closed_polygon(n)):
        assert made.topology.n_vertices == n
        assert not made.points[:, 2].any()


def test_the_duck_is_symmetric() -> None:
    points = shapes.duck().points
    mirrored = points * (1, -1, 1)
    assert np.linalg.norm(points[:, None] - mirrored[None], axis=2).min(axis=1).max() < 1e-12


def test_creases_of_the_pawn_wear_off_but_for_its_foot() -> None:
    pawn = shapes.pawn()
    assert Counter(pawn.surface.edge_sharpness.tolist()) == {0: 136, 10: 8, 3: 16, 2: 8, 1: 8}
    fine = subdivide(pawn, CATMULL_CLARK, 3).surface
    assert Counter(fine.edge_sharpness[fine.edge_sharpness > 0].tolist()) == {10: 8 * 2**3}


def test_every_function_of_the_package_is_in_the_menu_or_a_fragment_or_a_star() -> None:
    made = {name.replace("-", "_") for name in shapes.SHAPES}
    fragments = {"face_and_ring", "two_triangles_and_ring"}
    stars = {"quad_star", "triangle_star", "dome"}  # for stencils: tested with their figures
    assert set(shapes.__all__) - {"SHAPES"} <= made | fragments | stars


def test_every_paper_cited_has_an_entry() -> None:
    entries = set(re.findall(r"^@\w+\{(\w+),", (ROOT / "assets" / "references.bib").read_text(), re.MULTILINE))
    cited = {scheme.paper for scheme in (*SCHEMES, lane_riesenfeld(3), tensor_product(3, 3))}
    cited.add(box_spline(THREE_DIRECTION_QUARTIC).paper)
    for folder in ("subdivision", "lessons", "app"):
        for file in (ROOT / folder).rglob("*.py"):
            cited |= set(re.findall(r"\[([A-Z][A-Za-z]*\d{2})\]_", file.read_text()))
    assert cited <= entries

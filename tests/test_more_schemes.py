"""Schemes beyond the lecture: every one beside a known mask, a tensor product, or loops written without the engine."""

from collections.abc import Callable
from fractions import Fraction
from math import cos, pi

import numpy as np
import pytest
from test_meshes import double_torus

from subdivision import Boundary, Grid, Mesh, Polyline, Scheme, Topology, TopologyError, shapes, subdivide
from subdivision.arrays import Floats
from subdivision.limit import limit_points
from subdivision.rows import Connectivity
from subdivision.schemes import LECTURE, SCHEMES, ZWART_POWELL, box_spline, lane_riesenfeld, tensor_product
from subdivision.schemes.chaikin import CHAIKIN
from subdivision.schemes.doo_sabin import DOO_SABIN, DOO_SABIN_MEAN
from subdivision.schemes.four_point import Ends, four_point
from subdivision.schemes.kobbelt import KOBBELT, edge_points, face_points, kobbelt
from subdivision.schemes.mid_edge import MID_EDGE
from subdivision.schemes.modified_butterfly import MODIFIED_BUTTERFLY
from subdivision.schemes.sqrt3 import SQRT3
from subdivision.spectrum import ring, stencil_by_valence

POLYGONS = [Polyline(7), Polyline(6, closed=True), Polyline(3, closed=True), Polyline(11)]
REFLECTED = four_point(ends=Ends.REFLECTED)
CURVES = [CHAIKIN, four_point(), REFLECTED, four_point(Fraction(1, 10)), four_point(0.1, Ends.REFLECTED)]
curves = pytest.mark.parametrize("scheme", CURVES, ids=lambda s: s.name)
polygons = pytest.mark.parametrize("polygon", POLYGONS, ids=str)


def positions(n: int) -> Floats:
    return np.random.default_rng(n).normal(size=(n, 3))


def dense(scheme: Scheme, t: Connectivity, telling: str | None = None) -> Floats:
    return scheme.step(t, telling).matrix.toarray()


def assert_all_readings_agree(scheme: Scheme, t: Connectivity) -> None:
    """Rows sum to one; tellings multiply to one matrix; applied, assembled and exact readings are the same."""
    first = dense(scheme, t)
    points = positions(t.n_vertices)
    for telling in scheme.tellings:
        step = scheme.step(t, telling)
        matrix = step.matrix.toarray()
        assert matrix.shape == first.shape == (step.topology.n_vertices, t.n_vertices)
        assert np.abs(matrix - first).max() < 1e-12
        assert np.abs(matrix.sum(axis=1) - 1).max() < 1e-12
        assert np.abs(step.apply(points) - matrix @ points).max() < 1e-12
        for stage in step.stages:
            assert len(stage.carries) == len(stage.roles) == stage.n_points >= stage.topology.n_vertices
            kept = stage.carries[stage.carries >= 0]
            assert kept.max(initial=0) < stage.operator.shape[1]
        for point in range(0, len(matrix), 7):
            stencil = step.stencil(point)
            row = np.zeros(t.n_vertices)
            row[stencil.parents] = stencil.weights
            assert np.abs(row - matrix[point]).max() < 1e-12


@curves
@polygons
def test_every_telling_of_a_curve_is_the_same_matrix(scheme: Scheme, polygon: Polyline) -> None:
    assert_all_readings_agree(scheme, polygon)


@polygons
def test_cutting_corners_at_the_quarters_is_averaging_twice(polygon: Polyline) -> None:
    assert np.abs(dense(CHAIKIN, polygon) - dense(lane_riesenfeld(2), polygon)).max() < 1e-15
    assert CHAIKIN.step(polygon).topology == lane_riesenfeld(2).step(polygon).topology


@curves
@polygons
def test_a_polygon_read_backwards_makes_the_same_curve_backwards(scheme: Scheme, polygon: Polyline) -> None:
    there, back = dense(scheme, polygon), dense(scheme, polygon)[::-1, ::-1]
    if polygon.closed:  # the last edge comes first then; turn it back
        turns = (np.abs(there - np.roll(back, k, axis=0)).max() for k in range(len(there)))
        assert min(turns) < 1e-12
    else:
        assert np.abs(there - back).max() < 1e-12


@polygons
@pytest.mark.parametrize("w", [Fraction(1, 16), Fraction(1, 10), Fraction(0)])
def test_the_four_point_scheme_is_its_loop_over_edges(polygon: Polyline, w: Fraction) -> None:
    n = polygon.n_vertices
    P = np.eye(n)
    if polygon.closed:
        rows = [row for i in range(n) for row in (P[i], rule(*(P[(i + k) % n] for k in (-1, 0, 1, 2)), w=float(w)))]
    else:
        rows = [row for i in range(1, n - 2) for row in (P[i], rule(*P[i - 1 : i + 3], w=float(w)))] + [P[n - 2]]
        Q = np.concatenate([[2 * P[0] - P[1]], P, [2 * P[-1] - P[-2]]])
        both = [row for i in range(n - 1) for row in (P[i], rule(*Q[i : i + 4], w=float(w)))] + [P[-1]]
        assert np.abs(dense(four_point(w, Ends.REFLECTED), polygon) - np.array(both)).max() < 1e-12
    assert np.abs(dense(four_point(w), polygon) - np.array(rows)).max() < 1e-12


def rule(a: Floats, b: Floats, c: Floats, d: Floats, w: float) -> Floats:
    return (1 / 2 + w) * (b + c) - w * (a + d)


def test_at_a_sixteenth_points_of_a_cubic_stay_on_it_and_otherwise_of_a_line_only() -> None:
    x = np.arange(9.0)
    finer = np.arange(1, 7.25, 0.5)
    for degree in range(6):
        off = np.abs(dense(four_point(), Polyline(9)) @ x**degree - finer**degree).max()
        assert (off < 1e-10) == (degree <= 3)
        off = np.abs(dense(four_point(Fraction(1, 10)), Polyline(9)) @ x**degree - finer**degree).max()
        assert (off < 1e-10) == (degree <= 1)


def test_the_four_point_curve_goes_through_its_points_and_from_end_to_end_if_reflected() -> None:
    mesh = Mesh(Polyline(8), positions(8))
    fine = subdivide(mesh, REFLECTED, 4)
    assert np.abs(fine.points[::16] - mesh.points).max() < 1e-15
    assert np.abs(limit_points(fine, REFLECTED) - fine.points).max() == 0
    fine = subdivide(mesh, four_point(), 4)
    assert len(fine.points) == 2**4 * (8 - 5) + 5
    assert np.abs(limit_points(mesh, four_point()) - mesh.points[2:-2]).max() == 0


def test_four_points_are_too_few_to_grow_and_a_mesh_is_no_polygon() -> None:
    with pytest.raises(TopologyError, match="at least 6 points"):
        four_point().step(Polyline(5))
    with pytest.raises(TopologyError, match="at least 2 points"):
        REFLECTED.step(Polyline(1))
    for scheme in CURVES:
        with pytest.raises(TopologyError, match="not a polygon"):
            scheme.step(shapes.cube().topology)


def literal(mesh: Mesh) -> Mesh:
    return Mesh(mesh.surface.with_boundary(Boundary.LITERAL), mesh.points)


def prism(n: int) -> Mesh:
    """Two n-gons and n quads."""
    faces = [[*range(n)][::-1], [*range(n, 2 * n)], *([k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n))]
    return Mesh(Topology.from_faces(faces), positions(2 * n))


CLOSED: dict[str, Callable[[], Mesh]] = {
    "cube": shapes.cube, "tetrahedron": shapes.tetrahedron, "prism 5": lambda: prism(5), "prism 7": lambda: prism(7),
    "torus": shapes.torus, "triangle torus": shapes.triangle_torus, "double torus": double_torus,
    "bipyramid 8": lambda: shapes.bipyramid(8), "quads of valence 5": lambda: shapes.quad_bipyramid(5),
    "icosahedron": shapes.icosahedron,
}  # fmt: skip
OPEN: dict[str, Callable[[], Mesh]] = {
    "sheet": shapes.quad_sheet, "triangles": shapes.triangle_sheet, "fan": shapes.quad_fan,
    "triangle fan": shapes.triangle_fan,
}  # fmt: skip
DUAL = [DOO_SABIN, DOO_SABIN_MEAN, MID_EDGE]
closed = pytest.mark.parametrize("make", CLOSED.values(), ids=CLOSED)
opened = pytest.mark.parametrize("make", OPEN.values(), ids=OPEN)
dual = pytest.mark.parametrize("scheme", DUAL, ids=lambda s: s.name)
corner = pytest.mark.parametrize("scheme", [DOO_SABIN, DOO_SABIN_MEAN], ids=lambda s: s.name)


def same_points(a: Floats, b: Floats) -> bool:
    gaps = np.linalg.norm(a[:, None] - b[None], axis=2)
    return len(a) == len(b) and gaps.min(axis=0).max() < 1e-12 and gaps.min(axis=1).max() < 1e-12


def assert_well_made(t: Topology) -> None:
    """The half-edges are those that would be found by searching the faces."""
    built = Topology.from_faces(t.loops(), t.n_vertices)
    assert np.array_equal(t.twin, built.twin)
    assert np.array_equal(t.next, built.next)
    assert np.array_equal(t.face, built.face)
    assert np.array_equal(t.valence, built.valence)
    assert t.n_edges == built.n_edges == len(set(t.edge.tolist()))
    inner = t.twin >= 0
    assert np.array_equal(t.edge[inner], t.edge[t.twin[inner]])


def assert_relabelling_commutes(scheme: Scheme, mesh: Mesh) -> None:
    """Other numbers, turned loops and faces in another order: the same vertices and faces in the end."""
    rng = np.random.default_rng(1)
    t = mesh.surface
    new = rng.permutation(t.n_vertices)
    loops = [np.roll(new[loop], rng.integers(9)).tolist() for loop in t.loops()]
    order = rng.permutation(len(loops))
    other = Topology.from_faces([loops[k] for k in order], t.n_vertices)
    literal = not (t.edge_sharpness[t.boundary] > 0).any()
    other = other.with_boundary(Boundary.LITERAL) if literal else other
    points = np.empty_like(mesh.points)
    points[new] = mesh.points
    ours, theirs = subdivide(mesh, scheme, 2), subdivide(Mesh(other, points), scheme, 2)
    assert same_points(ours.points, theirs.points)
    assert same_points(*(np.array([m.points[loop].mean(axis=0) for loop in m.surface.loops()]) for m in (ours, theirs)))


def spread(mesh: Mesh) -> Mesh:
    """The same mesh at random places, no two of them alike."""
    return Mesh(mesh.topology, positions(mesh.topology.n_vertices))


@dual
@closed
def test_every_telling_of_a_dual_scheme_is_the_same_matrix(scheme: Scheme, make: Callable[[], Mesh]) -> None:
    assert_all_readings_agree(scheme, make().topology)
    assert_all_readings_agree(scheme, subdivide(make(), scheme, 1).topology)
    assert dense(scheme, make().topology).min() >= -1e-15
    assert_relabelling_commutes(scheme, spread(make()))


@corner
@opened
def test_doo_sabin_of_an_open_mesh_tells_the_same_too(scheme: Scheme, make: Callable[[], Mesh]) -> None:
    mesh = literal(make())
    assert_all_readings_agree(scheme, mesh.topology)
    assert_relabelling_commutes(scheme, spread(mesh))
    fine = mesh.surface
    for level in range(4):
        assert scheme.faces_after(mesh.surface, level) == fine.n_faces
        assert fine.euler == 1
        fine = scheme.step(fine).topology
        assert_well_made(fine)


@closed
def test_doo_sabin_counts_and_makes_a_face_of_every_face_edge_and_vertex(make: Callable[[], Mesh]) -> None:
    t = make().surface
    for level in range(4):
        V, E, F, sizes, valence = t.n_vertices, t.n_edges, t.n_faces, t.face_sizes, t.valence
        assert DOO_SABIN.faces_after(make().surface, level) == F
        t = DOO_SABIN.step(t).topology
        assert (t.n_vertices, t.n_edges, t.n_faces) == (2 * E, 4 * E, V + E + F)
        assert t.euler == make().surface.euler
        assert sorted(t.face_sizes) == sorted([*sizes, *[4] * E, *valence])
        assert set(t.valence) == {4}
        assert_well_made(t)


@closed
def test_mid_edge_counts_and_makes_a_face_of_every_face_and_vertex(make: Callable[[], Mesh]) -> None:
    t = make().surface
    for level in range(5):
        V, E, F, sizes, valence = t.n_vertices, t.n_edges, t.n_faces, t.face_sizes, t.valence
        assert MID_EDGE.faces_after(make().surface, level) == F
        t = MID_EDGE.step(t).topology
        assert (t.n_vertices, t.n_edges, t.n_faces) == (E, 2 * E, V + F)
        assert t.euler == make().surface.euler
        assert sorted(t.face_sizes) == sorted([*sizes, *valence])
        assert set(t.valence) == {4}
        assert_well_made(t)


@closed
def test_doo_sabin_corners_weigh_the_published_cosines(make: Callable[[], Mesh]) -> None:
    t = make().surface
    rows = []
    for loop in t.loops():
        n = len(loop)
        for i in range(n):
            row = np.zeros(t.n_vertices)
            for j in range(n):
                row[loop[(i + j) % n]] = (n + 5) / (4 * n) if j == 0 else (3 + 2 * cos(2 * pi * j / n)) / (4 * n)
            rows.append(row)
    assert np.abs(dense(DOO_SABIN, t) - np.array(rows)).max() < 1e-12
    assert str(DOO_SABIN.step(shapes.cube().topology).stencil(0)).startswith("9/16 v")


@pytest.mark.parametrize("n", [3, 4, 5, 6, 9])
def test_in_a_face_waves_shrink_by_a_half_once_round_and_by_a_quarter_else_or_by_midpoints_as_a_cosine(n: int) -> None:
    t = prism(n).surface
    shrinks = np.fft.fft(dense(DOO_SABIN, t)[:n, t.origin[:n]][0]).real
    assert shrinks == pytest.approx([1 if k == 0 else 1 / 2 if k in (1, n - 1) else 1 / 4 for k in range(n)], abs=1e-12)
    shrinks = np.fft.fft(dense(DOO_SABIN_MEAN, t)[:n, t.origin[:n]][0]).real
    waves = np.cos(2 * pi * np.arange(n) / n)
    assert shrinks[1:] == pytest.approx(1 / 2 + waves[1:] / 4, abs=1e-12)


def test_the_mean_of_four_agrees_in_quads_and_in_no_other_face() -> None:
    for name, make in CLOSED.items():
        t = make().surface
        off = np.abs(dense(DOO_SABIN, t) - dense(DOO_SABIN_MEAN, t)).max(axis=1)
        assert np.array_equal(off < 1e-12, t.face_sizes[t.face] == 4), name
    t = prism(5).surface
    P = prism(5).points
    expected = [
        (P[a] + (P[a] + P[b]) / 2 + (P[a] + P[c]) / 2 + P[loop].mean(axis=0)) / 4
        for loop in t.loops() for c, a, b in zip([loop[-1], *loop], loop, [*loop[1:], loop[0]], strict=False)
    ]  # fmt: skip
    assert np.abs(DOO_SABIN_MEAN.step(t).apply(P) - expected).max() < 1e-12


@corner
@pytest.mark.parametrize("net", [Grid(5, 4, True, True), Grid(5, 6), Grid(6, 5, wrap_s=True)], ids=str)
def test_doo_sabin_on_a_net_is_the_biquadratic_b_spline(scheme: Scheme, net: Grid) -> None:
    mesh = literal(Mesh(net.mesh(), positions(net.n_vertices)))
    for level in (1, 2):
        ours = subdivide(mesh, scheme, level)
        assert same_points(ours.points, subdivide(Mesh(net, mesh.points), tensor_product(2, 2), level).points)


def test_two_mid_edge_steps_on_a_net_are_one_of_the_box_spline_of_four_directions() -> None:
    net = Grid(5, 6, True, True)
    mesh = Mesh(net, positions(30))
    box = subdivide(mesh, box_spline(ZWART_POWELL), 2).points
    assert same_points(subdivide(Mesh(net.mesh(), mesh.points), MID_EDGE, 4).points, box)


@closed
@dual
def test_faces_of_a_dual_scheme_keep_their_centroids_and_vertices_tend_to_the_first_of_theirs(
    scheme: Scheme, make: Callable[[], Mesh]
) -> None:
    mesh = spread(make())
    t, fine = mesh.surface, subdivide(mesh, scheme, 1)
    before, after = (np.array([m.points[loop].mean(axis=0) for loop in m.surface.loops()]) for m in (mesh, fine))
    assert np.abs(after[: t.n_faces] - before).max() < 1e-12
    limits = limit_points(mesh, scheme)
    assert np.abs(limits - after[-t.n_vertices :]).max() < 1e-12
    finer = subdivide(mesh, scheme, 3)
    last = np.array([finer.points[loop].mean(axis=0) for loop in finer.surface.loops()])
    assert np.linalg.norm(last[:, None] - limits[None], axis=2).min(axis=0).max() < 1e-12


def test_told_as_topology_and_geometry_the_first_stages_move_nothing() -> None:
    cube, octahedron = shapes.cube().topology, shapes.octahedron().topology
    topological = {
        "split the vertices": (DOO_SABIN, "topology and geometry", cube), "topology": (KOBBELT, None, cube),
        "insert centroids": (SQRT3, None, octahedron), "midpoints": (four_point(), "midpoints, then push", Polyline(8)),
        "split": (CHAIKIN, "split and slide", Polyline(5)),
    }  # fmt: skip
    for name, (scheme, telling, t) in topological.items():
        first, *rest = scheme.step(t, telling).stages
        assert first.name == name
        assert not first.moves
        assert any(stage.moves for stage in rest)
    split = DOO_SABIN.step(cube).stages[0]
    assert np.array_equal(split.carries, shapes.cube().surface.origin)  # new corners grow out of the old one


def test_limits_of_dual_schemes_are_those_of_their_splines() -> None:
    net = Grid(5, 4, True, True)
    mesh = Mesh(net, positions(20))
    for scheme, spline in ((DOO_SABIN, tensor_product(2, 2)), (MID_EDGE, box_spline(ZWART_POWELL))):
        ours = limit_points(Mesh(net.mesh(), mesh.points), scheme)
        assert same_points(ours, limit_points(mesh, spline))


@dual
def test_a_dual_scheme_says_what_it_does_not_do(scheme: Scheme) -> None:
    word = "close the mesh" if scheme is MID_EDGE else "literal boundary"
    with pytest.raises(TopologyError, match=word):
        scheme.step(shapes.quad_sheet().topology)
    with pytest.raises(TopologyError, match="knows no creases"):
        scheme.step(Topology.from_faces(shapes.cube().surface.loops(), creases={(0, 1): 2.0}))
    with pytest.raises(TopologyError, match="knows no corners"):
        scheme.step(Topology.from_faces(shapes.cube().surface.loops(), corners={0: 2.0}))
    with pytest.raises(TopologyError, match="not a polygon mesh"):
        scheme.step(Grid(4, 4))


TRIANGULAR = {name: make for name, make in CLOSED.items() if make().surface.is_triangular}
triangular = pytest.mark.parametrize("make", TRIANGULAR.values(), ids=TRIANGULAR)


@triangular
def test_both_tellings_of_sqrt3_are_the_same_matrix_of_no_negative_weight(make: Callable[[], Mesh]) -> None:
    assert_all_readings_agree(SQRT3, make().topology)
    assert_all_readings_agree(SQRT3, subdivide(make(), SQRT3, 1).topology)
    assert dense(SQRT3, make().topology).min() >= -1e-15
    assert_relabelling_commutes(SQRT3, spread(make()))


@triangular
def test_sqrt3_is_its_loop_over_vertices_and_faces(make: Callable[[], Mesh]) -> None:
    t, P = make().surface, np.eye(make().surface.n_vertices)
    rows = []
    for v in range(t.n_vertices):
        ring = sorted({w for loop in t.loops() if v in loop for w in loop} - {v})
        a = (4 - 2 * cos(2 * pi / len(ring))) / 9
        rows.append((1 - a) * P[v] + a * P[ring].mean(axis=0))
    rows += [P[loop].mean(axis=0) for loop in t.loops()]
    assert np.abs(dense(SQRT3, t) - np.array(rows)).max() < 1e-12


@triangular
def test_sqrt3_makes_three_triangles_of_each_and_its_vertices_keep_their_valence(make: Callable[[], Mesh]) -> None:
    t = make().surface
    for level in range(4):
        V, E, F, valence = t.n_vertices, t.n_edges, t.n_faces, t.valence
        assert SQRT3.faces_after(make().surface, level) == F
        for stage in SQRT3.step(t).stages:
            assert isinstance(stage.topology, Topology)
            assert_well_made(stage.topology)
            assert (stage.topology.n_edges, stage.topology.n_faces) == (3 * E, 3 * F)
        t = SQRT3.step(t).topology
        assert t.n_vertices == V + F
        assert np.array_equal(t.valence, np.r_[valence, np.full(F, 6)])


@triangular
def test_after_two_sqrt3_steps_every_old_edge_is_cut_in_three(make: Callable[[], Mesh]) -> None:
    t = make().surface
    fine = subdivide(make(), SQRT3, 2).surface
    neighbour = [set(fine.ends[(fine.ends == v).any(axis=1)].ravel().tolist()) - {v} for v in range(fine.n_vertices)]
    for a, b in t.ends.tolist():
        assert any(b in neighbour[w] for v in neighbour[a] for w in neighbour[v] - neighbour[a] - {a})
        assert b not in set().union(*(neighbour[v] for v in neighbour[a]))
    assert fine.n_faces == 9 * t.n_faces


def test_two_sqrt3_steps_on_a_regular_mesh_refine_in_three_and_keep_planes() -> None:
    n, m = 9, 8
    step = SQRT3.step(Grid(n, m, True, True, diagonal=True).mesh())
    matrix = SQRT3.step(step.topology).matrix.toarray() @ step.matrix.toarray()
    assert centres(matrix, n, m, 3) == {(i, j) for i in range(3 * n) for j in range(3 * m)}


def centres(rows: Floats, n: int, m: int, finer: int) -> set[tuple[int, ...]]:
    """Where each row of a scheme on the (n, m) torus lies, by linear functions, in steps of 1/finer; all different."""
    lattice = np.stack(np.divmod(np.arange(n * m), m), axis=1)
    found = set()
    for row in rows:
        anchor = lattice[row.argmax()]
        away = (lattice - anchor + (n // 2, m // 2)) % (n, m) - (n // 2, m // 2)
        centre = finer * (anchor + row @ away)
        assert np.abs(centre - np.round(centre)).max() < 1e-12
        found.add(tuple((np.round(centre).astype(int) % (finer * n, finer * m)).tolist()))
    assert len(found) == len(rows)
    return found


@triangular
def test_sqrt3_vertices_tend_to_their_limits(make: Callable[[], Mesh]) -> None:
    mesh = spread(make())
    limits = limit_points(mesh, SQRT3)
    assert np.abs(limit_points(subdivide(mesh, SQRT3, 2), SQRT3)[: len(limits)] - limits).max() < 1e-12
    assert np.abs(subdivide(mesh, SQRT3, 6).points[: len(limits)] - limits).max() < 0.05


def test_sqrt3_says_what_it_does_not_do() -> None:
    with pytest.raises(TopologyError, match="every second step only; close the mesh, or use Loop"):
        SQRT3.step(shapes.triangle_sheet().topology)
    with pytest.raises(TopologyError, match="knows no creases"):
        SQRT3.step(Topology.from_faces(shapes.tetrahedron().surface.loops(), creases={(0, 2): 2.0}))
    with pytest.raises(TopologyError, match="must be a triangle"):
        SQRT3.step(shapes.cube().topology)


OPEN_TRIANGLES = {
    "triangles": shapes.triangle_sheet, "triangle fan": shapes.triangle_fan, "fan of 4": lambda: shapes.triangle_fan(4),
}  # fmt: skip
both = pytest.mark.parametrize(
    "make", [*TRIANGULAR.values(), *OPEN_TRIANGLES.values()], ids=[*TRIANGULAR, *OPEN_TRIANGLES]
)


@both
def test_every_telling_of_the_butterfly_is_the_same_matrix_and_it_interpolates(make: Callable[[], Mesh]) -> None:
    mesh = spread(make())
    t = mesh.surface
    assert_all_readings_agree(MODIFIED_BUTTERFLY, t)
    assert_all_readings_agree(MODIFIED_BUTTERFLY, subdivide(mesh, MODIFIED_BUTTERFLY, 1).topology)
    assert_relabelling_commutes(MODIFIED_BUTTERFLY, mesh)
    fine = subdivide(mesh, MODIFIED_BUTTERFLY, 3)
    assert np.abs(fine.points[: t.n_vertices] - mesh.points).max() == 0
    assert np.abs(limit_points(fine, MODIFIED_BUTTERFLY) - fine.points).max() == 0
    for level in range(4):
        assert MODIFIED_BUTTERFLY.faces_after(t, level) == 4**level * t.n_faces
    assert fine.surface.euler == t.euler
    assert_well_made(fine.surface)


def triangles_of(t: Topology) -> dict[tuple[int, int], int]:
    """Directed edge -> the third corner of the triangle on its left."""
    return {(a, b): c for x, y, z in t.loops() for a, b, c in ((x, y, z), (y, z, x), (z, x, y))}


def around(third: dict[tuple[int, int], int], v: int, first: int) -> list[int]:
    ring = [first]
    while (after := third[v, ring[-1]]) != first:
        ring.append(after)
    return ring


@triangular
def test_the_butterfly_is_its_loop_over_edges(make: Callable[[], Mesh]) -> None:
    t = make().surface
    P, third = np.eye(t.n_vertices), triangles_of(t)
    rows = MODIFIED_BUTTERFLY.step(t).matrix.toarray()[t.n_vertices :]
    for row, (a, b) in zip(rows, t.ends.tolist(), strict=True):
        wanted = []
        for v, w in ((a, b), (b, a)):
            ring = around(third, v, w)
            n = len(ring)
            s = {3: [5 / 12, -1 / 12, -1 / 12], 4: [3 / 8, 0, -1 / 8, 0]}.get(
                n, [(1 / 4 + cos(2 * pi * j / n) + cos(4 * pi * j / n) / 2) / n for j in range(n)]
            )
            if n != 6:
                wanted.append(3 / 4 * P[v] + sum(s[j] * P[ring[j]] for j in range(n)))
        if not wanted:
            wings = third[a, b], third[b, a]
            corners = [third[v, w] for v, w in ((wings[0], b), (a, wings[0]), (wings[1], a), (b, wings[1]))]
            wanted = [(P[a] + P[b]) / 2 + sum(P[w] for w in wings) / 8 - sum(P[c] for c in corners) / 16]
        assert np.abs(row - np.mean(wanted, axis=0)).max() < 1e-12


@pytest.mark.parametrize("n", [3, 4, 5, 7, 8, 12])
def test_round_an_extraordinary_vertex_waves_shrink_by_a_half_and_a_quarter(n: int) -> None:
    mesh = shapes.triangle_fan(n, rings=3)
    t = mesh.surface
    ring = around(triangles_of(t), 0, int(t.ends[(t.ends == 0).any(axis=1)][0].sum()))
    edge = {frozenset(ends): k for k, ends in enumerate(t.ends.tolist())}
    rows = MODIFIED_BUTTERFLY.step(t).matrix.toarray()
    local = rows[[t.n_vertices + edge[frozenset((0, v))] for v in ring]][:, ring]
    shrinks = np.fft.fft(local[0]).real
    assert shrinks[0] == pytest.approx(1 / 4, abs=1e-12)
    assert shrinks[[1, -1]] == pytest.approx(1 / 2, abs=1e-12)
    assert shrinks[2:-1] == pytest.approx([1 / 4 if k in (2, n - 2) else 0 for k in range(2, n - 1)], abs=1e-12)


def test_on_the_regular_lattice_the_butterfly_reproduces_cubics_and_nothing_higher() -> None:
    net = Grid(10, 10, diagonal=True)
    step = MODIFIED_BUTTERFLY.step(net.mesh())
    x, y = np.divmod(np.arange(100.0), 10)
    places = step.apply(np.stack([x, y, 0 * x], axis=1))
    inside = ((places[:, :2] > 1.9) & (places[:, :2] < 7.1)).all(axis=1)
    worst = np.zeros(6)
    for i, j in [(i, j) for i in range(6) for j in range(6) if i + j < 6]:
        values = step.matrix @ (x**i * y**j)
        off = np.abs(values - places[:, 0] ** i * places[:, 1] ** j)[inside].max()
        worst[i + j] = max(worst[i + j], off)
    assert worst[:4].max() < 1e-10
    assert worst[4:].min() > 1e-3


@pytest.mark.parametrize("make", OPEN_TRIANGLES.values(), ids=OPEN_TRIANGLES)
def test_the_outline_of_an_interpolating_scheme_is_the_four_point_curve(make: Callable[[], Mesh]) -> None:
    assert_outline(MODIFIED_BUTTERFLY, spread(make()))


def assert_outline(scheme: Scheme, mesh: Mesh) -> None:
    t = mesh.surface
    after = {a: b for loop in t.loops() for a, b in zip(loop, [*loop[1:], loop[0]], strict=True)
             if not any((b, a) in zip(other, [*other[1:], other[0]], strict=True) for other in t.loops())}  # fmt: skip
    ring = [min(after)]
    while after[ring[-1]] != ring[0]:
        ring.append(after[ring[-1]])
    curve = Mesh(Polyline(len(ring), closed=True), mesh.points[ring])
    for level in (1, 2):
        fine = subdivide(mesh, scheme, level)
        assert same_points(fine.points[fine.surface.on_boundary], subdivide(curve, four_point(), level).points)


@pytest.mark.parametrize("pinned", [(), (0, 5, 30, 35)])
def test_planes_stay_planes_at_the_boundary_of_the_butterfly_where_sharp_corners_end_the_outline(
    pinned: tuple[int, ...]
) -> None:
    net = Topology.from_faces(Grid(6, 6, diagonal=True).mesh().loops(), corners=dict.fromkeys(pinned, 10.0))
    places = np.stack(np.divmod(np.arange(36.0), 6), axis=1)
    off = MODIFIED_BUTTERFLY.step(net).matrix[36:] @ places - places[net.ends].mean(axis=1)
    assert np.abs(off[~net.boundary]).max() < 1e-12
    assert (np.abs(off).max() < 1e-12) == bool(pinned)


def test_the_butterfly_says_what_it_does_not_do() -> None:
    with pytest.raises(TopologyError, match="choose another boundary"):
        MODIFIED_BUTTERFLY.step(literal(shapes.triangle_sheet()).topology)
    with pytest.raises(TopologyError, match="knows no creases"):
        MODIFIED_BUTTERFLY.step(Topology.from_faces(shapes.tetrahedron().surface.loops(), creases={(0, 2): 2.0}))
    with pytest.raises(TopologyError, match="back to back"):
        MODIFIED_BUTTERFLY.step(Topology.from_faces([[0, 1, 2], [0, 2, 1]]))
    with pytest.raises(TopologyError, match="must be a triangle"):
        MODIFIED_BUTTERFLY.step(shapes.cube().topology)


QUADRILATERAL = {name: make for name, make in CLOSED.items() if make().surface.is_quadrilateral}
OPEN_QUADS = {"sheet": shapes.quad_sheet, "fan": shapes.quad_fan, "fan of 3": lambda: shapes.quad_fan(3, rings=2)}
all_quads = pytest.mark.parametrize(
    "make", [*QUADRILATERAL.values(), *OPEN_QUADS.values()], ids=[*QUADRILATERAL, *OPEN_QUADS]
)


@all_quads
@pytest.mark.parametrize("scheme", [KOBBELT, kobbelt(Fraction(1, 10))], ids=lambda s: s.name)
def test_every_telling_of_kobbelts_quads_is_the_same_matrix_and_it_interpolates(
    scheme: Scheme, make: Callable[[], Mesh]
) -> None:
    mesh = spread(make())
    t = mesh.surface
    assert_all_readings_agree(scheme, t)
    assert_all_readings_agree(scheme, subdivide(mesh, scheme, 1).topology)
    assert_relabelling_commutes(scheme, mesh)
    fine = subdivide(mesh, scheme, 3)
    assert np.abs(fine.points[: t.n_vertices] - mesh.points).max() == 0
    assert np.abs(limit_points(fine, scheme) - fine.points).max() == 0
    for level in range(4):
        assert scheme.faces_after(t, level) == 4**level * t.n_faces


@pytest.mark.parametrize("w", [Fraction(1, 16), Fraction(1, 10)])
def test_kobbelt_on_a_torus_is_the_four_point_scheme_along_s_and_along_t(w: Fraction) -> None:
    net = Grid(7, 5, True, True)
    along_s, along_t = (dense(four_point(w), Polyline(n, closed=True)) for n in net.shape)
    assert same_points(dense(kobbelt(w), net.mesh()), np.kron(along_s, along_t))


def test_kobbelt_on_a_sheet_with_sharp_corners_is_the_reflected_four_point_scheme() -> None:
    mesh = Grid(6, 5).mesh().with_boundary(Boundary.EDGE_AND_CORNER)
    along_s, along_t = (dense(REFLECTED, Polyline(n)) for n in (6, 5))
    assert same_points(dense(KOBBELT, mesh), np.kron(along_s, along_t))


@pytest.mark.parametrize("n", [3, 4, 5, 6, 7, 12])
@pytest.mark.parametrize("w", [Fraction(1, 16), Fraction(1, 10)])
def test_round_an_isolated_extraordinary_vertex_both_directions_make_the_same_face_point(n: int, w: Fraction) -> None:
    t = shapes.quad_fan(n, rings=5).surface
    E = edge_points(t, w).assemble().toarray()
    made = face_points(t, w).assemble() @ E
    ends, across = t.edge.reshape(-1, 4), t.edge[t.next[t.next]][t.twin].reshape(-1, 4)
    steps = np.where(np.arange(t.n_vertices) == 0, 0, 9)
    for _ in range(5):
        for a, b in (*t.ends, *t.ends[:, ::-1]):
            steps[a] = min(steps[a], steps[b] + 1)
    nearest, whole = (steps[t.origin].reshape(-1, 4).min(axis=1), ~t.on_boundary[t.origin].reshape(-1, 4).any(axis=1))
    for a, b in ((0, 2), (1, 3)):
        rows = float(1 / 2 + w) * (E[ends[:, a]] + E[ends[:, b]]) - float(w) * (E[across[:, a]] + E[across[:, b]])
        off = np.abs(rows - made).max(axis=1)
        assert off[whole & (nearest != 1)].max() < 1e-12
        assert (off[whole & (nearest == 1)].max() < 1e-12) == (n == 4)


@all_quads
def test_the_outline_of_kobbelts_quads_is_the_four_point_curve(make: Callable[[], Mesh]) -> None:
    if make().surface.boundary.any():
        assert_outline(KOBBELT, spread(make()))


def test_kobbelt_says_what_it_does_not_do() -> None:
    with pytest.raises(TopologyError, match="choose another boundary"):
        KOBBELT.step(literal(shapes.quad_sheet()).topology)
    with pytest.raises(TopologyError, match="knows no creases"):
        KOBBELT.step(Topology.from_faces(shapes.cube().surface.loops(), creases={(0, 1): 2.0}))
    with pytest.raises(TopologyError, match="must be a quadrilateral"):
        KOBBELT.step(shapes.octahedron().topology)


@pytest.mark.parametrize("scheme", [s for s in SCHEMES if s not in LECTURE], ids=lambda s: s.name)
def test_what_one_valence_does_not_tell_is_refused_with_a_sentence(scheme: Scheme) -> None:
    with pytest.raises(TopologyError, match="tells a stencil"):
        stencil_by_valence(scheme, 5, "vertex")
    with pytest.raises(TopologyError, match=scheme.title):
        ring(scheme, 5)

"""Eigenvalues round a vertex beside their closed forms, and what they promise, measured on meshes."""

from fractions import Fraction
from math import acos, cos, degrees, pi, sin, sqrt

import naive
import numpy as np
import pytest

from subdivision import Mesh, Scheme, TopologyError, shapes, subdivide
from subdivision.arrays import Floats
from subdivision.schemes import (
    CATMULL_CLARK,
    LECTURE,
    LOOP,
    LOOP_WARREN,
    QUAD_CENTROID,
    TRIANGLE_CENTROID,
    lane_riesenfeld,
)
from subdivision.spectrum import beta_min, ring, stencil_by_valence

VALENCES = (3, 4, 5, 6, 7, 8, 10, 12, 20)
TRIANGLES = (TRIANGLE_CENTROID, LOOP, LOOP_WARREN)
valences = pytest.mark.parametrize("n", VALENCES)
schemes = pytest.mark.parametrize("scheme", LECTURE, ids=lambda s: s.name)

TABLE = {  # n: quad lambda, Catmull-Clark mode 0, simple mode 0, lambda squared, triangle lambda, centroid, Loop
    3: (0.41010, 0.16667, 0.25, 0.16818, 0.25000, 0.25, 0.06250),
    4: (0.50000, 0.25000, 0.25, 0.25000, 0.37500, 0.25, 0.14062),
    5: (0.54999, 0.32247, 0.25, 0.30249, 0.45225, 0.25, 0.20453),
    6: (0.57968, 0.37500, 0.25, 0.33603, 0.50000, 0.25, 0.25000),
    8: (0.61112, 0.44309, 0.25, 0.37346, 0.55178, 0.25, 0.30446),
    12: (0.63480, 0.51275, 0.25, 0.40297, 0.59151, 0.25, 0.34988),
}

ANGLES = [  # largest angle between face normals at the pole, level by level
    ("triangles", 3, TRIANGLE_CENTROID, [101.5, 101.5, 101.5, 101.5, 101.5]),
    ("triangles", 3, LOOP, [101.5, 45.6, 12.3, 3.1, 0.8]),
    ("triangles", 3, LOOP_WARREN, [101.5, 45.6, 12.3, 3.1, 0.8]),
    ("triangles", 4, TRIANGLE_CENTROID, [109.5, 86.6, 64.3, 45.5, 31.2]),
    ("triangles", 4, LOOP, [109.5, 55.9, 22.5, 8.5, 3.2]),
    ("quads", 3, QUAD_CENTROID, [101.5, 82.6, 61.0, 41.3, 26.4]),
    ("quads", 3, CATMULL_CLARK, [101.5, 30.1, 13.4, 5.6, 2.3]),
    ("quads", 5, QUAD_CENTROID, [95.4, 49.7, 23.1, 10.5, 4.8]),
    ("quads", 5, CATMULL_CLARK, [95.4, 66.8, 42.6, 25.8, 15.3]),
]


def quad_lambda(n: int) -> float:
    c = cos(2 * pi / n)
    return (5 + c + cos(pi / n) * sqrt(2 * (9 + c))) / 16


def ring_matrix(scheme: Scheme, n: int) -> Floats:
    """By hand: every new point of the ring, from the published stencils."""
    a = np.arange(n)
    after, before = (a + 1) % n, (a - 1) % n
    if scheme in TRIANGLES:
        beta, S = naive.BETAS[scheme.name](n), np.zeros((n + 1, n + 1))
        S[0], S[1:, 0] = [1 - n * beta, *[beta] * n], 3 / 8
        for columns, weight in ((a, 3 / 8), (after, 1 / 8), (before, 1 / 8)):
            np.add.at(S, (1 + a, 1 + columns), weight)
        return S
    (v, e, f), S = naive.QUAD_WEIGHTS[scheme.name](n), np.zeros((2 * n + 1, 2 * n + 1))
    S[0], S[1:, 0] = [v, *[e] * n, *[f] * n], [6 / 16] * n + [1 / 4] * n
    for columns, weight in ((a, 6 / 16), (after, 1 / 16), (before, 1 / 16), (n + a, 1 / 16), (n + before, 1 / 16)):
        np.add.at(S, (1 + a, 1 + columns), weight)
    for columns in (a, after, n + a):
        np.add.at(S, (1 + n + a, 1 + columns), 1 / 4)
    return S


@valences
@schemes
def test_the_local_matrix_read_off_a_fan_is_the_one_written_by_hand(scheme: Scheme, n: int) -> None:
    assert np.abs(ring(scheme, n).matrix - ring_matrix(scheme, n)).max() < 1e-12


@valences
@schemes
def test_modes_together_have_the_eigenvalues_of_the_whole_matrix(scheme: Scheme, n: int) -> None:
    whole = np.linalg.eigvals(ring_matrix(scheme, n))
    traces = [(ring(scheme, n).spectrum ** k).sum() for k in (1, 2, 3)]
    assert np.abs(np.subtract(traces, [(whole**k).sum() for k in (1, 2, 3)])).max() < 1e-12
    assert sorted(ring(scheme, n).spectrum) == pytest.approx(sorted(whole.real), abs=1e-7)  # defective: half the digits


@valences
def test_quads_shrink_by_the_published_lambda_twice_whatever_the_vertex_rule(n: int) -> None:
    for scheme in (QUAD_CENTROID, CATMULL_CLARK):
        assert ring(scheme, n).subdominant == pytest.approx(quad_lambda(n), abs=1e-12)
        assert ring(scheme, n).eigenvalues(n - 1)[0] == pytest.approx(quad_lambda(n), abs=1e-12)
    simple, published = (ring(s, n).characteristic_map() for s in (QUAD_CENTROID, CATMULL_CLARK))
    assert np.abs(simple - published).max() < 1e-12


@valences
def test_mode_zero_of_quads_is_1_with_a_quarter_and_a_sixteenth_or_catmull_clarks_root(n: int) -> None:
    assert ring(QUAD_CENTROID, n).eigenvalues(0) == pytest.approx([1, 1 / 4, 1 / 16], abs=1e-12)
    roots = [((3 * n - 7) + sign * sqrt(5 * n * n - 30 * n + 49)) / (8 * n) for sign in (1, -1)]
    expected = [1, *sorted(roots, key=abs, reverse=True)]
    assert ring(CATMULL_CLARK, n).eigenvalues(0) == pytest.approx(expected, abs=1e-12)


@valences
@pytest.mark.parametrize("scheme", TRIANGLES, ids=lambda s: s.name)
def test_triangles_shrink_by_three_eighths_and_a_quarter_cosine_and_five_eighths_less_n_beta(
    scheme: Scheme, n: int
) -> None:
    assert ring(scheme, n).eigenvalues(0) == pytest.approx([1, 5 / 8 - n * naive.BETAS[scheme.name](n)], abs=1e-12)
    for k in range(1, n):
        assert ring(scheme, n).eigenvalues(k) == pytest.approx([3 / 8 + cos(2 * pi * k / n) / 4], abs=1e-12)


@pytest.mark.parametrize("n", TABLE)
def test_the_eigenvalues_are_those_of_the_table(n: int) -> None:
    quads, tris = ring(CATMULL_CLARK, n), ring(LOOP, n)
    numbers = (
        quads.subdominant, quads.cup, ring(QUAD_CENTROID, n).cup, quads.subdominant**2,
        tris.subdominant, ring(TRIANGLE_CENTROID, n).cup, tris.cup,
    )  # fmt: skip
    assert numbers == pytest.approx(TABLE[n], abs=6e-6)


@valences
def test_loop_makes_the_cup_shrink_by_lambda_squared(n: int) -> None:
    assert ring(LOOP, n).cup == pytest.approx(ring(LOOP, n).subdominant ** 2, abs=1e-12)
    assert "bounded curvature, not zero" in ring(LOOP, n).reading


def test_every_scheme_is_smooth_at_every_valence_but_centroid_averaging_of_triangles_at_three() -> None:
    rough = {(scheme.name, n) for scheme in LECTURE for n in range(3, 30) if not ring(scheme, n).is_smooth}
    assert rough == {("triangle-centroid", 3)}
    assert "a tip remains" in ring(TRIANGLE_CENTROID, 3).reading


def test_beta_min_is_the_centroid_value_at_three_and_below_every_beta_elsewhere() -> None:
    assert beta_min(3) == Fraction(1, 8) == Fraction(naive.centroid_beta(3))
    for n in range(3, 60):
        assert float(beta_min(n)) == pytest.approx((1 - cos(2 * pi / n)) / (4 * n), abs=1e-15)
        for name, beta in naive.BETAS.items():
            assert (beta(n) > float(beta_min(n)) + 1e-12) == ((name, n) != ("triangle-centroid", 3))


@pytest.mark.parametrize(("n", "scheme", "word"), [
    (3, QUAD_CENTROID, "pinched"), (5, QUAD_CENTROID, "flatten"), (8, CATMULL_CLARK, "pinched"),
    (4, TRIANGLE_CENTROID, "pinched"), (8, TRIANGLE_CENTROID, "flatten"), (6, LOOP, "bounded"),
    (4, CATMULL_CLARK, "bounded"),
])  # fmt: skip
def test_the_reading_compares_the_cup_with_lambda_squared(n: int, scheme: Scheme, word: str) -> None:
    assert word in ring(scheme, n).reading


@valences
@schemes
def test_the_characteristic_map_is_copied_at_lambda_and_winds_once_round_the_vertex(scheme: Scheme, n: int) -> None:
    local = ring(scheme, n)
    points = local.characteristic_map()
    assert np.abs(local.matrix @ points - local.subdominant * points).max() < 1e-12
    assert points[1] == pytest.approx((1, 0), abs=1e-12)
    turns = [points[1 + i] - (cos(2 * pi * i / n), sin(2 * pi * i / n)) for i in range(n)]
    assert np.abs(turns).max() < 1e-12


def test_stencils_by_valence_are_exact_and_named() -> None:
    n = 7
    vertex = dict(stencil_by_valence(CATMULL_CLARK, n, "vertex").terms)
    ring_weights = {f"E{i}": Fraction(3, 2 * n * n) for i in range(1, n + 1)}
    corner_weights = {f"F{i}": Fraction(1, 4 * n * n) for i in range(1, n + 1)}
    assert vertex == {"V": 1 - Fraction(7, 4 * n)} | ring_weights | corner_weights
    edge = dict(stencil_by_valence(QUAD_CENTROID, n, "edge").terms)
    beside = dict.fromkeys(("E2", "E7", "F1", "F7"), Fraction(1, 16))
    assert edge == dict.fromkeys(("V", "E1"), Fraction(6, 16)) | beside
    face = dict(stencil_by_valence(QUAD_CENTROID, n, "face").terms)
    assert face == dict.fromkeys(("V", "E1", "F1", "E2"), Fraction(1, 4))
    edge = dict(stencil_by_valence(LOOP, n, "edge").terms)
    assert edge == dict.fromkeys(("V", "E1"), Fraction(3, 8)) | dict.fromkeys(("E2", "E7"), Fraction(1, 8))
    loop = stencil_by_valence(LOOP, n, "vertex")
    assert float(loop.weight("E3")) == pytest.approx(naive.loop_beta(n), abs=1e-15)
    assert str(stencil_by_valence(TRIANGLE_CENTROID, 3, "vertex")) == "5/8 V + 1/8 E1 + 1/8 E2 + 1/8 E3"


def test_what_has_no_stencil_says_why() -> None:
    with pytest.raises(TopologyError, match="makes no face points"):
        stencil_by_valence(LOOP, 5, "face")
    with pytest.raises(TopologyError, match="choose a valence of 3 or more"):
        stencil_by_valence(LOOP, 2, "vertex")
    with pytest.raises(TopologyError, match="has no vertices of any valence"):
        ring(lane_riesenfeld(3), 5)


def normals_at(mesh: Mesh, v: int) -> Floats:
    found = []
    for loop in mesh.topology.loops():
        if v in loop:
            i, P = loop.index(v), mesh.points
            found.append(np.cross(P[loop[(i + 1) % len(loop)]] - P[v], P[loop[i - 1]] - P[v]))
    return np.array([normal / np.linalg.norm(normal) for normal in found])


def pole(kind: str, n: int) -> tuple[Mesh, int]:
    """A bipyramid of unit radius and height, its faces split in quads or not; and its upper pole."""
    ring = [[cos(2 * pi * i / n), sin(2 * pi * i / n), 0] for i in range(n)]
    points = np.array([*ring, [0, 0, 1], [0, 0, -1]])
    faces = [f for i in range(n) for f in ([i, (i + 1) % n, n], [(i + 1) % n, i, n + 1])]
    mesh = shapes.build.mesh(points, faces)
    if kind == "triangles":
        return mesh, n
    stage = CATMULL_CLARK.step(mesh.topology).stages
    edges = (points[mesh.topology.ends[:, 0]] + points[mesh.topology.ends[:, 1]]) / 2
    centres = np.array([points[loop].mean(axis=0) for loop in faces])
    return Mesh(stage[-1].topology, np.concatenate([points, centres, edges])), n


@pytest.mark.parametrize(("kind", "n", "scheme", "expected"), ANGLES, ids=[f"{s.name}-{n}" for _, n, s, _ in ANGLES])
def test_the_normals_at_a_pole_spread_as_in_the_table(kind: str, n: int, scheme: Scheme, expected: list[float]) -> None:
    mesh, v = pole(kind, n)
    for level, angle in enumerate(expected):
        at = normals_at(subdivide(mesh, scheme, level), v)
        assert degrees(acos(min(1, max(-1, float((at @ at.T).min()))))) == pytest.approx(angle, abs=0.051)


def test_at_valence_three_centroid_averaging_copies_vertex_and_ring_at_a_quarter_about_their_middle() -> None:
    mesh = Mesh(shapes.tetrahedron().topology, np.random.default_rng(3).normal(size=(4, 3)))
    for _ in range(5):
        finer = subdivide(mesh, TRIANGLE_CENTROID, 1)
        ring_before, ring_after = (
            np.array([m.points[next(iter(e - {0}))] for e in naive.faces_at_edges(m.topology.loops()) if 0 in e])
            for m in (mesh, finer)
        )
        middle = (mesh.points[0] + ring_before.mean(axis=0)) / 2
        assert np.abs(finer.points[0] - middle - (mesh.points[0] - middle) / 4).max() < 1e-12
        expected = middle + (ring_before - middle) / 4
        assert np.abs(ring_after[:, None] - expected[None]).max(axis=2).min(axis=1).max() < 1e-12
        mesh = finer


@pytest.mark.parametrize(("scheme", "expected"), [
    (TRIANGLE_CENTROID, [180.0] * 6), (LOOP, [180, 328, 358, 359.86, 359.99, 360]),
], ids=["centroid", "loop"])  # fmt: skip
def test_the_angles_at_a_tetrahedrons_corner_add_up_to_180_for_ever_or_to_360(
    scheme: Scheme, expected: list[float]
) -> None:
    mesh = shapes.tetrahedron()
    for angle_sum in expected:
        total, P = 0.0, mesh.points
        for loop in mesh.topology.loops():
            if 0 in loop:
                i = loop.index(0)
                a, b = P[loop[i - 2]] - P[0], P[loop[i - 1]] - P[0]
                total += acos(float(a @ b / np.linalg.norm(a) / np.linalg.norm(b)))
        assert degrees(total) == pytest.approx(angle_sum, abs=1e-9 if scheme is TRIANGLE_CENTROID else 0.6)
        mesh = subdivide(mesh, scheme, 1)

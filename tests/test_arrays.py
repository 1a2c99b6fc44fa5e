"""Rectangular nets: tensor products and box splines, beside polynomials in fractions and slices of arrays."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, permutations, product
from math import comb

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from subdivision import Grid, Mesh, TopologyError
from subdivision.arrays import Floats
from subdivision.continuity import alpha, degree, mask, placement, promise, smoothness
from subdivision.limit import limit_points, limit_stencil
from subdivision.limit_nets import box_weights, tensor_weights
from subdivision.schemes import (
    THREE_DIRECTION_LINEAR,
    THREE_DIRECTION_QUARTIC,
    ZWART_POWELL,
    box_spline,
    tensor_product,
)

Vectors = Sequence[tuple[int, int]]

BIDEGREES = list(product(range(1, 6), repeat=2))
CATALOGUE: dict[str, tuple[Vectors, int, int]] = {  # vectors, total degree, alpha
    "bilinear": (((1, 0), (0, 1)) * 2, 2, 2),
    "biquadratic": (((1, 0), (0, 1)) * 3, 4, 3),
    "bicubic": (((1, 0), (0, 1)) * 4, 6, 4),
    "three-direction linear": (THREE_DIRECTION_LINEAR, 1, 2),
    "three-direction quartic": (THREE_DIRECTION_QUARTIC, 4, 4),
    "three-direction degree 7": (THREE_DIRECTION_LINEAR * 3, 7, 6),
    "Zwart-Powell": (ZWART_POWELL, 2, 3),
    "parallel of two lengths": (((1, 0), (0, 1), (0, 1), (2, 0)), 2, 2),
    "parallel and opposite": (((1, 0), (0, 1), (1, 1), (-1, -1)), 2, 2),
    "one direction alone": (((1, 0), (1, 0), (0, 1)), 1, 1),
}
catalogue = pytest.mark.parametrize("name", CATALOGUE)

random_vectors = st.lists(
    st.tuples(st.integers(-2, 2), st.integers(-2, 2)).filter(any), min_size=0, max_size=4
).map(lambda more: ((1, 0), (0, 1), *more))  # fmt: skip


def control(n: int = 9, m: int = 8) -> Floats:
    return np.random.default_rng(1).normal(size=(n, m, 3))


def averaged(U: Floats, v: tuple[int, int]) -> Floats:
    """One pass, by slices."""
    (a, b), (n, m) = v, U.shape[:2]
    rows, columns = slice(max(0, -a), n - max(0, a)), slice(max(0, -b), m - max(0, b))
    moved = U[rows.start + a : rows.stop + a, columns.start + b : columns.stop + b]
    return (U[rows, columns] + moved) / 2


def quadrupled(P: Floats, vectors: Vectors) -> Floats:
    U = P.repeat(2, axis=0).repeat(2, axis=1)
    for v in vectors:
        U = averaged(U, v)
    return U


def without_two(vectors: Vectors) -> list[tuple[int, int]]:
    rest = list(vectors)
    rest.remove((1, 0))
    rest.remove((0, 1))
    return rest


def engine(P: Floats, vectors: Vectors, telling: str | None = None) -> Floats:
    step = box_spline(vectors).step(Grid(*P.shape[:2]), telling)
    return step.apply(P.reshape(-1, P.shape[2])).reshape(*step.topology.shape, -1)


def symbol(vectors: Vectors) -> dict[tuple[int, int], Fraction]:
    """Coefficients of 4 times the product of (1 + x^a y^b)/2, by counting subsets."""
    terms: dict[tuple[int, int], Fraction] = {}
    for chosen in product((0, 1), repeat=len(vectors)):
        power = tuple(sum(c * v[axis] for c, v in zip(chosen, vectors, strict=True)) for axis in (0, 1))
        terms[power] = terms.get(power, Fraction(0)) + Fraction(4, 2 ** len(vectors))
    return terms


@pytest.mark.parametrize(("m", "n"), BIDEGREES)
def test_every_telling_of_a_tensor_product_is_splitting_and_averaging_slices(m: int, n: int) -> None:
    P = control()
    U = P.repeat(2, axis=0)
    for _ in range(m):
        U = averaged(U, (1, 0))
    U = U.repeat(2, axis=1)
    for _ in range(n):
        U = averaged(U, (0, 1))
    scheme = tensor_product(m, n)
    for telling in scheme.tellings:
        step = scheme.step(Grid(9, 8), telling)
        assert step.topology.shape == (18 - m, 16 - n) == U.shape[:2]
        assert np.abs(step.apply(P.reshape(-1, 3)) - U.reshape(-1, 3)).max() < 1e-12


def test_duplicating_columns_commutes_with_averaging_rows() -> None:
    P = control()
    assert np.array_equal(averaged(P.repeat(2, axis=1), (1, 0)), averaged(P, (1, 0)).repeat(2, axis=1))


@given(random_vectors, random_vectors)
def test_averages_along_v_and_w_commute(some: Vectors, others: Vectors) -> None:
    U, (v, w) = control(10, 10), (some[-1], others[-1])
    here, there = averaged(averaged(U, v), w), averaged(averaged(U, w), v)
    assert np.abs(here - there).max() < 1e-12


@pytest.mark.parametrize(("m", "n"), [(2, 2), (1, 3), (3, 2)])
def test_every_interleaving_of_the_passes_gives_the_same_net(m: int, n: int) -> None:
    P = control()
    expected = quadrupled(P, [(1, 0)] * m + [(0, 1)] * n)
    for order in set(permutations([(1, 0)] * m + [(0, 1)] * n)):
        assert np.abs(engine(P, [(1, 0), (0, 1), *order]) - expected).max() < 1e-12


@pytest.mark.parametrize(("m", "n"), BIDEGREES)
def test_the_box_spline_of_two_directions_is_the_tensor_product(m: int, n: int) -> None:
    vectors = [(1, 0)] * (m + 1) + [(0, 1)] * (n + 1)
    rows = [[Fraction(comb(m + 1, i) * comb(n + 1, j), 2 ** (m + n)) for j in range(n + 2)] for i in range(m + 2)]
    assert mask(vectors).rows == tuple(map(tuple, rows))
    assert alpha(vectors) == min(m, n) + 1
    ours = tensor_product(m, n).step(Grid(9, 8)).apply(control().reshape(-1, 3))
    assert np.abs(engine(control(), vectors).reshape(-1, 3) - ours).max() < 1e-12


@given(random_vectors)
def test_the_mask_is_the_product_of_its_factors(vectors: Vectors) -> None:
    ours = mask(vectors)
    for power, coefficient in symbol(vectors).items():
        assert ours[power] == coefficient
    assert sum(sum(row) for row in ours.rows) == 4


@given(random_vectors)
def test_each_parity_class_of_a_mask_sums_to_one(vectors: Vectors) -> None:
    for parity in product((0, 1), repeat=2):
        assert sum(c for (i, j), c in symbol(vectors).items() if (i % 2, j % 2) == parity) == 1


@given(random_vectors)
def test_the_weight_of_P_i_in_Q_k_is_the_coefficient_at_2i_plus_1_minus_k(vectors: Vectors) -> None:
    rest, terms = without_two(vectors), symbol(vectors)
    n = 4 + max(sum(abs(v[axis]) for v in rest) for axis in (0, 1))
    step = box_spline(vectors).step(Grid(n, n))
    shift = [-sum(min(0, v[axis]) for v in rest) for axis in (0, 1)]
    width = step.topology.shape[1]
    for point in np.linspace(0, step.topology.n_vertices - 1, 12).astype(int):
        k = point // width + shift[0], point % width + shift[1]
        read = {(i, j): (2 * i + 1 - k[0], 2 * j + 1 - k[1]) for i in range(n) for j in range(n)}
        expected = {i * n + j: terms[power] for (i, j), power in read.items() if power in terms}
        assert dict(step.stencil(int(point)).terms) == expected


@given(random_vectors, st.randoms(use_true_random=False))
def test_the_order_of_the_directions_is_irrelevant(vectors: Vectors, draw: st.DrawFn) -> None:
    P, shuffled = control(12, 12), list(vectors)
    draw.shuffle(shuffled)  # type: ignore[attr-defined]
    expected = quadrupled(P, without_two(vectors))
    for telling in box_spline(vectors).tellings:
        assert np.abs(engine(P, shuffled, telling) - expected).max() < 1e-12
    assert expected.shape[0] == 24 - sum(abs(a) for a, _ in without_two(vectors))


def test_the_masks_of_the_catalogue_are_as_printed() -> None:
    linear = np.array([[1, 1, 0], [1, 2, 1], [0, 1, 1]]) / 2
    quartic = np.array([[1, 2, 1, 0, 0], [2, 6, 6, 2, 0], [1, 6, 10, 6, 1], [0, 2, 6, 6, 2], [0, 0, 1, 2, 1]]) / 16
    zwart_powell = np.array([[0, 1, 1, 0], [1, 2, 2, 1], [1, 2, 2, 1], [0, 1, 1, 0]]) / 4
    masks = ((THREE_DIRECTION_LINEAR, linear), (THREE_DIRECTION_QUARTIC, quartic), (ZWART_POWELL, zwart_powell))
    for vectors, rows in masks:
        assert np.array_equal(np.array(mask(vectors).rows, dtype=float), rows)


@catalogue
def test_degree_alpha_and_smoothness_are_those_of_the_catalogue(name: str) -> None:
    vectors, total, least = CATALOGUE[name]
    removed = min(
        size for size in range(len(vectors) + 1) for A in combinations(range(len(vectors)), size)
        if parallel([v for k, v in enumerate(vectors) if k not in A])
    )  # fmt: skip
    assert (degree(vectors), alpha(vectors), smoothness(vectors)) == (total, least, least - 2)
    assert removed == least
    assert ("jumps" in promise(vectors)) == (least == 1)


def parallel(vectors: Vectors) -> bool:
    return all(a * d == b * c for (a, b) in vectors for (c, d) in vectors)


def test_quartic_is_linear_then_three_averages_then_the_hexagon_and_the_weighted_centroids() -> None:
    L, expected = engine(control(), THREE_DIRECTION_LINEAR), engine(control(), THREE_DIRECTION_QUARTIC)
    n, m = L.shape[:2]

    def shifted(a: int, b: int) -> Floats:
        return L[1 + a : n - 1 + a, 1 + b : m - 1 + b]

    ring = [(1, 0), (1, 1), (0, 1), (-1, 0), (-1, -1), (0, -1)]
    hexagon = 2 / 8 * shifted(0, 0) + sum(1 / 8 * shifted(*v) for v in ring)
    pairs = zip(ring, ring[1:] + ring[:1], strict=True)
    centroids = [2 / 8 * shifted(0, 0) + 3 / 8 * shifted(*v) + 3 / 8 * shifted(*w) for v, w in pairs]
    assert np.abs(averaged(averaged(averaged(L, (1, 0)), (0, 1)), (1, 1)) - expected).max() < 1e-12
    assert np.abs(hexagon - expected).max() < 1e-12
    assert np.abs(sum(centroids) / 6 - expected).max() < 1e-12


def test_linear_three_direction_keeps_points_and_inserts_midpoints_on_rows_columns_and_diagonals() -> None:
    P = control()
    Q = engine(P, THREE_DIRECTION_LINEAR)
    assert np.abs(Q[::2, ::2] - P).max() < 1e-12
    assert np.abs(Q[1::2, ::2] - (P[1:] + P[:-1]) / 2).max() < 1e-12
    assert np.abs(Q[::2, 1::2] - (P[:, 1:] + P[:, :-1]) / 2).max() < 1e-12
    assert np.abs(Q[1::2, 1::2] - (P[1:, 1:] + P[:-1, :-1]) / 2).max() < 1e-12


def test_quartic_rows_are_ten_and_six_ones_or_three_three_one_one() -> None:
    step = box_spline(THREE_DIRECTION_QUARTIC).step(Grid(6, 7))
    kinds = {tuple(sorted(w for _, w in step.stencil(k).terms)) for k in range(step.topology.n_vertices)}
    assert kinds == {(*[Fraction(1, 16)] * 6, Fraction(10, 16)), (Fraction(1, 8),) * 2 + (Fraction(3, 8),) * 2}


def test_one_round_of_cell_centroids_is_biquadratic_and_two_are_bicubic() -> None:
    P = control()
    one = mean_of_cells(quadrupled(P, [(1, 0), (0, 1)]))
    assert np.abs(one.reshape(-1, 3) - tensor_product(2, 2).step(Grid(9, 8)).apply(P.reshape(-1, 3))).max() < 1e-12
    two = mean_of_cells(one).reshape(-1, 3)
    assert np.abs(two - tensor_product(3, 3).step(Grid(9, 8)).apply(P.reshape(-1, 3))).max() < 1e-12
    assert np.abs(one[0, 0] - (9 * P[0, 0] + 3 * P[1, 0] + 3 * P[0, 1] + P[1, 1]) / 16).max() < 1e-12


def mean_of_cells(U: Floats) -> Floats:
    return (U[1:, 1:] + U[1:, :-1] + U[:-1, 1:] + U[:-1, :-1]) / 4


def test_bicubic_stencils_are_products_of_1_6_1_and_1_1() -> None:
    step = tensor_product(3, 3).step(Grid(6, 6))
    six, one = np.array([1, 6, 1]) / 8, np.array([1, 1]) / 2
    for point, expected in ((0, np.outer(one, one)), (1, np.outer(one, six)), (10, np.outer(six, six))):
        assert np.abs(np.sort(step.stencil(point).weights) - np.sort(expected.ravel())).max() < 1e-12


@pytest.mark.parametrize("vectors", [THREE_DIRECTION_QUARTIC, ((1, 0), (0, 1)) * 3, (*THREE_DIRECTION_QUARTIC, (1, 1))])
def test_differencing_along_v_removes_v_and_halves(vectors: Vectors) -> None:
    P = control()
    for v in set(vectors):
        rest = list(vectors)
        rest.remove(v)
        finer = difference(engine(P, vectors), v)
        assert np.abs(finer - engine(difference(P, v), rest) / 2).max() < 1e-12


def difference(P: Floats, v: tuple[int, int]) -> Floats:
    a, b = v
    return P[a:, b:] - P[: P.shape[0] - a, : P.shape[1] - b]


@given(random_vectors)
def test_points_at_their_placement_go_to_their_placement(vectors: Vectors) -> None:
    for odd in ((1, 0), (0, 1), (1, 1)):  # linear data survive where the symbol vanishes twice
        assume(sum((a * odd[0] + b * odd[1]) % 2 for a, b in vectors) >= 2)
    tau, rest = placement(vectors), without_two(vectors)
    lost = [-sum(min(0, v[axis]) for v in rest) for axis in (0, 1)]
    P = np.moveaxis(np.indices((12, 12)), 0, 2) + tau
    Q = engine(np.dstack([P, np.zeros((12, 12))]), vectors)[..., :2]
    expected = (np.moveaxis(np.indices(Q.shape[:2]), 0, 2) + lost + tau) / 2
    assert np.abs(Q - expected).max() < 1e-12


@catalogue
def test_an_impulse_settles_where_alpha_is_two_or_more_and_keeps_a_jump_where_it_is_one(name: str) -> None:
    vectors, _, least = CATALOGUE[name]
    Z = np.zeros((16, 16, 3))
    Z[8, 8] = 1
    for _ in range(4):
        Z = engine(Z, vectors)
    steepest = max(np.abs(np.diff(Z, axis=axis)).max() for axis in (0, 1))
    assert (steepest > 0.6) == (least == 1)


@pytest.mark.parametrize("name", [name for name in CATALOGUE if name != "one direction alone"])
def test_net_limits_are_what_deep_levels_tend_to(name: str) -> None:
    vectors = CATALOGUE[name][0]
    P = np.random.default_rng(2).normal(size=(10, 10, 3))
    limits = limit_points(Mesh(Grid(10, 10), P.reshape(-1, 3)), box_spline(vectors))
    deep = P
    for _ in range(5):
        deep = engine(deep, vectors)
    gaps = np.linalg.norm(deep.reshape(1, -1, 3) - limits.reshape(-1, 1, 3)[::7], axis=2).min(axis=1)
    assert gaps.max() < 0.15  # point distance of level 5
    if name in ("bilinear", "bicubic", "three-direction quartic", "three-direction linear"):
        again = limit_points(Mesh(Grid(*deep.shape[:2]), deep.reshape(-1, 3)), box_spline(vectors))
        gaps = np.linalg.norm(again.reshape(1, -1, 3) - limits.reshape(-1, 1, 3)[::7], axis=2).min(axis=1)
        assert gaps.max() < 1e-12


@pytest.mark.parametrize(("m", "n"), list(product(range(1, 5), repeat=2)))
def test_box_spline_values_read_off_the_mask_are_products_of_b_splines(m: int, n: int) -> None:
    nonzero = {k: w for k, w in tensor_weights(m, n).items() if w}
    assert box_weights(((1, 0),) * (m + 1) + ((0, 1),) * (n + 1)) == nonzero
    assert sum(nonzero.values()) == 1


def test_a_quartic_point_tends_to_a_half_and_six_twelfths() -> None:
    stencil = limit_stencil(box_spline(THREE_DIRECTION_QUARTIC), Grid(5, 5), 12)
    ring = [12 + 5 * a + b for a, b in ((1, 0), (1, 1), (0, 1), (-1, 0), (-1, -1), (0, -1))]
    assert dict(stencil.terms) == {12: Fraction(1, 2)} | dict.fromkeys(ring, Fraction(1, 12))


def test_what_has_no_limit_or_no_room_says_so() -> None:
    with pytest.raises(TopologyError, match="The limit jumps"):
        limit_points(Mesh(Grid(5, 5), np.zeros((25, 3))), box_spline(((1, 0), (1, 0), (0, 1))))
    with pytest.raises(TopologyError, match="at least 4 rows in s"):
        tensor_product(3, 3).step(Grid(3, 5))
    with pytest.raises(TopologyError, match="needs \\(0,1\\)"):
        box_spline([(1, 0), (1, 1)])

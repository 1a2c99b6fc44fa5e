"""What a box spline's vector set promises: degree, continuity, mask, and where its points lie.

Statements and formulas are those of [WW02]_, chapter 2.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from subdivision.arrays import Floats
from subdivision.manifold import TopologyError
from subdivision.passes import Vector
from subdivision.words import phrase


@dataclass(frozen=True)
class Mask:
    """Coefficients of ``4 * product of (1 + x^a y^b)/2`` over the vector set.

    Attributes
    ----------
    rows : tuple of tuples of Fraction
        ``rows[i][j]`` belongs to ``x^(i + origin[0]) y^(j + origin[1])``.
    origin : (int, int)
        The smallest exponents; negative where vectors have negative entries.
    """

    rows: tuple[tuple[Fraction, ...], ...]
    origin: Vector

    def __getitem__(self, exponents: Vector) -> Fraction:
        i, j = exponents[0] - self.origin[0], exponents[1] - self.origin[1]
        inside = 0 <= i < len(self.rows) and 0 <= j < len(self.rows[0])
        return self.rows[i][j] if inside else Fraction(0)


def checked_vectors(vectors: Sequence[Sequence[int]]) -> tuple[Vector, ...]:
    """The vectors as pairs of integers.

    Raises
    ------
    TopologyError
        For anything but integer pairs, a zero vector, or a missing (1, 0) or (0, 1).
    """
    chosen = []
    for v in vectors:
        if len(v) != 2 or any(int(x) != x for x in v):
            raise TopologyError(phrase("{vector} is not a pair of integers", vector=tuple(v)))
        chosen.append((int(v[0]), int(v[1])))
    if (0, 0) in chosen:
        raise TopologyError("the vector (0,0) would average every point with itself; leave it out")
    for needed in ((1, 0), (0, 1)):
        if needed not in chosen:
            raise TopologyError(
                phrase("the vector set needs ({a},{b}) at least once, for the quadrupling", a=needed[0], b=needed[1])
            )
    return tuple(chosen)


def degree(vectors: Sequence[Vector]) -> int:
    """Total degree of the polynomial pieces: the number of vectors less 2."""
    return len(vectors) - 2


def alpha(vectors: Sequence[Vector]) -> int:
    """How few vectors one must remove until the rest are multiples of one vector."""
    parallel = max(sum(a * d == b * c for c, d in vectors) for a, b in vectors)
    return len(vectors) - parallel


def smoothness(vectors: Sequence[Vector]) -> int:
    """k of C^k: alpha - 2; -1 means that the limit jumps."""
    return alpha(vectors) - 2


def promise(vectors: Sequence[Vector]) -> str:
    """The continuity in a sentence."""
    k = smoothness(vectors)
    if k < 0:
        return (
            "The limit jumps (alpha = 1): all vectors but one are parallel, so across one direction nothing is "
            "averaged and each row keeps its own value. This is what the rule says, not a failure."
        )
    return phrase(
        "The limit is piecewise polynomial of total degree {degree} and C^{k} (alpha = {alpha}).",
        degree=degree(vectors),
        k=k,
        alpha=alpha(vectors),
    )


def mask(vectors: Sequence[Vector]) -> Mask:
    """The mask of a vector set, by multiplying its symbol out."""
    terms: dict[Vector, Fraction] = {(0, 0): Fraction(4)}
    for a, b in checked_vectors(vectors):
        product: dict[Vector, Fraction] = {}
        for (i, j), c in terms.items():
            for to in ((i, j), (i + a, j + b)):
                product[to] = product.get(to, Fraction(0)) + c / 2
        terms = product
    low = min(i for i, _ in terms), min(j for _, j in terms)
    high = max(i for i, _ in terms), max(j for _, j in terms)
    rows = tuple(
        tuple(terms.get((i, j), Fraction(0)) for j in range(low[1], high[1] + 1)) for i in range(low[0], high[0] + 1)
    )
    return Mask(rows, low)


def placement(vectors: Sequence[Vector]) -> Floats:
    """(2,) float: tau, such that control point (i, j) of level L belongs to parameter ``((i, j) + tau) / 2^L``.

    The index counts from where the unshortened net began: a pass along a vector with a
    negative entry drops that many points from the front.
    """
    rest: Floats = np.array(vectors, dtype=float).sum(axis=0) - (1, 1)
    return (1 - rest) / 2

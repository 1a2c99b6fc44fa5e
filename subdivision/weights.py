"""Exact weights, one for each row of an operator, and their floating-point shadow."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from subdivision.arrays import Floats, Indices, Mask
from subdivision.exact import Exact


@dataclass(frozen=True, eq=False)
class Weights:
    """One exact weight per row, stored as a short table of values and an index into it."""

    table: tuple[Exact, ...]
    index: Indices

    @cached_property
    def values(self) -> Floats:
        """(n,) float."""
        values: Floats = np.array([float(w) for w in self.table], dtype=float)[self.index]
        return values

    def __getitem__(self, row: int) -> Exact:
        return self.table[int(self.index[row])]

    def __rsub__(self, number: int) -> "Weights":
        return Weights(tuple(number - w for w in self.table), self.index)

    def __rmul__(self, number: Fraction | int) -> "Weights":
        return Weights(tuple(number * w for w in self.table), self.index)


def by_count(rule: Callable[[int], Exact | int], counts: Indices) -> Weights:
    """``rule(count)`` for every row: weights that depend on the valence.  A count of 0 weighs 0."""
    present = np.flatnonzero(np.bincount(counts))
    slot = np.zeros(present[-1] + 1 if len(present) else 1, dtype=np.intp)
    slot[present] = np.arange(len(present))
    table = tuple(_number(rule(int(n))) if n else Fraction(0) for n in present)
    return Weights(table, slot[counts])


def by_value(values: Floats | Mask) -> Weights:
    """The numbers themselves as exact weights; meant for few distinct ones, such as sharpness."""
    distinct, index = np.unique(values, return_inverse=True)
    return Weights(tuple(Fraction(float(v)) for v in distinct), index.ravel())


def everywhere(weight: Fraction | float | int, n: int) -> Weights:
    """The same weight for ``n`` rows."""
    return Weights((_number(weight),), np.zeros(n, dtype=np.intp))


def _number(value: Exact | int | float) -> Exact:
    return Fraction(value) if isinstance(value, int | float) else value

"""Linear operators with three readings: applied, assembled, and exact.

A rule is written once, as a formula such as ``3/4 * midpoints + 1/4 * wings``, and then

* *applied* to points it gathers whole arrays, which is fast;
* *assembled* it is the sparse matrix whose rows are the stencils;
* *row by row* it is exact, because the formula holds fractions, never rounded decimals.

Python's ``3 / 4`` is exact in binary; other constants are written ``Fraction(1, 3)``.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import overload

import numpy as np
from scipy.sparse import _sparsetools, csr_array, diags_array

from subdivision.arrays import Floats, Indices, Mask, taken
from subdivision.exact import Row, add_rows
from subdivision.weights import Weights, everywhere


class Operator:
    """A linear map from ``shape[1]`` points to ``shape[0]`` points."""

    shape: tuple[int, int]

    def apply(self, points: Floats) -> Floats:
        """(shape[1], d) float -> (shape[0], d) float."""
        raise NotImplementedError

    def assemble(self) -> csr_array:
        """The matrix, (shape[0], shape[1])."""
        raise NotImplementedError

    def row(self, i: int) -> Row:
        """Row ``i``, exact."""
        raise NotImplementedError

    @overload
    def __matmul__(self, other: "Operator") -> "Operator": ...
    @overload
    def __matmul__(self, other: Floats) -> Floats: ...
    def __matmul__(self, other: "Operator | Floats") -> "Operator | Floats":
        return Product(self, other) if isinstance(other, Operator) else self.apply(other)

    def __add__(self, other: "Operator") -> "Operator":
        return Sum(self, other)

    def __rmul__(self, weight: "Weights | Fraction | float | int") -> "Operator":
        return Scaled(weight if isinstance(weight, Weights) else everywhere(weight, self.shape[0]), self)

    def __getitem__(self, rows: "Indices | Mask | slice") -> "Operator":
        """Some of the rows."""
        return Product(Pick(np.arange(self.shape[0])[rows], self.shape[0]), self)


@dataclass(frozen=True, eq=False)
class Pick(Operator):
    """Row ``i`` copies point ``index[i]``."""

    index: Indices
    n_columns: int

    @property
    def shape(self) -> tuple[int, int]:  # type: ignore[override]
        return len(self.index), self.n_columns

    def apply(self, points: Floats) -> Floats:
        return taken(points, self.index)

    def assemble(self) -> csr_array:
        n = len(self.index)
        return csr_array((np.ones(n), self.index.copy(), np.arange(n + 1)), shape=self.shape)

    def row(self, i: int) -> Row:
        return {int(self.index[i]): Fraction(1)}


@dataclass(frozen=True, eq=False)
class MeanOf(Operator):
    """Row ``i`` is the mean of the ``k`` points ``columns[i]``; ``columns`` is (n, k) int."""

    columns: Indices
    n_columns: int

    @property
    def shape(self) -> tuple[int, int]:  # type: ignore[override]
        return len(self.columns), self.n_columns

    def apply(self, points: Floats) -> Floats:
        total = taken(points, self.columns[:, 0])
        for column in self.columns.T[1:]:
            total += taken(points, column)
        total /= self.columns.shape[1]
        return total

    def assemble(self) -> csr_array:
        n, k = self.columns.shape
        matrix = csr_array(
            (np.full(n * k, 1 / k), self.columns.flatten(), np.arange(0, n * k + 1, k)), shape=self.shape
        )
        matrix.sum_duplicates()
        return matrix

    def row(self, i: int) -> Row:
        row: Row = {}
        share = Fraction(1, self.columns.shape[1])
        for column in self.columns[i].tolist():
            add_rows({column: share}, row)
        return row


@dataclass(frozen=True, eq=False)
class Mean(Operator):
    """Row ``rows[j]`` is the mean of the points ``columns[j]`` listed with it; unlisted rows are zero."""

    rows: Indices
    columns: Indices
    shape: tuple[int, int]

    @cached_property
    def counts(self) -> Indices:
        return np.bincount(self.rows, minlength=self.shape[0])

    def apply(self, points: Floats) -> Floats:
        n, d, points = len(self.rows), points.shape[1], np.ascontiguousarray(points, dtype=float)
        total = np.zeros((self.shape[0], d))
        rows, columns = (x.astype(np.int32, copy=False) for x in (self.rows, self.columns))
        _sparsetools.coo_matmat_dense(n, d, rows, columns, np.ones(n), points.reshape(-1), total.reshape(-1))
        total /= np.maximum(self.counts, 1)[:, None]
        return total

    def assemble(self) -> csr_array:
        weights = 1 / np.maximum(self.counts, 1)[self.rows]
        return csr_array((weights, (self.rows, self.columns)), shape=self.shape)

    @cached_property
    def _grouped(self) -> tuple[Indices, Indices]:
        return self.columns[np.argsort(self.rows, kind="stable")], np.r_[0, np.cumsum(self.counts)]

    def row(self, i: int) -> Row:
        grouped, start = self._grouped
        row: Row = {}
        columns = grouped[start[i] : start[i + 1]].tolist()
        share = Fraction(1, max(len(columns), 1))
        for column in columns:
            add_rows({column: share}, row)
        return row


@dataclass(frozen=True, eq=False)
class Scaled(Operator):
    """Row ``i`` times ``weights[i]``."""

    weights: Weights
    of: Operator

    @property
    def shape(self) -> tuple[int, int]:  # type: ignore[override]
        return self.of.shape

    def apply(self, points: Floats) -> Floats:
        scaled = self.of.apply(points)
        scaled *= self.weights.values[:, None] if len(self.weights.table) > 1 else float(self.weights.table[0])
        return scaled

    def assemble(self) -> csr_array:
        return csr_array(diags_array(self.weights.values) @ self.of.assemble())

    def row(self, i: int) -> Row:
        return {c: self.weights[i] * w for c, w in self.of.row(i).items()} if self.weights[i] else {}


@dataclass(frozen=True, eq=False)
class Sum(Operator):
    """Two operators, added."""

    a: Operator
    b: Operator

    @property
    def shape(self) -> tuple[int, int]:  # type: ignore[override]
        return self.a.shape

    def apply(self, points: Floats) -> Floats:
        total = self.a.apply(points)
        total += self.b.apply(points)
        return total

    def assemble(self) -> csr_array:
        return csr_array(self.a.assemble() + self.b.assemble())

    def row(self, i: int) -> Row:
        row = dict(self.a.row(i))
        add_rows(self.b.row(i), row)
        return {c: w for c, w in row.items() if w}


@dataclass(frozen=True, eq=False)
class Product(Operator):
    """First ``b``, then ``a``."""

    a: Operator
    b: Operator

    @property
    def shape(self) -> tuple[int, int]:  # type: ignore[override]
        return self.a.shape[0], self.b.shape[1]

    def apply(self, points: Floats) -> Floats:
        return self.a.apply(self.b.apply(points))

    def assemble(self) -> csr_array:
        return csr_array(self.a.assemble() @ self.b.assemble())

    def row(self, i: int) -> Row:
        row: Row = {}
        for middle, weight in self.a.row(i).items():
            add_rows(self.b.row(middle), row, weight)
        return {c: w for c, w in row.items() if w}


@dataclass(frozen=True, eq=False)
class Stack(Operator):
    """Operators on top of each other, all reading the same points (narrow ones read the first of them)."""

    blocks: tuple[Operator, ...]

    @cached_property
    def shape(self) -> tuple[int, int]:  # type: ignore[override]
        return sum(b.shape[0] for b in self.blocks), max(b.shape[1] for b in self.blocks)

    def apply(self, points: Floats) -> Floats:
        return np.concatenate([b.apply(points[: b.shape[1]]) for b in self.blocks])

    def assemble(self) -> csr_array:
        rows, columns, entries, above = [], [], [], 0
        for block in self.blocks:
            part = block.assemble().tocoo()
            rows.append(part.row + above)
            columns.append(part.col)
            entries.append(part.data)
            above += block.shape[0]
        places = np.concatenate(rows), np.concatenate(columns)
        return csr_array((np.concatenate(entries), places), shape=self.shape)

    def row(self, i: int) -> Row:
        for block in self.blocks:
            if i < block.shape[0]:
                return block.row(i)
            i -= block.shape[0]
        raise IndexError(f"row {i} past the end of {self.shape}")


def identity(n: int) -> Operator:
    """(n, n): every point to itself."""
    return Pick(np.arange(n), n)


def stack(*blocks: Operator) -> Operator:
    """The blocks on top of each other."""
    return Stack(blocks)


def widened(operator: Operator, n_columns: int) -> Operator:
    """The same rows, reading the first of ``n_columns`` points."""
    return operator @ Pick(np.arange(operator.shape[1]), n_columns)


def mix(weights: Weights, a: Operator, b: Operator) -> Operator:
    """Row by row, ``weights`` of ``a`` and the rest of ``b``."""
    if weights.table == (Fraction(1),):
        return a
    return weights * a + (1 - weights) * b

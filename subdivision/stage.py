"""A stage is one factor of a subdivision step; a stencil is one row of its matrix."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from fractions import Fraction
from functools import cached_property, reduce

import numpy as np
from scipy.sparse import csr_array

from subdivision.arrays import Floats, Indices, frozen
from subdivision.exact import Exact, Row, add_rows, spelled
from subdivision.operators import Operator
from subdivision.rows import Connectivity


class Role(IntEnum):
    """What a point is, for the eye: every role has its colour and its shape."""

    ORIGINAL = 0
    EDGE = 1
    FACE = 2
    CENTROID = 3
    MOVED = 4


@dataclass(frozen=True)
class Stencil:
    """``new[point]`` is the sum of ``weight * old[parent]`` over ``terms``, the heaviest first."""

    point: int
    terms: tuple[tuple[int, Exact], ...]

    @classmethod
    def of(cls, point: int, row: Mapping[int, Exact]) -> "Stencil":
        return cls(point, tuple(sorted(row.items(), key=lambda term: (-float(term[1]), term[0]))))

    @property
    def parents(self) -> Indices:
        return np.array([p for p, _ in self.terms], dtype=np.intp)

    @property
    def weights(self) -> Floats:
        return np.array([float(w) for _, w in self.terms])

    def weight(self, parent: int) -> Exact:
        """The exact weight of one parent (0 where it does not contribute)."""
        return dict(self.terms).get(parent, Fraction(0))

    def __str__(self) -> str:
        return " + ".join(f"{spelled(w)} v{p}" for p, w in self.terms).replace("+ -", "- ")


@dataclass(frozen=True, eq=False)
class Stage:
    """New points ``operator @ old points``, connected by ``topology``.

    Attributes
    ----------
    operator : (n_new, n_old)
        Rows sum to one.
    topology : Connectivity
        Connectivity *after* the stage.  Points past its vertices are helpers: drawn, averaged,
        and dropped by a later stage.
    carries : (n_new,) int
        The old point that each new point continues; -1 where it is born.
    roles : (n_new,) int
        The ``Role`` of each new point once the stage is over.
    """

    name: str
    operator: Operator
    topology: Connectivity
    carries: Indices
    roles: Indices

    def __post_init__(self) -> None:
        object.__setattr__(self, "carries", frozen(self.carries))
        object.__setattr__(self, "roles", frozen(self.roles))

    @property
    def n_points(self) -> int:
        return self.operator.shape[0]

    @cached_property
    def matrix(self) -> csr_array:
        """(n_new, n_old) sparse."""
        return self.operator.assemble()

    @cached_property
    def born(self) -> Indices:
        """The points that were not there before."""
        return frozen(np.flatnonzero(self.carries < 0))

    @cached_property
    def moves(self) -> bool:
        """Whether a point that was there moves: the stage is geometric, else topological."""
        kept = np.flatnonzero(self.carries >= 0)
        stay = csr_array(
            (np.ones(len(kept)), self.carries[kept], np.arange(len(kept) + 1)), (len(kept), self.matrix.shape[1])
        )
        return bool(abs(self.matrix[kept] - stay).max() > 1e-12) if len(kept) else False

    @cached_property
    def _rows(self) -> dict[int, Row]:
        """The rows that have been asked for."""
        return {}

    def row(self, point: int) -> Mapping[int, Exact]:
        """The weights of ``point``, by the points before this stage."""
        if point not in self._rows:
            self._rows[point] = self.operator.row(point)
        return self._rows[point]

    def stencil(self, point: int) -> Stencil:
        """How ``point`` is made of the points before this stage."""
        return Stencil.of(point, self.row(point))


@dataclass(frozen=True, eq=False)
class Step:
    """Stages in a row; for one subdivision step ``matrix`` is the scheme's."""

    stages: tuple[Stage, ...]

    @property
    def topology(self) -> Connectivity:
        return self.stages[-1].topology

    @cached_property
    def matrix(self) -> csr_array:
        """(n_new, n_old) sparse: the product of the stages."""
        matrix = reduce(lambda done, stage: csr_array(stage.matrix @ done), self.stages[1:], self.stages[0].matrix)
        matrix.eliminate_zeros()
        return matrix

    def apply(self, points: Floats) -> Floats:
        return reduce(lambda done, stage: stage.operator.apply(done), self.stages, points)

    def stencil(self, point: int) -> Stencil:
        """How ``point`` is made of the points before the first stage: exact, by walking back."""
        row: Row = {point: Fraction(1)}
        for stage in reversed(self.stages):
            before: Row = {}
            for column, weight in row.items():
                add_rows(stage.row(column), before, weight)
            row = {c: w for c, w in before.items() if w}
        return Stencil.of(point, row)

    def influence(self, point: int) -> Floats:
        """(n_new,) float: how much of one old ``point`` every new point holds: a column."""
        return self.matrix[:, [point]].toarray().ravel()


def grown(old: int, new: int) -> Indices:
    """``carries`` of a stage that keeps ``old`` points and brings ``new`` ones."""
    return np.concatenate([np.arange(old), np.full(new, -1)])

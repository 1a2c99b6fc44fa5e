"""The steps of interpolating quads: the first by half-edges, later ones on grids, as ``grids`` lays them out."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np
from scipy.sparse import _sparsetools, csr_array

from subdivision.arrays import Floats, Indices, Small, taken
from subdivision.plans.kernels import Rows

AT_ONCE = 12_000
"""How many points are gathered at a time: they then stay in the cache."""


@lru_cache(maxsize=16)
def curve(n: int, tension: Fraction) -> Floats:
    """(n, n + 3) float: the new points of ``n`` edges in a row, from its points and one beyond each end."""
    w, made = float(tension), np.zeros((n, n + 3))
    for i in range(n):
        made[i, i : i + 4] = -w, 1 / 2 + w, 1 / 2 + w, -w
    return made


@lru_cache(maxsize=128)
def beyond(n: int, tension: Fraction) -> Floats:
    """(4 n, 2 n) float: what lies beyond a vertex of ``n`` quads, from its neighbours and their opposite corners.

    First the virtual points of its edges, by the rule of the scheme; then what each quad sees beyond the edge that
    follows its corner, beyond the edge before, and across.
    """
    neighbour, opposite = np.split(np.eye(2 * n), 2)
    lean = float(2 * tension / (1 + 2 * tension))
    back_two, back, here, on, on_two = (np.roll(np.arange(n), -j) for j in range(-2, 3))
    three = neighbour[back] + neighbour[here] + neighbour[on]
    four = opposite[back_two] + opposite[back] + opposite[here] + opposite[on]
    virtual = 4 * neighbour.mean(axis=0) - three + lean * (four - 4 * opposite.mean(axis=0))
    follows = 1 / 2 * (virtual + neighbour[on_two])
    precedes = 1 / 2 * (virtual[on] + neighbour[back])
    return np.concatenate([virtual, follows, precedes, 1 / 2 * (opposite[back_two] + opposite[on_two])])


@dataclass(frozen=True, eq=False)
class First:
    """The first step: every half-edge adds what it has to the point of its edge, and of its face.

    Attributes
    ----------
    origin, edge, beside : (n_halfedges,) int
        The vertex and edge of each half-edge, and the edge opposite in the face on the other side.
    fans : (((2 valence, count) int, (valence, count) int), ...)
        For each valence the neighbours of the vertices, then the opposite corners; and the edges.
    kept : Rows, optional
        What makes the points of edges, as one sparse matrix: slower to make, faster to apply.
    """

    origin: Small
    edge: Small
    beside: Small
    fans: tuple[tuple[Indices, Small], ...]
    kept: Rows | None = None
    more = 0

    def apply(self, seen: Floats, tension: Fraction, made: Floats) -> None:
        """Write the points of faces and edges."""
        H, d, w = len(self.edge), seen.shape[1], float(tension)
        faces, edges = np.split(made, [H // 4])
        if self.kept:
            self.kept.apply(seen, edges)
        else:
            self._add_edges(seen, tension, edges)
        faces.fill(0)
        start = np.arange(0, H + 1, 4, dtype=np.int32)
        for weight, four in ((1 / 4 + w / 2, self.edge), (-w / 2, self.beside)):
            parts = start, four, np.full(H, weight)
            _sparsetools.csr_matvecs(len(faces), len(edges), d, *parts, edges.reshape(-1), faces.reshape(-1))

    def _add_edges(self, points: Floats, tension: Fraction, edges: Floats) -> None:
        each, d, w = np.arange(len(self.edge), dtype=np.int32), points.shape[1], float(tension)
        edges.fill(0)
        _add(self.edge, self.origin, 1 / 2 + w, points, edges)
        for ring, at in self.fans:
            n, rule = len(at), beyond(len(at), tension)[: len(at)]
            for some in _runs(ring):
                virtual = (rule @ taken(points, ring[:, some]).reshape(2 * n, -1)).reshape(-1, d)
                _add(at[:, some].reshape(-1), each[: len(virtual)], -w, virtual, edges)

    def assembled(self, tension: Fraction, n_edges: int, n_vertices: int) -> "First":
        """The same with its matrix."""
        w = float(tension)
        entries = [(self.edge, self.origin, np.full(len(self.edge), 1 / 2 + w))]
        for ring, at in self.fans:
            rule = -w * beyond(len(at), tension)[: len(at)]
            made, read = np.nonzero(rule)
            held = np.repeat(rule[made, read], ring.shape[1])
            entries.append((at[made].reshape(-1), ring[read].reshape(-1), held))
        row, column, value = (np.concatenate(parts) for parts in zip(*entries, strict=True))
        return replace(self, kept=Rows(csr_array((value, (row, column)), shape=(n_edges, n_vertices))))


@dataclass(frozen=True, eq=False)
class Later:
    """A step of grids with ``n`` edges along each side, 2 or more.

    All numbers are those of the points before; what lies beyond corners follows them.

    Attributes
    ----------
    rings : ((2 valence, count) int, ...)
        For each valence the neighbours of the vertices, then the opposite corners.
    rows : (n + 3, n_edges) int
    grids : ((n + 3) ** 2, n_faces) int
    """

    n: int
    rings: tuple[Indices, ...]
    rows: Indices
    grids: Indices

    @property
    def more(self) -> int:
        """How many points it wants to see beyond corners."""
        return 4 * sum(ring.size // 2 for ring in self.rings)

    def apply(self, seen: Floats, tension: Fraction, made: Floats) -> None:
        """Write the points inside the grids, and along the edges."""
        self._look_beyond(seen, tension)
        rule, n, inner, d, F = curve(self.n, tension), self.n, 2 * self.n - 1, seen.shape[1], self.grids.shape[1]
        inside = made[: inner * inner * F].reshape(inner, inner, F * d)
        along = made[inner * inner * F :].reshape(inner, -1)
        for some in _runs(self.grids):
            read = taken(seen, self.grids[:, some]).reshape(n + 3, n + 3, -1)
            half = np.matmul(rule, read.reshape(n + 3, -1)).reshape(n, n + 3, -1)
            out = inside[:, :, some.start * d : some.stop * d]
            out[1::2, 1::2] = read[2:-2, 2:-2]
            out[::2, 1::2] = half[:, 2:-2]
            np.matmul(rule, read[2:-2], out=out[1::2, ::2])
            np.matmul(rule, half, out=out[::2, ::2])
        for some in _runs(self.rows):
            row = taken(seen, self.rows[:, some]).reshape(n + 3, -1)
            made_of_it = along[:, some.start * d : some.stop * d]
            made_of_it[1::2] = row[2:-2]
            np.matmul(rule, row, out=made_of_it[::2])

    def _look_beyond(self, seen: Floats, tension: Fraction) -> None:
        """Write what lies beyond the corners behind the points."""
        end, d = len(seen) - self.more, seen.shape[1]
        for ring in self.rings:
            (two_n, count), begin = ring.shape, end
            end += 2 * ring.size
            read = taken(seen, ring).reshape(two_n, -1)
            np.matmul(beyond(two_n // 2, tension), read, out=seen[begin:end].reshape(-1, count * d))


def _add(at: Small, of: Small, weight: float, points: Floats, out: Floats) -> None:
    n, d = len(at), points.shape[1]
    _sparsetools.coo_matmat_dense(n, d, at, of, np.full(n, weight), points.reshape(-1), out.reshape(-1))


def _runs(read: np.ndarray[Any, Any]) -> Iterator[slice]:
    """The columns of what is read, in short runs."""
    rows, n = read.shape
    each = max(AT_ONCE // rows, 1)
    return (slice(begin, min(begin + each, n)) for begin in range(0, n, each))

"""Many levels at once where triangles get middles and edges are flipped: a triangle's descendants by one table.

What is numbered after a triangle is its block: half-edge ``h`` of a level is triangle ``h`` of
the next, so that ``levels`` on the descendants of triangle ``f`` are ``3 ** levels * f`` and those that
follow, and a point is numbered as the triangle it is the middle of.  The block has the shape of
a propeller, for every flipped edge reaches into the triangle beyond; blocks have no point in common,
and no point of a level is in none but the vertices that the first level began with.

After a step only the first corner of a triangle may be extraordinary, so the kind of a block is
its valence.  The table reads the points one step on, where all vertices near have moved once,
each by its own valence: from there on no valence matters but that of the first corner.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from subdivision import refine_sqrt3
from subdivision.arrays import Floats, Indices, taken
from subdivision.plans.kernels import by_count
from subdivision.plans.middle_steps import MiddleStep, Reach
from subdivision.plans.poles import VALENCES, Table, by_valence, poles, rows, shown
from subdivision.topology import Topology

AT_ONCE = 512
"""How many blocks are made at a time: what they read and make then stays in the cache."""

DEPTHS = range(3, 5)
"""Of fewer levels a table is not worth it; of more, propellers would reach farther than what is read."""


@dataclass(frozen=True, eq=False)
class MiddleTables:
    """``depth`` levels from ``step.coarse``, which a step has made; ``step``, the first, is done already.

    Attributes
    ----------
    blocks : (((n,) int, (n, n_read) int, (n_own, n_read) float), ...)
        For each kind the triangles, what round them is read, and the table.
    """

    step: MiddleStep
    depth: int
    blocks: tuple[tuple[Indices, Indices, Floats], ...]

    @property
    def n_points(self) -> int:
        """How many points it makes."""
        t = self.step.coarse
        return int(t.n_vertices + t.n_faces * (3**self.depth // 2))

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices + n_faces, d) float -> (n_points, d) float, into ``out`` if there is one."""
        (_, d), V, F = points.shape, self.step.coarse.n_vertices, self.step.coarse.n_faces
        made = np.empty((self.n_points, d)) if out is None else out
        self._move_vertices(points[:V], points[V:], made[:V])
        levels = [made[V + F * begin :][: F * n].reshape(F, n, d) for begin, n in _levels(self.depth)]
        columns = np.ascontiguousarray(points.T)
        for faces, ring, table in self.blocks:
            for begin in range(0, len(faces), AT_ONCE):
                some = slice(begin, begin + AT_ONCE)
                own = np.empty((len(faces[some]), len(table), d))
                for i, column in enumerate(columns):
                    own[:, :, i] = taken(column, ring[some]) @ table.T
                for level, (first, n) in zip(levels, _levels(self.depth), strict=True):
                    level[faces[some]] = own[:, first : first + n]
        return made

    def _move_vertices(self, points: Floats, middles: Floats, out: Floats) -> None:
        """Where the vertices are in the end: as far as they ever go to the mean of the middles that are there now."""
        self.step.around(middles, out)
        counts = self.step.counts
        far = by_count(lambda n: _far(float(self.step.reach(n)), self.depth - 1), counts)
        out *= (far / np.maximum(counts, 1))[:, None]
        out += (1 - far)[:, None] * points

    @cached_property
    def topology(self) -> Topology:
        """After all steps."""
        t = self.step.topology
        for _ in range(self.depth - 1):
            t = refine_sqrt3.flipped(t)
        return t


def middle_tables(step: MiddleStep, depth: int, at_most: int) -> MiddleTables | None:
    """Tables for ``depth`` levels of which ``step`` is the first.

    None where a valence is not among ``VALENCES``, or where there are more than ``at_most`` of them.
    """
    t = step.coarse
    counts = step.counts[t.origin[::3]]
    present = np.flatnonzero(np.bincount(counts)).tolist()
    if len(present) > at_most or not set(present) <= set(VALENCES):
        return None
    blocks = []
    for n, (walks, table) in zip(present, by_valence(_computed, present, depth, step.reach), strict=True):
        faces = np.flatnonzero(counts == n)
        blocks.append((faces, _ring(t, faces, n)[:, walks], table))
    return MiddleTables(step, depth, tuple(blocks))


def _levels(depth: int) -> list[tuple[int, int]]:
    """What a block has of each level: how many points are of the levels before, and how many of this one."""
    return [(3**level // 2, 3**level) for level in range(depth)]


def _far(reach: float, steps: int) -> float:
    """How far a vertex goes in so many steps to the mean of its neighbours, which go 1/3 of the way to it."""
    together = np.array([[1 - reach / 3 * 2, reach / 3 * 2], [1 / 3, 2 / 3]])
    return float(np.linalg.matrix_power(together, steps)[0, 1])


def _ring(t: Topology, faces: Indices, n: int) -> Indices:
    """(n_faces, ...) int: what is round each of ``faces`` one step on, some of it twice.

    Of each corner, the first one of valence ``n``, all triangles; the first three neighbours; and one
    triangle beyond, as far as the block reaches.
    """
    found = []
    for corner in range(3):
        spoke = 3 * faces + corner
        for turn in range(6 if corner else n):
            found.append(t.n_vertices + spoke // 3)
            if turn < 3:
                found.append(taken(t.origin, taken(t.next, spoke)))
            if turn == 2:
                found.append(t.n_vertices + taken(t.twin, taken(t.next, spoke)) // 3)
            spoke = taken(t.next, taken(t.twin, spoke))
    return np.stack(found, axis=1)


def _computed(valences: list[int], depth: int, reach: Reach) -> list[Table]:
    """The blocks of the first triangles at poles, from the rings."""
    t, first = poles(valences, splits=2)
    steps = [MiddleStep(t, reach)]
    while len(steps) < depth:
        steps.append(MiddleStep(steps[-1].topology, reach))
    levels = zip(steps, _levels(depth), strict=True)
    own = [step.coarse.n_vertices + n * first[:, None] + np.arange(n) for step, (_, n) in levels]
    rings = [_ring(t, face, n)[0] for n, face in zip(valences, first[:, None], strict=True)]
    return shown(rows(np.concatenate(own, axis=1).ravel(), steps[1:]), rings)

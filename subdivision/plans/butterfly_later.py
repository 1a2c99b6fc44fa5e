"""One step of the modified butterfly from what a step has made: the second and all after it.

All is told by the mesh before, a quarter as large, as in ``later``.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from subdivision import refine
from subdivision.arrays import Floats, Small, taken, turned
from subdivision.plans.butterfly_steps import ButterflyStep, add, ahead_of, others
from subdivision.plans.kernels import Rows
from subdivision.topology import Topology

AT_ONCE = 2048
"""How many triangles there are in a run: what they make stays in the cache."""


@dataclass(frozen=True, eq=False)
class ButterflyLater:
    """The same as ``step``, quicker: told by the mesh ``before``, a quarter as large, of which a step has made its own.

    At each corner of a triangle the step before has cut off a small one.  The point on the edge inside is
    made there at once; to those on the two edges from the corner is added what is on this side.  Weights
    are counted in sixteenths: 8 for both ends, 2 for the wings, -1 for the four corners beyond.
    """

    before: Topology
    step: ButterflyStep

    @property
    def coarse(self) -> Topology:
        """What it begins with."""
        return self.step.coarse

    @property
    def n_points(self) -> int:
        """How many points it makes."""
        return self.step.n_points

    @property
    def topology(self) -> Topology:
        """After the step."""
        return self.step.topology

    def assembled(self) -> Rows:
        """The same as one sparse matrix."""
        return self.step.assembled()

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float -> (n_points, d) float, into ``out`` if there is one."""
        t, (N, d) = self.before, points.shape
        E = t.n_edges
        made = np.empty((self.n_points, d)) if out is None else out
        made[:N] = points
        edges = made[N:]
        halves, inner = edges[: 2 * E], edges[2 * E :].reshape(-1, 3, d)
        halves.fill(0)
        for begin in range(0, t.n_faces, AT_ONCE):
            some = slice(begin, begin + AT_ONCE)
            corner, ahead, right, left = (taken(points, index[some]) for index in self._around)
            behind, beyond = turned(ahead, -1), turned(ahead, 1)
            both = ahead + behind  # the ends of the edge inside; corner and beyond are its wings
            inside = 8 * both
            inside += 2 * (corner + beyond)
            inside -= right
            inside -= left
            inside -= others(corner)
            np.multiply(inside, 1 / 16, out=inner[some])
            corner *= 4
            corner -= beyond
            corner += 2 * both
            ahead *= 2
            ahead += corner
            ahead -= left
            behind *= 2
            behind += corner
            behind -= right
            add(self._half_ahead[some].ravel(), ahead.reshape(-1, d), halves, 1 / 16)
            add(self._half_behind[some].ravel(), behind.reshape(-1, d), halves, 1 / 16)
        self.step.make_over(points, edges)
        return made

    @cached_property
    def _around(self) -> tuple[Small, Small, Small, Small]:
        """(n_faces, 3) int each: the vertex at each corner, the point on the edge ahead, and those right and left.

        Round the vertex, clockwise, the one on the right comes next after the one ahead; counter-clockwise the one on
        the left comes next after the one behind.  Where there is none it is the origin of the half of the rim there,
        as ``step`` has it.
        """
        t, V = self.before, self.before.n_vertices
        origin, edge, twin = (x.reshape(-1, 3) for x in (t.origin, V + t.edge, t.twin))
        right, left = (taken(turned(edge, by).ravel(), twin) for by in (1, -1))
        if len(self.step.rim):
            right, left = np.where(twin < 0, origin, right), np.where(twin < 0, edge, left)
        return origin, edge, right, turned(left, -1)

    @cached_property
    def _half_ahead(self) -> Small:
        """(n_faces, 3) int: the half, at the corner, of the edge that leaves it."""
        return refine.half_edges(self.before).astype(np.int32).reshape(-1, 3)

    @cached_property
    def _half_behind(self) -> Small:
        """... and of the edge that arrives."""
        return turned(self._half_ahead ^ 1, -1)


Butterfly: TypeAlias = ButterflyStep | ButterflyLater


def butterfly_after(before: Butterfly) -> ButterflyLater:
    """The step after it: half-edge ``3 h`` leaves the vertex that ``h`` left, along the first half of its edge."""
    step = before.step if isinstance(before, ButterflyLater) else before
    rim = np.concatenate([3 * step.rim, 3 * ahead_of(step.rim) + 2])
    spokes = tuple(3 * some for some in step.spokes)
    return ButterflyLater(step.coarse, ButterflyStep(step.topology, step.beside, rim, spokes))

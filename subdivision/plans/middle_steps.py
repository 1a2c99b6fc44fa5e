"""One step of a scheme that gives every triangle a middle and flips the edges, on whole arrays.

A middle is the mean of its triangle; afterwards every old vertex goes some way to the mean of
the middles round it, which are its neighbours by then.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import _sparsetools, csr_array, diags_array, vstack

from subdivision import refine_sqrt3
from subdivision.arrays import Floats, Small
from subdivision.exact import Exact
from subdivision.plans.kernels import Rows, by_count
from subdivision.topology import Topology

Reach = Callable[[int], Exact | int]
"""Valence -> how far an old vertex goes to the mean of the middles round it."""


@dataclass(frozen=True, eq=False)
class MiddleStep:
    """One step from ``coarse``, closed and all triangles, numbered as the stages do: the vertices, then the middles."""

    coarse: Topology
    reach: Reach

    @property
    def n_points(self) -> int:
        """How many points it makes."""
        return self.coarse.n_vertices + self.coarse.n_faces

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float -> (n_points, d) float, into ``out`` if there is one."""
        (V, d), F = points.shape, self.coarse.n_faces
        made = np.empty((self.n_points, d)) if out is None else out
        vertices, middles = made[:V], made[V:]
        middles.fill(0)
        third = np.full(3 * F, 1 / 3)
        _sparsetools.csr_matvecs(F, V, d, self._start, self._corners, third, points.reshape(-1), middles.reshape(-1))
        self.around(middles, vertices)
        vertices *= (self._far / np.maximum(self.counts, 1))[:, None]
        vertices += (1 - self._far)[:, None] * points
        return made

    def around(self, middles: Floats, out: Floats) -> None:
        """The sum of the ``middles`` (n_faces, d) round each vertex, into ``out`` (n_vertices, d)."""
        (F, d), V = middles.shape, len(out)
        out.fill(0)
        ones = np.ones(3 * F)
        _sparsetools.csc_matvecs(V, F, d, self._start, self._corners, ones, middles.reshape(-1), out.reshape(-1))

    def assembled(self) -> Rows:
        """The same as one sparse matrix."""
        F, V, ones = self.coarse.n_faces, self.coarse.n_vertices, np.ones(3 * self.coarse.n_faces)
        corners = csr_array((ones, self._corners, self._start), shape=(F, V))
        middles = corners * (1 / 3)
        vertices = diags_array(self._far / np.maximum(self.counts, 1)) @ (corners.T.tocsr() @ middles)
        return Rows(csr_array(vstack([diags_array(1 - self._far) + vertices, middles], format="csr")))

    @cached_property
    def topology(self) -> Topology:
        """After the step."""
        return refine_sqrt3.flipped(self.coarse)

    @cached_property
    def counts(self) -> Small:
        """(n_vertices,) int: how many triangles are round each vertex."""
        return np.bincount(self.coarse.origin, minlength=self.coarse.n_vertices).astype(np.int32)

    @cached_property
    def _far(self) -> Floats:
        return by_count(lambda n: float(self.reach(n)), self.counts)

    @cached_property
    def _corners(self) -> Small:
        return self.coarse.origin.astype(np.int32, copy=False)

    @cached_property
    def _start(self) -> Small:
        return np.arange(0, 3 * self.coarse.n_faces + 1, 3, dtype=np.int32)

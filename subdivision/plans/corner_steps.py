"""Dual schemes on whole arrays: all faces of one size become their new corners by one product.

That is one step of most of them, and two of mid-edge subdivision, whose points come back to the corners.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csr_array

from subdivision.arrays import Floats, taken
from subdivision.exact import Exact
from subdivision.plans.corner_numbers import Numbering
from subdivision.plans.kernels import Rows
from subdivision.topology import Topology

Wave = Callable[[int, int], Exact | int]
"""Number of corners, steps ahead -> what a new corner holds of the corner so far ahead of it in its face."""


@dataclass(frozen=True, eq=False)
class CornerStep:
    """From ``coarse``, numbered as the stages do: a point for every half-edge, in the corner it leaves."""

    coarse: Topology
    wave: Wave
    numbering: Numbering

    @property
    def n_points(self) -> int:
        """How many points it makes."""
        return self.coarse.n_halfedges

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float -> (n_points, d) float, into ``out`` if there is one."""
        sizes, d = self.coarse.face_sizes, points.shape[1]
        made = np.empty((self.n_points, d)) if out is None else out
        start = np.cumsum(sizes) - sizes
        for k in np.flatnonzero(np.bincount(sizes)).tolist():
            h = (start[sizes == k][:, None] + np.arange(k)).ravel()
            corners = taken(points, taken(self.coarse.origin, h)).reshape(-1, k * d)
            made[h] = (corners @ np.kron(weights(self.wave, k).T, np.eye(d))).reshape(-1, d)
        return made

    def assembled(self) -> Rows:
        """The same as one sparse matrix."""
        sizes, n = self.coarse.face_sizes, self.n_points
        count = np.repeat(sizes, sizes)
        start = np.repeat(np.cumsum(sizes) - sizes, sizes)
        row = np.repeat(np.arange(n), count)
        ahead = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
        k, first = count[row], start[row]
        table = np.zeros((int(sizes.max()) + 1, int(sizes.max())))
        for size in np.unique(sizes).tolist():
            table[size, :size] = weights(self.wave, size)[0]
        corner = first + (row - first + ahead) % k
        places = row, self.coarse.origin[corner]
        return Rows(csr_array((table[k, ahead], places), shape=(n, self.coarse.n_vertices)))

    @cached_property
    def topology(self) -> Topology:
        """After the step, or the steps."""
        return self.numbering.refined(self.coarse)


def weights(wave: Wave, k: int) -> Floats:
    """(k, k): row by row what each new corner of a face of ``k`` holds of its corners."""
    row: Floats = np.array([float(wave(k, j)) for j in range(k)])
    return np.take(row, (np.arange(k) - np.arange(k)[:, None]) % k)

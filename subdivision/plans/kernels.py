"""One subdivision step on whole arrays: every half-edge adds what it has to the points it concerns.

The stages of a scheme say the same in words; tests hold the two together.  What distinguishes
a scheme from the others that refine alike is its ``reach``; all else follows from the
topology, and nothing is sorted or searched.  ``later`` has steps from what a step has made,
whose half-edges are known without being asked.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.sparse import _sparsetools, csr_array, diags_array, vstack

from subdivision import refine
from subdivision.arrays import Floats, Indices, Small, taken
from subdivision.exact import Exact
from subdivision.plans.sharp_rows import SharpRows, sharp_rows
from subdivision.topology import Topology

Reach = Callable[[int], Exact | int]
"""Valence -> how far a smooth vertex goes to the mean of its ring."""


@dataclass(frozen=True)
class Rule:
    """A scheme, as far as speed is concerned: how many corners the faces have that it makes, and its reach."""

    size: int
    reach: Reach

    def each(self, n: int) -> float:
        """What each corner of a smooth vertex of valence ``n`` weighs: the neighbour along it, in quads its face too.

        Half of the ring of a quad mesh are neighbours, half the points of faces around; of a triangle mesh all
        are neighbours.
        """
        return _number(self.reach, n) / n / self.brought

    @property
    def brought(self) -> int:
        """How many points of its ring a corner brings to its vertex."""
        return 2 if self.size == 4 else 1

    def corners(self, counts: Indices) -> Floats:
        """``each`` for many numbers of corners; 0 for none."""
        return by_count(self.each, counts)


@dataclass(frozen=True, eq=False)
class Kernel:
    """One step from ``coarse``, numbered as the stages do.

    Attributes
    ----------
    size : int
        How many corners the faces have that it makes.
    origin, edge, ahead, behind : (n_halfedges,) int
        The vertex and edge of each half-edge, and its neighbours in the face; ``behind`` for triangles only.
    start : (n_faces + 1,) int
        Where the half-edges of each face begin.
    ends, part : (n_halfedges,) float
        What an edge point holds of each end, and of each other point that a half-edge brings: 1/4 and 1/4 for quads,
        3/8 and 1/8 for triangles.  Vertices are brought the same part.
    own, corner : (n_vertices,) float
        How much a vertex holds of itself, and of what each of its corners brings.
    sharp : SharpRows or None
        None where everything is smooth.
    """

    coarse: Topology
    size: int
    origin: Small
    edge: Small
    ahead: Small
    behind: Small
    start: Small
    ends: Floats
    part: Floats
    own: Floats
    corner: Floats
    sharp: SharpRows | None

    @property
    def n_points(self) -> int:
        """How many points it makes."""
        return self.coarse.n_vertices + self.coarse.n_edges + (self.coarse.n_faces if self.size == 4 else 0)

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float -> (n_points, d) float, into ``out`` if there is one."""
        made = np.empty((self.n_points, points.shape[1])) if out is None else out
        made.fill(0)
        vertices, centres, edges = np.split(made, [len(points), self.n_points - self.coarse.n_edges])
        if self.size == 4:
            self._face_points(points, centres)
            self._spread(self.edge, centres, edges)
            self._spread(self.origin, centres, vertices)
        else:
            _add(self.edge, self.behind, self.part, points, edges)
        _add(self.edge, self.origin, self.ends, points, edges)
        _add(self.origin, self.ahead, self.part, points, vertices)
        vertices *= self.corner[:, None]
        vertices += self.own[:, None] * points
        if self.sharp:
            self.sharp.apply(points, vertices, edges)
        return made

    def refined(self) -> Topology:
        """The topology after the step."""
        return refine.quads(self.coarse) if self.size == 4 else refine.triangles(self.coarse)

    def _face_points(self, points: Floats, out: Floats) -> None:
        n, d = out.shape
        _sparsetools.csr_matvecs(
            n, len(points), d, self.start, self.origin, self.part, points.reshape(-1), out.reshape(-1)
        )
        if not self.coarse.is_quadrilateral:
            out *= (4 / self.coarse.face_sizes)[:, None]

    def _spread(self, at: Small, centres: Floats, out: Floats) -> None:
        """Every half-edge adds a part of the point of its face to ``out`` ``at`` it."""
        _sparsetools.csc_matvecs(
            len(out), len(centres), out.shape[1], self.start, at, self.part, centres.reshape(-1), out.reshape(-1)
        )


def kernel(t: Topology, rule: Rule) -> Kernel:
    """One step on ``t``."""
    ends, part = (1 / 4, 1 / 4) if rule.size == 4 else (3 / 8, 1 / 8)
    counts = np.bincount(t.origin, minlength=t.n_vertices)
    corner = rule.corners(counts)
    return Kernel(
        t,
        rule.size,
        origin=_small(t.origin),
        edge=_small(t.edge),
        ahead=_small(taken(t.origin, t.next)),
        behind=_small(refine.before(t, t.origin) if rule.size == 3 else t.origin[:0]),
        start=_small(np.concatenate([[0], np.cumsum(t.face_sizes)])),
        ends=np.full(t.n_halfedges, ends),
        part=np.full(t.n_halfedges, part),
        own=1 - rule.brought * corner * counts,
        corner=corner / part,
        sharp=sharp_rows(t),
    )


def by_count(number: Callable[[int], float], counts: Indices) -> Floats:
    """``number`` of each of the ``counts``; 0 for none."""
    table = np.zeros(int(counts.max(initial=0)) + 1)
    present = np.flatnonzero(np.bincount(counts))
    for n in present[present > 0]:
        table[n] = number(int(n))
    return table[counts]


@lru_cache(maxsize=1024)
def _number(reach: Reach, n: int) -> float:
    return float(reach(n))


def _add(at: Small, of: Small, weight: Floats, points: Floats, out: Floats) -> None:
    _sparsetools.coo_matmat_dense(len(at), out.shape[1], at, of, weight, points.reshape(-1), out.reshape(-1))


def _small(indices: Indices) -> Small:
    return indices.astype(np.int32, copy=False)


@dataclass(frozen=True, eq=False)
class Rows:
    """A kernel as one sparse matrix: slower to make, faster to apply."""

    matrix: csr_array

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float -> (n_points, d) float, into ``out`` if there is one."""
        (n, m), d = self.matrix.shape, points.shape[1]
        made = np.empty((n, d)) if out is None else out
        made.fill(0)
        parts = self.matrix.indptr, self.matrix.indices, self.matrix.data
        _sparsetools.csr_matvecs(n, m, d, *parts, points.reshape(-1), made.reshape(-1))
        return made


def assembled(k: Kernel) -> Rows:
    """The rows of ``k``."""
    t = k.coarse
    V, E, F = t.n_vertices, t.n_edges, t.n_faces
    edges = csr_array((k.ends, (k.edge, k.origin)), shape=(E, V))
    vertices = csr_array((k.part, (k.origin, k.ahead)), shape=(V, V))
    blocks = []
    if k.size == 4:
        centres = csr_array((1 / t.face_sizes[t.face], k.origin, k.start), shape=(F, V))
        face = _small(t.face)
        edges = edges + csr_array((k.part, (k.edge, face)), shape=(E, F)) @ centres
        vertices = vertices + csr_array((k.part, (k.origin, face)), shape=(V, F)) @ centres
        blocks = [centres]
    else:
        edges = edges + csr_array((k.part, (k.edge, k.behind)), shape=(E, V))
    vertices = csr_array(diags_array(k.own) + diags_array(k.corner) @ vertices)
    if k.sharp:
        vertices, edges = k.sharp.assembled(vertices, edges)
    return Rows(csr_array(vstack([vertices, *blocks, edges], format="csr")))

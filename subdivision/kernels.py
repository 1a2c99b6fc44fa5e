"""One subdivision step on whole arrays: every half-edge adds what it has to the points it concerns.

The stages of a scheme say the same in words; tests hold the two together.  What distinguishes
a scheme from the others that refine alike is its ``reach``; all else follows from the
topology, and nothing is sorted or searched.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import _sparsetools, csr_array, diags_array, vstack

from subdivision import refine
from subdivision.arrays import Floats, Indices, taken
from subdivision.exact import Exact
from subdivision.sharpness import CORNER, CREASE, SMOOTH, vertex_rules
from subdivision.topology import Topology

Small = NDArray[np.int32]
Reach = Callable[[int], Exact | int]
"""Valence -> how far a smooth vertex goes to the mean of its ring."""


@dataclass(frozen=True, eq=False)
class Sharp:
    """What sharpness changes.

    Attributes
    ----------
    edges, ends, share : (n,) int, (n, 2) int, (n, 1) float
        Sharp edges go ``share`` of the way to their midpoints.
    at, towards, weight : (m,) int, (m,) int, (m,) float
        Vertices on creases hold so much of a neighbour.
    """

    edges: Indices
    ends: Indices
    share: Floats
    at: Small
    towards: Small
    weight: Floats


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
    sharp : Sharp or None
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
    sharp: Sharp | None

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
            midpoints = points[self.sharp.ends].mean(axis=1)
            edges[self.sharp.edges] += self.sharp.share * (midpoints - edges[self.sharp.edges])
            _add(self.sharp.at, self.sharp.towards, self.sharp.weight, points, vertices)
        return made

    def refined(self) -> Topology:
        """The topology after the step: its corners now, the rest if it is asked for."""
        t = self.coarse
        split, corners = (
            (refine.quads, refine.quad_corners) if self.size == 4 else (refine.triangles, refine.triangle_corners)
        )
        return refine.deferred(t, lambda: split(t), corners(t), self.size, self.n_points)

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


@dataclass(frozen=True)
class Rule:
    """A scheme, as far as speed is concerned: how many corners the faces have that it makes, and its reach."""

    size: int
    reach: Reach

    def kernel(self, t: Topology) -> Kernel:
        """One step on ``t``.

        Half of the ring of a quad mesh are neighbours, half the points of faces around; of a triangle mesh all
        are neighbours.
        """
        brought = 2 if self.size == 4 else 1
        return _kernel(t, self.size, _reached(t, self.reach) / brought, brought)


def is_smooth(t: Topology) -> bool:
    """Whether nothing is sharp, so that all points are smooth."""
    return not (t.edge_sharpness.any() or t.vertex_sharpness.any())


def _kernel(t: Topology, size: int, corner: Floats, brought: int) -> Kernel:
    """``corner`` is what each corner of a smooth vertex weighs, for each of the points ``brought`` there."""
    ends, part = (1 / 4, 1 / 4) if size == 4 else (3 / 8, 1 / 8)
    own = 1 - brought * corner * np.bincount(t.origin, minlength=t.n_vertices)
    sharp = None
    if not is_smooth(t):
        own, corner, sharp = _sharpened(t, own, corner)
    behind = taken(t.origin, t.prev) if size == 3 else t.origin[:0]
    start = np.concatenate([[0], np.cumsum(t.face_sizes)])
    return Kernel(
        t,
        size,
        origin=_small(t.origin),
        edge=_small(t.edge),
        ahead=_small(taken(t.origin, t.next)),
        behind=_small(behind),
        start=_small(start),
        ends=np.full(t.n_halfedges, ends),
        part=np.full(t.n_halfedges, part),
        own=own,
        corner=corner / part,
        sharp=sharp,
    )


def _sharpened(t: Topology, own: Floats, corner: Floats) -> tuple[Floats, Floats, Sharp]:
    """The same for vertices that follow other rules, and the rest of those rules."""
    rules = vertex_rules(t)
    parts = [(rules.now, rules.stays, rules.sharp_now), (rules.then, 1 - rules.stays, rules.sharp_then)]
    smooth, keep, crease = (
        sum(share * (rule == kind) for rule, share, _ in parts) for kind in (SMOOTH, CORNER, CREASE)
    )
    ends = [t.ends[sharp] for _, _, sharp in parts]
    at = np.concatenate([pair.T.ravel() for pair in ends])
    towards = np.concatenate([pair[:, ::-1].T.ravel() for pair in ends])
    along = [share * (rule == CREASE) for rule, share, _ in parts]
    weight = np.concatenate([held[pair.T.ravel()] / 8 for held, pair in zip(along, ends, strict=True)])
    edges = np.flatnonzero(t.edge_sharpness)
    share = np.minimum(t.edge_sharpness[edges], 1)[:, None]
    sharp = Sharp(edges, t.ends[edges], share, _small(at), _small(towards), weight)
    return smooth * own + keep + 3 / 4 * crease, smooth * corner, sharp


@lru_cache(maxsize=1024)
def _number(reach: Reach, n: int) -> float:
    return float(reach(n))


def _reached(t: Topology, reach: Reach) -> Floats:
    """(n_vertices,) float: an equal share of ``reach`` for each corner of a vertex."""
    counts = np.bincount(t.origin, minlength=t.n_vertices)
    table = np.zeros(int(counts.max(initial=0)) + 1)
    present = np.flatnonzero(np.bincount(counts))
    for n in present[present > 0]:
        table[n] = _number(reach, int(n)) / n
    return table[counts]


def _add(at: Small, of: Small, weight: Floats, points: Floats, out: Floats) -> None:
    _sparsetools.coo_matmat_dense(len(at), out.shape[1], at, of, weight, points.reshape(-1), out.reshape(-1))


def _small(indices: Indices) -> Small:
    return indices.astype(np.int32)


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
        share = np.zeros(E)
        share[k.sharp.edges] = k.sharp.share.ravel()
        halves = np.repeat(k.sharp.share.ravel() / 2, 2), (np.repeat(k.sharp.edges, 2), k.sharp.ends.ravel())
        edges = csr_array(diags_array(1 - share) @ edges + csr_array(halves, shape=(E, V)))
        vertices = vertices + csr_array((k.sharp.weight, (k.sharp.at, k.sharp.towards)), shape=(V, V))
    return Rows(csr_array(vstack([vertices, *blocks, edges], format="csr")))

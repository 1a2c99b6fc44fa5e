"""One step from what a step has made: the second and all after it.

Every half-edge of the mesh before has left its mark: in a quad of its own, or in a triangle of
its own and one in the middle of its face.  So all is told by the arrays of the mesh before, a
quarter as long: every half-edge adds what is on its side to the points along its edge, and
makes those inside its face alone.  The work is done in runs of faces so short that what they
make stays in the cache.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from scipy.sparse import _sparsetools

from subdivision import refine
from subdivision.arrays import Floats, Indices, Small, next_corners, taken
from subdivision.plans.kernels import Rule
from subdivision.plans.sharp_rows import SharpRows, sharp_rows
from subdivision.topology import Topology

AT_ONCE = 8192
"""How many half-edges there are in a run, or some more."""


@dataclass(frozen=True, eq=False)
class Faces:
    """The half-edges of some faces, counted from 0: the next and the previous one, the face, where each face starts."""

    next: Indices
    prev: Indices
    face: Indices
    start: Small

    @classmethod
    def of(cls, sizes: Indices) -> "Faces":
        """Faces of these ``sizes``, one after the other."""
        end = np.cumsum(sizes)
        start = end - sizes
        before = np.arange(-1, end[-1] - 1)
        before[start] = end - 1
        face, starts = np.repeat(np.arange(len(sizes)), sizes), np.append(start, end[-1]).astype(np.int32)
        return cls(next_corners(sizes), before, face, starts)

    @cached_property
    def places(self) -> Small:
        """All half-edges, in their order."""
        return np.arange(len(self.next), dtype=np.int32)

    def sum(self, weights: Floats, of_halfedges: Floats, out: Floats) -> None:
        """Add what the half-edges of each face have, times their ``weights``."""
        n, d = of_halfedges.shape
        _sparsetools.csr_matvecs(
            len(out), n, d, self.start, self.places, weights, of_halfedges.reshape(-1), out.reshape(-1)
        )

    def add(self, weight: float, of_halfedges: Floats, at: Small, out: Floats) -> None:
        """Add ``weight`` times what each half-edge has to ``out`` ``at`` it."""
        n, d = of_halfedges.shape
        weights = _constant(weight, n)
        _sparsetools.coo_matmat_dense(n, d, at, self.places, weights, of_halfedges.reshape(-1), out.reshape(-1))


@lru_cache(maxsize=64)
def _constant(weight: float, n: int) -> Floats:
    """``n`` times the same."""
    return np.full(n, weight)


@dataclass(frozen=True, eq=False)
class Run:
    """Some faces of a mesh, their half-edges, and how these hang together.

    Attributes
    ----------
    own, brought : (n_faces, 1), (n_halfedges,) float
        How much the point of a face holds of itself now, and of what each of its half-edges brings.
    """

    faces: slice
    halfedges: slice
    inside: Faces
    own: Floats
    brought: Floats


@dataclass(frozen=True, eq=False)
class Later:
    """One step from ``coarse``, which a step has made of ``before``.

    Attributes
    ----------
    runs : (Run, ...)
        The faces of ``before``.
    origin, edge, half : (n_halfedges,) int
        The vertex, the edge, and the half of the edge, that each half-edge of ``before`` begins with.
    own, corner : (n_vertices,) float
        How much a vertex of ``before`` holds of itself now, and of what each of its corners brings.
    sharp : SharpRows or None
        None where everything is smooth.
    """

    before: Topology
    coarse: Topology
    rule: Rule
    runs: tuple[Run, ...]
    origin: Small
    edge: Small
    half: Small
    own: Floats
    corner: Floats
    sharp: SharpRows | None

    @property
    def n_points(self) -> int:
        """How many points it makes."""
        return self.coarse.n_vertices + self.coarse.n_edges + (self.coarse.n_faces if self.rule.size == 4 else 0)

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float -> (n_points, d) float, into ``out`` if there is one."""
        made = np.empty((self.n_points, points.shape[1])) if out is None else out
        vertices = made[: self.before.n_vertices]
        vertices.fill(0)
        (_quads if self.rule.size == 4 else _triangles)(self, points, made)
        vertices *= self.corner[:, None]
        vertices += self.own[:, None] * points[: len(vertices)]
        if self.sharp:
            self.sharp.apply(points, made[: len(points)], made[self.n_points - self.coarse.n_edges :])
        return made

    def refined(self) -> Topology:
        """The topology after the step."""
        return refine.quads(self.coarse) if self.rule.size == 4 else refine.triangles(self.coarse)


def later(before: Topology, coarse: Topology, rule: Rule) -> Later:
    """One step on ``coarse``, which a step has made of ``before``."""
    origin, edge, half = (
        x.astype(np.int32, copy=False) for x in (before.origin, before.edge, refine.half_edges(before))
    )
    counts = np.bincount(origin, minlength=before.n_vertices)
    corner = rule.corners(counts)
    own = 1 - rule.brought * corner * counts
    return Later(before, coarse, rule, tuple(_runs(before, rule)), origin, edge, half, own, corner, sharp_rows(coarse))


def _runs(t: Topology, rule: Rule) -> Iterator[Run]:
    ends = np.cumsum(t.face_sizes)
    cuts = np.unique(np.append(np.searchsorted(ends, np.arange(AT_ONCE, ends[-1], AT_ONCE)), t.n_faces - 1)) + 1
    first, start, inside = 0, 0, None
    for last, end in zip(cuts.tolist(), ends[cuts - 1].tolist(), strict=True):
        sizes = t.face_sizes[first:last]
        if inside is None or not np.array_equal(np.diff(inside.start), sizes):
            inside, corner = Faces.of(sizes), rule.corners(sizes)
            own, brought = (1 - 2 * corner * sizes)[:, None], np.repeat(corner, sizes)
        yield Run(slice(first, last), slice(start, end), inside, own, brought)
        first, start = last, end


def _quads(step: Later, points: Floats, made: Floats) -> None:
    t, each = step.before, step.rule.each(4)
    V, F, E, H = t.n_vertices, t.n_faces, t.n_edges, t.n_halfedges
    v, f, e = np.split(points, [V, V + F])
    v_made, f_made, e_made, centres, outer, inner = np.split(made, np.cumsum([V, F, E, H, 2 * E]))
    np.multiply(e, 1 - 8 * each, out=e_made)
    outer.fill(0)
    for run in step.runs:
        origin, edge, half = (x[run.halfedges] for x in (step.origin, step.edge, step.half))
        inside, centre, across = run.inside, centres[run.halfedges], inner[run.halfedges]
        corner, along, middle = taken(v, origin), taken(e, edge), taken(f[run.faces], inside.face)
        np.add(corner, along, out=across)
        np.add(across, middle, out=centre)
        centre += taken(along, inside.prev)
        centre *= 1 / 4
        across += centre
        inside.add(1 / 4, across, half, outer)

        ahead = taken(centre, inside.next)
        inside.add(1 / 4, ahead, half ^ 1, outer)
        ahead += centre
        ahead += middle
        np.add(ahead, along, out=across)
        across *= 1 / 4
        ahead += corner
        inside.add(each, ahead, edge, e_made)
        along += centre
        inside.add(1.0, along, origin, v_made)
        np.multiply(f[run.faces], run.own, out=f_made[run.faces])
        inside.sum(run.brought, along, f_made[run.faces])


def _triangles(step: Later, points: Floats, made: Floats) -> None:
    t, each = step.before, step.rule.each(6)
    V, E = t.n_vertices, t.n_edges
    v, e = points[:V], points[V:]
    v_made, e_made, outer, inner = np.split(made, np.cumsum([V, E, 2 * E]))
    np.multiply(e, 1 - 6 * each, out=e_made)
    outer.fill(0)
    for run in step.runs:
        origin, edge, half = (x[run.halfedges] for x in (step.origin, step.edge, step.half))
        inside, across = run.inside, inner[run.halfedges]
        corner, along = taken(v, origin), taken(e, edge)
        behind, ahead = taken(along, inside.prev), taken(along, inside.next)
        inside.add(1.0, along, origin, v_made)
        inside.add(1 / 8, ahead, half ^ 1, outer)
        np.add(along, behind, out=across)
        across *= 3
        across += corner
        across += ahead
        across *= 1 / 8

        ahead += behind
        ahead += corner
        inside.add(each, ahead, edge, e_made)
        corner += along
        corner *= 3
        corner += behind
        inside.add(1 / 8, corner, half, outer)

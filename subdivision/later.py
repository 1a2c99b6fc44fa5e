"""One step from what a step has made: the second and all after it.

Every half-edge of the mesh before has left its mark: in a quad of its own, or in a triangle of
its own and one in the middle of its face.  So all is told by the arrays of the mesh before, a
quarter as long; inside its faces nothing needs to be looked up, and along its edges little.
The work is done in runs of half-edges so short that what they make stays in the cache.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import _sparsetools

from subdivision import refine
from subdivision.arrays import Floats, Indices, taken
from subdivision.kernels import Rule, Small
from subdivision.sharp_rows import SharpRows, sharp_rows
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
        start, n = end - sizes, len(sizes)
        after, before = np.arange(1, end[-1] + 1), np.arange(-1, end[-1] - 1)
        after[end - 1], before[start] = start, end - 1
        return cls(after, before, np.repeat(np.arange(n), sizes), np.append(start, end[-1]).astype(np.int32))

    def sums(self, of_halfedges: Floats, out: Floats) -> None:
        """Add up what the half-edges of each face have."""
        (H, d), ones, places = of_halfedges.shape, np.ones(len(self.next)), np.arange(len(self.next), dtype=np.int32)
        out.fill(0)
        _sparsetools.csr_matvecs(len(out), H, d, self.start, places, ones, of_halfedges.reshape(-1), out.reshape(-1))


@dataclass(frozen=True, eq=False)
class Run:
    """Some of the faces of a mesh, and their half-edges."""

    faces: slice
    halfedges: slice
    inside: Faces


@dataclass(frozen=True, eq=False)
class Later:
    """One step from ``coarse``, which a step has made of ``before``.

    Attributes
    ----------
    runs : (Run, ...)
        The faces of ``before``.
    half, beyond : (2 n_edges,) int
        The half-edges of ``before`` that leave either end of each edge, as the edge is cut; and the next ones after
        their twins, which leave the same vertices on the other side.
    end, wing : (2 n_edges,) int
        Where those begin; in quads their faces, in triangles the edges before them in their faces.
    own, corner : (n_vertices,) float
        How much a vertex of ``before`` holds of itself now, and of what each of its corners brings.
    sharp : SharpRows or None
        None where everything is smooth.
    """

    before: Topology
    coarse: Topology
    rule: Rule
    runs: tuple[Run, ...]
    half: Indices
    beyond: Indices
    end: Indices
    wing: Indices
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
    half = np.zeros(2 * before.n_edges, dtype=np.intp)
    half[refine.half_edges(before)] = np.arange(before.n_halfedges)
    beyond = taken(taken(before.next, before.twin), half)
    end = taken(before.origin, half)
    if rule.size == 4:
        wing = taken(before.face, half)
    else:
        wing, beyond = taken(refine.before(before, before.edge), half), taken(before.edge, beyond)
    counts = np.bincount(before.origin, minlength=before.n_vertices)
    corner = rule.corners(counts)
    own = 1 - rule.brought * corner * counts
    return Later(before, coarse, rule, tuple(_runs(before)), half, beyond, end, wing, own, corner, sharp_rows(coarse))


def _runs(t: Topology) -> Iterator[Run]:
    ends = np.cumsum(t.face_sizes)
    cuts = np.unique(np.append(np.searchsorted(ends, np.arange(AT_ONCE, ends[-1], AT_ONCE)), t.n_faces - 1)) + 1
    first, start, inside = 0, 0, None
    for last, end in zip(cuts.tolist(), ends[cuts - 1].tolist(), strict=True):
        sizes = t.face_sizes[first:last]
        if inside is None or not np.array_equal(np.diff(inside.start), sizes):
            inside = Faces.of(sizes)
        yield Run(slice(first, last), slice(start, end), inside)
        first, start = last, end


def _quads(step: Later, points: Floats, made: Floats) -> None:
    t = step.before
    V, F, E, H = t.n_vertices, t.n_faces, t.n_edges, t.n_halfedges
    v, f, e = np.split(points, [V, V + F])
    v_made, f_made, e_made, centres, outer, inner = np.split(made, np.cumsum([V, F, E, H, 2 * E]))
    for run in step.runs:
        around, middle, inside = taken(e, t.edge[run.halfedges]), taken(f[run.faces], run.inside.face), run.inside
        centre, across = centres[run.halfedges], inner[run.halfedges]
        np.take(v, t.origin[run.halfedges], axis=0, out=centre, mode="clip")
        centre += taken(around, inside.prev)
        middle += around
        centre += middle
        centre *= 1 / 4
        np.add(middle, centre, out=across)
        across += taken(centre, inside.next)
        across *= 1 / 4
        around += centre
        inside.sums(around, f_made[run.faces])
        _bring(t.origin[run.halfedges], around, v_made)
    weight = step.rule.corners(t.face_sizes)
    f_made *= weight[:, None]
    f_made += (1 - 2 * weight * t.face_sizes)[:, None] * f

    each = step.rule.each(4)
    for edges, halves in _edges(E):
        sums = taken(centres, step.half[halves])
        sums += taken(centres, step.beyond[halves])
        sums += taken(v, step.end[halves])
        some = taken(e[edges], np.arange(len(sums)) // 2)
        np.add(sums, some, out=outer[halves])
        sums += taken(f, step.wing[halves])
        _between(sums, e[edges], each, 1 - 8 * each, e_made[edges])
    outer *= 1 / 4


def _triangles(step: Later, points: Floats, made: Floats) -> None:
    t = step.before
    V, E = t.n_vertices, t.n_edges
    v, e = points[:V], points[V:]
    v_made, e_made, outer, inner = np.split(made, np.cumsum([V, E, 2 * E]))
    for run in step.runs:
        around, inside, across = taken(e, t.edge[run.halfedges]), run.inside, inner[run.halfedges]
        np.take(v, t.origin[run.halfedges], axis=0, out=across, mode="clip")
        across += taken(around, inside.next)
        ends = taken(around, inside.prev)
        ends += around
        ends *= 3
        across += ends
        across *= 1 / 8
        _bring(t.origin[run.halfedges], around, v_made)

    each = step.rule.each(6)
    for edges, halves in _edges(E):
        ends, wings = taken(v, step.end[halves]), taken(e, step.wing[halves])
        wings += taken(e, step.beyond[halves])
        half = outer[halves]
        np.add(ends, taken(e[edges], np.arange(len(ends)) // 2), out=half)
        half *= 3
        half += wings
        half *= 1 / 8
        ends += wings
        _between(ends, e[edges], each, 1 - 6 * each, e_made[edges])


def _edges(n: int) -> Iterator[tuple[slice, slice]]:
    """Runs of edges, and of their halves."""
    for begin in range(0, n, AT_ONCE // 2):
        end = min(begin + AT_ONCE // 2, n)
        yield slice(begin, end), slice(2 * begin, 2 * end)


def _between(halves: Floats, own: Floats, each: float, keep: float, out: Floats) -> None:
    """What the vertex in the middle of an edge holds of what its ``halves`` have, and of its ``own`` place."""
    first = np.arange(0, len(halves), 2)
    np.take(halves, first, axis=0, out=out, mode="clip")
    out += taken(halves, first + 1)
    out *= each
    out += keep * own


def _bring(at: Indices, brought: Floats, out: Floats) -> None:
    """Add to each vertex what the half-edges that leave it have ``brought``."""
    n, d = brought.shape
    places, ones = np.arange(n, dtype=np.int32), np.ones(n)
    at = at.astype(np.int32, copy=False)
    _sparsetools.coo_matmat_dense(n, d, at, places, ones, brought.reshape(-1), out.reshape(-1))

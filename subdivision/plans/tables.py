"""Many levels at once: a face and its ring become a patch of fine points by one table of weights.

All faces of one kind share a table, so that one product of matrices makes all their patches.
A table is computed by running the kernels of the scheme themselves on one such face with its
ring, every vertex standing for itself.

Points are numbered anew: first the vertices of the coarse mesh, in their order; then, kind by
kind, the points inside each patch and on the edges it owns.  Faces and half-edges keep the
numbers the stages give them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from subdivision.arrays import Floats, Indices, Mask, short, taken
from subdivision.plans import poles
from subdivision.plans.kernels import Rule, kernel
from subdivision.plans.mirrors import seen_mirrored
from subdivision.plans.rings import Kind, unfolded, with_ring
from subdivision.plans.sorted_faces import Sorted, sorted_faces
from subdivision.plans.templates import blocks, descendants, template
from subdivision.topology import Topology

AT_ONCE = 2048
"""How many faces are gathered at a time: what they read then stays in the cache."""

_remembered: dict[tuple[Kind, int, Rule], Floats] = {}
"""Tables of smooth kinds, which other meshes have, too."""
REMEMBERED_AT_MOST = 256


@dataclass(frozen=True, eq=False)
class Patches:
    """All faces of one kind.

    Attributes
    ----------
    ring : (n_ring, n) int
        The points round each of the ``n`` faces.
    table, corners : (rows, n_ring), (k, n_ring) float
        What makes the points of a patch that are its own, and those at its corners.
    begin : int
        Point ``row`` of patch ``f`` is number ``begin + row * n + f``.
    rim, on_rim, rim_begins : (on_side, n_ring) float, (n_rim,) int, int
        The same for the last side of those patches that have nothing beyond it.
    """

    ring: Indices
    table: Floats
    corners: Floats
    begin: int
    rim: Floats
    on_rim: Indices
    rim_begins: int

    def apply(self, points: Floats, made: Floats, corners: Floats) -> None:
        """From ``points`` of the coarse mesh write this kind's into ``made``, and into ``corners`` (k, n, d)."""
        (rows, n_ring), n, d = self.table.shape, self.ring.shape[1], points.shape[1]
        own = made[self.begin : self.begin + rows * n].reshape(rows, n * d)
        corners = corners.reshape(len(self.corners), n * d)
        for begin in range(0, n, AT_ONCE):
            some = slice(begin * d, (begin + AT_ONCE) * d)
            read = taken(points, self.ring[:, begin : begin + AT_ONCE]).reshape(n_ring, -1)
            np.matmul(self.corners, read, out=corners[:, some])
            if rows:
                np.matmul(self.table, read, out=own[:, some])
        if len(self.on_rim):
            begin, end = self.rim_begins, self.rim_begins + len(self.on_rim) * len(self.rim)
            read = taken(points, self.ring[:, self.on_rim]).reshape(n_ring, -1)
            np.matmul(self.rim, read, out=made[begin:end].reshape(len(self.rim), -1))


@dataclass(frozen=True, eq=False)
class Tables:
    """``depth`` levels at once, from ``coarse``, whose points, the vertices', are the first of those that are read.

    Attributes
    ----------
    begin, step : (n_faces + n_halfedges,) int
        The points inside a face, and those along a half-edge, are numbers ``begin``, ``begin + step``, ...
    corner : (n_vertices,) int
        Where each vertex is among the corners of all patches; -1 for isolated ones.
    """

    coarse: Topology
    depth: int
    patches: tuple[Patches, ...]
    n_points: int
    begin: Indices
    step: Indices
    corner: Indices

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_read, d) float -> (n_points, d) float, into ``out`` if there is one."""
        V, F, d = self.coarse.n_vertices, self.coarse.n_faces, points.shape[1]
        made = np.empty((self.n_points, d)) if out is None else out
        corners = np.empty((self.coarse.n_halfedges, d))
        k, end = self.coarse.n_halfedges // F, 0
        for patches in self.patches:
            begin, end = end, end + k * patches.ring.shape[1]
            patches.apply(points, made, corners[begin:end])
        np.take(corners, self.corner, axis=0, out=made[:V], mode="clip")
        alone = self.corner < 0
        made[:V][alone] = points[:V][alone]
        return made

    @cached_property
    def origin(self) -> Indices:
        """(n_halfedges,) int: the vertex each fine half-edge leaves."""
        F = self.coarse.n_faces
        k = self.coarse.n_halfedges // F
        split, number = template(k, self.depth), short(self.n_points)
        begin, step = self.begin.astype(number), self.step.astype(number)
        numbers = np.empty((F, len(split.first)), dtype=number)
        numbers[:, :k] = self.coarse.origin.reshape(F, k)
        sides = numbers[:, split.until_side(0) :].reshape(F, k, -1)
        _counted(begin[F:].reshape(F, k), step[F:].reshape(F, k), sides)
        _counted(begin[:F], step[:F], numbers[:, k : split.until_side(0)])
        origin = np.empty((F * len(split.corners), k), dtype=number)
        for small, some in blocks(k, F, self.depth):
            np.take(numbers, split.corners[some].ravel(), axis=1, out=origin[small].reshape(F, -1), mode="clip")
        return origin.reshape(-1)


def tables(t: Topology, depth: int, rule: Rule, at_most: int) -> Tables | None:
    """Tables for a mesh that is itself the outcome of a step; None where it has too many kinds of faces."""
    found = sorted_faces(t, _central(t), at_most)
    if found is None:
        return None
    return laid_out(t, depth, found.faces, found.start, found.rings(t), _tables(found, depth, rule))


def _central(t: Topology) -> Mask:
    """(n_faces,) bool: the triangles in the middle of those before."""
    F = t.n_faces
    return np.arange(F) >= (F if t.n_halfedges == 4 * F else 3 * F // 4)


def laid_out(
    t: Topology, depth: int, faces: Indices, start: Indices, rings: Sequence[Indices], tables: Sequence[Floats]
) -> Tables:
    """The ``tables`` for faces of ``t`` by kind, ``faces[start[i]:start[i + 1]]``, from their ``rings``."""
    F, H, V = t.n_faces, t.n_halfedges, t.n_vertices
    k = H // F
    split = template(k, depth)
    owns = np.where(_central(t)[faces[start[:-1]]], 0, 2)
    rim = t.twin[k * faces + k - 1] < 0
    n, on_rim = np.diff(start), np.add.reduceat(rim, start[:-1], dtype=np.intp)
    rows = split.n_inside + owns * split.on_side
    begins = V + np.cumsum(np.concatenate([[0], n * rows]))
    rim_begins = begins[-1] + np.cumsum(np.concatenate([[0], on_rim * split.on_side]))

    kind = np.repeat(np.arange(len(n)), n)
    place = np.arange(F) - start[kind]
    begin, step = np.zeros(F + H, dtype=np.intp), np.zeros(F + H, dtype=np.intp)
    begin[faces], step[faces] = begins[kind] + place, n[kind]
    for i in range(2):
        own = owns[kind] > 0
        h = F + k * faces[own] + i
        begin[h] = begin[faces[own]] + (split.n_inside + i * split.on_side) * n[kind[own]]
        step[h] = n[kind[own]]
    before: Indices = np.cumsum(rim) - rim
    h = F + k * faces[rim] + k - 1
    begin[h] = (rim_begins[kind] + before - before[start[kind]])[rim]
    step[h] = on_rim[kind[rim]]
    _share(t.twin, begin[F:], step[F:], split.on_side)

    corner = np.full(V, -1)
    corner[t.origin.reshape(F, k)[faces]] = (k * start[kind] + place)[:, None] + n[kind][:, None] * np.arange(k)
    patches, none = [], np.zeros(0, dtype=np.intp)
    for i, (around, table) in enumerate(zip(rings, tables, strict=True)):
        patches.append(Patches(
            ring=around,
            table=table[k : split.until_side(owns[i])],
            corners=table[:k],
            begin=int(begins[i]),
            rim=table[split.until_side(k - 1) :],
            on_rim=np.flatnonzero(rim[start[i] : start[i + 1]]) if on_rim[i] else none,
            rim_begins=int(rim_begins[i]),
        ))  # fmt: skip
    return Tables(t, depth, tuple(patches), int(rim_begins[-1]), begin, step, corner)


def _share(twin: Indices, begin: Indices, step: Indices, on_side: int) -> None:
    """Half-edges without points of their own have those of their twins, the other way round."""
    bare = np.flatnonzero(step == 0)
    begin[bare] = begin[twin[bare]] + (on_side - 1) * step[twin[bare]]
    step[bare] = -step[twin[bare]]


def _tables(found: Sorted, depth: int, rule: Rule) -> list[Floats]:
    """(n_points, n_vertices) float for each kind: the points of the template from those of the ring.

    Of a kind and its image one is computed.  What is smooth is remembered for other meshes; there is not much of it.
    """
    if len(_remembered) > REMEMBERED_AT_MOST:
        _remembered.clear()
    kinds, images = found.kinds, found.images
    keys = [(kind, depth, rule) for kind in kinds]
    made = {i: _remembered[key] for i, key in enumerate(keys) if key[0].is_smooth and key in _remembered}
    missing = [i for i in range(len(kinds)) if i not in made]
    first = [i for i in missing if not 0 <= images[i] < i]
    if first:
        made |= zip(first, _computed(tuple(kinds[i] for i in first), depth, rule), strict=True)
    made |= {i: seen_mirrored(made[images[i]], kinds[i], depth) for i in missing if i not in made}
    _remembered.update({keys[i]: made[i] for i in missing if kinds[i].is_smooth})
    return [made[i] for i in range(len(kinds))]


def forget() -> None:
    """Remember no tables, as a new process does."""
    _remembered.clear()
    poles.forget()


def _computed(kinds: tuple[Kind, ...], depth: int, rule: Rule) -> list[Floats]:
    """The same, computed."""
    k = len(kinds[0].fans)
    t, number = unfolded(kinds)
    points = np.eye(int(number.max()) + 1)[number]
    ours = np.arange(t.n_faces) < len(kinds)
    for level in range(depth):
        if level:
            t, kept, ours = with_ring(t, ours)
            points = points[kept]
        step = kernel(t, rule)
        points, ours = step.apply(points), ours[t.face] if k == 4 else np.concatenate([ours[t.face], ours])
        t = step.refined()
    first, each = descendants(k, len(kinds), depth)
    faces = t.origin.reshape(-1, k)[ours][first + each * np.arange(len(kinds))[:, None]]
    vertices = faces.reshape(len(kinds), -1)[:, template(k, depth).first]
    return [points[own, : kind.ring.n_vertices] for own, kind in zip(vertices, kinds, strict=True)]


def _counted(begin: Indices, step: Indices, out: Indices) -> None:
    """Count from ``begin`` by ``step`` along the last axis of ``out``."""
    np.multiply(step[..., None], np.arange(out.shape[-1], dtype=out.dtype), out=out)
    out += begin[..., None]

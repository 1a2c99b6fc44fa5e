"""Many levels of a dual scheme at once: a corner of a closed control mesh becomes a block of points by one table.

After the first step four faces meet round every point: the old face, the face of the old vertex, and the quads of two
edges.  The points of these make all that the point ever becomes, in a constant way for each pair of sizes of a face and
a vertex: a block of 4, 16, 64 ... points, one product of matrices for all blocks of a kind.  Where everything is
regular it is the biquadratic B-spline of nine points, if the scheme is [DS78]_.

Not so where the mesh ends, where a vertex has two faces, where a face or vertex has very many corners, or where there
are so many kinds that tables do not pay: these are made step by step.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache, partial

import numpy as np

from subdivision.arrays import Floats, Indices, constant, short, stretches, taken
from subdivision.plans.corner_numbers import Corners, Numbering, digit, vertex_cycles
from subdivision.plans.corner_steps import Wave, weights
from subdivision.topology import Topology

AT_ONCE = 2048
"""How many blocks are gathered at a time: what they read then stays in the cache."""

BLOCKS_A_KIND = 6
"""What a kind must stand for on average to be worth a table."""

LARGEST = 64
"""Faces and vertices of more corners are too rare for a table of their own."""

Sizes = tuple[int, int, int, int]
"""How many corners the faces round a point have, counter-clockwise."""


def cycles(sizes: Sizes) -> list[list[int]]:
    """The points round a point of four faces, as they follow in each of these: 0 itself, then its neighbours."""
    found, more = [], 5
    for r, size in enumerate(sizes):
        found.append([0, 1 + r, *range(more, more + size - 3), 1 + (r + 1) % 4])
        more += size - 3
    return found


@lru_cache(maxsize=128)
def table(sizes: Sizes, wave: Wave, depth: int) -> Floats:
    """(4 ** depth, points round it) float: what a point becomes after ``depth`` doublings, digit by digit.

    In direction r is the new corner of face r.  It sees that face, shrunken; the quads of the two edges beside; and the
    quad of the point itself.
    """
    around = cycles(sizes)
    n = sum(sizes) - 7
    if depth == 0:
        return np.eye(1, n)
    made = [np.zeros((len(cycle), n)) for cycle in around]
    for corners, cycle in zip(made, around, strict=True):
        corners[:, cycle] = weights(wave, len(cycle))
    fine = []
    for r, own in enumerate(made):
        left, right, across = made[(r + 1) % 4], made[(r + 3) % 4], made[(r + 2) % 4]
        faces = (
            own,
            (own[0], own[-1], left[1], left[0]),
            (own[0], left[0], across[0], right[0]),
            (own[0], right[0], right[-1], own[1]),
        )
        now: Sizes = tuple(sizes[r] if q == r else 4 for q in range(4))  # type: ignore[assignment]
        seen = np.empty((sum(now) - 7, n))
        for q, cycle in enumerate(cycles(now)):
            seen[cycle] = faces[q - r]
        fine.append(table(now, wave, depth - 1) @ seen)
    return np.concatenate(fine)


@dataclass(frozen=True, eq=False)
class Kind:
    """All blocks of one kind: point ``row`` of block ``b`` is number ``begin + row * n + b``.

    Attributes
    ----------
    ring : (n_ring, n) int
        The points round each.
    table : (rows, n_ring) float
    begin : int
    """

    ring: Indices
    table: Floats
    begin: int

    def apply(self, points: Floats, made: Floats) -> None:
        """From ``points`` after the first step write this kind's into ``made``."""
        (rows, n_ring), n, d = self.table.shape, self.ring.shape[1], points.shape[1]
        own = made[self.begin : self.begin + rows * n].reshape(rows, n * d)
        for begin in range(0, n, AT_ONCE):
            read = taken(points, self.ring[:, begin : begin + AT_ONCE]).reshape(n_ring, -1)
            np.matmul(self.table, read, out=own[:, begin * d : (begin + AT_ONCE) * d])


@dataclass(frozen=True, eq=False)
class Blocks:
    """``depth`` doublings at once of what the first has made of the control mesh ``control``.

    Attributes
    ----------
    begin, step : (n_halfedges,) int
        The points of the block of each corner are numbers ``begin``, ``begin + step``, ...
    slot, valences : (n_halfedges,), (n,) int
        The cycles of corners round its vertices.
    """

    control: Topology
    numbering: Numbering
    depth: int
    kinds: tuple[Kind, ...]
    begin: Indices
    step: Indices
    slot: Indices
    valences: Indices

    @property
    def n_points(self) -> int:
        """How many points it makes."""
        return self.control.n_halfedges << 2 * self.depth

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_halfedges, d) float -> (n_points, d) float, into ``out`` if there is one."""
        made = np.empty((self.n_points, points.shape[1])) if out is None else out
        for kind in self.kinds:
            kind.apply(points, made)
        return made

    def refined(self) -> Topology:
        """What the stages make of ``control``."""
        t = self.control
        for _ in range(self.depth + 1):
            t = self.numbering.refined(t)
        return t

    @cached_property
    def topology(self) -> Topology:
        """The outcome: as the stages make it, but for the numbers of the vertices."""
        t = self.control
        sizes = np.concatenate(self.numbering.sizes(t.face_sizes, self.valences, np.full(t.n_edges, 4)))
        n_faces = len(sizes) + t.n_halfedges * (4**self.depth - 1)
        face_sizes = np.full(n_faces, 4)
        face_sizes[: len(sizes)] = sizes
        known = {
            "origin": self._origin(), "face_sizes": face_sizes, "n_vertices": self.n_points, "is_smooth": True,
            "edge_sharpness": constant(0.0, 2 * self.n_points),
            "vertex_sharpness": constant(0.0, self.n_points), "hidden": constant(False, n_faces),
        }  # fmt: skip
        once = lru_cache(self.refined)
        make = {name: partial(lambda name: getattr(once(), name), name) for name in ("next", "twin", "edge", "face")}
        return Topology.deferred(make, **known)

    def _origin(self) -> Indices:
        """(n_halfedges after,) int: the point each leaves."""
        number = short(16 * self.n_points)
        corners = Corners.of(self.control, self.slot, number)
        for _ in range(self.depth - 1):
            corners = corners.doubled(self.numbering)
        block, code = corners.code >> 2 * self.depth, corners.code & (1 << 2 * self.depth) - 1
        begin, step = self.begin.astype(number)[block], self.step.astype(number)[block]
        points = tuple(begin + digit(code, r) * step for r in range(4))
        origin = np.empty(4 * self.n_points, dtype=number)
        self.numbering.origin(corners, points, origin)
        return origin


def blocks(t: Topology, wave: Wave, numbering: Numbering, depth: int) -> Blocks | None:
    """``depth`` doublings, 1 or more, after the first; None where the closed form does not hold or does not pay."""
    if not t.is_smooth or (t.twin < 0).any():
        return None
    valence = np.bincount(t.origin, minlength=t.n_vertices)
    if valence[valence > 0].min() < 3 or max(valence.max(), t.face_sizes.max()) > LARGEST:
        return None
    base = int(valence.max()) + 1
    pair = np.repeat(t.face_sizes * base, t.face_sizes) + valence[t.origin]
    pairs = np.flatnonzero(np.bincount(pair))
    if len(pairs) * BLOCKS_A_KIND > t.n_halfedges:
        return None
    rank = np.zeros(int(pairs[-1]) + 1, dtype=np.uint16)
    rank[pairs] = np.arange(len(pairs))
    kind = rank[pair]
    order, count = np.argsort(kind, kind="stable"), np.bincount(kind)
    start = np.cumsum(count) - count
    begins = start << 2 * depth
    begin = np.empty(t.n_halfedges, dtype=np.intp)
    begin[order] = stretches(begins, count)
    kinds = []
    for i, key in enumerate(pairs.tolist()):
        of_face, of_vertex = divmod(key, base)
        some = order[start[i] : start[i] + count[i]]
        weighed = table((of_face, 4, of_vertex, 4), wave, depth)
        kinds.append(Kind(_ring(t, some, of_face, of_vertex), weighed, int(begins[i])))
    slot, valences = vertex_cycles(t)
    return Blocks(t, numbering, depth, tuple(kinds), begin, count[kind], slot, valences)


def _ring(t: Topology, h: Indices, of_face: int, of_vertex: int) -> Indices:
    """(n_ring, len(h)) int: the corners round each of ``h``, in the order of ``cycles``."""
    follow, back, across = t.next[h], t.prev[h], t.twin[h]
    ahead, behind = t.twin[back], t.next[across]
    rows, face, vertex = [h, follow, back, ahead, behind], follow, ahead
    for _ in range(of_face - 3):
        face = t.next[face]
        rows.append(face)
    rows.append(t.next[ahead])
    for _ in range(of_vertex - 3):
        vertex = t.twin[t.prev[vertex]]
        rows.append(vertex)
    return np.stack([*rows, across])

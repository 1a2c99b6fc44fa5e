"""Where dual schemes of closed meshes put what they make, in closed form: nothing is searched.

A step doubles a closed mesh: every corner becomes a point.  Two steps of mid-edge subdivision do so, too.
Where four faces meet round a point, it leaves four half-edges, counter-clockwise; direction 0 lies in the old face
that the point was a corner of, 1 in the quad of the edge before it, 2 in the face of the old vertex, and 3 in the quad
of the edge that its half-edge ran along.

So the corners of the control mesh become *blocks*: each is one point first, then 4, then 16, one for each direction of
each.  A point is told by its block and one digit, 0 to 3, for every time that it was one of four: the absolute
direction in which it lies, which is the direction of the face that it shares with the point before.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from subdivision.arrays import Indices, inverse, taken
from subdivision.cycles import vertex_slots
from subdivision.refine_dual import corners, midpoints
from subdivision.topology import Topology


@dataclass(frozen=True, eq=False)
class Corners:
    """The corners of a closed mesh, each with the half-edge that leaves it.

    Attributes
    ----------
    next, prev, twin, edge : (n,) int
        As in ``Topology``.
    slot : (n,) int
        Where each is when the corners of all vertices are laid end to end, counter-clockwise.
    code : (n,) int
        The block of the point that each becomes, and its digits so far: all as digits of one number to the base 4.
    """

    next: Indices
    prev: Indices
    twin: Indices
    edge: Indices
    slot: Indices
    code: Indices

    @classmethod
    def of(cls, t: Topology, slot: Indices, kind: type[np.signedinteger[Any]]) -> "Corners":
        """Those of a control mesh, as numbers of one ``kind``: each begins a block, at digit 0."""
        arrays = (t.next, t.prev, t.twin, t.edge, slot, 4 * np.arange(t.n_halfedges))
        return cls(*(x.astype(kind, copy=False) for x in arrays))

    @property
    def ahead(self) -> Indices:
        """The corner that follows at the vertex, counter-clockwise."""
        return taken(self.twin, self.prev)

    @property
    def behind(self) -> Indices:
        """The corner before at the vertex."""
        return taken(self.next, self.twin)

    def doubled(self, numbering: "Numbering") -> "Corners":
        """The corners of the mesh that these become points of: those that leave point ``h`` in the four directions."""
        four, along, about = numbering.numbers(self)
        ahead, behind, n = self.ahead, self.behind, len(self.next)
        own, quad, around, other = four
        each = np.arange(n, dtype=self.next.dtype)
        return Corners(
            next=_placed(four, own[self.next], other[self.prev], around[ahead], quad[behind]),
            prev=_placed(four, own[self.prev], other[ahead], around[behind], quad[self.next]),
            twin=_placed(four, quad[self.next], own[self.prev], other[ahead], around[behind]),
            edge=_placed(four, along, along[self.prev], about[ahead], about),
            slot=_placed(four, *(4 * each + r for r in range(4))),
            code=_placed(four, *(digit(self.code, r) for r in range(4))),
        )


def digit(code: Indices, direction: int) -> Indices:
    """``code`` with the digit of the point in that direction, counted from the last digit, behind it."""
    return 4 * code + ((code + direction) & 3)


Four = tuple[Indices, Indices, Indices, Indices]
"""Something of each point for each of its directions."""


@dataclass(frozen=True)
class Numbering:
    """How a family of dual schemes numbers what it makes of a mesh with ``n`` corners.

    Attributes
    ----------
    steps : int
        How many of them double the mesh.
    refined : Topology -> Topology
        What they make of any mesh they take.
    sizes : (of faces, of vertices, n_edges) -> list
        The sizes of the new faces, in their order.
    numbers : Corners -> (Four, (n,) int, (n,) int)
        The new half-edges that leave every point; and the new edge from there in direction 0 and in direction 3.
    origin : (Corners, Four, out) -> None
        Given the numbers of the points that the four new corners of every point become, writes the point each
        half-edge leaves after doubling twice, (16 n,).
    """

    steps: int
    refined: Callable[[Topology], Topology]
    sizes: Callable[[Indices, Indices, Indices], list[Indices]]
    numbers: Callable[[Corners], tuple[Four, Indices, Indices]]
    origin: Callable[[Corners, Four, Indices], None]


def vertex_cycles(t: Topology) -> tuple[Indices, Indices]:
    """The ``slot`` of each corner of a closed mesh, and how many corners its vertices have, without isolated ones."""
    slot, sizes = vertex_slots(t, np.ones(t.n_vertices, dtype=bool))
    return slot, sizes[sizes > 0]


def _by_corners(c: Corners) -> tuple[Four, Indices, Indices]:
    """Faces, then edges, then vertices."""
    n = len(c.next)
    each = np.arange(n, dtype=c.next.dtype)
    along = n + 4 * c.edge + 2 * (each > c.twin)
    return (each, along[c.prev], 3 * n + c.slot, along + 1), each, n + each


def _by_midpoints(c: Corners) -> tuple[Four, Indices, Indices]:
    """Faces, then vertices, then edges; faces and vertices begin one corner before."""
    n = len(c.next)
    along = 2 * n + 4 * c.edge + 2 * (c.next > c.next[c.twin])
    return (c.next, along[c.prev], n + c.slot[c.ahead], along + 1), c.next, n + c.slot


def _corner_origin(c: Corners, points: Four, out: Indices) -> None:
    faces, along, about, vertices = np.split(out, 4)
    (own, quad, around, other), behind = points, c.behind
    for at, number in zip(_by_corners(c)[0], points, strict=True):
        faces[at] = number
    _columns(along, own[c.next], own, other, quad[c.next])
    _columns(about, quad[behind], other, around, around[behind])
    _columns(vertices, *points)


def _midpoint_origin(c: Corners, points: Four, out: Indices) -> None:
    faces, vertices, along, about = np.split(out, 4)
    (own, quad, around, other), behind = points, c.behind
    by_own, by_quad, by_around, by_other = _by_midpoints(c)[0]
    following = by_own[c.next], by_other[c.prev], by_around[c.ahead], by_quad[behind]
    for at, number in zip(following, points, strict=True):
        faces[at] = number
    _columns(vertices, other, own, quad, around)
    _columns(along, own, own[c.prev], other[c.prev], quad)
    at_slot = inverse(c.slot)
    before = behind[at_slot]
    _columns(about, around[at_slot], around[before], quad[before], other[at_slot])


def _placed(at: Four, *values: Indices) -> Indices:
    """Each of four ``values`` at its place."""
    out = np.empty(4 * len(at[0]), dtype=values[0].dtype)
    for where, value in zip(at, values, strict=True):
        out[where] = value
    return out


def _columns(out: Indices, *parts: Indices) -> None:
    table = out.reshape(-1, len(parts))
    for k, part in enumerate(parts):
        table[:, k] = part


BY_CORNERS = Numbering(
    steps=1,
    refined=corners,
    sizes=lambda faces, vertices, edges: [faces, edges, vertices],
    numbers=_by_corners,
    origin=_corner_origin,
)
BY_MIDPOINTS = Numbering(
    steps=2,
    refined=lambda t: midpoints(midpoints(t)),
    sizes=lambda faces, vertices, edges: [faces, vertices, edges],
    numbers=_by_midpoints,
    origin=_midpoint_origin,
)

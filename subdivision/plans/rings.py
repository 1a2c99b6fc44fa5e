"""Faces with the ring of faces round them, of one kind or another: faces of one kind become the same surface, linearly.

After a step all faces are alike but for the fans round their corners: how many faces there
are, whether the mesh ends, what is sharp.  A ``Kind`` of face is the fans of its corners; it
can be unfolded into a small mesh of its own, and found again round every face of that kind.
"""

from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from subdivision.arrays import Indices, Mask, taken, turned
from subdivision.topology import Topology


@dataclass(frozen=True)
class Fan:
    """What a face sees round one of its corners.

    ``left`` faces follow it counter-clockwise and ``right`` clockwise; round a ``closed`` fan
    all others are on the left.  ``sharpness`` of the edges begins with the one that follows
    the corner in the face, goes on counter-clockwise, then clockwise; empty where all are 0.
    """

    left: int
    right: int
    closed: bool
    sharpness: tuple[float, ...] = ()
    pinned: float = 0.0

    @property
    def mirrored(self) -> "Fan":
        """The same fan seen from behind."""
        n = self.left + 2
        near, left, right = self.sharpness[1::-1], self.sharpness[2:n], self.sharpness[n:]
        if self.closed:
            return Fan(self.left, self.right, True, near + left[::-1], self.pinned)
        return Fan(self.right, self.left, False, near + right + left, self.pinned)


@dataclass(frozen=True)
class RingFace:
    """A face of the ring: ``turn`` faces to the left (right: negative) round ``corner``; its vertices from there on."""

    corner: int
    turn: int
    vertices: tuple[int, ...]


@dataclass(frozen=True)
class Ring:
    """The faces round one face, every one once; vertices are numbered from 0, the corners of the face itself first.

    Attributes
    ----------
    faces : (RingFace, ...)
    spokes : for each corner (int, ...)
        The other ends of its edges, in the order of ``Fan.sharpness``.
    n_vertices : int
        How many points the surface of the face is made of.
    """

    faces: tuple[RingFace, ...]
    spokes: tuple[tuple[int, ...], ...]
    n_vertices: int

    @cached_property
    def corners(self) -> Indices:
        """The corners of ``faces``, laid end to end."""
        return np.array([v for face in self.faces for v in face.vertices], dtype=np.intp)

    def around(self, ways: "Ways", faces: Indices) -> Indices:
        """(n_vertices, n_faces) int: where its vertices are round each of ``faces``."""
        k = len(self.spokes)
        found = np.empty((self.n_vertices, len(faces)), dtype=np.intp)
        starts = [k * faces + i for i in range(k)]
        for start, corner in zip(starts, found, strict=False):
            ways.ahead(0).take(start, out=corner, mode="clip")
        seen = k
        for face in self.faces:
            if face.turn in (1, -2):
                at = starts[face.corner]
            if face.turn == -2:
                at = taken(ways.right, at)
            at = taken(ways.left if face.turn > 0 else ways.right, at)
            for i, vertex in enumerate(face.vertices):
                if vertex >= seen:
                    ways.ahead(i).take(at, out=found[vertex], mode="clip")
                    seen += 1
        return found


class Ways:
    """Ways from the half-edges of a mesh, whose faces all have as many corners, to what is near."""

    def __init__(self, t: Topology) -> None:
        self.t, self.k = t, t.n_halfedges // t.n_faces
        self._ahead: dict[int, Indices] = {0: t.origin.astype(np.intp, copy=False)}

    @cached_property
    def left(self) -> Indices:
        """(n_halfedges,) int: the half-edge that leaves the same vertex next, counter-clockwise."""
        return turned(self.t.twin.reshape(-1, self.k), -1).ravel()

    @cached_property
    def right(self) -> Indices:
        """(n_halfedges,) int: the one before, clockwise."""
        return taken(self.t.next, self.t.twin)

    def ahead(self, i: int) -> Indices:
        """(n_halfedges,) int: the corner of its face that is ``i`` further on."""
        if i not in self._ahead:
            nearer, by = (i - 1, 1) if i < self.k - 1 else (0, -1)
            self._ahead[i] = turned(self.ahead(nearer).reshape(-1, self.k), by).ravel()
        return self._ahead[i]


@dataclass(frozen=True)
class Kind:
    """The fans of the corners of a face, in order."""

    fans: tuple[Fan, ...]

    @property
    def is_smooth(self) -> bool:
        """Whether nothing is sharp, so that only the numbers of faces matter."""
        return all(fan.closed and not fan.sharpness and not fan.pinned for fan in self.fans)

    @cached_property
    def shape(self) -> "Shape":
        """What the ring depends on; sharpness makes no difference."""
        return tuple((fan.left, fan.right, fan.closed) for fan in self.fans)

    @cached_property
    def ring(self) -> Ring:
        """What is round a face of this kind."""
        return ring(self.shape)

    @property
    def creases(self) -> list[tuple[int, int, float]]:
        """The sharp edges at its corners, and how sharp they are; some from both ends."""
        return [
            (i, end, sharpness)
            for i, (fan, ends) in enumerate(zip(self.fans, self.ring.spokes, strict=True))
            if fan.sharpness
            for end, sharpness in zip(ends, fan.sharpness, strict=True)
            if sharpness
        ]


Shape = tuple[tuple[int, int, bool], ...]
"""``left``, ``right`` and ``closed`` of the fan of each corner."""


@lru_cache(maxsize=4096)
def ring(shape: Shape) -> Ring:
    """The ring round a face, from nothing but numbers."""
    k = len(shape)
    numbers: dict[Hashable, int] = {("corner", i): i for i in range(k)}

    def numbered(names: list[Hashable]) -> tuple[int, ...]:
        return tuple(numbers.setdefault(_joined(shape, name), len(numbers)) for name in names)

    faces = tuple(RingFace(i, turn, numbered(names)) for i in range(k) for turn, names in _around(shape, i))
    spokes = tuple(numbered(_spokes(shape, i)) for i in range(k))
    return Ring(faces, spokes, len(numbers))


def _around(shape: Shape, i: int) -> Iterator[tuple[int, list[Hashable]]]:
    """The faces round corner ``i``; the one on the right is left to the next corner, which has it on the left."""
    left, right, closed = shape[i]
    quad = len(shape) == 4
    for j in range(1, left + (not closed)):
        opposite = [_opposite(i, j)] if quad else []
        yield j, [("corner", i), _left(shape, i, j), *opposite, _left(shape, i, j + 1)]
    for j in range(2, right + 1):
        opposite = [("right opposite", i, j)] if quad else []
        yield -j, [("corner", i), _right(shape, i, j), *opposite, _right(shape, i, j - 1)]


def _spokes(shape: Shape, i: int) -> list[Hashable]:
    left, right, closed = shape[i]
    return [_left(shape, i, j) for j in range(left + 1 + (not closed))] + [
        _right(shape, i, j) for j in range(1, right + 1)
    ]


def _left(shape: Shape, i: int, j: int) -> Hashable:
    """The end of edge ``j`` round corner ``i``, counter-clockwise from the one that follows it in the face."""
    k, (left, _, closed) = len(shape), shape[i]
    if j < 2:
        return "corner", (i + 1, i - 1)[j] % k
    if closed and j == left:
        return "beside", i
    return ("beside", (i - 1) % k) if k == 3 and j == 2 else ("left", i, j)


def _right(shape: Shape, i: int, j: int) -> Hashable:
    if j == 0:
        return "corner", (i + 1) % len(shape)
    return ("beside", i) if j == 1 else ("right", i, j)


def _opposite(i: int, j: int) -> Hashable:
    return ("beside", (i - 1) % 4) if j == 1 else ("left opposite", i, j)


def _joined(shape: Shape, name: Hashable) -> Hashable:
    """Round a corner of three triangles the other two share a vertex: one name for it."""
    if len(shape) == 3:
        for _ in shape:
            if isinstance(name, tuple) and name[0] == "beside" and shape[name[1]] == (2, 0, True):
                name = ("beside", (name[1] - 1) % 3)
    return name


def unfolded(kinds: tuple[Kind, ...]) -> tuple[Topology, Indices]:
    """One face of each kind with its ring, side by side in one mesh, the faces themselves first; and who is who.

    ``number`` (n_vertices,) int says which vertex of its kind every vertex is.
    """
    k, sizes = len(kinds[0].fans), np.array([kind.ring.n_vertices for kind in kinds])
    begin = np.cumsum(sizes) - sizes
    begins = list(zip(begin.tolist(), kinds, strict=True))
    faces = np.concatenate([(begin[:, None] + np.arange(k)).ravel(), *(b + kind.ring.corners for b, kind in begins)])
    t = Topology.from_corners(
        np.full(len(faces) // k, k), faces, int(sizes.sum()),
        creases={(b + i, b + j): sharpness for b, kind in begins for i, j, sharpness in kind.creases},
        corners={b + i: fan.pinned for b, kind in begins for i, fan in enumerate(kind.fans) if fan.pinned},
    )  # fmt: skip
    return t, np.arange(int(sizes.sum())) - np.repeat(begin, sizes)


def with_ring(t: Topology, ours: Mask) -> tuple[Topology, Indices, Mask]:
    """Some faces with the ring round them and nothing else, which vertices are left, and which faces are still ours."""
    k = t.n_halfedges // t.n_faces
    near = np.zeros(t.n_vertices, dtype=bool)
    near[t.origin.reshape(-1, k)[ours]] = True
    kept = taken(near, t.origin).reshape(-1, k).any(axis=1)
    h = np.flatnonzero(np.repeat(kept, k))
    origin, edge, next_, twin = (taken(part, h) for part in (t.origin, t.edge, t.next, t.twin))
    vertices, edges = _marked(origin, t.n_vertices), _marked(edge, t.n_edges)
    new = np.full(t.n_halfedges + 1, -1)  # the last stands for what -1 points to
    new[h] = np.arange(len(h))
    part = Topology(
        origin=taken(np.cumsum(vertices) - 1, origin),
        next=taken(new, next_),
        twin=new.take(twin, mode="wrap"),
        edge=taken(np.cumsum(edges) - 1, edge),
        face=np.repeat(np.arange(len(h) // k), k),
        n_vertices=int(vertices.sum()),
        edge_sharpness=t.edge_sharpness[edges],
        vertex_sharpness=t.vertex_sharpness[vertices],
        hidden=t.hidden[kept],
    )
    return part, np.flatnonzero(vertices), ours[kept]


def _marked(numbers: Indices, n: int) -> Mask:
    mask = np.zeros(n, dtype=bool)
    mask[numbers] = True
    return mask

"""Faces with the ring of faces round them, sorted into kinds: faces of one kind become the same surface, linearly.

After a step all faces are alike but for the fans round their corners: how many faces there
are, whether the mesh ends, what is sharp.  A ``Kind`` of face is the fans of its corners; it
can be unfolded into a small mesh of its own, and found again round every face of that kind.
"""

from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from subdivision.arrays import Floats, Indices, Mask, distinct, taken
from subdivision.sharp_rows import creases
from subdivision.topology import Topology

LARGEST_FAN = 32
"""Vertices of more faces are too rare, and their rings too large, for a table of their own."""


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

    def around(self, t: Topology, faces: Indices) -> Indices:
        """(n_vertices, n_faces) int: where its vertices are round each of ``faces``."""
        k = len(self.spokes)
        found = np.empty((self.n_vertices, len(faces)), dtype=np.intp)
        for i in range(k):
            found[i] = taken(t.origin, k * faces + i)
        seen = k
        for face in self.faces:
            if face.turn in (1, -2):
                at = k * faces + face.corner
            if face.turn == -2:
                at = taken(t.next, taken(t.twin, at))
            at = taken(t.twin, taken(t.prev, at)) if face.turn > 0 else taken(t.next, taken(t.twin, at))
            step = at
            for vertex in face.vertices[1:]:
                step = taken(t.next, step)
                if vertex >= seen:
                    found[vertex] = taken(t.origin, step)
                    seen += 1
        return found


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


@dataclass(frozen=True, eq=False)
class Sorted:
    """The faces of a mesh by kind: those of ``kinds[i]`` are ``faces[start[i]:start[i + 1]]``.

    In a mirror that keeps the first corner they are ``kinds[images[i]]``, or none of them where that is -1.
    """

    kinds: tuple[Kind, ...]
    images: tuple[int, ...]
    faces: Indices
    start: Indices

    def rings(self, t: Topology) -> list[Indices]:
        """What is round the faces of each kind; kinds whose rings are alike are walked together."""
        alike: dict[Shape, list[int]] = {}
        for i, kind in enumerate(self.kinds):
            alike.setdefault(kind.shape, []).append(i)
        faces = np.split(self.faces, self.start[1:-1])
        found = dict[int, Indices]()
        for shape, some in alike.items():
            ends = np.cumsum([len(faces[i]) for i in some])
            together = ring(shape).around(t, np.concatenate([faces[i] for i in some]))
            found |= zip(some, np.split(together, ends[:-1], axis=1), strict=True)
        return [found[i] for i in range(len(self.kinds))]


def sorted_faces(t: Topology, apart: Mask, at_most: int) -> Sorted | None:
    """The faces of ``t``, all quads or all triangles; those ``apart`` are never of one kind with others.

    None where there are more than ``at_most`` kinds, or one that cannot be unfolded: with a
    vertex of two faces, or of very many.
    """
    k = t.n_halfedges // t.n_faces
    counts = np.bincount(t.origin, minlength=t.n_vertices)
    if counts.max() > LARGEST_FAN:
        return None
    code, fans = _fans(t, counts)
    corners = code.reshape(-1, k)
    kind = apart.astype(np.intp)
    for i in range(k):
        kind = _ranked(kind * len(fans) + corners[:, i])
        if kind.max() >= at_most:
            return None
    order = np.argsort(kind.astype(np.uint16), kind="stable")
    start = np.concatenate([[0], np.cumsum(np.bincount(kind))])
    first = corners[order[start[:-1]]].tolist()
    kinds = tuple(Kind(tuple(fans[c] for c in row)) for row in first)
    if any(fan.closed and fan.left < 2 for kind in kinds for fan in kind.fans):
        return None
    return Sorted(kinds, _images(first, fans), order, start)


def _images(kinds: list[list[int]], fans: list[Fan]) -> tuple[int, ...]:
    """The place of the image of each of ``kinds``, which are told by the numbers of their fans; -1 for none."""
    numbers = {fan: c for c, fan in enumerate(fans)}
    image = [numbers.get(fan.mirrored, -1) for fan in fans]
    places = {tuple(row): i for i, row in enumerate(kinds)}
    return tuple(places.get(tuple(image[row[-i]] for i in range(len(row))), -1) for row in kinds)


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
    kept = near[t.origin].reshape(-1, k).any(axis=1)
    h = np.flatnonzero(np.repeat(kept, k))
    vertices, edges = (_marked(part[h], n) for part, n in ((t.origin, t.n_vertices), (t.edge, t.n_edges)))
    new = np.full(t.n_halfedges + 1, -1)  # the last stands for what -1 points to
    new[h] = np.arange(len(h))
    part = Topology(
        origin=(np.cumsum(vertices) - 1)[t.origin[h]],
        next=new[t.next[h]],
        twin=new[t.twin[h]],
        edge=(np.cumsum(edges) - 1)[t.edge[h]],
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


def _fans(t: Topology, counts: Indices) -> tuple[Indices, list[Fan]]:
    """Which of the fans each corner sees."""
    code = counts[t.origin]
    smooth = np.flatnonzero(np.bincount(code))
    fans = [Fan(int(n) - 1, 0, closed=True) for n in smooth]
    rank = np.zeros(len(counts) and int(counts.max()) + 1, dtype=np.intp)
    rank[smooth] = np.arange(len(smooth))
    code = rank[code]
    if not t.is_smooth:
        special = np.zeros(t.n_vertices, dtype=bool)
        special[creases(t).vertices] = True
        at = np.flatnonzero(special[t.origin])
        features = _features(t, at, int(counts.max()))
        first, which = distinct(features)
        code[at] = len(fans) + which
        fans += map(_fan, features[first].tolist())
    return code, fans


def _features(t: Topology, at: Indices, largest: int) -> Floats:
    """(len(at), 4 + 2 (largest + 1)) float: numbers in a fan, closed or not, and sharpness left and right."""
    left, right = (np.zeros((len(at), largest + 1)) for _ in range(2))
    faces = np.zeros((len(at), 2), dtype=np.intp)
    closed = np.zeros(len(at), dtype=bool)
    left[:, 0] = t.edge_sharpness[t.edge[at]]
    here, g = np.arange(len(at)), at
    for j in range(1, largest + 1):
        back = t.prev[g]
        ahead = t.twin[back]
        closed[here[ahead == at[here]]] = True
        here, back, ahead = (x[ahead != at[here]] for x in (here, back, ahead))
        left[here, j] = t.edge_sharpness[t.edge[back]]
        here, g = here[ahead >= 0], ahead[ahead >= 0]
        faces[here, 0] = j
    here = np.flatnonzero(~closed)
    g = at[here]
    for j in range(1, largest + 1):
        across = t.twin[g]
        here, g = here[across >= 0], t.next[across[across >= 0]]
        right[here, j] = t.edge_sharpness[t.edge[g]]
        faces[here, 1] = j
    return np.column_stack([faces, closed, t.vertex_sharpness[t.origin[at]], left, right])


def _fan(features: list[float]) -> Fan:
    left, right, closed = (int(x) for x in features[:3])
    first, second = 4, 4 + len(features) // 2 - 2
    sharpness = (*features[first : first + left + 1 + (not closed)], *features[second + 1 : second + right + 1])
    return Fan(left, right, bool(closed), sharpness if any(sharpness) else (), features[3])


def _ranked(numbers: Indices) -> Indices:
    """The same numbers with the gaps closed, in the same order."""
    present = np.bincount(numbers) > 0
    return (np.cumsum(present) - 1)[numbers]

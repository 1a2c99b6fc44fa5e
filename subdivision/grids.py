"""Tensor products of the four-point curve on closed meshes of quads [Kob96]_, many levels at once.

The first step is the rule of the scheme, on whole arrays.  After that a control quad is a grid of points, its edges
are rows, its corners stay: interpolating schemes keep what they have.  A grid is refined as a curve is, in one
direction and in the other, and for that it sees one row of points beyond each of its sides: those of the neighbours.
Beyond its corners it sees what makes the rule of the scheme a tensor product, whatever the valence.  Both directions
have their own idea of these points; as the scheme takes the mean of both directions, the mean of the ideas does.

Points are numbered: first the control vertices, in their order; then the points inside all quads, the first of each,
the second of each ...; then likewise those of the edges, from the end of the half-edge of lower number.  Faces and
half-edges keep the numbers the stages give them.  After one step so do the points.

Not for meshes that end, nor for faces other than quads: these are told in stages.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from subdivision import refine
from subdivision.arrays import Floats, Indices, constant, short, taken, turned
from subdivision.topology import Topology

AT_ONCE = 12_000
"""How many points are gathered at a time: they then stay in the cache."""


@lru_cache(maxsize=16)
def curve(n: int, tension: Fraction) -> Floats:
    """(2 n - 1, n + 3) float: what lies between the ends of ``n`` edges in a row, from them and one point beyond."""
    w, made = float(tension), np.zeros((2 * n - 1, n + 3))
    for i in range(n):
        made[2 * i, i : i + 4] = -w, 1 / 2 + w, 1 / 2 + w, -w
    for i in range(1, n):
        made[2 * i - 1, i + 1] = 1
    return made


@lru_cache(maxsize=128)
def beyond(n: int, tension: Fraction) -> Floats:
    """(4 n, 2 n) float: what lies beyond a vertex of ``n`` quads, from its neighbours and their opposite corners.

    First the virtual points of its edges, by the rule of the scheme; then what each quad sees beyond the edge that
    follows its corner, beyond the edge before, and across.
    """
    neighbour, opposite = np.split(np.eye(2 * n), 2)
    lean = float(2 * tension / (1 + 2 * tension))
    back_two, back, here, on, on_two = (np.roll(np.arange(n), -j) for j in range(-2, 3))
    three = neighbour[back] + neighbour[here] + neighbour[on]
    four = opposite[back_two] + opposite[back] + opposite[here] + opposite[on]
    virtual = 4 * neighbour.mean(axis=0) - three + lean * (four - 4 * opposite.mean(axis=0))
    follows = 1 / 2 * (virtual + neighbour[on_two])
    precedes = 1 / 2 * (virtual[on] + neighbour[back])
    return np.concatenate([virtual, follows, precedes, 1 / 2 * (opposite[back_two] + opposite[on_two])])


@dataclass(frozen=True, eq=False)
class Rings:
    """What is round the vertices of each valence, and what is made of that.

    Attributes
    ----------
    around : ((2 valence, count) int, ...)
        The neighbours of each vertex, then the opposite corners.
    ideas : int
        How many of the four things beyond its corners are made: 1 or 4.
    """

    around: tuple[Indices, ...]
    ideas: int

    def apply(self, seen: Floats, tension: Fraction, out: Floats) -> None:
        """Write what lies beyond the corners of all vertices."""
        end, d = 0, seen.shape[1]
        for ring in self.around:
            n, count = len(ring) // 2, ring.shape[1]
            begin, end = end, end + self.ideas * n * count
            read = taken(seen, ring).reshape(2 * n, -1)
            np.matmul(beyond(n, tension)[: self.ideas * n], read, out=out[begin:end].reshape(-1, count * d))


@dataclass(frozen=True, eq=False)
class First:
    """The first step.

    Attributes
    ----------
    rows : (4, n_edges) int
        The ends of each edge between two virtual points, which follow the vertices.
    edges : (8, n_faces) int
        The edges of each face, then those opposite in the faces beside.
    """

    rings: Rings
    rows: Indices
    edges: Indices

    def apply(self, seen: Floats, tension: Fraction, made: Floats) -> None:
        """Write the points of faces and edges."""
        F, w = self.edges.shape[1], float(tension)
        faces, edges = made[:F].reshape(1, -1), made[F:]
        _product(curve(1, tension), seen, self.rows, edges.reshape(1, -1))
        _product(np.repeat([[1 / 4 + w / 2, -w / 2]], 4, axis=1), edges, self.edges, faces)


@dataclass(frozen=True, eq=False)
class Later:
    """A step of grids with ``n`` edges along each side, 2 or more.

    All numbers are those of the points before; what lies beyond corners follows them.

    Attributes
    ----------
    rows : (n + 3, n_edges) int
    grids : ((n + 3) ** 2, n_faces) int
    """

    n: int
    rings: Rings
    rows: Indices
    grids: Indices

    def apply(self, seen: Floats, tension: Fraction, made: Floats) -> None:
        """Write the points inside the grids, and along the edges."""
        rule, inner, d, F = curve(self.n, tension), 2 * self.n - 1, seen.shape[1], self.grids.shape[1]
        inside, along = np.split(made, [inner * inner * F])
        out = inside.reshape(inner, inner, F * d)
        for some in _runs(self.grids):
            read = taken(seen, self.grids[:, some]).reshape(self.n + 3, -1)
            half = np.matmul(rule, read).reshape(inner, self.n + 3, -1)
            np.matmul(rule, half, out=out[:, :, some.start * d : some.stop * d])
        _product(rule, seen, self.rows, along.reshape(inner, -1))


@dataclass(frozen=True, eq=False)
class Grids:
    """One step or more from ``control``."""

    control: Topology
    tension: Fraction
    steps: tuple[First | Later, ...]

    def n_points(self, level: int) -> int:
        """How many there are after so many steps."""
        t, inner = self.control, (1 << level) - 1
        return t.n_vertices + inner * inner * t.n_faces + inner * t.n_edges

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float -> (n_points, d) float, into ``out`` if there is one."""
        V, d = points.shape
        n, made = V, self._room(0, d, None)
        made[:V] = points
        for level, step in enumerate(self.steps, 1):
            seen = made
            step.rings.apply(seen, self.tension, seen[n:])
            n, made = self.n_points(level), self._room(level, d, out)
            made[:V] = points
            step.apply(seen, self.tension, made[V:n])
        return made

    def _room(self, level: int, d: int, out: Floats | None) -> Floats:
        """For the points after so many steps, and for what the next step sees beyond them."""
        if level == len(self.steps):
            return np.empty((self.n_points(level), d)) if out is None else out
        return np.empty((self.n_points(level) + self.steps[level].rings.ideas * self.control.n_halfedges, d))

    def refined(self) -> Topology:
        """What the stages make of ``control``."""
        t = self.control
        for _ in self.steps:
            t = refine.quads(t)
        return t

    @cached_property
    def topology(self) -> Topology:
        """The outcome: as the stages make it, but for the numbers of the vertices."""
        if len(self.steps) == 1:
            return self.refined()
        t, depth = self.control, len(self.steps)
        numbers = np.ascontiguousarray(numbered(t, 1 << depth).reshape(-1, t.n_faces).T)
        origin = np.take(numbers, small_quads(depth).ravel(), axis=1, mode="clip").reshape(-1)
        once, n_points = lru_cache(self.refined), self.n_points(depth)
        make = {
            "twin": lambda: once().twin,
            "edge": lambda: once().edge,
            "edge_sharpness": lambda: constant(0.0, once().n_edges),
            "vertex_sharpness": lambda: constant(0.0, n_points),
            "hidden": lambda: once().hidden,
        }
        return refine.deferred(t, make, origin, 4, n_points)


def grids(t: Topology, tension: Fraction, levels: int) -> Grids | None:
    """``levels`` steps, 1 or more; None where they are not made of grids."""
    if not t.is_smooth or not t.is_quadrilateral or (t.twin < 0).any():
        return None
    fans = _fans(t)
    return Grids(t, tension, (_first(t, fans), *(_later(t, fans, 1 << k) for k in range(1, levels))))


@lru_cache(maxsize=8)
def small_quads(depth: int) -> Indices:
    """(4 ** depth, 4) int: the corners of the quads that one becomes, as points of its grid."""
    n = 1 << depth
    at = n * np.array([[[0, 0], [1, 0], [1, 1], [0, 1]]])
    for _ in range(depth):
        on = (at + np.roll(at, -1, axis=1)) // 2
        centre = np.broadcast_to((at[:, :1] + at[:, 2:3]) // 2, at.shape)
        at = np.stack([at, on, centre, np.roll(on, 1, axis=1)], axis=2).reshape(-1, 4, 2)
    return np.asarray(at @ [n + 1, 1])


def numbered(t: Topology, n: int) -> Indices:
    """(n + 1, n + 1, n_faces) int: the points of the grids, the first side from the first corner to the second."""
    V, F, E, inner = t.n_vertices, t.n_faces, t.n_edges, n - 1
    begin = V + inner * inner * F
    numbers = np.empty((n + 1, n + 1, F), dtype=short(begin + inner * E))
    numbers[1:-1, 1:-1] = np.arange(V, begin).reshape(inner, inner, F)
    back = np.arange(t.n_halfedges) > t.twin
    first = (begin + t.edge + np.where(back, (inner - 1) * E, 0)).astype(numbers.dtype)
    step = np.where(back, -E, E).astype(numbers.dtype)
    for c in range(4):
        side = np.rot90(numbers, -c)
        side[0, 0] = t.origin[c::4]
        for i in range(inner):
            side[1 + i, 0] = first[c::4] + i * step[c::4]
    return numbers


def _fans(t: Topology) -> list[Indices]:
    """(valence, count) int for each valence: corners, counter-clockwise round each vertex."""
    first, valence = np.full(t.n_vertices, -1), np.bincount(t.origin, minlength=t.n_vertices)
    first[t.origin] = np.arange(t.n_halfedges)
    ahead, fans = turned(t.twin.reshape(-1, 4), -1).ravel(), []
    for n in np.flatnonzero(np.bincount(valence[valence > 0])).tolist():
        fan = np.empty((n, int((valence == n).sum())), dtype=np.intp)
        fan[0] = first[valence == n]
        for i in range(1, n):
            fan[i] = taken(ahead, fan[i - 1])
        fans.append(fan)
    return fans


def _places(fans: list[Indices], ideas: int, begin: int, n: int) -> Indices:
    """(ideas, n_halfedges) int: the numbers, from ``begin``, of what lies beyond each corner."""
    places = np.empty((ideas, n), dtype=short(begin + ideas * n))
    for fan in fans:
        end = begin + ideas * fan.size
        places[:, fan] = np.arange(begin, end, dtype=places.dtype).reshape(ideas, *fan.shape)
        begin = end
    return places


def _rings(fans: list[Indices], neighbour: Indices, opposite: Indices, ideas: int) -> Rings:
    return Rings(tuple(np.concatenate([taken(neighbour, fan), taken(opposite, fan)]) for fan in fans), ideas)


def _first(t: Topology, fans: list[Indices]) -> First:
    neighbour, edge = (x.reshape(-1, 4) for x in (t.origin, t.edge))
    neighbour, across = turned(neighbour, 1), turned(turned(edge, 1), 1)
    rings = _rings(fans, neighbour.reshape(-1), turned(neighbour, 1).reshape(-1), 1)
    virtual = _places(fans, 1, t.n_vertices, t.n_halfedges)[0]
    beside = taken(across.reshape(-1), t.twin).reshape(-1, 4)
    return First(rings, _rows(t, 1, virtual), np.concatenate([edge.T, beside.T]))


def _later(t: Topology, fans: list[Indices], n: int) -> Later:
    F, begin = t.n_faces, t.n_vertices + (n - 1) ** 2 * t.n_faces + (n - 1) * t.n_edges
    numbers, ideas = numbered(t, n), _places(fans, 4, begin, t.n_halfedges)
    seen = np.empty((n + 3, n + 3, F), dtype=ideas.dtype)
    seen[1:-1, 1:-1] = numbers
    beside, neighbour, opposite = (np.empty((*shape, F, 4), dtype=ideas.dtype) for shape in ((n - 1,), (), ()))
    for c in range(4):
        side = np.rot90(numbers, -c)
        beside[:, :, c], neighbour[:, c], opposite[:, c] = side[n - 1 : 0 : -1, 1], side[1, 0], side[1, 1]
    across = taken(beside.reshape(n - 1, -1).T, t.twin).T
    for c in range(4):
        side = np.rot90(seen, -c)
        side[0, 1], side[1, 0], side[0, 0] = (idea[c::4] for idea in ideas[1:])
        side[2:-2, 0] = across[:, c::4]
    rings = _rings(fans, neighbour.reshape(-1), opposite.reshape(-1), 4)
    return Later(n, rings, _rows(t, n, ideas[0]), seen.reshape(-1, F))


def _rows(t: Topology, n: int, virtual: Indices) -> Indices:
    """(n + 3, n_edges) int: the points along each edge, with the virtual points before and behind."""
    lower = np.flatnonzero(np.arange(t.n_halfedges) < t.twin)
    h = np.empty(t.n_edges, dtype=np.intp)
    h[t.edge[lower]] = lower
    begin, inner = t.n_vertices + (n - 1) ** 2 * t.n_faces, n - 1
    rows = np.empty((n + 3, t.n_edges), dtype=virtual.dtype)
    rows[1], rows[-2] = t.origin[h], t.origin[t.next[h]]
    rows[0], rows[-1] = virtual[h], virtual[t.twin[h]]
    rows[2:-2] = np.arange(begin, begin + inner * t.n_edges).reshape(inner, t.n_edges)
    return rows


def _product(rule: Floats, points: Floats, rows: Indices, out: Floats) -> None:
    """``rule`` of the points in each column of ``rows``."""
    d = points.shape[1]
    for some in _runs(rows):
        read = taken(points, rows[:, some]).reshape(len(rows), -1)
        np.matmul(rule, read, out=out[:, some.start * d : some.stop * d])


def _runs(read: np.ndarray[Any, Any]) -> Iterator[slice]:
    """The columns of what is read, in short runs."""
    rows, n = read.shape
    each = max(AT_ONCE // rows, 1)
    return (slice(begin, min(begin + each, n)) for begin in range(0, n, each))

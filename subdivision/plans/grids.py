"""Tensor products of the four-point curve on closed meshes of quads [Kob96]_, many levels at once.

The first step is the rule of the scheme, on whole arrays.  After that a control quad is a grid of points, its edges
are rows, its corners stay: interpolating schemes keep what they have.  A grid is refined as a curve is, in one
direction and in the other, and for that it sees one row of points beyond each of its sides: those of the neighbours.
Beyond its corners it sees what makes the rule of the scheme a tensor product, whatever the valence.  Both directions
have their own idea of these points; as the scheme takes the mean of both directions, the mean of the ideas does.

Points are numbered: first the control vertices, in their order; then the points inside all quads, the first of each,
the second of each ...; then likewise those of the edges, from the end of the half-edge of lower number.  Faces and
half-edges keep the numbers the stages give them.  After one step so do the points.

Not for meshes that end, for faces other than quads, nor for vertices of very many: these are told in stages.
"""

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache

import numpy as np

from subdivision import refine
from subdivision.arrays import Floats, Indices, constant, short, taken, turned
from subdivision.plans.grid_steps import First, Later
from subdivision.topology import Topology

LARGEST_FAN = 64
"""Vertices of more faces are too rare for a table of their own, which grows with the square."""


@dataclass(frozen=True, eq=False)
class Grids:
    """One step or more from ``control``."""

    control: Topology
    tension: Fraction
    first: First
    later: tuple[Later, ...]

    @property
    def steps(self) -> tuple[First | Later, ...]:
        """One after the other."""
        return self.first, *self.later

    def n_points(self, level: int) -> int:
        """How many there are after so many steps."""
        t, inner = self.control, (1 << level) - 1
        return t.n_vertices + inner * inner * t.n_faces + inner * t.n_edges

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float -> (n_points, d) float, into ``out`` if there is one."""
        V, d = points.shape
        made = self._room(0, d, None)
        made[:V] = points
        for level, step in enumerate(self.steps, 1):
            seen, n = made, self.n_points(level)
            made = self._room(level, d, out)
            made[:V] = points
            step.apply(seen, self.tension, made[V:n])
        return made

    def _room(self, level: int, d: int, out: Floats | None) -> Floats:
        """For the points after so many steps, and for what the next step sees beyond them."""
        if level == len(self.steps):
            return np.empty((self.n_points(level), d)) if out is None else out
        return np.empty((self.n_points(level) + self.steps[level].more, d))

    def assembled(self) -> "Grids":
        """The same, slower to make and quicker to apply."""
        return replace(self, first=self.first.assembled(self.tension, self.control.n_edges, self.control.n_vertices))

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
    if not t.is_smooth or not t.is_quadrilateral or (t.twin < 0).any() or t.valence.max() > LARGEST_FAN:
        return None
    fans = _fans(t)
    return Grids(t, tension, _first(t, fans), tuple(_later(t, fans, 1 << k) for k in range(1, levels)))


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


def _first(t: Topology, fans: list[Indices]) -> First:
    origin, edge = (x.astype(np.int32, copy=False) for x in (t.origin, t.edge))
    neighbour = turned(origin.reshape(-1, 4), 1)
    across = turned(turned(edge.reshape(-1, 4), 1), 1).reshape(-1)
    rings = _rings(fans, neighbour.reshape(-1), turned(neighbour, 1).reshape(-1))
    return First(
        origin, edge, taken(across, t.twin), tuple((r, taken(edge, f)) for r, f in zip(rings, fans, strict=True))
    )


def _rings(fans: list[Indices], neighbour: Indices, opposite: Indices) -> tuple[Indices, ...]:
    return tuple(np.concatenate([taken(neighbour, fan), taken(opposite, fan)]) for fan in fans)


def _beyond_corners(fans: list[Indices], begin: int, n: int) -> Indices:
    """(4, n_halfedges) int: the numbers, from ``begin``, of what lies beyond each corner."""
    places = np.empty((4, n), dtype=short(begin + 4 * n))
    for fan in fans:
        end = begin + 4 * fan.size
        places[:, fan] = np.arange(begin, end, dtype=places.dtype).reshape(4, *fan.shape)
        begin = end
    return places


def _later(t: Topology, fans: list[Indices], n: int) -> Later:
    F, begin = t.n_faces, t.n_vertices + (n - 1) ** 2 * t.n_faces + (n - 1) * t.n_edges
    numbers, ideas = numbered(t, n), _beyond_corners(fans, begin, t.n_halfedges)
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
    rings = _rings(fans, neighbour.reshape(-1), opposite.reshape(-1))
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

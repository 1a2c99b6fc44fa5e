"""One step of the modified butterfly on whole arrays: the vertices stay, and every edge gets a point.

Every half-edge adds what it sees on its side to the point of its edge, as if all vertices were
regular: half of its origin, the wing in its own triangle, and the corners beyond its two
neighbours.  Then few points are made over: those of the outline by their own curve, and those
beside extraordinary vertices, round all vertices of one valence by one product.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from scipy.sparse import _sparsetools, csr_array, eye_array, vstack

from subdivision import refine
from subdivision.arrays import Floats, Indices, Small, taken, turned
from subdivision.exact import Exact
from subdivision.four_points import rim_points
from subdivision.operators import Operator
from subdivision.plans.kernels import Rows
from subdivision.topology import Topology

Beside = Callable[[int, int], Exact | int]
"""Valence, steps round -> what the point beside an extraordinary vertex holds of the neighbour so far from its own."""

CENTRE = 3 / 4
"""What it holds of the extraordinary vertex."""

AT_ONCE = 2048
"""How many triangles there are in a run: what they make stays in the cache."""


@dataclass(frozen=True, eq=False)
class ButterflyStep:
    """One step from ``coarse``, all triangles, numbered as the stages do: the vertices, then the edges.

    Attributes
    ----------
    rim : (n_rim,) int
        The half-edges with nothing beyond them.
    spokes : ((n, n_vertices) int, ...)
        The half-edges round the extraordinary vertices, in order, together where there are equally many.
    """

    coarse: Topology
    beside: Beside
    rim: Indices
    spokes: tuple[Indices, ...]

    @property
    def n_points(self) -> int:
        """How many points it makes."""
        return self.coarse.n_vertices + self.coarse.n_edges

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float -> (n_points, d) float, into ``out`` if there is one."""
        V, d = points.shape
        made = np.empty((self.n_points, d)) if out is None else out
        made[:V] = points
        edges = made[V:]
        edges.fill(0)
        origin, edge, beyond = self._origin, self._edge, self._beyond
        for begin in range(0, self.coarse.n_faces, AT_ONCE):
            some = slice(begin, begin + AT_ONCE)
            corner, outer = taken(points, origin[some]), taken(points, beyond[some])
            side = turned(corner, -1)
            side -= 1 / 2 * others(outer)
            side *= 1 / 4
            side += corner
            side *= 1 / 2
            add(edge[some].ravel(), side.reshape(-1, d), edges)
        self.make_over(points, edges)
        return made

    def make_over(self, points: Floats, edges: Floats) -> None:
        """The points of the outline, and those beside extraordinary vertices: the mean of two where both ends are."""
        d = points.shape[1]
        if len(self.rim):
            ahead, behind, lean = self._leaning
            for h in (ahead, behind):
                add(self._edge.ravel()[h], taken(points, lean[0]) - taken(points, lean[1]), edges, -1 / 16)
            edges[self._edge.ravel()[self.rim]] = self._outline.apply(points)
        for h, _ in self._made_over:
            edges[h] = 0
        for spokes, (edge, share) in zip(self.spokes, self._made_over, strict=True):
            n = len(spokes)
            ring = taken(points, taken(self.coarse.origin, ahead_of(spokes)))
            made = (_round(self.beside, n) @ ring.reshape(n, -1)).reshape(ring.shape)
            made += CENTRE * taken(points, taken(self.coarse.origin, spokes[0]))
            made *= share[:, :, None]
            add(edge.ravel(), made.reshape(-1, d), edges)

    def assembled(self) -> Rows:
        """The same as one sparse matrix."""
        V, E = self.coarse.n_vertices, self.coarse.n_edges
        at, of, weights = (np.concatenate(parts) for parts in zip(*self._entries(), strict=True))
        edges = csr_array((weights, (at, of)), shape=(E, V))
        return Rows(csr_array(vstack([eye_array(V), edges], format="csr")))

    def _entries(self) -> Iterator[tuple[Indices, Indices, Floats]]:
        """What the points of edges hold: edges, vertices, and how much of them, some of it in parts."""
        origin, beyond = self._origin, self._beyond
        regular = np.ones(self.coarse.n_edges, dtype=bool)
        rim = taken(self._edge.ravel(), self.rim)
        for edge in (rim, *(edge for edge, _ in self._made_over)):
            regular[edge] = False
        some = regular[self._edge]
        wing, ahead, behind = turned(origin, -1), turned(beyond, 1), turned(beyond, -1)
        for vertex, weight in ((origin, 1 / 2), (wing, 1 / 8), (ahead, -1 / 16), (behind, -1 / 16)):
            yield self._edge[some], vertex[some], np.full(np.count_nonzero(some), weight)
        if len(rim):
            outline = self._outline.assemble().tocoo()
            yield rim[outline.row], outline.col, outline.data
            ahead, behind, lean = self._leaning
            for h in (ahead, behind):
                edge = taken(self._edge.ravel(), h)
                some = regular[edge]
                for vertex, weight in zip(lean, (-1 / 16, 1 / 16), strict=True):
                    yield edge[some], vertex[some], np.full(np.count_nonzero(some), weight)
        for spokes, (edge, share) in zip(self.spokes, self._made_over, strict=True):
            around = _round(self.beside, len(spokes))
            read = [*taken(origin.ravel(), ahead_of(spokes)), taken(origin.ravel(), spokes[0])]
            for vertex, weights in zip(read, [*around.T, np.full(len(spokes), CENTRE)], strict=True):
                yield edge.ravel(), np.tile(vertex, len(spokes)), (weights[:, None] * share).ravel()

    @cached_property
    def topology(self) -> Topology:
        """After the step."""
        return refine.triangles(self.coarse)

    @cached_property
    def _origin(self) -> Small:
        """(n_faces, 3) int: the vertex each half-edge leaves."""
        return self.coarse.origin.astype(np.int32, copy=False).reshape(-1, 3)

    @cached_property
    def _edge(self) -> Small:
        """... and its edge."""
        return self.coarse.edge.astype(np.int32, copy=False).reshape(-1, 3)

    @cached_property
    def _beyond(self) -> Small:
        """... and the corner of the triangle beyond; where there is none, its origin, and ``_leaning`` mends that."""
        beyond = taken(turned(self._origin, -1).ravel(), self.coarse.twin)
        beyond[self.rim] = self.coarse.origin[self.rim]
        return beyond.reshape(-1, 3)

    @cached_property
    def _leaning(self) -> tuple[Indices, Indices, tuple[Indices, Indices]]:
        """The half-edges after and before each on the rim, and from where to where they lean.

        The parallelogram beyond a half-edge is as far from its origin as its end is from the corner on this side.
        """
        ahead = ahead_of(self.rim)
        behind = ahead_of(ahead)
        return ahead, behind, (taken(self.coarse.origin, ahead), taken(self.coarse.origin, behind))

    @cached_property
    def _outline(self) -> Operator:
        """(n_rim, n_vertices): the points of the rim."""
        return rim_points(self.coarse, self.rim)

    @cached_property
    def _made_over(self) -> list[tuple[Small, Floats]]:
        """For each of ``spokes`` their edges, and how much of the point there is theirs."""
        edges = [taken(self._edge.ravel(), some) for some in self.spokes]
        count = np.bincount(np.concatenate([e.ravel() for e in edges])) if edges else np.zeros(0)
        return [(e, 1 / count[e]) for e in edges]


def butterfly_step(t: Topology, beside: Beside) -> ButterflyStep:
    """One step on ``t``."""
    rim = np.flatnonzero(t.twin < 0)
    counts = np.bincount(t.origin, minlength=t.n_vertices)
    counts[t.origin[rim]] = counts[taken(t.origin, t.next[rim])] = 0  # regular, for all that it matters
    first = np.empty(t.n_vertices, dtype=np.intp)
    first[t.origin] = np.arange(t.n_halfedges)
    groups = []
    for n in np.flatnonzero(np.bincount(counts)).tolist():
        if n not in (0, 6):
            spokes = [first[counts == n]]
            while len(spokes) < n:
                spokes.append(ahead_of(taken(t.twin, spokes[-1])))
            groups.append(np.stack(spokes))
    return ButterflyStep(t, beside, rim, tuple(groups))


def others(of_halfedges: Floats) -> Floats:
    """What the next and the previous half-edge of each of (n, 3, d) have together."""
    both = turned(of_halfedges, 1)
    both += turned(of_halfedges, -1)
    return both


def ahead_of(halfedges: Indices) -> Indices:
    """The next ones, in triangles."""
    return halfedges + np.where(halfedges % 3 == 2, -2, 1)


@lru_cache(maxsize=64)
def _round(beside: Beside, n: int) -> Floats:
    """(n, n): row by row what the points beside a vertex hold of its neighbours."""
    row = np.array([float(beside(n, j)) for j in range(n)])
    return np.take(row, (np.arange(n) - np.arange(n)[:, None]) % n)


def add(at: Small, values: Floats, out: Floats, weight: float = 1) -> None:
    """Add ``weight`` times the ``values`` to ``out`` ``at`` their places."""
    n, d = values.shape
    places = np.arange(n, dtype=np.int32)
    _sparsetools.coo_matmat_dense(n, d, at, places, np.full(n, weight), values.reshape(-1), out.reshape(-1))

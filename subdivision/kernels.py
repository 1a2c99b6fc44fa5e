"""One subdivision step on whole arrays: every new point is a short row of weights, and all rows are applied at once.

The stages of a scheme say the same in words; tests hold the two together.  What distinguishes
a scheme from the others that refine alike is its ``reach``; all else follows from the
topology.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import _sparsetools

from subdivision import refine
from subdivision.arrays import Floats, Indices, taken
from subdivision.exact import Exact
from subdivision.sharpness import CORNER, CREASE, SMOOTH, vertex_rules
from subdivision.topology import Topology

Small = NDArray[np.int32]
Reach = Callable[[int], Exact | int]
"""Valence -> how far a smooth vertex goes to the mean of its ring."""


@dataclass(frozen=True, eq=False)
class Rows:
    """Sparse rows: row ``i`` weighs point ``index[j]`` by ``weight[j]`` for ``start[i] <= j < start[i + 1]``."""

    start: Small
    index: Small
    weight: Floats

    def apply(self, points: Floats, out: Floats) -> None:
        """Write the rows of ``points`` (n, d) to ``out`` (n_rows, d); both are contiguous."""
        out.fill(0)
        _sparsetools.csr_matvecs(
            len(out), len(points), points.shape[1],
            self.start, self.index, self.weight, points.reshape(-1), out.reshape(-1),
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Kernel:
    """One step from ``coarse``, numbered as the stages do.

    Of quads the vertex and edge points read face points too; triangles have no ``faces``.
    """

    coarse: Topology
    vertices: Rows
    edges: Rows
    faces: Rows | None = None

    @property
    def n_points(self) -> int:
        """How many points it makes."""
        return self.coarse.n_vertices + self.coarse.n_edges + (self.coarse.n_faces if self.faces else 0)

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float -> (n_points, d) float, into ``out`` if there is one."""
        V, d = points.shape
        inner = self.n_points - self.coarse.n_edges
        made = np.empty((self.n_points, d)) if out is None else out
        read = points
        if self.faces:
            read = np.empty((inner, d))
            read[:V] = points
            self.faces.apply(points, read[V:])
            made[V:inner] = read[V:]
        self.vertices.apply(read, made[:V])
        self.edges.apply(read, made[inner:])
        return made

    def refined(self) -> Topology:
        """The topology after the step: its corners now, the rest if it is asked for."""
        t = self.coarse
        origin = refine.quad_corners(t) if self.faces else refine.triangle_corners(t)
        split = refine.quads if self.faces else refine.triangles
        return refine.deferred(t, lambda: split(t), origin, 4 if self.faces else 3, self.n_points)


def quads(t: Topology, reach: Reach) -> Kernel:
    """The step that splits every face into quads; half of a ring are neighbours, half the points of faces around."""
    V = t.n_vertices
    ahead, centre = taken(t.origin, t.next), V + t.face
    per = _reached(t, reach) / 2
    start = np.concatenate([[0], np.cumsum(t.face_sizes)])
    weight = np.full(t.n_halfedges, 1 / 4) if t.is_quadrilateral else (1 / t.face_sizes)[t.face]
    return Kernel(
        t,
        vertices=_vertex_rows(t, [ahead, centre], per, V + t.n_faces),
        edges=_edge_rows(t, ahead, centre, 1 / 2),
        faces=Rows(_small(start), _small(t.origin), weight),
    )


def triangles(t: Topology, reach: Reach) -> Kernel:
    """The step that splits every triangle into four; the ring of a vertex is its neighbours."""
    ahead, wing = taken(t.origin, t.next), taken(t.origin, t.prev)
    return Kernel(
        t,
        vertices=_vertex_rows(t, [ahead], _reached(t, reach), t.n_vertices),
        edges=_edge_rows(t, ahead, wing, 3 / 4),
    )


def is_smooth(t: Topology) -> bool:
    """Whether nothing is sharp, so that all rows are those of smooth points."""
    return not (t.edge_sharpness.any() or t.vertex_sharpness.any())


@lru_cache(maxsize=1024)
def _number(reach: Reach, n: int) -> float:
    return float(reach(n))


def _reached(t: Topology, reach: Reach) -> Floats:
    """(n_vertices,) float: what each corner of a vertex weighs; all of them together ``reach`` of its valence."""
    counts = np.bincount(t.origin, minlength=t.n_vertices)
    table = np.zeros(int(counts.max(initial=0)) + 1)
    present = np.flatnonzero(np.bincount(counts))
    for n in present[present > 0]:
        table[n] = _number(reach, int(n)) / n
    return table[counts]


def _edge_rows(t: Topology, ahead: Indices, beside: Indices, ends: float) -> Rows:
    """Edge points: ``ends`` of the midpoint, the rest of what is ``beside`` the edge; sharp ones are midpoints."""
    half = np.empty(t.n_edges, dtype=np.intp)
    half[t.edge] = np.arange(t.n_halfedges)
    across = taken(t.twin, half)
    index = np.empty((t.n_edges, 4), dtype=np.int32)
    for k, part in enumerate((t.origin, ahead, beside)):
        index[:, k] = taken(part, half)
    index[:, 3] = taken(beside, np.where(across >= 0, across, half))
    weight = np.empty((t.n_edges, 4))
    weight[:, :2], weight[:, 2:] = ends / 2, (1 - ends) / 2
    sharp = np.flatnonzero(t.edge_sharpness)
    share = np.minimum(t.edge_sharpness[sharp], 1)[:, None]
    weight[sharp] = share * [1 / 2, 1 / 2, 0, 0] + (1 - share) * weight[sharp]
    return Rows(np.arange(0, 4 * t.n_edges + 1, 4, dtype=np.int32), index.ravel(), weight.ravel())


def _vertex_rows(t: Topology, around: list[Indices], per: Floats, n_columns: int) -> Rows:
    """Vertex points: smooth ones go to what is ``around`` their corners, ``per`` vertex and corner."""
    itself = 1 - len(around) * per * np.bincount(t.origin, minlength=t.n_vertices)
    creases: list[tuple[Indices, Indices, Floats]] = []
    if not is_smooth(t):
        rules = vertex_rules(t)
        parts = [(rules.now, rules.stays, rules.sharp_now), (rules.then, 1 - rules.stays, rules.sharp_then)]
        smooth, keep = (sum(share * (rule == kind) for rule, share, _ in parts) for kind in (SMOOTH, CORNER))
        itself, per = smooth * itself + keep, smooth * per
        for rule, share, sharp in parts:
            crease = share * (rule == CREASE)
            itself += 3 / 4 * crease
            a, b = t.ends[sharp].T
            creases += [(a, b, crease[a] / 8), (b, a, crease[b] / 8)]
    own = np.arange(t.n_vertices)
    spread = taken(per, t.origin)
    entries = [(own, own, itself), *((t.origin, one, spread) for one in around), *creases]
    return _sorted_rows(t.n_vertices, n_columns, *(np.concatenate(part) for part in zip(*entries, strict=True)))


def _sorted_rows(n_rows: int, n_columns: int, row: Indices, column: Indices, weight: Floats) -> Rows:
    """Rows from entries in any order."""
    rows = Rows(np.empty(n_rows + 1, dtype=np.int32), np.empty(len(row), dtype=np.int32), np.empty(len(row)))
    _sparsetools.coo_tocsr(
        n_rows, n_columns, len(row), _small(row), _small(column), weight, rows.start, rows.index, rows.weight
    )
    return rows


def _small(indices: Indices) -> Small:
    return indices.astype(np.int32)

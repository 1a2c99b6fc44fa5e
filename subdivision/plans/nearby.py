"""A mesh numbered along its surface: what is near on it is near in memory, and found in the cache when it is gathered.

Cuthill and McKee's order of the vertices [CM69]_; faces follow their least vertex, and edges their first face.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from subdivision.arrays import Floats, Indices, Small, inverse, next_corners, stretches, taken
from subdivision.topology import Topology


@dataclass(frozen=True, eq=False)
class Nearby:
    """The same mesh, numbered anew.

    Attributes
    ----------
    topology : Topology
        With the new numbers.
    vertices : (n_vertices,) int
        The number before of each vertex.
    halfedges : (n_halfedges,) int
        The number now of each half-edge.
    """

    topology: Topology
    vertices: Small
    halfedges: Indices

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float before -> (n_vertices, d) float in the new order, into ``out`` if there is one."""
        return points.take(self.vertices, axis=0, mode="clip", out=out)

    def as_before(self, told: Indices, size: int, levels: int) -> Indices:
        """What is ``told`` of each half-edge after ``levels``, (n,), in the order which the mesh before leads to.

        ``size`` corners have the faces that ``refine.quads`` and ``refine.triangles`` make.
        """
        if levels == 0:
            return taken(told, self.halfedges)
        if size == 4:
            return self.as_before(told.reshape(len(told) // 4, -1), size, levels - 1).reshape(told.shape)
        outer, inner = np.split(told, [3 * len(told) // 4])
        corners = self.as_before(outer.reshape(len(inner), -1), size, levels - 1).reshape(outer.shape)
        return np.concatenate([corners, self.as_before(inner, size, levels - 1)])


def nearby(t: Topology) -> Nearby:
    """``t`` with all its vertices, edges and faces numbered along it."""
    vertices = _along(t)
    corners = taken(inverse(vertices), t.origin)
    start = np.cumsum(t.face_sizes) - t.face_sizes
    faces = np.lexsort((np.maximum.reduceat(corners, start), np.minimum.reduceat(corners, start)))
    sizes = t.face_sizes[faces]
    before = stretches(start[faces], sizes)
    now = inverse(before)
    edges = _by_first(t.edge[before], t.n_edges)
    twin = t.twin[before]
    mesh = Topology(
        corners[before], next_corners(sizes), np.where(twin < 0, -1, taken(now, twin)), inverse(edges)[t.edge[before]],
        np.repeat(np.arange(t.n_faces), sizes), t.n_vertices, t.edge_sharpness[edges], t.vertex_sharpness[vertices],
        t.hidden[faces],
    )  # fmt: skip
    return Nearby(mesh, vertices, now)


def _along(t: Topology) -> Small:
    """(n_vertices,) int: every vertex, near those that are near it."""
    from scipy.sparse.csgraph import reverse_cuthill_mckee  # here: it takes as long to load as small plans take to make

    a, b = t.ends.T
    ones = np.ones(2 * len(a), dtype=np.int8)
    graph = csr_array((ones, (np.concatenate([a, b]), np.concatenate([b, a]))), shape=(t.n_vertices, t.n_vertices))
    return reverse_cuthill_mckee(graph, symmetric_mode=True)


def _by_first(numbers: Indices, n: int) -> Indices:
    """(n,) int: the numbers below ``n`` in the order in which each comes first."""
    first = np.empty(n, dtype=np.intp)
    first[numbers[::-1]] = np.arange(len(numbers))[::-1]
    return np.argsort(first)

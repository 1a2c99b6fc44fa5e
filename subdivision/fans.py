"""Corners counted round their vertices, and sums that weigh each corner by its number."""

from collections.abc import Callable
from fractions import Fraction
from functools import reduce
from typing import TypeAlias

import numpy as np

from subdivision.arrays import Indices, Mask, taken
from subdivision.averages import vertex_corners
from subdivision.exact import Exact
from subdivision.operators import Operator, Pick
from subdivision.topology import Topology
from subdivision.weights import Weights, by_count

Corner: TypeAlias = tuple[Exact | int, Exact | int, Exact | int, Exact | int]
"""What a sum takes of one face round a vertex: of the vertex itself, of the next, opposite and previous corners."""

NOTHING: Corner = (0, 0, 0, 0)


def dart_ends(t: Topology) -> Mask:
    """(n_halfedges,) bool: half-edges along the only sharp edge of an inner vertex."""
    if t.is_smooth:
        return np.zeros(t.n_halfedges, dtype=bool)
    sharp = t.edge_sharpness > 0
    alone = np.bincount(t.ends[sharp].ravel(), minlength=t.n_vertices) == 1
    inner = ~t.on_boundary & (t.vertex_sharpness == 0)
    return np.asarray(sharp[t.edge] & (alone & inner)[t.origin])


def numbered(t: Topology) -> Indices:
    """(n_halfedges,) int: corners counted counter-clockwise round their vertex.

    The first is where the mesh begins, or the only sharp edge, or the corner stored first; the
    children of a corner stay where it was in this order.
    """
    first = np.full(t.n_vertices, -1)
    for some in (np.arange(t.n_halfedges)[::-1], np.flatnonzero(dart_ends(t)), np.flatnonzero(t.twin < 0)):
        first[t.origin[some]] = some  # later entries overwrite earlier ones
    rank, around = np.zeros(t.n_halfedges, dtype=np.intp), taken(t.twin, t.prev)
    here = first[first >= 0]
    start = here
    for number in range(len(t.origin)):
        rank[here] = number
        ahead = taken(around, here)
        goes_on = (ahead >= 0) & (ahead != start)
        here, start = ahead[goes_on], start[goes_on]
        if len(here) == 0:
            break
    return rank


def weighed(t: Topology, kinds: Indices, weights: Callable[[int, int], list[Corner]]) -> Operator:
    """(n_vertices, n_vertices): sums over the corners of each vertex.

    ``weights(kind, n)`` lists what each of the ``n`` corners of a vertex of that kind weighs;
    vertices of kind 0 get nothing.
    """
    size = np.bincount(t.origin, minlength=t.n_vertices)
    base = int(size.max()) + 1
    cases, case = np.unique((kinds * base + size)[t.origin], return_inverse=True)
    tables = [weights(*divmod(int(key), base)) if key >= base else [NOTHING] for key in cases]
    begins = np.cumsum([0, *(len(table) for table in tables)])
    entry = begins[case] + np.where(kinds[t.origin] > 0, numbered(t), 0)
    entries = [corner for table in tables for corner in table]
    read = (t.origin, t.origin[t.next], t.origin[t.next[t.next]], t.origin[t.prev])
    parts = [
        Weights(tuple(Fraction(0) + corner[k] for corner in entries), entry) * Pick(ends, t.n_vertices)
        for k, ends in enumerate(read)
    ]
    return by_count(lambda n: n, size) * (vertex_corners(t) @ reduce(Operator.__add__, parts))

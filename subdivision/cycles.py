"""Sums round cycles of corners: the corners of a face, or the corners of an inner vertex."""

from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache

import numpy as np

from subdivision.arrays import Indices, Mask, taken
from subdivision.exact import Exact
from subdivision.fans import numbered
from subdivision.operators import Mean, Operator, Pick
from subdivision.topology import Topology
from subdivision.weights import Weights

Wave = Callable[[int, int], Exact | int]
"""Length of a cycle, steps ahead along it -> weight."""


def round_faces(t: Topology, wave: Wave) -> Operator:
    """(n_halfedges, n_halfedges): each corner to a sum over the corners of its face, counted from itself."""
    return _sums(np.arange(t.n_halfedges), t.face_sizes, wave, t.n_halfedges)


def round_vertices(t: Topology, some: Mask, wave: Wave) -> Operator:
    """Likewise over the corners of the vertex, counter-clockwise; rows of vertices other than ``some`` are zero.

    Only vertices inside the mesh may be among ``some`` (n_vertices,).
    """
    slots, sizes = vertex_slots(t, some)
    order = np.empty(int(sizes.sum()), dtype=np.intp)
    order[slots[slots >= 0]] = np.flatnonzero(slots >= 0)
    return _sums(order, sizes, wave, t.n_halfedges)


def vertex_slots(t: Topology, some: Mask) -> tuple[Indices, Indices]:
    """Corners laid end to end, vertex by vertex and counter-clockwise: the place of each (-1: none), and the counts."""
    sizes = np.where(some, np.bincount(t.origin, minlength=t.n_vertices), 0)
    first = np.cumsum(sizes) - sizes
    slots = taken(first, t.origin) + numbered(t)
    return np.where(taken(some, t.origin), slots, -1), sizes


@lru_cache(maxsize=256)
def _weights(wave: Wave, k: int) -> list[Exact]:
    """What is to be averaged along a cycle of length ``k``, where a mean divides by ``k`` again."""
    return [Fraction(k) * wave(k, j) for j in range(k)]


def _sums(order: Indices, sizes: Indices, wave: Wave, n: int) -> Operator:
    """Sums along cycles of ``sizes``, whose members ``order`` lists end to end; there are ``n`` points in all."""
    rows, columns, entries = [], [], []
    table: list[Exact] = []
    first = np.cumsum(sizes) - sizes
    for k in np.unique(sizes[sizes > 0]).tolist():
        members = order[first[sizes == k][:, None] + np.arange(k)]
        ahead = np.arange(k)
        rows.append(np.repeat(members, k))
        columns.append(members[:, (ahead[:, None] + ahead).ravel() % k].ravel())
        entries.append(np.tile(len(table) + ahead, members.size))
        table += _weights(wave, k)
    row, column, entry = (np.concatenate(parts) if parts else order[:0] for parts in (rows, columns, entries))
    weighed = Weights(tuple(table), entry) * Pick(column, n)
    return Mean(row, np.arange(len(row)), (n, len(row))) @ weighed

"""Sums round cycles of corners: the corners of a face, or the corners of an inner vertex."""

from collections.abc import Callable
from fractions import Fraction

import numpy as np

from subdivision.arrays import Indices, Mask
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
    return np.where(some[t.origin], first[t.origin] + numbered(t), -1), sizes


def _sums(order: Indices, sizes: Indices, wave: Wave, n: int) -> Operator:
    """Sums along cycles of ``sizes``, whose members ``order`` lists end to end; there are ``n`` points in all."""
    length, first = np.repeat(sizes, sizes), np.repeat(np.cumsum(sizes) - sizes, sizes)
    slot = np.repeat(np.arange(len(order)), length)
    ahead = np.arange(len(slot)) - np.repeat(np.cumsum(length) - length, length)
    there = first[slot] + (slot - first[slot] + ahead) % length[slot]
    lengths = np.unique(sizes[sizes > 0])
    table = tuple(Fraction(k) * wave(k, j) for k in lengths.tolist() for j in range(k))  # a mean divides by k again
    entry = (np.cumsum(lengths) - lengths)[np.searchsorted(lengths, length[slot])] + ahead
    weighed = Weights(table, entry) * Pick(order[there], n)
    return Mean(order[slot], np.arange(len(slot)), (n, len(slot))) @ weighed

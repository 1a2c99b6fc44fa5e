"""The four-point rule of Dyn, Gregory and Levin [DGL87]_, for polygons and for the outlines of meshes.

A new point is ``(1/2 + w)`` of each of the two in the middle and ``-w`` of each of the outer two:
the midpoint, pushed away from the mean of the outer two by ``2 w`` of the way between them.
"""

from fractions import Fraction

import numpy as np

from subdivision.arrays import Indices, Mask
from subdivision.operators import Mean, MeanOf, Operator, Pick, mix
from subdivision.topology import Topology
from subdivision.weights import by_value

CUBIC = Fraction(1, 16)
"""The tension with which points on a cubic stay on it."""


def pushed(midpoint: Operator, outer: Operator, tension: Fraction) -> Operator:
    """``midpoint`` away from ``outer``, the mean of the outer two."""
    return (1 + 2 * tension) * midpoint + (-2 * tension) * outer


def along(before: Operator, ends: Indices, after: Operator, tension: Fraction) -> Operator:
    """A row for each pair ``ends`` (m, 2) of points, with one point before and one after it."""
    outer = Fraction(1, 2) * before + Fraction(1, 2) * after
    return pushed(MeanOf(ends, before.shape[1]), outer, tension)


def reflected(index: Indices, there: Mask, end: Indices, inner: Indices, n: int) -> Operator:
    """Points ``index`` where they are ``there``; else the phantom ``2 end - inner`` beyond the last one."""
    known = Pick(np.where(there, index, end), n)
    if there.all():
        return known
    return mix(by_value(there), known, 2 * Pick(end, n) + (-1) * Pick(inner, n))


def outline(t: Topology, tension: Fraction = CUBIC) -> Operator:
    """(n_edges, n_vertices): boundary edges to their points on the outline; other rows are zero."""
    rim = np.flatnonzero(t.twin < 0)
    return Mean(t.edge[rim], np.arange(len(rim)), (t.n_edges, len(rim))) @ rim_points(t, rim, tension)


def rim_points(t: Topology, rim: Indices, tension: Fraction = CUBIC) -> Operator:
    """(n_rim, n_vertices): the ``rim``, all half-edges of the boundary, to its points: a four-point curve.

    It ends at sharp vertices, where a phantom point is reflected.
    """
    V = t.n_vertices
    a, b = t.origin[rim], t.origin[t.next[rim]]
    back, ahead = np.zeros(V, dtype=np.intp), np.zeros(V, dtype=np.intp)
    back[b], ahead[a] = a, b
    goes_on = t.vertex_sharpness == 0
    before, after = reflected(back[a], goes_on[a], a, b, V), reflected(ahead[b], goes_on[b], b, a, V)
    return along(before, np.stack([a, b], axis=1), after, tension)

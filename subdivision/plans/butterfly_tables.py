"""Many levels of the modified butterfly at once: tables, as ``tables`` has them, that read two rings of triangles.

Two rings hold too many extraordinary vertices for a table of each kind.  So the tables read what
one step has made of the first ring: its vertices and the points of its edges are two rings of
the next level.  Round a triangle that a step has made, only the first corner may be
extraordinary, and from there on no other vertex is near enough to matter.
"""

import numpy as np

from subdivision.arrays import Indices, taken
from subdivision.plans.butterfly_later import butterfly_after
from subdivision.plans.butterfly_steps import Beside, butterfly_step
from subdivision.plans.poles import VALENCES, Table, by_valence, poles, rows, shown
from subdivision.plans.tables import Tables, laid_out
from subdivision.plans.templates import descendants, template
from subdivision.topology import Topology

DEPTHS = range(3, 5)
"""Of fewer levels a table is not worth it; of more, larger ones would not be faster."""


def butterfly_tables(t: Topology, depth: int, beside: Beside, at_most: int) -> Tables | None:
    """Tables for ``depth`` levels from ``t``, made by a step, that read the points one step on.

    None where the mesh is open, a valence is not among ``VALENCES``, or there are more than ``at_most`` kinds.
    """
    if (t.twin < 0).any():
        return None
    counts = np.bincount(t.origin, minlength=t.n_vertices)
    first = counts[t.origin[::3]]
    first[3 * t.n_faces // 4 :] = 0  # in the middle of a triangle before all corners are regular
    faces = np.argsort(first.astype(np.uint16), kind="stable")
    present = np.bincount(first)
    found = np.flatnonzero(present).tolist()
    kinds = [n or 6 for n in found]
    if len(kinds) > at_most or not set(kinds) <= set(VALENCES):
        return None
    ends = np.cumsum(present[found])
    tables = by_valence(_computed, kinds, depth, beside)
    alike = zip(kinds, np.split(faces, ends[:-1]), tables, strict=True)
    rings = [_ring(t, some, n)[walks] for n, some, (walks, _) in alike]
    return laid_out(t, depth, faces, np.concatenate([[0], ends]), rings, [table for _, table in tables])


def _ring(t: Topology, faces: Indices, n: int) -> Indices:
    """(..., n_faces) int: what one step makes of the ring round each of ``faces``, some of it twice.

    Of each corner, the first one of valence ``n``: the vertex, its neighbours, the edges to them and those between.
    """
    found = []
    for corner in range(3):
        spoke = 3 * faces + corner
        found.append(taken(t.origin, spoke))
        for _ in range(6 if corner else n):
            rim = taken(t.next, spoke)
            found += [taken(t.origin, rim), t.n_vertices + taken(t.edge, spoke), t.n_vertices + taken(t.edge, rim)]
            spoke = taken(t.next, taken(t.twin, spoke))
    return np.stack(found)


def _computed(valences: list[int], depth: int, beside: Beside) -> list[Table]:
    """The points of the template round poles, from the rings."""
    t, first = poles(valences, splits=1)
    steps = [butterfly_after(butterfly_step(t, beside))]
    while len(steps) < depth - 1:
        steps.append(butterfly_after(steps[-1]))
    small, each = descendants(3, t.n_faces, depth)
    corners = steps[-1].topology.origin.reshape(-1, 3)[small + each * first[:, None]]
    own = corners.reshape(len(valences), -1)[:, template(3, depth).first]
    rings = [_ring(t, face, n)[:, 0] for n, face in zip(valences, first[:, None], strict=True)]
    return shown(rows(own.ravel(), steps), rings)

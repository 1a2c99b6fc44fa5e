"""Many levels of the modified butterfly at once: tables, as ``tables`` has them, that read two rings of triangles.

Two rings hold too many extraordinary vertices for a table of each kind.  So the tables read what
one step has made of the first ring: its vertices and the points of its edges are two rings of
the next level.  Round a triangle that a step has made, only the first corner may be
extraordinary, and from there on no other vertex is near enough to matter.
"""

from functools import lru_cache

import numpy as np

from subdivision.arrays import Floats, Indices, taken
from subdivision.butterfly_steps import Beside, butterfly_step
from subdivision.poles import pole
from subdivision.tables import Tables, laid_out
from subdivision.templates import descendants, template
from subdivision.topology import Topology

DEPTHS = range(3, 5)
"""Of fewer levels a table is not worth it; of more, larger ones would not be faster."""

LARGEST_FAN = 32
"""Vertices of more faces are too rare, and their rings too large, for a table of their own."""


def butterfly_tables(t: Topology, depth: int, beside: Beside, at_most: int) -> Tables | None:
    """Tables for ``depth`` levels from ``t``, closed and made by a step, that read the points one step on.

    None where vertices have more than ``LARGEST_FAN`` triangles, or more than ``at_most`` different numbers of them.
    """
    counts = np.bincount(t.origin, minlength=t.n_vertices)
    first = counts[t.origin[::3]]
    first[3 * t.n_faces // 4 :] = 0  # in the middle of a triangle before all corners are regular
    faces = np.argsort(first.astype(np.uint16), kind="stable")
    present = np.bincount(first)
    valences = np.flatnonzero(present).tolist()
    if valences[-1] > LARGEST_FAN or len(valences) > at_most:
        return None
    ends = np.cumsum(present[valences])
    rings, tables = [], []
    for n, some in zip(valences, np.split(faces, ends[:-1]), strict=True):
        walks, table = _table(n or 6, depth, beside)
        rings.append(_ring(t, some, n or 6)[walks])
        tables.append(table)
    return laid_out(t, depth, faces, np.concatenate([[0], ends]), rings, tables)


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


@lru_cache(maxsize=128)
def _table(n: int, depth: int, beside: Beside) -> tuple[Indices, Floats]:
    """Which of the ring are read, and (n_points, n_read) float: the points of the template made of them.

    The first triangle of a pole of valence ``n`` shows it.
    """
    t = pole(n, splits=1)
    step = butterfly_step(t, beside)
    steps = []
    for _ in range(depth - 1):
        step = step.after().step
        steps.append(step)
    small, _ = descendants(3, t.n_faces, depth)
    own = step.topology.origin.reshape(-1, 3)[small].ravel()[template(3, depth).first]
    rows = steps[-1].assembled().matrix[own]
    for step in reversed(steps[:-1]):
        rows = rows @ step.assembled().matrix
    ring, walks = np.unique(_ring(t, np.zeros(1, dtype=np.intp), n)[:, 0], return_index=True)
    table = rows[:, ring].toarray()
    read = table.any(axis=0)
    return walks[read], np.ascontiguousarray(table[:, read])

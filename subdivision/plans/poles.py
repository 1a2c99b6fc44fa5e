"""Tables by valence, made round poles: vertices of any valence in closed meshes of triangles, all regular near them.

What is like the first triangle at a pole has its table.  All valences that a mesh has are shown
side by side in one mesh, and what was computed for another mesh is remembered.
"""

from collections.abc import Callable, Hashable, Sequence
from typing import Protocol, TypeAlias, TypeVar

import numpy as np
from scipy.sparse import csr_array

from subdivision import refine
from subdivision.arrays import Floats, Indices
from subdivision.plans.kernels import Rows
from subdivision.topology import Topology

Table: TypeAlias = tuple[Indices, Floats]
"""Which members of a ring are read, and (n_own, n_read) float: the points made of them."""

Rule = TypeVar("Rule", bound=Hashable)

VALENCES = range(3, 33)
"""Of poles; others are too rare, or fold the triangles round them on each other."""

_remembered: dict[Hashable, Table] = {}
REMEMBERED_AT_MOST = 256


class Assembled(Protocol):
    """A step that can be had as one sparse matrix."""

    def assembled(self) -> Rows: ...


def by_valence(
    compute: Callable[[list[int], int, Rule], list[Table]], valences: list[int], depth: int, rule: Rule
) -> list[Table]:
    """A table for each valence, by the rule of a scheme; ``compute`` is not asked for what it has made before."""
    known = {n: _remembered[compute, n, depth, rule] for n in valences if (compute, n, depth, rule) in _remembered}
    missing = sorted(set(valences) - set(known))
    if missing:
        known |= zip(missing, compute(missing, depth, rule), strict=True)
        if len(_remembered) > REMEMBERED_AT_MOST:
            _remembered.clear()
        _remembered.update({(compute, n, depth, rule): known[n] for n in missing})
    return [known[n] for n in valences]


def forget() -> None:
    """Remember no tables, as a new process does."""
    _remembered.clear()


def poles(valences: list[int], splits: int) -> tuple[Topology, Indices]:
    """A double cone for each valence, its triangles split in four ``splits`` times, and the first triangle at each tip.

    It begins with the tip, from which it is 2 ** splits steps to the rim, where vertices of valence 4 are.
    """
    cones, n_vertices, n_faces, first = [], 0, 0, []
    for n in valences:
        tip, other, rim = n_vertices, n_vertices + 1, n_vertices + 2 + np.arange(n)
        ahead = np.roll(rim, -1)
        cones.append(np.stack(np.broadcast_arrays(tip, rim, ahead, other, ahead, rim), axis=1).ravel())
        first.append(n_faces)
        n_vertices, n_faces = n_vertices + 2 + n, n_faces + 2 * n
    t = Topology.from_corners(np.full(n_faces, 3), np.concatenate(cones))
    for _ in range(splits):
        t = refine.triangles(t)
    return t, 3**splits * np.array(first)


def rows(points: Indices, steps: Sequence[Assembled]) -> csr_array:
    """(n_points, n_read): what these points, which the last of ``steps`` makes, hold of those that the first reads."""
    held = steps[-1].assembled().matrix[points]
    for step in reversed(steps[:-1]):
        held = csr_array(held @ step.assembled().matrix)
    return held


def shown(held: csr_array, rings: list[Indices]) -> list[Table]:
    """A table for each pole, from the rows of all, as many for each, and its ring, which may have members twice."""
    members = [np.unique(ring, return_index=True) for ring in rings]
    place = np.zeros(held.shape[1], dtype=np.intp)
    for ring, _ in members:
        place[ring] = np.arange(len(ring))
    entries = held.tocoo()
    dense = np.zeros((held.shape[0], max(len(ring) for ring, _ in members)))
    dense[entries.row, place[entries.col]] = entries.data
    found = []
    for (_, walks), table in zip(members, dense.reshape(len(rings), -1, dense.shape[1]), strict=True):
        read = np.flatnonzero(table.any(axis=0))
        found.append((walks[read], np.ascontiguousarray(table[:, read])))
    return found

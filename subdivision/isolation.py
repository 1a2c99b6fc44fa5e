"""What a level counts: vertices, edges, faces, and how far apart its extraordinary vertices are."""

from dataclasses import dataclass

import numpy as np

from subdivision.topology import Topology


@dataclass(frozen=True)
class Counts:
    """``apart`` is the least number of edges between two extraordinary vertices; None where there are not two."""

    vertices: int
    edges: int
    faces: int
    euler: int
    extraordinary: int
    apart: int | None


def counts(t: Topology) -> Counts:
    """The counts of one mesh."""
    return Counts(t.n_vertices, t.n_edges, t.n_faces, t.euler, int(t.extraordinary.sum()), apart(t))


def apart(t: Topology) -> int | None:
    """The least number of edges on a way from one extraordinary vertex to another.

    All of them spread at once, an edge a round; the first edge where two of their regions meet tells.
    """
    region = np.where(t.extraordinary, np.arange(t.n_vertices), -1)
    far = np.where(t.extraordinary, 0, -1)
    both = np.concatenate([t.ends, t.ends[:, ::-1]])
    while True:
        a, b = t.ends.T
        meet = (region[a] >= 0) & (region[b] >= 0) & (region[a] != region[b])
        if meet.any():
            return int((far[a] + far[b] + 1)[meet].min())
        onward = both[(region[both[:, 0]] >= 0) & (region[both[:, 1]] < 0)]
        if not len(onward):
            return None
        region[onward[:, 1]] = region[onward[:, 0]]
        far[onward[:, 1]] = far[onward[:, 0]] + 1

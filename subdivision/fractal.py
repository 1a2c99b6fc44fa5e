"""The Sierpinski triangle as an iteration: what subdivision is set beside [Bar93]_.

``C(n+1) = W(C(n))``: three copies of all there is, each shrunk by half towards its corner.  The
maps ``w_i(p) = (p + v_i)/2`` are averages, so a step is a matrix like that of a subdivision
scheme; but nothing gets smooth.
"""

import numpy as np

from subdivision.operators import Pick
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.stage import Role, Stage, Step
from subdivision.topology import Topology

CORNERS = 3


def separate_triangles(n: int) -> Topology:
    """``n`` triangles that share no vertex: triangle ``k`` has the vertices ``3k .. 3k + 2``."""
    return Topology.from_corners(np.full(n, CORNERS), np.arange(CORNERS * n))


def copy_and_contract(t: Connectivity) -> Step:
    """Three coinciding copies; then copy ``i`` goes half way to corner ``v_i``.

    Copy ``i`` of vertex ``k`` is number ``i V + k``.  So ``v_i``, which no step of its own copy
    moves, is vertex ``i (V - 1)/2``: there is nothing to search.
    """
    V, copies = t.n_vertices, CORNERS * t.n_vertices
    source, copy = np.tile(np.arange(V), CORNERS), np.repeat(np.arange(CORNERS), V)
    corner = copy * V + copy * (V - 1) // 2
    after, all_of_them = separate_triangles(CORNERS * t.n_faces), np.arange(copies)
    halfway = 1 / 2 * Pick(all_of_them, copies) + 1 / 2 * Pick(corner, copies)
    return Step((
        Stage("copy", Pick(source, V), after, source, np.full(copies, Role.ORIGINAL)),
        Stage("contract", halfway, after, all_of_them, np.full(copies, Role.MOVED)),
    ))  # fmt: skip


def _refuses(t: Connectivity) -> str:
    """Why ``t`` is no ``C(n)``; empty where it is."""
    powers = [CORNERS**n for n in range(20)]
    apart = isinstance(t, Topology) and t.is_triangular and t.n_vertices == CORNERS * t.n_faces
    return "" if apart and t.n_faces in powers else "it is not one triangle, or what the iteration makes of one"


SIERPINSKI = Scheme(
    name="sierpinski",
    title="Sierpinski triangle",
    paper="Bar93",
    refuses=_refuses,
    tellings={"copy and contract": copy_and_contract},
)

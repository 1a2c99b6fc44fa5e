"""Mid-edge subdivision [PR97]_, the simplest scheme there is: connect the midpoints of neighbouring edges.

Every face keeps a smaller copy of itself, and every vertex of valence n leaves an n-gon behind;
new valences are 4.  Two steps on a regular quad mesh are one of the box spline of four directions
(Zwart-Powell): the weights are then 1/2, 1/4, 1/4.  The mesh must be closed.
"""

from fractions import Fraction

import numpy as np

from subdivision import meshes
from subdivision.averages import edge_midpoints, neighbours
from subdivision.limit_rules import vertices_to
from subdivision.operators import MeanOf, Operator, Pick, identity, stack
from subdivision.plans.corner_numbers import BY_MIDPOINTS
from subdivision.refine_dual import MIDPOINTS, midpoints
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.stage import Role, Stage, Step, grown
from subdivision.topology import Topology


def connected_midpoints(topology: Connectivity) -> Step:
    """Mark the midpoints; connect them, and the old vertices are gone."""
    t = meshes.as_mesh(topology)
    V, E = t.n_vertices, t.n_edges
    made = V + np.arange(E)
    roles = np.repeat([Role.ORIGINAL, Role.EDGE], [V, E])
    return Step((
        Stage("midpoints", stack(identity(V), edge_midpoints(t)), t, grown(V, E), roles),
        Stage("connect", Pick(made, V + E), midpoints(t), made, roles[V:]),
    ))  # fmt: skip


def cut_off(topology: Connectivity) -> Step:
    """Cut the corners off halfway: a point moves along every edge from either end, until the two meet."""
    t = meshes.as_mesh(topology)
    V, E = t.n_vertices, t.n_edges
    a, b = t.ends.T
    roles = np.repeat([Role.ORIGINAL, Role.EDGE], [V, 2 * E])
    pairs = np.stack([np.arange(E), E + np.arange(E)], axis=1)
    return Step((
        Stage("quarters", _quarters(t), t, np.r_[np.arange(V), a, b], roles),
        Stage("meet", MeanOf(V + pairs, V + 2 * E), midpoints(t), V + np.arange(E), np.full(E, Role.EDGE)),
    ))  # fmt: skip


def two_steps(n: int, j: int) -> Fraction:
    """What the point in a corner of a face of ``n`` holds of the corner ``j`` further round after two steps."""
    return Fraction(2 * (j == 0) + (j == 1) + (j == n - 1), 4)


def _quarters(t: Topology) -> Operator:
    """(V + 2 E, V): the vertices; then on every edge a point nearer to its first end; then nearer to the other."""
    there = t.ends[:, ::-1].T.ravel()
    quarter = 3 / 4 * Pick(t.ends.T.ravel(), t.n_vertices) + 1 / 4 * Pick(there, t.n_vertices)
    return stack(identity(t.n_vertices), quarter)


def _limit(topology: Connectivity) -> Stage:
    """Half of the vertex and half of the mean of its neighbours."""
    t = meshes.as_mesh(topology)
    half = Fraction(1, 2)
    return vertices_to(t, half * identity(t.n_vertices) + half * neighbours(t))


MID_EDGE = Scheme(
    name="mid-edge",
    title="Mid-edge",
    paper="PR97",
    refuses=meshes.refusing(meshes.refuses_sharp, meshes.refuses_open),
    tellings={"midpoints": connected_midpoints, "cut the corners": cut_off},
    refinement=MIDPOINTS,
    corners=two_steps,
    numbering=BY_MIDPOINTS,
    limit=_limit,
)

"""Doo-Sabin subdivision [DS78]_ of any polygon mesh, the dual scheme: biquadratic B-splines where all is regular.

Every corner of every face gets a point; the points are connected round the old faces, edges and
vertices.  In a face of n corners the weight of the own corner is ``(n + 5)/(4 n)``, and of the one
``j`` further round ``(3 + 2 cos(2 pi j/n))/(4 n)``: 9/16, 3/16, 1/16, 3/16 in quads.

What the cosines do can be seen.  Every polygon has an *affinely regular* one beside it, the image
of a regular polygon that fits it best; the new point is a quarter of the old corner, a quarter of
the corner of the regular polygon, and a half of the centroid (ours, by adding up the weights).
The plain mean of old corner, two edge midpoints and centroid agrees in quads, not elsewhere.

New valences are 4; faces of n corners and vertices of valence n leave an n-gon behind.
"""

from collections.abc import Callable
from fractions import Fraction
from functools import partial

import numpy as np

from subdivision import meshes
from subdivision.averages import edge_midpoints, face_centroids
from subdivision.cycles import round_faces
from subdivision.exact import Exact, cosine
from subdivision.limit_rules import dual_limit
from subdivision.operators import Mean, Operator, Pick, identity, stack
from subdivision.plans.corner_numbers import BY_CORNERS
from subdivision.refine_dual import CORNERS, corners
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.stage import Role, Stage, Step, grown
from subdivision.topology import Topology

Rule = Callable[[Topology], Operator]
"""(n_halfedges, n_halfedges): where each corner goes, from all corners of its face."""


def cosines(t: Topology) -> Operator:
    """The rule of [DS78]_."""
    own, centroid = identity(t.n_halfedges), _centroid(t)
    return 1 / 4 * own + 1 / 2 * centroid + 1 / 4 * (centroid + _lean(t))


def mean_of_four(t: Topology) -> Operator:
    """The mean of the corner, the midpoints of its two edges and the centroid."""
    own = identity(t.n_halfedges)
    beside = Pick(t.next, t.n_halfedges) + Pick(t.prev, t.n_halfedges)
    return 1 / 2 * own + 1 / 8 * beside + 1 / 4 * _centroid(t)


def cosine_weights(n: int, j: int) -> Exact:
    """What the new corner of a face of ``n`` holds of the corner ``j`` further round, by [DS78]_."""
    if j == 0:
        return Fraction(n + 5, 4 * n)
    return Fraction(3, 4 * n) + cosine(n, j) * Fraction(1, 2 * n)


def four_weights(n: int, j: int) -> Fraction:
    """The same, by the mean of four."""
    return Fraction(1, 4 * n) + Fraction(4 * (j == 0) + (j == 1) + (j == n - 1), 8)


def split_and_shrink(t: Topology, rule: Rule) -> Step:
    """Topology: every vertex once for each of its faces.  Geometry: every face shrinks, and the gaps open."""
    fine, H = corners(t), t.n_halfedges
    return Step((
        Stage("split the vertices", Pick(t.origin, t.n_vertices), fine, t.origin, np.full(H, Role.ORIGINAL)),
        Stage("shrink the faces", rule(t), fine, np.arange(H), np.full(H, Role.MOVED)),
    ))  # fmt: skip


def corner_points(t: Topology, rule: Rule) -> Step:
    """A point in every corner; then they are connected, and the old vertices are gone."""
    V, H = t.n_vertices, t.n_halfedges
    made = stack(identity(V), rule(t) @ Pick(t.origin, V))
    return Step((
        Stage("corner points", made, t, grown(V, H), np.repeat([Role.ORIGINAL, Role.MOVED], [V, H])),
        _connect(t, V),
    ))  # fmt: skip


def regular_polygons(topology: Connectivity) -> Step:
    """Centroids; the affinely regular polygon of every face; a point between both and the corner; connect."""
    t = meshes.as_mesh(topology)
    V, F, H = t.n_vertices, t.n_faces, t.n_halfedges
    roles = np.repeat([Role.ORIGINAL, Role.CENTROID, Role.FACE, Role.MOVED], [V, F, H, H])
    regular = Pick(V + t.face, V + F) + (_lean(t) @ Pick(t.origin, V + F))
    n = V + F + H
    points = 1 / 4 * Pick(t.origin, n) + 1 / 2 * Pick(V + t.face, n) + 1 / 4 * Pick(V + F + np.arange(H), n)
    return Step((
        Stage("centroids", stack(identity(V), face_centroids(t)), t, grown(V, F), roles[: V + F]),
        Stage("regular polygons", stack(identity(V + F), regular), t, grown(V + F, H), roles[:n]),
        Stage("corner points", stack(identity(n), points), t, grown(n, H), roles),
        _connect(t, n),
    ))  # fmt: skip


def midpoints_and_centroids(topology: Connectivity) -> Step:
    """Edge midpoints; centroids; the mean of four in every corner; connect."""
    t = meshes.as_mesh(topology)
    V, E, F, H = t.n_vertices, t.n_edges, t.n_faces, t.n_halfedges
    roles = np.repeat([Role.ORIGINAL, Role.EDGE, Role.CENTROID, Role.MOVED], [V, E, F, H])
    n = V + E + F
    four = [Pick(k, n) for k in (t.origin, V + t.edge, V + t.edge[t.prev], V + E + t.face)]
    points = 1 / 4 * (four[0] + four[1] + four[2] + four[3])
    return Step((
        Stage("edge midpoints", stack(identity(V), edge_midpoints(t)), t, grown(V, E), roles[: V + E]),
        Stage("centroids", stack(identity(V + E), face_centroids(t)), t, grown(V + E, F), roles[:n]),
        Stage("corner points", stack(identity(n), points), t, grown(n, H), roles),
        _connect(t, n),
    ))  # fmt: skip


def _centroid(t: Topology) -> Operator:
    """(n_halfedges, n_halfedges): every corner to the centroid of its face."""
    H = t.n_halfedges
    return Mean(t.face, np.arange(H), (t.n_faces, H))[t.face]


def _lean(t: Topology) -> Operator:
    """(n_halfedges, n_halfedges): from the centroid to the corner of the affinely regular polygon; a vector."""
    return round_faces(t, _wave)


def _wave(n: int, j: int) -> Exact:
    return cosine(n, j) * Fraction(2, n)


def _connect(t: Topology, before: int) -> Stage:
    """The last points alone, in the new topology."""
    made = before + np.arange(t.n_halfedges)
    return Stage("connect", Pick(made, before + len(made)), corners(t), made, np.full(len(made), Role.MOVED))


_refuses = meshes.refusing(meshes.refuses_sharp, meshes.refuses_curves_at_the_boundary)

DOO_SABIN = Scheme(
    name="doo-sabin",
    title="Doo-Sabin",
    paper="DS78",
    refuses=_refuses,
    tellings={
        "topology and geometry": partial(split_and_shrink, rule=cosines),
        "regular polygons": regular_polygons,
        "stencils": partial(corner_points, rule=cosines),
    },
    refinement=CORNERS,
    corners=cosine_weights,
    numbering=BY_CORNERS,
    limit=partial(dual_limit, corners=cosines),
)

DOO_SABIN_MEAN = Scheme(
    name="doo-sabin-mean",
    title="Doo-Sabin by midpoints",
    paper="DS78",
    refuses=_refuses,
    tellings={
        "midpoints and centroids": midpoints_and_centroids,
        "topology and geometry": partial(split_and_shrink, rule=mean_of_four),
        "stencils": partial(corner_points, rule=mean_of_four),
    },
    refinement=CORNERS,
    corners=four_weights,
    numbering=BY_CORNERS,
    limit=partial(dual_limit, corners=mean_of_four),
)

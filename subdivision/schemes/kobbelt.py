"""Kobbelt's interpolating subdivision of quad meshes [Kob96]_: the four-point scheme in both directions.

The point of an edge comes from four in a row; where the row ends at an extraordinary vertex p, a
virtual point takes the place of the fourth.  With the neighbours l of p and the opposite corners k
of its quads, counted from the edge in question, it is::

    4 mean(l) - (l[-1] + l[0] + l[1]) + 2 w/(1 + 2 w) (k[-2] + k[-1] + k[0] + k[1] - 4 mean(k))

which is the neighbour straight on at valence 4.  Then the point of a face comes from four edge
points in a row.  The virtual point is so made that both directions give the same one in the faces
round an isolated extraordinary vertex, as everywhere between regular ones.  In the faces next to
them, and between several extraordinary vertices, we take the mean of both directions.

The outline is the four-point curve of the boundary.  Rows that end there are continued by a
phantom point: ``2 p`` less the mean of the neighbours inside.
"""

from fractions import Fraction
from functools import partial

import numpy as np

from subdivision import meshes, refine
from subdivision.arrays import Indices, taken
from subdivision.averages import edge_midpoints, face_centroids, neighbours
from subdivision.four_points import CUBIC, outline, pushed, reflected
from subdivision.limit_rules import every_vertex_stays
from subdivision.operators import Mean, MeanOf, Operator, Pick, identity, mix, stack, widened
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.stage import Role, Stage, Step, grown
from subdivision.topology import Topology
from subdivision.weights import by_value
from subdivision.words import phrase


def kobbelt(tension: Fraction | float = CUBIC) -> Scheme:
    """The scheme of a ``tension`` as in ``four_point``, a sixteenth of the paper's omega."""
    w = Fraction(tension)
    words = "" if w == CUBIC else f" {w}"
    return Scheme(
        name=f"kobbelt{words}",
        title=phrase("Kobbelt's interpolating quads, tension {w}" if words else "Kobbelt's interpolating quads", w=w),
        paper="Kob96",
        refuses=meshes.refusing(meshes.refuses_non_quads, meshes.refuses_sharp, meshes.refuses_literal_boundaries),
        tellings={
            "midpoints, then push": partial(by_pushing, w=w),
            "stencils": partial(by_stencils, w=w),
        },
        refinement=refine.QUADS,
        rings=2,
        tension=w,
        limit=every_vertex_stays,
    )


def edge_points(t: Topology, w: Fraction) -> Operator:
    """(n_edges, n_vertices): four in a row, virtual points among them."""
    beyond = Mean(t.edge, np.arange(t.n_halfedges), (t.n_edges, t.n_halfedges)) @ _beyond_vertices(t, w)
    inside = pushed(edge_midpoints(t), beyond, w)
    return mix(by_value(t.boundary), outline(t, w), inside) if t.boundary.any() else inside


def face_points(t: Topology, w: Fraction) -> Operator:
    """(n_faces, n_edges): four edge points in a row, the mean of both directions."""
    middle = MeanOf(t.edge.reshape(-1, 4), t.n_edges)
    across = t.edge[t.next[t.next]]
    beyond = reflected(across[t.twin], t.twin >= 0, t.edge, across, t.n_edges)
    return pushed(middle, MeanOf(np.arange(t.n_halfedges).reshape(-1, 4), t.n_halfedges) @ beyond, w)


def virtual_points(t: Topology, w: Fraction) -> Operator:
    """(n_halfedges, n_vertices): before each half-edge, the point before its origin.  Only inside the mesh."""
    V, back, ahead = t.n_vertices, taken(t.next, t.twin), taken(t.twin, t.prev)
    side = taken(t.origin, t.next)
    far = taken(side, t.next)
    corners = Mean(t.origin, far, (V, V))
    three = MeanOf(np.stack([taken(side, back), side, taken(side, ahead)], axis=1), V)
    around = [taken(far, taken(back, back)), taken(far, back), far, taken(far, ahead)]
    four = MeanOf(np.stack(around, axis=1), V)
    lean = 2 * w / (1 + 2 * w)
    return 4 * neighbours(t)[t.origin] + (-3) * three + 4 * lean * four + (-4 * lean) * corners[t.origin]


def by_stencils(topology: Connectivity, w: Fraction) -> Step:
    """Edge points; face points from edge points; then they are connected."""
    t = meshes.as_mesh(topology)
    V, E, F = t.n_vertices, t.n_edges, t.n_faces
    n = V + E + F
    roles = np.repeat([Role.ORIGINAL, Role.EDGE, Role.FACE], [V, E, F])
    order = np.r_[np.arange(V), V + E + np.arange(F), V + np.arange(E)]
    faces = face_points(t, w) @ Pick(np.arange(V, V + E), V + E)
    return Step((
        Stage("edge points", stack(identity(V), edge_points(t, w)), t, grown(V, E), roles[: V + E]),
        Stage("face points", stack(identity(V + E), faces), t, grown(V + E, F), roles),
        Stage("connect", Pick(order, n), refine.quads(t), order, roles[order]),
    ))  # fmt: skip


def by_pushing(topology: Connectivity, w: Fraction) -> Step:
    """Topology: midpoints and centroids.  Geometry: edges are pushed onto the surface, then faces; vertices stay."""
    t = meshes.as_mesh(topology)
    V, E, F = t.n_vertices, t.n_edges, t.n_faces
    n, fine = V + E + F, refine.quads(t)
    kept, edges = Pick(np.arange(V + F), n), Pick(np.arange(V + F, n), n)
    split = stack(identity(V), face_centroids(t), edge_midpoints(t))
    pushed_faces = stack(Pick(np.arange(V), n), face_points(t, w) @ edges, edges)
    return Step((
        Stage("topology", split, fine, grown(V, F + E), _roles(t, Role.FACE, Role.EDGE)),
        _push("push the edges", stack(kept, widened(edge_points(t, w), n)), fine, _roles(t, Role.FACE, Role.MOVED)),
        _push("push the faces", pushed_faces, fine, _roles(t, Role.MOVED, Role.MOVED)),
    ))  # fmt: skip


def _beyond_vertices(t: Topology, w: Fraction) -> Operator:
    """(n_halfedges, n_vertices): the virtual or phantom point before the origin of each half-edge."""
    if not t.boundary.any():
        return virtual_points(t, w)
    inner = ~t.on_boundary[t.origin]
    phantom = 2 * identity(t.n_vertices) + (-1) * neighbours(t, ~t.boundary)
    return mix(by_value(inner), virtual_points(t, w), phantom[t.origin])


def _push(name: str, operator: Operator, fine: Topology, roles: Indices) -> Stage:
    return Stage(name, operator, fine, np.arange(fine.n_vertices), roles)


def _roles(t: Topology, face: Role, edge: Role) -> Indices:
    return np.repeat([Role.ORIGINAL, face, edge], [t.n_vertices, t.n_faces, t.n_edges])


KOBBELT = kobbelt()

"""Modified butterfly subdivision [ZSS96]_: a C1 surface through all vertices of a triangle mesh.

Between two vertices of valence 6 comes the butterfly's point [DLG90]_: 1/2 of each of them, 1/8 of
each of the two wings, -1/16 of each of the four corners beyond.  Beside an extraordinary vertex of
valence n it is 3/4 of that vertex and ``s_j`` of its neighbours, counted round from the other end:
``(1/4 + cos(2 pi j/n) + cos(4 pi j/n)/2)/n``, but 5/12, -1/12, -1/12 at valence 3, and 3/8, 0, -1/8, 0
at valence 4.  Between two of them it is the mean of both.

These weights make waves that run once round the vertex shrink by 1/2, those that run twice by 1/4.

The outline is the four-point curve of the boundary, whatever the inside.  An edge inside is as
usual, boundary vertices counting as regular; where a corner beyond is missing, the parallelogram
of the triangle on this side stands in for it.
"""

from fractions import Fraction

import numpy as np

from subdivision import meshes, refine
from subdivision.arrays import Mask
from subdivision.averages import edge_midpoints, edge_wings
from subdivision.cycles import round_vertices
from subdivision.exact import Exact, cosine
from subdivision.four_points import outline
from subdivision.limit_rules import every_vertex_stays
from subdivision.operators import Mean, MeanOf, Operator, Pick, identity, mix, stack, widened
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.stage import Role, Stage, Step, grown
from subdivision.topology import Topology
from subdivision.weights import by_value
from subdivision.words import phrase

FEW = {3: (Fraction(5, 12), Fraction(-1, 12), Fraction(-1, 12)), 4: (Fraction(3, 8), 0, Fraction(-1, 8), 0)}


def weight(n: int, j: int) -> Exact | int:
    """``s_j`` at valence ``n``: what the neighbour ``j`` further round weighs."""
    if n in FEW:
        return FEW[n][j]
    return (Fraction(1, 4) + cosine(n, j) + Fraction(1, 2) * cosine(n, 2 * j)) * Fraction(1, n)


def edge_points(t: Topology) -> Operator:
    """(n_edges, n_vertices): the point of every edge."""
    special = _special(t)
    halves = np.flatnonzero(special[t.origin])
    inside = butterfly(t)
    if len(halves):
        rows = Mean(t.edge[halves], halves, (t.n_edges, t.n_halfedges)) @ beside_special(t)
        inside = mix(by_value(np.any(special[t.ends], axis=1)), rows, inside)
    return mix(by_value(t.boundary), outline(t), inside) if t.boundary.any() else inside


def butterfly(t: Topology) -> Operator:
    """(n_edges, n_vertices): the butterfly of every edge, wherever its ends have valence 6."""
    h = np.arange(t.n_halfedges)
    beyond = Mean(np.r_[t.edge, t.edge], np.r_[t.next, t.prev], (t.n_edges, len(h))) @ _across(t)
    return edge_midpoints(t) + 1 / 4 * edge_wings(t) + (-1 / 4) * beyond


def beside_special(t: Topology) -> Operator:
    """(n_halfedges, n_vertices): the point of each edge as the extraordinary vertex it leaves wants it; else zero."""
    ring = round_vertices(t, _special(t), weight) @ Pick(t.origin[t.next], t.n_vertices)
    return 3 / 4 * Pick(t.origin, t.n_vertices) + ring


def by_stencils(topology: Connectivity) -> Step:
    """Edge points; then they are connected."""
    t = meshes.as_mesh(topology)
    V, E = t.n_vertices, t.n_edges
    roles = np.repeat([Role.ORIGINAL, Role.EDGE], [V, E])
    return Step((
        Stage("edge points", stack(identity(V), edge_points(t)), t, grown(V, E), roles),
        Stage("connect", identity(V + E), refine.triangles(t), np.arange(V + E), roles),
    ))  # fmt: skip


def by_pushing(topology: Connectivity) -> Step:
    """Topology: a midpoint on every edge.  Geometry: it is pushed onto the surface; the vertices stay."""
    t = meshes.as_mesh(topology)
    V, E, fine = t.n_vertices, t.n_edges, refine.triangles(t)
    push = stack(Pick(np.arange(V), V + E), widened(edge_points(t), V + E))
    return Step((
        Stage(
            "topology", stack(identity(V), edge_midpoints(t)), fine, grown(V, E),
            np.repeat([Role.ORIGINAL, Role.EDGE], [V, E]),
        ),
        Stage("push", push, fine, np.arange(V + E), np.repeat([Role.ORIGINAL, Role.MOVED], [V, E])),
    ))  # fmt: skip


def _across(t: Topology) -> Operator:
    """(n_halfedges, n_vertices): the corner of the triangle beyond each half-edge, mirrored where there is none."""
    V, beyond = t.n_vertices, t.twin >= 0
    there = Pick(t.origin[t.prev[t.twin]], V)
    if beyond.all():
        return there
    mirrored = 2 * MeanOf(np.stack([t.origin, t.origin[t.next]], axis=1), V) + (-1) * Pick(t.origin[t.prev], V)
    return mix(by_value(beyond), there, mirrored)


def _special(t: Topology) -> Mask:
    return t.extraordinary & (t.valence > 0)


def _refuses_pairs(t: Topology) -> str:
    pairs = np.flatnonzero((t.valence == 2) & ~t.on_boundary)
    if pairs.size == 0:
        return ""
    return phrase(
        "vertex {vertex} has two triangles only, glued back to back, and the rule begins with three; remove it",
        vertex=pairs[0],
    )


MODIFIED_BUTTERFLY = Scheme(
    name="modified-butterfly",
    title="Modified butterfly",
    paper="ZSS96",
    refuses=meshes.refusing(
        meshes.refuses_non_triangles, _refuses_pairs, meshes.refuses_sharp, meshes.refuses_literal_boundaries
    ),
    tellings={"midpoints, then push": by_pushing, "stencils": by_stencils},
    refinement=refine.TRIANGLES,
    rings=2,
    beside=weight,
    limit=every_vertex_stays,
)

"""The two ways to tell a mesh scheme: centroid averaging, and stencils.

*Centroid averaging* splits every face without changing the shape, marks the centroid of every
new face (of every face *and corner* for triangles), and moves each vertex towards the centroid
of those around it.  A scheme says how far: ``pull(n)`` of the way at valence ``n``; the
lecture's schemes go all the way.  *Stencils* reach the same points in one go each.

Boundary and crease vertices average the cells of lowest dimension they belong to: edges
instead of faces, or only themselves [WW02]_; this makes them cubic B-spline curves.
"""

from collections.abc import Callable
from fractions import Fraction

import numpy as np

from subdivision import refine
from subdivision.arrays import Indices, Mask
from subdivision.averages import (
    corner_ends,
    edge_faces,
    edge_midpoints,
    edge_wings,
    face_centroids,
    neighbours,
    vertex_corners,
    vertex_faces,
)
from subdivision.exact import Exact
from subdivision.manifold import TopologyError
from subdivision.operators import Operator, Pick, identity, mix, stack, widened
from subdivision.sharpness import CREASE, SMOOTH, VertexRules, blend, edge_share, vertex_rules
from subdivision.stage import Role, Stage, Step, grown
from subdivision.topology import Topology
from subdivision.weights import Weights, by_count

Pull = Callable[[int], Exact | int]
"""Valence -> how much of the way to the centroid of centroids a vertex goes."""


def quad_averaging(t: Topology, pull: Pull) -> Step:
    """Topology (V, F, E points), coloured centroids, geometry."""
    fine = refine.quads(t)
    split = stack(identity(t.n_vertices), face_centroids(t), edge_midpoints(t))
    roles = np.repeat([Role.ORIGINAL, Role.FACE, Role.EDGE], [t.n_vertices, t.n_faces, t.n_edges])
    return _averaging(
        t, fine, split, roles, face_centroids(fine), vertex_faces(fine), by_count(pull, _ordinary(fine, 4))
    )


def triangle_averaging(t: Topology, pull: Pull) -> Step:
    """Topology (V, E points), weighted centroids (one per triangle and corner), geometry."""
    fine = refine.triangles(t)
    split = stack(identity(t.n_vertices), edge_midpoints(t))
    roles = np.repeat([Role.ORIGINAL, Role.EDGE], [t.n_vertices, t.n_edges])
    weighted = 2 / 8 * Pick(fine.origin, fine.n_vertices) + 6 / 8 * corner_ends(fine)
    return _averaging(t, fine, split, roles, weighted, vertex_corners(fine), by_count(pull, _ordinary(fine, 6)))


def quad_stencils(t: Topology, pull: Pull) -> Step:
    """Face points, edge points, vertex points; then they are connected."""
    V, F, E = t.n_vertices, t.n_faces, t.n_edges
    corners, faces = Pick(np.arange(V), V + F), Pick(np.arange(V, V + F), V + F)
    midpoint = edge_midpoints(t) @ corners
    edge_point = mix(edge_share(t), midpoint, 1 / 2 * midpoint + 1 / 2 * (edge_faces(t) @ faces))
    weight = by_count(lambda n: pull(n) * Fraction(1, 4), t.valence)
    ring = weight * (neighbours(t) @ corners) + weight * (vertex_faces(t) @ faces)
    smooth = (1 - 2 * weight) * corners + ring
    vertex_point = blend(
        _lawful(t), smooth, lambda sharp: 3 / 4 * corners + 1 / 4 * (neighbours(t, sharp) @ corners), corners
    )
    roles = np.repeat([Role.MOVED, Role.FACE, Role.EDGE], [V, F, E])
    unmoved = np.repeat([Role.ORIGINAL, Role.FACE, Role.EDGE], [V, F, E])
    return Step((
        Stage("face points", stack(identity(V), face_centroids(t)), t, grown(V, F), unmoved[: V + F]),
        Stage("edge points", stack(identity(V + F), edge_point), t, grown(V + F, E), unmoved),
        _vertex_points(vertex_point, t, V + F + E, roles),
        Stage("connect", identity(V + F + E), refine.quads(t), np.arange(V + F + E), roles),
    ))  # fmt: skip


def triangle_stencils(t: Topology, beta: Callable[[int], Exact | int]) -> Step:
    """Edge points, vertex points; then they are connected.  ``beta(n)`` weighs each neighbour."""
    V, E = t.n_vertices, t.n_edges
    midpoint = edge_midpoints(t)
    edge_point = mix(edge_share(t), midpoint, 3 / 4 * midpoint + 1 / 4 * edge_wings(t))
    smooth = mix(by_count(lambda n: n * beta(n), t.valence), neighbours(t), identity(V))
    vertex_point = blend(
        _lawful(t), smooth, lambda sharp: 3 / 4 * identity(V) + 1 / 4 * neighbours(t, sharp), identity(V)
    )
    roles = np.repeat([Role.MOVED, Role.EDGE], [V, E])
    unmoved = np.repeat([Role.ORIGINAL, Role.EDGE], [V, E])
    return Step((
        Stage("edge points", stack(identity(V), edge_point), t, grown(V, E), unmoved),
        _vertex_points(vertex_point, t, V + E, roles),
        Stage("connect", identity(V + E), refine.triangles(t), np.arange(V + E), roles),
    ))  # fmt: skip


def _averaging(
    t: Topology, fine: Topology, split: Operator, roles: Indices, centroids: Operator, around: Operator, pull: Weights
) -> Step:
    X, C = fine.n_vertices, centroids.shape[0]
    still, helpers = Pick(np.arange(X), X + C), Pick(np.arange(X, X + C), X + C)
    smooth = mix(pull, around @ helpers, still)
    moved = blend(
        _refined_rules(t, fine),
        smooth,
        lambda sharp: 1 / 2 * still + 1 / 2 * widened(neighbours(fine, sharp), X + C),
        still,
    )
    return Step((
        Stage("topology", split, fine, grown(t.n_vertices, X - t.n_vertices), roles),
        Stage("centroids", stack(identity(X), centroids), fine, grown(X, C), np.r_[roles, np.full(C, Role.CENTROID)]),
        Stage("geometry", moved, fine, np.arange(X), np.full(X, Role.MOVED)),
    ))  # fmt: skip


def _refined_rules(t: Topology, fine: Topology) -> VertexRules:
    """The rules of the control mesh, carried to the refined one: an edge point follows its edge."""
    coarse = vertex_rules(t)
    extra = fine.n_vertices - t.n_vertices
    new = np.zeros(extra, dtype=np.intp)
    new[extra - t.n_edges :] = np.where(t.edge_sharpness > 0, CREASE, SMOOTH)
    share = np.ones(extra)
    share[new == CREASE] = np.minimum(t.edge_sharpness, 1)[t.edge_sharpness > 0]
    inner = np.zeros(fine.n_edges - 2 * t.n_edges, dtype=bool)
    return VertexRules(
        now=np.r_[coarse.now, new],
        then=np.r_[coarse.then, np.where(share < 1, SMOOTH, new)],
        stays=np.r_[coarse.stays, share],
        sharp_now=_on_halves(coarse.sharp_now, inner),
        sharp_then=_on_halves(coarse.sharp_then, inner),
    )


def _on_halves(sharp: Mask, inner: Mask) -> Mask:
    return np.concatenate([np.repeat(sharp, 2), inner])


def _lawful(t: Topology) -> VertexRules:
    """The rules, if every boundary edge has one: stencils are only told where the neighbourhood is whole."""
    if (t.edge_sharpness[t.boundary] == 0).any():
        raise TopologyError(
            "the literal boundary rule is told by centroid averaging only; choose that telling or another boundary"
        )
    return vertex_rules(t)


def _ordinary(t: Topology, regular: int) -> Indices:
    """Valences, a boundary vertex counting as ``regular``: the literal rule knows no other pull there (ours)."""
    return np.where(t.on_boundary, regular, t.valence)


def _vertex_points(operator: Operator, t: Topology, n: int, roles: Indices) -> Stage:
    """Move the first points; those behind them stay."""
    V = operator.shape[0]
    rest = Pick(np.arange(V, n), n)
    return Stage("vertex points", stack(widened(operator, n), rest), t, np.arange(n), roles)

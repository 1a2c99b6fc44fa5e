"""Kobbelt's sqrt(3) subdivision [Kob00]_ of triangle meshes: three new triangles for each, turned.

Insert the centroid of every triangle; move every old vertex ``a(n) = (4 - 2 cos(2 pi/n))/9`` of the
way to the mean of its neighbours; flip every old edge.  Two steps cut every edge in three, where
two splits in four would cut it in four.  C2, but C1 at the limits of extraordinary vertices.

Seen after the flip the neighbours of an old vertex are the centroids, and the same vertex goes
``3 a/2`` of the way to their mean: halfway at valence 6.  The limit is ``(p + 3 a mean)/(1 + 3 a)``.

The paper cuts boundary edges in three, but in every second step only, and so the step depends on
what came before; a mesh with a boundary is refused.
"""

from fractions import Fraction
from functools import partial

import numpy as np

from subdivision import meshes
from subdivision.arrays import Indices, Mask
from subdivision.averages import face_centroids, neighbours
from subdivision.exact import Exact, cosine, quotient
from subdivision.limit_rules import vertices_to
from subdivision.operators import Operator, Pick, identity, mix, stack, widened
from subdivision.refine_sqrt3 import THIRDS, flipped, inserted
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.stage import Role, Stage, Step, grown
from subdivision.topology import Topology
from subdivision.weights import by_count


def pull(n: int) -> Exact:
    """How far a vertex of valence ``n`` goes to the mean of its neighbours."""
    return (4 - 2 * cosine(n)) * Fraction(1, 9)


def reach(n: int) -> Exact:
    """How far it goes, the same way, to the mean of the middles round it."""
    return pull(n) * Fraction(3, 2)


def smooth_and_flip(topology: Connectivity) -> Step:
    """Insert centroids; smooth the old vertices; flip the old edges."""
    t = meshes.as_mesh(topology)
    V, F = t.n_vertices, t.n_faces
    smooth = mix(by_count(pull, t.valence), neighbours(t), identity(V))
    return Step((
        _insert(t),
        _smooth(smooth, inserted(t), F),
        Stage("flip the edges", identity(V + F), flipped(t), np.arange(V + F), _roles(V, F, Role.MOVED)),
    ))  # fmt: skip


def flip_and_smooth(topology: Connectivity) -> Step:
    """Topology: insert centroids, flip the old edges.  Geometry: every old vertex goes to the mean of its centroids."""
    t = meshes.as_mesh(topology)
    V, F = t.n_vertices, t.n_faces
    fine = flipped(t)
    smooth = mix(by_count(reach, t.valence), neighbours(fine, _spokes(t))[:V], Pick(np.arange(V), V + F))
    return Step((
        _insert(t),
        Stage("flip the edges", identity(V + F), fine, np.arange(V + F), _roles(V, F, Role.ORIGINAL)),
        _smooth(smooth, fine, F),
    ))  # fmt: skip


def _insert(t: Topology) -> Stage:
    V, F = t.n_vertices, t.n_faces
    points = stack(identity(V), face_centroids(t))
    return Stage("insert centroids", points, inserted(t), grown(V, F), _roles(V, F, Role.ORIGINAL))


def _smooth(smooth: Operator, topology: Topology, F: int) -> Stage:
    """Move the old vertices; the ``F`` centroids stay."""
    V = smooth.shape[0]
    points = stack(widened(smooth, V + F), Pick(np.arange(V, V + F), V + F))
    return Stage("smooth the vertices", points, topology, np.arange(V + F), _roles(V, F, Role.MOVED))


def _spokes(t: Topology) -> Mask:
    """(n_edges after the flip,) bool: edges from an old vertex to a centroid."""
    return np.arange(t.n_edges + t.n_halfedges) >= t.n_edges


def _roles(V: int, F: int, old: Role) -> Indices:
    return np.repeat([old, Role.FACE], [V, F])


def _limit(topology: Connectivity) -> Stage:
    t = meshes.as_mesh(topology)
    away = by_count(lambda n: quotient(3 * pull(n), 1 + 3 * pull(n)), t.valence)
    return vertices_to(t, mix(away, neighbours(t), identity(t.n_vertices)))


OPEN = (
    "it ends at the edge between vertices {a} and {b}, and boundary edges are cut in every "
    "second step only; close the mesh, or use Loop"
)


SQRT3 = Scheme(
    name="sqrt3",
    title="Kobbelt's √3",
    paper="Kob00",
    refuses=meshes.refusing(meshes.refuses_non_triangles, partial(meshes.refuses_open, why=OPEN), meshes.refuses_sharp),
    tellings={"insert, smooth, flip": smooth_and_flip, "insert, flip, smooth": flip_and_smooth},
    refinement=THIRDS,
    middles=reach,
    limit=_limit,
)

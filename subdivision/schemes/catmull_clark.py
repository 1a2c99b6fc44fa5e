"""Catmull-Clark subdivision [CC78]_: centroid averaging that goes 4/n of the way.

In stencils: face and edge as for bicubic B-splines; vertex 1 - 7/(4 n), 3/(2 n^2), 1/(4 n^2).
Any polygon may be a control face; after one step all faces are quads.
"""

from fractions import Fraction
from functools import partial

from subdivision import meshes, refine
from subdivision.centroids import quad_averaging, quad_stencils
from subdivision.limit_rules import quad_limit
from subdivision.limit_tangents import quad_tangents
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.stage import Step


def pull(n: int) -> Fraction:
    """How far a vertex of valence ``n`` goes to the centroid of the centroids."""
    return Fraction(4, n)


def by_averaging(t: Connectivity) -> Step:
    """Only quads: next to other polygons the edge points of [CC78]_ are not averages of centroids."""
    return quad_averaging(meshes.only_quads(t, "Catmull-Clark"), pull)


CATMULL_CLARK = Scheme(
    name="catmull-clark",
    title="Catmull-Clark",
    paper="CC78",
    refuses=meshes.refuses_non_meshes,
    tellings={
        "stencils": partial(quad_stencils, pull=pull),
        "centroid averaging": by_averaging,
    },
    refinement=refine.QUADS,
    reach=lambda n: Fraction(2, n),
    limit=partial(quad_limit, pull=pull),
    tangents=partial(quad_tangents, pull=pull),
)

"""Centroid averaging of triangle meshes: the lecture's scheme [WW02]_.

Split every triangle in four, mark a centroid 2/8, 3/8, 3/8 for every triangle *and corner*,
move every vertex to the centroid of its own.  In stencils: edge 3/8, 3/8, 1/8, 1/8; vertex
5/8 and 3/(8 n).  C2 except at the limits of extraordinary vertices: C1 there, but at valence
3 only C0.
"""

from fractions import Fraction
from functools import partial

from subdivision import meshes, refine
from subdivision.centroids import triangle_averaging, triangle_stencils
from subdivision.limit_rules import triangle_limit
from subdivision.limit_tangents import triangle_tangents
from subdivision.scheme import Scheme


def pull(n: int) -> int:
    """All the way to the centroid of the weighted centroids, whatever the valence ``n``."""
    return 1


def beta(n: int) -> Fraction:
    """The weight of each of the ``n`` neighbours."""
    return Fraction(3, 8 * n)


TRIANGLE_CENTROID = Scheme(
    name="triangle-centroid",
    title="Centroid averaging of triangles",
    paper="WW02",
    refuses=meshes.refuses_non_triangles,
    tellings={
        "centroid averaging": partial(triangle_averaging, pull=pull),
        "stencils": partial(triangle_stencils, beta=beta),
    },
    refinement=refine.TRIANGLES,
    reach=lambda n: n * beta(n),
    limit=partial(triangle_limit, beta=beta),
    tangents=partial(triangle_tangents, beta=beta),
)

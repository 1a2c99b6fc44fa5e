"""Centroid averaging of quad meshes: the lecture's scheme, the same as its simple stencil.

Split every face, mark the centroid of every new quad, move every vertex to the centroid of
the centroids around it [WW02]_.  In stencils: face 1/4; edge 6/16, 1/16; vertex 9/16,
6/(16 n), 1/(16 n).  C2 except at the limits of extraordinary vertices, where it is C1.
"""

from fractions import Fraction
from functools import partial

from subdivision import meshes, refine
from subdivision.centroids import quad_averaging, quad_stencils
from subdivision.limit_rules import quad_limit
from subdivision.limit_tangents import quad_tangents
from subdivision.scheme import Scheme


def pull(n: int) -> int:
    """All the way to the centroid of the centroids, whatever the valence ``n``."""
    return 1


QUAD_CENTROID = Scheme(
    name="quad-centroid",
    title="Centroid averaging of quads",
    paper="WW02",
    refuses=meshes.refuses_non_quads,
    tellings={
        "centroid averaging": partial(quad_averaging, pull=pull),
        "stencils": partial(quad_stencils, pull=pull),
    },
    refinement=refine.QUADS,
    reach=lambda n: Fraction(1, 2),
    limit=partial(quad_limit, pull=pull),
    tangents=partial(quad_tangents, pull=pull),
)

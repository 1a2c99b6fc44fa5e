"""Centroid averaging of quads that goes part of the way at extraordinary vertices.

``pull`` of the way to the centroid of the centroids, all the way at the regular valence 4.  1 is the
lecture's scheme [WW02]_; at valence n a pull of 4/n is Catmull-Clark's [CC78]_.
"""

from fractions import Fraction
from functools import partial

from subdivision import meshes, refine
from subdivision.centroids import quad_averaging, quad_stencils
from subdivision.limit_rules import quad_limit
from subdivision.limit_tangents import quad_tangents
from subdivision.scheme import Scheme
from subdivision.words import phrase

REGULAR = 4


def quad_pull(pull: Fraction = Fraction(1)) -> Scheme:
    """The scheme that goes ``pull`` of the way."""
    way = partial(_way, pull)
    return Scheme(
        name="quad-pull",
        title=phrase("Quads, {pull} of the way", pull=pull),
        paper="WW02",
        refuses=meshes.refuses_non_quads,
        tellings={
            "centroid averaging": partial(quad_averaging, pull=way),
            "stencils": partial(quad_stencils, pull=way),
        },
        refinement=refine.QUADS,
        reach=lambda n: way(n) * Fraction(1, 2),
        limit=partial(quad_limit, pull=way),
        tangents=partial(quad_tangents, pull=way),
    )


def _way(pull: Fraction, n: int) -> Fraction:
    return Fraction(1) if n == REGULAR else Fraction(pull)

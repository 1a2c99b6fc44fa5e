"""Centroid averaging of triangles that goes part of the way at extraordinary vertices.

``pull`` of the way to the centroid of the weighted centroids, so each of n neighbours weighs
``beta = pull * 3/(8 n)``; all the way at the regular valence 6.  1 is the lecture's scheme [WW02]_,
and each of Loop's and Warren's betas is the pull that ``extraordinary.special_pulls`` tells.
"""

from fractions import Fraction
from functools import partial

from subdivision import meshes, refine
from subdivision.centroids import triangle_averaging, triangle_stencils
from subdivision.limit_rules import triangle_limit
from subdivision.limit_tangents import triangle_tangents
from subdivision.scheme import Scheme
from subdivision.words import phrase

REGULAR = 6


def triangle_pull(pull: Fraction = Fraction(1)) -> Scheme:
    """The scheme that goes ``pull`` of the way."""
    way, beta = partial(_way, pull), partial(_beta, pull)
    return Scheme(
        name="triangle-pull",
        title=phrase("Triangles, {pull} of the way", pull=pull),
        paper="WW02",
        refuses=meshes.refuses_non_triangles,
        tellings={
            "centroid averaging": partial(triangle_averaging, pull=way),
            "stencils": partial(triangle_stencils, beta=beta),
        },
        refinement=refine.TRIANGLES,
        reach=lambda n: n * beta(n),
        limit=partial(triangle_limit, beta=beta),
        tangents=partial(triangle_tangents, beta=beta),
    )


def _way(pull: Fraction, n: int) -> Fraction:
    return Fraction(1) if n == REGULAR else Fraction(pull)


def _beta(pull: Fraction, n: int) -> Fraction:
    return _way(pull, n) * Fraction(3, 8 * n)

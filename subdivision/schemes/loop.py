"""Loop subdivision of triangle meshes [Loop87]_, and the same with Warren's beta [War95]_.

Edge 3/8, 3/8, 1/8, 1/8; vertex ``1 - n beta(n)`` and ``beta(n)`` for each of its n neighbours.
Told as centroid averaging it goes ``8 n beta/3`` of the way to the centroid of the weighted
centroids, which is all the way at the regular valence 6.
"""

from fractions import Fraction
from functools import partial

from subdivision import meshes, refine
from subdivision.centroids import triangle_averaging, triangle_stencils
from subdivision.exact import Exact, cosine
from subdivision.limit_rules import triangle_limit
from subdivision.limit_tangents import triangle_tangents
from subdivision.scheme import Scheme


def loop_beta(n: int) -> Exact:
    """Loop's own choice [Loop87]_: ``(5/8 - (3/8 + cos(2 pi/n)/4)^2)/n``; bounded curvature in the cup mode."""
    return (Fraction(5, 8) - (Fraction(3, 8) + cosine(n) * Fraction(1, 4)) ** 2) * Fraction(1, n)


def warren_beta(n: int) -> Exact:
    """Warren's simpler choice [War95]_: 3/16 at valence 3, else 3/(8 n)."""
    return Fraction(3, 16) if n == 3 else Fraction(3, 8 * n)


def loop_pull(n: int) -> Exact:
    """How far ``loop_beta`` goes to the centroid of the weighted centroids; 1 at valence 6."""
    return loop_beta(n) * Fraction(8 * n, 3)


def warren_pull(n: int) -> Exact:
    """How far ``warren_beta`` goes: all the way, but 3/2 of it at valence 3."""
    return warren_beta(n) * Fraction(8 * n, 3)


LOOP = Scheme(
    name="loop",
    title="Loop",
    paper="Loop87",
    refuses=meshes.refuses_non_triangles,
    tellings={
        "stencils": partial(triangle_stencils, beta=loop_beta),
        "centroid averaging": partial(triangle_averaging, pull=loop_pull),
    },
    refinement=refine.TRIANGLES,
    reach=lambda n: n * loop_beta(n),
    limit=partial(triangle_limit, beta=loop_beta),
    tangents=partial(triangle_tangents, beta=loop_beta),
)

LOOP_WARREN = Scheme(
    name="loop-warren",
    title="Loop with Warren's beta",
    paper="War95",
    refuses=meshes.refuses_non_triangles,
    tellings={
        "stencils": partial(triangle_stencils, beta=warren_beta),
        "centroid averaging": partial(triangle_averaging, pull=warren_pull),
    },
    refinement=refine.TRIANGLES,
    reach=lambda n: n * warren_beta(n),
    limit=partial(triangle_limit, beta=warren_beta),
    tangents=partial(triangle_tangents, beta=warren_beta),
)

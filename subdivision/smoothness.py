"""How far a vertex may be pulled: what makes primal schemes C1 at valence n, in closed form.

The vertex rule acts on waves that run 0 times round the vertex only; rings shrink by ``lambda``
whatever it is.  With the pull ``p`` (how much of the way to the centroid of the centroids) bowls
shrink by ``5/8 - 3 p/8`` on triangles, and on quads by the roots of
``64 x^2 - (48 - 28 p) x + 4 - 3 p``, which are always real.  Solved for ``p`` these are our limits.
"""

from dataclasses import dataclass
from fractions import Fraction
from math import cos, pi, sqrt

from subdivision.exact import Exact, Formula, cosine, quotient


@dataclass(frozen=True)
class Between:
    """The numbers between ``least`` and ``most``, which are not among them."""

    least: Exact
    most: Exact

    def __contains__(self, number: Exact | int) -> bool:
        return float(self.least) < float(number) < float(self.most)


def quad_lambda(n: int) -> Exact:
    """``(5 + c + cos(pi/n) sqrt(2 (9 + c)))/16`` with ``c = cos(2 pi/n)``: what a ring shrinks by [Stam98]_."""
    if n in (2, 4):
        return Fraction(n, 8)
    c = cos(2 * pi / n)
    text = f"(5 + c + cos(π/{n})·sqrt(18 + 2c))/16, c = cos(2π/{n})"
    return Formula(text, (5 + c + cos(pi / n) * sqrt(2 * (9 + c))) / 16)


def triangle_lambda(n: int) -> Exact:
    """``3/8 + cos(2 pi/n)/4``: what a ring shrinks by [Loop87]_."""
    return Fraction(3, 8) + cosine(n) * Fraction(1, 4)


def quad_pulls(n: int) -> Between:
    """The pulls that are C1 at valence ``n``: at either end a bowl would shrink by plus or minus lambda."""
    ring = quad_lambda(n)
    return Between(quad_pull_for(ring), quotient(4 * (16 * ring**2 + 12 * ring + 1), 28 * ring + 3))


def triangle_pulls(n: int) -> Between:
    """The pulls that are C1 at valence ``n``: (2 - 2 c)/3 to (8 + 2 c)/3, so beta > (1 - c)/(4 n)."""
    ring = triangle_lambda(n)
    return Between(triangle_pull_for(ring), triangle_pull_for(-ring))


def quad_pull_for(shrink: Exact) -> Exact:
    """The pull with which a bowl on quads shrinks by ``shrink``."""
    return quotient(4 * (12 * shrink - 16 * shrink**2 - 1), 28 * shrink - 3)


def triangle_pull_for(shrink: Exact) -> Exact:
    """The pull with which a bowl on triangles shrinks by ``shrink``."""
    return (Fraction(5, 8) - shrink) * Fraction(8, 3)


def are_quads_smooth(n: int, pull: Exact | int) -> bool:
    """Whether a quad scheme is C1 at valence ``n``."""
    return n >= 3 and pull in quad_pulls(n)


def are_triangles_smooth(n: int, beta: Exact | int) -> bool:
    """Whether a triangle scheme is C1 at valence ``n``: 5/8 - n beta must be smaller than 3/8 + cos(2 pi/n)/4."""
    return n >= 3 and abs(float(Fraction(5, 8) - n * beta)) < float(triangle_lambda(n))

"""What becomes of a surface at a vertex of valence n: eigenvalues, conditions in words, and how far one may pull.

Bowls are what runs 0 times round the vertex, saddles what runs twice [PR98]_.  A C1 surface has a
bounded curvature there, not zero, where both shrink by lambda squared; what shrinks slower is pinched,
what shrinks faster leaves a flat spot.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from types import MappingProxyType

from subdivision.characteristic import CharacteristicMap, characteristic_map
from subdivision.exact import Exact
from subdivision.manifold import TopologyError
from subdivision.scheme import Scheme
from subdivision.schemes import CATMULL_CLARK, LOOP, LOOP_WARREN, QUAD_CENTROID, TRIANGLE_CENTROID
from subdivision.smoothness import (
    Between,
    quad_lambda,
    quad_pull_for,
    quad_pulls,
    triangle_lambda,
    triangle_pull_for,
    triangle_pulls,
)
from subdivision.spectrum import Ring, ring
from subdivision.words import phrase

EQUAL = 1e-12
"""Eigenvalues so close are the same."""


@dataclass(frozen=True)
class Eigenvalue:
    """``value``, of what runs ``mode`` times round the vertex; ``times`` is 2 if it runs either way round."""

    value: float
    mode: int
    times: int


@dataclass(frozen=True)
class Condition:
    """Something asked of eigenvalues: whether it holds, what becomes of the surface in a word, and why."""

    name: str
    holds: bool
    word: str
    why: str


@dataclass(frozen=True, eq=False)
class Analysis:
    """``ring`` is the local subdivision matrix, ``chart`` the characteristic map."""

    ring: Ring
    chart: CharacteristicMap

    @property
    def subdominant(self) -> float:
        """Lambda: what a ring shrinks by."""
        return self.ring.subdominant

    @cached_property
    def eigenvalues(self) -> tuple[Eigenvalue, ...]:
        """All of them, mode by mode, the largest of each first."""
        n = self.ring.valence
        return tuple(
            Eigenvalue(float(value), mode, 1 if mode in (0, n / 2) else 2)
            for mode in range(n // 2 + 1)
            for value in self.ring.eigenvalues(mode)
        )

    @cached_property
    def rival(self) -> Eigenvalue:
        """The largest eigenvalue but 1 and the lambda pair; C1 needs it to be smaller."""
        others = [e for e in self.eigenvalues if abs(e.value - 1) > EQUAL or e.mode]
        first = next(e for e in others if e.mode == 1)
        return max((e for e in others if e is not first), key=lambda e: abs(e.value))

    @cached_property
    def conditions(self) -> tuple[Condition, Condition, Condition]:
        """A tangent plane, then the bounded curvature of bowls and of saddles."""
        smooth = self._tangent_plane()
        saddles = Condition(phrase("Saddles"), smooth.holds, phrase("none"), "no wave runs twice round three faces")
        if self.ring.valence > 3:
            saddles = self._curvature(phrase("Saddles"), self.ring.saddle, smooth.holds)
        return smooth, self._curvature(phrase("Bowls"), self.ring.cup, smooth.holds), saddles

    @property
    def is_smooth(self) -> bool:
        """Whether the surface is C1 at the vertex."""
        return self.conditions[0].holds

    def _tangent_plane(self) -> Condition:
        rival, ring = abs(self.rival.value), self.subdominant
        if not rival < ring - EQUAL:
            return Condition(
                "C¹",
                False,
                phrase("a tip"),
                phrase(
                    "mode {mode} shrinks by {rival:.4f}, the ring by {ring:.4f}",
                    mode=self.rival.mode,
                    rival=rival,
                    ring=ring,
                ),
            )
        if not self.chart.is_one_to_one:
            return Condition("C¹", False, phrase("a fold"), "the characteristic map is not one to one")
        return Condition(
            "C¹",
            True,
            "a tangent plane",
            phrase("λ is double, all else shrinks faster: {rival:.4f} or less", rival=rival),
        )

    def _curvature(self, name: str, value: float, is_smooth: bool) -> Condition:
        square = self.subdominant**2
        told = f"{value:.4f}, λ² = {square:.4f}"
        if not is_smooth:
            return Condition(name, False, "no curvature", "there is no tangent plane")
        if abs(abs(value) - square) <= EQUAL:
            return Condition(
                name, True, phrase("bounded"), phrase("{told}: the curvature is bounded and not zero", told=told)
            )
        if abs(value) > square:
            return Condition(
                name, False, phrase("pinched"), phrase("{told}: the curvature grows without bound", told=told)
            )
        return Condition(name, True, "flat spot", phrase("{told}: the curvature dies out", told=told))


@dataclass(frozen=True)
class Special:
    """A pull with a name."""

    name: str
    pull: Exact


@dataclass(frozen=True)
class PullRule:
    """A family with a pull: of the ``published`` schemes that differ from it in nothing but how far they pull."""

    family: str
    regular: int
    published: Mapping[str, Scheme]

    @property
    def all_the_way(self) -> Scheme:
        """The lecture's own: pull 1 at every valence."""
        return next(iter(self.published.values()))

    def smooth(self, n: int) -> Between:
        """The pulls that are C1 at valence ``n``."""
        return quad_pulls(n) if self.regular == 4 else triangle_pulls(n)

    def bounded(self, n: int) -> Exact:
        """The pull that gives bowls a bounded curvature, not zero: they shrink by lambda squared."""
        if self.regular == 4:
            return quad_pull_for(quad_lambda(n) ** 2)
        return triangle_pull_for(triangle_lambda(n) ** 2)

    def pull_of(self, scheme: Scheme, n: int) -> Exact:
        """How far one of the published schemes pulls at valence ``n``.

        Raises
        ------
        TopologyError
            If it is another kind of scheme.
        """
        whole = self.all_the_way.reach
        if scheme not in self.published.values() or scheme.reach is None or whole is None:
            raise TopologyError(phrase("{scheme} is not told by how far it pulls", scheme=scheme.title))
        return scheme.reach(n) * (1 / Fraction(float(whole(n))))

    def specials(self, n: int) -> tuple[Special, ...]:
        """The published pulls, and the one that bounds the curvature of bowls if none of them does."""
        found = [Special(name, self.pull_of(scheme, n)) for name, scheme in self.published.items()]
        bound = self.bounded(n)
        if all(abs(float(each.pull) - float(bound)) > EQUAL for each in found):
            found.append(Special(phrase("bounded"), bound))
        return tuple(found)


TRIANGLE_PULLS = PullRule(
    "triangle-pull", 6, MappingProxyType({"simple": TRIANGLE_CENTROID, "Warren": LOOP_WARREN, "Loop": LOOP})
)
QUAD_PULLS = PullRule("quad-pull", 4, MappingProxyType({"simple": QUAD_CENTROID, "Catmull-Clark": CATMULL_CLARK}))
PULL_RULES: Mapping[str, PullRule] = MappingProxyType({rule.family: rule for rule in (TRIANGLE_PULLS, QUAD_PULLS)})
"""By the name of the family."""


def pull_rule(scheme: Scheme) -> PullRule | None:
    """The family that goes on from a scheme by varying its pull; its own, if it is one of a family."""
    for rule in PULL_RULES.values():
        if scheme.name == rule.family or scheme in rule.published.values():
            return rule
    return None


def analysis(scheme: Scheme, valence: int) -> Analysis:
    """What becomes of the surface at a vertex.

    Raises
    ------
    TopologyError
        As ``spectrum.ring``.
    """
    found = ring(scheme, valence)
    rule = pull_rule(scheme)
    return Analysis(found, _chart(rule.family, valence) if rule else characteristic_map(scheme, valence))


@lru_cache(maxsize=64)
def _chart(family: str, valence: int) -> CharacteristicMap:
    """One for all pulls: the rule of the vertex has no part in it."""
    return characteristic_map(PULL_RULES[family].all_the_way, valence)

"""Every scheme by a name that can be written down, with its parameters: what menus offer and sessions keep."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import ceil, floor
from types import MappingProxyType
from typing import TypeAlias

from subdivision import schemes
from subdivision.manifold import TopologyError
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.words import phrase

Vectors: TypeAlias = tuple[tuple[int, int], ...]

Value: TypeAlias = int | Fraction | Vectors
"""A whole number such as a degree, a fraction such as a weight, or the vectors of a box spline."""


@dataclass(frozen=True)
class Parameter:
    """A number of a family: ``least`` to ``most`` in steps of ``step``; or, with ``vectors``, a vector set."""

    name: str
    start: Value
    least: Fraction = Fraction(1)
    most: Fraction = Fraction(1)
    step: Fraction = Fraction(1)
    is_vectors: bool = False

    def next(self, value: Value, by: int) -> Value:
        """``by`` whole steps on, from between two the first is to the nearest; held within the limits.

        Vectors have no next.
        """
        if not isinstance(value, int | Fraction):
            return value
        steps = Fraction(value - self.least) / self.step
        there = min(max(self.least + ((floor if by > 0 else ceil)(steps) + by) * self.step, self.least), self.most)
        return int(there) if isinstance(self.start, int) else Fraction(there)


@dataclass(frozen=True)
class Family:
    """A scheme for each choice of its parameters."""

    name: str
    title: str
    make: Callable[..., Scheme]
    parameters: tuple[Parameter, ...] = ()

    @property
    def start(self) -> tuple[Value, ...]:
        return tuple(p.start for p in self.parameters)


def _degree(name: str, start: int) -> Parameter:
    return Parameter(name, start, Fraction(1), Fraction(7))


def _four_point(tension: Fraction) -> Scheme:
    """From end to end, as an open polygon of any length is shown best."""
    return schemes.four_point(tension, schemes.Ends.REFLECTED)


_TENSION = Parameter("tension", Fraction(1, 16), Fraction(0), Fraction(1, 8), Fraction(1, 64))

_PULL = Parameter("pull", Fraction(1), Fraction(0), Fraction(2), Fraction(1, 16))


FAMILIES: Mapping[str, Family] = MappingProxyType({
    family.name: family
    for family in (
        *(Family(each.name, each.title, lambda each=each: each) for each in schemes.SCHEMES),
        Family("triangle-pull", "Triangles, any pull", schemes.triangle_pull, (_PULL,)),
        Family("quad-pull", "Quads, any pull", schemes.quad_pull, (_PULL,)),
        Family("lane-riesenfeld", "Lane-Riesenfeld", schemes.lane_riesenfeld, (_degree("degree", 3),)),
        Family("chaikin", schemes.CHAIKIN.title, lambda: schemes.CHAIKIN),
        Family("four-point", "Four-point scheme", _four_point, (_TENSION,)),
        Family(
            "tensor-product", "Tensor product", schemes.tensor_product,
            (_degree("degree in s", 3), _degree("degree in t", 3)),
        ),
        Family(
            "box-spline", "Box spline", schemes.box_spline,
            (Parameter("vectors", schemes.THREE_DIRECTION_QUARTIC, is_vectors=True),),
        ),
    )
})  # fmt: skip
"""By name, in menu order."""


@lru_cache(maxsize=256)
def scheme(name: str, parameters: tuple[Value, ...] = ()) -> Scheme:
    """The scheme of a family; without ``parameters`` at its usual ones.

    Raises
    ------
    TopologyError
        For a name that is not there, or parameters the family refuses.
    """
    if name not in FAMILIES:
        raise TopologyError(
            phrase("there is no scheme '{name}'; there are {names}", name=name, names=", ".join(FAMILIES))
        )
    family = FAMILIES[name]
    if parameters and len(parameters) != len(family.parameters):
        raise TopologyError(
            phrase(
                "{scheme} takes {n} parameters, not {given}",
                scheme=family.title,
                n=len(family.parameters),
                given=len(parameters),
            )
        )
    return family.make(*(parameters or family.start))


def suiting(topology: Connectivity) -> tuple[Family, ...]:
    """The families that accept a control object, at their usual parameters, in menu order."""
    return tuple(family for family in FAMILIES.values() if scheme(family.name).accepts(topology))

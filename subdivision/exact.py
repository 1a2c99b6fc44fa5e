"""Exact weights: fractions, and fractions times cosines where a scheme has them.

Every weight in this program is a number of the form ``a + b cos(2 pi/n) + ...`` with
rational ``a, b``.  Floating point is computed *from* it and never turned back.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import cos, pi
from typing import TypeAlias

Monomial: TypeAlias = tuple[int, ...]
"""The valences whose cosines are multiplied: ``(5, 5)`` is ``cos(2 pi/5) ** 2``."""

RATIONAL_COSINES = {1: Fraction(1), 2: Fraction(-1), 3: Fraction(-1, 2), 4: Fraction(0), 6: Fraction(1, 2)}


@dataclass(frozen=True)
class Cosines:
    """A polynomial with rational coefficients in the numbers ``cos(2 pi/n)``."""

    terms: tuple[tuple[Monomial, Fraction], ...]

    def __add__(self, other: "Exact | int") -> "Exact":
        total = dict(self.terms)
        for monomial, coefficient in _terms(other):
            total[monomial] = total.get(monomial, Fraction(0)) + coefficient
        return _exact(total)

    def __mul__(self, other: "Exact | int") -> "Exact":
        total: dict[Monomial, Fraction] = {}
        for m, a in self.terms:
            for n, b in _terms(other):
                both = tuple(sorted(m + n))
                total[both] = total.get(both, Fraction(0)) + a * b
        return _exact(total)

    def __truediv__(self, other: Fraction | int) -> "Exact":
        return self * (1 / Fraction(other))

    def __pow__(self, exponent: int) -> "Exact":
        power: Exact = Fraction(1)
        for _ in range(exponent):
            power = power * self
        return power

    def __neg__(self) -> "Exact":
        return self * -1

    def __sub__(self, other: "Exact | int") -> "Exact":
        return self + -1 * other

    def __rsub__(self, other: "Exact | int") -> "Exact":
        return -self + other

    __radd__ = __add__
    __rmul__ = __mul__

    @cached_property
    def value(self) -> float:
        total = 0.0
        for monomial, coefficient in self.terms:
            product = float(coefficient)
            for n in monomial:
                product *= cos(2 * pi / n)
            total += product
        return total

    def __float__(self) -> float:
        return self.value

    def __str__(self) -> str:
        words = [f"{c}{_spelled(m)}" for m, c in self.terms]
        return " + ".join(words).replace("+ -", "- ")


Exact: TypeAlias = Fraction | Cosines
Row: TypeAlias = dict[int, Exact]
"""A row of a matrix: column -> exact weight, zeros left out."""


def cosine(n: int) -> Exact:
    """``cos(2 pi/n)``, a fraction where it is one."""
    return RATIONAL_COSINES[n] if n in RATIONAL_COSINES else Cosines((((n,), Fraction(1)),))


def spelled(weight: Exact) -> str:
    """The weight as it stands beside a point: ``3/8``, or a decimal where a fraction would not be read."""
    if isinstance(weight, Fraction) and weight.denominator < 100_000:
        return str(weight)
    return f"{float(weight):.6f}"


def add_rows(parts: "Mapping[int, Exact]", onto: Row, factor: "Exact | int" = 1) -> None:
    """Add ``factor`` times a row to another, in place."""
    for column, weight in parts.items():
        onto[column] = onto.get(column, Fraction(0)) + factor * weight


def _terms(number: "Exact | int") -> tuple[tuple[Monomial, Fraction], ...]:
    return number.terms if isinstance(number, Cosines) else (((), Fraction(number)),)


def _exact(terms: Mapping[Monomial, Fraction]) -> Exact:
    kept = tuple(sorted((m, c) for m, c in terms.items() if c))
    if all(not m for m, _ in kept):
        return sum((c for _, c in kept), Fraction(0))
    return Cosines(kept)


def _spelled(monomial: Monomial) -> str:
    powers = {n: monomial.count(n) for n in monomial}
    return "".join(f" cos(2π/{n})" + (f"^{p}" if p > 1 else "") for n, p in powers.items())

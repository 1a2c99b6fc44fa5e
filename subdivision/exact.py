"""Exact weights: fractions, and fractions times cosines where a scheme has them.

Every weight of a step is a number of the form ``a + b cos(2 pi/n) + ...`` with rational
``a, b``.  Limits also divide and take roots; what is then no such number is kept as the
formula it was computed from.  Floating point is computed *from* all these and never turned back.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import cos, lcm, pi
from typing import TypeAlias

Monomial: TypeAlias = tuple[int | Fraction, ...]
"""The valences whose cosines are multiplied: ``(5, 5)`` is ``cos(2 pi/5) ** 2``; ``(5/2,)`` is ``cos(4 pi/5)``."""

RATIONAL_COSINES = {1: Fraction(1), 2: Fraction(-1), 3: Fraction(-1, 2), 4: Fraction(0), 6: Fraction(1, 2)}


class Number:
    """What follows from ``+`` and ``*``."""

    def __add__(self, other: "Exact | int") -> "Exact":
        raise NotImplementedError

    def __mul__(self, other: "Exact | int") -> "Exact":
        raise NotImplementedError

    def __radd__(self, other: "Exact | int") -> "Exact":
        return self + other

    def __rmul__(self, other: "Exact | int") -> "Exact":
        return self * other

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


@dataclass(frozen=True)
class Cosines(Number):
    """A polynomial with rational coefficients in the numbers ``cos(2 pi/n)``."""

    terms: tuple[tuple[Monomial, Fraction], ...]

    def __add__(self, other: "Exact | int") -> "Exact":
        if isinstance(other, Formula):
            return other + self
        total = dict(self.terms)
        for monomial, coefficient in _terms(other):
            total[monomial] = total.get(monomial, Fraction(0)) + coefficient
        return _exact(total)

    def __mul__(self, other: "Exact | int") -> "Exact":
        if isinstance(other, Formula):
            return other * self
        total: dict[Monomial, Fraction] = {}
        for m, a in self.terms:
            for n, b in _terms(other):
                both = tuple(sorted(m + n))
                total[both] = total.get(both, Fraction(0)) + a * b
        return _exact(total)

    @cached_property
    def value(self) -> float:
        """The number, in floating point."""
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


@dataclass(frozen=True)
class Formula(Number):
    """``factor`` times a number that is neither fraction nor cosines: how it is written, and what it comes to."""

    text: str
    once: float
    factor: Fraction = Fraction(1)

    def __add__(self, other: "Exact | int") -> "Exact":
        if not isinstance(other, Number) and other == 0:
            return self
        if isinstance(other, Formula) and other.text == self.text:
            return self * 0 if self.factor == -other.factor else replace(self, factor=self.factor + other.factor)
        return Formula(f"{self} + {other}", float(self) + float(other))

    def __mul__(self, other: "Exact | int") -> "Exact":
        if isinstance(other, Number):
            return Formula(f"({self})·({other})", float(self) * float(other))
        return replace(self, factor=self.factor * other) if other else Fraction(0)

    def __float__(self) -> float:
        return float(self.factor) * self.once

    def __str__(self) -> str:
        return self.text if self.factor == 1 else f"{self.factor}·({self.text})"


Exact: TypeAlias = Fraction | Cosines | Formula
Row: TypeAlias = dict[int, Exact]
"""A row of a matrix: column -> exact weight, zeros left out."""


def cosine(n: int, times: int = 1) -> Exact:
    """``cos(2 pi times/n)``, a fraction where it is one."""
    turn = Fraction(times, n) % 1
    turn = min(turn, 1 - turn)
    if turn == 0:
        return Fraction(1)
    around = 1 / turn
    if around in RATIONAL_COSINES:
        return RATIONAL_COSINES[int(around)]
    return Cosines((((int(around) if around.denominator == 1 else around,), Fraction(1)),))


def sine(n: int, times: int = 1) -> Exact:
    """``sin(2 pi times/n)``."""
    return cosine(4 * n, 4 * times - n)


def quotient(a: "Exact | int", b: "Exact | int") -> Exact:
    """``a / b``: a fraction where both are, else the formula."""
    if isinstance(b, Number):
        return Formula(f"({a})/({b})", float(a) / float(b))
    return a * (1 / Fraction(b))


def spelled(weight: Exact) -> str:
    """The weight as it stands beside a point: ``3/8``, or a decimal where a fraction would not be read."""
    if isinstance(weight, Fraction) and weight.denominator < 100_000:
        return str(weight)
    return f"{float(weight):.6f}"


def spelled_together(weights: "Sequence[Exact]") -> list[str]:
    """Weights over one denominator, as stencils are drawn (36/64, 6/64, 1/64); singly where that is too long."""
    fractions = [w for w in weights if isinstance(w, Fraction)]
    below = lcm(*(w.denominator for w in fractions))
    if len(fractions) < len(weights) or below > 1024 or below == 1:
        return [spelled(w) for w in weights]
    return [f"{w * below}/{below}" for w in fractions]


def add_rows(parts: "Mapping[int, Exact]", onto: Row, factor: "Exact | int" = 1) -> None:
    """Add ``factor`` times a row to another, in place."""
    is_once = factor == 1
    for column, weight in parts.items():
        share = weight if is_once else factor * weight
        onto[column] = onto[column] + share if column in onto else share


def _terms(number: Fraction | Cosines | int) -> tuple[tuple[Monomial, Fraction], ...]:
    return number.terms if isinstance(number, Cosines) else (((), Fraction(number)),)


def _exact(terms: Mapping[Monomial, Fraction]) -> Exact:
    kept = tuple(sorted((m, c) for m, c in terms.items() if c))
    if all(not m for m, _ in kept):
        return sum((c for _, c in kept), Fraction(0))
    return Cosines(kept)


def _spelled(monomial: Monomial) -> str:
    powers = {n: monomial.count(n) for n in monomial}
    return "".join(f" {_cosine_spelled(n)}" + (f"^{p}" if p > 1 else "") for n, p in powers.items())


def _cosine_spelled(n: int | Fraction) -> str:
    return f"cos({2 * n.denominator}π/{n.numerator})"

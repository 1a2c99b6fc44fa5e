"""Sentences that remember how they were made, so that they can be said in another language."""

from collections.abc import Iterable
from numbers import Integral
from typing import Any


class Phrase(str):
    """A sentence with something filled in; a plain string to all who do not ask for its parts.

    Attributes
    ----------
    template : str
        The sentence with named gaps, as it is looked up in a dictionary: ``"level {level} of {levels}"``.
    values : str -> object
        What stands in the gaps.  Words among them are said in the other language too.
    many : str
        The template for other numbers than one, where it depends on the ``number``; else empty.
    """

    template: str
    values: dict[str, Any]
    many: str
    number: int

    def __new__(cls, template: str, values: dict[str, Any], many: str = "", number: int = 1) -> "Phrase":
        self = super().__new__(cls, filled(many if many and number != 1 else template, values))
        self.template, self.values, self.many, self.number = template, values, many, number
        return self

    def __str__(self) -> str:
        return self

    def __getnewargs__(self) -> tuple[str, dict[str, Any], str, int]:  # type: ignore[override]
        return self.template, self.values, self.many, self.number


def phrase(template: str, **values: Any) -> Phrase:
    """The sentence with its gaps filled; gaps without a value stay for whoever fills them later (colours, in captions).

    A text in a gap that is to begin a sentence and end it is said so: ``{reason:sentence}``.

    >>> phrase("level {level} of {levels}", level=2, levels=5)
    'level 2 of 5'
    >>> phrase("{reason:sentence}", reason="the mesh has no faces")
    'The mesh has no faces.'
    """
    return Phrase(template, values)


def plural(one: str, many: str, number: int, **values: Any) -> Phrase:
    """The phrase for that number of things.

    >>> plural("{n} edge", "{n} edges", 1, n=1), plural("{n} edge", "{n} edges", 3, n=3)
    ('1 edge', '3 edges')
    """
    return Phrase(one, values, many, number)


def joined(separator: str, parts: Iterable[str]) -> Phrase:
    """Several texts in a row, each of them said in the other language by itself.

    >>> joined("   ", ["degree 3", "level 2"])
    'degree 3   level 2'
    """
    values = {f"part{k}": part for k, part in enumerate(parts)}
    return Phrase(separator.join("{" + name + "}" for name in values), values)


def filled(template: str, values: dict[str, Any]) -> str:
    """``template`` with its named gaps filled as far as there are values."""
    return template.format_map(_Gaps(values))


class _Gaps(dict[str, Any]):
    def __getitem__(self, name: str) -> Any:
        value = super().__getitem__(name)
        if isinstance(value, Integral) and not isinstance(value, bool):
            return _Number(value)
        return _Text(value) if isinstance(value, str) else value

    def __missing__(self, name: str) -> str:
        return "{" + name + "}"


class _Number(int):
    """A whole number in a gap, whose thousands can stand apart: ``{faces:space}``, as most languages write them."""

    def __format__(self, how: str) -> str:
        return f"{int(self):,}".replace(",", "\u202f") if how == "space" else format(int(self), how)


class _Text(str):
    """Words in a gap, which can stand there as a whole sentence."""

    def __format__(self, how: str) -> str:
        if how != "sentence" or not self:
            return super().__format__("" if how == "sentence" else how)
        return f"{self[0].upper()}{self[1:]}{'' if self.endswith(('.', '?', '!')) else '.'}"

"""Sentences that remember how they were made, so that they can be said in another language."""

from typing import Any


class Phrase(str):
    """A sentence with something filled in; a plain string to all who do not ask for its parts.

    Attributes
    ----------
    template : str
        The sentence with named gaps, as it is looked up in a dictionary: ``"level {level} of {levels}"``.
    values : str -> object
        What stands in the gaps.  Words among them are said in the other language too.
    """

    template: str
    values: dict[str, Any]

    def __new__(cls, template: str, values: dict[str, Any]) -> "Phrase":
        self = super().__new__(cls, filled(template, values))
        self.template, self.values = template, values
        return self

    def __str__(self) -> str:
        return self

    def __getnewargs__(self) -> tuple[str, dict[str, Any]]:  # type: ignore[override]
        return self.template, self.values


def phrase(template: str, **values: Any) -> Phrase:
    """The sentence with its gaps filled; gaps without a value stay for whoever fills them later (colours, in captions).

    >>> phrase("level {level} of {levels}", level=2, levels=5)
    'level 2 of 5'
    """
    return Phrase(template, values)


def filled(template: str, values: dict[str, Any]) -> str:
    """``template`` with its named gaps filled as far as there are values."""
    return template.format_map(_Gaps(values))


class _Gaps(dict[str, Any]):
    def __missing__(self, name: str) -> str:
        return "{" + name + "}"

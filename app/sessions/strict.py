"""JSON from anywhere, read so that nothing is believed: every value is asked for with its kind and its limits."""

import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any

from subdivision.words import phrase

LONGEST_NUMBER = 40
"""Characters of a number; Python itself writes no float with more than 25."""

SHOWN = 40
"""Characters of a wrong value that a sentence repeats."""


class KeepingError(ValueError):
    """Why a session or a link was not kept or restored: what, where, and the mend, in one sentence."""


@dataclass(frozen=True)
class Entry:
    """A value of a document and the way to it, such as ``laboratory.rules[0].family``."""

    value: Any
    where: str = ""

    def fault(self, what: str) -> KeepingError:
        """What is wrong here, and how to mend it."""
        return KeepingError(phrase("{where}: {what}", where=self.where, what=what) if self.where else what)

    def table(self, names: Collection[str], may: Collection[str] = ()) -> Mapping[str, "Entry"]:
        """The values of a table by name: all of ``names``, some of those it ``may`` have, and no others."""
        if not isinstance(self.value, dict):
            raise self._not(phrase("a table with {names}", names=_listed(names)))
        for name in self.value:
            if name not in names and name not in may:
                known = _listed([*names, *may]) or "nothing"
                raise self.fault(
                    phrase(
                        "'{name}' is not known here; take it out (there can be {known})", name=_shown(name), known=known
                    )
                )
        for name in names:
            if name not in self.value:
                raise self.fault(phrase("'{name}' is missing; put it in", name=name))
        dot = "." if self.where else ""
        return {name: Entry(value, f"{self.where}{dot}{name}") for name, value in self.value.items()}

    def rows(self, least: int = 0, most: int = 1_000_000) -> list["Entry"]:
        """The values of a list of ``least`` to ``most``."""
        if not isinstance(self.value, list) or not least <= len(self.value) <= most:
            number = str(least) if least == most else phrase("{least} to {most:,}", least=least, most=most)
            raise self._not(phrase("a list of {number} values", number=number))
        return [Entry(value, f"{self.where}[{k}]") for k, value in enumerate(self.value)]

    def whole(self, least: int, most: int) -> int:
        """A whole number within limits."""
        if type(self.value) is not int or not least <= self.value <= most:
            raise self._not(phrase("a whole number from {least} to {most}", least=least, most=most))
        return self.value

    def number(self, least: float, most: float) -> float:
        """A number within limits."""
        if type(self.value) not in (int, float) or not (isfinite(self.value) and least <= self.value <= most):
            raise self._not(phrase("a number from {least:g} to {most:g}", least=least, most=most))
        return float(self.value)

    def flag(self) -> bool:
        """Yes or no."""
        if type(self.value) is not bool:
            raise self._not("true or false")
        return self.value

    def words(self, most: int = 300) -> str:
        """A text of ``most`` characters at most."""
        if not isinstance(self.value, str) or len(self.value) > most:
            raise self._not(phrase("a text of at most {most} characters", most=most))
        return self.value

    def one_of(self, names: Collection[str]) -> str:
        """One of some names."""
        if not isinstance(self.value, str) or self.value not in names:
            raise self._not(phrase("one of {names}", names=", ".join(names)))
        return self.value

    def _not(self, wanted: str) -> KeepingError:
        return self.fault(phrase("{value} is not {wanted}; write that", value=_shown(self.value), wanted=wanted))


def parsed(text: str | bytes) -> Entry:
    """A JSON document as its one entry.

    Raises
    ------
    KeepingError
        With the line of what is not JSON.
    """
    try:
        told = text.decode("utf-8-sig") if isinstance(text, bytes) else text
        return Entry(json.loads(told, parse_int=_whole, parse_constant=_refused, object_pairs_hook=_table))
    except json.JSONDecodeError as fault:
        place = phrase("line {line}, column {column}", line=fault.lineno, column=fault.colno)
        raise KeepingError(
            phrase(
                "{place}: this is not JSON ({reason}); mend the line or save it again", place=place, reason=fault.msg
            )
        ) from None
    except UnicodeDecodeError as fault:
        raise KeepingError(phrase("byte {byte}: this is not text in UTF-8; save it again", byte=fault.start)) from None
    except RecursionError:
        raise KeepingError("the lists stand too deep in one another; save it again") from None


def _whole(digits: str) -> int:
    if len(digits) > LONGEST_NUMBER:
        raise KeepingError(phrase("the number {number} is too long; write a smaller one", number=_shown(digits)))
    return int(digits)


def _refused(name: str) -> None:
    raise KeepingError(phrase("{name} is not a number that can be drawn; write a finite one", name=name))


def _table(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise KeepingError(phrase("'{name}' stands twice in one table; take one out", name=_shown(twice)))
    return found


def _listed(names: Collection[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)


def _shown(value: Any) -> str:
    """A wrong value as a sentence repeats it: on one line, shortened, and no larger than it need be."""
    if isinstance(value, list | dict):
        return phrase("a list of {n}" if isinstance(value, list) else "a table of {n}", n=len(value))
    text = value if isinstance(value, str) else json.dumps(value)
    plain = "".join(c if c.isprintable() else "?" for c in text[:SHOWN])
    return f"{plain}..." if len(text) > SHOWN else plain or "nothing"

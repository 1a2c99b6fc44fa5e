"""Whether a refusal is the sentence it should be."""

import re

_PLACE = re.compile(r", (line|byte) \d+: ")
_OF_ALL = re.compile(r"the file is empty|it has .* but no faces|it has neither vertices nor faces")
"""Faults of the whole file, which are at no line."""


def is_sentence(said: str, name: str) -> bool:
    """Whether it names the file, the line (or byte), what is wrong and the mend, on one line of no great length."""
    has_place = _PLACE.match(said.removeprefix(name)) or _OF_ALL.search(said)
    return said.startswith(name) and bool(has_place) and "; " in said and said.isprintable() and len(said) < 400

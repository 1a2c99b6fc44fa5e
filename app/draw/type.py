"""Words and mathematics as outlines: the shipped Inter for words, mathtext for what stands between dollars.

Every painter measures with this, so that a picture breaks its lines at the same places everywhere.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

import numpy as np
from matplotlib.path import Path as Outline

from app.draw.formulas import formula
from app.draw.letters import Glyph, advance, shape, together
from app.draw.primitives import ANCHOR, Area, Text
from subdivision.arrays import Floats, Indices

FAMILY = "Inter"

ASCENT, DESCENT = 0.93, 0.25
"""Room for a line of plain words, relative to its size."""

DOUBT = 0.02
"""By how much words and the spaces between them may come nearer to each other than each by itself, at each space."""

Extent: TypeAlias = tuple[float, float, float]
"""Width, ascent above the baseline, descent below it."""


@dataclass(frozen=True)
class Run:
    """A stretch of words or of mathematics, ``x`` from the start of its line, for type of size 1."""

    text: str
    x: float
    is_math: bool


def measure(text: str, size: float, bold: bool = False) -> Extent:
    """The room ``text`` takes at ``size``."""
    width, ascent, descent, _ = _set(text, bold)
    return float(width * size), float(ascent * size), float(descent * size)


def extent(text: Text) -> Area:
    """The room some type takes."""
    width, ascent, descent = measure(text.text, text.size, text.bold)
    left = text.x - ANCHOR[text.align] * width
    return left, text.y - ascent, width, ascent + descent


def outline(text: str, size: float, bold: bool = False) -> tuple[Floats, Indices]:
    """Vertices (n, 2), y upwards from the baseline, and matplotlib path codes."""
    vertices, codes = _outlined(text, bold)
    return vertices * size, codes


def runs(text: str, bold: bool = False) -> tuple[Run, ...]:
    """The stretches of ``text`` and where each starts."""
    return _set(text, bold)[3]


@lru_cache(maxsize=512)
def wrapped(text: str, size: float, width: float, bold: bool = False) -> tuple[str, ...]:
    """Lines no wider than ``width``, of even lengths; a formula is never broken."""
    if not text.strip():
        return ()
    words = _words(text)
    full = _broken(words, size, width, bold)
    if len(full) == 1:
        return full
    low, high = width / 2, width
    for _ in range(8):  # the narrowest measure that needs no more lines: no short last line
        middle = (low + high) / 2
        low, high = (low, middle) if len(_broken(words, size, middle, bold)) == len(full) else (middle, high)
    return _broken(words, size, high, bold)


def _broken(words: list[str], size: float, width: float, bold: bool) -> tuple[str, ...]:
    lines, about = [words[0]], _about(words[0], bold)
    for word in words[1:]:
        longer, guess = f"{lines[-1]} {word}", about + _about(f" {word}", bold)
        doubt = DOUBT * size * (1 + longer.count(" "))
        is_clear = abs(guess * size - width) > doubt
        if (guess * size if is_clear else measure(longer, size, bold)[0]) <= width:
            lines[-1], about = longer, guess
        else:
            lines.append(word)
            about = _about(word, bold)
    return tuple(line.strip() for line in lines)


@lru_cache(maxsize=4096)
def _about(text: str, bold: bool) -> float:
    """The width of type of size 1, so far as it does not depend on what stands beside it."""
    return measure(f"|{text}", 1.0, bold)[0] - measure("|", 1.0, bold)[0]


def _words(text: str) -> list[str]:
    """Split at spaces, but not at those inside a formula."""
    found: list[str] = []
    inside = False
    for piece in text.strip().split(" "):  # of two spaces one stays with the word
        if inside:
            found[-1] += f" {piece}"
        else:
            found.append(piece)
        inside ^= piece.count("$") % 2 == 1
    return found


def _pieces(text: str) -> list[tuple[str, bool]]:
    """Words and formulas in turn; a dollar without a partner is a word."""
    parts = text.split("$")
    if len(parts) % 2 == 0:
        return [(text, False)]
    return [(part, k % 2 == 1) for k, part in enumerate(parts) if part]


@lru_cache(maxsize=16384)
def _set(text: str, bold: bool) -> tuple[float, float, float, tuple[Run, ...]]:
    """Width, ascent, descent and stretches of a line of type of size 1."""
    at, ascent, descent = 0.0, ASCENT, DESCENT
    found: list[Run] = []
    for piece, is_math in _pieces(text):
        found.append(Run(piece, at, is_math))
        width, up, down = formula(piece)[:3] if is_math else (advance(piece, bold), ASCENT, DESCENT)
        at, ascent, descent = at + width, max(ascent, up), max(descent, down)
    return at, ascent, descent, tuple(found)


@lru_cache(maxsize=2048)
def _outlined(text: str, bold: bool) -> Glyph:
    """The outline of a line of type of size 1."""
    found: list[Glyph] = []
    for run in _set(text, bold)[3]:
        vertices, codes = formula(run.text)[3:] if run.is_math else shape(run.text, bold)
        found.append((vertices + np.array([run.x, 0.0]), codes))
    return together(found)


def path(text: str, size: float, bold: bool = False) -> Outline:
    """The outline as one matplotlib path."""
    return Outline(*outline(text, size, bold))

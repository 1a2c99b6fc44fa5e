"""Where the letters of plain words stand, in Inter: asked of the shaper once for each two in a row, then remembered.

Shaping is slow, and a page of words has few pairs of letters.  How far a letter is from the next depends on these two
alone; the shape of a sign, such as a bracket or a colon, also on its neighbours.
"""

import re
from collections import OrderedDict
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from operator import add
from typing import TypeAlias

import numpy as np
from matplotlib.font_manager import fontManager, get_font
from matplotlib.textpath import TextToPath

from app import ASSETS
from subdivision.arrays import Floats, Indices

FONTS = ASSETS / "fonts"
REGULAR, BOLD = FONTS / "Inter-Regular.otf", FONTS / "Inter-SemiBold.otf"
FEATURES = ("tnum",)
"""Figures of one width: numbers that change while a stage plays do not jitter."""

END = "|"
"""Stands behind the words, to tell where they end."""

WESTERN = re.compile(r"[\u0020-\u02ff\u0370-\u058f\u2010-\u2bff]*")
"""Words in which a character is a letter, one after the other from the left; others are always shaped as a whole."""

SIGN = re.compile(r"[^\w ,.;|]*[(\[{][^)\]}|]*[)\]}]+|(?:[^\w ,.;|]|_)+|\d ?x|x ?\d")
"""What looks different beside capitals, figures and other signs; what is in brackets as a whole."""

REACH = 2
"""How many letters away from a sign its neighbours count."""

Glyph: TypeAlias = tuple[Floats, Indices]
"""Its outline."""

Letter: TypeAlias = tuple[float, float, Glyph]
"""How far the next one is, how far it is above the baseline, its glyph: in units of the shaper."""

Key: TypeAlias = str | tuple[str, str]
"""A letter and the next; beside a sign the letters up to it, and those after it."""

_known: tuple[dict[Key, Letter], dict[Key, Letter]] = {}, {}
_glyphs: tuple[OrderedDict[str, Glyph], OrderedDict[str, Glyph]] = OrderedDict(), OrderedDict()
"""Of the regular typeface and of the bold one."""


def advance(text: str, bold: bool) -> float:
    """The width of a line of type of size 1."""
    return sum(step for step, _, _ in letters(text, bold)) / TextToPath.FONT_SCALE


def shape(text: str, bold: bool) -> Glyph:
    """The outline of a line of type of size 1: vertices (n, 2), y upwards from the baseline, and matplotlib's codes."""
    vertices: list[Floats] = [np.zeros((0, 2))]
    codes: list[Indices] = [np.zeros(0, dtype=np.uint8)]
    at = 0.0
    for step, above, (v, c) in letters(text, bold):
        vertices.append(v + np.array([at, above]))
        codes.append(c)
        at += step
    return np.vstack(vertices) / TextToPath.FONT_SCALE, np.concatenate(codes)


def letters(text: str, bold: bool) -> list[Letter]:
    """The letters of a line."""
    known, line = _known[bold], f"{text}{END}"
    keys = _keys(line)
    if not known.keys() >= set(keys) and not (WESTERN.fullmatch(text) and _learn(line, keys, bold)):
        return list(_shaped(line, bold))
    return [known[key] for key in keys]


def _learn(line: str, keys: list[Key], bold: bool) -> bool:
    """Ask the shaper for the letters that are not known; whether it told one for each character."""
    known = _known[bold]
    for places in _together([k for k, key in enumerate(keys) if key not in known], keys):
        start = max(places[0] - _left(keys[places[0]]), 0)
        stretch = line[start : places[-1] + _right(keys[places[-1]]) + 1]
        learnt = list(_shaped(stretch, bold))
        if len(learnt) + 1 != len(stretch):
            return False
        known.update((keys[k], learnt[k - start]) for k in places)
    return True


def _keys(line: str) -> list[Key]:
    """What tells each letter of a line, but the last, apart."""
    found: list[Key] = list(map(add, line, line[1:]))
    for sign in SIGN.finditer(line):
        first, last = max(sign.start() - REACH, 0), min(sign.end() + REACH, len(found))
        for k in range(first, last):
            found[k] = line[first : k + 1], line[k + 1 : last + 1]
    return found


def _left(key: Key) -> int:
    """How many letters before its own the shaper is to see."""
    return 0 if isinstance(key, str) else 2 * REACH


def _right(key: Key) -> int:
    """How many letters after its own the shaper is to see."""
    return 1 if isinstance(key, str) else len(key[1]) + REACH


def _together(places: list[int], keys: list[Key]) -> list[list[int]]:
    """The places of letters that are shaped together, for the shaper is to see the same ones beside them."""
    found: list[list[int]] = []
    for k in places:
        if found and k - _left(keys[k]) <= found[-1][-1] + _right(keys[found[-1][-1]]):
            found[-1].append(k)
        else:
            found.append([k])
    return found


def _shaped(line: str, bold: bool) -> Iterator[Letter]:
    """The letters of a line but the last, as the shaper sets them."""
    font, glyphs = get_font(_files(bold)), _glyphs[bold]
    font.set_size(TextToPath.FONT_SCALE, TextToPath.DPI)
    placed, _, _ = TextToPath().get_glyphs_with_font(font, line, glyphs, features=FEATURES)
    for (name, x, y, _), (_, next_x, _, _) in pairwise(placed):
        yield next_x - x, y, glyphs[name]


@cache
def _files(bold: bool) -> tuple[str, ...]:
    """Inter, and a typeface that has the characters Inter lacks."""
    return str(BOLD if bold else REGULAR), fontManager.findfont("DejaVu Sans")

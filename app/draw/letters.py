"""Where the letters of plain words stand, in Inter: asked of the shaper once for each two in a row, then remembered.

Shaping is slow, and a page of words has few pairs of letters.  How far a letter is from the next depends on these two
alone; the shape of a sign, such as a bracket or a colon, also on its neighbours.  What the lessons need is asked
beforehand, in a table that ``make type`` makes; it serves the version of matplotlib by which it was made.
"""

import re
from collections import OrderedDict
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import pairwise
from operator import add
from pathlib import Path
from typing import TypeAlias

import matplotlib
import numpy as np
from matplotlib.font_manager import fontManager, get_font
from matplotlib.ft2font import GlyphIndexType, LoadFlags
from matplotlib.textpath import TextToPath

from app import ASSETS
from subdivision.arrays import Floats, Indices

FONTS = ASSETS / "fonts"
REGULAR, BOLD = FONTS / "Inter-Regular.otf", FONTS / "Inter-SemiBold.otf"
TABLE = ASSETS / "letters.tsv"
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

Letter: TypeAlias = tuple[float, float, str]
"""How far the next one is and how far it is above the baseline, in units of the shaper; the name of its glyph."""

BETWEEN = "\x1f"
"""Stands in a key between the letters up to one and those after it."""

Known: TypeAlias = dict[str, Letter]
"""The letters that have been asked for, by themselves and the next; beside a sign, by all that are near."""

_glyphs: OrderedDict[str, Glyph] = OrderedDict()


def beforehand(table: Path) -> list[list[str]]:
    """The rows of a table of what was set beforehand; none where matplotlib is of another version."""
    head, *rows = table.read_text(encoding="utf-8").split("\n") if table.exists() else [""]
    is_alike = head == f"matplotlib {matplotlib.__version__}"
    return [row.split("\t") for row in rows if row] if is_alike else []


def together(glyphs: Iterable[Glyph]) -> Glyph:
    """One outline of several."""
    none: Glyph = np.zeros((0, 2)), np.zeros(0, dtype=np.uint8)
    vertices, codes = zip(none, *glyphs, strict=True)
    return np.vstack(vertices), np.concatenate(codes)


def outlined(file: str, number: GlyphIndexType) -> Glyph:
    """The outline of a glyph of a typeface, of the size at which everything is set."""
    font = get_font(file)
    font.clear()
    font.set_size(TextToPath.FONT_SCALE, TextToPath.DPI)
    font.load_glyph(number, flags=LoadFlags.NO_HINTING)
    return font.get_path()


def advance(text: str, bold: bool) -> float:
    """The width of a line of type of size 1."""
    return sum(step for step, _, _ in letters(text, bold)) / TextToPath.FONT_SCALE


def shape(text: str, bold: bool) -> Glyph:
    """The outline of a line of type of size 1: vertices (n, 2), y upwards from the baseline, and matplotlib's codes."""
    found: list[Glyph] = []
    at = 0.0
    for step, above, name in letters(text, bold):
        vertices, codes = _glyph(name)
        found.append((vertices + np.array([at, above]), codes))
        at += step
    vertices, codes = together(found)
    return vertices / TextToPath.FONT_SCALE, codes


def letters(text: str, bold: bool) -> list[Letter]:
    """The letters of a line."""
    known, line = asked()[bold], f"{text}{END}"
    keys = _keys(line)
    if not known.keys() >= set(keys) and not (WESTERN.fullmatch(text) and _learn(line, keys, bold)):
        return list(_shaped(line, bold))
    return [known[key] for key in keys]


@cache
def asked() -> tuple[Known, Known]:
    """What is known of the regular typeface and of the bold one: what was asked beforehand, and since."""
    found: tuple[Known, Known] = {}, {}
    for bold, key, step, above, name in beforehand(TABLE):
        found[bold == "bold"][key] = float(step), float(above), name
    return found


def _learn(line: str, keys: list[str], bold: bool) -> bool:
    """Ask the shaper for the letters that are not known; whether it told one for each character."""
    known = asked()[bold]
    for places in _together([k for k, key in enumerate(keys) if key not in known], keys):
        start = max(places[0] - _left(keys[places[0]]), 0)
        stretch = line[start : places[-1] + _right(keys[places[-1]]) + 1]
        learnt = list(_shaped(stretch, bold))
        if len(learnt) + 1 != len(stretch):
            return False
        known.update((keys[k], learnt[k - start]) for k in places)
    return True


def _keys(line: str) -> list[str]:
    """What tells each letter of a line, but the last, apart."""
    found = list(map(add, line, line[1:]))
    for sign in SIGN.finditer(line):
        first, last = max(sign.start() - REACH, 0), min(sign.end() + REACH, len(found))
        for k in range(first, last):
            found[k] = f"{line[first : k + 1]}{BETWEEN}{line[k + 1 : last + 1]}"
    return found


def _left(key: str) -> int:
    """How many letters before its own the shaper is to see."""
    return 2 * REACH if BETWEEN in key else 0


def _right(key: str) -> int:
    """How many letters after its own the shaper is to see."""
    return len(key.partition(BETWEEN)[2]) + REACH if BETWEEN in key else 1


def _together(places: list[int], keys: list[str]) -> list[list[int]]:
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
    font = get_font(_files(bold))
    font.set_size(TextToPath.FONT_SCALE, TextToPath.DPI)
    placed, _, _ = TextToPath().get_glyphs_with_font(font, line, _glyphs, features=FEATURES)
    for (name, x, y, _), (_, next_x, _, _) in pairwise(placed):
        yield next_x - x, y, name


def _glyph(name: str) -> Glyph:
    """The outline of a glyph, which the shaper names by its typeface and number."""
    if name not in _glyphs:
        typeface, _, number = name.rpartition("-")
        files = {REGULAR.stem: str(REGULAR), BOLD.stem: str(BOLD)}
        _glyphs[name] = outlined(files.get(typeface, _files(False)[1]), GlyphIndexType(int(number, 16)))
    return _glyphs[name]


@cache
def _files(bold: bool) -> tuple[str, ...]:
    """Inter, and a typeface that has the characters Inter lacks."""
    return str(BOLD if bold else REGULAR), fontManager.findfont("DejaVu Sans")

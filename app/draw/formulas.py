"""Mathematics as outlines: what stands between dollars, set by mathtext.

Setting a formula takes as long as painting a window.  What the lessons show is set beforehand, in a table that
``make type`` makes; it serves the version of mathtext by which it was made.
"""

import json
from functools import cache, lru_cache
from pathlib import Path
from threading import Lock
from typing import TypeAlias

import matplotlib
import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.ft2font import GlyphIndexType
from matplotlib.textpath import TextToPath

from app import ASSETS
from app.draw.letters import Glyph, beforehand, outlined, together
from subdivision.arrays import Floats, Indices

TABLE = ASSETS / "formulas.tsv"

MATHEMATICS, MATHEMATICS_SIZE = "stix", 1.12
"""Its letters are lower than Inter's: set larger, both look alike."""

UNIT = TextToPath.FONT_SCALE
"""The size at which everything is set."""

BAR: Indices = np.array([1, 2, 2, 2, 2, 79], dtype=np.uint8)
"""Round four corners, in matplotlib's codes."""

Outlined: TypeAlias = tuple[float, float, float, Floats, Indices]
"""Width, ascent, descent, vertices and codes."""

Box: TypeAlias = tuple[
    float, float, float, list[tuple[str, float, GlyphIndexType, float, float]], list[tuple[float, float, float, float]]
]
"""Width, height, descent; of each glyph typeface, size, number and place; of each bar place, width and height."""

_one_at_a_time = Lock()
"""The parser of mathtext is one for all threads, and remembers where it is."""


@lru_cache(maxsize=2048)
def formula(text: str) -> Outlined:
    """A formula in type of size 1."""
    box: Box = json.loads(prepared()[text]) if text in prepared() else boxed(text)
    width, height, descent, glyphs, bars = box
    found: list[Glyph] = []
    for typeface, size, number, x, y in glyphs:
        v, c = _glyph(typeface, number)
        found.append((v * (size / UNIT) + np.array([x, y]), c))
    for x, y, wide, tall in bars:
        corners = (x, y), (x, y + tall), (x + wide, y + tall), (x + wide, y), (x, y), (0, 0)
        found.append((np.array(corners), BAR))
    vertices, codes = together(found)
    scale = UNIT / MATHEMATICS_SIZE
    return width / scale, (height - descent) / scale, descent / scale, vertices / scale, codes


@cache
def prepared() -> dict[str, str]:
    """The boxes that were set beforehand, as JSON; none where mathtext is of another version."""
    return dict(beforehand(TABLE))


def boxed(text: str) -> Box:
    """A formula as mathtext sets it."""
    look = FontProperties(math_fontfamily=MATHEMATICS, size=UNIT)
    with _one_at_a_time:
        box = TextToPath().mathtext_parser.parse(f"${text}$", TextToPath.DPI, look)
    glyphs = [
        (_typeface(Path(str(font.fname))), float(size), number, float(x), float(y))
        for font, size, _, number, x, y in box.glyphs
    ]
    bars = [(float(x), float(y), float(wide), float(tall)) for x, y, wide, tall in box.rects]
    return float(box.width), float(box.height), float(box.depth), glyphs, bars


@cache
def _typefaces() -> Path:
    """The folder of those that mathtext brings."""
    return (Path(matplotlib.get_data_path()) / "fonts" / "ttf").resolve()


def _typeface(file: Path) -> str:
    """The name of a typeface that mathtext brings; the whole path of another."""
    return file.name if file.resolve().parent == _typefaces() else str(file)


@cache
def _glyph(typeface: str, number: GlyphIndexType) -> Glyph:
    """The outline of a glyph of the size at which everything is set."""
    return outlined(str(_typefaces() / typeface), number)

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
from matplotlib.font_manager import FontProperties, get_font
from matplotlib.ft2font import GlyphIndexType, LoadFlags
from matplotlib.textpath import TextToPath

from app import ASSETS
from app.draw.letters import Glyph
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
    vertices: list[Floats] = [np.zeros((0, 2))]
    codes: list[Indices] = [np.zeros(0, dtype=np.uint8)]
    for typeface, size, number, x, y in glyphs:
        v, c = _glyph(typeface, number)
        vertices.append(v * (size / UNIT) + np.array([x, y]))
        codes.append(c)
    for x, y, wide, tall in bars:
        vertices.append(np.array([(x, y), (x, y + tall), (x + wide, y + tall), (x + wide, y), (x, y), (0, 0)]))
        codes.append(BAR)
    scale = UNIT / MATHEMATICS_SIZE
    return width / scale, (height - descent) / scale, descent / scale, np.vstack(vertices) / scale, np.hstack(codes)


@cache
def prepared() -> dict[str, str]:
    """The boxes that were set beforehand, as JSON; none where mathtext is of another version."""
    head, *rows = TABLE.read_text(encoding="utf-8").splitlines() if TABLE.exists() else [""]
    is_alike = head == f"matplotlib {matplotlib.__version__}"
    return dict(row.split("\t") for row in rows) if is_alike else {}


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
    font = get_font(str(_typefaces() / typeface))
    font.clear()
    font.set_size(UNIT, TextToPath.DPI)
    font.load_glyph(number, flags=LoadFlags.NO_HINTING)
    vertices, codes = font.get_path()
    return vertices, codes

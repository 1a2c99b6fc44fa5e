"""Words and mathematics as outlines: the shipped Inter for words, mathtext for what stands between dollars.

Every painter measures with this, so that a picture breaks its lines at the same places everywhere.
"""

from dataclasses import dataclass
from functools import cache, lru_cache
from threading import Lock
from typing import TypeAlias

import numpy as np
from matplotlib.font_manager import FontProperties, fontManager, get_font
from matplotlib.path import Path as Outline
from matplotlib.textpath import TextToPath

from app import ASSETS
from subdivision.arrays import Floats, Indices

FONTS = ASSETS / "fonts"
FAMILY = "Inter"
REGULAR, BOLD = FONTS / "Inter-Regular.otf", FONTS / "Inter-SemiBold.otf"

MATHEMATICS, MATHEMATICS_SIZE = "stix", 1.12
"""Its letters are lower than Inter's: set larger, both look alike."""
FEATURES = ("tnum",)
"""Figures of one width: numbers that change while a stage plays do not jitter."""

ASCENT, DESCENT = 0.93, 0.25
"""Room for a line of plain words, relative to its size."""

DOUBT = 0.02
"""By how much words and the spaces between them may come nearer to each other than each by itself, at each space."""

Extent: TypeAlias = tuple[float, float, float]
"""Width, ascent above the baseline, descent below it."""


_one_at_a_time = Lock()
"""The parser of mathtext is one for all threads, and remembers where it is."""


@dataclass(frozen=True)
class Run:
    """A stretch of words or of mathematics, ``x`` from the start of its line, for type of size 1."""

    text: str
    x: float
    is_math: bool


def measure(text: str, size: float, bold: bool = False) -> Extent:
    """The room ``text`` takes at ``size``."""
    width, ascent, descent, *_ = _set(text, bold)
    return float(width * size), float(ascent * size), float(descent * size)


def outline(text: str, size: float, bold: bool = False) -> tuple[Floats, Indices]:
    """Vertices (n, 2), y upwards from the baseline, and matplotlib path codes."""
    _, _, _, vertices, codes, _ = _set(text, bold)
    return vertices * size, codes


def runs(text: str, bold: bool = False) -> tuple[Run, ...]:
    """The stretches of ``text`` and where each starts."""
    return _set(text, bold)[5]


@lru_cache(maxsize=512)
def wrapped(text: str, size: float, width: float, bold: bool = False) -> tuple[str, ...]:
    """Lines no wider than ``width``, of even lengths; a formula is never broken."""
    if not text.strip():
        return ()
    words = _words(text)
    full = _broken(words, size, width, bold)
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


@lru_cache(maxsize=2048)
def _set(text: str, bold: bool) -> tuple[float, float, float, Floats, Indices, tuple[Run, ...]]:
    """Everything about a line of type of size 1."""
    at, ascent, descent = 0.0, ASCENT, DESCENT
    vertices: list[Floats] = [np.zeros((0, 2))]
    codes: list[Indices] = [np.zeros(0, dtype=np.intp)]
    found: list[Run] = []
    for piece, is_math in _pieces(text):
        found.append(Run(piece, at, is_math))
        width, up, down, v, c = _math(piece) if is_math else _plain(piece, bold)
        vertices.append(v + np.array([at, 0.0]))
        codes.append(c)
        at, ascent, descent = at + width, max(ascent, up), max(descent, down)
    return at, ascent, descent, np.vstack(vertices), np.concatenate(codes).astype(np.uint8), tuple(found)


def _plain(text: str, bold: bool) -> tuple[float, float, float, Floats, Indices]:
    tool = TextToPath()
    font = get_font(_files(bold))
    font.set_size(tool.FONT_SCALE, tool.DPI)
    glyphs, shapes, _ = tool.get_glyphs_with_font(font, f"{text}|", features=FEATURES)
    vertices, codes = [np.zeros((0, 2))], [np.zeros(0, dtype=np.uint8)]
    for name, x, y, scale in glyphs[:-1]:
        v, c = shapes[name]
        vertices.append(np.asarray(v) * scale + np.array([x, y]))
        codes.append(np.asarray(c))
    width, scale = glyphs[-1][1], tool.FONT_SCALE
    return width / scale, ASCENT, DESCENT, np.vstack(vertices) / scale, np.concatenate(codes)


@lru_cache(maxsize=2048)
def _math(text: str) -> tuple[float, float, float, Floats, Indices]:
    with _one_at_a_time:
        return _mathematics(text)


def _mathematics(text: str) -> tuple[float, float, float, Floats, Indices]:
    tool = TextToPath()
    look = FontProperties(math_fontfamily=MATHEMATICS, size=tool.FONT_SCALE)
    width, height, descent = tool.get_text_width_height_descent(f"${text}$", look, ismath=True)
    vertices, codes = tool.get_text_path(look, f"${text}$", ismath=True)
    scale = tool.FONT_SCALE / MATHEMATICS_SIZE
    return (
        width / scale, (height - descent) / scale, descent / scale,
        np.asarray(vertices, dtype=float).reshape(-1, 2) / scale, np.asarray(codes, dtype=np.uint8),
    )  # fmt: skip


@cache
def _files(bold: bool) -> tuple[str, ...]:
    """Inter, and a typeface that has the characters Inter lacks."""
    return str(BOLD if bold else REGULAR), fontManager.findfont("DejaVu Sans")


def path(text: str, size: float, bold: bool = False) -> Outline:
    """The outline as one matplotlib path."""
    return Outline(*outline(text, size, bold))

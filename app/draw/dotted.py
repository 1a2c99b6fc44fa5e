"""Dots with words beside them: the words as large as there is room for, none over a dot, a stroke or other words.

Words stand off their dot in the direction the dot says.  Sizes are tried from the largest on; for each, the
dots are spread as far as their pane allows.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from app.draw.picture import Colour, Diagram, Dot, Shape
from app.draw.primitives import LEAST, Area, Mark, Primitive, Stroke, Text
from app.draw.type import measure
from subdivision.arrays import Floats, Mask

LARGEST = 38.0
"""The largest type, in logical points."""

GAP = 8.0
"""Between a dot and its words, and between strokes and words, in logical points."""

REACH = {Shape.CLEAR: 1.73}
"""How far a dot reaches, relative to its size, where that is not 1."""

TALL, LOW = 0.8, 0.09
"""How far fractions reach above and below their baseline, relative to their size."""

FURTHER = 60.0
"""How much further off their dot words may stand to be free of strokes, in logical points."""

ALONG = np.linspace(0.0, 1.0, 41)[:, None, None]
"""The places along a stroke that words keep off."""


@dataclass(frozen=True, eq=False)
class Spread:
    """Dots in their pane, in pixels.

    ``at`` (n_dots, 2) is where they are, ``reach`` (n_dots,) how far they reach; ``words`` (n_dots, 4) the left,
    top, right and bottom of what is written beside each, in type of ``size`` logical points.
    """

    at: Floats
    reach: Floats
    words: Floats
    size: float
    unit: float
    start: tuple[float, float]
    cell: float


@lru_cache(maxsize=64)
def spread(diagram: Diagram, area: Area, unit: float, most: float = LARGEST) -> Spread:
    """The largest type, up to ``most`` logical points, with which nothing meets, strokes apart if it must be.

    ``unit`` pixels are a logical point.
    """
    found: list[tuple[int, Spread]] = []
    for size in [*np.arange(most, LEAST, -1.0).tolist(), LEAST]:
        fit, crossed = _aside(diagram, _spread(diagram, area, unit, size))
        if _is_clear(fit):
            found.append((crossed, fit))
            if crossed == 0:
                break
    return min(found, key=lambda each: each[0])[1] if found else fit


def drawn(diagram: Diagram, fit: Spread, stroke: float, background: Colour) -> list[Primitive]:
    """The links, ``stroke`` times as wide as they say, up to where clear dots begin; the dots and their words."""
    return [*_strokes(diagram, fit, stroke * fit.unit), *_marks(diagram, fit, background)]


def nearest(diagram: Diagram, fit: Spread, x: float, y: float) -> Dot | None:
    """The dot under a place, or a little beside it; the later one where two are equally near."""
    far = np.linalg.norm(fit.at - (x, y), axis=1) - 1.5 * fit.reach
    k = len(far) - 1 - int(np.argmin(far[::-1]))
    return diagram.dots[k] if far[k] <= 0 else None


def _strokes(diagram: Diagram, fit: Spread, width: float) -> list[Primitive]:
    """The links, ``width`` pixels to a logical point of theirs."""
    clear = [k for k, dot in enumerate(diagram.dots) if dot.shape is Shape.CLEAR]
    found: list[Primitive] = []
    for link in diagram.links:
        ends = np.array(fit.start) + fit.cell * np.array([(link.x0, link.y0), (link.x1, link.y1)])
        x0, y0, x1, y1 = map(float, ends.ravel())
        whole = Stroke(x0, y0, x1, y1, link.colour, link.width * width, link.opacity)
        pieces = [whole]
        for k in clear:
            pieces = [piece for each in pieces for piece in _outside(each, fit.at[k], float(fit.reach[k]))]
        found.extend(pieces)
    return found


def _marks(diagram: Diagram, fit: Spread, background: Colour) -> list[Primitive]:
    """The dots and their words."""
    found: list[Primitive] = []
    for dot, (x, y), reach, room in zip(diagram.dots, fit.at, fit.reach, fit.words, strict=True):
        found.append(Mark(float(x), float(y), dot.shape, float(reach) / REACH.get(dot.shape, 1.0), dot.colour))
        if dot.text:
            size = fit.size * fit.unit
            x, y = float(room[0]), float(room[1]) + TALL * size
            found.append(Text(x, y, dot.text, size, dot.colour, halo=background))
    return found


def _spread(diagram: Diagram, area: Area, unit: float, size: float) -> Spread:
    """With type of one size, the dots as far from one another as words and pane allow."""
    dots = diagram.dots
    cells = np.array([(d.x, d.y) for d in dots])
    reach = np.array([d.size * REACH.get(d.shape, 1.0) for d in dots]) * unit
    same = np.abs(cells[:, None] - cells[None]).max(axis=2) < 1e-6
    words = _off(dots, (reach * same).max(axis=1) + GAP * unit, size * unit)
    low = np.minimum(words[:, :2], -reach[:, None])
    high = np.maximum(words[:, 2:], reach[:, None])
    x, y, w, h = area
    cell = min(diagram.largest * unit, *(_cell(cells[:, k], low[:, k], high[:, k], (w, h)[k]) for k in (0, 1)))
    start = [
        begin + ((-cell * cells[:, k] - low[:, k]).max() + (room - cell * cells[:, k] - high[:, k]).min()) / 2
        for k, (begin, room) in enumerate(((x, w), (y, h)))
    ]
    at = np.array(start) + cell * cells
    return Spread(at, reach, words + np.hstack([at, at]), size, unit, (float(start[0]), float(start[1])), float(cell))


def _off(dots: tuple[Dot, ...], clear: Floats, size: float) -> Floats:
    """(n_dots, 4): the room for the words of each dot, from its middle, no nearer to it than ``clear``."""
    half = np.array([(measure(d.text, size)[0], (TALL + LOW) * size) if d.text else (0.0, 0.0) for d in dots]) / 2
    way = np.array([d.way for d in dots])
    near, far = np.zeros(len(dots)), clear + np.linalg.norm(half, axis=1)
    for _ in range(20):  # halving: the place nearest to the dot that is clear of it
        middle = (near + far) / 2
        gap = np.linalg.norm(np.maximum(np.abs(middle[:, None] * way) - half, 0.0), axis=1)
        near, far = np.where(gap < clear, middle, near), np.where(gap < clear, far, middle)
    centre = far[:, None] * way * (half > 0)
    return np.hstack([centre - half, centre + half])


def _cell(places: Floats, low: Floats, high: Floats, room: float) -> float:
    """The largest cell with which everything, from ``low`` to ``high`` about its place, fits in ``room``."""
    apart = places[:, None] - places[None]
    left = room - (high[:, None] - low[None])
    return float(np.divide(left, apart, out=np.full_like(apart, np.inf), where=apart > 1e-6).min(initial=np.inf))


def _is_clear(fit: Spread) -> bool:
    """Whether no words meet a dot or other words."""
    words, gap = fit.words[_written(fit.words)], 0.5 * GAP * fit.unit
    low, high = words[:, :2] - gap, words[:, 2:] + gap
    meet = ((low[:, None] < high[None]) & (low[None] < high[:, None])).all(axis=2)
    return not _meets(fit, words).any() and bool(meet.sum() == len(words))


def _aside(diagram: Diagram, fit: Spread) -> tuple[Spread, int]:
    """Words that a link runs through stand further off their dot, if that frees them; and how many it does not free."""
    way = np.array([d.way for d in diagram.dots])
    words, along = fit.words.copy(), _along(diagram, fit)
    crossed = np.flatnonzero(_crossed(fit, words, along))
    for step in np.arange(1.0, FURTHER, 2.0) * fit.unit:
        if not len(crossed):
            break
        moved = fit.words[crossed] + step * np.hstack([way, way])[crossed]
        free = ~_crossed(fit, moved, along) & ~_meets(fit, moved)
        words[crossed[free]] = moved[free]
        crossed = crossed[~free]
    return replace(fit, words=words), len(crossed)


def _along(diagram: Diagram, fit: Spread) -> Floats:
    """(n, 1, 2): places along the links."""
    ends = np.array([[(k.x0, k.y0), (k.x1, k.y1)] for k in diagram.links]).reshape(-1, 2, 2)
    ends = np.array(fit.start) + fit.cell * ends
    return np.asarray(((1 - ALONG) * ends[:, 0] + ALONG * ends[:, 1]).reshape(-1, 1, 2))


def _meets(fit: Spread, words: Floats) -> Mask:
    """(n,) bool: which of the ``words`` (n, 4) are over a dot."""
    near = np.clip(fit.at[None], words[:, None, :2], words[:, None, 2:])
    far = np.linalg.norm(near - fit.at[None], axis=2)
    return np.asarray(_written(words) & (far < fit.reach + 0.5 * GAP * fit.unit).any(axis=1))


def _crossed(fit: Spread, words: Floats, along: Floats) -> Mask:
    """(n,) bool: which of the ``words`` (n, 4) have a place ``along`` a link in them."""
    gap = 0.25 * GAP * fit.unit
    low, high = words[:, :2] - gap, words[:, 2:] + gap
    inside = np.ones((len(along), len(words)), dtype=bool)
    for k in (0, 1):
        inside &= (along[:, :, k] > low[:, k]) & (along[:, :, k] < high[:, k])
    return np.asarray(_written(words) & inside.any(axis=0))


def _written(words: Floats) -> Mask:
    """(n,) bool: which of the rooms (n, 4) have words in them."""
    return np.asarray(words[:, 2] > words[:, 0])


def _outside(stroke: Stroke, middle: Floats, reach: float) -> list[Stroke]:
    """What is left of a stroke outside a diamond."""
    a, b = np.array([stroke.x0, stroke.y0]) - middle, np.array([stroke.x1, stroke.y1]) - middle
    bounds = [(0.0, 1.0)]
    for normal in np.array([(1, 1), (1, -1), (-1, 1), (-1, -1)]):
        begin, end = float(normal @ a) - reach, float(normal @ b) - reach
        if begin > 0 and end > 0:
            return [stroke]
        if (begin > 0) != (end > 0):
            t = begin / (begin - end)
            bounds.append((t, 1.0) if begin > 0 else (0.0, t))
    first, last = max(low for low, _ in bounds), min(high for _, high in bounds)
    if first >= last:
        return [stroke]
    (x0, y0), (x1, y1) = a + middle + first * (b - a), a + middle + last * (b - a)
    before, after = replace(stroke, x1=float(x0), y1=float(y0)), replace(stroke, x0=float(x1), y0=float(y1))
    return [piece for piece, kept in ((before, first > 0), (after, last < 1)) if kept]

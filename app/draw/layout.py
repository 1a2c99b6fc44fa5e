"""Where words, legend, labels and diagrams stand on a picture of a given size, as flat strokes and marks.

One layout serves all painters: the window's overlay, PNG and SVG.
Coordinates are pixels from the upper left, y downwards.
"""

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import chain, takewhile
from math import hypot

import numpy as np

from app.draw import bars, dotted, pins
from app.draw.labels import Kept, placed
from app.draw.picture import Box, Camera, Diagram, Dot, Entry, Link, Note, Pane, Picture, Scene, Squares
from app.draw.primitives import LEAST, Area, Mark, Plate, Primitive, Stroke, Text, Tiles
from app.draw.type import measure, wrapped

__all__ = [
    "Area",
    "Mark",
    "Plate",
    "Primitive",
    "Stroke",
    "Text",
    "fitted",
    "overlay",
    "pane_areas",
    "part_at",
    "spoken",
]


# Sizes in logical points: thousandths of the picture's height.
MARGIN, GAP = 26.0, 14.0
TITLE, PANE_TITLE, READING, CORNER, LEGEND = 36.0, 27.0, 27.0, 25.0, 25.0
CAPTION, FORMULA, NOTE = 36.0, 36.0, 25.0
BOX = 34.0
"""The largest type in a box."""
IN_BOX = 1.18
"""From one baseline to the next in a box, relative to the size of the type."""

CORNER_OF_BOX = 0.14
"""Radius of the corners of a box, relative to its shorter side."""

SPECK = 2.6
"""The least side of a square, however small its cell is."""

TILES = 400
"""So many squares of a diagram at most are one primitive."""

HEAD, SPREAD = 3.6, 0.55
"""How far an arrow's head reaches back, relative to the width of its stroke, and aside, relative to that."""

FRAME, ROUND = 7.0, 12.0
"""A frame's stroke, and the radius of its corners."""

APART = 1.4
"""Between the caption and the formula beside it, relative to the caption's size."""

GUTTER, EDGE = 6.0, 1e-9
"""Half of what parts panes side by side, where nets that are cut off must not meet; what is no part of a width."""

ROOM, STEPS = 0.55, 32
"""Enlarged type leaves this part of the picture's height to the panes; it is fitted in so many steps."""

LINE = 1.3
"""From one baseline to the next, relative to the size of the type."""


@dataclass(frozen=True)
class _Words:
    """What stands above and below the panes, and the room that is left between ``top`` and ``bottom``."""

    placed: tuple[Primitive, ...]
    top: float
    bottom: float


def overlay(
    picture: Picture,
    width: float,
    height: float,
    cameras: Sequence[Camera | None] | None = None,
    words: bool = True,
    kept: Kept | None = None,
) -> tuple[Primitive, ...]:
    """Everything flat on a picture of ``width`` by ``height`` pixels.

    ``cameras``, one for each pane, are those the user has turned; None: as the picture says.
    ``words`` includes the caption and its formula.  Labels stay beside their points where they are ``kept``.
    """
    picture = _readable(picture, width, height, words)
    found: list[Primitive] = []
    areas = pane_areas(picture, width, height, words)
    spreads = _spreads(picture, areas, height / 1000)
    live = cameras or [None] * len(picture.panes)
    for k, (pane, area, camera) in enumerate(zip(picture.panes, areas, live, strict=True)):
        if k in spreads and isinstance(pane.content, Diagram):
            found.extend(dotted.drawn(pane.content, spreads[k], picture.stroke, picture.background))
        elif isinstance(pane.content, Diagram):
            found.extend(_diagram(pane.content, area, picture, height))
        else:
            seen = camera or fitted(pane.content.camera, area)
            found.extend(pins.drawn(pane.content, seen, area, picture, height))
            said = bars.drawn(pane.content, seen, area, picture, height)
            found.extend(placed(pane.content, seen, area, height, picture, kept, bars.rooms(said)))
            found.extend(chain(*said))
        found.extend(_framed(pane, area, picture, height))
        found.extend(_pane_title(pane, area, picture, height))
        found.extend(_reading(pane, area, picture, height))
    return (*found, *_words(picture, width, height, words).placed)


def pane_areas(picture: Picture, width: float, height: float, words: bool = True) -> list[Area]:
    """Where the panes are, in whole pixels: what title, legend and caption leave free."""
    picture = _readable(picture, width, height, words)
    around = _words(picture, width, height, words)
    above, below = _title_room(picture, height), _reading_room(picture, height)
    tall, gutter = around.bottom - around.top, GUTTER * height / 1000
    areas = []
    for pane in picture.panes:
        x, y, w, h = pane.rect
        apart = gutter if isinstance(pane.content, Scene) else 0.0
        left = round(x * width + (apart if x > 0 else 0))
        right = round((x + w) * width - (apart if x + w < 1 - EDGE else 0))
        top, bottom = round(around.top + y * tall + above), round(around.top + (y + h) * tall - below)
        areas.append((float(left), float(top), float(max(right - left, 1)), float(max(bottom - top, 1))))
    return areas


@lru_cache(maxsize=64)
def fitted(camera: Camera, area: Area) -> Camera:
    """The camera stepped back for a pane too narrow for it: what it must show stays visible."""
    back = max(1.0, camera.aspect * area[3] / area[2])
    if camera.scale:
        return replace(camera, scale=camera.scale * back)
    tangent = np.tan(np.radians(camera.angle) / 2) * back
    return replace(camera, angle=float(2 * np.degrees(np.arctan(tangent))))


# -- words round the panes --------------------------------------------------------------------


def _words(picture: Picture, width: float, height: float, words: bool) -> _Words:
    unit = height / 1000
    head, top = _head(picture, width, unit)
    foot: list[Primitive] = []
    bottom = height - 0.5 * MARGIN * unit
    if words and (picture.caption or picture.formula):
        foot, bottom = _caption(picture, width, height)
    legend, bottom = _legend(picture, width, bottom, unit)
    return _Words((*head, *legend, *foot), top, bottom)


def spoken(picture: Picture, width: float, height: float) -> tuple[tuple[Primitive, ...], float, float]:
    """Title, counts, caption and formula alone, and from where to where the rest of the picture reaches down."""
    picture = _readable(picture, width, height, words=True)
    head, top = _head(picture, width, height / 1000)
    foot, bottom = _caption(picture, width, height)
    return (*head, *foot), top, bottom


def _readable(picture: Picture, width: float, height: float, words: bool) -> Picture:
    """The picture with enlarged type as large as it leaves room for the panes."""
    if picture.growth == 1.0:
        return picture
    named = tuple((bool(pane.title), bool(pane.reading)) for pane in picture.panes)
    said = (picture.title, picture.corner, picture.legend, picture.caption, picture.formula)
    growth = _growth(named, said, picture.scale, picture.growth, width, height, words)
    return replace(picture, scale=picture.scale * growth / picture.growth, growth=growth)


@lru_cache(maxsize=64)
def _growth(
    named: tuple[tuple[bool, bool], ...],
    said: tuple[str, str, tuple[Entry, ...], str, str],
    scale: float,
    growth: float,
    width: float,
    height: float,
    words: bool,
) -> float:
    """How much type can grow: panes with or without titles and readings, and what is ``said`` round them."""
    title, corner, legend, caption, formula = said
    panes = tuple(Pane(Diagram((0, 0, 1, 1)), title="-" * above, reading="-" * below) for above, below in named)
    black = (0.0, 0.0, 0.0)

    def leaves_room(smaller: int) -> bool:
        part = 1 - smaller / STEPS * (1 - 1 / growth)
        tried = Picture(panes, black, black, black, legend, title, caption, formula, corner, scale=scale * part)
        around = _words(tried, width, height, words)
        free = around.bottom - around.top - _title_room(tried, height) - _reading_room(tried, height)
        return free >= ROOM * height

    smaller = bisect_left(range(STEPS), True, key=leaves_room)
    return growth - smaller / STEPS * (growth - 1)


def _head(picture: Picture, width: float, unit: float) -> tuple[list[Primitive], float]:
    """Title upper left, counts upper right or, where there is no room, below the title."""
    scale, margin = unit * picture.scale, MARGIN * unit
    y, found = margin, list[Primitive]()
    counts = measure(picture.corner, CORNER * scale)[0]
    room = width - 2 * margin
    lines = wrapped(picture.title, TITLE * scale, room, bold=True)
    for line in lines:
        y += TITLE * scale * (0.95 if line is lines[0] else LINE)
        found.append(Text(margin, y, line, TITLE * scale, picture.ink, bold=True))
    if picture.corner:
        last = measure(lines[-1], TITLE * scale, True)[0] if lines else 0.0
        if not lines or last + counts + 2 * margin > room:
            y += CORNER * scale * (LINE if lines else 0.95)
            found.append(Text(margin, y, picture.corner, CORNER * scale, picture.muted))
        else:
            found.append(Text(width - margin, y, picture.corner, CORNER * scale, picture.muted, "right"))
    return found, y + (0.3 * TITLE * scale + 0.4 * GAP * unit if found else 0.0)


def _caption(picture: Picture, width: float, height: float) -> tuple[list[Primitive], float]:
    """The caption centred at the bottom; the formula beside it if it leaves room for two lines, else below.

    There is always room for two lines, so that what is above stays in its place from step to step.
    """
    unit = height / 1000
    size, room = CAPTION * unit * picture.scale, min(width - 2 * MARGIN * unit, 1.72 * height)
    formula = picture.formula.replace(r"\frac", r"\dfrac")
    math = _fitted_formula(formula, FORMULA * unit * picture.scale, room, LEAST * unit)
    wide, up, down = measure(formula, math) if math else (0.0, 0.0, 0.0)
    narrow = room - wide - APART * size
    beside = wrapped(picture.caption, size, narrow) if math and narrow > 8 * size else ()
    is_beside = bool(beside) and len(beside) <= 2
    lines = beside if is_beside else wrapped(picture.caption, size, room)
    block = len(lines) * LINE * size
    tall = max(block, up + down) if is_beside or not lines else block + (up + down + 0.2 * size if math else 0.0)
    taken = max(tall, 2 * LINE * size)
    top = height - (0.7 * MARGIN + 0.4 * GAP) * unit - taken
    words = max((measure(line, size)[0] for line in lines), default=0.0)
    middle = width / 2 - (wide + APART * size) / 2 if is_beside else width / 2
    y = top + (taken - (block if is_beside else tall)) / 2
    found: list[Primitive] = []
    for line in lines:
        found.append(Text(middle, y + 0.98 * size, line, size, picture.ink, "center"))
        y += LINE * size
    if math and is_beside:
        x, base = middle + words / 2 + APART * size, top + (taken - up - down) / 2 + up
        found.append(Text(x, base, formula, math, picture.ink))
    elif math:
        found.append(Text(width / 2, y + up + (0.2 * size if lines else 0.0), formula, math, picture.ink, "center"))
    return found, top - 0.4 * GAP * unit


def _fitted_formula(formula: str, size: float, room: float, least: float) -> float:
    """The size of the formula, smaller where it would not fit; 0: there is none."""
    if not formula:
        return 0.0
    wide = measure(formula, size)[0]
    return max(min(size, size * room / max(wide, 1e-9)), least)


def _legend(picture: Picture, width: float, bottom: float, unit: float) -> tuple[list[Primitive], float]:
    """One row, or as many as are needed, above ``bottom``."""
    if not picture.legend:
        return [], bottom
    scale, margin = unit * picture.scale, MARGIN * unit
    size = LEGEND * scale
    rows: list[list[tuple[float, int]]] = [[]]
    x = margin
    for k, entry in enumerate(picture.legend):
        wide = 1.25 * size + measure(entry.text, size)[0]
        if rows[-1] and x + wide > width - margin:
            rows.append([])
            x = margin
        rows[-1].append((x, k))
        x += wide + 1.2 * size
    found: list[Primitive] = []
    top = bottom - GAP * unit * 0.5 - len(rows) * LINE * size
    for r, row in enumerate(rows):
        y = top + (r + 0.95) * LINE * size
        for x, k in row:
            e = picture.legend[k]
            found.append(Mark(x + 0.45 * size, y - 0.36 * size, e.shape, 0.3 * size, e.colour))
            found.append(Text(x + 1.25 * size, y, e.text, size, picture.muted))
    return found, top - 0.3 * GAP * unit


def _title_room(picture: Picture, height: float) -> float:
    return PANE_TITLE * LINE * height / 1000 * picture.scale if any(p.title for p in picture.panes) else 0.0


def _pane_title(pane: Pane, area: Area, picture: Picture, height: float) -> list[Primitive]:
    if not pane.title:
        return []
    size = _fitted_size(pane.title, PANE_TITLE, area, picture, height)
    return [Text(area[0] + area[2] / 2, area[1] - 0.35 * size, pane.title, size, picture.muted, "center", bold=True)]


def _fitted_size(words: str, wished: float, area: Area, picture: Picture, height: float) -> float:
    """As large as wished, as far as the words then fit over or below their pane."""
    size = wished * height / 1000 * picture.scale
    wide = measure(words, size, True)[0]
    return max(min(size, size * 0.94 * area[2] / wide), LEAST * height / 1000)


def _reading_room(picture: Picture, height: float) -> float:
    return READING * LINE * height / 1000 * picture.scale if any(p.reading for p in picture.panes) else 0.0


def _reading(pane: Pane, area: Area, picture: Picture, height: float) -> list[Primitive]:
    """What was measured, in the middle below its pane."""
    if not pane.reading:
        return []
    size = _fitted_size(pane.reading, READING, area, picture, height)
    x, y = area[0] + area[2] / 2, area[1] + area[3] + 0.95 * size
    return [Text(x, y, pane.reading, size, picture.ink, "center", bold=True)]


# -- diagrams ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Cells:
    """Where the cells of a diagram stand in its pane: all alike, in the middle."""

    x0: float
    y0: float
    wide: float
    tall: float

    def at(self, x: float, y: float) -> tuple[float, float]:
        return self.x0 + self.wide * x, self.y0 + self.tall * y

    def of(self, box: Box) -> tuple[float, float]:
        """Width and height of a box."""
        return self.wide * box.width, self.tall * box.height


def _cells(diagram: Diagram, area: Area, unit: float) -> _Cells:
    """As large as there is room for, in a shape the diagram allows."""
    left, top, right, bottom = diagram.cells
    margin = MARGIN * unit
    wide, tall = (area[2] - 2 * margin) / max(right - left, 1e-9), (area[3] - margin) / max(bottom - top, 1e-9)
    least, most = diagram.shape
    tall = min(tall, wide / least, diagram.largest * unit)
    wide = min(wide, most * tall)
    x, y = area[0] + area[2] / 2, area[1] + area[3] / 2
    return _Cells(x - wide * (left + right) / 2, y - tall * (top + bottom) / 2, wide, tall)


def part_at(
    picture: Picture, width: float, height: float, x: float, y: float, words: bool = True
) -> tuple[int, Box | Dot] | None:
    """The box, square or dot of a diagram under a place of the picture, the topmost, and the number of its pane."""
    unit = height / 1000
    areas = pane_areas(picture, width, height, words)
    spreads = _spreads(picture, areas, unit)
    for k, (pane, area) in enumerate(zip(picture.panes, areas, strict=True)):
        if not isinstance(pane.content, Diagram):
            continue
        if k in spreads and (dot := dotted.nearest(pane.content, spreads[k], x, y)) is not None:
            return k, dot
        cells = _cells(pane.content, area, unit)
        here = np.array([(x - cells.x0) / cells.wide, (y - cells.y0) / cells.tall])
        for squares in reversed(pane.content.squares):
            if len(hit := np.flatnonzero((np.abs(squares.places - here) <= squares.side / 2).all(axis=1))):
                return k, squares.box(hit[-1])
        for part in reversed(pane.content.boxes):
            across, down = (abs(a - b) for a, b in zip(cells.at(part.x, part.y), (x, y), strict=True))
            wide, tall = cells.of(part)
            if across <= wide / 2 and down <= tall / 2:
                return k, part
    return None


def _diagram(diagram: Diagram, area: Area, picture: Picture, height: float) -> list[Primitive]:
    """Links, boxes and notes, the later ones over the earlier."""
    unit = height / 1000
    cells, margin = _cells(diagram, area, unit), MARGIN * unit
    links = [stroke for k in diagram.links for stroke in _link(k, cells, k.width * unit * picture.stroke)]
    said = _spelled(diagram, cells, unit, picture.scale)
    boxes = [
        primitive
        for b, (text, size) in zip(diagram.boxes, said, strict=True)
        for primitive in _box(b, cells, text, size, b.line * unit * picture.stroke)
    ]
    size = max(min(NOTE * unit * picture.scale, 0.5 * cells.tall), LEAST * unit)
    notes = [text for n in diagram.notes for text in _note(n, cells.at(n.x, n.y), size, area, margin)]
    return [*links, *boxes, *(tiles for each in diagram.squares for tiles in _tiles(each, cells, SPECK * unit)), *notes]


def _tiles(squares: Squares, cells: _Cells, least: float) -> list[Primitive]:
    """Some hundreds at a time: painters take a rest between two primitives."""
    wide, tall = (max(each * squares.side, least) for each in (cells.wide, cells.tall))
    corners = squares.places * (cells.wide, cells.tall) + (cells.x0 - wide / 2, cells.y0 - tall / 2)
    parts = (slice(k, k + TILES) for k in range(0, len(corners), TILES))
    radius = CORNER_OF_BOX * min(wide, tall)
    return [Tiles(corners[part], wide, tall, squares.colours[part], radius, squares.opacity) for part in parts]


def _link(link: Link, cells: _Cells, width: float) -> list[Primitive]:
    """The stroke, and those of its head."""
    (x0, y0), (x1, y1) = cells.at(link.x0, link.y0), cells.at(link.x1, link.y1)
    starts = [(x0, y0)]
    if link.is_arrow:
        part = HEAD * width / max(hypot(x0 - x1, y0 - y1), 1e-9)
        x, y = part * (x0 - x1), part * (y0 - y1)
        starts += [(x1 + x - SPREAD * y, y1 + y + SPREAD * x), (x1 + x + SPREAD * y, y1 + y - SPREAD * x)]
    return [Stroke(*start, x1, y1, link.colour, width, link.opacity) for start in starts]


def _framed(pane: Pane, area: Area, picture: Picture, height: float) -> list[Primitive]:
    if pane.frame is None:
        return []
    unit, (x, y, w, h) = height / 1000, area
    line = FRAME * unit * picture.stroke
    return [Plate(x + line, y + line, w - 2 * line, h - 2 * line, None, pane.frame, line, ROUND * unit)]


def _spreads(picture: Picture, areas: Sequence[Area], unit: float) -> dict[int, dotted.Spread]:
    """The panes with dots, by number, all with type of one size."""
    unit, margin = unit * picture.scale, 0.5 * MARGIN * unit
    found = {
        k: (pane.content, (x + margin, y + margin, max(w - 2 * margin, 1.0), max(h - 2 * margin, 1.0)))
        for k, (pane, (x, y, w, h)) in enumerate(zip(picture.panes, areas, strict=True))
        if isinstance(pane.content, Diagram) and pane.content.dots
    }
    most = min((dotted.spread(diagram, area, unit).size for diagram, area in found.values()), default=0.0)
    return {k: dotted.spread(diagram, area, unit, most) for k, (diagram, area) in found.items()}


def _spelled(diagram: Diagram, cells: _Cells, unit: float, scale: float) -> list[tuple[str, float]]:
    """For each box the words it has room for, and their size; short words are not much larger than the longest."""
    found: list[tuple[str, float]] = []
    choice = {group: _fullest(diagram, group, cells, LEAST * unit) for group in {b.group for b in diagram.boxes}}
    for b in diagram.boxes:
        k, size = choice[b.group]
        text = b.texts[min(k, len(b.texts) - 1)] if size else ""
        comfortable = max(size, 0.88 * _room(b, text, cells))
        found.append((text, min(1.4 * size, BOX * unit * scale, comfortable) if size else 0.0))
    return found


def _fullest(diagram: Diagram, group: int, cells: _Cells, least: float) -> tuple[int, float]:
    """Which of its texts all boxes of a group have room for, and the least of the sizes at which they hold it."""
    boxes = [b for b in diagram.boxes if b.group == group]
    for k in range(max(len(b.texts) for b in boxes)):
        said = sorted(((b, b.texts[min(k, len(b.texts) - 1)]) for b in boxes), key=lambda one: -len(one[1]))
        rooms = list(takewhile(lambda size: size >= least, (_room(b, text, cells) for b, text in said)))
        if len(rooms) == len(boxes):  # the longest first: where they have no room, no others need to be set
            return k, min(rooms)
    return 0, 0.0


def _room(box: Box, text: str, cells: _Cells) -> float:
    """The largest size at which a box holds its words."""
    across, down = cells.of(box)
    wide, tall = _block(text)
    return min(0.94 * down / tall, 0.92 * across / max(wide, 1e-9)) if tall else float("inf")


@lru_cache(maxsize=2048)
def _block(text: str) -> tuple[float, float]:
    """Width and height of the lines of a box, in type of size 1."""
    found = [measure(line, 1.0) for line in text.splitlines()]
    wide = max((line[0] for line in found), default=0.0)
    return wide, max([IN_BOX * len(found), *(up + down for _, up, down in found)])


def _box(box: Box, cells: _Cells, said: str, size: float, line: float) -> list[Primitive]:
    (x, y), (w, h) = cells.at(box.x, box.y), cells.of(box)
    plate = Plate(x - w / 2, y - h / 2, w, h, box.fill, box.stroke, line, CORNER_OF_BOX * min(w, h), box.opacity)
    lines = said.splitlines()
    top = y + 0.36 * size - (len(lines) - 1) * IN_BOX * size / 2
    words = [
        Text(x, top + k * IN_BOX * size, text, size, box.ink, "center", opacity=box.opacity)
        for k, text in enumerate(lines)
    ]
    return [plate, *words]


def _note(note: Note, at: tuple[float, float], size: float, area: Area, margin: float) -> list[Primitive]:
    """Words that stay inside their pane: on two lines or more where there is not room for one."""
    x, y = at
    left, right = area[0] + 0.3 * margin, area[0] + area[2] - 0.3 * margin
    room = {"left": right - x, "right": x - left, "center": 2 * min(x - left, right - x)}[note.align]
    lines = wrapped(note.text, size, max(room, size))
    top = y + 0.36 * size - (len(lines) - 1) * LINE * size / 2
    return [
        Text(x, top + k * LINE * size, line, size, note.colour, note.align, opacity=note.opacity)
        for k, line in enumerate(lines)
    ]

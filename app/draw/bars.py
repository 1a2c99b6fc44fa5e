"""The bar that says what colours stand for, and the sentence of a scene: flat, over the pane, where there is room."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from app.draw.picture import Bar, Camera, Picture, Scene
from app.draw.places import meeting
from app.draw.primitives import LEAST, Area, Plate, Primitive, Text
from app.draw.type import extent, measure, wrapped
from subdivision.arrays import Floats

NUMBER, TITLE, REMARK = 23.0, 24.0, 25.0
"""Sizes of type in logical points."""

THICK, LONG, GAP, MARGIN = 20.0, 340.0, 9.0, 26.0
"""Of the bar, between it and its numbers, and from the rim of the pane, in logical points."""

PART = 0.62
"""How much of its pane the bar takes at most."""

LINE = 1.3


def drawn(scene: Scene, camera: Camera, area: Area, picture: Picture, height: float) -> list[list[Primitive]]:
    """Bar and sentence of a scene in its pane, each if there is one; the sentence stands above a bar at the foot."""
    unit = height / 1000
    found: list[list[Primitive]] = []
    if scene.bar is not None:
        beside = (area[2] - camera.aspect * area[3]) / 2
        place = _upright if beside > _needed(scene.bar, picture, unit) else _lying
        found.append(place(scene.bar, area, picture, unit))
    if scene.remark:
        remark = _remark(scene.remark, area, picture, unit)
        over = _over(rooms([remark])[:, 0], rooms(found))
        found.append([replace(line, y=line.y - over) for line in remark])
    return found


def rooms(flat: Sequence[Sequence[Primitive]]) -> Floats:
    """(4, n): left, top, right and bottom of the words and plates of each."""
    found = np.zeros((4, len(flat)))
    for k, each in enumerate(flat):
        boxes = [extent(x) if isinstance(x, Text) else (x.x, x.y, x.width, x.height)
                 for x in each if isinstance(x, Text | Plate)]  # fmt: skip
        left, top, wide, tall = np.array(boxes).T
        found[:, k] = left.min(), top.min(), (left + wide).max(), (top + tall).max()
    return found


def _over(room: Floats, others: Floats) -> float:
    """How far up a room must go to be above all that it meets."""
    left, top, right, bottom = room
    return float((bottom - others[1, meeting((left, top, right, bottom), others)]).max(initial=0.0))


def _needed(bar: Bar, picture: Picture, unit: float) -> float:
    """How much room beside the scene an upright bar needs."""
    size = _type(NUMBER, picture) * unit
    return (MARGIN + THICK + GAP) * unit + max(measure(text, size)[0] for _, text in bar.ticks)


def _type(size: float, picture: Picture) -> float:
    """In logical points, and never too small to be read."""
    return max(size * picture.scale, LEAST)


def _upright(bar: Bar, area: Area, picture: Picture, unit: float) -> list[Primitive]:
    """At the right of the pane, half way up, the most at the top; the title above it."""
    size, head = _type(NUMBER, picture) * unit, _type(TITLE, picture) * unit
    tall = min(LONG * unit, PART * area[3])
    right, top = area[0] + area[2] - MARGIN * unit, area[1] + (area[3] - tall) / 2
    numbers = max(measure(text, size)[0] for _, text in bar.ticks)
    left = right - numbers - (GAP + THICK) * unit
    n = len(bar.colours)
    found: list[Primitive] = []
    for k, colour in enumerate(reversed(bar.colours)):  # each up to the end, so that no seam shows between them
        found.append(Plate(left, top + k / n * tall, THICK * unit, (1 - k / n) * tall, colour))
    found.append(_frame(left, top, THICK * unit, tall, picture, unit))
    for at, text in bar.ticks:
        y = top + (1 - at) * tall + 0.36 * size
        found.append(Text(right - numbers, y, text, size, picture.ink, halo=picture.background))
    lines = _lines(bar.title, head, min(area[2] / 3, 9 * head))
    for k, line in enumerate(reversed(lines)):
        y = top - (1.1 + k * LINE) * head
        found.append(Text(right, y, line, head, picture.ink, "right", halo=picture.background))
    return found


def _lying(bar: Bar, area: Area, picture: Picture, unit: float) -> list[Primitive]:
    """At the bottom of a pane that is narrow, in its middle, the most at the right; the title above it."""
    size, head = _type(NUMBER, picture) * unit, _type(TITLE, picture) * unit
    wide = min(LONG * unit, PART * area[2])
    left, bottom = area[0] + (area[2] - wide) / 2, area[1] + area[3] - 0.3 * MARGIN * unit
    top = bottom - LINE * size - THICK * unit
    n = len(bar.colours)
    found: list[Primitive] = []
    for k, colour in enumerate(bar.colours):
        found.append(Plate(left + k / n * wide, top, (1 - k / n) * wide, THICK * unit, colour))
    found.append(_frame(left, top, wide, THICK * unit, picture, unit))
    for at, text in bar.ticks:
        found.append(Text(left + at * wide, bottom, text, size, picture.ink, "center", halo=picture.background))
    title = Text(area[0] + area[2] / 2, top - 0.45 * head, bar.title, head, picture.ink, "center",
                 halo=picture.background)  # fmt: skip
    return [*found, title]


def _frame(x: float, y: float, width: float, height: float, picture: Picture, unit: float) -> Plate:
    return Plate(x, y, width, height, None, picture.muted, 1.2 * unit * picture.stroke)


def _remark(words: str, area: Area, picture: Picture, unit: float) -> list[Text]:
    """At the foot of the pane."""
    size = _type(REMARK, picture) * unit
    lines = _lines(words, size, area[2] - 2 * MARGIN * unit)
    bottom = area[1] + area[3] - 0.5 * size
    return [
        Text(area[0] + area[2] / 2, bottom - (len(lines) - 1 - k) * LINE * size, line, size, picture.ink, "center",
             halo=picture.background)
        for k, line in enumerate(lines)
    ]  # fmt: skip


def _lines(words: str, size: float, width: float) -> tuple[str, ...]:
    return tuple(wrapped(words, size, max(width, size)))

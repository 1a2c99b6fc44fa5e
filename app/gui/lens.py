"""The magnifier: everything larger about a place that stays where it is, as arithmetic on areas."""

from typing import TypeAlias

from app.draw.primitives import Area

MAGNIFICATION = 2.0

Window: TypeAlias = tuple[float, float, float]
"""What of a view is seen: where its middle is, right and up in halves of the part; the part's height to the whole's."""

WHOLE: Window = 0.0, 0.0, 1.0


def enlarged(area: Area, x: float, y: float) -> Area:
    """An area, magnified about a place."""
    left, top, wide, tall = area
    m = MAGNIFICATION
    return x + m * (left - x), y + m * (top - y), m * wide, m * tall


def within(area: Area, width: float, height: float) -> Area | None:
    """The part of an area that is in sight; None where none is."""
    left, top, wide, tall = area
    x, y = max(left, 0.0), max(top, 0.0)
    right, low = min(left + wide, width), min(top + tall, height)
    return (x, y, right - x, low - y) if right - x >= 1 and low - y >= 1 else None


def window(area: Area, part: Area) -> Window:
    """Which part of a view that fills ``area`` fills ``part``."""
    left, top, wide, tall = area
    x, y, w, h = part
    return (2 * (x - left) + w - wide) / w, (2 * (top - y) + tall - h) / h, h / tall

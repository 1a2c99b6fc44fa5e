"""The flat strokes and marks a layout is made of; every painter knows these five and no more.

Coordinates are pixels from the upper left, y downwards.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from app.draw.picture import Colour, Shape
from subdivision.arrays import Floats

ANCHOR = {"left": 0.0, "center": 0.5, "right": 1.0}
"""Where in its width a text is held, by its alignment."""

RIM = 0.28
"""Width of the rim that sets type off from what lies under it, relative to the size of the type."""


@dataclass(frozen=True)
class Text:
    """Words with their baseline at ``y``; what stands between dollars is mathematics.  ``size`` in pixels."""

    x: float
    y: float
    text: str
    size: float
    colour: Colour
    align: str = "left"
    bold: bool = False
    opacity: float = 1.0
    halo: Colour | None = None


@dataclass(frozen=True)
class Plate:
    """A filled rectangle with round corners; ``stroke`` None: no outline."""

    x: float
    y: float
    width: float
    height: float
    fill: Colour | None
    stroke: Colour | None = None
    line: float = 1.0
    radius: float = 0.0
    opacity: float = 1.0


@dataclass(frozen=True)
class Stroke:
    """A straight line."""

    x0: float
    y0: float
    x1: float
    y1: float
    colour: Colour
    width: float
    opacity: float = 1.0
    dashed: bool = False


@dataclass(frozen=True)
class Mark:
    """A flat marker, as in the legend; ``size`` is its radius."""

    x: float
    y: float
    shape: Shape
    size: float
    colour: Colour
    opacity: float = 1.0


@dataclass(frozen=True, eq=False)
class Tiles:
    """Many plates of one size without outlines: ``corners`` (n, 2), the upper left ones; ``colours`` (n, 3)."""

    corners: Floats
    width: float
    height: float
    colours: Floats
    radius: float = 0.0
    opacity: float = 1.0

    def plates(self) -> Iterator[Plate]:
        """One by one."""
        for (x, y), (red, green, blue) in zip(self.corners.tolist(), self.colours.tolist(), strict=True):
            fill = red, green, blue
            yield Plate(x, y, self.width, self.height, fill, radius=self.radius, opacity=self.opacity)

    @cached_property
    def _all(self) -> tuple[bytes, bytes, float, float, float, float]:
        numbers = self.width, self.height, self.radius, self.opacity
        return np.ascontiguousarray(self.corners).tobytes(), np.ascontiguousarray(self.colours).tobytes(), *numbers

    def __eq__(self, other: object) -> bool:
        return self is other or (isinstance(other, Tiles) and self._all == other._all)

    def __hash__(self) -> int:
        return hash(self._all)


Primitive: TypeAlias = Text | Plate | Stroke | Mark | Tiles

Area: TypeAlias = tuple[float, float, float, float]
"""A pane in pixels from the upper left: x, y, width, height."""

LEAST = 1000 / 45
"""The smallest type, in logical points: thousandths of the picture's height."""


def one_by_one(flat: Iterable[Primitive]) -> Iterator[Text | Plate | Stroke | Mark]:
    """The same in the same order, where tiles are plates."""
    for each in flat:
        if isinstance(each, Tiles):
            yield from each.plates()
        else:
            yield each

"""Arrays, colours and lines of type, each kept once and called by its number."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.draw.markup import code
from app.draw.picture import Colour
from app.draw.type import measure
from app.draw.vector import traced
from subdivision.arrays import Floats, Indices

FINE = 65535
"""Places are written in so many steps from one side of the lesson's box to the other."""

EM = 100.0
"""Outlines of type are written in hundredths of its size."""

NO_COLOUR = -1


@dataclass(eq=False)
class Tables:
    """What is kept once.

    ``low`` and ``wide`` (3,) are the corner and the sides of the box that holds every point of the lesson;
    ``dark`` tells what a colour of the light theme is in the dark one.
    """

    low: Floats
    wide: Floats
    dark: dict[Colour, Colour] = field(default_factory=dict)
    blocks: list[bytes] = field(default_factory=list)
    _arrays: dict[bytes, int] = field(default_factory=dict)
    _texts: dict[tuple[str, bool], int] = field(default_factory=dict)
    _colours: dict[Colour, int] = field(default_factory=dict)

    def places(self, points: Floats) -> NDArray[np.uint16]:
        """(n, 3) places as whole steps in the box."""
        steps = (np.asarray(points, dtype=float).reshape(-1, 3) - self.low) / self.wide * FINE
        return np.asarray(np.clip(np.round(steps), 0, FINE), dtype="<u2")

    def array(self, values: NDArray[Any]) -> int:
        """The number of an array of 1-, 2- or 4-byte whole numbers or of single precision."""
        block = values.dtype.str.encode()[1:] + np.ascontiguousarray(values).tobytes()
        if block not in self._arrays:
            self._arrays[block] = len(self.blocks)
            self.blocks.append(block)
        return self._arrays[block]

    def indices(self, values: Indices) -> int:
        """The number of an array of point numbers."""
        is_small = not np.size(values) or int(np.max(values)) <= FINE
        return self.array(np.asarray(values).astype("<u2" if is_small else "<u4").ravel())

    def bytes_of(self, values: Floats) -> int:
        """The number of an array of colours."""
        return self.array(np.round(255 * np.clip(values, 0, 1)).astype("|u1").ravel())

    def colour(self, colour: Colour | None) -> int:
        """The number of a colour of the light theme."""
        return NO_COLOUR if colour is None else self._colours.setdefault(colour, len(self._colours))

    def text(self, words: str, bold: bool = False) -> int:
        """The number of a line of type."""
        return self._texts.setdefault((words, bold), len(self._texts))

    @property
    def palette(self) -> list[tuple[str, str]]:
        """Every colour in the light and in the dark theme, the same one where no theme changes it."""
        return [(code(colour), code(self.dark.get(colour, colour))) for colour in self._colours]

    @property
    def texts(self) -> list[Mapping[str, Any]]:
        """Every line of type: what it says, its room relative to its size, its outline."""
        return [
            {"says": words.replace("$", ""), "room": [round(n, 4) for n in measure(words, 1.0, bold)],
             "path": traced(words, EM, 0.0, 0.0, bold)}
            for words, bold in self._texts
        ]  # fmt: skip

"""Smooth pictures from several jagged ones, each of which is nudged by another part of a pixel.

Several samples of each pixel at once are OpenGL's own way.  VTK draws no translucent surfaces so, and a processor that
does the work of a graphics card has four samples at most and takes longer over them.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

PLACES = tuple((right / 16, up / 16) for right, up in (
    (1, -3), (-1, 3), (5, 1), (-3, -5), (-5, 5), (-7, -1), (3, 7), (7, -7),
))  # fmt: skip
"""Where in a pixel its samples are, right and up from its middle: no two of them in one column or row."""


class Mean:
    """The mean of pictures, which are added one by one."""

    def __init__(self) -> None:
        self._sum: Any = np.uint16(0)
        self._count = 0

    def add(self, picture: NDArray[np.uint8]) -> None:
        """Another picture of the same shape; of 256 there is room."""
        self._sum += picture
        self._count += 1

    def picture(self) -> NDArray[np.uint8]:
        """What those that were added are together."""
        return np.asarray((self._sum + self._count // 2) // self._count, dtype=np.uint8)

"""Places scattered over a pane, and which of them are near others, without looking at all of them."""

from dataclasses import dataclass

import numpy as np

from app.draw.primitives import Area
from subdivision.arrays import Floats, Indices, stretches

CELLS = 64
"""A pane is so many cells across and down."""


@dataclass(frozen=True, eq=False)
class Scattered:
    """Places ``at`` (n, 2): those in cell k of the pane are ``order[first[k] : first[k + 1]]``."""

    area: Area
    at: Floats
    order: Indices
    first: Indices

    def near(self, left: Floats, top: Floats, right: Floats, bottom: Floats) -> tuple[Indices, Indices]:
        """Pairs of a room and a place: all that are in it, and some that are near."""
        if not len(self.at):
            return np.zeros(0, dtype=np.intp), np.zeros(0, dtype=np.intp)
        x, y, w, h = self.area
        room, row = _all_from(_cells(top, y, h), _cells(bottom, y, h) + 1)
        before = row * CELLS
        start = self.first[before + _cells(left, x, w)[room]]
        stop = self.first[before + _cells(right, x, w)[room] + 1]
        strip, k = _all_from(start, stop)
        return room[strip], self.order[k]


def scattered(at: Floats, area: Area) -> Scattered:
    """The places, those outside the pane in the cells at its rim."""
    x, y, w, h = area
    cells = _cells(at[:, 1], y, h) * CELLS + _cells(at[:, 0], x, w)
    order = np.argsort(cells, kind="stable")
    return Scattered(area, at, order, np.searchsorted(cells[order], np.arange(CELLS * CELLS + 1)))


def _cells(at: Floats, start: float, size: float) -> Indices:
    """In which column, or row, each of the coordinates is."""
    return np.minimum(np.maximum((at - start) * (CELLS / size), 0), CELLS - 1).astype(np.intp)


def _all_from(start: Indices, stop: Indices) -> tuple[Indices, Indices]:
    """Every number from each ``start`` to before its ``stop``, after the number of the pair it is of."""
    counts = stop - start
    owner = np.repeat(np.arange(len(counts)), counts)
    return owner, stretches(start, counts)

"""The matrices of a step: every stage's factor, their product, and the row of the point that is pointed at.

A mark for every weight that is not zero, the darker the heavier.  The product stands first, then its
factors, the last stage first, as they are written: M = M3 M2 M1.
"""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from scipy.sparse import csr_array

from app.draw.picture import Box, Diagram, Note, Squares
from app.draw.theme import Theme, mixed
from app.state import Spot
from subdivision import Step, Trace
from subdivision.arrays import Floats, Indices
from subdivision.words import phrase

MOST = 4000
"""More marks than this are a grey plane."""

GAP, HEAD, TITLE = 0.08, 0.08, 0.6
"""Between matrices, above each of them for its name, and room for that name, relative to the largest."""

PANE = 0.9
"""Width to height of the pane they are meant for."""

PALEST = 0.25
"""The lightest mark, relative to the heaviest."""


def matrices(trace: Trace, at: float, theme: Theme, spot: Spot | None) -> Diagram:
    """The step that is under way, or just over, at stage position ``at``."""
    k = min(max(int(np.ceil(at)), 1), len(trace.stages))
    begin = trace.begins(trace.levels[k - 1])
    stages = trace.stages[begin:k]
    factors = [stage.matrix for stage in reversed(stages)]
    product = _product(trace, begin, k)
    shown = [product, *factors] if len(factors) > 1 else factors
    names = [stage.name for stage in reversed(stages)]
    titles = [phrase("product"), *names] if len(factors) > 1 else names
    if sum(m.nnz for m in shown) > MOST:
        words = phrase("{n:,} weights: too many to tell apart. Go to a lower level.", n=sum(m.nnz for m in shown))
        return Diagram((-6, -2, 6, 2), notes=(Note(0, 0, words, theme.muted, "center"),))
    rows = _rows(trace, begin, k, spot, len(factors) > 1)
    return _drawn(shown, titles, rows, [k, *range(k, begin, -1)] if len(factors) > 1 else [k], theme)


@lru_cache(maxsize=16)
def _product(trace: Trace, begin: int, k: int) -> csr_array:
    return Step(trace.stages[begin:k]).matrix


def _rows(trace: Trace, begin: int, k: int, spot: Spot | None, with_product: bool) -> list[Indices]:
    """For each matrix shown, the rows that the point in focus needs."""
    if spot is None or spot.stage != k:
        return [np.zeros(0, dtype=np.intp)] * (k - begin + with_product)
    needed = [np.array([spot.point])]
    for stage in reversed(trace.stages[begin + 1 : k]):
        needed.append(np.unique(stage.matrix[needed[-1]].indices))
    return [needed[0], *needed] if with_product else needed


def _drawn(
    shown: Sequence[csr_array], titles: Sequence[str], rows: Sequence[Indices], stages: Sequence[int], theme: Theme
) -> Diagram:
    """Matrices on as many shelves as make them largest, all in one scale."""
    places, (wide, tall) = _shelved([(m.shape[1], m.shape[0]) for m in shown])
    head = HEAD * max(wide, tall)
    boxes: list[Box] = []
    squares: list[Squares] = []
    notes: list[Note] = []
    for matrix, title, lit, stage, (x, y) in zip(shown, titles, rows, stages, places, strict=True):
        height, width = matrix.shape
        middle = x + width / 2, y + height / 2
        frame = Box(*middle, ("",), theme.background, theme.ink, theme.muted, width + 1, height + 1, line=1.2)
        boxes.append(frame)
        boxes.extend(_strip(x, y, width, int(row), theme) for row in lit)
        squares.append(_marks(matrix, (x, y), stage, lit, theme))
        notes.append(
            Note(
                x - 0.5,
                y - 0.55 * head,
                phrase("{title}  {height}×{width}", title=title, height=height, width=width),
                theme.muted,
            )
        )
    room = -1.0, -head, wide + 1.0, tall + 1.0
    return Diagram(room, tuple(boxes), (), tuple(notes), largest=26.0, squares=tuple(squares))


def _shelved(sizes: Sequence[tuple[int, int]]) -> tuple[list[tuple[float, float]], tuple[float, float]]:
    """Upper left corners of boxes (width, height) in reading order, and the room they take together."""
    found = [_on_shelves(sizes, width) for width in _widths(sizes)]
    return min(found, key=lambda one: max(one[1][0] / PANE, one[1][1]))


def _widths(sizes: Sequence[tuple[int, int]]) -> list[float]:
    """Widths of a shelf at which another box more fits on the first one."""
    return [float(sum(w for w, _ in sizes[: k + 1])) * (1 + GAP) + 1 for k in range(len(sizes))]


def _on_shelves(
    sizes: Sequence[tuple[int, int]], width: float
) -> tuple[list[tuple[float, float]], tuple[float, float]]:
    largest = max(max(size) for size in sizes)
    gap, head = GAP * largest, HEAD * 2 * largest
    places: list[tuple[float, float]] = []
    x = y = deepest = widest = 0.0
    for w, h in sizes:
        slot = max(w, TITLE * largest)
        if x and x + w > max(width, largest):
            x, y, deepest = 0.0, y + deepest + head, 0.0
        places.append((x, y))
        x, deepest, widest = x + slot + gap, max(deepest, h), max(widest, x + slot)
    return places, (widest, y + deepest)


def _strip(x: float, y: float, width: int, row: int, theme: Theme) -> Box:
    fill = mixed(theme.background, theme.selection, 0.3)
    return Box(x + width / 2, y + row + 0.5, ("",), fill, theme.ink, fill, width + 1.0, 1.0, line=0.0)


def _marks(matrix: csr_array, at: tuple[float, float], stage: int, lit: Indices, theme: Theme) -> Squares:
    entries = matrix.tocoo()
    weights: Floats = np.abs(entries.data) / max(float(np.abs(entries.data).max(initial=0.0)), 1e-300)
    ink = np.where(np.isin(entries.row, lit)[:, None], theme.selection, theme.ink)
    shade = (PALEST + (1 - PALEST) * weights)[:, None]
    places = np.stack([at[0] + entries.col + 0.5, at[1] + entries.row + 0.5], axis=1)
    return Squares(places, (1 - shade) * theme.background + shade * ink, np.asarray(entries.row, dtype=np.intp), stage)

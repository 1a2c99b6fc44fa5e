"""The vector set of a box spline as a picture: arrows on the integer lattice, what they promise, and their mask."""

from collections import Counter
from collections.abc import Iterator
from math import lcm

from app.draw.picture import Box, Diagram, Link, Note
from app.draw.theme import Theme, mixed
from subdivision.continuity import Mask, alpha, degree, mask, smoothness
from subdivision.passes import Vector
from subdivision.words import phrase

ARROW, RULE, AXIS = 4.5, 1.4, 2.4
"""Strokes in logical points: an arrow, a line of the lattice, an axis."""

AROUND, BETWEEN = 0.9, 2.6
"""Cells above and beside the lattice, and between it and the mask."""

PALEST, DARKEST = 0.10, 0.42
"""How much ink the lightest and the heaviest coefficient have behind them."""

OFF = 0.36
"""How far right or left, up or down, of an arrow's tip the number is that says how often it is there."""

LEAST = 2
"""The lattice goes at least so far each way."""


def lattice(vectors: tuple[Vector, ...], theme: Theme) -> Diagram:
    """The arrows, a line of facts below them, and the mask below that: s to the right, t upwards in both."""
    far = max(LEAST, *(abs(x) for v in vectors for x in v))
    table = mask(vectors)
    rows, columns = len(table.rows[0]), len(table.rows)
    top, side = far + BETWEEN, min(1.0, (2 * far + 1) / max(rows, columns))
    right = far + AROUND
    return Diagram(
        (-right, -far - AROUND, right, top + side * rows + 0.2),
        tuple(_boxes(table, top, side, theme)),
        (*_ruled(far, theme), *_arrows(vectors, theme)),
        (*_axes(far, theme), *_counted(vectors, theme), *_facts(vectors, table, far, theme)),
        largest=110.0,
    )


def over_one(table: Mask) -> tuple[list[list[int]], int]:
    """The coefficients of a mask over their least common denominator, as they are drawn: t downwards from the top."""
    below = lcm(*(c.denominator for row in table.rows for c in row))
    upwards = zip(*table.rows, strict=True)
    return [[int(c * below) for c in row] for row in reversed(list(upwards))], below


def shade(count: int, heaviest: int) -> float:
    """How much ink there is behind a coefficient: none behind 0."""
    return PALEST + (DARKEST - PALEST) * count / heaviest if count else 0.0


def facts(vectors: tuple[Vector, ...]) -> str:
    """Degree, alpha and continuity in a few words."""
    k = smoothness(vectors)
    continuity = f"$C^{{{k}}}$" if k >= 0 else "the limit jumps"
    return phrase(
        "degree {degree}    alpha {alpha}    {continuity}",
        degree=degree(vectors),
        alpha=alpha(vectors),
        continuity=continuity,
    )


def _ruled(far: int, theme: Theme) -> Iterator[Link]:
    """The lines of the lattice."""
    end = far + 0.4
    for k in range(-far, far + 1):
        colour, width = (theme.net, AXIS) if k == 0 else (theme.faint, RULE)
        yield Link(k, -end, k, end, colour, width=width)
        yield Link(-end, k, end, k, colour, width=width)


def _arrows(vectors: tuple[Vector, ...], theme: Theme) -> Iterator[Link]:
    """One arrow for each vector; a long one lies under those that are shorter."""
    for a, b in sorted(set(vectors), key=lambda v: -(v[0] ** 2 + v[1] ** 2)):
        yield Link(0, 0, a, -b, theme.ink, width=ARROW, is_arrow=True)


def _axes(far: int, theme: Theme) -> tuple[Note, ...]:
    return Note(far + 0.65, 0, "s", theme.muted, "center"), Note(0, -far - 0.65, "t", theme.muted, "center")


def _counted(vectors: tuple[Vector, ...], theme: Theme) -> Iterator[Note]:
    """How often a vector is there, beyond its tip and between the lines."""
    for (a, b), times in Counter(vectors).items():
        if times > 1:
            right, up = (a >= 0) - (a < 0), (b > 0) - (b <= 0)
            yield Note(a + OFF * right, -b - OFF * up, f"×{times}", theme.ink, "center")


def _facts(vectors: tuple[Vector, ...], table: Mask, far: int, theme: Theme) -> tuple[Note, ...]:
    below = over_one(table)[1]
    every = phrase("mask, every box ×\u00a01/{below}", below=below) if below > 1 else "mask"
    return (
        Note(0, far + 1.1, facts(vectors), theme.ink, "center"),
        Note(0, far + BETWEEN - 0.5, every, theme.muted, "center"),
    )


def _boxes(table: Mask, top: float, side: float, theme: Theme) -> Iterator[Box]:
    """The mask; where it is 0 a box is empty."""
    rows, _ = over_one(table)
    heaviest = max(max(row) for row in rows)
    left = -side * len(rows[0]) / 2
    for j, row in enumerate(rows):
        for i, count in enumerate(row):
            yield Box(
                left + side * (i + 0.5), top + side * (j + 0.5), (str(count) if count else "",),
                mixed(theme.background, theme.muted, shade(count, heaviest)), theme.ink, theme.faint,
                0.94 * side, 0.94 * side, line=RULE,
            )  # fmt: skip

"""Diagrams of coefficients: the pyramid of a polygon, the array of a net.

Every box is a row of the matrix of the stages so far, read exactly; the boxes fill as the stage
plays, in step with the same stage in space.  The point in focus and those it is made of are lit.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import ceil, lcm
from typing import TypeAlias

import numpy as np

from app.draw.motion import eased
from app.draw.picture import Box, Colour, Diagram, Link, Note
from app.draw.theme import Theme, mixed
from app.state import Spot
from subdivision import Connectivity, Grid, Polyline, Role, Stage, Step, Trace
from subdivision.arrays import Floats
from subdivision.exact import spelled
from subdivision.passes import as_grid
from subdivision.stage import Stencil
from subdivision.words import phrase

WIDE, TALL, FLAT = 0.94, 0.84, 0.72
"""Width of a box, its height in an array, and in a pyramid, where strokes need room: in cells."""

SHAPE_OF_ROWS, SHAPE_OF_ARRAYS = (0.8, 1.8), (0.9, 2.2)
"""Least and most width to height of the cells of a pyramid, and of an array."""

LARGEST = 122.0
"""Height of a cell of an array, at most, in logical points."""

TINT = 0.24
"""How much of a role's colour fills its box."""

DIM = 0.5
"""How bright the ancestors further back than the parents are."""

LINE, GLOW = 2.0, 4.5
"""Width of a stroke in logical points, and how much wider a lit one is."""

BLANK, GAP, NONE = "\u2007", "\u2002", "·"
"""In a table: a space as wide as a figure, the one between columns, and a point that does not contribute."""

Light: TypeAlias = Mapping[tuple[int, int], float]
"""How bright a point is, by the number of stages done and its own: 0..1."""


@dataclass(frozen=True, eq=False)
class _Told:
    """What a diagram is drawn of: the stages of one step, which ``begin`` stages into the trace."""

    control: Connectivity
    stages: tuple[Stage, ...]
    begin: int
    light: Light
    theme: Theme


def diagram(trace: Trace, at: float, theme: Theme, focus: Spot | None = None) -> Diagram:
    """The step under way at stage position ``at``, as boxes; the one in ``focus`` and its ancestors are lit."""
    k = min(int(at), len(trace.stages) - 1)
    level = trace.levels[k if at > k else max(k - (at == k and k > 0), 0)]
    begin = trace.begins(level)
    told = _Told(trace.topology_at(begin), trace.step(level).stages, begin, lights(trace, focus), theme)
    if isinstance(told.control, Grid):
        return _array(told, eased(at) - begin)
    if isinstance(told.control, Polyline):
        return _pyramid(told, eased(at) - begin)
    raise TypeError("only polygons and nets have a diagram of coefficients")


def lights(trace: Trace, focus: Spot | None) -> Light:
    """1 for the point in focus and its parents, less for the ancestors further back, to the start of their step."""
    if focus is None or not 0 <= focus.point < len(trace.roles_at(focus.stage)):
        return {}
    found = {(focus.stage, focus.point): 1.0}
    points, begin = [focus.point], trace.begins(trace.levels[max(focus.stage - 1, 0)])
    for k in reversed(range(begin, focus.stage)):
        points = sorted({int(parent) for p in points for parent in trace.stages[k].stencil(p).parents})
        found |= {(k, p): 1.0 if k == focus.stage - 1 else DIM for p in points}
    return found


@lru_cache(maxsize=64)
def rows(stages: tuple[Stage, ...]) -> tuple[tuple[Stencil, ...], int]:
    """Every row of the product of some stages, exact, and the least common denominator of their weights."""
    step = Step(stages)
    found = tuple(step.stencil(i) for i in range(stages[-1].n_points))
    return found, lcm(*(w.denominator for s in found for _, w in s.terms if isinstance(w, Fraction)))


def times(below: int) -> str:
    """What every box is multiplied with; no line breaks in it."""
    return f"×\u00a01/{below}" if below > 1 else ""


def tinted(colour: Colour, theme: Theme, part: float = TINT) -> Colour:
    """A colour thinned with the background."""
    return mixed(theme.background, colour, part)


# -- what a box says --------------------------------------------------------------------------


def row_texts(stencil: Stencil, below: int) -> tuple[str, ...]:
    """``below`` times a row over a polygon: the sum in one to three lines, then its coefficients alone."""
    terms = _sorted(stencil, below)
    sums = [_summed(_parts(terms, n), _point) for n in (1, 2, 3)]
    counts = [_counted(_parts(terms, n)) for n in (1, 2, 3)]
    return *sums, *counts


def block_texts(stencil: Stencil, below: int, grid: Grid) -> tuple[str, ...]:
    """``below`` times a row over a net: the sum, a line for each t; its coefficients as a table; which they are."""
    terms = _sorted(stencil, below)
    across = sorted(terms, key=lambda term: (term[0] % grid.n_t, term[0]))
    lines = [[term for term in across if term[0] % grid.n_t == j] for j in sorted({p % grid.n_t for p, _ in across})]
    broken = [[term] for term in across] if len(lines) == 1 else lines
    different = sorted({count for _, count in terms}, key=float, reverse=True)
    tersest = " ".join(map(_spelled, different))
    sums = [_summed(each, _named(grid)) for each in (lines, broken)]
    return *sums, _table(dict(terms), grid), tersest


@lru_cache(maxsize=64)
def _blocks(stages: tuple[Stage, ...], below: int, grid: Grid) -> tuple[tuple[str, ...], ...]:
    """``block_texts`` of every row of the product of some stages of a net; of none, of its own points."""
    stencils = rows(stages)[0] if stages else _unmoved(grid.n_vertices)
    return tuple(block_texts(each, below, grid) for each in stencils)


@lru_cache(maxsize=64)
def _sums(stages: tuple[Stage, ...]) -> tuple[tuple[str, ...], ...]:
    """``row_texts`` of every row of the product of some stages of a polygon."""
    stencils, below = rows(stages)
    return tuple(row_texts(each, below) for each in stencils)


@lru_cache(maxsize=64)
def _parents(stage: Stage) -> tuple[tuple[int, ...], ...]:
    """For every point of a stage those it is an average of, across no seam."""
    found = [[int(p) for p in stage.stencil(i).parents] for i in range(stage.n_points)]
    return tuple(tuple(p for p in parents if abs(p - i) <= 1) for i, parents in enumerate(found))


Terms: TypeAlias = Sequence[tuple[int, Fraction | float]]
"""Point numbers and how often each counts."""


def _sorted(stencil: Stencil, below: int) -> list[tuple[int, Fraction | float]]:
    counts = [(p, w * below) for p, w in stencil.terms]
    return sorted((p, c if isinstance(c, Fraction) else float(c)) for p, c in counts)


def _parts(terms: Terms, n: int) -> list[Terms]:
    """The terms in ``n`` lines or fewer, the longer ones first."""
    size = ceil(len(terms) / n)
    return [terms[k : k + size] for k in range(0, len(terms), size)]


def _summed(lines: Sequence[Terms], name: Callable[[int], str]) -> str:
    """``3P_0+P_1`` where points count 3 and 1; every line but the first begins with its plus."""
    plus = "{+}"  # braces take the wide spaces off an operator
    sums = [plus.join(f"{_spelled(c) if c != 1 else ''}{name(p)}" for p, c in line) for line in lines]
    return "\n".join(f"${plus if k else ''}{line}$" for k, line in enumerate(sums))


def _counted(lines: Sequence[Terms]) -> str:
    return "\n".join(" ".join(_spelled(c) for _, c in line) for line in lines)


def _table(counts: Mapping[int, Fraction | float], grid: Grid) -> str:
    """The coefficients where their points stand in the net: s to the right, t upwards."""
    columns = sorted({p // grid.n_t for p in counts})
    lines = sorted({p % grid.n_t for p in counts}, reverse=True)
    words = [[_spelled(counts[p]) if (p := i * grid.n_t + j) in counts else NONE for i in columns] for j in lines]
    widths = [max(len(line[k]) for line in words) for k in range(len(columns))]
    return "\n".join(GAP.join(w.rjust(n, BLANK) for w, n in zip(line, widths, strict=True)) for line in words)


def _spelled(count: Fraction | float) -> str:
    return spelled(count) if isinstance(count, Fraction) else f"{count:.3g}"


def _point(i: int) -> str:
    return f"P_{{{i}}}"


def _named(grid: Grid) -> Callable[[int], str]:
    return lambda k: f"P_{{{k // grid.n_t}{k % grid.n_t}}}"


# -- pyramids ---------------------------------------------------------------------------------


def _pyramid(told: _Told, at: float) -> Diagram:
    """The split row at the bottom, every averaging row above it, half a box further right."""
    boxes: list[Box] = []
    links: list[Link] = []
    notes: list[Note] = []
    if at == 0:
        boxes = [_control(told, i, (2 * i + 0.5, 0.0), _point, FLAT) for i in range(told.control.n_vertices)]
    for k in range(ceil(at)):
        shown = _filled(told.stages[k].n_points, at - k) if k else np.ones(told.stages[k].n_points)
        boxes.extend(_row(told, k, at, shown))
        links.extend(_strokes(told, k, shown))
        every = times(rows(told.stages[: k + 1])[1])
        name = phrase("average\u00a0{k}, {times}", k=k, times=every) if k else "split"
        notes.append(Note(k / 2 - 0.6, -k, name, told.theme.muted, "right", float(shown[0])))
    cells = (-1.6, 0.5 - len(told.stages), told.stages[0].n_points - 0.45, 0.5)
    links.sort(key=lambda link: link.width)  # what is lit lies over the rest
    return Diagram(cells, tuple(boxes), tuple(links), tuple(notes), shape=SHAPE_OF_ROWS)


def _row(told: _Told, k: int, at: float, shown: Floats) -> list[Box]:
    """The boxes of stage ``k``; the copies of a point slide apart while it is split."""
    stage, said = told.stages[k], _sums(told.stages[: k + 1])
    slide = 0.0 if k else 1 - min(at, 1.0)
    found = []
    for i in range(stage.n_points):
        x = i + k / 2 + slide * (2 * int(stage.carries[i]) + 0.5 - i)
        found.append(_box(told, (x, -k), said[i], Role(stage.roles[i]), k + 1, i, float(shown[i]), FLAT, k))
    return found


def _strokes(told: _Told, k: int, shown: Floats) -> list[Link]:
    """From the boxes of row ``k`` down to those they average (not across the seam of a closed polygon)."""
    if k == 0:
        return []
    found = []
    for i, parents in enumerate(_parents(told.stages[k])):
        for p in parents:
            colour, line = _lit(told, min(_glow(told, k + 1, i), _glow(told, k, p)), told.theme.muted)
            x, below = i + k / 2, p + (k - 1) / 2
            found.append(Link(x, FLAT / 2 - k, below, 1 - k - FLAT / 2, colour, float(shown[i]), line))
    return found


# -- arrays -----------------------------------------------------------------------------------


def _array(told: _Told, at: float) -> Diagram:
    """The net as it stands: s to the right, t upwards; boxes slide from the box they continue."""
    k = max(ceil(at) - 1, 0)
    grid, stages, t = as_grid(told.control), told.stages[: k + 1], at - k
    if at == 0:
        boxes = [_control(told, i, (x, y), _named(grid), TALL) for i, (x, y) in enumerate(_places(grid).tolist())]
    else:
        boxes = _sliding(told, stages, t)
    old = as_grid(stages[-2].topology if k else grid).shape
    new = as_grid(stages[-1].topology).shape
    w, h = ((1 - t) * before + t * after for before, after in zip(old, new, strict=True))
    below = rows(stages)[1] if at else 1
    extent = (-w / 2 - 0.05, -h / 2 - 0.05, w / 2 + 0.05, h / 2 + 0.45)
    return Diagram(extent, tuple(boxes), (), (_compass(h, below, told.theme),), (), LARGEST, SHAPE_OF_ARRAYS)


def _compass(height: float, below: int, theme: Theme) -> Note:
    """Which way s and t run, and what every box is multiplied with."""
    way = "s →   t ↑"
    words = phrase("every box {times}     {way}", times=times(below), way=way) if below > 1 else way
    return Note(0, height / 2 + 0.22, words, theme.muted, "center")


def _sliding(told: _Told, stages: tuple[Stage, ...], t: float) -> list[Box]:
    """The boxes of the last stage, ``t`` of it done: each slides over, and says its new sum from the middle on."""
    *earlier, stage = stages
    grid, done = as_grid(told.control), len(stages)
    new, old = _places(stage.topology), _places(earlier[-1].topology if earlier else grid)
    below = rows(stages)[1]
    after, before = _blocks(stages, below, grid), _blocks(tuple(earlier), below, grid)
    roles = earlier[-1].roles if earlier else np.zeros(len(old), dtype=np.intp)
    shown = _filled(stage.n_points, t)
    boxes = []
    for i, source in enumerate(stage.carries):
        if source < 0:
            place, opacity = new[i], shown[i]
        else:
            place = (1 - t) * old[source] + t * new[i]
            opacity = abs(2 * shown[i] - 1) if stage.moves else 1.0
        if shown[i] >= 0.5 or source < 0:
            texts, role = after[i], Role(stage.roles[i])
        else:
            texts, role = before[source], Role(roles[source])
        boxes.append(_box(told, (float(place[0]), float(place[1])), texts, role, done, i, float(opacity), TALL))
    return boxes


def _unmoved(n: int) -> tuple[Stencil, ...]:
    return tuple(Stencil(i, ((i, Fraction(1)),)) for i in range(n))


def _places(net: Connectivity) -> Floats:
    """(n, 2): the cell of every point of a net, the net centred."""
    grid = as_grid(net)
    i, j = np.divmod(np.arange(grid.n_vertices), grid.n_t)
    return np.stack([i - (grid.n_s - 1) / 2, (grid.n_t - 1) / 2 - j], axis=1)


# -- boxes ------------------------------------------------------------------------------------


def _filled(n: int, t: float) -> Floats:
    """(n,) opacities in 0..1: boxes appear one after the other while ``t`` runs from 0 to 1."""
    soft = max(3.0, n / 4)
    filled: Floats = np.clip((min(t, 1.0) * (n + soft) - np.arange(n)) / soft, 0, 1)
    return filled


def _control(told: _Told, i: int, place: tuple[float, float], name: Callable[[int], str], height: float) -> Box:
    return _box(told, place, (f"${name(i)}$",), Role.ORIGINAL, 0, i, 1.0, height)


def _box(
    told: _Told,
    place: tuple[float, float],
    texts: tuple[str, ...],
    role: Role,
    done: int,
    point: int,
    opacity: float,
    height: float,
    group: int = 0,
) -> Box:
    """The box of a point after ``done`` stages of the step."""
    colour = told.theme.roles[role] if role is not Role.ORIGINAL else told.theme.muted
    stroke, line = _lit(told, _glow(told, done, point), colour)
    return Box(
        *place, texts, tinted(colour, told.theme), told.theme.ink, stroke, WIDE, height,
        opacity=opacity, point=point, stage=told.begin + done, group=group, line=line,
    )  # fmt: skip


def _glow(told: _Told, done: int, point: int) -> float:
    return told.light.get((told.begin + done, point), 0.0)


def _lit(told: _Told, glow: float, colour: Colour) -> tuple[Colour, float]:
    """Colour and width of a stroke that is lit so brightly."""
    return mixed(colour, told.theme.selection, glow), LINE + GLOW * glow

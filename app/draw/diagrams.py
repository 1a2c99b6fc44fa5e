"""Diagrams of coefficients: the pyramid of a polygon, the array of a net.

Every box is a row of the matrix of the stages so far, read exactly; the boxes fill as the stage
plays, in step with the same stage in space.
"""

from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache
from math import lcm

import numpy as np

from app.draw.motion import eased
from app.draw.picture import Box, Colour, Diagram, Link, Note
from app.draw.theme import Theme
from app.state import Spot
from subdivision import Connectivity, Grid, Polyline, Role, Stage, Step, Trace
from subdivision.arrays import Floats
from subdivision.exact import spelled
from subdivision.passes import as_grid
from subdivision.stage import Stencil

PITCH = 0.82
"""From one row of a pyramid to the next, in cells."""

FLAT = 0.52
"""Height of a pyramid's boxes, in cells."""

THREE = 3
"""Sums of more terms are written in two lines."""

TINT = 0.24
"""How much of a role's colour fills its box."""


def diagram(trace: Trace, at: float, theme: Theme, focus: Spot | None = None) -> Diagram:
    """The step under way at stage position ``at``, as boxes; those that a box in ``focus`` is made of are lit."""
    k = min(int(at), len(trace.stages) - 1)
    level = trace.levels[k if at > k else max(k - (at == k and k > 0), 0)]
    begin = trace.begins(level)
    stages = trace.step(level).stages
    return drawn(trace.topology_at(begin), stages, eased(at) - begin, theme)


def drawn(control: Connectivity, stages: tuple[Stage, ...], at: float, theme: Theme) -> Diagram:
    """The stages of one step, ``at`` of them done."""
    if isinstance(control, Grid):
        return _array(control, stages, at, theme)
    if isinstance(control, Polyline):
        return _pyramid(control, stages, at, theme)
    raise TypeError("only polygons and nets have a diagram of coefficients")


def combination(stencil: Stencil, name: Callable[[int], str], below: int) -> str:
    """``below`` times a row, as mathematics: ``3P_0+P_1`` where the weights are 3/4 and 1/4; long ones in two lines."""
    words: list[str] = []
    for p, w in sorted(stencil.terms, key=lambda term: term[0]):
        count = w * below
        words.append(name(p) if count == 1 else f"{count}{name(p)}" if isinstance(count, Fraction) else spelled(count))
    half = len(words) if len(words) <= THREE else -(-len(words) // 2)
    plus = "{+}"  # braces take the wide spaces off an operator
    lines = [plus.join(words[:half]), plus.join(["", *words[half:]])]
    return "\n".join(f"${line}$" for line in lines if line)


@lru_cache(maxsize=64)
def rows(stages: tuple[Stage, ...]) -> tuple[tuple[Stencil, ...], int]:
    """Every row of the product of some stages, exact, and the least common denominator of their weights."""
    step = Step(stages)
    found = tuple(step.stencil(i) for i in range(stages[-1].n_points))
    return found, lcm(*(w.denominator for s in found for _, w in s.terms if isinstance(w, Fraction)))


def times(below: int) -> str:
    """What every box is multiplied with."""
    return f"× 1/{below}" if below > 1 else ""


def tinted(colour: Colour, theme: Theme) -> Colour:
    """A colour thinned with the background."""
    r, g, b = (TINT * c + (1 - TINT) * w for c, w in zip(colour, theme.background, strict=True))
    return r, g, b


def _pyramid(control: Polyline, stages: tuple[Stage, ...], at: float, theme: Theme) -> Diagram:
    """The split row at the bottom, every averaging row above it, half a box further right."""
    boxes: list[Box] = []
    links: list[Link] = []
    notes: list[Note] = []
    if at == 0:
        boxes = [
            _box(2 * i + 0.5, 0, f"${_point(i)}$", Role.ORIGINAL, theme, 1.0, i, FLAT)
            for i in range(control.n_vertices)
        ]
    for k, stage in enumerate(stages[: int(np.ceil(at))]):
        shown = _filled(stage.n_points, at - k) if k else np.ones(stage.n_points)
        stencils, below = rows(stages[: k + 1])
        for i in range(stage.n_points):
            x, y = i + k / 2, -PITCH * k
            if k == 0:  # the copies of a point slide apart
                x = i + (1 - min(at, 1.0)) * (2 * int(stage.carries[i]) + 0.5 - i)
            boxes.append(
                _box(x, y, combination(stencils[i], _point, below), Role(stage.roles[i]), theme, shown[i], i, FLAT)
            )
            if k:
                links.extend(_parents(stage, i, k, shown[i], theme))
        notes.append(Note(k / 2 - 0.65, -PITCH * k, _row_name(k, below), theme.muted, "right", float(shown[0])))
    widest, tall = stages[0].n_points, PITCH * (len(stages) - 1)
    return Diagram((-1.75, -tall - FLAT, widest - 0.4, FLAT), tuple(boxes), tuple(links), tuple(notes))


def _row_name(k: int, below: int) -> str:
    return f"average {k} {times(below)}" if k else "split"


def _parents(stage: Stage, i: int, k: int, opacity: float, theme: Theme) -> list[Link]:
    """Strokes from a box down to the boxes it averages (not across the seam of a closed polygon)."""
    below = [int(p) for p in stage.stencil(i).parents if abs(int(p) - i) <= 1]
    x, y = i + k / 2, -PITCH * k
    return [Link(x, y + FLAT / 2, p + (k - 1) / 2, y + PITCH - FLAT / 2, theme.muted, opacity) for p in below]


def _array(control: Grid, stages: tuple[Stage, ...], at: float, theme: Theme) -> Diagram:
    """The net as it stands: s to the right, t upwards; boxes slide from the box they continue."""
    largest = max(
        (s.topology.shape for s in stages if isinstance(s.topology, Grid)), key=lambda shape: shape[0] * shape[1]
    )
    w, h = max(largest[0], control.n_s), max(largest[1], control.n_t)
    extent = (-w / 2 - 0.1, -h / 2 - 0.1, w / 2 + 0.1, h / 2 + 0.45)
    k = max(int(np.ceil(at)) - 1, 0)
    if at == 0:
        start = _places(control)
        names = [_named(control)(i) for i in range(control.n_vertices)]
        boxes = [
            _box(x, y, f"${n}$", Role.ORIGINAL, theme, 1.0, i)
            for i, ((x, y), n) in enumerate(zip(start, names, strict=True))
        ]
        return Diagram(extent, tuple(boxes), (), (_compass(h, 1, theme),))
    boxes = _sliding(control, stages[: k + 1], at - k, theme)
    return Diagram(extent, tuple(boxes), (), (_compass(h, rows(stages[: k + 1])[1], theme),))


def _compass(height: int, below: int, theme: Theme) -> Note:
    """Which way s and t run, and what every box is multiplied with."""
    scale = f"every box {times(below)}     " if below > 1 else ""
    return Note(0, height / 2 + 0.25, scale + "s →   t ↑", theme.muted, "center")


def _sliding(control: Grid, stages: tuple[Stage, ...], t: float, theme: Theme) -> list[Box]:
    """The boxes of the last stage, ``t`` of it done: each slides over, and says its new sum from the middle on."""
    *earlier, stage = stages
    new, old = _places(stage.topology), _places(earlier[-1].topology if earlier else control)
    stencils, below = rows(stages)
    before = rows(tuple(earlier))[0] if earlier else tuple(Stencil(i, ((i, Fraction(1)),)) for i in range(len(old)))
    roles = earlier[-1].roles if earlier else np.zeros(len(old), dtype=np.intp)
    shown = _filled(stage.n_points, t)
    boxes = []
    for i, source in enumerate(stage.carries):
        x, y = (1 - t) * old[source] + t * new[i]
        done = shown[i] >= 0.5
        stencil, role = (stencils[i], stage.roles[i]) if done else (before[source], roles[source])
        opacity = float(abs(2 * shown[i] - 1)) if stage.moves else 1.0
        text = combination(stencil, _named(control), below)
        boxes.append(_box(float(x), float(y), text, Role(role), theme, opacity, i))
    return boxes


def _places(net: Connectivity) -> Floats:
    """(n, 2): the cell of every point of a net, the net centred."""
    grid = as_grid(net)
    i, j = np.divmod(np.arange(grid.n_vertices), grid.n_t)
    return np.stack([i - (grid.n_s - 1) / 2, (grid.n_t - 1) / 2 - j], axis=1)


def _filled(n: int, t: float) -> Floats:
    """(n,) opacities in 0..1: boxes appear one after the other while ``t`` runs from 0 to 1."""
    soft = max(3.0, n / 4)
    filled: Floats = np.clip((min(t, 1.0) * (n + soft) - np.arange(n)) / soft, 0, 1)
    return filled


def _box(
    x: float, y: float, text: str, role: Role, theme: Theme, opacity: float, point: int, height: float = 0.72
) -> Box:
    colour = theme.roles[role] if role is not Role.ORIGINAL else theme.muted
    tint = tinted(colour, theme)
    return Box(x, y, (text,), tint, theme.ink, colour, 0.94, height, opacity=float(opacity), point=point)


def _point(i: int) -> str:
    return f"P_{{{i}}}"


def _named(grid: Grid) -> Callable[[int], str]:
    return lambda k: f"P_{{{k // grid.n_t}{k % grid.n_t}}}"

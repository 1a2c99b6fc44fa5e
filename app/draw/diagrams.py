"""Diagrams of coefficients: the pyramid of a polygon, the array of a net.

Every box is a row of the matrix of the stages so far, read exactly; the boxes fill as the stage
plays, in step with the same stage in space.
"""

from collections.abc import Callable
from fractions import Fraction
from math import lcm

import numpy as np

from app.draw.motion import eased
from app.draw.picture import Box, Colour, Diagram, Link, Note
from app.draw.theme import Theme
from subdivision import Connectivity, Grid, Polyline, Role, Stage, Step, Trace
from subdivision.arrays import Floats
from subdivision.exact import spelled
from subdivision.passes import as_grid
from subdivision.stage import Stencil

TINT = 0.24
"""How much of a role's colour fills its box."""


def diagram(trace: Trace, at: float, theme: Theme) -> Diagram:
    """The step under way at stage position ``at``, as boxes."""
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


def combination(stencil: Stencil, name: Callable[[int], str]) -> str:
    """A row as mathematics: ``(3 P_0 + P_1)/4`` over its least common denominator, in the order of the points."""
    terms = sorted(stencil.terms, key=lambda term: term[0])
    fractions = [(p, w) for p, w in terms if isinstance(w, Fraction)]
    if len(fractions) < len(terms):
        return "$" + " + ".join(rf"{spelled(w)}\,{name(p)}" for p, w in terms) + "$"
    below = lcm(*(w.denominator for _, w in fractions))
    above = "+".join(_multiple(w * below, name(p)) for p, w in fractions).replace("+-", "-")
    return f"${above}$" if below == 1 else rf"$\frac{{{above}}}{{{below}}}$"


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
            _box(2 * i + 0.5, 0, f"${_point(i)}$", Role.ORIGINAL, theme, 1.0, i) for i in range(control.n_vertices)
        ]
    for k, stage in enumerate(stages[: int(np.ceil(at))]):
        shown = _filled(stage.n_points, at - k) if k else np.ones(stage.n_points)
        for i in range(stage.n_points):
            x, y = i + k / 2, -1.25 * k
            if k == 0:  # the copies of a point slide apart
                x = i + (1 - min(at, 1.0)) * (2 * int(stage.carries[i]) + 0.5 - i)
            stencil = Step(stages[: k + 1]).stencil(i)
            boxes.append(_box(x, y, combination(stencil, _point), Role(stage.roles[i]), theme, shown[i], i))
            if k:
                links.extend(_parents(stage, i, k, shown[i], theme))
        notes.append(Note(-0.75, -1.25 * k, stage.name, theme.muted, "right", float(shown[0])))
    widest, rows = stages[0].n_points, len(stages)
    return Diagram((-2.6, -1.25 * (rows - 1) - 0.7, widest - 0.3, 0.7), tuple(boxes), tuple(links), tuple(notes))


def _parents(stage: Stage, i: int, k: int, opacity: float, theme: Theme) -> list[Link]:
    """Strokes from a box down to the boxes it averages (not across the seam of a closed polygon)."""
    below = [int(p) for p in stage.stencil(i).parents if abs(int(p) - i) <= 1]
    x, y = i + k / 2, -1.25 * k
    return [Link(x, y + 0.36, p + (k - 1) / 2, y + 1.25 - 0.36, theme.muted, opacity) for p in below]


def _array(control: Grid, stages: tuple[Stage, ...], at: float, theme: Theme) -> Diagram:
    """The net as it stands: s to the right, t upwards; boxes slide from the box they continue."""
    largest = max(
        (s.topology.shape for s in stages if isinstance(s.topology, Grid)), key=lambda shape: shape[0] * shape[1]
    )
    w, h = max(largest[0], control.n_s), max(largest[1], control.n_t)
    extent = (-w / 2 - 0.1, -h / 2 - 0.1, w / 2 + 0.1, h / 2 + 0.45)
    arrow = (Note(0, h / 2 + 0.25, "s →   t ↑", theme.muted, "center"),)
    k = max(int(np.ceil(at)) - 1, 0)
    if at == 0:
        start = _places(control)
        names = [_named(control)(i) for i in range(control.n_vertices)]
        boxes = [
            _box(x, y, f"${n}$", Role.ORIGINAL, theme, 1.0, i)
            for i, ((x, y), n) in enumerate(zip(start, names, strict=True))
        ]
        return Diagram(extent, tuple(boxes), (), arrow)
    stage, t = stages[k], at - k
    before = stages[k - 1].topology if k else control
    return Diagram(extent, tuple(_sliding(control, stages[: k + 1], stage, before, t, theme)), (), arrow)


def _sliding(
    control: Grid, sofar: tuple[Stage, ...], stage: Stage, before: Connectivity, t: float, theme: Theme
) -> list[Box]:
    new, old = _places(stage.topology), _places(before)
    step, earlier = Step(sofar), Step(sofar[:-1]) if len(sofar) > 1 else None
    shown = _filled(stage.n_points, t)
    boxes = []
    for i, carried in enumerate(stage.carries):
        x, y = new[i] if carried < 0 else (1 - t) * old[carried] + t * new[i]
        done = shown[i] >= 0.5
        stencil = step.stencil(i) if done or carried < 0 or earlier is None else earlier.stencil(int(carried))
        role = (
            Role(stage.roles[i])
            if done or carried < 0
            else Role(sofar[-2].roles[carried])
            if earlier
            else Role.ORIGINAL
        )
        opacity = float(shown[i]) if carried < 0 else float(abs(2 * shown[i] - 1)) if stage.moves else 1.0
        boxes.append(_box(float(x), float(y), combination(stencil, _named(control)), role, theme, opacity, i))
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


def _box(x: float, y: float, text: str, role: Role, theme: Theme, opacity: float, point: int) -> Box:
    colour = theme.roles[role] if role is not Role.ORIGINAL else theme.muted
    return Box(x, y, text, tinted(colour, theme), theme.ink, colour, opacity=float(opacity), point=point)


def _point(i: int) -> str:
    return f"P_{{{i}}}"


def _named(grid: Grid) -> Callable[[int], str]:
    return lambda k: f"P_{{{k // grid.n_t}{k % grid.n_t}}}"


def _multiple(count: Fraction, name: str) -> str:
    return name if count == 1 else f"{count}{name}"

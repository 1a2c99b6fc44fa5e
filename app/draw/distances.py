"""How fast the levels go to the limit: two plots over the level, on scales where a constant rate is a straight line.

Above, how far the vertices of a level are from their limits, where they are farthest.  Below, the largest angle between
the normals of two corners at one vertex: it goes to 0 exactly where the surface has a tangent plane.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from app.draw.limits import is_whole, limit_of
from app.draw.picture import Box, Colour, Diagram, Link, Note
from app.draw.theme import Theme
from app.state import Spot, State
from lessons.script import View
from subdivision import Topology, TopologyError, Trace
from subdivision.measure import normal_spread
from subdivision.words import phrase

LEAST = 1e-12
"""Less than this, relative to the size of the control object, or in degrees, is none: the plot ends before it."""

WIDE, TALL, GAP = 10.0, 4.0, 3.4
"""A plot in cells, and what is between the two."""

SLACK = 0.12
"""How much of its height a plot leaves free above and below its curve."""

DOT = 0.34
"""Size of a dot in cells."""


@dataclass(frozen=True)
class Course:
    """A measurement at the levels ``first``, ``first`` + 1, ...; ``refusal`` says why there is none."""

    title: str
    values: tuple[float, ...] = ()
    first: int = 0
    refusal: str = ""

    @property
    def rate(self) -> float | None:
        """How many times smaller the last value is than the one before; None where that is not told."""
        if len(self.values) < 2 or not min(self.values[-2:]) > LEAST:
            return None
        return self.values[-2] / self.values[-1]


def distances(state: State, view: View, theme: Theme) -> Diagram:
    """Both plots of a view, on its control points as they were dragged."""
    trace = state.trace(view)
    away = to_limit(trace)
    vertex = _probed(trace, _spot(state, view))
    probe = Course("Angle between normals", refusal="There is no vertex inside a surface here.")
    if vertex is not None:
        probe = spread(trace, *vertex)
    far, near = _plot(away, theme, theme.ink, 0.0), _plot(probe, theme, theme.accent, TALL + GAP)
    cells = (-2.4, -1.9, WIDE + 2.6, 2 * TALL + GAP + 1.5)
    return Diagram(
        cells, (*far.boxes, *near.boxes), (*far.links, *near.links), (*far.notes, *near.notes), shape=(0.7, 1.6)
    )


@lru_cache(maxsize=8)
def to_limit(trace: Trace) -> Course:
    """For every complete level, the largest distance of its vertices from their limits."""
    title, found = "Largest distance to the limit", []
    try:
        for k in _ends(trace):
            stage = limit_of(trace.scheme, trace.topology_at(k))
            way = stage.operator.apply(trace.points[k]) - trace.points[k][stage.carries]
            found.append(float(np.sqrt((way * way).sum(axis=1)).max(initial=0.0)))
    except TopologyError as reason:
        return Course(title, refusal=phrase("{reason:sentence}", reason=str(reason)))
    return Course(title, tuple(found))


@lru_cache(maxsize=64)
def spread(trace: Trace, vertex: int, level: int) -> Course:
    """The smoothness probe at a vertex, from the level where it has that number on."""
    title, found, at = phrase("Angle between normals at v{vertex}", vertex=vertex), list[float](), vertex
    ends = _ends(trace)
    for here, after in zip(ends[level:], [*ends[level + 1 :], None], strict=True):
        found.append(normal_spread(trace.mesh_at(here), at))
        for stage in trace.stages[here:after] if after is not None else ():
            later = np.flatnonzero(stage.carries == at)
            if not len(later):
                return Course(title, tuple(found), level, "No later level continues this vertex.")
            at = int(later[0])
    return Course(title, tuple(found), level)


def _ends(trace: Trace) -> list[int]:
    """After how many stages levels are complete."""
    return [k for k in range(len(trace.stages) + 1) if is_whole(trace, k)]


def _spot(state: State, view: View) -> Spot | None:
    spot = state.focus
    is_here = spot is not None and spot.pane < len(state.now.views) and state.now.views[spot.pane].trace is view.trace
    return spot if is_here else None


def _probed(trace: Trace, spot: Spot | None) -> tuple[int, int] | None:
    """The vertex in focus if a level has it, else the first extraordinary one, else the first inside; and its level."""
    ends = _ends(trace)
    if spot is not None and spot.stage in ends:
        t = trace.topology_at(spot.stage)
        if spot.point < t.n_vertices and (t.origin == spot.point).any():
            return spot.point, ends.index(spot.stage)
    t = trace.control.topology
    if not isinstance(t, Topology):
        return None
    inside = (
        np.flatnonzero(t.extraordinary) if t.extraordinary.any() else np.flatnonzero(~t.on_boundary & (t.valence > 0))
    )
    return (int(inside[0]), 0) if len(inside) else None


def _plot(course: Course, theme: Theme, colour: Colour, top: float) -> Diagram:
    """One plot with its axes and its words, ``top`` cells down."""
    bottom, shown = top + TALL, [v for v in course.values if v > LEAST]
    axes = [Link(0, top, 0, bottom, theme.muted, width=1.6), Link(0, bottom, WIDE, bottom, theme.muted, width=1.6)]
    notes = [Note(0, top - 1.15, course.title, colour)]
    if not shown:
        why = course.refusal or "It is 0 at every level."
        return _part([], [], [*notes, Note(WIDE / 2, top + TALL / 2, why, theme.muted, "center")])
    low, high = np.log10(min(shown)), np.log10(max(shown))
    room = max(high - low, 0.3)
    low, high = (low + high - room) / 2 - SLACK * room, (low + high + room) / 2 + SLACK * room
    last = max(course.first + len(shown) - 1, 1)
    places = [
        (WIDE * (course.first + k) / last, bottom - TALL * (np.log10(v) - low) / (high - low))
        for k, v in enumerate(shown)
    ]
    links = [Link(*a, *b, colour, width=3.4) for a, b in pairwise(places)]
    for power in range(int(np.ceil(low)), int(np.floor(high)) + 1):
        y = bottom - TALL * (power - low) / (high - low)
        axes.append(Link(0, y, WIDE, y, theme.muted, 0.35, 1.0))
    boxes = [Box(x, y, ("",), colour, colour, colour, DOT, DOT, line=0.0) for x, y in places]
    notes += [Note(WIDE * k / last, bottom + 0.6, str(k), theme.muted, "center") for k in range(last + 1)]
    notes.append(Note(-0.3, places[0][1], spelled(shown[0], course), theme.muted, "right"))
    if len(shown) > 1:
        notes.append(Note(WIDE + 0.4, places[-1][1], spelled(shown[-1], course), theme.muted))
    if course.rate is not None:
        notes.append(Note(WIDE, top - 0.15, said_rate(course.rate), colour, "right"))
    return _part(boxes, [*axes, *links], notes)


def _part(boxes: list[Box], links: list[Link], notes: list[Note]) -> Diagram:
    """A plot before it has its place."""
    return Diagram((0.0, 0.0, 1.0, 1.0), tuple(boxes), tuple(links), tuple(notes))


def said_rate(rate: float) -> str:
    """A rate in words."""
    if abs(rate - 1) < 0.005:
        return "stays as it is"
    if rate > 1:
        return phrase("falls by {rate:.2f} a level", rate=rate)
    return phrase("grows by {rate:.2f} a level", rate=1 / rate)


def spelled(value: float, course: Course) -> str:
    """A value with its unit: angles in degrees."""
    unit = "°" if "Angle" in course.title else ""
    return f"{value:.3g}{unit}" if value >= 1e-3 else f"{value:.1e}{unit}".replace("-", "−")

"""Stencils as the lecture draws them: black discs, their weights, and a clear diamond for the point they make.

The plane is the trace's control object seen from above; every weight is read from the engine's row.
"""

import numpy as np

from app.draw.picture import Diagram, Dot, Entry, Link, Note, Pane, Shape
from app.draw.pointed import Pointed
from app.draw.theme import Theme
from subdivision import Role, Trace
from subdivision.arrays import Floats, Indices
from subdivision.exact import spelled_together

DISC, DIAMOND = 13.0, 17.0
"""Radii in logical points."""

TYPE = 30.0
OFF = 34.0
"""From a disc to the middle of its weight, in logical points."""

CELLS = 3.0
"""The longest stroke from the new point to a contributor is this many cells."""


def stencil(trace: Trace, row: Pointed, theme: Theme) -> Diagram:
    """A row as a flat picture."""
    places, here = _places(trace, row)
    ink = theme.roles[Role.ORIGINAL]
    edges = _edges(trace, row)
    number = {int(p): k for k, p in enumerate(row.stencil.parents)}
    links = tuple(
        _link(places[number[a]], places[number[b]], theme) for a, b in edges.tolist() if a in number and b in number
    )
    words = spelled_together([w for _, w in row.stencil.terms])
    begin = row.stage - row.span
    dots = [Dot(x, y, Shape.SPHERE, DISC, ink, p, begin) for p, (x, y) in zip(number, places, strict=True)]
    notes = [
        Note(x, y, word, theme.ink, "center", size=TYPE, away=_away((x, y), here))
        for word, (x, y) in zip(words, places, strict=True)
    ]
    dots.append(Dot(*here, Shape.CLEAR, DIAMOND, ink, row.stencil.point, row.stage))
    low, high = (np.vstack([places, here]).min(axis=0) - 0.6, np.vstack([places, here]).max(axis=0) + 0.6)
    return Diagram((*low, *high), (), links, tuple(notes), tuple(dots), largest=110.0)


def legend(panes: tuple[Pane, ...], theme: Theme) -> tuple[Entry, ...]:
    """Discs and diamond, if a stencil is in the picture."""
    dots = [d for p in panes if isinstance(p.content, Diagram) for d in p.content.dots]
    if not dots:
        return ()
    ink = theme.roles[Role.ORIGINAL]
    return Entry(Shape.SPHERE, ink, "contributes"), Entry(Shape.CLEAR, ink, "new point")


def _places(trace: Trace, row: Pointed) -> tuple[Floats, tuple[float, float]]:
    """(n, 2) in cells, y downwards: the contributors; and the new point."""
    old, new = trace.points[row.stage - row.span][:, :2], trace.points[row.stage][row.stencil.point, :2]
    found = old[row.stencil.parents]
    far = float(np.linalg.norm(found - new, axis=1).max())
    places = (found - new) * np.array([1, -1]) * CELLS / max(far, 1e-9)
    return places, (0.0, 0.0)


def _link(a: Floats, b: Floats, theme: Theme) -> Link:
    return Link(float(a[0]), float(a[1]), float(b[0]), float(b[1]), theme.edge, width=3.0)


def _edges(trace: Trace, row: Pointed) -> Indices:
    return np.asarray(trace.topology_at(row.stage - row.span).ends)


def _away(at: tuple[float, float], here: tuple[float, float]) -> tuple[float, float]:
    """Outwards from the new point; the new point's own weight stands lower right."""
    off = np.array(at) - np.array(here)
    far = float(np.linalg.norm(off))
    x, y = off / far if far > 1e-9 else (0.8, 0.6)
    return float(OFF * x * 1.3), float(-OFF * y)

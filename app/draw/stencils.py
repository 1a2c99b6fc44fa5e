"""Stencils as the lecture draws them: black discs, their weights, and a clear diamond for the point they make.

The plane is the trace's control object seen from above, one cell to an edge of its mesh; every weight is
read from the engine's row.
"""

from collections.abc import Sequence

import numpy as np

from app.draw.picture import Diagram, Dot, Entry, Link, Pane, Scene, Shape
from app.draw.pointed import Pointed
from app.draw.theme import NAMES, Theme
from subdivision import Role, Stencil, Trace
from subdivision.arrays import Floats, Indices
from subdivision.exact import spelled_together

DISC, DIAMOND = 15.0, 19.0
"""Radii in logical points."""

STROKE = 3.6

LARGEST = 420.0
"""The longest that an edge is drawn, in logical points."""

NEAR = 0.1
"""So near to the new point, relative to an edge, there is no outwards."""


ASIDE = 1e-3
"""How little it counts, beside the room, that words stand to the right and rather below than above."""


def stencil(trace: Trace, row: Pointed, theme: Theme, words: Sequence[str] | None = None) -> Diagram:
    """A row as a flat picture: the mesh's edges among the contributors, each with its weight; and the new point.

    ``words`` stand in the place of the weights.
    """
    ink, begin = theme.roles[Role.ORIGINAL], row.stage - row.span
    links = _edges(trace, row)
    places = _places(trace, row, links)
    ways = [_way(places, links, k) for k in range(len(places))]
    dots = [
        Dot(float(x), float(y), Shape.SPHERE, DISC, ink, int(p), begin, text, way)
        for p, (x, y), text, way in zip(row.stencil.parents, places, words or spelled(row.stencil), ways, strict=True)
    ]
    dots.append(Dot(0.0, 0.0, Shape.CLEAR, DIAMOND, ink, row.stencil.point, row.stage))
    strokes = tuple(_link(places[a], places[b], theme) for a, b in links)
    around = np.vstack([places, np.zeros(2)])
    return Diagram((*around.min(axis=0), *around.max(axis=0)), (), strokes, (), tuple(dots), largest=LARGEST)


def legend(panes: tuple[Pane, ...], theme: Theme) -> tuple[Entry, ...]:
    """What the discs are, unless a scene beside them says so, and the diamond; nothing where there is no stencil."""
    if not any(isinstance(p.content, Diagram) and p.content.dots for p in panes):
        return ()
    ink, old = theme.roles[Role.ORIGINAL], NAMES[Role.ORIGINAL]
    named = any(m.name == old for p in panes if isinstance(p.content, Scene) for m in p.content.markers)
    disc, diamond = Entry(Shape.SPHERE, ink, old), Entry(Shape.CLEAR, ink, "new point")
    return (diamond,) if named else (disc, diamond)


def spelled(row: Stencil) -> list[str]:
    """The weights, as fractions of one denominator; four decimals where they are no fractions."""
    words = spelled_together([weight for _, weight in row.terms])
    return [f"≈{float(w):.4f}" if "." in word else word for word, (_, w) in zip(words, row.terms, strict=True)]


def _link(a: Floats, b: Floats, theme: Theme) -> Link:
    return Link(float(a[0]), float(a[1]), float(b[0]), float(b[1]), theme.edge, width=STROKE)


def _edges(trace: Trace, row: Pointed) -> Indices:
    """(n_links, 2) int: edges of the mesh between two contributors, by their place in the row."""
    ends, parents = trace.topology_at(row.stage - row.span).ends, row.stencil.parents
    place = np.full(len(trace.points[row.stage - row.span]), -1)
    place[parents] = np.arange(len(parents))
    found = place[ends]
    return np.asarray(found[(found >= 0).all(axis=1)])


def _places(trace: Trace, row: Pointed, links: Indices) -> Floats:
    """(n_contributors, 2) in cells, x to the right and y downwards from the new point."""
    old, new = trace.points[row.stage - row.span][:, :2], trace.points[row.stage][row.stencil.point, :2]
    found = (old[row.stencil.parents] - new) * np.array([1.0, -1.0])
    sides = found[links[:, 0]] - found[links[:, 1]] if len(links) else found
    return np.asarray(found / max(float(np.linalg.norm(sides, axis=1).max()), 1e-9))


def _way(places: Floats, links: Indices, k: int) -> tuple[float, float]:
    """Where the weight of contributor ``k`` stands: outwards; at the new point where there is most room."""
    x, y = places[k]
    far = float(np.hypot(x, y))
    if far > NEAR:
        return float(x) / far, float(y) / far
    ends = links[(links == k).any(axis=1)].sum(axis=1) - k
    if not len(ends):
        return 1.0, 0.0
    angles = np.sort(np.arctan2(places[ends, 1], places[ends, 0]))
    gaps = np.diff(angles, append=angles[0] + 2 * np.pi)
    between = (angles + gaps / 2 + np.pi) % (2 * np.pi) - np.pi
    angle = between[np.argmax(gaps - ASIDE * np.abs(between - ASIDE))]
    return float(np.cos(angle)), float(np.sin(angle))

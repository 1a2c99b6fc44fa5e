"""Lines of light on a surface, which show how smooth it is.

Isophotes: along each the surface leans equally far from the light.  Reflection lines: where the eye sees one of many
long parallel lamps in the surface.  A surface that is only C1 bends both sharply where its pieces meet; on a C2 surface
they are smooth.
"""

import numpy as np

from app.draw.geometry import facets
from app.draw.picture import Camera, Colour, Faces, Lines
from subdivision.arrays import Floats

LIGHT = np.array([0.48, -0.36, 0.8])
"""A unit vector towards the light; it stays where it is when the view turns."""

STEP = 6.0
"""Degrees from one line to the next."""

LAMPS = 15.0
"""Degrees from one lamp to the next, as the surface sees them."""


def isophotes(faces: Faces, colour: Colour, width: float) -> Lines:
    """The lines on a close mesh, straight across each of its triangles."""
    cut = facets(faces)
    lean = np.degrees(np.arccos(np.clip(cut.normals @ LIGHT, -1.0, 1.0)))
    return _lines(cut.points[cut.triangles], lean[cut.triangles], STEP, colour, width)


def reflections(faces: Faces, camera: Camera, colour: Colour, width: float) -> Lines:
    """Upright lamps all round, as an eye far away in the direction of the lesson's camera sees them in a close mesh."""
    cut = facets(faces)
    right, _, back = camera.axes
    seen = 2 * (cut.normals @ back)[:, None] * cut.normals - back
    way = np.degrees(np.arctan2(seen @ right, seen @ back))[cut.triangles]
    over = np.ptp(way, axis=1, keepdims=True) > 180  # straight behind the surface the angles begin anew
    return _lines(cut.points[cut.triangles], way + 360 * (over & (way < 0)), LAMPS, colour, width)


def _lines(corners: Floats, values: Floats, step: float, colour: Colour, width: float) -> Lines:
    """Where triangles have a value that is a multiple of ``step``."""
    first, last = np.floor(values.min(axis=1) / step), np.floor(values.max(axis=1) / step)
    count = (last - first).astype(np.intp)
    owner = np.repeat(np.arange(len(count)), count)
    turn = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count) + 1
    points = _crossings(corners[owner], values[owner], (first[owner] + turn) * step)
    return Lines(points, np.arange(len(points)).reshape(-1, 2), colour, width)


def _crossings(corners: Floats, values: Floats, levels: Floats) -> Floats:
    """(2 m, 3): both ends of the line at which each of ``m`` triangles has its level, which parts its corners."""
    above = values >= levels[:, None]
    single = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    row = np.arange(len(single))
    ends = []
    for turn in (1, 2):  # from the corner that is alone on its side to either of the others
        other = (single + turn) % 3
        a, b = values[row, single], values[row, other]
        t = ((levels - a) / (b - a))[:, None]
        ends.append((1 - t) * corners[row, single] + t * corners[row, other])
    return np.stack(ends, axis=1).reshape(-1, 3)

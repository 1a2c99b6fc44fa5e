"""Isophotes: lines on a surface along which it leans equally far from the light.

A surface that is only C1 bends them sharply where its pieces meet; on a C2 surface they are smooth.
"""

import numpy as np

from app.draw.geometry import facets
from app.draw.picture import Colour, Faces, Lines
from subdivision.arrays import Floats

LIGHT = np.array([0.48, -0.36, 0.8])
"""A unit vector towards the light; it stays where it is when the view turns."""

STEP = 6.0
"""Degrees from one line to the next."""


def isophotes(faces: Faces, colour: Colour, width: float) -> Lines:
    """The lines on a close mesh, straight across each of its triangles."""
    cut = facets(faces)
    lean = np.degrees(np.arccos(np.clip(cut.normals @ LIGHT, -1.0, 1.0)))
    first, last = np.ceil(lean.min() / STEP), np.floor(lean.max() / STEP)
    ends = [_crossings(cut.points[cut.triangles], lean[cut.triangles], k * STEP) for k in np.arange(first, last + 1)]
    points = np.concatenate([np.zeros((0, 3)), *ends])
    return Lines(points, np.arange(len(points)).reshape(-1, 2), colour, width)


def _crossings(corners: Floats, values: Floats, level: float) -> Floats:
    """(2 m, 3): both ends of the line at which each of ``m`` triangles has the value ``level``."""
    above = values >= level
    parted = above.any(axis=1) & ~above.all(axis=1)
    corners, values, above = corners[parted], values[parted], above[parted]
    single = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    row = np.arange(len(single))
    ends = []
    for turn in (1, 2):  # from the corner that is alone on its side to either of the others
        other = (single + turn) % 3
        a, b = values[row, single], values[row, other]
        t = ((level - a) / (b - a))[:, None]
        ends.append((1 - t) * corners[row, single] + t * corners[row, other])
    return np.stack(ends, axis=1).reshape(-1, 3)

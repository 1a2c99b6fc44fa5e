"""Cues while a stage plays: strokes spread from the points that contribute to the point they make.

A newborn point is reached by strokes from its parents; a moving one hangs on strokes from the
points that pull it, most often the centroids around it.  They are read off the stage's matrix.
"""

import numpy as np

from app.draw.picture import Lines
from app.draw.theme import Theme
from subdivision import Frame, Role
from subdivision.arrays import Floats, Indices, Mask

FEW = 80
"""More points than this would be a thicket."""

ARRIVED = 0.65
"""The part of a stage after which strokes have reached the newborn points."""


def cues(frame: Frame, theme: Theme, faint: Mask, faint_before: Mask) -> tuple[Lines, ...]:
    """The strokes of one instant; none at rest, none where there would be too many, none from faint points."""
    if frame.stage is None or frame.progress in (0.0, 1.0):
        return ()
    moves = frame.stage.moves
    points = np.flatnonzero(~faint & (_moving(frame) if moves else frame.newborn))
    if not 0 < len(points) <= FEW:
        return ()
    entries = frame.stage.matrix[points].tocoo()
    child, parent = points[entries.row], np.asarray(entries.col, dtype=np.intp)
    other = (parent != frame.stage.carries[child]) & ~faint_before[parent]
    child, parent = child[other], parent[other]
    if moves:
        return _strokes(frame, theme, child, parent, frame.old_roles[parent], 1.0, 0.8 * (1 - frame.progress))
    fading = max(frame.progress - ARRIVED, 0.0) / (1 - ARRIVED)
    return _strokes(frame, theme, child, parent, frame.roles[child], min(frame.progress / ARRIVED, 1.0), 1 - fading)


def _moving(frame: Frame) -> Mask:
    """(n,) bool: points that are under way."""
    away: Floats = np.abs(frame.points - frame.start).max(axis=1)
    return away > 1e-9 * max(float(np.ptp(frame.points)), 1e-300)


def _strokes(
    frame: Frame, theme: Theme, child: Indices, parent: Indices, roles: Indices, grown: float, opacity: float
) -> tuple[Lines, ...]:
    """Strokes from parents towards children, by the role that gives their colour."""
    found = []
    for role in Role:
        of = np.flatnonzero(roles == role)
        if len(of) and opacity > 0:
            begin, end = frame.old_points[parent[of]], frame.points[child[of]]
            tips = begin + grown * (end - begin)
            pairs = np.stack([np.arange(len(of)), np.arange(len(of)) + len(of)], axis=1)
            width = 3.0 * theme.stroke
            found.append(Lines(np.vstack([begin, tips]), pairs, theme.roles[role], width, opacity))
    return tuple(found)

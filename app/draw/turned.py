"""A camera as the hand has turned it."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from app.draw.picture import Camera, unit
from lessons.turn import Turn
from subdivision.arrays import Floats

STEEPEST = np.radians(89.0)


@lru_cache(maxsize=64)
def turned(camera: Camera, turn: Turn) -> Camera:
    """The camera that sees what the hand wants to see; a parallel one does not rotate."""
    away, up = camera.position - camera.focal, camera.up
    tall = _height(camera)
    if not camera.scale:
        away, up = _rotated(away, up, turn)
    side = unit(np.cross(up, away))
    up = unit(np.cross(away, side))
    focal = camera.focal + tall * (turn.right * side + turn.up * up)
    reach = 1.0 if camera.scale else 1 / turn.zoom
    return replace(camera, position=focal + reach * away, focal=focal, up=up, scale=camera.scale / turn.zoom)


def _rotated(away: Floats, up: Floats, turn: Turn) -> tuple[Floats, Floats]:
    distance = float(np.linalg.norm(away))
    height = float(np.arcsin(np.clip(away[2] / distance, -1, 1)))
    level = up if abs(height) > np.pi / 2 - 1e-6 else away
    azimuth = np.arctan2(level[1], level[0]) + (np.pi if level is up and height > 0 else 0.0) + turn.around
    height = float(np.clip(height + turn.over, -STEEPEST, STEEPEST)) if turn.over else height
    out = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    away = distance * (np.cos(height) * out + np.array([0.0, 0.0, np.sin(height)]))
    return away, -np.sin(height) * out + np.array([0.0, 0.0, np.cos(height)])


def _height(camera: Camera) -> float:
    """How much of space is seen from top to bottom, at the focal point."""
    if camera.scale:
        return 2 * camera.scale
    return float(2 * np.linalg.norm(camera.position - camera.focal) * np.tan(np.radians(camera.angle) / 2))

"""How the hand turns the lesson's camera: a value that applies to every pane alike, so that panes stay linked."""

from dataclasses import dataclass, replace

import numpy as np

from app.draw.picture import Camera
from subdivision.arrays import Floats

STEEPEST = np.radians(89.0)
NEAREST, FARTHEST = 30.0, 0.15


@dataclass(frozen=True)
class Turn:
    """Radians round the vertical and upwards; magnification; shift in heights of the untouched view."""

    around: float = 0.0
    over: float = 0.0
    zoom: float = 1.0
    right: float = 0.0
    up: float = 0.0

    def rotated(self, across: float, down: float) -> "Turn":
        """After a drag by parts of the view's height: half a turn for one height."""
        return replace(self, around=self.around - np.pi * across, over=self.over + np.pi * down)

    def panned(self, across: float, down: float) -> "Turn":
        """After a drag by parts of the view's height: what was under the mouse stays under it."""
        return replace(self, right=self.right - across / self.zoom, up=self.up + down / self.zoom)

    def zoomed(self, factor: float, across: float = 0.0, down: float = 0.0) -> "Turn":
        """Magnified about a place ``across`` and ``down`` from the middle, in parts of the view's height."""
        zoom = float(np.clip(self.zoom * factor, FARTHEST, NEAREST))
        kept = 1 / self.zoom - 1 / zoom
        return replace(self, zoom=zoom, right=self.right + across * kept, up=self.up - down * kept)

    def of(self, camera: Camera) -> Camera:
        """The camera that sees what the hand wants to see; a parallel one does not rotate."""
        away, up = camera.position - camera.focal, camera.up
        tall = _height(camera)
        if not camera.scale:
            away, up = self._rotated(away, up)
        side = _unit(np.cross(up, away))
        up = _unit(np.cross(away, side))
        focal = camera.focal + tall * (self.right * side + self.up * up)
        reach = 1.0 if camera.scale else 1 / self.zoom
        return replace(camera, position=focal + reach * away, focal=focal, up=up, scale=camera.scale / self.zoom)

    def _rotated(self, away: Floats, up: Floats) -> tuple[Floats, Floats]:
        distance = float(np.linalg.norm(away))
        height = float(np.arcsin(np.clip(away[2] / distance, -1, 1)))
        level = up if abs(height) > np.pi / 2 - 1e-6 else away
        azimuth = np.arctan2(level[1], level[0]) + (np.pi if level is up and height > 0 else 0.0) + self.around
        height = float(np.clip(height + self.over, -STEEPEST, STEEPEST)) if self.over else height
        out = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
        away = distance * (np.cos(height) * out + np.array([0.0, 0.0, np.sin(height)]))
        return away, -np.sin(height) * out + np.array([0.0, 0.0, np.cos(height)])


REST = Turn()


def _height(camera: Camera) -> float:
    """How much of space is seen from top to bottom, at the focal point."""
    if camera.scale:
        return 2 * camera.scale
    return float(2 * np.linalg.norm(camera.position - camera.focal) * np.tan(np.radians(camera.angle) / 2))


def _unit(vector: Floats) -> Floats:
    return np.asarray(vector / max(float(np.linalg.norm(vector)), 1e-300), dtype=float)

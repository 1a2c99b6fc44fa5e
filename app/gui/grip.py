"""A control point in the hand: where the mouse takes it."""

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, Qt

from app.draw.picture import Camera
from app.draw.primitives import Area
from subdivision.arrays import Floats

AXES = {Qt.Key.Key_X: 0, Qt.Key.Key_Y: 1, Qt.Key.Key_Z: 2}
"""Keys that hold a drag to an axis."""


@dataclass(frozen=True, eq=False)
class Grip:
    """Vertex ``vertex`` was at ``start`` (3,) when the hand took it at ``at``, in a pane seen by ``camera``."""

    vertex: int
    start: Floats
    at: QPointF
    camera: Camera
    area: Area

    def moved(self, to: QPointF, axis: int | None = None) -> tuple[float, float, float]:
        """Where the point goes with the mouse: in the plane of the view, or along an axis of space."""
        x, y, depth = self.camera.project(self.start, self.area[2], self.area[3])[0]
        step = to - self.at
        there = self.camera.place(x + step.x(), y + step.y(), depth, self.area[2], self.area[3])
        if axis is not None:
            there = self.start + self._along(axis, step)
        a, b, c = map(float, there)
        return a, b, c

    def _along(self, axis: int, step: QPointF) -> Floats:
        """As far along the axis as its picture goes with the mouse; nowhere where it points at the eye."""
        unit = np.eye(3)[axis]
        reach = 1e-3 * float(np.linalg.norm(self.start - self.camera.position))
        ends = self.camera.project(np.stack([self.start, self.start + reach * unit]), self.area[2], self.area[3])
        way = ends[1, :2] - ends[0, :2]
        length = float(way @ way)
        if length < 1e-4 * (self.area[3] * 1e-3) ** 2:
            return np.zeros(3)
        return np.asarray(reach * unit * (way @ (step.x(), step.y())) / length)

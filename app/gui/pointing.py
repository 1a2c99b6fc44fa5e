"""Which point the mouse means."""

import numpy as np

from app.draw.picture import Camera, Scene
from app.draw.primitives import Area

REACH = 14.0
"""How near to a marker the mouse must be to mean it, in pixels."""

AS_NEAR = 4.0
"""Markers whose distances differ by no more pixels are equally near: the one in front is meant."""


def nearest(scene: Scene, camera: Camera, area: Area, x: float, y: float) -> tuple[int, int] | None:
    """After how many stages (-1: now), and the number of, the point whose marker is nearest to a place, if near."""
    found = [(m.points, m.ids, np.full(len(m.ids), m.stage)) for m in scene.markers if (m.ids >= 0).any()]
    if not found:
        return None
    points, ids, stages = (np.concatenate(each) for each in zip(*found, strict=True))
    flat = camera.project(points, area[2], area[3]) + np.array([area[0] - x, area[1] - y, 0.0])
    apart = np.where(ids >= 0, np.hypot(flat[:, 0], flat[:, 1]), np.inf)
    near = np.flatnonzero(apart < min(REACH, float(apart.min()) + AS_NEAR))
    if not near.size:
        return None
    chosen = near[np.argmin(flat[near, 2])]
    return int(stages[chosen]), int(ids[chosen])

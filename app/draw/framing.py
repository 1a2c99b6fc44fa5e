"""Where the camera of a lesson stands: it sees the whole control object, and never moves with the stages."""

from dataclasses import replace

import numpy as np

from app.draw.picture import Camera
from lessons.script import Look
from subdivision import Mesh, Trace
from subdivision.arrays import Floats
from subdivision.rows import shown_faces

FRAME = 1.4
"""Width to height of the part of a pane that the control object fills; wider panes have room beside it."""

NARROW = 0.7
"""The same for what is slender, at least."""

FLAT_FRAME = 1.55
"""The same for what is seen in parallel."""

FILLED = 0.86
"""How much of the frame."""

RING = 1.3
"""How far round a fragment the camera sees."""


def camera(trace: Trace, look: Look, also: Floats | None = None) -> Camera:
    """A camera that sees the whole control object in the direction of ``look``; it ignores the stage on purpose.

    Of a fragment it sees what is not hidden, and something of the faint ring; in any case what is in ``also`` (n, 3).
    """
    points = _looked_at(trace.control)
    points = points if also is None else np.vstack([points, also])
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    radius = max(float(np.linalg.norm(points - centre, axis=1).max()), 1e-9)
    azimuth, elevation = np.radians(look.azimuth), np.radians(look.elevation)
    towards = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)])
    up = np.array([-np.sin(elevation) * np.cos(azimuth), -np.sin(elevation) * np.sin(azimuth), np.cos(elevation)])
    if look.parallel:
        half = _half_height(points, centre, up) / look.zoom
        return Camera(centre + 10 * radius * towards, centre, up, scale=half, aspect=FLAT_FRAME)
    return _framed(Camera(centre + 4 * radius * towards, centre, up), points, look.zoom)


def _looked_at(control: Mesh) -> Floats:
    """(n, 3): the points that must be seen."""
    hidden = control.topology.hidden
    if not hidden.any() or hidden.all():
        return control.points
    shown = control.points[np.unique(shown_faces(control.topology)[1])]
    middle = shown.mean(axis=0)
    return np.asarray(middle + RING * (shown - middle))


def _framed(camera: Camera, points: Floats, zoom: float) -> Camera:
    """The camera moved sideways and back until the points fill the frame, but for a margin."""
    for _ in range(6):
        seen = camera.project(points, FRAME, 1.0)
        low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
        fill = float(((high - low) / (FRAME, 1.0)).max()) / (FILLED * zoom)
        ahead = camera.focal - camera.position
        right = np.cross(ahead, camera.up) / np.linalg.norm(ahead)
        visible = 2 * float(np.linalg.norm(ahead)) * np.tan(np.radians(camera.angle) / 2)
        across, down = (low + high) / 2 - (FRAME / 2, 0.5)
        aside = visible * (across * right - down * camera.up)
        focal = camera.focal + aside
        camera = replace(camera, position=focal - ahead * max(fill, 0.05), focal=focal)
    seen = camera.project(points, FRAME, 1.0)[:, 0]
    return replace(camera, aspect=float(np.clip(np.ptp(seen) / FILLED, NARROW, FRAME)))


def _half_height(points: Floats, centre: Floats, up: Floats) -> float:
    right = np.cross([0.0, 0.0, 1.0], up)
    tall, wide = np.abs((points - centre) @ up).max(), np.abs((points - centre) @ right).max()
    return float(1.25 * max(tall, wide * 0.62, 1e-9))

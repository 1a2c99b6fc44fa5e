"""Control polygons, in the plane z = 0."""

import numpy as np

from subdivision.rows import Polyline
from subdivision.shapes.build import turns
from subdivision.trace import Mesh


def polygon(n: int = 5) -> Mesh:
    """An open zig-zag of ``n`` points from left to right: the control polygon of Figure 1."""
    heights = [-0.55, 0.75, -0.15, 0.95, -0.75, 0.35, -0.45, 0.65]
    x = np.linspace(-1.4, 1.4, n)
    return Mesh(Polyline(n), np.stack([x, np.resize(heights, n), np.zeros(n)], axis=1))


def hook() -> Mesh:
    """An open polygon of 6 points that curls like a fish-hook: the control polygon of Figure 11."""
    flat = [(-1.35, -0.35), (-0.95, 0.85), (0.55, 1.05), (1.35, -0.1), (0.45, -1.0), (-0.3, -0.25)]
    return Mesh(Polyline(6), np.array([(x, y, 0.0) for x, y in flat]))


def closed_polygon(n: int = 6) -> Mesh:
    """A closed polygon of ``n`` points, a pebble with bays."""
    radii = np.resize([1.35, 0.8, 1.2, 0.95, 1.3, 0.6, 1.1, 0.9], n)
    angles = turns(n, start=0.25)
    points = np.stack([radii * np.cos(angles), radii * np.sin(angles), np.zeros(n)], axis=1)
    return Mesh(Polyline(n, closed=True), points)

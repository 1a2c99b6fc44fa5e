"""Control polygons, in the plane z = 0."""

import numpy as np

from subdivision.rows import Polyline
from subdivision.shapes.build import turns
from subdivision.trace import Mesh


def polygon(n: int = 5) -> Mesh:
    """An open zig-zag of ``n`` points from left to right: the control polygon of Figure 1."""
    heights = [-0.7, 0.6, 0.95, -0.8, -0.45, 0.85, 0.3, -0.75]
    x = np.linspace(-1.4, 1.4, n)
    return Mesh(Polyline(n), np.stack([x, np.resize(heights, n), np.zeros(n)], axis=1))


def hook() -> Mesh:
    """An open polygon of 7 points, bent both ways like an S-hook: the control polygon of Figure 11."""
    flat = [(-1.45, 0.35), (-1.0, -1.05), (0.45, -1.15), (0.65, -0.1), (-0.55, 0.45), (0.0, 1.35), (1.4, 0.65)]
    return Mesh(Polyline(7), np.array([(x, y, 0.0) for x, y in flat]))


def closed_polygon(n: int = 6) -> Mesh:
    """A closed polygon of ``n`` points, a pebble with a bay."""
    radii = np.resize([1.35, 1.25, 0.15, 1.4, 1.1, 1.2], n)
    angles = turns(n, start=-0.4)
    points = np.stack([radii * np.cos(angles), radii * np.sin(angles), np.zeros(n)], axis=1)
    return Mesh(Polyline(n, closed=True), points - (points.min(axis=0) + points.max(axis=0)) / 2)

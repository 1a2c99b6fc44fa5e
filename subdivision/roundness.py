"""How round control objects are: the ball that fits a tip, and how far points are from lying on one ball."""

import numpy as np

from subdivision.arrays import Floats
from subdivision.trace import Mesh


def ball_at(mesh: Mesh, vertex: int) -> float:
    """The radius of the ball through ``vertex`` and about through its neighbours; inf where they lie in a plane.

    It is half of d^2/h: d^2 is the mean of the neighbours' squared distances, h how far the vertex is from
    their centroid.  Exact where they lie on a circle above whose centre the vertex stands.
    """
    ends = mesh.topology.ends
    around = ends[(ends == vertex).any(axis=1)].sum(axis=1) - vertex
    away = mesh.points[around] - mesh.points[vertex]
    height = float(np.linalg.norm(away.mean(axis=0)))
    return float((away**2).sum(axis=1).mean()) / (2 * height) if height > 0 else float("inf")


def radius_ratio(points: Floats) -> float:
    """The farthest of ``points`` (n, 3) from their centroid over the nearest: 1 on a ball about it."""
    radii = np.linalg.norm(points - points.mean(axis=0), axis=1)
    return float(radii.max() / radii.min())

"""The two lines that all shapes end with."""

from collections.abc import Mapping, Sequence

import numpy as np

from subdivision.arrays import Floats
from subdivision.passes import as_grid
from subdivision.topology import Topology
from subdivision.trace import Mesh

Points = Sequence[Sequence[float]] | Floats
Faces = Sequence[Sequence[int]]


def mesh(points: Points, faces: Faces, creases: Mapping[tuple[int, int], float] | None = None) -> Mesh:
    """The polygon mesh of counter-clockwise ``faces`` on ``points`` (n, 3)."""
    return Mesh(Topology.from_faces(faces, len(points), creases=creases), np.asarray(points, dtype=float))


def meshed(net: Mesh) -> Mesh:
    """A rectangular net as a polygon mesh, same points in the same order."""
    return Mesh(as_grid(net.topology).mesh(), net.points)


def turns(n: int, start: float = 0.0) -> Floats:
    """(n,) float: the angles of a regular n-gon, in radians; the first one ``start`` steps after the x axis."""
    return 2 * np.pi * (np.arange(n) + start) / n

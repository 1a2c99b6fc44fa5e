"""The basis function of a control point as a graph: every control point at height 0, that one at height 1."""

from functools import lru_cache

import numpy as np

from lessons.script import Look
from subdivision import Mesh, Polyline, Topology, TopologyError, Trace
from subdivision.arrays import Floats, next_corners

HEIGHT = 0.42
"""What height 1 is in the picture, relative to the width of the graph."""

ASLANT = Look(azimuth=-60.0, elevation=24.0)
"""How a graph over a plane is seen."""

CLOSED = "It lies over no plane, so its basis functions are no graphs: they are shown as colour."


@lru_cache(maxsize=16)
def graph(trace: Trace, vertex: int) -> Trace:
    """The same stages on the control object with its heights replaced: 1 at ``vertex``, 0 elsewhere.

    After any stage a point is as high as the share of ``vertex`` that it holds, times ``height_of``.  The points of an
    open polygon stand side by side, a unit apart, and heights are upwards; else heights are along z.

    Raises
    ------
    TopologyError
        If the control object lies over no plane, as closed meshes do.
    """
    control = trace.control
    points = _spread(control)
    points[vertex, _up(control)] = height_of(control)
    return trace.with_control(Mesh(control.topology, points))


def height_of(control: Mesh) -> float:
    """What height 1 is in space."""
    return HEIGHT * float(np.ptp(_spread(control), axis=0).max())


def heights(trace: Trace, points: Floats) -> Floats:
    """(n,): how high points are, 1 being the control point's own height."""
    return np.asarray(points[:, _up(trace.control)] / height_of(trace.control))


def middle(control: Mesh) -> int:
    """The control point that is lifted if none is pointed at: the one nearest to their mean."""
    if _is_open(control):
        return control.topology.n_vertices // 2
    return int(np.argmin(np.linalg.norm(control.points - control.points.mean(axis=0), axis=1)))


def look_of(control: Mesh, usual: Look) -> Look:
    """From where the graph is seen."""
    return usual if _is_open(control) and usual.parallel else ASLANT if usual.parallel else usual


def _spread(control: Mesh) -> Floats:
    """(n, 3): the control points at height 0."""
    if _is_open(control):
        n = control.topology.n_vertices
        return np.stack([np.arange(n) - (n - 1) / 2, np.zeros(n), np.zeros(n)], axis=1)
    if not _is_over_a_plane(control):
        raise TopologyError(CLOSED)
    return np.asarray(control.points * [1.0, 1.0, 0.0])


def _up(control: Mesh) -> int:
    return 1 if _is_open(control) else 2


def _is_open(control: Mesh) -> bool:
    return isinstance(control.topology, Polyline) and not control.topology.closed


def _is_over_a_plane(control: Mesh) -> bool:
    """Whether seen along z no two faces turn different ways."""
    t = control.topology
    if isinstance(t, Polyline):
        return True
    if isinstance(t, Topology) and not t.boundary.any():
        return False
    start = np.cumsum(t.face_sizes) - t.face_sizes
    ahead = next_corners(t.face_sizes)
    x, y = control.points[t.origin, 0], control.points[t.origin, 1]
    area = np.add.reduceat(x * y[ahead] - x[ahead] * y, start)
    least = 1e-9 * float(np.abs(area).max())
    return bool((area > least).all() or (area < -least).all())

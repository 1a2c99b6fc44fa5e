"""Chaikin's corner cutting [Cha74]_: the quadratic B-spline curve, told in quarters.

Every edge gets a point at one quarter and one at three quarters of its length; then the corners
between them are cut off.  The matrix is that of Lane-Riesenfeld subdivision of degree 2.
"""

from functools import partial

import numpy as np

from subdivision.limit_nets import curve_limit
from subdivision.operators import Operator, Pick, identity, stack
from subdivision.passes import as_polygon, at_once, average, room, split, told
from subdivision.rows import Connectivity, Polyline
from subdivision.scheme import Scheme
from subdivision.stage import Role, Stage, Step

ALONG = (1, 0)


def corner_cutting(t: Connectivity) -> Step:
    """Mark the quarters of every edge; cut the corners off."""
    polygon = as_polygon(t)
    n, m = polygon.n_vertices, 2 * polygon.n_edges
    ends = polygon.ends.ravel()
    quarters = _quarters(m) @ Pick(ends, n)
    roles = np.repeat([Role.ORIGINAL, Role.EDGE], [n, m])
    return Step((
        Stage("quarters", stack(identity(n), quarters), polygon, np.r_[np.arange(n), np.full(m, -1)], roles),
        Stage("cut the corners", Pick(n + np.arange(m), n + m), _finer(polygon), n + np.arange(m), roles[n:]),
    ))  # fmt: skip


def split_and_slide(t: Connectivity) -> Step:
    """Topology: every point twice.  Geometry: each copy slides a quarter of the way along its own edge."""
    polygon = as_polygon(t)
    ends = polygon.ends.ravel()
    m = len(ends)
    return Step((
        Stage("split", Pick(ends, polygon.n_vertices), _finer(polygon), ends, np.full(m, Role.ORIGINAL)),
        Stage("slide", _quarters(m), _finer(polygon), np.arange(m), np.full(m, Role.MOVED)),
    ))  # fmt: skip


def _quarters(m: int) -> Operator:
    """(m, m): of points in pairs, each a quarter of the way to its partner."""
    return 3 / 4 * identity(m) + 1 / 4 * Pick(np.arange(m) ^ 1, m)


def _finer(polygon: Polyline) -> Polyline:
    return Polyline(2 * polygon.n_edges, polygon.closed)


def _averaged(t: Connectivity) -> Step:
    return told(t, [split(0), average(ALONG, "average 1"), average(ALONG, "average 2")])


def _refuses(t: Connectivity) -> str:
    return room(t, (2, 0)) if isinstance(t, Polyline) else "it is not a polygon"


CHAIKIN = Scheme(
    name="chaikin",
    title="Chaikin's corner cutting",
    paper="Cha74",
    refuses=_refuses,
    tellings={
        "corner cutting": corner_cutting,
        "split and slide": split_and_slide,
        "split and average": _averaged,
        "stencils": lambda t: at_once("stencils", _averaged(t)),
    },
    limit=partial(curve_limit, degree=2),
)

"""Lane-Riesenfeld subdivision of uniform B-spline curves of any degree [LR80]_.

Split every point in two, then average neighbours ``degree`` times: symbol
``(1 + z)^(degree + 1) / 2^degree``.  An open polygon of N points becomes one of 2 N - degree,
a closed one of 2 N.
"""

from functools import partial

from subdivision.limit_nets import curve_limit
from subdivision.manifold import TopologyError
from subdivision.passes import Pass, at_once, average, merged, room, split, told, topology_and_geometry
from subdivision.rows import Connectivity, Polyline
from subdivision.scheme import Scheme
from subdivision.stage import Step
from subdivision.words import phrase

ALONG = (1, 0)


def lane_riesenfeld(degree: int) -> Scheme:
    """The scheme of degree ``degree`` >= 1.

    Raises
    ------
    TopologyError
        For a degree below 1: it would split without averaging.
    """
    if degree < 1:
        raise TopologyError(
            phrase("a curve of degree {degree} cannot be averaged into being; choose degree 1 or more", degree=degree)
        )
    return Scheme(
        name=f"lane-riesenfeld-{degree}",
        title=phrase("Lane-Riesenfeld, degree {degree}", degree=degree),
        paper="LR80",
        refuses=partial(_refuses, degree=degree),
        tellings={
            "split and average": lambda t: told(t, _split_and_average(degree)),
            "topology and geometry": lambda t: told_in_two(t, degree),
            "stencils": lambda t: at_once("stencils", told(t, _split_and_average(degree))),
        },
        limit=partial(curve_limit, degree=degree),
    )


def told_in_two(t: Connectivity, degree: int) -> Step:
    """Topology, the linear pass that keeps the shape; then geometry, the averages that move points."""
    topology = merged("topology", [split(0), average(ALONG)])
    if degree == 3:  # two averages send a point to the midpoint of the midpoints beside it
        return topology_and_geometry(t, topology)
    return told(t, [topology, *(average(ALONG, phrase("average {k}", k=k)) for k in range(2, degree + 1))])


def _split_and_average(degree: int) -> list[Pass]:
    return [split(0), *(average(ALONG, phrase("average {k}", k=k)) for k in range(1, degree + 1))]


def _refuses(t: Connectivity, degree: int) -> str:
    if not isinstance(t, Polyline):
        return "it is not a polygon"
    return room(t, (degree, 0))

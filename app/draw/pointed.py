"""What is pointed out: a row of a product of stages, and where it stands in its trace."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from app.draw.limits import is_whole, limit_of
from app.state import Spot
from subdivision import Stencil, Step, TopologyError, Trace
from subdivision.arrays import Floats

ACROSS: Mapping[str, str] = {
    "stage": "one stage",
    "step": "one whole step",
    "all": "all levels, from the control points",
    "limit": "to the limit, from the control points",
}
"""How far back a row is read."""


@dataclass(frozen=True)
class Pointed:
    """A row to point out: its point after ``stage`` stages, its contributors ``span`` stages before.

    ``place`` (3,) is where the point is, if not where the trace has it: at its limit.
    """

    stencil: Stencil
    stage: int
    span: int
    place: Floats | None = None


@lru_cache(maxsize=16)
def row_of(trace: Trace, spot: Spot, across: str) -> Pointed | None:
    """The row of a point, read back as far as ``across`` says; None for a control point, which is given.

    Raises
    ------
    TopologyError
        If there is no limit to read: the scheme tells none, the boundary has none, or a level is not complete.
    """
    k = spot.stage
    if across == "limit":
        return _to_limit(trace, spot)
    if k == 0:
        return None
    begin = {"stage": k - 1, "step": trace.begins(trace.levels[k - 1]), "all": 0}[across]
    return Pointed(Step(trace.stages[begin:k]).stencil(spot.point), k, k - begin)


def _to_limit(trace: Trace, spot: Spot) -> Pointed:
    k = spot.stage
    if not is_whole(trace, k):
        raise TopologyError("A limit is that of a whole level: go on to where this level ends.")
    stage = limit_of(trace.scheme, trace.topology_at(k))
    rows = np.flatnonzero(stage.carries == spot.point)
    if not len(rows):
        raise TopologyError(f"v{spot.point} has no limit of its own: not all points around it exist.")
    row = Step((*trace.stages[:k], stage)).stencil(int(rows[0]))
    place = row.weights @ trace.points[0][row.parents]
    return Pointed(Stencil(spot.point, row.terms), k, k, place)

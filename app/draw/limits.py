"""The level that is shown, pushed onto its limit."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from app.draw.picture import Markers, Scene, Shape
from app.draw.theme import Theme
from subdivision import Scheme, Stage, Topology, TopologyError, Trace
from subdivision.limit import levels_to_settle, limit_stage
from subdivision.rows import Connectivity
from subdivision.words import phrase

LIMIT_POINT = "limit point"
"""Name of its markers."""

UNDER_WAY = "A limit is that of a whole level, and this one is under way."

SMALL = 0.5
"""Size of a limit point, relative to a marker of its level."""

CROWDED = 0.1
"""... and relative to the typical edge, at most."""

MOST_FACES = 40_000
"""More than these are not made only to find a limit for a picture: it would have to wait."""

MOST = 3000
"""More limit points than this are not marked."""


def limit_of(scheme: Scheme, topology: Connectivity) -> Stage:
    """As ``subdivision.limit.limit_stage``, and known again.

    Raises
    ------
    TopologyError
        As there, and where it would keep a picture waiting.
    """
    known = _limits(topology)
    if id(scheme) not in known:
        _require_quick(scheme, topology)
        known[id(scheme)] = scheme, limit_stage(scheme, topology)
    return known[id(scheme)][1]


@lru_cache(maxsize=12)
def _limits(topology: Connectivity) -> dict[int, tuple[Scheme, Stage]]:
    return {}


def _require_quick(scheme: Scheme, topology: Connectivity) -> None:
    """Sharpness that wears off takes levels, and levels take time."""
    if isinstance(topology, Topology) and scheme.refinement is not None:
        levels = levels_to_settle(scheme, topology)
        if levels > 1 and (faces := scheme.faces_after(topology, levels)) > MOST_FACES:
            raise TopologyError(
                phrase(
                    "sharp edges take {levels} more levels to wear off, {faces:,} faces: no limit is shown before that",
                    levels=levels,
                    faces=faces,
                )
            )


def is_whole(trace: Trace, k: float) -> bool:
    """Whether a level is complete after ``k`` stages."""
    return k == int(k) and (k in (0, len(trace.stages)) or trace.levels[int(k)] > trace.levels[int(k) - 1])


def at_limit(trace: Trace, k: int) -> Trace:
    """The first ``k`` stages, and one more that takes every point of that level to its limit.

    Raises
    ------
    TopologyError
        If there is no limit: in words that say why.
    """
    stage = limit_of(trace.scheme, trace.topology_at(k))
    level = trace.levels[k - 1] if k else 0
    found = replace(trace, stages=(*trace.stages[:k], stage), levels=(*trace.levels[:k], level + 1))
    found.__dict__["points"] = (*trace.points[: k + 1], stage.operator.apply(trace.points[k]))  # those it had
    return found


def limit_or_refusal(trace: Trace, at: float) -> tuple[Trace | None, str]:
    """The trace with its limit, or a sentence that says why there is none; neither between two stages."""
    if not is_whole(trace, at):
        return None, UNDER_WAY if at == int(at) else ""
    try:
        return at_limit(trace, int(at)), ""
    except TopologyError as reason:
        words = str(reason)
        return None, phrase("{reason:sentence}", reason=words)


def marked(made: Scene, trace: Trace, theme: Theme) -> Scene:
    """The points of the level as small marks on the limit, numbered as in the level."""
    points, carries = trace.points[-1], trace.stages[-1].carries
    own = [m for m in made.markers if m.stage < 0 and (m.ids >= 0).any()]
    kept = tuple(m for m in made.markers if not any(m is other for other in own))
    ends = trace.stages[-1].topology.ends
    typical = float(np.median(np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1))) if len(ends) else 0.0
    radius = min(SMALL * max((float(m.radius.max()) for m in own), default=np.inf), CROWDED * typical)
    if not radius or len(points) > MOST:
        return replace(made, markers=kept)
    size, there = np.full(len(points), radius), np.ones(len(points))
    limits = Markers(points, Shape.SPHERE, theme.accent, size, there, carries, LIMIT_POINT)
    return replace(made, markers=(*kept, limits))

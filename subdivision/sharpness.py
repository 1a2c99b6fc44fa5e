"""Semi-sharp creases and corners [DKT98]_, blended between levels as OpenSubdiv does.

A vertex follows one of four rules, told by its sharpness and that of its edges: *smooth*
(no sharp edge; with one it is a dart, which is smooth too), *crease* (two sharp edges) or
*corner* (three and more, or a sharp vertex).  Where the rule softens on the next level, the
vertex takes a share of both rules: as much of the old one as sharpness is left, on average.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from subdivision.arrays import Floats, Indices, Mask
from subdivision.operators import Operator, mix
from subdivision.refine import worn
from subdivision.weights import Weights, by_value

SMOOTH, CREASE, CORNER = 0, 1, 2


class Sharpened(Protocol):
    """A mesh, as far as its sharpness is concerned."""

    @property
    def n_vertices(self) -> int: ...
    @property
    def ends(self) -> Indices: ...
    @property
    def edge_sharpness(self) -> Floats: ...
    @property
    def vertex_sharpness(self) -> Floats: ...


@dataclass(frozen=True, eq=False)
class VertexRules:
    """Which rule every vertex follows in this step, and which in the next.

    Attributes
    ----------
    now, then : (n_vertices,) int
        SMOOTH, CREASE or CORNER.
    stays : (n_vertices,) float
        The share of ``now``; the rest follows ``then``.
    sharp_now, sharp_then : (n_edges,) bool
        Edges that make the creases of each.
    """

    now: Indices
    then: Indices
    stays: Floats
    sharp_now: Mask
    sharp_then: Mask


def vertex_rules(t: Sharpened) -> VertexRules:
    """The rules of one step on ``t``."""
    edges, vertices = t.edge_sharpness, t.vertex_sharpness
    now, then = _rule(t, vertices, edges), _rule(t, worn(vertices), worn(edges))
    return VertexRules(now, then, np.where(now == then, 1.0, _remaining(t)), edges > 0, worn(edges) > 0)


def edge_share(t: Sharpened) -> Weights:
    """How much of every edge point is the plain midpoint: sharpness, at most 1."""
    return by_value(np.minimum(t.edge_sharpness, 1))


def blend(rules: VertexRules, smooth: Operator, crease: Callable[[Mask], Operator], corner: Operator) -> Operator:
    """One row per vertex by its rule; ``crease`` makes the rows of a curve along some sharp edges."""
    now = _chosen(rules.now, smooth, crease(rules.sharp_now), corner)
    if (rules.stays == 1).all():
        return now
    return mix(by_value(rules.stays), now, _chosen(rules.then, smooth, crease(rules.sharp_then), corner))


def _chosen(rule: Indices, smooth: Operator, crease: Operator, corner: Operator) -> Operator:
    if not rule.any():
        return smooth
    sharp = mix(by_value(rule == CREASE), crease, corner) if (rule == CORNER).any() else crease
    return mix(by_value(rule == SMOOTH), smooth, sharp)


def _rule(t: Sharpened, vertices: Floats, edges: Floats) -> Indices:
    sharp_edges = np.bincount(t.ends[edges > 0].ravel(), minlength=t.n_vertices)
    rule = np.select([sharp_edges < 2, sharp_edges == 2], [SMOOTH, CREASE], CORNER)
    return np.where(vertices > 0, CORNER, rule)


def _remaining(t: Sharpened) -> Floats:
    """The mean sharpness of what turns smooth after this step, at most 1 (every such value is at most 1)."""
    edges = np.where(t.edge_sharpness <= 1, t.edge_sharpness, 0)
    fading = np.where(t.vertex_sharpness <= 1, t.vertex_sharpness, 0)
    total = fading + np.bincount(t.ends.ravel(), weights=np.repeat(edges, 2), minlength=t.n_vertices)
    count = (fading > 0) + np.bincount(t.ends[edges > 0].ravel(), minlength=t.n_vertices)
    return total / np.maximum(count, 1)

"""What several lessons measure on screen, and how they leave helpers out."""

from dataclasses import replace
from functools import lru_cache
from itertools import chain

import numpy as np

from lessons.script import Reading
from subdivision import Mesh, Stage, Topology, Trace
from subdivision.measure import angle_sum, counts, edges_apart, largest_distance, largest_gap
from subdivision.words import phrase, plural


def difference(a: Mesh, b: Mesh) -> str:
    """The distance between points of the same number, where it is largest; rounding errors below 1e-12 are 0."""
    return phrase("largest difference {distance}", distance=_rounded(largest_distance(a, b)))


def gap(a: Mesh, b: Mesh) -> str:
    """How far the points of ``b`` are from the nearest of ``a``, where they are farthest: for other numberings."""
    return phrase("largest difference {distance}", distance=_rounded(largest_gap(b.points, a.points)))


def counted(mesh: Mesh) -> str:
    """Vertices, edges, faces and their alternating sum."""
    n = counts(mesh.topology)
    return f"V {n.vertices}   E {n.edges}   F {n.faces}   χ {n.euler}"


def angles_at(vertex: int) -> Reading:
    """The angle sum at a vertex."""
    return lambda mesh: phrase("angle sum {angle:.2f}°", angle=angle_sum(mesh, vertex))


def isolation(mesh: Mesh) -> str:
    """How many extraordinary vertices there are, and how many edges the nearest two are apart."""
    edges = nearest(mesh)
    special = int(mesh.surface.extraordinary.sum())
    return plural("{n} extraordinary, {edges} edge apart", "{n} extraordinary, {edges} edges apart", edges,
                  n=special, edges=edges)


def nearest(mesh: Mesh) -> int:
    """The least number of edges between two extraordinary vertices."""
    return _nearest(mesh.surface)


@lru_cache(maxsize=16)
def _nearest(surface: Topology) -> int:
    special = np.flatnonzero(surface.extraordinary)
    ways = edges_apart(surface, special)
    return int(ways[~np.eye(len(special), dtype=bool)].min())


def same_rows(a: Trace, b: Trace) -> bool:
    """Whether all points of two traces have the same weights, as exact fractions."""
    n = a.stages[-1].n_points
    return n == b.stages[-1].n_points and all(a.whole.stencil(k) == b.whole.stencil(k) for k in range(n))


def without_helpers(told: Trace) -> Trace:
    """Centroids and geometry of every level as one stage, so that a level has two."""
    steps = [told.step(level).stages for level in range(told.levels[-1] + 1)]
    stages = list(chain.from_iterable((topology, _joined(helpers, geometry)) for topology, helpers, geometry in steps))
    return replace(told, stages=tuple(stages), levels=tuple(k // 2 for k in range(len(stages))))


def _joined(helpers: Stage, geometry: Stage) -> Stage:
    """The helpers made and used at once; those before them keep their numbers."""
    return replace(geometry, operator=geometry.operator @ helpers.operator)


def _rounded(distance: float) -> str:
    return f"{round(distance, 12):g}"

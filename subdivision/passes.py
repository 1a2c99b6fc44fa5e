"""Split and average on polygons and rectangular nets: every pass is a stage.

A pass averages each point with the one ``v`` further on, if both exist; along a wrapped
direction they always do.  It shortens an open net by ``|v|``, and every point that is left
continues the one it started from.
"""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import TypeAlias

import numpy as np
from scipy.sparse import csr_array

from subdivision.arrays import Indices
from subdivision.manifold import TopologyError
from subdivision.operators import MeanOf, Operator, Pick, identity, stack
from subdivision.rows import Connectivity, Grid, Polyline
from subdivision.stage import Role, Stage, Step
from subdivision.words import phrase

Vector: TypeAlias = tuple[int, int]
Pass: TypeAlias = Callable[[Connectivity], Stage]
"""Makes the next stage of what the stages before have made."""


def told(topology: Connectivity, passes: Iterable[Pass]) -> Step:
    """The passes one after the other; a point is told apart while it is an original, a midpoint or a centroid."""
    stages: list[Stage] = []
    sofar: csr_array | None = None
    for make in passes:
        stage = make(stages[-1].topology if stages else topology)
        sofar = stage.matrix if sofar is None else csr_array(stage.matrix @ sofar)
        stages.append(replace(stage, roles=_roles(sofar)))
    return Step(tuple(stages))


def at_once(name: str, step: Step) -> Step:
    """A whole step as a single stage; a new point continues the old one that makes up most of it."""
    matrix = step.matrix
    heavy = matrix.tocoo()
    kept = np.flatnonzero(heavy.data > 1 / 2 + 1e-12)
    kept = kept[np.lexsort((-heavy.col[kept], heavy.data[kept]))]  # the heaviest last, of equals the first: it stays
    carries = np.full(matrix.shape[0], -1)
    carries[heavy.row[kept]] = heavy.col[kept]
    operator = _composed(step)
    return Step((Stage(name, operator, step.topology, carries, _roles(matrix)),))


def topology_and_geometry(topology: Connectivity, linear: Pass) -> Step:
    """The linear pass that keeps the shape; then every vertex goes to the centroid of the centroids around it."""
    first = linear(topology)
    return Step((first, cell_centroids(first.topology, first.roles), centroid_of_centroids(first.topology)))


def split(direction: int) -> Pass:
    """Every point twice, along the polygon or along ``direction`` 0 (s) or 1 (t) of a net."""

    def stage(t: Connectivity) -> Stage:
        if isinstance(t, Polyline):
            return _copies("split", np.repeat(np.arange(t.n_vertices), 2), Polyline(2 * t.n_vertices, t.closed), t)
        grid = as_grid(t)
        twice = np.repeat(grid.numbers, 2, axis=direction)
        return _copies(
            phrase("split {direction}", direction="st"[direction]), twice.ravel(), _resized(grid, twice.shape), grid
        )

    return stage


def quadruple(t: Connectivity) -> Stage:
    """Every point of a net four times."""
    grid = as_grid(t)
    four = np.repeat(np.repeat(grid.numbers, 2, axis=0), 2, axis=1)
    return _copies("quadruple", four.ravel(), _resized(grid, four.shape), grid)


def average(v: Vector, name: str | None = None) -> Pass:
    """One averaging pass along ``v`` on a net; on a polygon ``v`` is (1, 0)."""

    def stage(t: Connectivity) -> Stage:
        if isinstance(t, Polyline):
            ends = np.stack([np.arange(t.n_vertices), np.roll(np.arange(t.n_vertices), -1)], axis=1)
            ends = ends if t.closed else ends[:-1]
            return _means(name or "average", ends, Polyline(len(ends), t.closed), t, ends[:, 0])
        grid = as_grid(t)
        here, there = _pairs(grid, v)
        ends = np.stack([here.ravel(), there.ravel()], axis=1)
        return _means(
            name or phrase("average {vector}", vector=spelled(v)), ends, _resized(grid, here.shape), grid, ends[:, 0]
        )

    return stage


def cell_averages(name: str) -> Pass:
    """One round of centroid averaging: every cell of a net goes to its centroid, which continues its first corner."""

    def stage(t: Connectivity) -> Stage:
        grid = as_grid(t)
        cells = _cells(grid)
        shape = (grid.n_s - (not grid.wrap_s), grid.n_t - (not grid.wrap_t))
        return _means(name, cells, _resized(grid, shape), grid, cells[:, 0])

    return stage


def merged(name: str, passes: Iterable[Pass]) -> Pass:
    """Several passes shown as one stage: what is a copy stays, the rest is born."""

    def stage(t: Connectivity) -> Stage:
        step = told(t, passes)
        matrix = step.matrix
        single = np.diff(matrix.indptr) == 1
        source = np.where(single, matrix.indices[np.minimum(matrix.indptr[:-1], len(matrix.indices) - 1)], -1)
        return Stage(name, _composed(step), step.topology, source, step.stages[-1].roles)

    return stage


def cell_centroids(t: Connectivity, roles: Indices) -> Stage:
    """Helpers: the midpoint of every edge of a polygon, the centroid of every cell of a net."""
    cells = _cells(t)
    n, m = t.n_vertices, len(cells)
    return Stage(
        "centroids", stack(identity(n), MeanOf(cells, n)), t, np.r_[np.arange(n), np.full(m, -1)],
        np.r_[roles, np.full(m, Role.CENTROID)],
    )  # fmt: skip


def centroid_of_centroids(t: Connectivity) -> Stage:
    """Every vertex with all its cells goes to the mean of their centroids; the rim is lost."""
    if isinstance(t, Polyline):
        n, around = t.n_vertices, np.arange(t.n_edges)
        pairs = np.stack([around, np.roll(around, -1)], axis=1)
        pairs = pairs if t.closed else pairs[:-1]
        kept, coarse = np.arange(1, len(pairs) + 1) % n, Polyline(len(pairs), t.closed)
        return Stage("geometry", MeanOf(n + pairs, n + t.n_edges), coarse, kept, np.full(len(kept), Role.MOVED))
    grid = as_grid(t)
    n_s, n_t = grid.n_s - (not grid.wrap_s), grid.n_t - (not grid.wrap_t)
    cells = Grid(n_s, n_t, grid.wrap_s, grid.wrap_t) if min(n_s, n_t) > 0 else grid
    a, d = _pairs(cells, (1, 1))
    b, c = cells.numbers[1:, :-1], cells.numbers[:-1, 1:]
    if grid.wrap_s or grid.wrap_t:
        b, c = _neighbour(cells, (1, 0), a.shape), _neighbour(cells, (0, 1), a.shape)
    four = np.stack([x.ravel() for x in (a, b, c, d)], axis=1)
    kept = _neighbour(grid, (1, 1), a.shape).ravel()
    operator = MeanOf(grid.n_vertices + four, grid.n_vertices + cells.n_vertices)
    return Stage("geometry", operator, _resized(grid, a.shape), kept, np.full(len(kept), Role.MOVED))


def spelled(v: Vector) -> str:
    """A direction as a stage names it: s, t, or the vector."""
    return {(1, 0): "s", (0, 1): "t"}.get(v, f"({v[0]},{v[1]})")


def as_grid(t: Connectivity) -> Grid:
    """``t`` itself, if it is a rectangular net."""
    if not isinstance(t, Grid):
        raise TopologyError("this scheme subdivides rectangular nets, not polygons or meshes")
    return t


def as_polygon(t: Connectivity) -> Polyline:
    """``t`` itself, if it is a polygon."""
    if not isinstance(t, Polyline):
        raise TopologyError("this scheme subdivides polygons, not nets or meshes")
    return t


def room(t: Connectivity, lost: tuple[int, int]) -> str:
    """Why an open control object is too small for passes that shorten it by ``lost``; empty where it is not."""
    if isinstance(t, Polyline):
        sizes = [(phrase("points"), t.n_vertices, lost[0], t.closed)]
    elif isinstance(t, Grid):
        sizes = [
            (phrase("rows in s"), t.n_s, lost[0], t.wrap_s),
            (phrase("columns in t"), t.n_t, lost[1], t.wrap_t),
        ]
    else:
        return "it is a polygon mesh, not a polygon or a rectangular net"
    for what, n, s, wrapped in sizes:
        if not wrapped and n <= s:
            return phrase(
                "each step shortens it by {s}, so {n} {what} would never grow; it needs at least {least} {what}",
                s=s,
                n=n,
                what=what,
                least=s + 1,
            )
    return ""


def _pairs(grid: Grid, v: Vector) -> tuple[Indices, Indices]:
    """Point numbers ``k`` and ``k + v`` wherever both exist, as arrays of the shortened shape."""
    (i, i_on), (j, j_on) = (
        _reach(n, step, wrap) for n, step, wrap in zip(grid.shape, v, (grid.wrap_s, grid.wrap_t), strict=True)
    )
    return grid.numbers[np.ix_(i, j)], grid.numbers[np.ix_(i_on, j_on)]


def _reach(n: int, step: int, wrap: bool) -> tuple[Indices, Indices]:
    here = np.arange(n) if wrap else np.arange(max(0, -step), min(n, n - step))
    if len(here) == 0:
        raise TopologyError(
            phrase("no two of the {n} rows are {apart} apart; the net is too small for this pass", n=n, apart=abs(step))
        )
    return here, (here + step) % n


def _neighbour(grid: Grid, v: Vector, shape: tuple[int, ...]) -> Indices:
    """The numbers of the points ``v`` further on than the first ``shape`` points."""
    i, j = (np.arange(shape[0]) + v[0]) % grid.n_s, (np.arange(shape[1]) + v[1]) % grid.n_t
    return grid.numbers[np.ix_(i, j)]


def _cells(t: Connectivity) -> Indices:
    if isinstance(t, Polyline):
        return t.ends
    grid = as_grid(t)
    return replace(grid, diagonal=False).origin.reshape(-1, 4)


def _resized(grid: Grid, shape: tuple[int, ...]) -> Grid:
    return replace(grid, n_s=shape[0], n_t=shape[1])


def _copies(name: str, source: Indices, after: Connectivity, before: Connectivity) -> Stage:
    operator = Pick(source, before.n_vertices)
    return Stage(name, operator, after, source, np.full(len(source), Role.ORIGINAL))


def _means(name: str, ends: Indices, after: Connectivity, before: Connectivity, carries: Indices) -> Stage:
    return Stage(name, MeanOf(ends, before.n_vertices), after, carries, np.full(len(ends), Role.MOVED))


def _composed(step: Step) -> Operator:
    operator = step.stages[0].operator
    for stage in step.stages[1:]:
        operator = stage.operator @ operator
    return operator


def _roles(sofar: csr_array) -> Indices:
    sofar.eliminate_zeros()
    sizes = np.diff(sofar.indptr)
    even = np.asarray(sofar.max(axis=1).toarray()).ravel() * sizes < 1 + 1e-12
    if not (even & np.isin(sizes, (1, 2, 4))).all():
        return np.full(len(sizes), Role.MOVED)
    return np.select([sizes == 1, sizes == 2], [Role.ORIGINAL, Role.EDGE], Role.FACE)

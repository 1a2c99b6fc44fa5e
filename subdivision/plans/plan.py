"""Subdivision of a mesh laid out once for its topology, then applied to points, and to moved points again.

The first levels are kernels, one after the other.  Where the rest is deep, a table for each
kind of face makes it at once; a small mesh has one table for everything.  Dual schemes have
steps of their own, and tables for each kind of corner; so have those that flip edges, and the
butterfly, for each kind of triangle.  Interpolating quads are grids.  Schemes that have none,
and quads of open meshes, are told in stages, which all of this is tested against.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, partial
from typing import TypeAlias

import numpy as np

from subdivision import refine
from subdivision.arrays import Floats, Indices, frozen, inverse
from subdivision.meshes import as_mesh
from subdivision.plans.butterfly_later import Butterfly, butterfly_after
from subdivision.plans.butterfly_steps import Beside, butterfly_step
from subdivision.plans.butterfly_tables import DEPTHS as BUTTERFLY_DEPTHS
from subdivision.plans.butterfly_tables import butterfly_tables
from subdivision.plans.corner_blocks import Blocks, blocks
from subdivision.plans.corner_numbers import Numbering
from subdivision.plans.corner_steps import CornerStep, Wave
from subdivision.plans.grids import Grids, grids
from subdivision.plans.kernels import Kernel, Rows, Rule, assembled, kernel
from subdivision.plans.later import Later, later
from subdivision.plans.middle_steps import MiddleStep
from subdivision.plans.middle_steps import Reach as MiddleReach
from subdivision.plans.middle_tables import DEPTHS, MiddleTables, middle_tables
from subdivision.plans.nearby import Nearby, nearby
from subdivision.plans.tables import Tables, tables
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.stage import Step
from subdivision.topology import INFINITELY_SHARP, Topology

DEEPEST = 5
"""Tables of more levels would not be faster: a point costs the same at any depth."""

WORTH_TABLES = 20_000
"""Fine faces from where on laying out tables takes less time than they save."""

FACES_A_KIND, FINE_FACES_A_KIND = 6, 2_000
"""What a kind of face must stand for on average, before and after, to be worth a table."""

SCATTERED = 2_000
"""Control points from where on it is worth, for points that are moved again, to number them along the mesh first."""

SMALL, SMALL_ENOUGH = 16, 8_000
"""Control points, and points made of them, up to which one dense matrix is the fastest plan."""

AnyStep: TypeAlias = (
    Kernel | Later | CornerStep | Blocks | Grids | MiddleStep | MiddleTables | Butterfly | Rows | Step | Tables | Nearby
)


@dataclass(frozen=True, eq=False)
class Plan:
    """``levels`` steps from one topology.

    Attributes
    ----------
    topology : Connectivity
        The outcome's.  Of meshes, half-edges, edges and faces are numbered as by the stages.
    steps : (AnyStep, ...)
        One after the other they make the points.
    whole : (n_vertices after, n_vertices before) float, optional
        The product of the steps, where that is small.
    stages : () -> Topology, optional
        Makes the outcome's with the vertices numbered as by the stages; None where they are.
    """

    topology: Connectivity
    steps: tuple[AnyStep, ...]
    whole: Floats | None = None
    stages: Callable[[], Topology] | None = None

    def apply(self, points: Floats, out: Floats | None = None) -> Floats:
        """(n_vertices, d) float before -> (n_vertices, d) float after, into ``out`` if there is one.

        Who applies a plan again and again saves the time to find new memory.
        """
        if self.whole is not None:
            return self.whole.dot(points, out)
        points = np.ascontiguousarray(points, dtype=float)
        for step in self.steps[:-1]:
            points = step.apply(points)
        for last in self.steps[-1:]:
            if not isinstance(last, Step):
                return last.apply(points, out)
            points = last.apply(points)
        if out is None:
            return points
        out[:] = points
        return out

    @cached_property
    def numbers(self) -> Indices:
        """(n_vertices,) int: where the points are that the stages number 0, 1, 2, ..."""
        numbers = np.arange(self.topology.n_vertices)
        for near in self.steps[:1]:
            if isinstance(near, Nearby):  # no half-edge tells where isolated vertices are
                numbers[: len(near.vertices)] = inverse(near.vertices)
        if self.stages is not None:
            numbers[self.stages().origin] = self.topology.origin
        return frozen(numbers)


def plan(t: Connectivity, scheme: Scheme, levels: int) -> Plan:
    """The plan of ``levels`` steps of ``scheme`` on ``t``.

    Raises
    ------
    TopologyError
        If the scheme refuses the control object.
    """
    laid_out = _along(t, scheme, levels) or once(t, scheme, levels)
    if levels > 0 and t.n_vertices <= SMALL and laid_out.topology.n_vertices <= SMALL_ENOUGH:
        return replace(laid_out, whole=np.asfortranarray(laid_out.apply(np.eye(t.n_vertices))))
    return replace(laid_out, steps=tuple(map(_kept, laid_out.steps)))


def once(t: Connectivity, scheme: Scheme, levels: int) -> Plan:
    """The same plan, quicker to make and, of small meshes, slower to apply."""
    scheme.require(t)
    rule = _rule(t, scheme)
    if isinstance(t, Topology) and scheme.corners and scheme.numbering:
        return _dual(t, scheme, scheme.corners, scheme.numbering, levels)
    if isinstance(t, Topology) and scheme.middles:
        return _flipping(t, scheme.middles, levels, scheme.faces_after(t, levels))
    if isinstance(t, Topology) and scheme.beside:
        return _butterfly(t, scheme.beside, levels, scheme.faces_after(t, levels))
    if in_grids := _grids(t, scheme, levels):
        return Plan(in_grids.topology, (in_grids,), stages=in_grids.refined)
    if rule is None or not isinstance(t, Topology) or scheme.refinement is None:
        return _staged(t, scheme, levels)
    fine = scheme.refinement.faces(t, levels) if levels else 0
    steps: list[Kernel | Later] = []
    before = t
    while len(steps) < levels:
        depth = levels - len(steps)
        if steps and 1 < depth <= DEEPEST and fine > WORTH_TABLES:
            deep = tables(t, depth, rule, at_most=min(t.n_faces // FACES_A_KIND, fine // FINE_FACES_A_KIND))
            if deep:
                return _deep(steps, deep)
        steps.append(later(before, t, rule) if steps else kernel(t, rule))
        before, t = t, steps[-1].refined()
    return Plan(t, tuple(steps))


def is_swift(t: Connectivity, scheme: Scheme, levels: int) -> bool:
    """Whether whole arrays make all of it, which need little memory beside it."""
    if not isinstance(t, Topology):
        return False
    is_dual = scheme.corners and scheme.numbering and levels % scheme.numbering.steps == 0
    return bool(scheme.reach or scheme.middles or scheme.beside or is_dual or scheme.tension is not None)


def _kept(step: AnyStep) -> AnyStep:
    """The same step, slower to make and quicker to apply; rows of triangles are short."""
    if isinstance(step, Kernel):
        return assembled(step)
    if isinstance(step, Later) and step.rule.size == 3:
        return assembled(kernel(step.coarse, step.rule))
    if isinstance(step, CornerStep | Grids | MiddleStep | Butterfly):
        return step.assembled()
    return Rows(step.matrix) if isinstance(step, Step) else step


def _rule(t: Connectivity, scheme: Scheme) -> Rule | None:
    """What makes the kernels of ``scheme``, if it has any for this mesh."""
    if scheme.reach is None or scheme.refinement is None or not isinstance(t, Topology):
        return None
    if (t.edge_sharpness[t.boundary] < INFINITELY_SHARP).any():
        return None
    return Rule(scheme.refinement.size, scheme.reach)


def _dual(t: Topology, scheme: Scheme, wave: Wave, numbering: Numbering, levels: int) -> Plan:
    """Points in the corners, then blocks of them; a step for itself where two would double."""
    fine = scheme.faces_after(t, levels)
    doublings, single = divmod(levels, numbering.steps)
    steps: list[AnyStep] = []
    for _ in range(single):
        steps.append(step := scheme.step(t))
        t = as_mesh(step.topology)
    if doublings > 1 and fine > WORTH_TABLES and (deep := blocks(t, wave, numbering, doublings - 1)):
        return Plan(deep.topology, (*steps, CornerStep(t, wave, numbering), deep), stages=deep.refined)
    for _ in range(doublings):
        steps.append(corner_step := CornerStep(t, wave, numbering))
        t = corner_step.topology
    return Plan(t, tuple(steps))


def _flipping(t: Topology, reach: MiddleReach, levels: int, fine: int) -> Plan:
    """Middles and flips step by step, then blocks; the first step of these is made for itself."""
    steps: list[MiddleStep] = []
    while len(steps) < levels:
        step, depth = MiddleStep(t, reach), levels - len(steps)
        if steps and depth in DEPTHS and fine > WORTH_TABLES:
            deep = middle_tables(step, depth, at_most=fine // FINE_FACES_A_KIND)
            if deep:
                return Plan(deep.topology, (*steps, step, deep))
        steps.append(step)
        t = step.topology
    return Plan(t, tuple(steps))


def _butterfly(t: Topology, beside: Beside, levels: int, fine: int) -> Plan:
    """Step by step, then by tables, which begin one step on; open meshes have none."""
    steps: list[Butterfly] = []
    while len(steps) < levels:
        step = butterfly_after(steps[-1]) if steps else butterfly_step(t, beside)
        depth = levels - len(steps)
        if steps and depth in BUTTERFLY_DEPTHS and fine > WORTH_TABLES:
            most = min(t.n_faces // FACES_A_KIND, fine // FINE_FACES_A_KIND)
            deep = butterfly_tables(t, depth, beside, most)
            if deep:
                return _deep([*steps, step], deep)
        steps.append(step)
        t = step.topology
    return Plan(t, tuple(steps))


def _grids(t: Connectivity, scheme: Scheme, levels: int) -> Grids | None:
    """All steps at once, if there are many points; a single one numbers them as the stages do, and may be small."""
    if not isinstance(t, Topology) or scheme.tension is None or levels == 0:
        return None
    return grids(t, scheme.tension, levels) if levels == 1 or scheme.faces_after(t, levels) > WORTH_TABLES else None


def _staged(t: Connectivity, scheme: Scheme, levels: int) -> Plan:
    steps: list[Step] = []
    for _ in range(levels):
        steps.append(scheme.step(t))
        t = steps[-1].topology
    return Plan(t, tuple(steps))


def _deep(steps: Sequence[AnyStep], deep: Tables) -> Plan:
    """Some steps, and all others at once."""
    size = deep.coarse.n_halfedges // deep.coarse.n_faces
    stages = lru_cache(partial(_refined, deep.coarse, size, deep.depth))
    return Plan(_renumbered(stages, deep.coarse, deep.origin, size, deep.n_points), (*steps, deep), stages=stages)


def _along(t: Connectivity, scheme: Scheme, levels: int) -> Plan | None:
    """The plan for the mesh numbered along its surface; None where that is not worth while."""
    rule = _rule(t, scheme)
    if rule is None or not isinstance(t, Topology) or levels == 0 or t.n_vertices < SCATTERED:
        return None
    scheme.require(t)
    near = nearby(t)
    made = once(near.topology, scheme, levels)
    origin = near.as_before(made.topology.origin, rule.size, levels)
    stages = lru_cache(partial(_refined, t, rule.size, levels))
    outcome = _renumbered(stages, t, origin, rule.size, made.topology.n_vertices)
    return Plan(outcome, (near, *made.steps), stages=stages)


def _renumbered(
    stages: Callable[[], Topology], coarse: Topology, origin: Indices, size: int, n_vertices: int
) -> Topology:
    """What ``stages`` make of ``coarse``, but for the numbers of the vertices."""
    names = ("twin", "edge", "edge_sharpness", "vertex_sharpness", "hidden")
    make = {name: partial(lambda name: getattr(stages(), name), name) for name in names}
    return refine.deferred(coarse, make, origin, size, n_vertices)


def _refined(t: Topology, size: int, levels: int) -> Topology:
    """What the stages make of ``t``."""
    for _ in range(levels):
        t = refine.quads(t) if size == 4 else refine.triangles(t)
    return t

"""A control object carried through the stages of a scheme, ready to be looked at."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import overload

import numpy as np

from subdivision.arrays import Floats, Indices, Mask, frozen
from subdivision.manifold import TopologyError
from subdivision.plans.plan import is_swift, once
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.size import STAGED, SWIFT, TRACED, require_room
from subdivision.stage import Role, Stage, Step
from subdivision.topology import Topology
from subdivision.words import phrase


@dataclass(frozen=True, eq=False)
class Mesh:
    """Positions ``points`` (n_vertices, 3) float on a ``topology``: a polygon, a net or a polygon mesh."""

    topology: Connectivity
    points: Floats

    def __post_init__(self) -> None:
        kept = isinstance(self.points, np.ndarray) and not self.points.flags.writeable
        points = np.array(self.points, dtype=float, copy=None if kept else True)
        if points.shape != (self.topology.n_vertices, 3):
            raise ValueError(
                phrase(
                    "{n} vertices need points of shape (n, 3), not {shape}",
                    n=self.topology.n_vertices,
                    shape=points.shape,
                )
            )
        object.__setattr__(self, "points", frozen(points))

    @property
    def surface(self) -> Topology:
        """The half-edge topology of a polygon mesh.

        Raises
        ------
        TopologyError
            If this is a polygon or a net.
        """
        if not isinstance(self.topology, Topology):
            raise TopologyError("this control object is not a polygon mesh")
        return self.topology

    def moved(self, vertex: int, to: Floats) -> "Mesh":
        """The same connectivity with one vertex elsewhere."""
        points = self.points.copy()
        points[vertex] = to
        return replace(self, points=points)


@dataclass(frozen=True, eq=False)
class Frame:
    """What there is to see at one instant of a trace.

    Attributes
    ----------
    topology : Connectivity
        What connects the first ``topology.n_vertices`` points; the others are helpers.
    points : (n, 3) float
        Where every point is now.
    start : (n, 3) float
        Where it was when the stage began (newborn points: where they are born).
    birth : (n,) float in 0..1
        How much of it is there: newborn points grow.
    roles, roles_before : (n,) int
        What each point is becoming, and was.
    stage : Stage or None
        The stage under way, or the one just over; None before the first.
    progress : float in 0..1
        How far that stage has come.
    before : Mesh
        What the stage began with, its helpers left out.
    old_points, old_roles : (n_old, 3) float, (n_old,) int
        All points the stage began with, helpers too.
    leaving : (m,) int
        The old points that nothing continues; they fade as ``progress`` grows.
    level : int
        How many subdivision steps are complete.
    """

    topology: Connectivity
    points: Floats
    start: Floats
    birth: Floats
    roles: Indices
    roles_before: Indices
    stage: Stage | None
    progress: float
    before: Mesh
    old_points: Floats
    old_roles: Indices
    leaving: Indices
    level: int

    @property
    def newborn(self) -> Mask:
        """(n,) bool: points that the stage under way brings."""
        return self.birth < 1 if self.stage is None else np.asarray(self.stage.carries < 0)


@dataclass(frozen=True, eq=False)
class Trace:
    """``stages`` depend on the control topology only, so dragging a vertex rebuilds none of them.

    ``levels`` tells, for every stage, which subdivision step (0, 1, ...) it belongs to.
    """

    control: Mesh
    scheme: Scheme
    telling: str
    stages: tuple[Stage, ...]
    levels: tuple[int, ...]

    @cached_property
    def points(self) -> Sequence[Floats]:
        """Positions before the first stage and after each one."""
        done = [self.control.points]
        for stage in self.stages:
            done.append(frozen(stage.operator.apply(done[-1])))
        return tuple(done)

    @cached_property
    def whole(self) -> Step:
        """All stages of all levels, as one product."""
        return Step(self.stages)

    def step(self, level: int) -> Step:
        """The stages of one level."""
        return Step(tuple(s for s, of in zip(self.stages, self.levels, strict=True) if of == level))

    def upto(self, k: int) -> Step:
        """The first ``k`` stages, as one product."""
        return Step(self.stages[:k])

    def index(self, stage: Stage) -> int:
        return next(k for k, s in enumerate(self.stages) if s is stage)

    def begins(self, level: int) -> int:
        """How many stages come before subdivision step ``level``."""
        return sum(of < level for of in self.levels)

    def topology_at(self, k: int) -> Connectivity:
        return self.stages[k - 1].topology if k else self.control.topology

    def mesh_at(self, k: int) -> Mesh:
        """The control object after ``k`` stages, helpers left out."""
        topology = self.topology_at(k)
        return Mesh(topology, self.points[k][: topology.n_vertices])

    def roles_at(self, k: int) -> Indices:
        return self.stages[k - 1].roles if k else np.zeros(len(self.points[0]), dtype=np.intp)

    def with_control(self, control: Mesh) -> "Trace":
        """The same stages on moved control points."""
        return replace(self, control=control)

    def dragged(self, moves: Mapping[int, Floats]) -> "Trace":
        """The same stages with some control points elsewhere: ``vertex -> where to``, (3,) float.

        Every stage is linear, so each of its points goes by its own share of the move: one sparse
        update for each vertex, whatever the size of the rest, after those stages only that are looked at.
        """
        points = self.control.points.copy()
        ways = {vertex: np.asarray(to, dtype=float) - points[vertex] for vertex, to in moves.items()}
        for vertex, way in ways.items():
            points[vertex] += way
        there = self.with_control(Mesh(self.control.topology, points))
        moved = _Later(len(self.points), lambda k: self._moved(ways, k) if k else there.control.points)
        there.__dict__["points"] = moved  # where a cached property keeps its value
        return there

    def _moved(self, ways: Mapping[int, Floats], k: int) -> Floats:
        """The positions after ``k`` stages where control points go some ways."""
        after = self.points[k].copy()
        for vertex, way in ways.items():
            touched, share = self._influence(vertex, k)
            after[touched] += share[:, None] * way
        return frozen(after)

    def influence(self, vertex: int, k: int) -> Floats:
        """(n_points,): how much of control point ``vertex`` each point holds after ``k`` stages: its basis function."""
        touched, share = self._influence(vertex, k)
        found = np.zeros(len(self.roles_at(k)))
        found[touched] = share
        return found

    @cached_property
    def _influences(self) -> dict[tuple[int, int], tuple[Indices, Floats]]:
        return {}

    def _influence(self, vertex: int, k: int) -> tuple[Indices, Floats]:
        """The points that a control vertex reaches in ``k`` stages, and how much of it each of them holds."""
        if not k:
            return np.array([vertex]), np.ones(1)
        if (vertex, k) not in self._influences:
            touched, share = self._influence(vertex, k - 1)
            operator = self.stages[k - 1].operator
            column = np.zeros((operator.shape[1], 1))
            column[touched, 0] = share
            column = operator.apply(column)
            touched = np.flatnonzero(column)
            self._influences[vertex, k] = touched, column[touched, 0]
        return self._influences[vertex, k]

    def frame(self, at: float) -> Frame:
        """The frame ``at`` stages into the trace; the fraction is progress through a stage."""
        at = min(max(at, 0.0), float(len(self.stages)))
        k = min(int(at), len(self.stages) - 1) if self.stages else 0
        if at == 0:
            return self._still()
        if at == int(at):
            k = int(at) - 1
        return self._during(k, at - k)

    def _still(self) -> Frame:
        n = len(self.points[0])
        roles = np.full(n, Role.ORIGINAL)
        return Frame(
            self.control.topology, self.points[0], self.points[0], np.ones(n), roles, roles, None, 1.0,
            self.control, self.points[0], roles, np.zeros(0, dtype=np.intp), 0,
        )  # fmt: skip

    def _during(self, k: int, t: float) -> Frame:
        stage, before, after = self.stages[k], self.points[k], self.points[k + 1]
        kept = stage.carries >= 0
        start, was, birth = after.copy(), stage.roles.copy(), np.full(len(after), t)
        start[kept], was[kept], birth[kept] = before[stage.carries[kept]], self.roles_at(k)[stage.carries[kept]], 1.0
        gone = np.ones(len(before), dtype=bool)
        gone[stage.carries[kept]] = False
        done = k + 1 == len(self.stages) or self.levels[k + 1] > self.levels[k]
        points = after if t == 1 else (1 - t) * start + t * after
        return Frame(
            stage.topology, points, start, birth, stage.roles, was, stage, t,
            self.mesh_at(k), before, self.roles_at(k), np.flatnonzero(gone), self.levels[k] + (done and t == 1),
        )  # fmt: skip


class _Later(Sequence[Floats]):
    """``n`` arrays, each made when it is first asked for: number ``k`` by ``make(k)``."""

    def __init__(self, n: int, make: Callable[[int], Floats]) -> None:
        self._made: list[Floats | None] = [None] * n
        self._make = make

    def __len__(self) -> int:
        return len(self._made)

    @overload
    def __getitem__(self, k: int) -> Floats: ...
    @overload
    def __getitem__(self, k: slice) -> tuple[Floats, ...]: ...
    def __getitem__(self, k: int | slice) -> Floats | tuple[Floats, ...]:
        if isinstance(k, slice):
            return tuple(self[each] for each in range(*k.indices(len(self))))
        k = range(len(self))[k]
        if (made := self._made[k]) is None:
            made = self._made[k] = self._make(k)
        return made


def trace(
    scheme: Scheme, control: Mesh, telling: str | None = None, levels: int = 1, *, most: int | None = None
) -> Trace:
    """Subdivide ``control`` ``levels`` times and keep every stage on the way.

    Raises
    ------
    TopologyError
        If the scheme refuses the control object, or there is no room: for ``most`` faces, or in this machine's memory.
    """
    require_room(scheme, control.topology, levels, TRACED, most)
    stages: list[Stage] = []
    owner: list[int] = []
    topology = control.topology
    for level in range(levels):
        step = scheme.step(topology, telling)
        stages.extend(step.stages)
        owner.extend([level] * len(step.stages))
        topology = step.topology
    return Trace(control, scheme, telling or next(iter(scheme.tellings)), tuple(stages), tuple(owner))


def subdivide(control: Mesh, scheme: Scheme, levels: int, *, most: int | None = None) -> Mesh:
    """The mesh after ``levels`` steps; only the last level is kept.

    Faces are numbered as by the stages; so are the vertices, unless there are more than some 20,000 faces.  For the
    same mesh with moved points keep its ``plan``, which numbers vertices in its own way: its ``numbers`` say where each
    one is that the stages make.

    Raises
    ------
    TopologyError
        If the scheme refuses the control object, or there is no room: for ``most`` faces, or in this machine's memory.
    """
    swift = is_swift(control.topology, scheme, levels)
    require_room(scheme, control.topology, levels, SWIFT if swift else STAGED, most)
    made = once(control.topology, scheme, levels)
    return Mesh(made.topology, frozen(made.apply(control.points)))

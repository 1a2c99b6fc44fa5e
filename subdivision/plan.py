"""Subdivision of a mesh laid out once for its topology, then applied to points, and to moved points again.

The first levels are kernels, one after the other.  Where the rest is deep, a table for each
kind of face makes it at once; a small mesh has one table for everything.  Schemes that have
no kernel are told in stages, which all of this is tested against.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from subdivision import kernels, refine
from subdivision.arrays import Floats, Indices, frozen
from subdivision.kernels import Kernel
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.stage import Step
from subdivision.tables import Tables, tables
from subdivision.topology import INFINITELY_SHARP, Topology

DEEPEST = 4
"""Tables of more levels would not be faster: a weight costs the same at any depth."""

FACES_A_TABLE = 16
"""What a kind of face needs to be worth a table, on average."""


@dataclass(frozen=True, eq=False)
class Plan:
    """``levels`` steps from one topology.

    Attributes
    ----------
    topology : Connectivity
        The outcome's.  Of meshes, half-edges, edges and faces are numbered as by the stages.
    steps : (Kernel or Step or Tables, ...)
        One after the other they make the points.
    """

    topology: Connectivity
    steps: tuple[Kernel | Step | Tables, ...]

    def apply(self, points: Floats) -> Floats:
        """(n_vertices, d) float before -> (n_vertices, d) float after."""
        points = np.ascontiguousarray(points, dtype=float)
        for step in self.steps:
            points = step.apply(points)
        return points

    @cached_property
    def numbers(self) -> Indices:
        """(n_vertices,) int: where the points are that the stages number 0, 1, 2, ..."""
        numbers = np.arange(self.topology.n_vertices)
        if self.steps and isinstance(self.steps[-1], Tables):
            numbers[_refined(self.steps[-1]).origin] = self.topology.origin
        return frozen(numbers)


def plan(t: Connectivity, scheme: Scheme, levels: int) -> Plan:
    """The plan of ``levels`` steps of ``scheme`` on ``t``.

    Raises
    ------
    TopologyError
        If the scheme refuses the control object.
    """
    scheme.require(t)
    make = _kernels(t, scheme)
    if make is None or not isinstance(t, Topology):
        return _staged(t, scheme, levels)
    depth = _depth(t, scheme, levels)
    steps: list[Kernel] = []
    while len(steps) < levels:
        if depth > 1 and len(steps) == levels - depth:
            deep = tables(t, depth, make, at_most=t.n_faces // FACES_A_TABLE)
            if deep:
                return Plan(_renumbered(deep), (*steps, deep))
        steps.append(make(t))
        t = steps[-1].refined()
    return Plan(t, tuple(steps))


def _kernels(t: Connectivity, scheme: Scheme) -> Callable[[Topology], Kernel] | None:
    """How to make the kernels of ``scheme``, if it has any for this mesh."""
    if scheme.reach is None or scheme.refinement is None or not isinstance(t, Topology):
        return None
    if (t.edge_sharpness[t.boundary] < INFINITELY_SHARP).any():
        return None
    return partial(kernels.quads if scheme.refinement is refine.QUADS else kernels.triangles, reach=scheme.reach)


def _staged(t: Connectivity, scheme: Scheme, levels: int) -> Plan:
    steps = []
    for _ in range(levels):
        steps.append(scheme.step(t))
        t = steps[-1].topology
    return Plan(t, tuple(steps))


def _depth(t: Topology, scheme: Scheme, levels: int) -> int:
    """How many levels to make at once: many, but from enough faces to be worth a table for each kind."""
    assert scheme.refinement
    depth = min(DEEPEST, levels - 1)
    while depth > 1 and scheme.refinement.faces(t, levels - depth) < 1500:
        depth -= 1
    return depth


def _renumbered(deep: Tables) -> Topology:
    """The outcome: as the stages make it, but for the numbers of the vertices."""
    size = deep.coarse.n_halfedges // deep.coarse.n_faces
    return refine.deferred(deep.coarse, lambda: _refined(deep), deep.origin, size, deep.n_points)


def _refined(deep: Tables) -> Topology:
    """What the stages make of the mesh that ``deep`` begins with."""
    t = deep.coarse
    split = refine.quads if t.n_halfedges == 4 * t.n_faces else refine.triangles
    for _ in range(deep.depth):
        t = split(t)
    return t

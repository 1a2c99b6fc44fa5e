"""Where points tend to, and how the surface lies there, for any scheme that tells its limit rules.

A scheme's rules hold once a mesh is *settled*: its faces have the size that the scheme makes,
and no sharpness is left but what never wears off.  Until then the mesh is refined, as often as
the largest finite sharpness takes [DKT98]_, and the rules are read through these steps.
"""

from dataclasses import replace
from functools import reduce
from math import ceil
from typing import cast

import numpy as np

from subdivision.arrays import Floats
from subdivision.manifold import TopologyError
from subdivision.operators import Operator
from subdivision.rows import Connectivity
from subdivision.scheme import Scheme
from subdivision.stage import Stage, Stencil, Step
from subdivision.topology import INFINITELY_SHARP, Topology
from subdivision.trace import Mesh, Trace
from subdivision.words import phrase

MOST_FACES = 2_000_000
"""Refining stops here: beyond, semi-sharp creases would cost gigabytes."""


def limit_stage(scheme: Scheme, topology: Connectivity) -> Stage:
    """Every point to its limit; ``carries`` tells which points have one (all, but for the rims of open nets).

    Raises
    ------
    TopologyError
        If the scheme refuses the control object or tells no limits, if its boundary is literal, or
        if sharpness takes too many levels to wear off.
    """
    scheme.require(topology)
    if scheme.limit is None:
        raise TopologyError(phrase("{scheme} tells no limit positions", scheme=scheme.title))
    if not isinstance(topology, Topology):
        return scheme.limit(topology)
    settled, before = _settled(scheme, topology)
    stage = scheme.limit(settled)
    if before is None:
        return stage
    kept = slice(topology.n_vertices)
    operator = stage.operator[kept] @ before
    return replace(stage, operator=operator, topology=topology, carries=stage.carries[kept], roles=stage.roles[kept])


def limit(scheme: Scheme, topology: Connectivity) -> Operator:
    """(n_limits, n_vertices): points to limits, a row for each that has one (on a mesh: every vertex)."""
    return limit_stage(scheme, topology).operator


def limit_points(mesh: Mesh, scheme: Scheme) -> Floats:
    """(n_limits, 3) float: where the points of ``mesh`` tend to."""
    return limit(scheme, mesh.topology).apply(mesh.points)


def limit_mesh(mesh: Mesh, scheme: Scheme) -> Mesh:
    """``mesh`` pushed onto the limit surface; an open net loses the rim that has no limits."""
    stage = limit_stage(scheme, mesh.topology)
    return Mesh(stage.topology, stage.operator.apply(mesh.points))


def to_limit(told: Trace) -> Trace:
    """The trace with one stage more, which takes every point to its limit."""
    stage = limit_stage(told.scheme, told.topology_at(len(told.stages)))
    level = told.levels[-1] + 1 if told.levels else 0
    return replace(told, stages=(*told.stages, stage), levels=(*told.levels, level))


def limit_stencil(scheme: Scheme, topology: Connectivity, vertex: int) -> Stencil:
    """How the limit of one vertex is made of control points.

    Raises
    ------
    TopologyError
        As ``limit_stage``, and if the vertex supports the surface without a limit of its own.
    """
    stage = limit_stage(scheme, topology)
    rows = np.flatnonzero(stage.carries == vertex)
    if len(rows) == 0:
        why = "not all points around it exist"
        raise TopologyError(
            phrase("point {vertex} has no limit of its own: {why}", vertex=vertex, why=why), vertices=[vertex]
        )
    return replace(stage.stencil(int(rows[0])), point=vertex)


def tangents(scheme: Scheme, topology: Connectivity) -> tuple[Operator, Operator]:
    """Two operators (n_vertices, n_vertices): directions that span the tangent plane at each limit.

    Seen from outside, the second is counter-clockwise of the first.  Both rows are zero where there is
    no single tangent plane: on creases inside the mesh, at tips, at valence 2.

    Raises
    ------
    TopologyError
        As ``limit_stage``.
    """
    scheme.require(topology)
    if scheme.tangents is None or not isinstance(topology, Topology):
        raise TopologyError(phrase("{scheme} tells no tangents", scheme=scheme.title))
    settled, before = _settled(scheme, topology)
    first, second = scheme.tangents(settled)
    if before is None:
        return first, second
    kept = slice(topology.n_vertices)
    return first[kept] @ before, second[kept] @ before


def normals(mesh: Mesh, scheme: Scheme) -> Floats:
    """(n_vertices, 3) float: unit normals of the limit surface; zero where there is no single one."""
    first, second = (operator.apply(mesh.points) for operator in tangents(scheme, mesh.topology))
    across = np.cross(first, second)
    size, sides = _lengths(across), _lengths(first) * _lengths(second)
    parallel = size <= 1e-12 * sides
    return np.asarray(np.where(parallel, 0.0, across / np.where(parallel, 1.0, size)))


def levels_to_settle(scheme: Scheme, topology: Topology) -> int:
    """How many steps until the scheme's limit rules hold."""
    sharpness = np.concatenate([topology.edge_sharpness, topology.vertex_sharpness])
    wearing = ceil(float(sharpness[sharpness < INFINITELY_SHARP].max(initial=0.0)))
    size = scheme.refinement.size if scheme.refinement else 0
    return max(wearing, int(size > 0 and (topology.face_sizes != size).any()))


def _lengths(vectors: Floats) -> Floats:
    return np.asarray(np.linalg.norm(vectors, axis=1, keepdims=True))


def _settled(scheme: Scheme, topology: Topology) -> tuple[Topology, Operator | None]:
    """The mesh once the rules hold, and the operator that leads there."""
    if (topology.edge_sharpness[topology.boundary] < INFINITELY_SHARP).any():
        raise TopologyError(
            "under the literal boundary rule the sheet shrinks at every level, and no limit rule is known; "
            "choose another boundary, or close the mesh"
        )
    levels = levels_to_settle(scheme, topology)
    faces = scheme.faces_after(topology, levels)
    if faces > MOST_FACES:
        raise TopologyError(
            phrase(
                "the largest finite sharpness takes {levels} levels to wear off, which makes {faces:,} "
                "faces, more than {most_faces:,}; lower the sharpness or make it infinite ({infinite:g})",
                levels=levels,
                faces=faces,
                most_faces=MOST_FACES,
                infinite=INFINITELY_SHARP,
            )
        )
    steps: list[Step] = []
    for _ in range(levels):
        steps.append(scheme.step(steps[-1].topology if steps else topology))
    if not steps:
        return topology, None
    operators = [stage.operator for step in steps for stage in step.stages]
    return cast(Topology, steps[-1].topology), reduce(lambda done, then: then @ done, operators)

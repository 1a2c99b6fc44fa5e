"""A lesson made on the spot from any mesh: every stage of the scheme that suits it."""

from collections.abc import Iterator

from lessons.script import Beat, Lesson, play, show
from subdivision import Mesh, Scheme, Stage, Topology, Trace, trace
from subdivision.schemes import CATMULL_CLARK, QUAD_CENTROID, TRIANGLE_CENTROID

LEVELS = 2
BUDGET = 20_000
"""Faces after the last level; beyond it every picture of playing would take too long."""

SECTION = "Opened"

SENTENCES = {
    "topology": "New topology: a point on every edge, {and_faces}smaller faces between them. Nothing moves.",
    "face points": "A face point in every face: the mean of its corners.",
    "edge points": "An edge point on every edge.",
    "vertex points": "Every old vertex moves to its vertex point.",
    "connect": "Connect the points: the new topology.",
    "centroids": "Mark the centroids: the {{centroid}} helpers, not vertices.",
    "geometry": "New geometry: every vertex moves to the centroid of the centroids around it.",
}


def explored(mesh: Mesh, name: str) -> Lesson:
    """All stages of the natural scheme on ``mesh``, already worked out.

    Raises
    ------
    TopologyError
        If the scheme refuses the mesh.
    """
    scheme = natural_scheme(mesh)
    levels = affordable(mesh, scheme)
    told = trace(scheme, mesh, levels=levels)
    _ = told.points, [stage.moves for stage in told.stages]  # here, where nobody waits for a picture
    lesson = Lesson(f"opened_{name}", name, SECTION, lambda: _beats(told, levels))
    _ = lesson.beats
    return lesson


def natural_scheme(mesh: Mesh) -> Scheme:
    """Triangles: centroid averaging for triangles; quads: for quads; else Catmull-Clark."""
    sizes = set(mesh.topology.face_sizes.tolist()) if isinstance(mesh.topology, Topology) else {4}
    if sizes == {3}:
        return TRIANGLE_CENTROID
    return QUAD_CENTROID if sizes == {4} else CATMULL_CLARK


def affordable(mesh: Mesh, scheme: Scheme) -> int:
    """How many levels stay within the budget of faces: 0, 1 or 2."""
    return sum(scheme.faces_after(mesh.surface, level) <= BUDGET for level in range(1, LEVELS + 1))


def _beats(told: Trace, levels: int) -> Iterator[Beat]:
    t = told.control.topology
    extraordinary = int(t.extraordinary.sum()) if isinstance(t, Topology) else 0
    words = f"{t.n_vertices:,} vertices, {t.n_faces:,} faces; {extraordinary:,} extraordinary vertices."
    yield show(told, None, f"{words} {_limits(told, levels)}".strip())
    for stage, level in zip(told.stages, told.levels, strict=True):
        yield play(told, stage, _said(stage, level, told))


def _limits(told: Trace, levels: int) -> str:
    """What is played, and what was left out and why."""
    if levels == LEVELS:
        return f"{told.scheme.title}, {LEVELS} levels."
    if levels:
        return f"{told.scheme.title}, one level: two would exceed {BUDGET:,} faces."
    return f"It is shown as it is: one level would exceed {BUDGET:,} faces."


def _said(stage: Stage, level: int, told: Trace) -> str:
    and_faces = "" if told.scheme is TRIANGLE_CENTROID else "a point on every face, "
    sentence = SENTENCES.get(stage.name, f"{stage.name.capitalize()}.").format(and_faces=and_faces)
    faces = f" {stage.topology.n_faces:,} faces." if stage.name in ("topology", "connect") else ""
    return f"{'Again. ' if level else ''}{sentence}{faces}"

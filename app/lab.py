"""The laboratory: any control object under one to four rules, as a lesson made on the spot."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

from lessons.script import Beat, Lesson, View, look_at
from subdivision import Boundary, Mesh, Polyline, Role, Scheme, Stage, Topology, Trace, trace
from subdivision.catalogue import FAMILIES, Value, scheme
from subdivision.rows import Grid

LABORATORY = "laboratory"
SECTION = "Laboratory"

LEVELS = 2
MOST_LEVELS = 8
MOST_PANES = 4

BUDGET = 20_000
"""Faces, or points of a polygon, after the last level; beyond it every picture of playing would take too long."""

SENTENCES = {
    "topology": "New topology: a point on every edge, {and_faces}smaller faces between them. Nothing moves.",
    "face points": "A face point in every face: the mean of its corners.",
    "edge points": "An edge point on every edge.",
    "vertex points": "Every old vertex moves to its vertex point.",
    "connect": "Connect the points: the new topology.",
    "centroids": "Mark the centroids: the {{centroid}} helpers, not vertices.",
    "geometry": "New geometry: every vertex moves to the centroid of the centroids around it.",
    "split": "Split: write every point twice. Nothing moves.",
    "quadruple": "Split: write every point four times. Nothing moves.",
    "stencils": "Every new point at once, by its stencil.",
}


@dataclass(frozen=True)
class Rule:
    """What subdivides the control object in one pane: a scheme of the catalogue, a telling, a boundary rule."""

    family: str
    parameters: tuple[Value, ...] = ()
    telling: str = ""
    boundary: Boundary = Boundary.EDGE

    @property
    def scheme(self) -> Scheme:
        return scheme(self.family, self.parameters)

    @property
    def values(self) -> tuple[Value, ...]:
        """The parameters, the usual ones where none are given."""
        return self.parameters or FAMILIES[self.family].start

    @property
    def told(self) -> str:
        """The telling, the scheme's first where none is chosen or it has no such telling."""
        tellings = list(self.scheme.tellings)
        return self.telling if self.telling in tellings else tellings[0]

    def bounded(self, control: Mesh) -> Mesh:
        """A control object with the rule's boundary, if it is a polygon mesh."""
        t = control.topology
        return replace(control, topology=t.with_boundary(self.boundary)) if isinstance(t, Topology) else control


@dataclass(frozen=True, eq=False)
class Lab:
    """``control`` called ``name``, under ``rules``, ``levels`` times."""

    name: str
    control: Mesh
    rules: tuple[Rule, ...]
    levels: int = LEVELS


def lab_of(mesh: Mesh, name: str) -> Lab:
    """A control object under the scheme that suits it, for as many levels as can be played well.

    Raises
    ------
    TopologyError
        If no scheme takes it.
    """
    lab = Lab(name, mesh, (Rule(natural_family(mesh)),), LEVELS)
    lab.rules[0].scheme.require(mesh.topology)
    return replace(lab, levels=min(LEVELS, affordable(lab)))


def natural_family(mesh: Mesh) -> str:
    """Polygons: cubics; nets: bicubics or quartics; triangles and quads: centroid averaging; else Catmull-Clark."""
    t = mesh.topology
    if isinstance(t, Polyline):
        return "lane-riesenfeld"
    if isinstance(t, Grid):
        return "box-spline" if t.diagonal else "tensor-product"
    sizes = set(t.face_sizes.tolist())
    return {(3,): "triangle-centroid", (4,): "quad-centroid"}.get(tuple(sizes), "catmull-clark")


def affordable(lab: Lab) -> int:
    """How many levels stay within the budget under every rule; at most ``MOST_LEVELS``."""
    return min(_affordable(lab.control, rule) for rule in lab.rules)


def lesson_of(lab: Lab) -> Lesson:
    """The story of a laboratory: every stage of every level, all panes in step.

    Raises
    ------
    TopologyError
        If one of its rules refuses the control object.
    """
    traces = tuple(_told(lab.control, rule, lab.levels) for rule in lab.rules)
    made = Lesson(LABORATORY, titled(lab.name), SECTION, lambda: _beats(lab, traces))
    _ = made.beats
    return made


def titled(name: str) -> str:
    """A name of a shape or a file as it stands on a picture."""
    words = name.replace("-", " ").replace("_", " ")
    return f"{words[:1].upper()}{words[1:]}"


@lru_cache(maxsize=16)
def _told(control: Mesh, rule: Rule, levels: int) -> Trace:
    found = trace(rule.scheme, rule.bounded(control), rule.told, levels)
    _ = found.points, [stage.moves for stage in found.stages]  # here, where nobody waits for a picture
    return found


def _affordable(mesh: Mesh, rule: Rule) -> int:
    for level in range(1, MOST_LEVELS + 1):
        if _size(mesh, rule, level) > BUDGET:
            return level - 1
    return MOST_LEVELS


def _size(mesh: Mesh, rule: Rule, levels: int) -> int:
    """Faces (points of a polygon) after some levels."""
    t = mesh.topology
    if isinstance(t, Topology):
        return rule.scheme.faces_after(t, levels)
    return int(
        (t.n_vertices if isinstance(t, Polyline) else t.n_faces) * (2 if isinstance(t, Polyline) else 4) ** levels
    )


def _beats(lab: Lab, traces: tuple[Trace, ...]) -> Iterator[Beat]:
    look = look_at(traces[0])
    titles = [_title(rule) if len(lab.rules) > 1 else "" for rule in lab.rules]
    yield Beat(
        _opening(lab, traces[0]),
        tuple(View(t, 0, 0, title=title) for t, title in zip(traces, titles, strict=True)),
        look=look,
    )
    for level in range(lab.levels):
        n = len(traces[0].step(level).stages)
        for k in range(n):
            stage = traces[0].stages[traces[0].begins(level) + k]
            views = tuple(
                View(t, *_stretch(t, level, k, n), title=title) for t, title in zip(traces, titles, strict=True)
            )
            yield Beat(_said(stage, level), views, look=look)


def _stretch(t: Trace, level: int, k: int, n: int) -> tuple[int, int]:
    """Which stages of a pane go with stage ``k`` of the leading pane's ``n``."""
    begin, m = t.begins(level), len(t.step(level).stages)
    return begin + round(m * k / n), begin + round(m * (k + 1) / n)


def _title(rule: Rule) -> str:
    boundary = f", {rule.boundary.value.replace('-', ' ')}" if rule.boundary is not Boundary.EDGE else ""
    return f"{rule.scheme.title}: {rule.told}{boundary}"


def _opening(lab: Lab, told: Trace) -> str:
    t = told.control.topology
    faces = f", {t.n_faces:,} faces" if t.n_faces else ""
    extraordinary = int(t.extraordinary.sum()) if isinstance(t, Topology) else 0
    special = f"; {extraordinary:,} extraordinary" if isinstance(t, Topology) else ""
    levels = f"{lab.levels} level{'s' * (lab.levels != 1)}"
    limit = "" if lab.levels else " One level would be too many faces to play."
    return f"{t.n_vertices:,} vertices{faces}{special}. {told.scheme.title}, {levels}.{limit}"


def _said(stage: Stage, level: int) -> str:
    has_face_points = bool((stage.roles[stage.born] == Role.FACE).any())
    sentence = SENTENCES.get(stage.name, f"{stage.name[:1].upper()}{stage.name[1:]}.").format(
        and_faces="a point on every face, " if has_face_points else ""
    )
    is_new_mesh = stage.name in ("topology", "connect") and stage.topology.n_faces
    faces = f" {stage.topology.n_faces:,} faces." if is_new_mesh else ""
    return f"{'Again. ' if level else ''}{sentence}{faces}"

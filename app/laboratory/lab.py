"""The laboratory: any control object under one to four rules, as a lesson made on the spot."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from app.lately import Lately
from lessons.measured import difference
from lessons.script import Beat, Lesson, Reading, View, look_at
from subdivision import Boundary, Mesh, Polyline, Role, Scheme, Stage, Topology, Trace, trace
from subdivision.catalogue import FAMILIES, Value, Vectors, scheme
from subdivision.files.faults import printable
from subdivision.passes import spelled
from subdivision.rows import Grid
from subdivision.schemes.box_spline import averaged, in_order, other_orders
from subdivision.size import TooLarge, after, lost, sample
from subdivision.words import joined, phrase, plural

LABORATORY = "laboratory"
SECTION = "Laboratory"

LEVELS = 2
MOST_LEVELS = 8
MOST_PANES = 4

BUDGET = 130_000
"""Faces, or points of a polygon, after the last level; beyond it every picture would take too long."""

COMFORT = 20_000
"""... and what is played well: as many a new control object is given, unless more are asked for."""

ROOM = 200_000
"""Points, of all stages, that stories worked out lately may have together: some 80 MB; older ones are told anew."""

SENTENCES = {
    "topology": "New topology: a point on every edge, smaller faces between them. Nothing moves.",
    "topology with face points": "New topology: a point on every edge, a point on every face, smaller faces between "
    "them. Nothing moves.",
    "face points": "A face point in every face: the mean of its corners.",
    "edge points": "An edge point on every edge.",
    "vertex points": "Every old vertex moves to its vertex point.",
    "connect": "Connect the points: the new topology.",
    "centroids": "Mark the centroids: the {centroid} helpers, not vertices.",
    "geometry": "New geometry: every vertex moves to the centroid of the centroids around it.",
    "split": "Split: write every point twice. Nothing moves.",
    "quadruple": "Split: write every point four times. Nothing moves.",
    "stencils": "Every new point at once, by its stencil.",
}


@dataclass(frozen=True)
class Rule:
    """What subdivides the control object in one pane: a scheme of the catalogue, a telling, a boundary rule.

    ``until`` is the level at which a pane beside the leading one rests; 0: it goes along to the last one.
    """

    family: str
    parameters: tuple[Value, ...] = ()
    telling: str = ""
    boundary: Boundary = Boundary.EDGE
    until: int = 0

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

    @property
    def vectors(self) -> Vectors:
        """The vector set of a box spline; of all other rules ()."""
        return next((v for v in self.values if isinstance(v, tuple)), ())

    @property
    def passes(self) -> Vectors:
        """What a box spline averages along, in the order told."""
        rest = tuple(averaged(self.vectors))
        return rest[::-1] if self.told == "in reverse" else rest

    def bounded(self, control: Mesh) -> Mesh:
        """A control object with the rule's boundary, if it is a polygon mesh."""
        t = control.topology
        return replace(control, topology=t.with_boundary(self.boundary)) if isinstance(t, Topology) else control


@dataclass(frozen=True, eq=False)
class Lab:
    """``control`` called ``name``, under ``rules``, ``levels`` times.

    ``overlay`` is the number of another order of the leading box spline's passes, from 1, that lies over it; 0: none.
    """

    name: str
    control: Mesh
    rules: tuple[Rule, ...]
    levels: int = LEVELS
    overlay: int = 0

    @property
    def other(self) -> Rule | None:
        """The leading box spline with its passes in the other order, where one lies over it."""
        lead = self.rules[0]
        orders = other_orders(lead.passes) if self.overlay and lead.vectors else ()
        if not orders:
            return None
        passes = orders[(self.overlay - 1) % len(orders)]
        return replace(lead, parameters=(in_order(passes),), telling="in order")


def lab_of(mesh: Mesh, name: str) -> Lab:
    """A control object under the scheme that suits it, for as many levels as can be played well.

    Raises
    ------
    TopologyError
        If no scheme takes it.
    """
    lab = Lab(name, mesh, (Rule(natural_family(mesh)),), LEVELS)
    lab.rules[0].scheme.require(mesh.topology)
    return replace(lab, levels=min(LEVELS, affordable(lab, COMFORT)))


def natural_family(mesh: Mesh) -> str:
    """Polygons: cubics; nets: bicubics or quartics; triangles and quads: centroid averaging; else Catmull-Clark."""
    t = mesh.topology
    if isinstance(t, Polyline):
        return "lane-riesenfeld"
    if isinstance(t, Grid):
        return "box-spline" if t.diagonal else "tensor-product"
    sizes = set(t.face_sizes.tolist())
    return {(3,): "triangle-centroid", (4,): "quad-centroid"}.get(tuple(sizes), "catmull-clark")


def affordable(lab: Lab, budget: int = BUDGET) -> int:
    """How many levels stay within a budget of faces under every rule; at most ``MOST_LEVELS``."""
    return min(_affordable(lab.control, rule, budget) for rule in lab.rules)


def require_playable(lab: Lab) -> None:
    """Ask for no more levels than a picture has room for.

    Raises
    ------
    TooLarge
        With the numbers, and the most levels that it has room for.
    """
    if lab.levels > (most := affordable(lab)):
        faces = max(_size(lab.control, rule, min(lab.levels, MOST_LEVELS + 1)) for rule in lab.rules)
        raise TooLarge(
            phrase(
                "{levels} levels would make {faces:,} faces, and a picture has room for {budget:,}; choose at most "
                "{most}",
                levels=lab.levels, faces=faces, budget=BUDGET, most=most,
            )
            if faces > BUDGET
            else phrase("{levels} levels are more than are told; choose at most {most}", levels=lab.levels, most=most)
        )  # fmt: skip


def lesson_of(lab: Lab) -> Lesson:
    """The story of a laboratory: every stage of every level, all panes in step.

    Raises
    ------
    TopologyError
        If one of its rules refuses the control object.
    """
    made = _Story(LABORATORY, titled(lab.name), SECTION, lambda: _beats(lab))
    _ = made.beats
    return made


class _Story(Lesson):
    """Weighs nothing itself, so that hundreds can be undone to: its beats go when newer ones need their room."""

    @property
    def beats(self) -> tuple[Beat, ...]:
        return _STORIES(self)


def titled(name: str) -> str:
    """A name of a shape or a file as it stands on a picture: words, never mathematics, whatever is in it."""
    words = printable(name).replace("-", " ").replace("_", " ").replace("$", "")
    return f"{words[:1].upper()}{words[1:]}"


def _tell(asked: tuple[Mesh, Rule, int]) -> Trace:
    control, rule, levels = asked
    found = trace(rule.scheme, rule.bounded(control), rule.told, levels)
    _ = found.points, [stage.moves for stage in found.stages]  # here, where nobody waits for a picture
    return found


def _points(*traces: Trace) -> int:
    return sum(len(points) for told in traces for points in told.points)


_TRACES = Lately(_tell, _points, ROOM)
_STORIES: Lately[Lesson, tuple[Beat, ...]] = Lately(
    lambda lesson: tuple(lesson.script()), lambda beats: _points(*(view.trace for view in beats[0].views)), ROOM
)


def _affordable(mesh: Mesh, rule: Rule, budget: int) -> int:
    for level in range(1, MOST_LEVELS + 1):
        if _size(mesh, rule, level) > budget:
            return level - 1
    return MOST_LEVELS


def _size(mesh: Mesh, rule: Rule, levels: int) -> int:
    """Faces (points of a polygon) after some levels."""
    t = mesh.topology
    if isinstance(t, Topology):
        return rule.scheme.faces_after(t, levels)
    return after(t, _lost(rule, sample(t)), levels)


@lru_cache(maxsize=256)
def _lost(rule: Rule, net: Polyline | Grid) -> tuple[int, int]:
    """By how much a rule shortens a polygon or a net; what refuses it is told elsewhere."""
    return lost(rule.scheme, net) if rule.scheme.accepts(net) else (0, 0)


def _beats(lab: Lab) -> Iterator[Beat]:
    rules = lab.rules if lab.other is None else (lab.rules[0], lab.other, *lab.rules[1:])
    lengths = [lab.levels, *(min(rule.until or lab.levels, lab.levels) for rule in rules[1:])]
    traces = tuple(_TRACES((lab.control, rule, n)) for rule, n in zip(rules, lengths, strict=True))
    look = look_at(traces[0])
    titles = [_title(rule) if len(rules) > 1 else "" for rule in rules]
    yield Beat(_opening(lab, traces[0]), _views(lab, traces, titles, [(0, 0)] * len(traces), _apart), look=look)
    for level in range(lab.levels):
        n = len(traces[0].step(level).stages)
        for k in range(n):
            stage = traces[0].stages[traces[0].begins(level) + k]
            stretches, reading = [_stretch(t, level, k, n) for t in traces], _apart if k + 1 == n else _on_the_way
            yield Beat(_said(stage, level), _views(lab, traces, titles, stretches, reading), look=look)


def _views(
    lab: Lab,
    traces: Sequence[Trace],
    titles: Sequence[str],
    stretches: Sequence[tuple[int, int]],
    reading: Reading,
) -> tuple[View, ...]:
    """A pane for every rule; behind two orders of passes, one with the second laid over the first."""
    panes = [View(t, *stretch, title=title) for t, title, stretch in zip(traces, titles, stretches, strict=True)]
    if lab.other is not None:
        panes.insert(2, replace(panes[0], title="One over the other", over=panes[1], reading=reading))
    return tuple(panes)


def _apart(a: Mesh, b: Mesh) -> str:
    """How far two orders are apart, where their nets have one shape."""
    return difference(a, b) if a.topology == b.topology else _on_the_way(a, b)


def _on_the_way(a: Mesh, b: Mesh) -> str:
    """While some passes are still to come: how far apart, or of which shapes, the two nets are."""
    if a.topology == b.topology:
        return phrase("on the way: {difference}", difference=difference(a, b))
    shapes = (f"{t.n_s} × {t.n_t}" for t in (a.topology, b.topology) if isinstance(t, Grid))
    return phrase("on the way: {shapes} points", shapes=" and ".join(shapes))


def _stretch(t: Trace, level: int, k: int, n: int) -> tuple[int, int]:
    """Which stages of a pane go with stage ``k`` of the leading pane's ``n``."""
    begin, m = t.begins(level), len(t.step(level).stages)
    return begin + round(m * k / n), begin + round(m * (k + 1) / n)


def _title(rule: Rule) -> str:
    if rule.vectors and rule.told != "stencils":
        passes = ", ".join(map(spelled, rule.passes))
        return phrase("average {passes}", passes=passes) if passes else "quadruple only"
    boundary = [rule.boundary.value.replace("-", " ")] if rule.boundary is not Boundary.EDGE else []
    until = [phrase("to level {level}", level=rule.until)] if rule.until else []
    told = phrase("{scheme}: {telling}", scheme=rule.scheme.title, telling=rule.told)
    return joined(", ", [told, *boundary, *until])


def _opening(lab: Lab, told: Trace) -> str:
    t = told.control.topology
    counts = [plural("{n:,} vertex", "{n:,} vertices", t.n_vertices, n=t.n_vertices)]
    counts += [plural("{n:,} face", "{n:,} faces", t.n_faces, n=t.n_faces)] if t.n_faces else []
    found = joined(", ", counts)
    if isinstance(t, Topology):
        found = phrase("{counts}; {n:,} extraordinary", counts=found, n=int(t.extraordinary.sum()))
    levels = plural("{n} level", "{n} levels", lab.levels, n=lab.levels)
    said = phrase("{counts}. {scheme}, {levels}.", counts=found, scheme=told.scheme.title, levels=levels)
    return said if lab.levels else joined(" ", [said, "One level would be too many faces to play."])


def _said(stage: Stage, level: int) -> str:
    has_face_points = bool((stage.roles[stage.born] == Role.FACE).any())
    name = "topology with face points" if stage.name == "topology" and has_face_points else stage.name
    faces = stage.topology.n_faces if stage.name in ("topology", "connect") else 0
    return joined(" ", [
        *([phrase("Again.")] if level else []),
        SENTENCES.get(name) or _named(stage),
        *([plural("{n:,} face.", "{n:,} faces.", faces, n=faces)] if faces else []),
    ])  # fmt: skip


def _named(stage: Stage) -> str:
    """What the name of a stage says, as a sentence."""
    if (way := stage.name.removeprefix("average ")) != stage.name:
        return phrase("Average along {direction}: every point goes half way to the next one there.", direction=way)
    return phrase("{name:sentence}", name=stage.name)

"""A state as text that can be read, kept in a file, and restored exactly.

Version 1 is a JSON table: the lesson and its knobs, the place in it, what is pointed at, what was dragged, from where
it is seen, the options of the picture, what was predicted, and the laboratory.  What passes is not kept: playing, and
what is picked.  Beats are numbered as if nothing were asked, so that a lesson may ask more one day.

Floats are written so that they are read as the same floats.  Reading believes nothing and follows nothing.  A name
that this version does not know is refused, since what it stands for would be missing from the picture; knobs and
options that are not named stand where they begin.
"""

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import fields, replace
from fractions import Fraction
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from app import asking
from app.draw.pointed import ACROSS
from app.draw.surface import SHOWS
from app.draw.theme import THEMES
from app.laboratory.boxlab import LONGEST, MOST_VECTORS
from app.laboratory.lab import LABORATORY, MOST_LEVELS, MOST_PANES, Lab, Rule, lesson_of, require_playable
from app.sessions.strict import Entry, KeepingError, parsed
from app.state import VALENCES, Edits, Options, Prediction, Spot, State, settle
from lessons import all_lessons
from lessons.questions import Where
from lessons.script import Lesson
from lessons.turn import FARTHEST, NEAREST, Turn
from subdivision import Boundary, Mesh, Polyline, Topology, TopologyError, shapes
from subdivision.catalogue import FAMILIES, Parameter, Value, scheme
from subdivision.files import FileError
from subdivision.files.faults import Fault, fault_of_system, printable
from subdivision.files.saving import save
from subdivision.rows import Grid
from subdivision.topology import INFINITELY_SHARP
from subdivision.words import phrase

FORMAT = "subdivision-studio session"
VERSION = 1
SUFFIX = ".subdivision"

OF_THE_ROOM = ("presenting", "blank", "reduced_motion", "language", "scale")
"""Options that belong to where and who one is, not to the picture: they stay as they are."""

CHOICES: Mapping[str, Mapping[str, Any]] = {"theme": THEMES, "across": ACROSS, "surface_shows": SHOWS}
"""What an option in words may be."""

MOST_BYTES = 32 << 20
MOST_POINTS, MOST_CORNERS = 100_000, 500_000
FARTHEST_POINT = 1e15
FASTEST = 100.0
FRACTION = re.compile(r"-?[0-9]{1,9}(/[1-9][0-9]{0,8})?")

Table: TypeAlias = dict[str, Any]


# -- keeping ------------------------------------------------------------------------------------


def kept(state: State) -> str:
    """The state as text; one that is playing, as it will rest.

    Raises
    ------
    KeepingError
        If its control object is too large for a session.
    """
    return "".join(_written(document(state))) + "\n"


def document(state: State) -> Table:
    """The state as JSON knows values."""
    state = settle(state)
    found: Table = {
        "format": FORMAT,
        "version": VERSION,
        "lesson": state.lesson.id,
        "knobs": state.lesson.settings,
        "place": _kept_place(state),
        "dragged": [[int(vertex), [float(x) for x in to]] for vertex, to in state.edits],
        "turn": {each.name: float(getattr(state.turn, each.name)) for each in fields(Turn)},
        "options": {name: getattr(state.options, name) for name in _options()},
    }
    if state.focus is not None:
        found["pointed at"] = {each.name: int(getattr(state.focus, each.name)) for each in fields(Spot)}
    if state.predicted:
        found["predicted"] = [p if isinstance(p, int) else [float(x) for x in p] for p in state.predicted]
    if state.lab is not None:
        found["laboratory"] = _laboratory(state.lab)
    return found


def _kept_place(state: State) -> Table:
    told = state.lesson.asking(False).beats
    if asking.is_open(state):
        beat = asking.answer(state)
        return {"beat": told.index(beat), "at": float(beat.start), "question": True}
    return {"beat": told.index(state.now), "at": float(state.at)}


def write(path: Path, state: State) -> Path:
    """Keep the state in a file, whole or not at all; the suffix is added where it is missing.

    Raises
    ------
    KeepingError
        If it cannot be written there; an older file then stays as it was.
    """
    path = named(path)
    try:
        save(path, [kept(state).encode()])
    except (OSError, MemoryError) as error:
        raise KeepingError(str(fault_of_system(error, path).in_file(path))) from error
    return path


def named(path: Path) -> Path:
    """The name that a session is kept under."""
    return path if path.suffix.lower() == SUFFIX else path.with_name(path.name + SUFFIX)


def _options() -> tuple[str, ...]:
    return tuple(each.name for each in fields(Options) if each.name not in OF_THE_ROOM)


def _laboratory(lab: Lab) -> Table:
    return {
        "name": lab.name,
        "object": _object(lab.control),
        "rules": [
            {
                "family": rule.family,
                "parameters": [_parameter(value) for value in rule.parameters],
                "telling": rule.telling,
                "boundary": rule.boundary.value,
                "until": rule.until,
            }
            for rule in lab.rules
        ],
        "levels": lab.levels,
        "overlay": lab.overlay,
    }


def _parameter(value: Value) -> Any:
    if isinstance(value, tuple):
        return [list(vector) for vector in value]
    return str(value) if isinstance(value, Fraction) else value


@lru_cache(maxsize=1)
def _object(control: Mesh) -> Table:
    """A shape of the house by its name; else all its numbers."""
    for name in shapes.SHAPES:
        if is_same(_shape(name), control):
            return {"shape": name}
    t, points = control.topology, control.points
    if len(points) > MOST_POINTS or len(t.origin) > MOST_CORNERS:
        raise KeepingError(
            phrase(
                "the object in the laboratory has {n:,} vertices, and a session keeps at most {most:,}; "
                "open it from its own file again",
                n=len(points),
                most=MOST_POINTS,
            )
        )
    if not (np.abs(points) <= FARTHEST_POINT).all():
        raise KeepingError(
            phrase("the object in the laboratory goes beyond {most:g}; scale it down", most=FARTHEST_POINT)
        )
    if isinstance(t, Polyline):
        return {"polygon": {"closed": t.closed, "points": points.tolist()}}
    if isinstance(t, Grid):
        return {"net": {
            "size": list(t.shape), "wrapped": [t.wrap_s, t.wrap_t], "diagonal": t.diagonal, "points": points.tolist(),
        }}  # fmt: skip
    return {"mesh": {"points": points.tolist(), **_connectivity(t)}}


def _connectivity(t: Topology) -> Table:
    """The faces, what is sharp or hidden, and the numbers of the edges where the faces alone would give others."""
    loops = t.loops()
    found: Table = {
        "faces": loops,
        "sharp edges": [[*t.ends[e].tolist(), float(t.edge_sharpness[e])] for e in np.flatnonzero(t.edge_sharpness)],
        "sharp vertices": [[int(v), float(t.vertex_sharpness[v])] for v in np.flatnonzero(t.vertex_sharpness)],
        "hidden faces": np.flatnonzero(t.hidden).tolist(),
    }
    if not np.array_equal(Topology.from_faces(loops, t.n_vertices).edge, t.edge):
        found["edges"] = t.edge.tolist()
    return found


@cache
def _shape(name: str) -> Mesh:
    return shapes.SHAPES[name]()


def is_same(one: Mesh, other: Mesh) -> bool:
    """Whether two control objects are the same in every number."""
    a, b = one.topology, other.topology
    if type(a) is not type(b) or not np.array_equal(one.points, other.points):
        return False
    if isinstance(a, Topology):
        return all(np.array_equal(getattr(a, each.name), getattr(b, each.name)) for each in fields(a))
    return a == b


def _written(value: Any, indent: str = "") -> Iterator[str]:
    """JSON with one line for each value of a table and each row of numbers."""
    inner = f"{indent}  "
    if isinstance(value, dict) and value:
        for k, (name, inside) in enumerate(value.items()):
            yield f"{',' if k else '{'}\n{inner}{json.dumps(name)}: "
            yield from _written(inside, inner)
        yield f"\n{indent}}}"
    elif isinstance(value, list) and any(isinstance(each, list | dict) for each in value):
        for k, inside in enumerate(value):
            yield f"{',' if k else '['}\n{inner}"
            yield from [json.dumps(inside)] if isinstance(inside, list) else _written(inside, inner)
        yield f"\n{indent}]"
    else:
        yield json.dumps(value, allow_nan=False)


# -- restoring ----------------------------------------------------------------------------------


def read(path: Path, options: Options | None = None) -> State:
    """The state in a file.

    Raises
    ------
    KeepingError
        That begins with the file's name.
    """
    try:
        if path.exists() and not path.is_file():
            raise Fault("it is not an ordinary file", "choose one").in_file(path)
        if path.stat().st_size > MOST_BYTES:
            raise Fault(phrase("it is larger than {most} MB", most=MOST_BYTES >> 20), "choose a session").in_file(path)
        return restored(path.read_bytes(), options)
    except KeepingError as fault:
        raise KeepingError(f"{printable(path.name)}, {fault}") from None
    except FileError as fault:
        raise KeepingError(str(fault)) from None
    except (OSError, MemoryError) as error:
        raise KeepingError(str(fault_of_system(error, path).in_file(path))) from error


def restored(text: str | bytes, options: Options | None = None) -> State:
    """The state that ``kept`` wrote; of ``options``, those of the room stay.

    Raises
    ------
    KeepingError
        For anything that is not such a text, or leads out of its lesson.
    """
    if len(text) > MOST_BYTES:
        raise KeepingError(
            phrase("this is larger than {most} MB, too large for a session; choose another one", most=MOST_BYTES >> 20)
        )
    table = _recognised(parsed(text))
    lab = _lab(table["laboratory"]) if "laboratory" in table else None
    wanted = _picture(table["options"], options or Options())
    lesson = _lesson(table["lesson"], table["knobs"], lab, table).asking(wanted.asking)
    beat, at = _place(table["place"], lesson)
    state = State(
        lesson, beat, at, edits=_edits(table["dragged"], lesson), lab=lab, turn=_turn(table["turn"]), options=wanted
    )
    state = replace(state, predicted=_predicted(table["predicted"], state)) if "predicted" in table else state
    return replace(state, focus=_spot(table["pointed at"], state)) if "pointed at" in table else state


def taken_up(state: State, other: State) -> State:
    """A restored state in place of the one that is open; what belongs to the room stays."""
    room = {name: getattr(state.options, name) for name in OF_THE_ROOM}
    return replace(other, options=replace(other.options, **room))


def _recognised(entry: Entry) -> Mapping[str, Entry]:
    value = entry.value
    if not isinstance(value, dict) or value.get("format") != FORMAT:
        raise KeepingError(
            phrase(
                "this is no session: it does not say 'format': '{format}'; choose a {suffix} file",
                format=FORMAT,
                suffix=SUFFIX,
            )
        )
    version = value.get("version")
    if type(version) is int and version > VERSION:
        raise KeepingError(
            phrase(
                "version: it was made by a newer program (version {version}); update this one", version=version % 10**6
            )
        )
    if version != VERSION or type(version) is not int:
        raise KeepingError(phrase("version: there is no such version; write {version}", version=VERSION))
    names = ("format", "version", "lesson", "knobs", "place", "dragged", "turn", "options")
    return entry.table(names, may=("pointed at", "predicted", "laboratory"))


def _lesson(entry: Entry, knobs: Entry, lab: Lab | None, table: Mapping[str, Entry]) -> Lesson:
    if entry.value == LABORATORY:
        if lab is None:
            raise entry.fault("the laboratory is open, but 'laboratory' is missing; put it in")
        knobs.table(())
        return _told(table["laboratory"], lab)
    lessons = {each.id: each for each in all_lessons()}
    if not isinstance(entry.value, str) or entry.value not in lessons:
        raise entry.fault(
            phrase(
                "there is no lesson '{name}'; if it is one of your own, open its folder first (File > Lessons folder…)",
                name=printable(str(entry.value)[:60]),
            )
        )
    lesson = lessons[entry.value]
    limits = {knob.name: (knob.least, knob.most) for knob in lesson.knobs}
    set_ = {name: each.whole(*limits[name]) for name, each in knobs.table((), may=limits).items()}
    starts = {knob.name: knob.start for knob in lesson.knobs}
    return lesson.turned(**(starts | set_))


def _told(entry: Entry, lab: Lab) -> Lesson:
    try:
        return lesson_of(lab)
    except TopologyError as refusal:
        raise entry.fault(str(refusal)) from None


def _place(entry: Entry, lesson: Lesson) -> tuple[int, float]:
    place, told = entry.table(("beat", "at"), may=("question",)), lesson.asking(False).beats
    beat = told[place["beat"].whole(0, len(told) - 1)]
    number, at = lesson.beats.index(beat), place["at"].number(beat.start, beat.stop)
    if "question" not in place or not place["question"].flag():
        return number, at
    if not number or lesson.beats[number - 1].asks is None:
        raise place["question"].fault("nothing is asked there; take it out, or let 'asking' be true")
    return number - 1, lesson.beats[number - 1].start


def _predicted(entry: Entry, state: State) -> tuple[Prediction, ...]:
    """Places where a point was asked for, else the number of one answer."""
    question = asking.question(state)
    if question is None:
        raise entry.fault("nothing is asked there; take it out")
    if isinstance(question, Where):
        return tuple(_point(each) for each in entry.rows(1, asking.MOST))
    return tuple(each.whole(0, len(question.answers) - 1) for each in entry.rows(1, 1))


def _edits(entry: Entry, lesson: Lesson) -> Edits:
    most = max(view.trace.control.topology.n_vertices for beat in lesson.beats for view in beat.views)
    found: dict[int, tuple[float, float, float]] = {}
    for each in entry.rows(most=most):
        vertex, to = each.rows(2, 2)
        number = vertex.whole(0, most - 1)
        if number in found:
            raise each.fault(phrase("vertex {number} stands here twice; take one out", number=number))
        found[number] = _point(to)
    return tuple(found.items())


def _point(entry: Entry) -> tuple[float, float, float]:
    x, y, z = (each.number(-FARTHEST_POINT, FARTHEST_POINT) for each in entry.rows(3, 3))
    return x, y, z


def _turn(entry: Entry) -> Turn:
    table = entry.table([each.name for each in fields(Turn)])
    limits = {"zoom": (FARTHEST, NEAREST)}
    return Turn(**{name: each.number(*limits.get(name, (-1e6, 1e6))) for name, each in table.items()})


def _picture(entry: Entry, room: Options) -> Options:
    start = Options()
    chosen: Table = {}
    for name, each in entry.table((), may=_options()).items():
        usual = getattr(start, name)
        if isinstance(usual, bool):
            chosen[name] = each.flag()
        elif isinstance(usual, str):
            chosen[name] = each.one_of(CHOICES[name])
        elif isinstance(usual, int):
            chosen[name] = each.whole(0, VALENCES.stop - 1)
        else:
            chosen[name] = each.number(1 / FASTEST, FASTEST)
    return replace(start, **chosen, **{name: getattr(room, name) for name in OF_THE_ROOM})


def _spot(entry: Entry, state: State) -> Spot:
    table = entry.table([each.name for each in fields(Spot)])
    pane = table["pane"].whole(0, len(state.now.views) - 1)
    points = state.now.views[pane].trace.points
    stage = table["stage"].whole(0, len(points) - 1)
    return Spot(pane, stage, table["point"].whole(0, len(points[stage]) - 1))


def _lab(entry: Entry) -> Lab:
    table = entry.table(("name", "object", "rules", "levels"), may=("overlay",))
    control = _control(table["object"])
    rules = tuple(_rule(each, control) for each in table["rules"].rows(1, MOST_PANES))
    overlay = table["overlay"].whole(0, MOST_VECTORS) if "overlay" in table else 0
    levels = table["levels"].whole(0, MOST_LEVELS)
    lab = Lab(table["name"].words(), control, rules, levels, overlay)
    try:
        require_playable(lab)
    except TopologyError as refusal:
        raise table["levels"].fault(str(refusal)) from None
    return lab


def _rule(entry: Entry, control: Mesh) -> Rule:
    table = entry.table(("family", "parameters", "telling", "boundary"), may=("until",))
    family = FAMILIES[table["family"].one_of(FAMILIES)]
    given = table["parameters"].rows(most=len(family.parameters))
    if given and len(given) < len(family.parameters):
        raise table["parameters"].fault(
            phrase("{scheme} takes {n}; write all of them, or none", scheme=family.title, n=len(family.parameters))
        )
    values = tuple(_value(each, p) for each, p in zip(given, family.parameters, strict=False))
    boundary = Boundary(table["boundary"].one_of([b.value for b in Boundary]))
    try:
        until = table["until"].whole(0, MOST_LEVELS) if "until" in table else 0
        rule = Rule(family.name, values, boundary=boundary, until=until)
        rule = replace(rule, telling=table["telling"].one_of(("", *rule.scheme.tellings, *_tellings())))
        rule.scheme.require(rule.bounded(control).topology)
    except TopologyError as refusal:
        raise entry.fault(str(refusal)) from None
    return rule


@cache
def _tellings() -> tuple[str, ...]:
    """How any scheme is told: a rule keeps the word for one that its scheme does not have, for when it changes back."""
    return tuple(dict.fromkeys(telling for name in FAMILIES for telling in scheme(name).tellings))


def _value(entry: Entry, parameter: Parameter) -> Value:
    if parameter.is_vectors:
        return tuple(_vector(each) for each in entry.rows(1, MOST_VECTORS))
    if isinstance(parameter.start, int):
        return entry.whole(int(parameter.least), int(parameter.most))
    if not FRACTION.fullmatch(entry.words()):
        raise entry.fault("this is no fraction; write one such as 3/16")
    if not parameter.least <= (value := Fraction(entry.value)) <= parameter.most:
        raise entry.fault(
            phrase(
                "{name} goes from {least} to {most}; write one between",
                name=parameter.name,
                least=parameter.least,
                most=parameter.most,
            )
        )
    return value


def _vector(entry: Entry) -> tuple[int, int]:
    a, b = (each.whole(-LONGEST, LONGEST) for each in entry.rows(2, 2))
    return a, b


def _control(entry: Entry) -> Mesh:
    if not isinstance(entry.value, dict) or len(entry.value) != 1:
        raise entry.fault("there must be one thing here: 'shape', 'polygon', 'net' or 'mesh'; keep one of them")
    ((kind, inside),) = entry.table((), may=("shape", *_MAKERS)).items()
    if kind == "shape":
        return _shape(inside.one_of(shapes.SHAPES))
    try:
        return _MAKERS[kind](inside)
    except TopologyError as fault:
        raise inside.fault(str(fault)) from None


def _points(entry: Entry) -> list[tuple[float, float, float]]:
    return [_point(each) for each in entry.rows(1, MOST_POINTS)]


def _polygon(entry: Entry) -> Mesh:
    table = entry.table(("closed", "points"))
    points = _points(table["points"])
    return Mesh(Polyline(len(points), table["closed"].flag()), np.array(points))


def _net(entry: Entry) -> Mesh:
    table = entry.table(("size", "wrapped", "diagonal", "points"))
    n_s, n_t = (each.whole(1, MOST_POINTS) for each in table["size"].rows(2, 2))
    wrap_s, wrap_t = (each.flag() for each in table["wrapped"].rows(2, 2))
    points = _points(table["points"])
    if len(points) != n_s * n_t:
        raise table["points"].fault(
            phrase(
                "a net of {n_s} by {n_t} has {n} points, not {found}; mend the size",
                n_s=n_s,
                n_t=n_t,
                n=n_s * n_t,
                found=len(points),
            )
        )
    return Mesh(Grid(n_s, n_t, wrap_s, wrap_t, table["diagonal"].flag()), np.array(points))


def _mesh(entry: Entry) -> Mesh:
    """As it was: its faces make the connectivity, and everything that is sharp or hidden is named."""
    table = entry.table(("points", "faces", "sharp edges", "sharp vertices", "hidden faces"), may=("edges",))
    points = _points(table["points"])
    last = len(points) - 1
    faces = [[v.whole(0, last) for v in each.rows(3, MOST_CORNERS)] for each in table["faces"].rows(1, MOST_CORNERS)]
    bare = Topology.from_faces(faces, len(points), boundary=Boundary.LITERAL)
    bare = _renumbered(bare, table["edges"]) if "edges" in table else bare
    edges, vertices, hidden = bare.edge_sharpness.copy(), bare.vertex_sharpness.copy(), bare.hidden.copy()
    number = {frozenset(pair): e for e, pair in enumerate(bare.ends.tolist())}
    for each in table["sharp edges"].rows(most=MOST_CORNERS):
        a, b, sharpness = each.rows(3, 3)
        pair = frozenset((a.whole(0, last), b.whole(0, last)))
        if pair not in number:
            raise each.fault(phrase("there is no edge between {a} and {b}; take it out", a=a.value, b=b.value))
        edges[number[pair]] = sharpness.number(0, INFINITELY_SHARP)
    for each in table["sharp vertices"].rows(most=len(points)):
        vertex, sharpness = each.rows(2, 2)
        vertices[vertex.whole(0, last)] = sharpness.number(0, INFINITELY_SHARP)
    for each in table["hidden faces"].rows(most=len(faces)):
        hidden[each.whole(0, len(faces) - 1)] = True
    sharp = replace(bare, edge_sharpness=edges, vertex_sharpness=vertices, hidden=hidden)
    return Mesh(sharp, np.array(points))


def _renumbered(t: Topology, entry: Entry) -> Topology:
    """The mesh with the edges along its half-edges numbered as they are told."""
    edge = np.array([each.whole(0, t.n_edges - 1) for each in entry.rows(t.n_halfedges, t.n_halfedges)])
    number = np.zeros(t.n_edges, dtype=np.intp)
    number[t.edge] = edge
    if len(set(number.tolist())) < t.n_edges or (number[t.edge] != edge).any():
        raise entry.fault("two edges have one number, or one edge has two; leave the list out to have them numbered")
    return replace(t, edge=edge)


_MAKERS = {"polygon": _polygon, "net": _net, "mesh": _mesh}

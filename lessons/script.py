"""What a lesson is made of: beats, each a sentence over a stretch of a trace.

A lesson file holds one function that yields its beats; ``@lesson`` makes the lesson of it.
Beats are values: going back, jumping and exporting are indexing.  What the function takes as
parameters, such as a degree or a valence, the user may change while the lesson stands.
"""

import inspect
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property
from typing import Any, TypeAlias, TypedDict, Unpack

import numpy as np

from lessons.questions import Question, Which, checked
from lessons.turn import Turn
from subdivision import Boundary, Mesh, Role, Stage, Stencil, Trace
from subdivision.words import phrase


class Kind(Enum):
    """How a trace is drawn."""

    SCENE = "scene"
    """As points, edges and faces in space."""
    DIAGRAM = "diagram"
    """As boxes of coefficients: a pyramid for a polygon, an array for a net."""
    STENCIL = "stencil"
    """As the view's stencil drawn flat: black discs, the weights at them, a clear diamond for the point they make."""


@dataclass(frozen=True)
class Look:
    """Where the camera stands: degrees round the z axis, degrees above the x-y plane (90: from above), zoom."""

    azimuth: float = -50.0
    elevation: float = 25.0
    zoom: float = 1.0
    parallel: bool = False
    turned: tuple[Turn, ...] = ()
    """How a hand has turned it from there, once or again and again."""


FLAT = Look(azimuth=-90.0, elevation=90.0, parallel=True)
"""Straight from above, x to the right and y up: for plane curves."""

Reading: TypeAlias = Callable[..., str]
"""Measures what a pane shows: its ``Mesh`` (and that of the view laid over it) to a few words with a number."""


@dataclass(frozen=True, eq=False)
class View:
    """One pane of a beat: ``trace`` runs from stage position ``start`` to ``stop`` while the beat plays.

    Attributes
    ----------
    title : str
        Stands above the pane, where there are several.
    stencil : Stencil or None
        A row to point out: its point, its contributors, their weights.  It belongs to the end of the beat.
    span : int
        How many stages back the stencil's parents live (1: the stage just played).
    look : Look or None
        Where this pane's camera stands; None: where the beat's stands.
    marks : (vertex, words), ...
        What is written at some vertices: "n = 6".
    over : View or None
        Laid over this one in dashes: its net only.
    reading : Mesh -> str, or (Mesh, Mesh) -> str with a view laid over
        A measurement of what the pane shows, live, written below it.
    framed : Trace or None
        Whose control object the camera sees; None: its own.  A dragged one may so be seen as if it stood as before.
    isophotes : bool
        Draw no net but the lines along which the surface leans equally far from the light.
    veiled : bool
        Its stencil is asked for: neither it nor its weights are shown.
    """

    trace: Trace
    start: float
    stop: float
    kind: Kind = Kind.SCENE
    title: str = ""
    stencil: Stencil | None = None
    span: int = 1
    look: Look | None = None
    marks: tuple[tuple[int, str], ...] = ()
    over: "View | None" = None
    reading: Reading | None = None
    isophotes: bool = False
    framed: Trace | None = None
    veiled: bool = False

    def __post_init__(self) -> None:
        for at in (self.start, self.stop):
            if not isinstance(at, int | float | np.number):
                raise TypeError(f"a view runs from a number of stages to another, such as View(told, 0, 3), not {at!r}")

    def at(self, progress: float) -> float:
        """The stage position at ``progress`` (0..1) through the beat."""
        return self.start + progress * (self.stop - self.start)


@dataclass(frozen=True, eq=False)
class Beat:
    """Say ``text`` while the first view's trace runs from its start to its stop (equal: a still).

    Attributes
    ----------
    text : str
        The caption: short, present tense, readable from the back row.  Colours are named by what they mean:
        ``{edge}`` is "orange", or "yellow" where colours are as in the lecture's caption.
    views : tuple of View
        What is shown, side by side; the first one leads the timeline.
    formula : str
        Mathematics between dollar signs, set beside the caption.
    notes : str
        What the lecturer may say; not on the picture.
    look : Look
        Where the camera stands.
    claim : bool
        What the text asserts about the numbers; the tests require it.
    poster : bool
        Whether its end is the picture that stands for the lesson; else that is the end of the last beat.
    predict : Question or None
        What the class is asked before it sees the beat, where questions are asked.
    asks : Question or None
        What this beat asks and the next one answers.
    """

    text: str
    views: tuple[View, ...]
    formula: str = ""
    notes: str = ""
    look: Look = Look()
    claim: bool = True
    poster: bool = False
    predict: Question | None = None
    asks: Question | None = None

    @property
    def lead(self) -> View:
        return self.views[0]

    @property
    def start(self) -> float:
        return self.lead.start

    @property
    def stop(self) -> float:
        return self.lead.stop

    @property
    def is_still(self) -> bool:
        return self.start == self.stop

    def progress(self, at: float) -> float:
        """How far the beat has come when its leading view stands at ``at``."""
        return 1.0 if self.is_still else (at - self.start) / (self.stop - self.start)


OWN = "Own lessons"
"""The heading of lessons that name no section."""

Script = Callable[..., Iterator[Beat]]

Meaning: TypeAlias = Role | str
"""What a colour means: a role, or "extraordinary" for extraordinary vertices among the originals."""

EXTRAORDINARY = "extraordinary"


@dataclass(frozen=True)
class Knob:
    """A whole number of a lesson that the user may change while it stands; ``name`` is a parameter of its script."""

    name: str
    least: int
    most: int
    start: int

    @property
    def label(self) -> str:
        return self.name.replace("_", " ")


@dataclass(frozen=True, eq=False)
class Lesson:
    """A story in beats.

    Attributes
    ----------
    id : str
        The name of its function and file: ``figure_14_cube``.
    title : str
    section : str
        The heading it stands under; headings sort by their number.
    ours : str
        What the lecture does not say and we inferred; empty where all is the lecture's own.
    colours : Meaning -> str
        The colours the lecture's caption names, where they differ from the house's: ``{Role.EDGE: "yellow"}``.
    knobs : tuple of Knob
        What the user may change; ``values`` are what they stand at.
    asks : bool
        Whether its questions are beats of their own.
    """

    id: str
    title: str
    section: str
    script: Script
    ours: str = ""
    colours: Mapping[Meaning, str] = field(default_factory=dict)
    knobs: tuple[Knob, ...] = ()
    values: tuple[int, ...] = ()
    asks: bool = False
    _turned: dict[tuple[object, ...], "Lesson"] = field(default_factory=dict, repr=False)

    @cached_property
    def beats(self) -> tuple[Beat, ...]:
        if self.asks:
            return tuple(each for beat in self.asking(False).beats for each in _asked_first(beat))
        return tuple(self.script(**self.settings))

    @property
    def settings(self) -> dict[str, int]:
        """What the knobs stand at, by name."""
        return {knob.name: value for knob, value in zip(self.knobs, self.values, strict=True)}

    def turned(self, **settings: int) -> "Lesson":
        """The lesson with some knobs at other values, held within their limits; the same object for the same values."""
        wanted = {**self.settings, **settings}
        values = tuple(min(max(wanted[k.name], k.least), k.most) for k in self.knobs)
        return self._other(values, self.asks)

    def asking(self, on: bool) -> "Lesson":
        """The lesson with its questions as beats of their own, or without; itself where it has none."""
        if on == self.asks or (on and not any(beat.predict for beat in self.beats)):
            return self
        return self._other(self.values, on)

    def _other(self, values: tuple[int, ...], asks: bool) -> "Lesson":
        self._turned.setdefault((*self.values, self.asks), self)
        return self._turned.setdefault((*values, asks), replace(self, values=values, asks=asks))


def lesson(
    title: str,
    *,
    section: str = OWN,
    ours: str = "",
    colours: Mapping[Meaning, str] | None = None,
    knobs: Mapping[str, range] | None = None,
) -> Callable[[Script], Lesson]:
    """Make a lesson of the function that tells it.

    ``knobs`` names parameters of the function and the values they may take; they begin at their defaults.
    """

    def made(script: Script) -> Lesson:
        defaults = {name: p.default for name, p in inspect.signature(script).parameters.items()}
        turning = tuple(Knob(name, r[0], r[-1], defaults[name]) for name, r in (knobs or {}).items())
        start = tuple(knob.start for knob in turning)
        return Lesson(script.__name__, title, section, script, ours, colours or {}, turning, start)

    return made


class Said(TypedDict, total=False):
    """What ``show`` and ``play`` may add to their sentence: fields of a ``Beat``, and of its ``View``."""

    formula: str
    notes: str
    look: Look
    claim: bool
    poster: bool
    predict: Question | None
    title: str
    stencil: Stencil | None
    span: int
    marks: tuple[tuple[int, str], ...]
    over: View | None
    reading: Reading | None
    framed: Trace | None


def show(trace: Trace, after: Stage | None, text: str, **said: Unpack[Said]) -> Beat:
    """A still picture of the control object ``after`` a stage (None: before the first)."""
    at = trace.index(after) + 1 if after else 0
    return _beat(trace, (at, at), text, said)


def play(trace: Trace, first: Stage, text: str, *, until: Stage | None = None, **said: Unpack[Said]) -> Beat:
    """One stage, animated; or all stages from ``first`` ``until`` another one."""
    return _beat(trace, (trace.index(first), trace.index(until or first) + 1), text, said)


def beside(beat: Beat, *others: View) -> Beat:
    """The same beat with more panes beside it."""
    return replace(beat, views=(*beat.views, *others))


def diagram_of(beat: Beat, title: str = "") -> View:
    """The leading view's trace as a diagram, in step with it."""
    return replace(beat.lead, kind=Kind.DIAGRAM, title=title)


def stencil_of(trace: Trace, point: int, title: str = "") -> View:
    """The row of one point across the whole trace, drawn flat over the control points seen from above."""
    end = len(trace.stages)
    return View(trace, end, end, Kind.STENCIL, title, stencil=trace.whole.stencil(point), span=end)


def side_by_side(text: str, *views: View, **said: Unpack[Said]) -> Beat:
    """Several views as panes; the first one leads the timeline."""
    said.setdefault("look", look_at(views[0].trace))
    return Beat(text, views, **_split(said)[0])


def at_rest(trace: Trace, *panes: tuple[int, str]) -> tuple[View, ...]:
    """The control object after some numbers of stages as panes, each with its title above it."""
    return tuple(View(trace, at, at, title=title) for at, title in panes)


def levels(trace: Trace, *which: int) -> tuple[View, ...]:
    """The control object and some levels of it as panes, each with its name above it."""
    return at_rest(trace, *((trace.begins(k), phrase("level {k}", k=k) if k else "control points") for k in which))


def fragment(mesh: Mesh) -> Mesh:
    """A piece of a larger mesh: the faces that touch its boundary are there for the others, and drawn faint."""
    return Mesh(mesh.surface.with_boundary(Boundary.HIDE), mesh.points)


def look_at(trace: Trace) -> Look:
    """From above at what lies in the x-y plane, else from the front right."""
    return FLAT if np.ptp(trace.control.points[:, 2]) < 1e-9 else Look()


def with_diagram(beat: Beat) -> Beat:
    """The same beat with its diagram beside it."""
    return beside(beat, diagram_of(beat))


def before_and_after(beat: Beat, stage: Stage, before: str, after: str) -> Beat:
    """The same beat with two diagrams beside it: as it stood when ``stage`` was over, and as it plays."""
    trace = beat.lead.trace
    at = trace.index(stage) + 1
    return beside(beat, View(trace, at, at, Kind.DIAGRAM, before), diagram_of(beat, after))


def _asked_first(beat: Beat) -> tuple[Beat, ...]:
    return (beat,) if beat.predict is None else (question_of(beat), beat)


def question_of(beat: Beat) -> Beat:
    """The still that asks what a beat answers: its views as they stand before it, or pictures to choose from."""
    asked = checked(beat)
    views = (
        tuple(replace(v, title=str(k), look=v.look or beat.look, reading=None) for k, v in enumerate(asked.answers, 1))
        if isinstance(asked, Which)
        else tuple(_before(view, beat.is_still) for view in beat.views)
    )
    return Beat(asked.text, views, look=beat.look, asks=asked)


def _before(view: View, is_still: bool) -> View:
    """A view as it stands before its beat, its stencil veiled but minded by the camera; of a still, just the mesh."""
    over = None if is_still or view.over is None else _before(view.over, is_still)
    span = view.span - int(view.stop - view.start)
    return replace(view, stop=view.start, span=span, veiled=True, over=over, reading=None if is_still else view.reading)


def _beat(trace: Trace, stretch: tuple[float, float], text: str, said: Said) -> Beat:
    said.setdefault("look", look_at(trace))
    of_beat, of_view = _split(said)
    return Beat(text, (View(trace, *stretch, **of_view),), **of_beat)


def _split(said: Said) -> tuple[dict[str, Any], dict[str, Any]]:
    """What is said of the beat, and what of its view."""
    of_view = {name: value for name, value in said.items() if name in OF_VIEW}
    return {name: value for name, value in said.items() if name not in OF_VIEW}, of_view


OF_VIEW = ("title", "stencil", "span", "marks", "over", "reading", "framed")

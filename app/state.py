"""The whole state of the program as one value, and the only ways to change it.

No Qt here: a transition is a function from a state to the next one, so undo is a list and a
test is an equality.  ``app.gui.session`` wraps it in the one signal that views listen to.

A lesson is walked from *stop* to *stop*: the end of every stage of every beat.  Going on plays
the stage between; going back plays it backwards.
"""

from dataclasses import dataclass, field, fields, replace
from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np

from app.laboratory.lab import LABORATORY, Lab
from app.words import language
from lessons import all_lessons
from lessons.script import Beat, Lesson, View
from lessons.turn import REST, Turn
from subdivision import Topology, Trace
from subdivision.catalogue import Vectors

Edits: TypeAlias = tuple[tuple[int, tuple[float, float, float]], ...]
"""Control points that were dragged: (vertex, where to), one entry a vertex."""

Prediction: TypeAlias = tuple[float, float, float] | int
"""A place where somebody thinks a point will go, or the number (from 0) of the answer that was chosen."""

VALENCES = range(3, 13)
"""Those that are analysed."""

STILL = 0.5
"""How long a still is on the timeline; a stage is 1."""

READING = 2.5
"""How long playing through rests on a still, in stages, so that it can be read."""

WALKED = 256
"""Lessons whose ways are remembered: more than there are, and not all that were ever made in the laboratory."""


@dataclass(frozen=True)
class Stop:
    """A place where playing rests: ``at`` stages into the trace, in beat number ``beat``."""

    beat: int
    at: float


@dataclass(frozen=True)
class Segment:
    """One stage, or one still, on the timeline."""

    beat: int
    start: float
    stop: float
    begin: float
    end: float
    name: str
    level: int
    ends_level: bool


@dataclass(frozen=True)
class Options:
    """What is shown, and how."""

    surface: bool = True
    net: bool = True
    ghost: bool = True
    helpers: bool = True
    weights: bool = True
    labels: bool = False
    valences: bool = False
    legend: bool = True
    control: bool = False
    matrix: bool = False
    basis: bool = False
    limit: bool = False
    distances: bool = False
    surface_shows: str = ""
    lattice: bool = False
    spectrum: bool = False
    valence: int = 0
    """Which vertices are analysed; 0: those of the object."""
    as_caption: bool = False
    across: str = "step"
    theme: str = "light"
    language: str = field(default_factory=language)
    """That of the words on the picture and round it: at first the one that is spoken."""
    scale: float = 1.0
    """How large the window is, and from 1 on also the type, the strokes and the points of the picture."""
    speed: float = 1.0
    through: bool = False
    asking: bool = False
    """Lessons rest at their questions, before they show the answers."""
    reduced_motion: bool = False
    """Stages fade into one another instead of moving."""
    presenting: bool = False
    blank: bool = False


ASIDE = ("matrix", "lattice", "distances")
"""Options that put something beside the picture, one under another; 'spectrum' needs all the room there."""


@dataclass(frozen=True)
class Spot:
    """A point that is pointed at: number ``point`` after ``stage`` stages, in pane number ``pane``."""

    pane: int
    stage: int
    point: int


@dataclass(frozen=True)
class Picked:
    """What of the control object is chosen to be edited: its vertices, edges or faces with these ``numbers``.

    ``along`` is how far along the last edge the hand meant it, from its first end, in 0..1.
    """

    kind: str
    numbers: tuple[int, ...]
    along: float = 0.5


KINDS = ("vertex", "edge", "face")
"""What can be picked."""


@dataclass(frozen=True, eq=False)
class State:
    """Where we are: the lesson, the beat, how far into it, what is pointed at, what was dragged, the laboratory.

    ``goal`` is where playing will rest; None while it rests.  ``wait`` is how many stages' time a
    still is shown before playing through goes on.  ``turn`` is what the hand has done to the beat's camera.
    ``predicted`` is what the class has said to the question that is asked, or has just been answered.
    """

    lesson: Lesson
    beat: int = 0
    at: float = 0.0
    goal: Stop | None = None
    wait: float = 0.0
    focus: Spot | None = None
    edits: Edits = ()
    lab: Lab | None = None
    picked: Picked | None = None
    turn: Turn = REST
    predicted: tuple[Prediction, ...] = ()
    options: Options = field(default_factory=Options)

    @property
    def now(self) -> Beat:
        return self.lesson.beats[self.beat]

    @property
    def progress(self) -> float:
        """0..1 through the beat."""
        return self.now.progress(self.at)

    @property
    def is_playing(self) -> bool:
        return self.goal is not None

    @property
    def vectors(self) -> Vectors:
        """The vector set of the box spline that leads the laboratory; () where none does."""
        is_lab = self.lab is not None and self.lesson.id == LABORATORY
        return self.lab.rules[0].vectors if self.lab is not None and is_lab else ()

    def trace(self, view: View) -> Trace:
        """The view's trace on the control points as they were dragged."""
        return edited(view.trace, self.edits)


def edited(trace: Trace, edits: Edits) -> Trace:
    """The trace with control points moved; itself where none is."""
    return _edited(trace, edits) if edits else trace


@lru_cache(maxsize=8)
def _edited(trace: Trace, edits: Edits) -> Trace:
    there = {vertex: np.array(to) for vertex, to in edits if vertex < trace.control.topology.n_vertices}
    return trace.dragged(there) if there else trace


# -- the way through a lesson -----------------------------------------------------------------


@lru_cache(maxsize=WALKED)
def stops(lesson: Lesson) -> tuple[Stop, ...]:
    """Every place where playing rests, in order.  A played beat rests after each of its stages."""
    found: list[Stop] = []
    for b, beat in enumerate(lesson.beats):
        whole = [float(k) for k in range(int(np.floor(beat.start)) + 1, int(np.ceil(beat.stop)))]
        rests = [beat.stop] if beat.is_still else [*whole, beat.stop]
        if b == 0 and not beat.is_still:
            rests.insert(0, beat.start)
        found.extend(Stop(b, at) for at in rests)
    return tuple(found)


@lru_cache(maxsize=WALKED)
def segments(lesson: Lesson) -> tuple[Segment, ...]:
    """The timeline: one segment for each stage played and each still."""
    found: list[Segment] = []
    here = 0.0
    for b, beat in enumerate(lesson.beats):
        trace = beat.lead.trace
        if beat.is_still:
            level, _ = _level(trace, beat.start)
            found.append(Segment(b, beat.start, beat.stop, here, here + STILL, "", level, False))
            here += STILL
        for k in range(int(beat.start), int(np.ceil(beat.stop)) if not beat.is_still else 0):
            level, ends = _level(trace, k + 1)
            found.append(Segment(b, k, k + 1, here, here + 1, trace.stages[k].name, level, ends))
            here += 1
    return tuple(found)


def axis_of(state: State) -> float:
    """Where the state stands on the timeline."""
    mine = [s for s in segments(state.lesson) if s.beat == state.beat]
    for s in mine:
        if s.start <= state.at <= s.stop:
            return s.end if s.start == s.stop else s.begin + (state.at - s.start) * (s.end - s.begin)
    return mine[-1].end


def question_at(state: State) -> int | None:
    """The number of the beat that asks what is asked now, or what this beat answers; None: there is no question."""
    beats, b = state.lesson.beats, state.beat
    return next((k for k in (b, b - 1) if k >= 0 and beats[k].asks is not None), None)


def valence_of(state: State) -> int:
    """The valence that is analysed: of the inner vertex pointed at, else the one chosen, else the object's own.

    An object's own is that of most of its extraordinary vertices, the regular one if it has none.
    """
    if (found := _valence_pointed_at(state)) in VALENCES:
        return found
    t = state.now.lead.trace.control.topology
    if state.options.valence or not isinstance(t, Topology):
        return state.options.valence or 4
    counted = np.bincount(t.valence[t.extraordinary], minlength=VALENCES.stop)[: VALENCES.stop]
    counted[: VALENCES.start] = 0
    return int(counted.argmax()) if counted.any() else (6 if t.is_triangular else 4)


def _valence_pointed_at(state: State) -> int:
    """0: no inner vertex of a mesh is pointed at."""
    spot = state.focus
    t = state.now.views[spot.pane].trace.topology_at(spot.stage) if spot is not None else None
    if spot is None or not isinstance(t, Topology) or spot.point >= t.n_vertices or t.on_boundary[spot.point]:
        return 0
    return int(t.valence[spot.point])


def level_of(state: State) -> int:
    """How many subdivision steps are complete."""
    return _level(state.now.lead.trace, float(np.floor(state.at)))[0]


def stop_level(lesson: Lesson, stop: Stop) -> int:
    """How many subdivision steps are complete at a stop."""
    return _level(lesson.beats[stop.beat].lead.trace, stop.at)[0]


def _level(trace: Trace, at: float) -> tuple[int, bool]:
    """Steps complete after ``at`` stages, and whether one ends just there."""
    k = int(at)
    if k == 0:
        return 0, False
    ends = k == len(trace.stages) or trace.levels[k] > trace.levels[k - 1]
    return trace.levels[k - 1] + ends, ends


# -- transitions ------------------------------------------------------------------------------


def start(lesson: Lesson, options: Options | None = None) -> State:
    """The lesson at its first stop."""
    options = options or Options()
    told = lesson.asking(options.asking)
    return at_stop(State(told, options=options), stops(told)[0])


def open_lesson(state: State, lesson: Lesson, step: int = 0) -> State:
    """Another lesson at its stop number ``step`` (from 0), same options."""
    lesson = lesson.asking(state.options.asking)
    places = stops(lesson)
    return at_stop(state, places[min(max(step, 0), len(places) - 1)], lesson=lesson, edits=(), picked=None)


def at_stop(state: State, stop: Stop, **changes: Any) -> State:
    """Rest at a stop; ``changes`` may bring another lesson, whose stop it is."""
    return _moved(state, beat=stop.beat, at=stop.at, goal=None, wait=0.0, focus=None, **changes)


def _moved(state: State, **changes: Any) -> State:
    """The state at another place; another lesson, or another camera of it, is seen as it is meant to be."""
    there = replace(state, **changes)
    there = replace(there, focus=_held(state, there)) if there.focus is None else there
    is_same_question = there.lesson is state.lesson and question_at(there) == question_at(state)
    there = there if is_same_question else replace(there, predicted=())
    is_same_view = there.lesson.id == state.lesson.id and there.now.look == state.now.look
    return there if is_same_view else replace(there, turn=REST)


def _held(before: State, there: State) -> Spot | None:
    """The control point in focus, which stays there from stage to stage while control points are shown."""
    spot, o = before.focus, there.options
    if spot is None or spot.stage or not (o.basis or o.control) or before.lesson is not there.lesson:
        return None
    views, others = before.now.views, there.now.views
    is_same = spot.pane < min(len(views), len(others)) and views[spot.pane].trace is others[spot.pane].trace
    return spot if is_same else None


def rest(state: State) -> State:
    """Pause where we are."""
    return replace(state, goal=None, wait=0.0)


def settle(state: State) -> State:
    """Finish at once what is playing."""
    return at_stop(state, state.goal) if state.goal else state


def forward(state: State) -> State:
    """Play to the next stop; if playing already, be there at once and play on."""
    state = settle(state)
    later = [s for s in stops(state.lesson) if (s.beat, s.at) > (state.beat, state.at)]
    if not later:
        return state
    goal = later[0]
    beat = state.lesson.beats[goal.beat]
    if goal.beat == state.beat:
        return replace(state, goal=goal)
    return (
        at_stop(state, goal) if beat.is_still else _moved(state, beat=goal.beat, at=beat.start, goal=goal, focus=None)
    )


def back(state: State) -> State:
    """Play backwards to the stop before; if playing already, be there at once and go on back."""
    state = settle(state)
    earlier = [s for s in stops(state.lesson) if (s.beat, s.at) < (state.beat, state.at)]
    if not earlier:
        return state
    return at_stop(state, earlier[-1]) if state.now.is_still else replace(state, goal=earlier[-1])


def onward(state: State) -> State:
    """Play to the next stop; from the last one of a lesson, to the next lesson."""
    there = forward(state)
    return there if _has_gone(state, there) else _neighbour(there, 1)


def homeward(state: State) -> State:
    """Play back to the stop before; from the first one of a lesson, to the end of the lesson before."""
    there = back(state)
    if _has_gone(state, there) or (before := _neighbour(there, -1)) is there:
        return there
    return last(before)


def _has_gone(state: State, there: State) -> bool:
    return (there.beat, there.at, there.goal) != (state.beat, state.at, state.goal)


def _neighbour(state: State, by: int) -> State:
    """The lesson ``by`` places on in the lecture; the same state where there is none."""
    every = all_lessons()
    here = next((k for k, lesson in enumerate(every) if lesson.id == state.lesson.id), len(every))
    return open_lesson(state, every[here + by]) if 0 <= here + by < len(every) and here < len(every) else state


def skip(state: State, by: int) -> State:
    """``by`` stops on or back, without playing."""
    state, places = settle(state), stops(state.lesson)
    if by > 0:
        beyond = [s for s in places if (s.beat, s.at) > (state.beat, state.at)]
        return at_stop(state, beyond[min(by, len(beyond)) - 1]) if beyond else state
    before = [s for s in places if (s.beat, s.at) < (state.beat, state.at)]
    return at_stop(state, before[max(len(before) + by, 0)]) if before else state


def first(state: State) -> State:
    """The first stop of the lesson."""
    return at_stop(state, stops(state.lesson)[0])


def last(state: State) -> State:
    """The last stop of the lesson."""
    return at_stop(state, stops(state.lesson)[-1])


def turn_level(state: State, by: int) -> State:
    """The nearest stop where one more (or one fewer) subdivision step is complete."""
    here = level_of(settle(state))
    places = stops(state.lesson)
    levels = [_level(state.lesson.beats[s.beat].lead.trace, s.at)[0] for s in places]
    wanted = [s for s, level in zip(places, levels, strict=True) if level == here + by]
    later = [s for s in wanted if (s.beat, s.at) > (state.beat, state.at)]
    earlier = [s for s in wanted if (s.beat, s.at) < (state.beat, state.at)]
    nearest = later[:1] if by > 0 else earlier[-1:]
    return at_stop(state, nearest[0]) if nearest else (last(state) if by > 0 else first(state))


def toggle_play(state: State) -> State:
    """Pause, or play to the next stop; at the end of the lesson, from its beginning."""
    if state.is_playing:
        return rest(state)
    there = forward(state)
    return there if _has_gone(state, there) else forward(first(state))


def tick(state: State, stages: float) -> State:
    """Playing goes on by a number of ``stages`` (0.02, say), and rests at the goal or goes for the next one."""
    if state.goal is None:
        return state
    if state.wait > 0:
        left = max(state.wait - stages, 0.0)
        return replace(state, wait=left) if left else _onward(settle(state))
    back_there = (state.goal.beat, state.goal.at) < (state.beat, state.at)
    end = state.goal.at if state.goal.beat == state.beat else state.now.start
    at = max(state.at - stages, end) if back_there else min(state.at + stages, end)
    if at != end:
        return replace(state, at=at)
    settled = at_stop(state, state.goal)
    return _onward(settled) if state.options.through and not back_there else settled


def _onward(state: State) -> State:
    """Playing through: on to the next stop; a still is shown long enough to be read."""
    there = forward(state)
    if there.is_playing or there.beat == state.beat:
        return there
    return replace(there, goal=Stop(there.beat, there.at), wait=READING)


def seek(state: State, axis: float) -> State:
    """Scrub: be ``axis`` along the timeline."""
    parts = segments(state.lesson)
    axis = min(max(axis, 0.0), parts[-1].end)
    s = next(s for s in parts if axis <= s.end)
    at = s.start + (axis - s.begin) / (s.end - s.begin) * (s.stop - s.start)
    return at_stop(state, Stop(s.beat, at))


def look(state: State, spot: Spot | None) -> State:
    """Point at a point: its stencil is shown; None: at nothing."""
    return replace(state, focus=spot)


def pick(state: State, picked: Picked | None) -> State:
    """Choose parts of the control object to edit; None: nothing."""
    return replace(state, picked=picked)


def turn_knob(state: State, number: int, by: int) -> State:
    """Change the lesson's knob number ``number`` (from 0) by ``by``; stay at the same place of the story."""
    if not 0 <= number < len(state.lesson.knobs):
        return state
    knob, value = state.lesson.knobs[number], state.lesson.values[number]
    return set_knob(state, knob.name, value + by)


def set_knob(state: State, name: str, value: int) -> State:
    """Set a knob of the lesson, held within its limits; stay at the same place of the story."""
    other = state.lesson.turned(**{name: value})
    if other is state.lesson:
        return state
    state = settle(state)
    old, new = stops(state.lesson), stops(other)
    here = max(k for k, s in enumerate(old) if (s.beat, s.at) <= (state.beat, state.at) or k == 0)
    from_end = len(old) - 1 - here
    k = min(here, len(new) - 1) if here < from_end else max(len(new) - 1 - from_end, 0)
    return at_stop(state, new[k], lesson=other, edits=(), picked=None)


def turn_view(state: State, turn: Turn) -> State:
    """See it from elsewhere."""
    return replace(state, turn=turn)


def is_turned_only(before: State, after: State) -> bool:
    """Whether two states differ in nothing but from where they are seen."""
    return _differ_only_in("turn", before, after)


def is_dragged_only(before: State, after: State) -> bool:
    """Whether two states differ in nothing but in where control points are."""
    return _differ_only_in("edits", before, after)


def _differ_only_in(part: str, before: State, after: State) -> bool:
    differing = [each.name for each in fields(State) if getattr(before, each.name) != getattr(after, each.name)]
    return differing == [part]


def drag(state: State, vertex: int, to: tuple[float, float, float]) -> State:
    """Move a control point; everything downstream follows."""
    kept = tuple((v, p) for v, p in state.edits if v != vertex)
    return replace(state, edits=(*kept, (vertex, to)))


def put_back(state: State, vertex: int) -> State:
    """A control point where the lesson has it."""
    return replace(state, edits=tuple((v, p) for v, p in state.edits if v != vertex))


def choose(state: State, **options: Any) -> State:
    """Change options by name."""
    return replace(state, options=replace(state.options, **options))


def toggle(state: State, option: str) -> State:
    """Switch one of the yes-or-no options; what stands beside the picture leaves where there is no room for both."""
    is_on = not getattr(state.options, option)
    leaves = ASIDE if option == "spectrum" else ("spectrum",) if option in ASIDE else ()
    return choose(state, **dict.fromkeys(leaves if is_on else (), False), **{option: is_on})


def turn_valence(state: State, by: int) -> State:
    """Analyse vertices of another valence; whatever is pointed at is let go."""
    there = min(max(valence_of(state) + by, VALENCES.start), VALENCES.stop - 1)
    return choose(replace(state, focus=None), valence=there)

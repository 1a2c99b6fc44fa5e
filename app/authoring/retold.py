"""A lesson in another version of its file: a state stays at its place in it."""

from dataclasses import replace

from app.state import Spot, State, settle
from lessons.script import Beat, Lesson


def retold(state: State, lesson: Lesson) -> State:
    """The state in another version of its lesson: at the same beat or the nearest, with all that still makes sense."""
    if state.lesson.id != lesson.id or state.lesson is lesson:
        return state
    state = settle(state)
    same = {name: value for name, value in state.lesson.settings.items() if name in {k.name for k in lesson.knobs}}
    there = lesson.turned(**same).asking(state.lesson.asks)
    beat = _nearest(state, there.beats)
    now = there.beats[beat]
    at = min(max(now.start + state.at - state.now.start, now.start), now.stop)
    most = max(view.trace.control.topology.n_vertices for each in there.beats for view in each.views)
    edits = tuple((vertex, to) for vertex, to in state.edits if vertex < most)
    focus = state.focus if state.focus is not None and _is_there(state.focus, now) else None
    return replace(state, lesson=there, beat=beat, at=at, edits=edits, focus=focus, picked=None)


def _nearest(state: State, beats: tuple[Beat, ...]) -> int:
    """The beat that says the same, nearest to where the state was; else the one of the same number, or the last."""
    alike = [k for k, beat in enumerate(beats) if beat.text == state.now.text]
    return min(alike, key=lambda k: abs(k - state.beat), default=min(state.beat, len(beats) - 1))


def _is_there(spot: Spot, beat: Beat) -> bool:
    """Whether a beat has the point that was pointed at."""
    if spot.pane >= len(beat.views) or spot.stage > len(stages := beat.views[spot.pane].trace.stages):
        return False
    control = beat.views[spot.pane].trace.control
    return spot.point < (stages[spot.stage - 1].n_points if spot.stage else control.topology.n_vertices)

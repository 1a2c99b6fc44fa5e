"""Predictions: what the class says before it sees, and how far that is from what it then sees.

A question rests on the timeline as a beat of its own, and the beat after it gives the answer.
"""

from dataclasses import replace

import numpy as np

from app.state import Prediction, State, Stop, at_stop, choose, question_at, settle
from lessons.questions import Question, Weight, Where, Which
from lessons.script import Beat, View
from subdivision.arrays import Floats
from subdivision.exact import spelled
from subdivision.words import phrase

MOST = 8
"""Places that a class may point at; one more, and the first of them leaves."""


def question(state: State) -> Question | None:
    """What is asked now, or was asked before this beat."""
    k = question_at(state)
    return state.lesson.beats[k].asks if k is not None else None


def is_open(state: State) -> bool:
    """Whether the state rests at a question."""
    return state.now.asks is not None


def answers(state: State) -> int:
    """How many answers there are to choose from, if the state rests where one is to be chosen; else 0."""
    asked = state.now.asks
    return 0 if asked is None or isinstance(asked, Where) else len(asked.answers)


def answer(state: State) -> Beat:
    """The beat that answers what is asked."""
    return state.lesson.beats[(question_at(state) or 0) + 1]


def is_told(state: State) -> bool:
    """Whether the answer is there to be compared with what was predicted."""
    return state.now.asks is None and state.progress == 1 and bool(state.predicted)


def place(state: State, asked: Where) -> Floats:
    """(3,): where the point will be, on the control points as they were dragged."""
    view = answer(state).views[asked.pane]
    return np.asarray(state.trace(view).points[int(view.stop)][asked.point])


def edge(state: State, asked: Where) -> float:
    """The mean length of the edges of the control object: distances are told in it."""
    control = state.trace(answer(state).views[asked.pane]).control
    a, b = control.points[control.topology.ends].transpose(1, 0, 2)
    return float(np.linalg.norm(a - b, axis=1).mean())


def distances(state: State, asked: Where) -> Floats:
    """(n,): how far each predicted place is from where the point goes, in edges."""
    places = np.array([p for p in state.predicted if not isinstance(p, int)], dtype=float).reshape(-1, 3)
    return np.asarray(np.linalg.norm(places - place(state, asked), axis=1) / edge(state, asked))


def chosen(state: State) -> int | None:
    """The number of the answer that was chosen."""
    return next((p for p in state.predicted if isinstance(p, int)), None)


def measured(state: State, view: View) -> str:
    """How near the predictions came, where the view has the point that was asked for; else nothing."""
    asked = question(state)
    if not (isinstance(asked, Where) and is_told(state) and view is answer(state).views[asked.pane]):
        return ""
    n, nearest = len(state.predicted), f"{distances(state, asked).min():.2f}"
    if n == 1:
        return phrase("prediction {distance} of an edge away", distance=nearest)
    return phrase("nearest of {n} predictions {distance} of an edge away", n=n, distance=nearest)


def spoken_truth(state: State) -> str:
    """The answer to what is asked, for the lecturer alone; nothing where nothing is."""
    asked = state.now.asks
    if isinstance(asked, Where):
        x, y, z = (f"{n:.2f}" for n in place(state, asked))
        return phrase("Answer: the point goes to ({x}, {y}, {z}).", x=x, y=y, z=z)
    if isinstance(asked, Weight):
        k = asked.truth(answer(state))
        return phrase("Answer {number}: {weight}.", number=k + 1, weight=spelled(asked.answers[k]))
    if isinstance(asked, Which):
        return phrase("Answer: picture {number}.", number=asked.truth(answer(state)) + 1)
    return ""


# -- transitions ------------------------------------------------------------------------------


def predict(state: State, prediction: Prediction) -> State:
    """Point at one more place, or choose an answer; the same answer again takes it back."""
    if not isinstance(prediction, int):
        is_asked = isinstance(state.now.asks, Where)
        return replace(state, predicted=(*state.predicted, prediction)[-MOST:]) if is_asked else state
    if not 0 <= prediction < answers(state):
        return state
    return replace(state, predicted=() if state.predicted == (prediction,) else (prediction,))


def take_back(state: State) -> State:
    """Without the last prediction."""
    return replace(state, predicted=state.predicted[:-1]) if is_open(state) else state


def toggle_asking(state: State) -> State:
    """Rest at questions from now on, or no more; stay at the same place of the story."""
    state = settle(state)
    is_on = not state.options.asking
    other, here, at = state.lesson.asking(is_on), state.now, state.at
    if is_open(state):  # its place goes: to the one before, or to where the answer begins
        here = state.lesson.beats[state.beat - 1] if state.beat else answer(state)
        at = here.stop if state.beat else here.start
    return at_stop(choose(state, asking=is_on), Stop(other.beats.index(here), at), lesson=other)

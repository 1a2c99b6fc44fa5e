"""What is asked and what was predicted, on the picture: beside the truth once that is there."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from app import asking
from app.draw import stencils
from app.draw.picture import Box, Diagram, Label, Markers, Note, Pin, Scene, Shape
from app.draw.selected import radius_of
from app.draw.theme import Theme, mixed
from app.state import State
from lessons.questions import Weight, Where, Which
from lessons.script import View
from subdivision import Stencil
from subdivision.arrays import Floats
from subdivision.exact import spelled
from subdivision.words import phrase

ASKED, PREDICTION = "asked", phrase("prediction")
"""The name of the marker at what is asked for; what the legend calls a prediction."""

MARK = "?"
MARK_SIZE, DISTANCE_SIZE = 42.0, 26.0
"""Of type in logical points."""

HALO = 1.15
"""Radius round the point that is asked for, relative to the markers that are there."""

TINT = 0.25
"""How much of its colour the true answer's box takes on."""

FRAME, THIN = 7.0, 2.0
"""Strokes round an answer that was chosen, and round others, in logical points."""


def asked(scene: Scene, state: State, view: View, theme: Theme) -> Scene:
    """The scene of a view with a mark at what is asked for, and with the places that were predicted."""
    question = asking.question(state)
    if isinstance(question, Where):
        views = state.now.views
        if question.pane >= len(views) or view is not views[question.pane]:
            return scene
        scene = _with_pins(scene, state, question, theme)
        at = question.before(asking.answer(state)) if asking.is_open(state) else -1
        return _with_mark(scene, state, view, int(view.start), at, theme) if at >= 0 else scene
    if isinstance(question, Weight) and view.veiled and view.stencil == question.row:
        scene = _with_mark(scene, state, view, int(view.stop) - view.span, question.parent, theme)
    return scene


def veiled(state: State, row: Stencil) -> list[str]:
    """What stands in the place of the weights of a row: room for them, and a mark at the one that is asked for."""
    question = state.now.asks
    asked_for = question.parent if isinstance(question, Weight) and row == question.row else -1
    rooms = ["\u00a0" * len(words) for words in stencils.spelled(row)]
    return [MARK if p == asked_for else room for (p, _), room in zip(row.terms, rooms, strict=True)]


def _with_mark(scene: Scene, state: State, view: View, stage: int, point: int, theme: Theme) -> Scene:
    trace = state.trace(view)
    at = trace.points[stage][point]
    size = np.array([HALO * radius_of(scene, trace.control)])
    halo = Markers(at[None], Shape.HALO, theme.guess, size, np.ones(1), np.full(1, -1), ASKED)
    mark = Label(at, MARK, theme.ink, MARK_SIZE)
    return replace(scene, markers=(*scene.markers, halo), labels=(*scene.labels, mark))


def _with_pins(scene: Scene, state: State, question: Where, theme: Theme) -> Scene:
    """Each predicted place; once the answer is there, tied to it, and with the distance."""
    places = [np.array(p) for p in state.predicted if not isinstance(p, int)]
    if not asking.is_told(state):
        return replace(scene, pins=tuple(Pin(p, Shape.AIM, theme.guess) for p in places))
    truth: Floats = asking.place(state, question)
    pins = tuple(Pin(p, Shape.AIM, theme.guess, truth) for p in places)
    words = tuple(
        Label(p, f"{distance:.2f}", theme.ink, DISTANCE_SIZE)
        for p, distance in zip(places, asking.distances(state, question), strict=True)
    )
    return replace(scene, pins=pins, labels=(*scene.labels, *words))


# -- answers to choose from ---------------------------------------------------------------------


def weights(state: State, theme: Theme) -> Diagram | None:
    """The weights to choose from, one under another; with the answer, which is true.  None: there are none to show."""
    question = asking.question(state)
    if not isinstance(question, Weight) or not (asking.is_open(state) or state.predicted):
        return None
    true = question.truth(asking.answer(state)) if asking.is_told(state) else -1
    n, chosen = len(question.answers), asking.chosen(state)
    boxes = [
        Box(
            0.0, float(k), (text,), mixed(theme.background, theme.accent, TINT) if k == true else theme.background,
            theme.ink, theme.guess if k == chosen else theme.muted, 1.1, 0.72, line=FRAME if k == chosen else THIN,
            choice=k,
        )
        for k, text in enumerate(map(spelled, question.answers))
    ]  # fmt: skip
    notes = [
        *(Note(-0.75, float(k), str(k + 1), theme.muted, "right") for k in range(n)),
        *(Note(0.75, float(k), words, theme.ink) for k in range(n) if (words := _verdict(k, chosen, true))),
    ]
    return Diagram((-1.0, -0.6, 2.1, n - 0.4), tuple(boxes), (), tuple(notes), largest=120.0)


def pictures(state: State) -> Iterator[tuple[View, bool]]:
    """Beside the answer: the picture that was chosen, and the true one; and whether it is the chosen one."""
    question, chosen = asking.question(state), asking.chosen(state)
    if not isinstance(question, Which) or asking.is_open(state) or chosen is None:
        return
    true = question.truth(asking.answer(state)) if asking.is_told(state) else -1
    views = state.lesson.beats[state.beat - 1].views
    for k in sorted({chosen, true} - {-1}, key=lambda k: k != chosen):
        words = phrase("{number}: {verdict}", number=k + 1, verdict=_verdict(k, chosen, true))
        yield replace(views[k], title=words), k == chosen


def _verdict(k: int, chosen: int | None, true: int) -> str:
    if k == chosen:
        return phrase("predicted, and true") if k == true else phrase("predicted")
    return phrase("true") if k == true else ""

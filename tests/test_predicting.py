"""Questions have one true answer, which is the engine's; what was predicted is measured exactly, and kept."""

from collections import Counter
from itertools import product

import numpy as np
import pytest

import lessons
from app import asking
from app import state as st
from app.authoring.trial import tried
from app.draw.compose import compose
from app.draw.layout import overlay
from app.draw.picture import Diagram, Scene, Shape
from app.draw.primitives import Mark, Text
from app.draw.theme import THEMES
from app.sessions.keeping import kept, restored
from app.sessions.link import followed, link
from app.sessions.strict import KeepingError
from lessons.questions import Weight, Where, Which, weight, where, which
from lessons.script import Lesson, View, at_rest, play, show
from subdivision import shapes, trace
from subdivision.exact import spelled
from subdivision.schemes import QUAD_CENTROID

ASKING = [each for each in lessons.all_lessons() if any(beat.predict for beat in each.beats)]
CUBE = lessons.find("14")

each_lesson = pytest.mark.parametrize("lesson", ASKING, ids=lambda each: each.id)


def questions(lesson):
    """The states that rest at the questions of a lesson."""
    state = st.start(lesson, st.Options(asking=True))
    there = [st.at_stop(state, stop) for stop in st.stops(state.lesson)]
    return [each for each in there if asking.is_open(each)]


def answered(state):
    """The state at the end of the beat that answers."""
    b = state.beat + 1
    return st.at_stop(state, [stop for stop in st.stops(state.lesson) if stop.beat == b][-1])


def outline(view):
    """The edges that a view ends with, as a set of pairs of places."""
    mesh = view.trace.mesh_at(int(view.stop))
    return frozenset(frozenset(map(tuple, edge)) for edge in mesh.points.round(9)[mesh.topology.ends].tolist())


def turned(lesson):
    """The lesson for every value of its knobs."""
    for values in product(*(range(knob.least, knob.most + 1) for knob in lesson.knobs)):
        yield lesson.turned(**dict(zip((knob.name for knob in lesson.knobs), values, strict=True)))


def test_the_lecture_asks_in_most_of_its_figures_and_in_every_way():
    wanted = [f"figure_{n:02}" for n in (1, 2, 4, 6, 7, 11, 12, 13, 14, 15, 16, 19, 20, 21, 22, 24)]
    asked = {each.id[:9] for each in ASKING}
    assert set(wanted) <= asked
    assert "motivation" in {each.id for each in ASKING}
    assert sum(each.id.startswith("exercise") for each in ASKING) >= 2
    kinds = Counter(type(beat.predict) for each in ASKING for beat in each.beats)
    assert min(kinds[kind] for kind in (Where, Weight, Which)) >= 4


@each_lesson
def test_the_truth_is_the_engines_and_there_is_one_whatever_the_knobs_stand_at(lesson):
    for each in turned(lesson):
        for state in questions(each):
            asked, beat = state.now.asks, asking.answer(state)
            if isinstance(asked, Where):
                view = beat.views[asked.pane]
                row = view.trace.upto(int(view.stop)).stencil(asked.point)
                there = row.weights @ view.trace.points[0][row.parents]
                assert np.abs(there - asking.place(state, asked)).max() < 1e-12
            elif isinstance(asked, Weight):
                true = [answer == asked.row.weight(asked.parent) for answer in asked.answers]
                assert (sum(true), true[asked.truth(beat)]) == (1, True)
                assert 2 <= len(set(asked.answers)) == len(asked.answers) <= 4
                assert [float(a) for a in asked.answers] == sorted(map(float, asked.answers))
            else:
                ends = [outline(view) for view in beat.views]
                assert [outline(view) in ends for view in asked.answers].count(True) == 1
                assert outline(asked.answers[asked.truth(beat)]) in ends


@each_lesson
def test_a_question_is_one_more_stop_before_its_answer_and_tells_nothing(lesson):
    plain, asked = st.stops(lesson), st.stops(lesson.asking(True))
    there = lesson.asking(True).beats
    assert [lesson.beats.index(there[s.beat]) for s in asked if there[s.beat].asks is None] == [s.beat for s in plain]
    assert len(asked) - len(plain) == sum(beat.predict is not None for beat in lesson.beats)
    for state in questions(lesson):
        assert asking.answer(state).predict is state.now.asks
        assert len(state.now.text) <= 130
        assert state.now.text.endswith("?")
        assert state.now.formula == state.now.notes == ""
        for theme in THEMES:
            picture = compose(st.choose(state, theme=theme))
            assert len(picture.panes) <= 6
        words = [label.text for scene in picture.scenes for label in scene.labels]
        words += [dot.text for pane in picture.panes if isinstance(pane.content, Diagram) for dot in pane.content.dots]
        true = state.now.asks.row.weight(state.now.asks.parent) if isinstance(state.now.asks, Weight) else None
        assert true is None or spelled(true) not in words
        is_pointed_out = isinstance(state.now.asks, Where) or any(view.stencil for view in state.now.views)
        assert ("?" in words) == (is_pointed_out and not isinstance(state.now.asks, Which))


@each_lesson
def test_what_was_predicted_stays_beside_the_truth_and_goes_when_the_beat_ends(lesson):
    for state in questions(lesson):
        guess = (0.1, 0.2, 0.3) if isinstance(state.now.asks, Where) else 0
        there = answered(asking.predict(state, guess))
        picture = compose(there)
        if isinstance(state.now.asks, Where):
            scene = picture.panes[state.now.asks.pane].content
            assert isinstance(scene, Scene)
            (pin,) = scene.pins
            assert np.array_equal(pin.to, asking.place(there, state.now.asks))
            assert "away" in picture.panes[state.now.asks.pane].reading
        elif isinstance(state.now.asks, Weight):
            choices = picture.panes[-1].content
            assert {"predicted", "true"} <= set(" ".join(note.text for note in choices.notes).replace(",", "").split())
        else:
            assert any("predicted" in pane.title for pane in picture.panes)
            assert any("true" in pane.title for pane in picture.panes)
        after = st.skip(there, 1)
        assert (after.beat, after.at) == (there.beat, there.at) or after.predicted == ()
        assert st.at_stop(there, st.Stop(state.beat, state.at)).predicted == (guess,)


def test_the_distance_is_that_of_the_engine_in_edges_of_the_control_object():
    state = next(each for each in questions(CUBE) if isinstance(each.now.asks, Where))
    for away in ((0.3, 0.0, 0.0), (0.1, -0.2, 0.2)):
        guess = np.array([2 / 3, -2 / 3, 2 / 3]) + away
        there = answered(asking.predict(state, tuple(guess)))
        expected = np.linalg.norm(away) / 2  # the cube's edges have length 2
        assert asking.distances(there, asking.question(there)) == pytest.approx([expected], abs=1e-12)
        assert compose(there).panes[0].reading == f"prediction {expected:.2f} of an edge away"
    moved = st.drag(there, 5, (3.0, -3.0, 3.0))
    row = moved.now.lead.trace.step(0).stencil(5)
    truth = row.weights @ moved.trace(moved.now.lead).control.points[row.parents]
    (found,) = asking.distances(moved, asking.question(moved)) * asking.edge(moved, asking.question(moved))
    assert found == pytest.approx(float(np.linalg.norm(guess - truth)), abs=1e-12)


def test_predictions_are_painted_over_everything_and_told_by_shape_in_every_theme():
    state = next(each for each in questions(CUBE) if isinstance(each.now.asks, Where))
    state = answered(asking.predict(asking.predict(state, (0.0, 0.0, 0.0)), (0.7, -0.7, 0.7)))
    for theme in THEMES:
        painted = overlay(compose(st.choose(state, theme=theme)), 1280, 720)
        marks = [each for each in painted if isinstance(each, Mark) and each.shape is Shape.AIM]
        assert len(marks) == 3  # and one in the legend
        assert {mark.colour for mark in marks} == {THEMES[theme].guess}
        assert "0.58" in [each.text for each in painted if isinstance(each, Text)]


def test_going_on_without_a_prediction_is_the_lesson_as_it_was():
    state = st.start(CUBE, st.Options(asking=True))
    for stop in st.stops(state.lesson):
        there = st.at_stop(state, stop)
        if not asking.is_open(there):
            plain = compose(st.at_stop(st.start(CUBE), st.Stop(CUBE.beats.index(there.now), stop.at)))
            assert [len(pane.content.markers) for pane in compose(there).panes] == [
                len(pane.content.markers) for pane in plain.panes
            ]


def test_the_switch_keeps_the_place_and_the_same_object_for_the_same_lesson():
    state = st.start(CUBE, st.Options(asking=True))
    assert CUBE.asking(True) is state.lesson
    assert state.lesson.asking(False) is CUBE
    for stop in st.stops(state.lesson):
        there = asking.toggle_asking(st.at_stop(state, stop))
        assert there.lesson is CUBE
        assert st.Stop(there.beat, there.at) in st.stops(CUBE)
        if not asking.is_open(st.at_stop(state, stop)):
            assert asking.toggle_asking(there).now is there.now
    still = show(trace(QUAD_CENTROID, shapes.cube()), None, "A cube.")
    no_questions = Lesson("none", "None", "Test", lambda: iter([still]))
    assert no_questions.asking(True) is no_questions


@each_lesson
def test_a_session_and_a_link_bring_predictions_back(lesson):
    for state in questions(lesson):
        guess = (0.1, -1 / 3, 2e-7) if isinstance(state.now.asks, Where) else 1
        for there in (state, asking.predict(state, guess), answered(asking.predict(state, guess))):
            for back in (restored(kept(there)), followed(link(there))):
                assert (back.lesson, back.beat, back.at, back.predicted) == (
                    there.lesson, there.beat, there.at, there.predicted,
                )  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('"question": true', '"question": 1', "place.question: 1 is not true or false"),
        ('"asking": true', '"asking": false', "place.question: nothing is asked there"),
        ("[[0.5, 0.5, 0.5]]", "[3]", r"predicted\[0\]"),
        ("[0.5, 0.5, 0.5]", ", ".join(["[0.5, 0.5, 0.5]"] * 9), "predicted: a list of 9"),
    ],
)
def test_what_was_predicted_is_read_with_suspicion(old, new, sentence):
    state = next(each for each in questions(CUBE) if isinstance(each.now.asks, Where))
    text = " ".join(kept(asking.predict(state, (0.5, 0.5, 0.5))).split()).replace("[ [", "[[").replace("] ]", "]]")
    assert old in text
    with pytest.raises(KeepingError, match=sentence):
        restored(text.replace(old, new))


def test_a_question_without_exactly_one_true_answer_is_refused():
    told = trace(QUAD_CENTROID, shapes.cube())
    row, still = told.whole.stencil(5), View(told, 3, 3)
    first = told.stages[0]

    def lesson(beat):
        return Lesson("mine", "Mine", "Test", lambda: iter([beat]))

    for beat, sentence in (
        (show(told, None, "A cube.", predict=where(5, "Where?")), "nothing moves there"),
        (play(told, first, "T.", predict=where(26, "Where?")), "there is no point 26 then; ask for one from 0 to 25"),
        (play(told, first, "T.", predict=where(5, "Where?", pane=1)), "nothing moves there"),
        (play(told, first, "T.", predict=which("Which?", still, View(told, 0, 0))), "0 of the answers"),
        (play(told, first, "T.", predict=which("Which?", *at_rest(told, (1, ""), (1, "")))), "2 of the answers"),
        (play(told, first, "T.", predict=which("Which?", *at_rest(told, (1, "")))), "give two to 4"),
        (show(told, None, "A.", predict=Weight("?", row, 5, (row.weight(0), row.weight(4)))), "0 of the answers"),
    ):
        with pytest.raises(ValueError, match=sentence):
            st.start(lesson(beat), st.Options(asking=True))
    assert weight(row, 5, "How much?").answers.count(row.weight(5)) == 1


def test_a_lesson_of_ones_own_that_asks_wrongly_is_named_at_its_line(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(
        """from lessons.questions import where
from lessons.script import lesson, play, show
from subdivision import shapes, trace
from subdivision.schemes import LOOP


@lesson("Mine", section="My lessons")
def mine():
    told = trace(LOOP, shapes.octahedron())
    yield play(told, told.stages[0], "Topology.", predict=where(0, "Where will it go?"))
    yield show(told, told.stages[0], "A still.", predict=where(0, "Where will it go?"))
"""
    )
    fault = tried(path).fault
    assert fault is not None
    assert fault.line == 11
    assert "nothing moves there" in fault.what

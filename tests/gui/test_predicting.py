"""Predictions with the real window: asked, said, shown beside the truth; and a clicker that is never held up."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

import lessons
from app import asking
from app.draw.picture import Diagram
from app.gui.narration import ANSWER_HINT, WHERE_HINT
from app.gui.presenter import noted
from app.sessions.link import followed, link
from app.state import Stop, choose, drag, open_lesson, stops, turn_view
from lessons.turn import Turn

pytestmark = pytest.mark.window
Key = Qt.Key


@pytest.fixture
def cube(qtbot, window):
    """Figure 14 at its first stop, with its questions."""
    window.session.do(choose, speed=8.0, asking=True)
    window.session.do(open_lesson, lessons.find("14"))
    qtbot.wait(50)
    return window


def press(window, key):
    QTest.keyClick(QApplication.activeWindow() or window, key)


def onward(qtbot, window, times=1):
    for _ in range(times):
        press(window, Key.Key_PageDown)
        qtbot.waitUntil(lambda: not window.session.state.is_playing, timeout=5000)


def click(window, x, y):
    QTest.mouseClick(window.viewport.canvas, Qt.MouseButton.LeftButton, pos=QPoint(round(x), round(y)))


def seen(window, place, pane=0):
    """Where a place of space is in the window."""
    camera, (x, y, wide, tall) = window.viewport.cameras()[pane], window.viewport.areas()[pane]
    flat = camera.project(np.asarray(place, dtype=float), wide, tall)[0]
    return QPointF(x + flat[0], y + flat[1])


def words(window):
    return [label.text for label in window.viewport.picture().scenes[0].labels]


def test_clicks_are_predictions_and_the_truth_comes_beside_them_with_the_distance(qtbot, cube):
    onward(qtbot, cube, 4)
    state = cube.session.state
    assert "Where will it go?" in state.now.text
    assert cube.viewport.narration._hint(state) == WHERE_HINT
    assert words(cube) == ["?"]
    truth = asking.place(state, state.now.asks)
    there = seen(cube, truth)
    click(cube, there.x(), there.y())
    click(cube, there.x() + 60, there.y())
    assert len(cube.viewport.picture().scenes[0].pins) == 2
    onward(qtbot, cube)
    state = cube.session.state
    near, far = asking.distances(state, asking.question(state))
    assert near < 0.01  # the click was at a whole pixel
    assert far > 10 * near
    assert words(cube) == [f"{near:.2f}", f"{far:.2f}"]
    assert f"nearest of 2 predictions {near:.2f} of an edge away" in cube.viewport.picture().panes[0].reading
    assert "prediction" in {entry.text for entry in cube.viewport.picture().legend}
    cube.session.do(drag, 5, (2.0, -2.0, 2.0))
    assert asking.distances(cube.session.state, asking.question(cube.session.state))[0] > near
    onward(qtbot, cube)
    assert cube.session.state.predicted == ()


def test_backspace_and_undo_take_predictions_back_and_the_ninth_replaces_the_first(qtbot, cube):
    onward(qtbot, cube, 4)
    for k in range(asking.MOST + 1):
        click(cube, 300 + 20 * k, 200)
    assert len(cube.session.state.predicted) == asking.MOST
    last = cube.session.state.predicted[-1]
    press(cube, Key.Key_Backspace)
    assert len(cube.session.state.predicted) == asking.MOST - 1
    cube.session.undo()
    assert cube.session.state.predicted[-1] == last
    while cube.session.state.predicted:
        press(cube, Key.Key_Backspace)
    press(cube, Key.Key_Backspace)
    assert asking.is_open(cube.session.state)


def test_two_clicks_in_a_row_are_two_predictions_and_leave_the_view(qtbot, cube):
    onward(qtbot, cube, 4)
    cube.session.do(turn_view, Turn(around=0.2))
    click(cube, 300, 200)
    QTest.mouseDClick(cube.viewport.canvas, Qt.MouseButton.LeftButton, pos=QPoint(300, 200))
    QTest.mouseRelease(cube.viewport.canvas, Qt.MouseButton.LeftButton, pos=QPoint(300, 200))
    assert len(cube.session.state.predicted) == 2
    assert cube.session.state.turn == Turn(around=0.2)


def test_an_answer_is_chosen_by_its_key_or_its_box_and_stays_beside_the_true_one(qtbot, cube):
    onward(qtbot, cube, 6)
    state = cube.session.state
    assert cube.viewport.narration._hint(state) == ANSWER_HINT
    across = state.options.across
    press(cube, Key.Key_3)
    assert cube.session.state.predicted == (2,)
    press(cube, Key.Key_3)
    assert cube.session.state.predicted == ()
    assert cube.session.state.options.across == across
    (x, y, wide, tall) = cube.viewport.areas()[-1]
    for down in np.linspace(y, y + tall, 40):
        click(cube, x + 0.4 * wide, down)
        if cube.session.state.predicted:
            break
    assert cube.session.state.predicted == (0,)
    onward(qtbot, cube)
    pane = cube.viewport.picture().panes[-1].content
    assert isinstance(pane, Diagram)
    assert [note.text for note in pane.notes][-2:] == ["predicted", "true"]
    assert pane.boxes[2].texts == ("9/16",)
    press(cube, Key.Key_1)
    assert cube.session.state.options.across == "stage"


def test_a_picture_is_chosen_by_a_click_and_framed(qtbot, cube):
    onward(qtbot, cube)
    x, y, wide, tall = cube.viewport.areas()[2]
    click(cube, x + wide / 2, y + tall / 2)
    framed = [pane.frame is not None for pane in cube.viewport.picture().panes]
    assert framed == [False, False, True]
    onward(qtbot, cube)
    beside = [(pane.title, pane.frame is not None) for pane in cube.viewport.picture().panes[1:]]
    assert beside == [("3: predicted", True), ("2: true", False)]
    view, spots = cube.viewport, []
    for k, (pane, area) in enumerate(zip(view.picture().panes, view.areas(), strict=True)):
        (x, y), *_ = view.cameras()[k].project(pane.content.markers[0].points, *area[2:])[:, :2] + area[:2]
        spots.append(view.spot_at(QPointF(x, y)))
    assert spots[0] is not None
    assert spots[1:] == [None, None]


@pytest.mark.parametrize("key", [Key.Key_PageDown, Key.Key_Right, Key.Key_Space])
def test_a_clicker_alone_goes_through_all_questions_while_presenting(qtbot, cube, key):
    press(cube, Key.Key_F5)
    visited = []
    for _ in stops(cube.session.state.lesson):
        state = cube.session.state
        visited.append(Stop(state.beat, state.at))
        press(cube, key)
        qtbot.waitUntil(lambda: not cube.session.state.is_playing, timeout=5000)
    assert tuple(visited) == stops(lessons.find("14").asking(True))


def test_the_switch_takes_the_questions_away_and_is_remembered(qtbot, cube):
    onward(qtbot, cube, 4)
    assert asking.is_open(cube.session.state)
    press(cube, Key.Key_F6)
    state = cube.session.state
    assert not asking.is_open(state)
    assert state.lesson is lessons.find("14")
    assert (state.beat, state.at) == (2, 2.0)
    assert cube.settings.value("asking") == "off"
    onward(qtbot, cube)
    press(cube, Key.Key_F6)
    assert cube.session.state.now.text == state.lesson.beats[3].text
    assert cube.settings.value("asking") == "on"


def test_a_prediction_comes_back_from_a_link(qtbot, cube):
    onward(qtbot, cube, 4)
    click(cube, 300, 200)
    state = cube.session.state
    there = followed(link(state))
    assert there.predicted == state.predicted
    assert (there.lesson, there.beat, there.at) == (state.lesson, state.beat, state.at)


def test_only_the_lecturer_reads_the_answer(qtbot, cube):
    onward(qtbot, cube, 6)
    state = cube.session.state
    assert "9/16" in noted(state)
    assert "Predictions: 0." in noted(state)
    assert "9/16" not in cube.notes.words.text()
    assert "9/16" not in cube.why._words.text()
    corner = seen(cube, state.now.lead.trace.points[3][5])
    assert cube.viewport.spot_at(corner) is None

"""Control points in the hand: dragged, held to an axis, put back, undone; everything downstream follows."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.state import choose, last
from subdivision import Mesh

pytestmark = pytest.mark.window
VERTEX = 5


def seen(window, vertex):
    """Where a control point is on the viewport."""
    viewport = window.viewport
    trace = window.session.state.trace(window.session.state.now.lead)
    x, y, w, h = viewport.areas()[0]
    flat = viewport.cameras()[0].project(trace.control.points[vertex], w, h)[0]
    return QPoint(round(x + flat[0]), round(y + flat[1]))


def send(window, kind, at, buttons):
    plotter = window.viewport.canvas
    button = Qt.MouseButton.NoButton if kind == QEvent.Type.MouseMove else Qt.MouseButton.LeftButton
    where = QPointF(at)
    event = QMouseEvent(kind, where, plotter.mapToGlobal(where), button, buttons, Qt.KeyboardModifier.NoModifier)
    QApplication.sendEvent(plotter, event)


def dragged(window, qtbot, by, key=None):
    """Take the control point, hold a key, move, let go."""
    here, held = seen(window, VERTEX), Qt.MouseButton.LeftButton
    send(window, QEvent.Type.MouseButtonPress, here, held)
    if key:
        none = Qt.KeyboardModifier.NoModifier
        QApplication.sendEvent(window.viewport.canvas, QKeyEvent(QEvent.Type.KeyPress, key, none))
    for part in (0.3, 0.6, 1.0):
        send(window, QEvent.Type.MouseMove, here + QPoint(*(round(part * b) for b in by)), held)
        qtbot.wait(5)
    send(window, QEvent.Type.MouseButtonRelease, here + QPoint(*by), Qt.MouseButton.NoButton)
    if key:
        QApplication.sendEvent(window.viewport.canvas, QKeyEvent(QEvent.Type.KeyRelease, key, none))


@pytest.fixture
def cube(window):
    """The hand-made cube after two levels, its control points shown."""
    window.session.do(choose, control=True)
    window.session.do(last)
    return window


def test_a_dragged_control_point_stays_under_the_mouse_and_all_levels_follow_exactly(cube, qtbot):
    before, here = cube.session.state, seen(cube, VERTEX)
    dragged(cube, qtbot, (60, -40))
    trace = cube.session.state.trace(cube.session.state.now.lead)
    assert (seen(cube, VERTEX) - (here + QPoint(60, -40))).manhattanLength() <= 2
    afresh = trace.with_control(Mesh(trace.control.topology, trace.control.points))
    assert max(np.abs(a - b).max() for a, b in zip(trace.points, afresh.points, strict=True)) < 1e-12
    assert np.abs(trace.points[-1] - before.trace(before.now.lead).points[-1]).max() > 0.1
    shown = cube.viewport._picture.scenes[0].faces[0].points
    assert np.array_equal(shown, trace.points[-1][: len(shown)])


def test_one_drag_is_one_undo(cube, qtbot):
    dragged(cube, qtbot, (60, -40))
    assert cube.session.state.edits
    cube.session.undo()
    assert cube.session.state.edits == ()
    cube.session.redo()
    assert cube.session.state.edits


@pytest.mark.parametrize(("key", "axis"), [(Qt.Key.Key_X, 0), (Qt.Key.Key_Y, 1), (Qt.Key.Key_Z, 2)])
def test_a_drag_with_a_letter_held_stays_on_that_axis(cube, qtbot, key, axis):
    start = cube.session.state.now.lead.trace.control.points[VERTEX]
    dragged(cube, qtbot, (50, -45), key)
    (vertex, to), = cube.session.state.edits
    moved = np.array(to) - start
    assert vertex == VERTEX
    assert abs(moved[axis]) > 0.05
    assert np.abs(np.delete(moved, axis)).max() < 1e-12


def test_a_double_click_puts_the_point_back(cube, qtbot):
    dragged(cube, qtbot, (60, -40))
    QTest.mouseDClick(cube.viewport.canvas, Qt.MouseButton.LeftButton, pos=seen(cube, VERTEX))
    assert cube.session.state.edits == ()


def test_the_keys_1_to_4_read_the_point_across_a_stage_a_step_all_levels_or_to_the_limit(cube, qtbot):
    QTest.mouseClick(cube.viewport.canvas, Qt.MouseButton.LeftButton, pos=seen(cube, VERTEX))
    said = []
    keys = (Qt.Key.Key_1, Qt.Key.Key_2, Qt.Key.Key_3, Qt.Key.Key_4)
    for key, across in zip(keys, cube.why.across.buttons, strict=True):
        QTest.keyClick(cube.windowHandle(), key)
        assert cube.session.state.options.across == across
        assert cube.why.across.buttons[across].isChecked()
        said.append(cube.why._words.text())
    assert "given, not made" in said[2]
    assert "12/27" in said[3]


def test_typed_coordinates_move_the_control_point_and_leave_the_others_exact(cube, qtbot):
    QTest.mouseClick(cube.viewport.canvas, Qt.MouseButton.LeftButton, pos=seen(cube, VERTEX))
    assert cube.why.place.isVisible()
    box = cube.why.place.boxes[2]
    box.setFocus()
    box.selectAll()
    QTest.keyClicks(box, "2.5")
    QTest.keyClick(box, Qt.Key.Key_Return)
    (vertex, to), = cube.session.state.edits
    start = cube.session.state.now.lead.trace.control.points[VERTEX]
    assert vertex == VERTEX
    assert to == (start[0], start[1], 2.5)
    cube.session.undo()
    assert cube.session.state.edits == ()

"""Presenting: what the lecturer points and looks with, apart from the lesson, which it never changes."""

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.gui.pointer import LIGHT

pytestmark = pytest.mark.window
Key = Qt.Key


def move(window, x, y):
    """The mouse, without a button, over the picture."""
    plotter, none = window.viewport._plotter, Qt.MouseButton.NoButton
    at = QPointF(x, y)
    event = QMouseEvent(QEvent.Type.MouseMove, at, plotter.mapToGlobal(at), none, none, Qt.KeyboardModifier.NoModifier)
    QApplication.sendEvent(plotter, event)


def press(window, key):
    QTest.keyClick(QApplication.activeWindow() or window, key)


def is_hidden(window):
    return window.viewport.cursor().shape() == Qt.CursorShape.BlankCursor


# -- the pointer ------------------------------------------------------------------------------


def test_a_pointer_that_rests_is_hidden_while_presenting_and_comes_back_when_it_moves(qtbot, window):
    press(window, Key.Key_F5)
    move(window, 300, 200)
    assert not is_hidden(window)
    qtbot.wait(1500)
    assert not is_hidden(window)
    qtbot.waitUntil(lambda: is_hidden(window), timeout=1000)
    move(window, 310, 200)
    assert not is_hidden(window)
    qtbot.waitUntil(lambda: is_hidden(window), timeout=2500)
    press(window, Key.Key_Escape)
    assert not is_hidden(window)
    qtbot.wait(2200)
    assert not is_hidden(window)


def reddish(window, x, y):
    """How near the picture is to the colour of the light."""
    seen = window.viewport.grab().toImage().pixelColor(x, y)
    return abs(seen.red() - LIGHT.red()) + abs(seen.green() - LIGHT.green()) + abs(seen.blue() - LIGHT.blue())


@pytest.mark.parametrize("presents", [False, True])
def test_the_light_follows_the_mouse_and_leaves_no_trace(qtbot, window, presents):
    if presents:
        press(window, Key.Key_F5)
        qtbot.wait(100)
    state, picture = window.session.state, window.viewport._picture
    press(window, Key.Key_F2)
    for x in range(60, 121, 10):
        move(window, x, 80)
    assert reddish(window, 120, 80) < 40
    assert window.viewport.pointer._trail
    assert is_hidden(window)
    qtbot.waitUntil(lambda: not window.viewport.pointer._trail, timeout=1000)
    assert reddish(window, 80, 80) > 200
    assert reddish(window, 120, 80) < 40
    QApplication.sendEvent(window.viewport._plotter, QEvent(QEvent.Type.Leave))
    assert reddish(window, 120, 80) > 200
    press(window, Key.Key_F2)
    move(window, 120, 80)
    assert reddish(window, 120, 80) > 200
    assert not is_hidden(window)
    assert (window.session.state, window.viewport._picture) == (state, picture)


class Calm:
    """A style that animates nothing."""

    def styleHint(self, *_):
        return 0


def test_where_motion_is_not_wanted_the_light_has_no_trail(window, monkeypatch):
    monkeypatch.setattr(window.viewport.pointer, "style", Calm)
    press(window, Key.Key_F2)
    move(window, 60, 80)
    move(window, 120, 80)
    assert not window.viewport.pointer._trail
    assert reddish(window, 120, 80) < 40

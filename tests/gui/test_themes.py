"""What suits the eyes of who looks: themes and reduced motion, chosen in the real window."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.draw.theme import THEMES
from app.gui.look import colour, system_theme
from app.state import last, seek, segments, tick, toggle_play

pytestmark = pytest.mark.window
CTRL = Qt.KeyboardModifier.ControlModifier


def press(window, key, modifiers):
    QTest.keyClick(window.windowHandle(), key, modifiers)


def surfaces(window):
    return [faces.points for faces in window.viewport.picture().panes[0].content.faces]


def in_view_menu(window, id_):
    """Whether a command stands in the menu View."""
    menus = {action.text(): action.menu() for action in window.menuBar().actions()}
    return window.actions_by_id[id_] in menus["&View"].actions()


@pytest.mark.parametrize("name", THEMES)
def test_a_theme_dresses_picture_and_window(qtbot, window, name):
    window.actions_by_id[f"theme_{name}"].trigger()
    qtbot.waitUntil(lambda: not window.is_changing)
    assert window.viewport.picture().background == THEMES[name].background
    assert QApplication.palette().windowText().color() == colour(THEMES[name].ink)
    assert window.settings.value("theme") == name
    window.actions_by_id["theme_system"].trigger()
    assert window.session.state.options.theme == system_theme()


def test_with_reduced_motion_stages_fade(window):
    assert in_view_menu(window, "reduced_motion")
    assert not window.actions_by_id["reduced_motion"].isChecked()
    stage = next(s for s in segments(window.session.state.lesson) if s.stop == 3 > s.start)
    window.session.do(seek, stage.begin)
    before = surfaces(window)
    window.session.do(seek, stage.end)
    after = surfaces(window)
    press(window, Qt.Key.Key_M, CTRL)
    assert window.actions_by_id["reduced_motion"].isChecked()
    window.session.do(seek, 0.6 * stage.begin + 0.4 * stage.end)
    assert all(np.array_equal(a, b) for a, b in zip(surfaces(window), [*before, *after], strict=True))
    press(window, Qt.Key.Key_M, CTRL)
    window.session.do(seek, 0.6 * stage.begin + 0.4 * stage.end)
    (moving,) = surfaces(window)
    assert not np.array_equal(moving, before[0])
    assert not np.array_equal(moving, after[0])


def test_with_reduced_motion_a_lesson_plays_to_its_end(window):
    press(window, Qt.Key.Key_M, CTRL)
    window.session.do(toggle_play)
    for _ in range(60):
        window.session.do(tick, 0.3)
        if not window.session.state.is_playing:
            window.session.do(toggle_play)
        if window.session.state.beat == last(window.session.state).beat:
            break
    assert window.session.state.beat == last(window.session.state).beat


def test_reduced_motion_is_remembered(window):
    press(window, Qt.Key.Key_M, CTRL)
    assert window.settings.value("reduced_motion") == "on"
    assert window.session.state.options.reduced_motion
    press(window, Qt.Key.Key_M, CTRL)
    assert window.settings.value("reduced_motion") == "off"

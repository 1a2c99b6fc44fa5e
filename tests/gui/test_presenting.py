"""Presenting: what the lecturer points and looks with, apart from the lesson, which it never changes."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QGuiApplication, QImage, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

import lessons
from app.draw import raster
from app.draw.compose import compose
from app.gui import presenter as presenting
from app.gui import window as windows
from app.gui.pointer import LIGHT
from app.gui.presenter import spoken_time
from app.state import choose, first, last, onward, open_lesson, settle, skip

pytestmark = pytest.mark.window
Key = Qt.Key


def move(window, x, y):
    """The mouse, without a button, over the picture."""
    plotter, none = window.viewport.canvas, Qt.MouseButton.NoButton
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
    QApplication.sendEvent(window.viewport.canvas, QEvent(QEvent.Type.Leave))
    assert reddish(window, 120, 80) > 200
    press(window, Key.Key_F2)
    move(window, 120, 80)
    assert reddish(window, 120, 80) > 200
    assert not is_hidden(window)
    assert (window.session.state, window.viewport._picture) == (state, picture)


def test_where_motion_is_not_wanted_the_light_has_no_trail(window):
    window.session.do(choose, reduced_motion=True)
    press(window, Key.Key_F2)
    move(window, 60, 80)
    move(window, 120, 80)
    assert not window.viewport.pointer._trail
    assert reddish(window, 120, 80) < 40


# -- the magnifier ----------------------------------------------------------------------------


def pixels(window):
    """(rows, columns, 3): what the viewport shows above its caption, once it has come to rest."""
    image = window.viewport.grab().toImage().convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    tall = window.viewport.narration.y()
    return rows[:tall, : 3 * image.width()].reshape(tall, image.width(), 3).astype(int)


def unlike(large, small, x, y):
    """The part of places, two pixels apart, where ``large`` is not ``small`` magnified about a place."""
    down, right = np.mgrid[2 : large.shape[0] - 2 : 2, 2 : large.shape[1] - 2 : 2]
    expected = small[(y + (down - y) / 2).astype(int), (x + (right - x) / 2).astype(int)]
    return float(np.mean(np.abs(large[down, right] - expected).max(axis=2) > 60))


@pytest.mark.parametrize("id_", ["figure_14_cube", "figure_10_same_cost", "figure_03_t_split", "cube"])
@pytest.mark.parametrize("place", [(0.3, 0.4), (0.9, 0.1)])
def test_the_magnifier_shows_panes_and_flat_parts_twice_as_large_about_the_mouse(qtbot, window, id_, place):
    if id_ != "cube":
        window.session.do(open_lesson, lessons.find(id_))
    window.session.do(last)
    window.viewport.narration.hide()
    qtbot.wait(1000)  # until it is smooth
    small = pixels(window)
    x, y = round(place[0] * small.shape[1]), round(place[1] * small.shape[0])
    move(window, 5, 5)
    press(window, Key.Key_F3)
    move(window, x, y)
    qtbot.wait(1000)
    assert unlike(pixels(window), small, x, y) < 0.03
    assert unlike(small, small, x, y) > 0.03
    press(window, Key.Key_Escape)
    assert not window.viewport.is_magnified
    qtbot.waitUntil(lambda: window.viewport.samples == 1)
    qtbot.waitUntil(lambda: window.viewport.samples > 1)
    assert np.mean(np.abs(pixels(window) - small).max(axis=2) > 60) < 0.001


# -- the presenter's window -------------------------------------------------------------------


@pytest.fixture
def presenter(qtbot, window):
    """The presenter's window, open beside the window."""
    window.session.do(choose, speed=8.0)
    press(window, Key.Key_F4)
    qtbot.waitExposed(window.presenter)
    return window.presenter


def test_the_presenter_reads_the_caption_the_notes_and_what_comes_next(window, presenter):
    window.session.do(open_lesson, lessons.find("figure_14_cube"))
    told = window.session.state.lesson
    assert presenter.lesson.text() == told.title
    assert presenter.caption.text() == told.beats[0].text
    assert told.beats[0].notes in presenter.notes.text()
    assert presenter.step.text().startswith("Step 1 of ")
    ahead = presenter.following.text()
    window.session.do(skip, 1)
    assert ahead.endswith(presenter.caption.text())
    assert presenter.step.text().startswith("Step 2 of ")
    window.session.do(last)
    assert presenter.following.text() == "The lesson ends here. Next: " + lessons.find("figure_15_plus_sign").title
    _, now, _, total = presenter.step.text().split()
    assert now == total


def small(state, size):
    return raster.image(compose(state), size.width(), size.height(), words=False, flat=True)


@pytest.mark.parametrize("here", [first, last])
@pytest.mark.parametrize("options", [{}, {"theme": "dark", "as_caption": True, "asking": True}])
def test_the_small_picture_is_of_just_what_comes_next(qtbot, window, presenter, here, options):
    window.session.do(choose, **options)
    window.session.do(open_lesson, lessons.find("figure_14_cube"))
    window.session.do(here)
    preview = presenter.preview
    qtbot.waitUntil(lambda: preview.image is not None, timeout=20_000)
    image = preview.image.convertToFormat(QImage.Format.Format_RGBA8888)
    told = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.width(), 4)
    before = small(window.session.state, image.size())
    window.session.do(onward)
    window.session.do(settle)
    assert np.array_equal(told, small(window.session.state, image.size()))
    assert not np.array_equal(told, before)


def test_all_keys_work_in_the_presenters_window(qtbot, window, presenter):
    presenter.activateWindow()
    qtbot.waitUntil(presenter.isActiveWindow, timeout=3000)
    QTest.keyClick(presenter, Key.Key_PageDown)
    qtbot.waitUntil(lambda: window.session.state.at == 1 and not window.session.state.is_playing, timeout=3000)
    assert presenter.step.text() == f"Step {presenting.step_of(window.session.state)[0]} of 8"
    QTest.keyClick(presenter, Key.Key_Period)
    assert window.session.state.options.blank
    QTest.keyClick(presenter, Key.Key_Escape)
    assert not window.session.state.options.blank
    QTest.keyClick(presenter, Key.Key_Escape)
    assert not presenter.isVisible()
    assert window.isVisible()


def test_the_time_that_has_passed_starts_again(qtbot, presenter):
    qtbot.waitUntil(lambda: presenter.elapsed.text() == "0:01", timeout=3000)
    presenter.again.click()
    assert presenter.elapsed.text() == "0:00"
    assert ":" in presenter.clock.text()
    assert [spoken_time(s) for s in (9, 75, 3599, 3600, 7325)] == ["0:09", "1:15", "59:59", "1:00:00", "2:02:05"]


@pytest.mark.parametrize("has_second", [False, True])
def test_presenting_opens_it_on_a_second_screen_and_leaving_closes_it(window, monkeypatch, has_second):
    other = QGuiApplication.primaryScreen() if has_second else None
    for module in (presenting, windows):
        monkeypatch.setattr(module, "spare_screen", lambda _: other)
    press(window, Key.Key_F5)
    assert window.presenter.isVisible() == has_second
    press(window, Key.Key_F5)
    assert not window.presenter.isVisible()


def test_it_closes_with_the_window(window, presenter):
    window.close()
    assert not presenter.isVisible()

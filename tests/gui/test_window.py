"""Journeys through the real window, by the keys and the mouse that users have."""

import gc
import threading
from dataclasses import fields, replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QImage, QKeySequence, QOpenGLContext, QSurface
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.draw.samples import PLACES
from app.draw.theme import THEMES
from app.gui.keys import COMMANDS, spelled_keys
from app.gui.session import Session
from app.gui.sheets import rows
from app.gui.window import Window
from app.state import (
    axis_of,
    choose,
    first,
    forward,
    last,
    open_lesson,
    seek,
    segments,
    start,
    stops,
    toggle,
    turn_view,
)
from lessons import all_lessons
from subdivision import shapes

pytestmark = pytest.mark.window
Key = Qt.Key
FILES = {
    "good": "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 1\nf 1 2 3 4\nf 2 5 6 3\n",
    "broken": "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n",
}


def press(window, key, modifiers=Qt.KeyboardModifier.NoModifier):
    """A key as the keyboard sends it: to whatever has the focus."""
    QTest.keyClick(window.windowHandle(), key, modifiers)


def place(state):
    return state.beat, state.at


def values(state):
    return {f.name: getattr(state, f.name) for f in fields(state)}


def focus(window, where):
    target = {"viewport": window.viewport.canvas, "list": window.contents.list, "search": window.contents.search}[
        where
    ]
    target.setFocus()
    assert QApplication.focusWidget() is target
    return target


def rested(qtbot, window):
    qtbot.waitUntil(lambda: not window.session.state.is_playing, timeout=5000)
    return place(window.session.state)


@pytest.mark.parametrize("where", ["viewport", "list", "search"])
def test_a_clicker_plays_every_stage_there_and_back_wherever_the_focus_is(qtbot, window, lesson, where):
    window.session.do(choose, speed=8.0)
    focus(window, where)
    expected = [(s.beat, s.at) for s in stops(lesson)]
    there, back = [place(window.session.state)], []
    for _ in expected[1:]:
        press(window, Key.Key_PageDown)
        there.append(rested(qtbot, window))
    for _ in expected:
        back.insert(0, place(window.session.state))
        press(window, Key.Key_PageUp)
        rested(qtbot, window)
    assert there == expected
    assert back == expected
    assert QApplication.focusWidget() is focus(window, where)


@pytest.mark.parametrize("where", ["viewport", "list"])
def test_every_key_of_the_table_reaches_its_command_wherever_the_focus_is(window, where):
    reached = []
    for command in COMMANDS:
        action = window.actions_by_id[command.id]
        action.triggered.disconnect()
        action.triggered.connect(lambda _=False, id_=command.id: reached.append(id_))
    wanted = []
    for command in COMMANDS:
        for key in command.keys:
            if where == "list" and key in ("Up", "Down"):
                continue  # a list keeps these
            focus(window, where)
            chord = QKeySequence(key)[0]
            for other in COMMANDS:  # a key may do one thing at one time and another at another
                window.actions_by_id[other.id].setEnabled(other is command or key not in other.keys)
            press(window, chord.key(), chord.keyboardModifiers())
            wanted.append(command.id)
    assert reached == wanted


def test_the_search_box_keeps_what_is_typed_and_lets_the_clicker_through(qtbot, window, lesson):
    window.find_lesson()
    QTest.keyClicks(window.contents.search, "gh 3.b?")
    assert window.contents.search.text() == "gh 3.b?"
    assert window.session.state.options.ghost
    assert not window.session.state.options.blank
    press(window, Key.Key_PageDown)
    assert window.session.state.is_playing
    press(window, Key.Key_Escape)
    assert window.contents.search.text() == ""


def test_no_vtk_hot_key_fires(qtbot, window):
    widget = focus(window, "viewport")
    renderers = list(window.viewport._plotter.renderers)
    before = [window.viewport.cameras()[0].position.copy(), [r.GetActiveCamera().GetPosition() for r in renderers]]
    for key in "weqrp3fscbvjtuam+-":
        QTest.keyClicks(widget, key)
    for each in window.viewport._painters:
        for actor in each.renderer.actors.values():
            assert actor.GetProperty().GetRepresentation() == 2
    assert window.isVisible()
    assert np.allclose(window.viewport.cameras()[0].position, before[0])
    assert [r.GetActiveCamera().GetPosition() for r in renderers] == before[1]


def test_scrubbing_follows_the_mouse_and_is_one_change_to_undo(qtbot, window, lesson):
    track = window.timeline._track
    before = values(window.session.state)
    end = segments(lesson)[-1].end
    middle = track.height() // 2
    QTest.mousePress(track, Qt.MouseButton.LeftButton, pos=QPoint(int(track._x(0.7)), middle))
    for axis in (1.0, 2.3, 3.37):
        QTest.mouseMove(track, QPoint(round(track._x(axis)), middle))
    QTest.mouseRelease(track, Qt.MouseButton.LeftButton, pos=QPoint(round(track._x(3.37)), middle))
    assert axis_of(window.session.state) == pytest.approx(3.37, abs=end / track.width())
    window.session.undo()
    assert values(window.session.state) == before
    assert not window.session.can_undo


def test_undo_and_redo_restore_equal_states(qtbot, window, lesson):
    window.session.do(choose, speed=8.0)
    seen = [values(window.session.state)]
    press(window, Key.Key_PageDown)
    rested(qtbot, window)
    seen.append(values(window.session.state))
    press(window, Key.Key_G)
    seen.append(values(window.session.state))
    press(window, Key.Key_End)
    seen.append(values(window.session.state))
    for state in reversed(seen[:-1]):
        press(window, Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
        assert values(window.session.state) == state
    for state in seen[1:]:
        press(window, Key.Key_Z, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier)
        assert values(window.session.state) == state


def test_pausing_is_no_change_to_undo(window, lesson):
    before = values(window.session.state)
    press(window, Key.Key_Space)
    press(window, Key.Key_Space)
    assert not window.session.state.is_playing
    press(window, Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert values(window.session.state) == before


def test_a_broken_file_is_a_sentence_in_the_window_and_nothing_is_lost(qtbot, window, tmp_path):
    path = tmp_path / "broken.obj"
    path.write_text(FILES["broken"])
    before = values(window.session.state)
    window.open_file(str(path))
    qtbot.waitUntil(lambda: window.banner.isVisible(), timeout=5000)
    assert "broken.obj" in window.banner.words.text()
    assert "line 4" in window.banner.words.text()
    assert values(window.session.state) == before
    assert QApplication.activeModalWidget() is None
    press(window, Key.Key_Escape)
    assert not window.banner.isVisible()


def test_a_good_file_plays_its_stages(qtbot, window, tmp_path):
    path = tmp_path / "good.obj"
    path.write_text(FILES["good"])
    window.open_file(str(path))
    qtbot.waitUntil(lambda: window.session.state.lesson.title == "Good", timeout=5000)
    window.session.do(choose, speed=8.0)
    names = []
    for _ in range(6):
        press(window, Key.Key_PageDown)
        rested(qtbot, window)
        names.append(window.session.state.now.lead.trace.stages[int(window.session.state.at) - 1].name)
    assert names == ["topology", "centroids", "geometry"] * 2
    assert window.session.state.now.lead.trace.topology_at(6).n_faces == 2 * 16


def test_presenting_and_leaving_it_changes_nothing(qtbot, window):
    window.session.do(forward)
    rested(qtbot, window)
    before, parts = values(window.session.state), layout(window)
    press(window, Key.Key_F5)
    assert window.isFullScreen()
    assert not any(part.isVisible() for part in (window.contents, window.timeline, window.menuBar()))
    assert window.viewport.size() == window.centralWidget().size()
    assert window.viewport.narration._size(window.session.state, window.height()) >= window.height() / 36
    press(window, Key.Key_Escape)
    qtbot.waitUntil(lambda: layout(window) == parts, timeout=3000)
    assert values(window.session.state) == before


def layout(window):
    shown = [w.isVisible() for w in (*window._sides.values(), window.timeline, window.menuBar())]
    return shown, window.windowState(), window._splitter.sizes(), window.size()


def test_blank_paints_black_and_the_next_press_shows_the_picture_again(qtbot, window):
    press(window, Key.Key_Period)
    assert window.viewport.grab().toImage().pixelColor(200, 200).name() == "#000000"
    press(window, Key.Key_Period)
    assert window.viewport.grab().toImage().pixelColor(5, 200).name() != "#000000"


def test_the_sheet_of_keys_lists_every_key_that_works(window):
    press(window, Key.Key_Question)
    assert window.sheets[0].isVisible()
    listed = {key for group in rows().values() for _, keys in group for key in keys}
    assert {key for c in COMMANDS for key in spelled_keys(c)} <= listed
    bound = {s.toString() for a in window.actions_by_id.values() for s in a.shortcuts()}
    assert bound == {QKeySequence(key).toString() for c in COMMANDS for key in c.keys}
    press(window, Key.Key_Escape)
    assert not window.sheets[0].isVisible()


def test_every_menu_entry_does_something(window):
    entries = [a for m in window.menuBar().actions() for a in m.menu().actions() if not a.isSeparator()]
    commands = set(window.actions_by_id.values())
    assert entries
    assert all(entry.menu() is not None or entry in commands for entry in entries)


def test_pointing_at_a_vertex_tells_how_it_is_made(qtbot, window):
    window.session.do(choose, speed=8.0)
    for _ in range(3):
        press(window, Key.Key_PageDown)
        rested(qtbot, window)
    camera, area = window.viewport.cameras()[0], window.viewport.areas()[0]
    corner = window.session.state.now.lead.trace.points[3][7]
    x, y, _ = camera.project(corner, area[2], area[3])[0]
    at = QPoint(round(area[0] + x), round(area[1] + y))
    QTest.mouseMove(window.viewport.canvas, at)
    qtbot.waitUntil(lambda: window.session.state.focus is not None)
    assert window.session.state.focus.point == 7
    words = window.why._words.text()
    assert "27/48" in words
    assert "6/48" in words
    QTest.mouseMove(window.viewport.canvas, QPoint(5, 5))
    qtbot.waitUntil(lambda: window.session.state.focus is None)
    assert "Point at a vertex" in window.why._words.text()


def test_where_points_are_on_their_way_the_hand_turns_the_view(window):
    window.session.do(seek, 1.0)
    state, view = window.session.state, window.viewport
    assert state.at == 0.5
    camera, area = view.cameras()[0], view.areas()[0]
    for x, y, _ in camera.project(state.now.lead.trace.frame(state.at).points, area[2], area[3]):
        turn, at = window.session.state.turn, QPoint(round(area[0] + x), round(area[1] + y))
        drag(view.canvas, at, at + QPoint(20, 10))
        assert window.session.state.turn != turn
        window.session.do(turn_view, turn)
    assert window.session.state.edits == ()
    assert window.session.state.focus is None


def test_dragging_turns_space_and_pans_the_plane_and_a_double_click_undoes_it(window):
    widget = window.viewport.canvas
    before = window.viewport.cameras()[0]
    drag(widget, QPoint(100, 300), QPoint(180, 330))
    turned = window.viewport.cameras()[0]
    assert not np.allclose(turned.position, before.position)
    assert np.allclose(turned.focal, before.focal)
    assert np.linalg.norm(turned.position - turned.focal) == pytest.approx(
        np.linalg.norm(before.position - before.focal)
    )
    QTest.mouseDClick(widget, Qt.MouseButton.LeftButton, pos=QPoint(20, 100))
    assert np.allclose(window.viewport.cameras()[0].position, before.position)


def drag(widget, start, stop):
    QTest.mousePress(widget, Qt.MouseButton.LeftButton, pos=start)
    for t in (0.2, 0.6, 1.0):
        QTest.mouseMove(widget, start + (stop - start) * t)
    QTest.mouseRelease(widget, Qt.MouseButton.LeftButton, pos=stop)


def test_nothing_is_drawn_while_nothing_happens(qtbot, window):
    qtbot.wait(600)
    drawn = []
    tag = window.viewport._plotter.render_window.AddObserver("EndEvent", lambda *_: drawn.append(1))
    qtbot.wait(1000)
    assert len(drawn) == 0
    window.session.do(toggle, "ghost")
    qtbot.wait(600)
    window.viewport._plotter.render_window.RemoveObserver(tag)
    assert len(drawn) == 1 + window.viewport.samples == 1 + len(PLACES)  # once plain, then once for each sample


def seen(viewport):
    """(height, width, 3): what the viewport shows."""
    shown = viewport.grab().toImage().convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(shown.constBits(), np.uint8).reshape(shown.height(), shown.bytesPerLine())
    return rows[:, : 3 * shown.width()].reshape(shown.height(), -1, 3).astype(int)


def test_a_picture_is_the_same_whether_it_is_copied_into_the_window_or_put_there_by_opengl(
    qtbot, lesson, settings, monkeypatch
):
    pictures = []
    for is_soft, quick, samples in ((True, -1.0, 4), (False, 0.0, 4), (True, 9.0, len(PLACES))):
        monkeypatch.setattr("app.gui.viewport.is_software", lambda is_soft=is_soft: is_soft)
        monkeypatch.setattr("app.gui.viewport.SAMPLES", 8 if is_soft else 4)  # what takes long has half of them
        monkeypatch.setattr("app.gui.canvas.QUICK", quick)
        other = Window(Session(start(lesson)), settings)
        other.resize(1280, 720)
        other.show()
        qtbot.waitExposed(other)
        other.viewport.start()
        assert (other.viewport.canvas is other.viewport._plotter) is not is_soft
        other.session.do(last)
        qtbot.wait(800)
        assert other.viewport.samples == samples
        pictures.append(seen(other.viewport))
        other.close()
        other.deleteLater()
    assert np.ptp(pictures[0]) > 100
    assert np.abs(pictures[0] - pictures[1]).max() <= 2
    other = np.abs(pictures[0] - pictures[2])  # each sample is drawn for itself: only where something ends
    assert 0 < np.mean(other > 2) < 0.05
    assert other.mean() < 0.5


def test_what_changes_while_it_becomes_smooth_becomes_smooth_as_it_is_then(qtbot, window):
    view = window.viewport
    qtbot.waitUntil(lambda: view.samples == len(PLACES))
    before = seen(view)
    window.session.do(toggle, "ghost")
    qtbot.waitUntil(lambda: view.canvas._smoothing.are_left)
    window.session.do(toggle, "ghost")
    assert not view.canvas._smoothing.are_left
    qtbot.waitUntil(lambda: view.samples == 1)
    qtbot.waitUntil(lambda: view.samples == len(PLACES))
    np.testing.assert_array_equal(seen(view), before)


def test_what_is_shown_is_the_last_of_the_pictures_that_were_begun(window):
    view, one_by_one = window.viewport, []
    for step in (last, first):
        window.session.do(step)
        assert view.canvas.is_awaited  # its pixels are filled in while the window does what else there is to do
        QApplication.processEvents()
        assert not view.canvas.is_awaited
        one_by_one.append(seen(view))
    at_last, at_first = one_by_one
    assert np.abs(at_last - at_first).mean() > 0.5
    for step in (last, first, last):
        window.session.do(step)
    QApplication.processEvents()
    assert not view.canvas.is_awaited
    np.testing.assert_array_equal(seen(view), at_last)


@pytest.mark.parametrize("theme", ["light", "dark", "projector"])
def test_the_picture_has_most_of_the_window_and_every_theme_its_background(qtbot, window, theme):
    window.session.do(choose, theme=theme)
    qtbot.waitUntil(lambda: not window.is_changing)
    qtbot.wait(50)
    assert window.viewport.width() * window.viewport.height() >= 0.6 * 1280 * 720
    seen = window.grab().toImage().pixelColor(window.viewport.mapTo(window, QPoint(6, 300)))
    assert seen.getRgbF()[:3] == pytest.approx(THEMES[theme].background, abs=0.04)  # a screen may have few colours


def test_a_narrow_window_puts_the_details_behind_their_button(qtbot, window):
    window.resize(1000, 640)
    qtbot.waitUntil(lambda: not window._sides["details"].isVisible(), timeout=2000)
    press(window, Key.Key_F10)
    assert window._sides["details"].isVisible()
    window.resize(1280, 720)
    qtbot.waitUntil(lambda: window._sides["details"].isVisible(), timeout=2000)


def test_a_search_in_a_narrow_panel_moves_nothing(qtbot, window):
    window._splitter.setSizes([1, window.width(), 1])
    qtbot.wait(100)
    wide = window.contents.width()
    window.contents.search.setText("loop")
    qtbot.wait(500)  # the button that clears it comes bit by bit
    assert window.contents.width() == wide


def test_searching_and_enter_open_a_lesson_from_the_keyboard(qtbot, window):
    wanted = all_lessons()[-1]
    press(window, Key.Key_K, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClicks(window.contents.search, wanted.id)
    press(window, Key.Key_Return)
    assert window.session.state.lesson is wanted
    assert window.contents.search.text() == ""
    press(window, Key.Key_Space)
    assert window.session.state.is_playing


def test_a_saved_picture_is_finer_than_the_screen_and_the_window_goes_on(qtbot, window, tmp_path):
    window.session.do(choose, speed=8.0)
    qtbot.wait(600)  # until it is smooth
    seen = window.viewport.grab().toImage()
    for name in ("cube", "cube.svg"):
        window.save_picture_to(str(tmp_path / name))
        qtbot.waitUntil(lambda: not window.saver.is_busy, timeout=20000)
    assert QImage(str(tmp_path / "cube.png")).width() >= 1920
    assert "<svg" in (tmp_path / "cube.svg").read_text()
    assert "Saved" in window.banner.words.text()
    window.save_picture_to(str(tmp_path / "cube.xyz"))
    qtbot.waitUntil(lambda: not window.saver.is_busy, timeout=20000)
    assert ".png" in window.banner.words.text()
    press(window, Key.Key_Escape)
    qtbot.wait(600)
    assert window.viewport.grab().toImage() == seen
    press(window, Key.Key_PageDown)
    rested(qtbot, window)
    assert window.viewport.grab().toImage() != seen


def test_help_says_what_the_program_is_and_a_click_puts_it_away(window):
    window.actions_by_id["about"].trigger()
    assert not window.sheets[1].grab().toImage().isNull()
    QTest.mouseClick(window.sheets[1], Qt.MouseButton.LeftButton)
    assert not window.sheets[1].isVisible()


def test_a_long_read_says_so_and_can_be_cancelled(qtbot, window, tmp_path, monkeypatch):
    done = threading.Event()

    def slow(path):
        done.wait(5)
        return shapes.cube()

    monkeypatch.setattr("subdivision.files.read", slow)
    before = values(window.session.state)
    window.open_file(str(tmp_path / "large.obj"))
    qtbot.waitUntil(lambda: "large.obj" in window.banner.words.text(), timeout=2000)
    press(window, Key.Key_PageDown)  # the window is not held up
    rested(qtbot, window)
    press(window, Key.Key_PageUp)
    rested(qtbot, window)
    QTest.mouseClick(window.banner._cancel, Qt.MouseButton.LeftButton)
    assert not window.banner.isVisible()
    done.set()
    qtbot.waitUntil(lambda: not window.opener._running, timeout=2000)
    assert values(window.session.state) == before


def test_a_message_goes_when_another_lesson_comes(window, lesson):
    window.say("bad.obj, line 3: 'x' is not a number")
    window.session.do(forward)
    assert not window.banner.isHidden()
    window.session.do(open_lesson, replace(lesson, id="another"))
    assert window.banner.isHidden()


def test_a_window_that_is_closed_keeps_no_address_of_what_qt_has_given_back(window, qtbot):
    gc.collect()
    assert window.viewport.canvas.isVisible()
    window.close()
    qtbot.wait(10)
    assert {QOpenGLContext, QSurface}.isdisjoint(map(type, gc.get_objects()))

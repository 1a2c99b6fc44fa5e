"""The laboratory in the window: choose, compare, ask, undo; by mouse and keyboard."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from app.gui.parts import Head
from app.laboratory import bench
from app.laboratory.lab import LABORATORY
from app.state import choose, drag, last, level_of
from subdivision import shapes

pytestmark = pytest.mark.window


def open_by_keyboard(window):
    """Ctrl+K, type, Enter."""
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_K, Qt.KeyboardModifier.ControlModifier)
    QTest.keyClicks(window.contents.search, "own object")
    QTest.keyClick(window.contents.search, Qt.Key.Key_Return)
    assert window.session.state.lesson.id == LABORATORY
    return window.laboratory


def pick(choice, name):
    """Choose from a list with the keyboard."""
    choice.box.setFocus()
    k = choice.box.findText(name, Qt.MatchFlag.MatchStartsWith)
    assert k >= 0, name
    for _ in range(abs(k - choice.box.currentIndex())):
        QTest.keyClick(choice.box, Qt.Key.Key_Down if choice.box.currentIndex() < k else Qt.Key.Key_Up)
    assert choice.box.currentIndex() == k


def test_why_the_cubes_corner_moves_to_five_ninths_is_found_from_the_window_alone(window, qtbot):
    panel = open_by_keyboard(window)
    pick(panel.panes[0].family, "Catmull-Clark")
    window.session.do(last)
    QTest.mouseClick(panel.levels.less, Qt.MouseButton.LeftButton)
    assert window.session.state.lab.levels == 1
    window.session.do(last)
    trace = window.session.state.now.lead.trace
    x, y, w, h = window.viewport.areas()[0]
    flat = window.viewport.cameras()[0].project(trace.points[-1][5], w, h)[0]
    place = QPoint(round(x + flat[0]), round(y + flat[1]))
    QTest.mouseMove(window.viewport.canvas, place)
    QTest.mouseClick(window.viewport.canvas, Qt.MouseButton.LeftButton, pos=place)
    words = window.why._words.text()
    assert "v5" in words
    for weight in ("15/36", "6/36", "1/36"):
        assert weight in words
    assert np.abs(np.abs(trace.points[-1][5]) - 5 / 9).max() < 1e-12


def test_schemes_are_compared_side_by_side_with_one_camera_and_shared_edits(window, qtbot):
    panel = open_by_keyboard(window)
    QTest.mouseClick(panel.more, Qt.MouseButton.LeftButton)
    assert len(window.session.state.now.views) == len(panel.panes) == 2
    pick(panel.panes[1].family, "Catmull-Clark")
    window.session.do(last)


    window.session.do(drag, 5, (2.0, -2.0, 2.0))
    ends = [window.session.state.trace(v).points for v in window.session.state.now.views]
    assert all(np.abs(points[0][5] - (2.0, -2.0, 2.0)).max() == 0 for points in ends)
    assert np.abs(ends[0][-1] - ends[1][-1]).max() > 1e-3
    first, second = window.viewport.cameras()
    assert np.abs(first.position - second.position).max() < 1e-12
    window.session.undo()
    assert window.session.state.edits == ()


def test_every_choice_can_be_undone_and_the_panel_follows(window):
    panel = open_by_keyboard(window)
    pick(panel.shape, "Torus")
    assert window.session.state.lab.name == "torus"
    window.session.undo()
    for _ in range(20):
        if window.session.state.lab.name != "cube":
            window.session.undo()
    assert panel.shape.box.currentText() == "Cube"


def test_a_level_too_many_is_refused_with_the_numbers_and_other_refusals_are_sentences_too(window, qtbot):
    panel = open_by_keyboard(window)
    window.session.do(bench.take, "duck")
    for _ in range(10):
        panel.levels.more.click()
        qtbot.waitUntil(lambda: not panel.worker.is_busy, timeout=20000)
    before = window.session.state.lab
    said = f"{before.levels + 1} levels would make "
    assert said in window.banner.words.text()
    assert f"room for 130,000; choose at most {before.levels}" in window.banner.words.text()
    panel.wish(bench.choose_family, 0, "loop")
    qtbot.waitUntil(lambda: not panel.worker.is_busy, timeout=20000)
    assert window.session.state.lab is before
    assert window.banner.isVisible()
    assert "triangle" in window.banner.words.text()


def test_the_timeline_and_the_level_keys_work_on_ones_own_object(window):
    open_by_keyboard(window)
    window.session.do(choose, speed=4.0)
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_Up)
    assert level_of(window.session.state) == 1
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_Down)
    assert level_of(window.session.state) == 0


def test_a_section_of_the_panel_folds_away_and_comes_back(window):


    open_by_keyboard(window)
    head = next(h for h in window.laboratory.findChildren(Head) if h.text() == "Laboratory")
    QTest.mouseClick(head, Qt.MouseButton.LeftButton)
    assert not window.laboratory.levels.isVisible()
    head.setFocus()
    QTest.keyClick(head, Qt.Key.Key_Space)
    assert window.laboratory.levels.isVisible()


def test_a_large_object_is_worked_out_elsewhere_and_dragging_it_at_level_three_keeps_the_engines_points(window, qtbot):
    window.session.do(lambda s: bench.replace_control(bench.enter(s), shapes.torus(50, 40), "ring"))
    panel = window.laboratory
    for level in (2, 3):
        panel.levels.more.click()
        assert panel.worker.is_busy
        qtbot.waitUntil(lambda: not panel.worker.is_busy, timeout=20000)
        assert window.session.state.lab.levels == level
    window.session.do(last)
    window.session.do(drag, 5, (1.5, 0.4, 0.6))
    trace = window.session.state.trace(window.session.state.now.lead)
    assert trace.topology_at(len(trace.stages)).n_faces == 128_000
    afresh = trace.with_control(trace.control)
    assert np.abs(trace.points[-1] - afresh.points[-1]).max() < 1e-12


def test_a_change_worked_out_elsewhere_is_forgotten_when_a_newer_one_is_wished(window, qtbot):
    window.session.do(lambda s: bench.replace_control(bench.enter(s), shapes.torus(50, 40), "ring"))
    panel = window.laboratory
    panel.wish(bench.choose_family, 0, "loop")  # refused, in the end
    panel.wish(bench.choose_family, 0, "catmull-clark")
    qtbot.waitUntil(lambda: not panel.worker.is_busy, timeout=20000)
    assert window.session.state.lab.rules[0].family == "catmull-clark"
    assert not window.banner.isVisible()
    panel.wish(bench.choose_family, 0, "loop")
    qtbot.waitUntil(lambda: not panel.worker.is_busy, timeout=20000)
    assert window.session.state.lab.rules[0].family == "catmull-clark"
    assert "triangle" in window.banner.words.text()


def test_folded_sections_stay_folded_in_the_next_window(window, settings, qtbot):
    open_by_keyboard(window)
    next(h for h in window.details.findChildren(Head) if h.text() == "Shown").click()
    window.details.keep(settings)
    for head in window.details.findChildren(Head):
        head.setChecked(True)
    window.details.restore(settings)
    assert [h.text() for h in window.details.findChildren(Head) if not h.isChecked()] == ["Shown"]

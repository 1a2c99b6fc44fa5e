"""The figures in the window: every lesson by keyboard alone, knobs, boxes under the mouse, the caption's colours."""

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest

import lessons
from app.draw.layout import part_at
from app.draw.theme import YELLOW
from app.state import Stop, at_stop, choose, first, last, open_lesson, settle, stops
from lessons.script import Kind

pytestmark = pytest.mark.window
Key, Control = Qt.Key, Qt.KeyboardModifier.ControlModifier


def press(window, key, modifiers=Qt.KeyboardModifier.NoModifier):
    QTest.keyClick(window.windowHandle(), key, modifiers)


def test_the_whole_lecture_is_presented_from_its_first_stop_to_its_last_by_a_clicker_alone(window):
    every = lessons.all_lessons()
    window.session.do(open_lesson, every[0])
    press(window, Key.Key_F5)
    for place in [(lesson.id, stop) for lesson in every for stop in stops(lesson)][1:]:
        press(window, Key.Key_PageDown)
        if window.session.state.is_playing:
            window.session.do(settle)
        QTest.qWait(1)
        state = window.session.state
        assert (state.lesson.id, Stop(state.beat, state.at)) == place
        assert state.options.presenting
    press(window, Key.Key_Escape)
    assert not window.session.state.options.presenting


def test_a_knob_is_turned_by_its_keys_and_its_buttons_and_the_lesson_stays_where_it_is(window):
    window.session.do(open_lesson, lessons.find("1"))
    window.session.do(last)
    assert window.session.state.lesson.settings == {"degree": 3}
    press(window, Key.Key_Right, Control)
    assert window.session.state.lesson.settings == {"degree": 4}
    assert window.session.state.beat == len(window.session.state.lesson.beats) - 1
    (row,) = window.knobs.rows
    row.less.click()
    row.less.click()
    assert window.session.state.lesson.settings == {"degree": 2}
    for _ in range(10):
        press(window, Key.Key_Right, Control)
    assert window.session.state.lesson.settings == {"degree": 7}
    assert not row.more.isEnabled()
    press(window, Key.Key_Z, Control)
    assert window.session.state.lesson.settings == {"degree": 6}
    assert window.contents.list.currentIndex().data() == window.session.state.lesson.title


def test_pointing_at_a_box_lights_its_parents_and_says_its_row(window, qtbot):
    window.session.do(open_lesson, lessons.find("1"))
    window.session.do(last)
    viewport = window.viewport
    number = next(k for k, v in enumerate(window.session.state.now.views) if v.kind is Kind.DIAGRAM)
    boxes = viewport._picture.panes[number].content.boxes
    target = max(boxes, key=lambda box: (box.stage, -box.point))
    x, y, w, h = viewport.areas()[number]
    spots = [(x + w * i / 60, y + h * j / 60) for i in range(60) for j in range(60)]

    def box_at(place):
        found = part_at(viewport._picture, viewport.width(), viewport._tall(), *place, words=False)
        return found[1] if found else None

    place = next(p for p in spots if box_at(p) == target)
    QTest.mouseMove(viewport.canvas, QPointF(2, 2).toPoint())  # it may have been left at the place itself
    qtbot.wait(50)
    QTest.mouseMove(viewport.canvas, QPointF(*place).toPoint())
    qtbot.waitUntil(lambda: window.session.state.focus is not None, timeout=10_000)
    focus = window.session.state.focus
    assert (focus.stage, focus.point) == (target.stage, target.point)
    row = window.session.state.now.views[number].trace.stages[focus.stage - 1].stencil(focus.point)
    boxes = viewport._picture.panes[number].content.boxes
    heaviest = max(box.line for box in boxes)
    lit = {(box.stage, box.point) for box in boxes if box.line == heaviest}
    assert heaviest > target.line
    assert lit == {(focus.stage, focus.point), *((focus.stage - 1, int(p)) for p in row.parents)}
    assert f"v{focus.point}" in window.why._words.text()


def test_the_switch_as_in_the_caption_recolours_the_picture_and_the_words(window):
    window.session.do(open_lesson, lessons.find("12"))
    window.session.do(first)
    assert window.shown._switches["as_caption"].isEnabled()
    press(window, Key.Key_PageDown)
    window.session.do(last)
    marked = next(k for k, b in enumerate(window.session.state.lesson.beats) if "{centroid}" in b.text)
    press(window, Key.Key_A)
    window.session.do(lambda s: at_stop(s, next(p for p in stops(s.lesson) if p.beat == marked)))
    picture = window.viewport._picture
    assert "green" in picture.caption
    edge = next(e for e in picture.legend if e.text == "edge point")
    assert edge.colour == YELLOW
    press(window, Key.Key_A)
    edge = next(e for e in window.viewport._picture.legend if e.text == "edge point")
    assert edge.colour != YELLOW
    window.session.do(open_lesson, lessons.find("1"))
    assert not window.shown._switches["as_caption"].isEnabled()


def test_notes_stand_apart_and_go_with_their_step(window):
    window.session.do(open_lesson, lessons.find("12"))
    noted = next(k for k, b in enumerate(window.session.state.lesson.beats) if b.notes)
    window.session.do(lambda s: at_stop(s, next(p for p in stops(s.lesson) if p.beat == noted)))
    assert window.session.state.now.notes[:20] in window.notes.words.text()
    assert window.session.state.now.notes not in window.viewport._picture.caption


def test_six_linked_panes_turn_together(window):
    window.session.do(open_lesson, lessons.find("9"))
    window.session.do(last)
    assert len(window.viewport._picture.panes) == 6
    before = window.viewport.cameras()
    centre = window.viewport.canvas.rect().center()
    QTest.mousePress(window.viewport.canvas, Qt.MouseButton.LeftButton, pos=centre)
    QTest.mouseMove(window.viewport.canvas, centre + QPointF(80, 20).toPoint())
    QTest.mouseRelease(window.viewport.canvas, Qt.MouseButton.LeftButton, pos=centre + QPointF(80, 20).toPoint())
    after = window.viewport.cameras()
    assert all(abs(a.position - b.position).max() > 1e-3 for a, b in zip(before, after, strict=True))
    assert all(abs(a.position - after[0].position).max() < 1e-12 for a in after)


def test_a_knob_turned_while_playing_settles_first(window):
    window.session.do(open_lesson, lessons.find("1"))
    window.session.do(choose, speed=0.25)
    press(window, Key.Key_PageDown)
    press(window, Key.Key_Right, Control)
    assert not window.session.state.is_playing
    assert window.session.state.beat > 0

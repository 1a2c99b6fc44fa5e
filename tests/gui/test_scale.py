"""Everything in the window larger or smaller, while it stands."""

import re

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QLabel

import lessons
from app.cli import main
from app.export.wish import Wish
from app.gui.application import settings_scale
from app.gui.export import arguments
from app.gui.keys import BY_ID, spelled_keys
from app.gui.look import SCALES
from app.gui.session import Session
from app.laboratory import bench
from app.sessions import keeping
from app.state import Options, last, start, toggle

pytestmark = pytest.mark.window
CTRL = Qt.KeyboardModifier.ControlModifier


def press(window, key):
    QTest.keyClick(window.windowHandle(), key, CTRL)


def settle():
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QApplication.processEvents()


def choose_scale(qtbot, window, scale):
    """Choose a size, and wait until the window has it."""
    window.choose_scale(scale)
    qtbot.waitUntil(lambda: not window.is_changing)


def sizes(window):
    """Of each button and label, in order: its type, and the size of its icon."""
    settle()
    places = window._places()
    everything = [each for place in places.values() for each in (*place.findChildren(QAbstractButton),
                                                                 *place.findChildren(QLabel))]
    return [
        (type(each).__name__, each.font().pixelSize(), each.iconSize().width() if hasattr(each, "iconSize") else 0)
        for each in everything
    ]


def test_larger_and_as_usual_by_the_keys(qtbot, window):
    window.session.do(toggle, "labels")
    options, past = window.session.state.options, list(window.session._past)
    for key in (Qt.Key.Key_Plus, Qt.Key.Key_Equal, Qt.Key.Key_Plus):
        press(window, key)
    qtbot.waitUntil(lambda: not window.is_changing)
    assert window.session.state.options.scale == 1.5 == settings_scale(window.settings)
    assert window.actions_by_id["scale_150"].isChecked()
    assert QApplication.font().pixelSize() == 21
    press(window, Qt.Key.Key_Minus)
    assert window.session.state.options.scale == 1.25
    press(window, Qt.Key.Key_0)
    assert (window.session.state.options, window.session._past) == (options, past)
    press(window, Qt.Key.Key_Plus)
    window.session.undo()
    assert not window.session.state.options.labels
    assert window.session.state.options.scale == 1.1
    for by, end in ((1, max(SCALES)), (-1, min(SCALES))):
        for _ in SCALES:
            window.turn_scale(by)
        assert window.session.state.options.scale == end
    assert spelled_keys(BY_ID["larger"]) == ("Ctrl++", "Ctrl+=")
    assert spelled_keys(BY_ID["smaller"]) == ("Ctrl+−",)


def test_a_window_that_begins_large_is_as_one_that_became_so(qtbot, window, lesson, settings):
    def type_of(w):
        return [each.font().pixelSize() for each in (w.menuBar(), w.banner.words, w.presenter.again, w.timeline)]

    choose_scale(qtbot, window, 1.5)
    assert type_of(window) == [21] * 4
    choose_scale(qtbot, window, 1.0)
    QApplication.instance().setStyleSheet("")  # as where no window has been before
    began = type(window)(Session(start(lesson, Options(scale=1.5))), settings)
    qtbot.addWidget(began)
    assert type_of(began) == [21] * 4


def test_twice_the_scale_is_twice_the_size(qtbot, window):
    window.resize(1900, 1000)
    window.session.do(bench.take, "cube")
    usual = sizes(window)
    choose_scale(qtbot, window, 2.0)
    assert sizes(window) == [(kind, 2 * font, 2 * icon) for kind, font, icon in usual]
    choose_scale(qtbot, window, 1.0)
    assert sizes(window) == usual


@pytest.mark.parametrize(("scale", "size"), [(2.5, (1280, 720)), (0.75, (720, 480)), (2.0, (1920, 1080)),
                                             (1.5, (1280, 720))])
def test_the_picture_keeps_half_of_the_window_and_nothing_is_cut_off(qtbot, window, scale, size):
    choose_scale(qtbot, window, scale)
    window.resize(*size)
    qtbot.waitUntil(lambda: (window.width(), window.height()) == size)
    settle()
    assert window.viewport.width() * window.viewport.height() >= 0.5 * size[0] * size[1]
    inside = window.rect()
    for part in (window.menuBar(), window.timeline, window.viewport, *window.timeline.findChildren(QAbstractButton)):
        if part.isVisible():
            assert inside.contains(part.rect().translated(part.mapTo(window, part.rect().topLeft())))
            assert part.width() >= part.minimumSizeHint().width()


def test_an_export_is_as_large_as_what_is_shown(qapp, tmp_path):
    largest = []
    for scale in (1.0, 1.5):
        state = last(start(lessons.find("14"), Options(scale=scale)))
        kept, out = keeping.write(tmp_path / "view", state), tmp_path / f"{scale}.svg"
        words = arguments(kept, state, Wish("svg", "view"), out)
        words.remove("--progress")  # nobody listens
        assert main(words) == 0
        largest.append(max(float(size) for size in re.findall(r'font-size="([0-9.]+)', out.read_text())))
    assert largest[1] == pytest.approx(1.5 * largest[0], rel=0.02)

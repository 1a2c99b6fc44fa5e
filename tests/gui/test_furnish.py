"""Everything round the picture can be made anew while the window stands, and nobody notices."""

from collections import Counter

import pytest
from PySide6.QtCore import SIGNAL, QCoreApplication, QEvent, Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.draw.compose import said
from app.draw.theme import THEMES
from app.gui.parts import Head
from app.laboratory import bench
from app.state import Spot, choose, forward, look, toggle

pytestmark = pytest.mark.window


def settle():
    """Let Qt lay out what is new and delete what is old."""
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QApplication.processEvents()


def alive():
    """How many widgets there are of each kind."""
    settle()
    return Counter(type(each).__name__ for each in QApplication.allWidgets())


def folds(window):
    return [head.isChecked() for head in window.details.findChildren(Head)]


def seen(window):
    """What of the window is seen, and where."""
    parts = (*window._sides.values(), window.timeline, window.menuBar(), window.banner, window.viewport)
    return [part.isVisible() and part.geometry() for part in parts], window.windowState(), window._splitter.sizes()


def test_nothing_is_lost(qtbot, window):
    session = window.session
    session.do(bench.take, "cube")
    session.do(toggle, "labels")
    window.details.findChildren(Head)[1].setChecked(False)
    window._splitter.setSizes([260, 720, 300])
    window._splitter.splitterMoved.emit(260, 1)  # as the hand does
    window.contents.search.setText("cube")
    window.contents.search.setFocus()
    window.banner.offer("Here is an offer.", "Take it", lambda: session.do(toggle, "valences"))
    window.toggle_presenter()
    qtbot.waitExposed(window.presenter)
    window.activateWindow()
    window.contents.search.setFocus()
    qtbot.waitUntil(lambda: QApplication.focusWidget() is window.contents.search)
    window.presenter._since.restart()
    before, folded, viewport = seen(window), folds(window), window.viewport
    state, past = session.state, list(session._past)
    window.furnish()
    settle()
    assert (session.state, session._past) == (state, past)
    assert window.viewport is viewport
    assert seen(window) == before
    assert folds(window) == folded
    assert QApplication.focusWidget() is window.contents.search
    assert window.contents.search.text() == "cube"
    assert window.presenter.isVisible()
    assert window.presenter.caption.text() == said(state, state.now)
    QTest.mouseClick(window.banner.accept, Qt.MouseButton.LeftButton)
    assert session.state.options.valences
    window.session.undo()
    window.session.undo()
    assert not session.state.options.labels
    assert not window.shown._switches["labels"].isChecked()


def test_what_is_under_way_goes_on(qtbot, window, tmp_path):
    mesh = tmp_path / "one.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    window.open_file(str(mesh))
    window.furnish()
    qtbot.waitUntil(lambda: bench.is_open(window.session.state), timeout=10000)
    assert window.laboratory.isVisible()
    window.session.do(forward)
    window.furnish()
    assert window.session.state.is_playing


def test_a_number_being_typed_counts(window):
    window.session.do(bench.take, "cube")
    window.session.do(choose, control=True)
    window.session.do(look, Spot(0, 0, 3))
    box = window.why.place.boxes[0]
    box.setFocus()
    box.lineEdit().setText("1.25")
    window.furnish()
    assert window.session.state.edits[-1][1][0] == 1.25
    assert QApplication.focusWidget() is window.why.place.boxes[0] is not box


def test_nothing_is_left_over(window):
    window.session.do(bench.take, "cube")
    window.furnish()
    before = alive()
    receivers = window.session.receivers(SIGNAL("changed(PyObject)"))
    children = len(window.session.children())
    for _ in range(10):
        window.furnish()
    assert alive() == before
    assert window.session.receivers(SIGNAL("changed(PyObject)")) == receivers == 1
    assert len(window.session.children()) == children


def test_presenting_stays_presenting(window):
    window.toggle_presenting()
    settle()
    before = seen(window)
    window.furnish()
    settle()
    assert seen(window) == before
    window.toggle_presenting()
    settle()
    assert window.timeline.isVisible()
    assert window.contents.isVisible()


def test_the_window_answers_while_it_changes_its_looks(qtbot, window):
    answered = []
    timer = QTimer(interval=0)
    timer.timeout.connect(lambda: answered.append(window.is_changing))
    timer.start()
    window.contents.search.setText("cube")
    window.session.do(choose, scale=1.25)
    window.session.do(toggle, "labels")  # all of it before the first change is over
    window.session.do(choose, theme="dark")
    window.session.do(choose, language="de")
    qtbot.waitUntil(lambda: not window.is_changing)
    timer.stop()
    assert sum(answered) > 10
    assert window.updatesEnabled()
    assert window.contents.search.text() == "cube"
    assert window.shown._switches["labels"].isChecked()
    assert window.menuBar().actions()[0].text() == "&Datei"
    assert (window.font().pixelSize(), window.viewport.picture().background) == (18, THEMES["dark"].background)
    window.session.do(choose, language="en")
    qtbot.waitUntil(lambda: not window.is_changing)
    assert window.menuBar().actions()[0].text() == "&File"


def test_a_window_that_changes_its_looks_can_be_closed(window):
    window.session.do(choose, scale=1.5)
    assert window.is_changing
    window.close()
    assert not window.is_changing
    assert window.settings.value("contents") == "shown"

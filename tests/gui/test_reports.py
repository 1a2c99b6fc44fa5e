"""Planted faults: each ends in one dialog with a report, a traceback in the log, and a window that goes on."""

import gc
import logging
import threading

import pytest
from PySide6.QtCore import QEvent, QObject, Qt, QThreadPool, QTimer
from PySide6.QtGui import QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QWidget

from app.cli import main
from app.gui.fault import Faults
from app.report import ROOT, Recent, plain, report_of
from app.state import choose, drag, first, forward, last, seek, toggle_play


class Planted(Exception):
    """What is raised here on purpose."""


def fail(*_, **__):
    raise Planted("planted in '/home/anna/My exams/secret.obj'")


@pytest.fixture
def faults(window, tmp_path):
    found = Faults(window, tmp_path / "studio.log", {"OpenGL": "painted by hand"})
    found.listen()
    yield found
    found.leave()
    found.dialog.close()


def in_a_slot(window):
    QTimer.singleShot(0, fail)


def in_a_timer(window):
    window._timer_of_the_test = QTimer(window, singleShot=True, interval=5)
    window._timer_of_the_test.timeout.connect(fail)
    window._timer_of_the_test.start()


def in_an_event_filter(window):
    class Filter(QObject):
        def eventFilter(self, watched, event):
            if event.type() == QEvent.Type.User:
                window.removeEventFilter(self)
                fail()
            return False

    window._filter_of_the_test = Filter(window)
    window.installEventFilter(window._filter_of_the_test)
    QApplication.postEvent(window, QEvent(QEvent.Type.User))


def in_an_event_handler(window):
    class Failing(QWidget):
        customEvent = fail

    window._widget_of_the_test = Failing(window)
    QApplication.postEvent(window._widget_of_the_test, QEvent(QEvent.Type.User))


def in_a_transition(window):
    QTimer.singleShot(0, lambda: window.session.do(fail))


def in_the_work_of_a_worker(window):
    window.worker.start(
        fail, fail, window.banner.say, waiting="Waiting", too_large="Too large.", broken="The work could not be done."
    )


def in_a_thread_of_the_pool(window):
    QThreadPool.globalInstance().start(fail)


def in_a_thread(window):
    thread = threading.Thread(target=fail)
    thread.start()
    thread.join()


def where_nobody_can_raise(window):
    class Last:
        __del__ = fail

    Last()
    gc.collect()


def in_an_observer_of_vtk(window):
    watched = window.viewport._plotter.render_window
    tag = watched.AddObserver("UserEvent", fail)
    watched.InvokeEvent("UserEvent")
    watched.RemoveObserver(tag)


PLACES = (
    in_a_slot, in_a_timer, in_an_event_filter, in_an_event_handler, in_a_transition, in_the_work_of_a_worker,
    in_a_thread_of_the_pool, in_a_thread, where_nobody_can_raise, in_an_observer_of_vtk,
)  # fmt: skip


@pytest.mark.window
@pytest.mark.parametrize("plant", PLACES)
def test_a_fault_anywhere_ends_in_a_dialog_and_the_window_goes_on(qtbot, window, faults, caplog, plant):
    window.session.do(forward)
    window.session.do(last)
    with caplog.at_level(logging.CRITICAL):
        plant(window)
        qtbot.waitUntil(faults.dialog.isVisible, timeout=5000)
    report = faults.dialog.report
    assert report.startswith("Planted in ")
    assert 'File "tests/gui/test_reports.py", line ' in report
    assert "'…/secret.obj'" in report
    assert "anna" not in report
    assert "OpenGL: painted by hand" in report
    assert "  forward\n  last\n" in report
    assert "raise Planted(" in report
    assert str(ROOT) not in report
    (record,) = [each for each in caplog.records if each.levelno == logging.CRITICAL]
    assert record.exc_info[0] is Planted
    assert not faults.dialog.text.isVisible()
    assert not faults.dialog.isModal()
    assert "exit" not in faults.dialog.sentence.text()
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_Home)
    assert window.session.state.beat == 0
    QTest.mouseClick(faults.dialog.go_on, Qt.MouseButton.LeftButton)
    assert not faults.dialog.isVisible()


@pytest.mark.window
def test_a_fault_in_every_frame_is_one_dialog_with_a_count_and_playing_stops(qtbot, window, faults, monkeypatch):
    window.session.do(first)
    monkeypatch.setattr("app.gui.viewport.faded", fail)
    window.session.do(toggle_play)
    qtbot.waitUntil(faults.dialog.isVisible, timeout=5000)
    assert not window.session.state.is_playing
    for k in range(40):
        window.session.do(seek, k / 40)
    qtbot.waitUntil(lambda: "times" in faults.dialog.often.text(), timeout=5000)
    assert [each for each in QApplication.topLevelWidgets() if each.windowTitle() == faults.dialog.windowTitle()] == [
        faults.dialog
    ]
    (count,) = faults._counts.values()
    assert count > 15
    assert f"It has happened {count} times." in faults.dialog.report
    assert window.timeline.isEnabled()
    faults.dialog.go_on.click()
    window.session.do(seek, 0.3)
    qtbot.waitUntil(lambda: "times by now" in window.banner.words.text(), timeout=5000)
    assert not faults.dialog.isVisible()
    monkeypatch.undo()
    window.session.do(last)
    assert window.viewport._picture.caption == window.session.state.now.text


@pytest.mark.window
def test_a_panel_that_fails_keeps_no_other_from_showing_the_state(qtbot, window, faults, monkeypatch):
    monkeypatch.setattr(window.banner, "show_state", fail)
    before = window.timeline.grab().toImage()
    window.session.do(last)
    assert window.timeline.grab().toImage() != before
    qtbot.waitUntil(faults.dialog.isVisible, timeout=5000)


@pytest.mark.window
def test_from_the_dialog_the_report_is_copied_unfolded_and_the_session_saved(
    qtbot, window, faults, tmp_path, monkeypatch
):
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "saved"), ""))
    window.session.do(drag, 3, (1.0, -0.25, 0.5))
    QTimer.singleShot(0, fail)
    qtbot.waitUntil(faults.dialog.isVisible, timeout=5000)
    faults.dialog.copy.click()
    assert QGuiApplication.clipboard().text() == faults.dialog.report
    assert faults.dialog.copy.text() == "Copied"
    faults.dialog.details.head.click()
    assert faults.dialog.text.isVisible()
    assert faults.dialog.text.toPlainText() == faults.dialog.report
    monkeypatch.setattr("app.sessions.keeping.restored", lambda *_: fail())
    faults.dialog.save.click()
    monkeypatch.undo()
    assert window.document.path == tmp_path / "saved.subdivision"


@pytest.mark.window
def test_different_faults_stand_in_one_dialog_and_a_new_one_opens_it_again(qtbot, window, faults):
    QTimer.singleShot(0, fail)
    QTimer.singleShot(0, lambda: 1 / 0)
    qtbot.waitUntil(lambda: len(faults._counts) == 2 and faults.dialog.isVisible(), timeout=5000)
    qtbot.waitUntil(lambda: "1 other fault" in faults.dialog.often.text(), timeout=5000)
    assert "ZeroDivisionError" in faults.dialog.report
    assert "Planted" in faults.dialog.report
    faults.dialog.go_on.click()
    QTimer.singleShot(0, lambda: {}["nothing"])
    qtbot.waitUntil(faults.dialog.isVisible, timeout=5000)
    assert faults.dialog.report.startswith("KeyError")
    assert "Planted" not in faults.dialog.report


def test_of_a_path_only_what_is_needed_is_told():
    assert plain("no such file: '/home/anna/My exams/b.obj'") == "no such file: '…/b.obj'"
    assert plain("open /home/anna/b.obj, or C:\\Users\\anna\\b.obj") == "open …/b.obj, or …/b.obj"
    assert plain(f'File "{ROOT}/app/cli.py", line 3; 1/2 of a/b') == 'File "app/cli.py", line 3; 1/2 of a/b'


def test_actions_alike_in_a_row_are_one_and_few_are_remembered():
    recent = Recent()
    for k in range(100):
        recent.add(main)
        recent.add(choose if k % 2 else drag)
        recent.add(seek)
        recent.add(seek)
    told = recent.told()
    assert len(told) == 24
    assert told[-3:] == ("main", "choose", "seek (2 times)")


def test_a_report_of_a_fault_without_words_or_place_is_one_too():
    report = report_of(KeyError())
    assert report.sentence == "KeyError in the program: nothing more is known"
    assert report.told({}, 3).splitlines()[1] == "It has happened 3 times."

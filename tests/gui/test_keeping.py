"""Sessions in the real window: saved, opened, dropped, linked, offered again; and nothing lost when it dies."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QGuiApplication, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QMessageBox

import lessons
from app.cli import main
from app.gui.autosave import Autosave
from app.gui.menus import _list_recent
from app.laboratory import bench
from app.sessions.keeping import document, kept, read, write
from app.sessions.link import HEAD, followed, link
from app.state import choose, drag, forward, last, open_lesson, seek, start, turn_view
from lessons.turn import REST

pytestmark = pytest.mark.window
CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
TURN = REST.rotated(0.2, 0.1).zoomed(1.3)


def press(window, key, modifiers=CTRL):
    QTest.keyClick(window.windowHandle(), key, modifiers)


def arrange(window):
    """A lesson of the lecture, at a step, dragged, turned, with switches changed."""
    session = window.session
    session.do(open_lesson, lessons.find("14"), 5)
    session.do(drag, 3, (1.0, -0.25, 1 / 3))
    session.do(turn_view, TURN)
    session.do(choose, labels=True, ghost=False)
    return document(session.state)


def elsewhere(window):
    window.session.do(bench.enter)
    window.session.do(last)
    assert document(window.session.state)["lesson"] == "laboratory"


def rested(qtbot, window):
    qtbot.waitUntil(lambda: not window.opener.is_busy, timeout=10_000)


@pytest.fixture(autouse=True)
def no_question(monkeypatch):
    """The question at the end is answered by whoever asks for it."""
    monkeypatch.setattr("app.gui.window.Window.ask_to_save", lambda _: QMessageBox.StandardButton.Discard)


def test_a_session_is_saved_and_opened_again_as_it_was(qtbot, window, tmp_path, monkeypatch):
    path, asked = tmp_path / "seminar.subdivision", []
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *a: (asked.append(a), (str(path), ""))[1])
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    assert window.windowTitle() == "Subdivision Studio"
    told = arrange(window)
    press(window, Qt.Key.Key_S)
    assert len(asked) == 1
    assert "seminar.subdivision" in window.windowTitle()
    assert not window.isWindowModified()
    elsewhere(window)
    assert window.isWindowModified()
    press(window, Qt.Key.Key_O)
    rested(qtbot, window)
    assert document(window.session.state) == told
    assert not window.isWindowModified()
    window.session.do(seek, 0.5)
    assert window.isWindowModified()
    press(window, Qt.Key.Key_S)
    assert len(asked) == 1
    assert not window.isWindowModified()
    assert document(read(path)) == document(window.session.state)
    press(window, Qt.Key.Key_S, CTRL | SHIFT)
    assert len(asked) == 2


def test_a_name_without_its_suffix_never_replaces_a_file_unasked(window, tmp_path, monkeypatch):
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "talk"), ""))
    arrange(window)
    window.save_session_as()
    assert window.document.path == tmp_path / "talk.subdivision"
    before = window.document.path.read_bytes()
    window.session.do(choose, net=False)
    window.save_session_as()
    assert "talk.subdivision is there already" in window.banner.words.text()
    assert window.document.path.read_bytes() == before


def test_the_command_opens_links_sessions_and_meshes(window, tmp_path, monkeypatch, capsys):
    told = arrange(window)
    word, path = link(window.session.state), write(tmp_path / "talk.subdivision", window.session.state)
    mesh = tmp_path / "sheet.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3 4\n")
    ran = []
    monkeypatch.setattr("app.gui.application.run", lambda **asked: ran.append(asked) or 0)
    for name, file in ((word, None), (str(path), path), (str(mesh), mesh)):
        assert main([name, "--theme", "dark"]) == 0
        assert ran[-1]["path"] == file
    opened = [document(asked["opening"](start(lessons.find("1")))) for asked in ran]
    assert opened[:2] == [{**told, "options": {**told["options"], "theme": "dark"}}] * 2
    assert opened[2]["laboratory"]["name"] == "sheet"
    for wrong, said in (
        (word[:-5], "not come whole"), (f"{path}x", "are not read"), (str(tmp_path / "no.subdivision"), "no such file"),
        (str(tmp_path / "no.obj"), "no such file"), ("figure_77", "there is no lesson"),
    ):  # fmt: skip
        assert main([wrong]) == 1
        assert said in capsys.readouterr().err
    assert main([word, "--step", "3"]) == 1
    assert "leave them out" in capsys.readouterr().err


def test_undoing_to_what_was_saved_takes_the_star_away(window, tmp_path):
    arrange(window)
    window.save_session_to(tmp_path / "a.subdivision")
    window.session.do(choose, net=False)
    assert window.isWindowModified()
    window.session.undo()
    assert not window.isWindowModified()
    window.session.undo()
    assert window.isWindowModified()


def test_what_cannot_be_written_is_a_sentence_and_all_stays(window, tmp_path, monkeypatch):
    told = arrange(window)
    window.save_session_to(tmp_path / "a.subdivision")
    before = (tmp_path / "a.subdivision").read_bytes()
    window.session.do(choose, net=False)
    monkeypatch.setattr("os.fsync", lambda _: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    press(window, Qt.Key.Key_S)
    assert "no space is left" in window.banner.words.text()
    assert (tmp_path / "a.subdivision").read_bytes() == before
    assert window.isWindowModified()
    assert document(window.session.state) == {**told, "options": {**told["options"], "net": False}}
    window.save_session_to(tmp_path / "none" / "a.subdivision")
    assert "check the name" in window.banner.words.text()
    assert window.document.path == tmp_path / "a.subdivision"


def test_a_broken_session_is_a_sentence_with_its_line_and_nothing_is_lost(qtbot, window, tmp_path):
    told = arrange(window)
    (tmp_path / "bad.subdivision").write_text(kept(window.session.state).replace('"labels": true', '"labels": yes'))
    window.open_file(str(tmp_path / "bad.subdivision"))
    rested(qtbot, window)
    assert "bad.subdivision, line 2" in window.banner.words.text()
    assert document(window.session.state) == told
    assert window.windowTitle() == "Subdivision Studio"


def test_sessions_and_meshes_are_dropped_on_the_window(qtbot, window, tmp_path):
    told = arrange(window)
    window.save_session_to(tmp_path / "dropped.subdivision")
    (tmp_path / "mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3 4\n")
    for name in ("mesh.obj", "dropped.subdivision"):
        data = QMimeData()
        data.setUrls([QUrl.fromLocalFile(str(tmp_path / name))])
        where = QPoint(100, 100), Qt.DropAction.CopyAction, data, Qt.MouseButton.LeftButton
        entering = QDragEnterEvent(*where, Qt.KeyboardModifier.NoModifier)
        window.dragEnterEvent(entering)
        assert entering.isAccepted()
        window.dropEvent(QDropEvent(QPointF(100, 100), *where[1:], Qt.KeyboardModifier.NoModifier))
        rested(qtbot, window)
        assert (window.session.state.lesson.id == "laboratory") == (name == "mesh.obj")
    assert document(window.session.state) == told


def test_files_are_offered_again_and_those_that_are_gone_say_so(qtbot, window, tmp_path):
    arrange(window)
    for k in range(9):
        window.session.do(seek, 0.1 * k)
        window.save_session_to(tmp_path / f"{k}.subdivision")
    menu = next(a.menu() for a in window.menuBar().actions()[0].menu().actions() if a.menu())
    _list_recent(window, menu)
    names = [a.text() for a in menu.actions()]
    assert names == [f"{k}.subdivision" for k in range(8, 0, -1)]
    menu.actions()[3].trigger()
    rested(qtbot, window)
    assert window.document.path == tmp_path / "5.subdivision"
    assert window.document.recent()[0] == tmp_path / "5.subdivision"
    (tmp_path / "7.subdivision").unlink()
    _list_recent(window, menu)
    next(a for a in menu.actions() if a.text() == "7.subdivision").trigger()
    assert "7.subdivision is no longer there" in window.banner.words.text()
    assert tmp_path / "7.subdivision" not in window.document.recent()


def test_a_link_is_copied_and_pasted(window):
    told = arrange(window)
    press(window, Qt.Key.Key_L)
    word = QGuiApplication.clipboard().text()
    assert word.startswith(HEAD)
    assert document(followed(word)) == told
    elsewhere(window)
    press(window, Qt.Key.Key_V)
    assert document(window.session.state) == told
    window.session.undo()
    assert window.session.state.lesson.id == "laboratory"
    QGuiApplication.clipboard().setText(word[:-9])
    press(window, Qt.Key.Key_V)
    assert "not come whole" in window.banner.words.text()
    QGuiApplication.clipboard().setText("hello")
    press(window, Qt.Key.Key_V)
    assert "no link of this program" in window.banner.words.text()


def test_the_search_box_pastes_for_itself(window):
    state = window.session.state
    QGuiApplication.clipboard().setText("torus")
    window.find_lesson()
    press(window, Qt.Key.Key_V)
    assert window.contents.search.text() == "torus"
    assert window.session.state is state
    assert not window.banner.isVisible()


def test_the_end_asks_about_what_is_not_saved(window, tmp_path, monkeypatch):
    arrange(window)
    window.save_session_to(tmp_path / "a.subdivision")
    window.session.do(choose, net=False)
    buttons = QMessageBox.StandardButton
    monkeypatch.setattr(type(window), "ask_to_save", lambda _: buttons.Cancel)
    assert not window.close()
    assert window.isVisible()
    monkeypatch.setattr(type(window), "ask_to_save", lambda _: buttons.Save)
    assert window.close()
    assert not read(tmp_path / "a.subdivision").options.net


# -- the view is undone too ---------------------------------------------------------------------


def test_a_turn_of_the_camera_is_one_change_to_undo(qtbot, window):
    widget, before = window.viewport.canvas, window.viewport.cameras()[0].position
    QTest.mousePress(widget, Qt.MouseButton.LeftButton, pos=QPoint(60, 80))
    for k in range(1, 6):
        QTest.mouseMove(widget, QPoint(60 + 12 * k, 80 + 4 * k))
    QTest.mouseRelease(widget, Qt.MouseButton.LeftButton, pos=QPoint(120, 100))
    turned = window.viewport.cameras()[0].position
    assert not np.allclose(turned, before)
    for _ in range(5):
        here = QPointF(200, 150)
        wheel = QWheelEvent(
            here, widget.mapToGlobal(here), QPoint(), QPoint(0, 120), Qt.MouseButton.NoButton,
            Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, False,
        )  # fmt: skip
        QApplication.sendEvent(widget, wheel)
    nearer = window.viewport.cameras()[0].position
    press(window, Qt.Key.Key_R, Qt.KeyboardModifier.NoModifier)
    assert np.allclose(window.viewport.cameras()[0].position, before)
    for there in (nearer, turned, before):
        press(window, Qt.Key.Key_Z)
        assert np.allclose(window.viewport.cameras()[0].position, there)
    assert not window.session.can_undo
    press(window, Qt.Key.Key_Z, CTRL | SHIFT)
    assert np.allclose(window.viewport.cameras()[0].position, turned)


def test_another_lesson_is_seen_as_it_is_meant_to_be_and_undo_brings_the_turn_back(window):
    window.session.do(turn_view, TURN)
    turned = window.viewport.cameras()[0].position
    window.session.do(open_lesson, lessons.find("14"))
    assert window.session.state.turn == REST
    window.session.undo()
    assert np.allclose(window.viewport.cameras()[0].position, turned)


def test_turning_while_a_stage_plays_is_one_change(qtbot, window):
    window.session.do(forward)
    for k in range(5):
        window.session.do(turn_view, REST.rotated(0.01 * k, 0.1))
        qtbot.wait(30)
    window.session.let_go()
    window.session.undo()
    assert window.session.state.turn == REST
    window.session.undo()
    assert not window.session.can_undo


# -- after a crash ------------------------------------------------------------------------------

PROGRAM = """
import sys
from pathlib import Path
from PySide6.QtCore import QTimer
from app.gui.application import application, first_state
from app.gui.autosave import Autosave
from app.gui.session import Session
from app.state import choose, drag, open_lesson, turn_view
from lessons.turn import REST
import lessons
app = application()
session = Session(first_state(None, None, "light", False))
autosave = Autosave(session, Path(sys.argv[1]))
session.do(open_lesson, lessons.find("14"), 5)
session.do(drag, 3, (1.0, -0.25, 1 / 3))
session.do(turn_view, REST.rotated(0.2, 0.1).zoomed(1.3))
session.do(choose, labels=True, ghost=False)
count = 0
def go_on():
    global count
    count += 1
    session.do(drag, 3, (1.0, -0.25, count / 3))
    autosave.keep()
if sys.argv[2] == "busy":
    timer = QTimer(interval=0)
    timer.timeout.connect(go_on)
    timer.start()
if sys.argv[2] == "well":
    QTimer.singleShot(2500, app.quit)
print("ready", flush=True)
app.exec()
autosave.end()
"""


def program(folder: Path, how: str) -> subprocess.Popen:
    found = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(folder), how], stdout=subprocess.PIPE, text=True,
        cwd=Path(__file__).parents[2],
    )  # fmt: skip
    with found.stdout as said:
        assert said.readline() == "ready\n"
    return found


def test_what_was_open_when_the_program_died_is_offered_and_restored(qtbot, window, tmp_path):
    told = arrange(window)
    elsewhere(window)
    child = program(tmp_path, "idle")
    running = Autosave(window.session, tmp_path)
    assert running.left is None  # the other program lives
    qtbot.waitUntil(lambda: list(tmp_path.glob("*.subdivision")) != [], timeout=8000)
    beside = Autosave(window.session, tmp_path)
    assert beside.left is None
    child.send_signal(signal.SIGKILL)
    child.wait()
    autosave = Autosave(window.session, tmp_path)
    window.offer_to_restore(autosave)
    assert window.banner.accept.isVisible()
    assert window.banner.accept.text() == "Restore what was open"
    window.session.do(last)
    assert window.banner.accept.isVisible()
    QTest.mouseClick(window.banner.accept, Qt.MouseButton.LeftButton)
    found = document(window.session.state)
    assert {k: v for k, v in found.items() if k != "laboratory"} == told
    assert not window.banner.isVisible()
    for each in (running, beside, autosave):
        each.end()
    assert list(tmp_path.iterdir()) == []


def test_a_program_that_dies_while_it_writes_leaves_a_whole_file(tmp_path, qtbot):
    for k in range(3):
        child = program(tmp_path, "busy")
        qtbot.waitUntil(lambda k=k: len(list(tmp_path.glob("*.subdivision"))) > k, timeout=8000)
        time.sleep(0.1 + 0.037 * k)
        child.send_signal(signal.SIGKILL)
        child.wait()
    files = list(tmp_path.glob("*.subdivision"))
    assert len(files) == 3
    for path in files:
        assert read(path).edits[0][1][2] >= 1 / 3


def test_a_program_that_ends_well_leaves_nothing(tmp_path, window):
    child = program(tmp_path, "well")
    assert child.wait(20) == 0
    assert list(tmp_path.iterdir()) == []
    autosave = Autosave(window.session, tmp_path)
    window.offer_to_restore(autosave)
    assert not window.banner.isVisible()
    autosave.end()


def test_keeping_costs_the_window_s_thread_next_to_nothing(qtbot, window, tmp_path):
    arrange(window)
    autosave = Autosave(window.session, tmp_path)
    spent = []
    for k in range(8):
        window.session.do(choose, net=bool(k % 2))
        begin = time.perf_counter()
        autosave.keep()
        spent.append(time.perf_counter() - begin)
        autosave._writer.waitForDone(5000)
    assert min(spent) < 0.005
    qtbot.waitUntil(lambda: list(tmp_path.glob("*.subdivision")) != [], timeout=5000)
    autosave.end()


def test_a_folder_that_cannot_be_written_is_said_once(qtbot, window, tmp_path):
    (tmp_path / "file").write_text("")
    autosave = Autosave(window.session, tmp_path / "file")
    said = []
    autosave.failed.connect(said.append)
    for net in (False, True, False):
        window.session.do(choose, net=net)
        autosave.keep()
    autosave._writer.waitForDone(5000)
    qtbot.wait(20)
    assert len(said) == 1
    autosave.end()

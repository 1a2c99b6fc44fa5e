"""Lessons of one's own in the real window: agreed to, loaded, reloaded, and the last good version when one breaks."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QMessageBox

import lessons
from app.authoring.recording import difference, picture
from app.authoring.shelf import remembered
from app.export.wish import Wish
from app.gui.consent import Consent
from app.gui.contents import FAULT, LESSON
from app.laboratory import bench
from app.state import at_stop, drag, last, open_lesson, skip, start, stops

pytestmark = pytest.mark.window


@pytest.fixture(autouse=True)
def no_question(monkeypatch):
    """The question at the end is answered by whoever asks for it."""
    monkeypatch.setattr("app.gui.window.Window.ask_to_save", lambda _: QMessageBox.StandardButton.Discard)


HEAD = """\
from lessons.script import lesson, play, show
from subdivision import shapes, trace
from subdivision.schemes import CATMULL_CLARK


@lesson("A corner of my own")
def corner():
    told = trace(CATMULL_CLARK, shapes.cube(), levels=1)
    yield show(told, None, "A cube.")
    yield play(told, told.stages[0], "Topology.")
"""


@pytest.fixture
def folder(tmp_path) -> Path:
    (found := tmp_path / "mine").mkdir()
    (found / "corner.py").write_text(HEAD)
    return found


def answering(button: str) -> list[Consent]:
    """Whoever is asked presses a button, found by what it is called in the dialog."""
    asked: list[Consent] = []

    def press():
        dialog = QApplication.activeModalWidget()
        assert isinstance(dialog, Consent)
        assert dialog.later.isDefault()
        asked.append(dialog)
        QTest.mouseClick(getattr(dialog, button), Qt.MouseButton.LeftButton)

    QTimer.singleShot(200, press)
    return asked


def rested(qtbot, window):
    qtbot.waitUntil(lambda: not window.authoring.is_busy, timeout=20_000)


def listed(window) -> dict[str, str]:
    """Every lesson in the list by its title, and what is wrong with its file."""
    model = window.contents._model
    rows = [model.item(k) for k in range(model.rowCount())]
    return {row.data(LESSON).title: row.data(FAULT) for row in rows if row.data(LESSON) is not None}


def opened(qtbot, window, folder, monkeypatch):
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(folder))
    asked = answering("run")
    window.actions_by_id["lessons_folder"].trigger()
    assert len(asked) == 1
    rested(qtbot, window)
    window.activateWindow()  # as a window manager does when a dialog has gone
    qtbot.waitUntil(lambda: window.isActiveWindow(), timeout=5000)


def test_a_folder_runs_only_after_the_user_agreed_and_is_not_asked_for_again(qtbot, window, folder, monkeypatch):
    (folder / "corner.py").write_text(HEAD + f"\nopen({str(folder.parent / 'it ran')!r}, 'a').close()\n")
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(folder))
    asked = answering("later")
    window.actions_by_id["lessons_folder"].trigger()
    assert len(asked) == 1
    assert not (folder.parent / "it ran").exists()
    assert "were not run" in window.banner.words.text()
    assert "A corner of my own" not in listed(window)
    opened(qtbot, window, folder, monkeypatch)
    assert (folder.parent / "it ran").exists()
    assert listed(window)["A corner of my own"] == ""
    assert "Lessons of your own: 1" in window.banner.words.text()
    place = window.authoring._place
    assert remembered(place).is_agreed(folder)
    assert not remembered(place).is_agreed(folder.parent)
    window.actions_by_id["lessons_folder"].trigger()  # asks nothing now
    rested(qtbot, window)
    window.session.do(open_lesson, lessons.find("corner"))
    assert window.session.state.now.text == "A cube."


def test_a_file_that_changes_is_shown_again_at_its_place_and_a_broken_one_is_named(qtbot, window, folder, monkeypatch):
    opened(qtbot, window, folder, monkeypatch)
    session, file = window.session, folder / "corner.py"
    session.do(open_lesson, lessons.find("corner"))
    session.do(last)
    session.do(drag, 0, (2.0, 2.0, 2.0))
    at = session.state.at
    window.save_session_to(folder.parent / "talk.subdivision")
    file.write_text(HEAD.replace('"Topology."', '"New words."'))
    qtbot.waitUntil(lambda: session.state.now.text == "New words.", timeout=20_000)
    assert (session.state.at, session.state.edits) == (at, ((0, (2.0, 2.0, 2.0)),))
    assert window.banner.words.text() == "Reloaded corner.py"
    assert not window.isWindowModified()
    session.undo()
    assert session.state.now.text == "New words."
    assert session.state.edits == ()
    (half := folder / "corner.tmp").write_text(HEAD + "    yield 1 / 0\n")
    half.replace(file)  # as editors do that write beside
    qtbot.waitUntil(lambda: "corner.py, line 11" in window.banner.words.text(), timeout=20_000)
    assert "ZeroDivisionError" in window.banner.words.text()
    assert session.state.now.text == "New words."
    assert "line 11" in listed(window)["A corner of my own"]
    window.export_to(Wish("png", of="view"), folder.parent / "out")
    assert "Nothing was exported" in window.banner.words.text()
    (half := folder / "corner.tmp").write_text(HEAD)
    half.replace(file)
    qtbot.waitUntil(lambda: session.state.now.text == "Topology.", timeout=20_000)
    assert listed(window)["A corner of my own"] == ""
    window.export_to(Wish("png", of="view"), folder.parent / "out.png")
    qtbot.waitUntil(lambda: not window.exporter.is_busy, timeout=60_000)
    assert (folder.parent / "out.png").exists(), window.banner.words.text()
    file.unlink()
    qtbot.waitUntil(lambda: "corner" not in {each.id for each in lessons.all_lessons()}, timeout=20_000)
    assert session.state.now.text == "Topology."


def test_one_that_never_ends_is_stopped_and_listed_while_the_window_lives(qtbot, window, folder, monkeypatch):
    monkeypatch.setattr("app.authoring.trial.SECONDS", 2)
    monkeypatch.setattr("app.gui.trials.command", lambda path, taken: _short(path, taken))
    (folder / "ever.py").write_text("while True:\n    pass\n")
    opened(qtbot, window, folder, monkeypatch)
    assert listed(window)["A corner of my own"] == ""
    assert "takes longer than" in listed(window)["ever.py"]
    window.banner.hide()
    window.contents.search.setText("ever")
    window.contents.search.returnPressed.emit()
    assert "ever.py, line" in window.banner.words.text()
    before = window.session.state.at, window.session.state.beat
    window.session.do(skip, 1)
    assert (window.session.state.at, window.session.state.beat) != before


def test_a_reading_that_fails_on_the_screen_is_named_and_the_window_lives(qtbot, window, folder, monkeypatch):
    words = 'Path(__file__).with_name("here").read_text()'
    text = HEAD.replace("from lessons", "from pathlib import Path\n\nfrom lessons", 1)
    (folder / "corner.py").write_text(text + f'    yield show(told, None, "M.", reading=lambda mesh: {words})\n')
    (folder / "here").write_text("fine")
    opened(qtbot, window, folder, monkeypatch)
    window.session.do(open_lesson, lessons.find("corner"))
    (folder / "here").unlink()
    window.session.do(last)
    qtbot.waitUntil(lambda: "FileNotFoundError" in window.banner.words.text(), timeout=20_000)
    assert "corner.py, line 13" in window.banner.words.text()
    assert window.session.state.now.text == "M."


def test_a_new_lesson_is_written_loaded_and_shown(qtbot, window, folder, monkeypatch):
    shown = []
    monkeypatch.setattr("app.gui.authoring.QDesktopServices.openUrl", lambda url: shown.append(url.toLocalFile()))
    opened(qtbot, window, folder, monkeypatch)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(folder / "My first one"), ""))
    window.actions_by_id["new_lesson"].trigger()
    qtbot.waitUntil(lambda: window.session.state.lesson.id == "my_first_one", timeout=20_000)
    assert window.session.state.lesson.title == "My first one"
    assert shown == [str(folder)]
    window.actions_by_id["new_lesson"].trigger()
    assert "choose another name" in window.banner.words.text()


def test_what_is_shown_is_recorded_by_one_key_into_a_lesson_that_shows_it(qtbot, window, folder, monkeypatch):
    opened(qtbot, window, folder, monkeypatch)
    asked = []
    monkeypatch.setattr(QFileDialog, "getSaveFileName",
                        lambda *a, **k: (asked.append(a), (str(folder / "My talk"), ""))[1])
    session = window.session
    session.do(bench.enter)
    session.do(last)
    session.do(drag, 0, (1.5, 1.5, 1.5))
    for _ in range(2):
        window.banner.hide()
        shown = picture(session.state)
        QTest.keyClick(window.windowHandle(), Qt.Key.Key_R, Qt.KeyboardModifier.ControlModifier)
        qtbot.waitUntil(lambda: "Recorded as the last step of my_talk.py" in window.banner.words.text()
                        and window.banner.isVisible(), timeout=20_000)
        rested(qtbot, window)
        talk = lessons.find("my_talk")
        assert difference(shown, picture(at_stop(start(talk, session.state.options), stops(talk)[-1]))) == ""
        session.do(skip, -1)
    assert len(asked) == 1  # once for each lesson
    assert len(talk.beats) == 2
    assert session.state.lesson.id == "laboratory"
    (folder / "my_talk.py").write_text("broken(\n")
    qtbot.waitUntil(lambda: "never closed" in window.banner.words.text(), timeout=20_000)
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_R, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(lambda: "Nothing was recorded" in window.banner.words.text(), timeout=20_000)
    assert (folder / "my_talk.py").read_text() == "broken(\n"


def _short(path, taken):
    from app.authoring.trial import command

    return command(path, taken, 2)

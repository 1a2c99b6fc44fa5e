"""Export from the window: the dialog, the process beside it, cancelling, and what is left."""

import json

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QFileDialog

import lessons
from app.export import FORMATS, Wish
from app.export.making import export
from app.gui import export as dialogs
from app.gui.export import ExportDialog
from app.state import last, open_lesson, turn_view
from lessons.turn import Turn

pytestmark = pytest.mark.window

SMALL = (320, 180)


@pytest.fixture
def cube(window):
    """The window at the last step of a lesson that a process of its own can find."""
    window.session.do(open_lesson, lessons.find("figure_14_cube"))
    window.session.do(last)
    return window


def over(qtbot, window):
    qtbot.waitUntil(lambda: not window.exporter.is_busy, timeout=60_000)
    return window.banner.words.text()


def left_in(folder):
    return sorted(path.name for path in folder.iterdir() if path.suffix != ".ini")


def test_the_view_is_exported_as_it_is_seen_while_the_window_goes_on(cube, qtbot, tmp_path):
    cube.session.do(turn_view, Turn(around=0.7, zoom=1.3))
    cube.export_to(Wish("svg", "view", SMALL), tmp_path / "view")
    assert cube.exporter.is_busy
    assert not cube.banner.isHidden()
    assert "Exporting view.svg" in cube.banner.words.text()
    assert over(qtbot, cube) == f"Exported {tmp_path / 'view.svg'}"
    export(cube.session.state, Wish("svg", "view", SMALL), tmp_path / "own.svg")
    assert (tmp_path / "view.svg").read_bytes() == (tmp_path / "own.svg").read_bytes()
    assert left_in(tmp_path) == ["own.svg", "view.svg"]


def test_progress_is_in_the_banner_and_cancel_leaves_nothing(cube, qtbot, tmp_path):
    cube.export_to(Wish("gif", "lesson", (640, 360)), tmp_path / "a.gif")
    qtbot.waitUntil(lambda: "%" in cube.banner.words.text(), timeout=60_000)
    assert left_in(tmp_path) != []
    qtbot.mouseClick(cube.banner._cancel, Qt.MouseButton.LeftButton)
    assert over(qtbot, cube) == "The export was cancelled; nothing is left of it."
    assert left_in(tmp_path) == []


def test_closing_the_window_stops_an_export(cube, qtbot, tmp_path):
    cube.export_to(Wish("gif", "lesson", (640, 360)), tmp_path / "a.gif")
    qtbot.waitUntil(lambda: left_in(tmp_path) != [], timeout=60_000)
    cube.exporter.stop()
    assert left_in(tmp_path) == []


def test_one_export_at_a_time_and_faults_are_told(cube, qtbot, tmp_path):
    cube.export_to(Wish("svg", "view", SMALL), tmp_path / "no" / "a.svg")
    cube.export_to(Wish("svg", "view", SMALL), tmp_path / "b.svg")
    assert "is under way" in cube.banner.words.text()
    assert "There is no folder" in over(qtbot, cube)
    assert left_in(tmp_path) == []


def test_the_dialog_asks_only_what_makes_a_difference(window):
    dialog = ExportDialog(window, "light", Wish("pptx"))
    dialog.show()
    rows = {"size": dialog.pixels, "background": dialog.background, "pace": dialog.pace, "limit": dialog.limit}
    for name, kind in FORMATS.items():
        dialog.format.setCurrentIndex(dialog.format.findData(name))
        assert {row for row, box in rows.items() if box.isVisible()} == set(kind.wants), name
        assert dialog.wish.format == name
    dialog.close()


def test_the_dialog_says_what_cannot_be(window):
    dialog = ExportDialog(window, "light", Wish("png"))
    dialog.background.setCurrentIndex(dialog.background.findData("black"))
    assert "black hides" in dialog.remark.text()
    assert not dialog.go.isEnabled()
    dialog.background.setCurrentIndex(dialog.background.findData("transparent"))
    assert dialog.go.isEnabled()
    dialog.pixels.setCurrentText("large")
    assert "is no size" in dialog.remark.text()
    dialog.pixels.setCurrentText("800x600")
    assert dialog.wish.size == (800, 600)
    dialog.format.setCurrentIndex(dialog.format.findData("mp4"))
    assert dialog.wish.background == "theme"
    boxes = (dialog.of, dialog.format, dialog.pixels, dialog.background, dialog.pace, dialog.limit)
    assert all(box.accessibleName() and box.toolTip() for box in boxes)


def test_the_key_opens_the_dialog_and_the_choice_is_made(cube, qtbot, tmp_path, monkeypatch):
    shown = []

    def chosen(dialog):
        dialog.of.setCurrentIndex(dialog.of.findData("view"))
        dialog.format.setCurrentIndex(dialog.format.findData("glb"))
        shown.append(dialog.windowTitle())
        return ExportDialog.DialogCode.Accepted

    monkeypatch.setattr(dialogs.ExportDialog, "exec", chosen)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "cube"), ""))
    qtbot.keyClick(
        QApplication.focusWidget() or cube, Qt.Key.Key_E,
        Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier,
    )  # fmt: skip
    qtbot.waitUntil(lambda: shown == ["Export"], timeout=2000)
    over(qtbot, cube)
    data = (tmp_path / "cube.glb").read_bytes()
    assert json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])["asset"]["version"] == "2.0"


def test_a_picture_is_saved_as_pdf_too_and_copied_at_the_same_time(qtbot, window, tmp_path):
    window.save_picture_to(str(tmp_path / "a.pdf"))
    window.copy_picture()
    qtbot.waitUntil(lambda: not (window.saver.is_busy or window.copier.is_busy), timeout=20000)
    assert QGuiApplication.clipboard().image().width() >= 1920
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")

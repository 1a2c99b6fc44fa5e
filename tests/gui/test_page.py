"""File > Export page… writes the lesson that is open, as the command does."""

from pathlib import Path

import pytest
from PySide6.QtWidgets import QFileDialog

import lessons
from app.page import page_of
from app.state import Options, open_lesson, start

pytestmark = pytest.mark.window


def test_the_menu_writes_the_page_of_the_open_lesson(window, qtbot, tmp_path, monkeypatch):
    window.session.do(open_lesson, lessons.find("figure_14_cube"))
    wanted = tmp_path / "cube.html"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(wanted), ""))
    window.actions_by_id["page"].trigger()
    qtbot.waitUntil(lambda: not window.exporter.is_busy, timeout=60_000)
    assert window.banner.words.text() == f"Exported {wanted}"
    assert wanted.read_bytes() == page_of(start(lessons.find("figure_14_cube"), Options()))
    assert [path.name for path in Path(tmp_path).iterdir() if path.suffix == ".html"] == ["cube.html"]

"""The window in another language: nothing in it is forgotten, and it changes while it stands."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QComboBox, QListView, QWidget

import lessons
from app import words
from app.gui.export import ExportDialog
from app.gui.keys import COMMANDS, MOUSE
from app.gui.session import Session
from app.gui.window import Window
from app.laboratory import bench
from app.sessions.link import link
from app.state import Options, Picked, choose, forward, last, open_lesson, pick, settle, start, toggle
from app.words import ENGLISH, speak, tr
from tests.words.__main__ import gathered
from tests.words.pseudo import PSEUDO, Pseudo, bare

pytestmark = pytest.mark.window

OF_QT = {"Cancel"}
"""Qt's own words, which it translates itself into the languages it has."""

READ = ("text", "toolTip", "accessibleName", "accessibleDescription", "placeholderText", "windowTitle", "title")
"""What a widget says, where it says any of it."""


@pytest.fixture(autouse=True)
def english():
    yield
    speak(ENGLISH)


@pytest.fixture(scope="module")
def pseudo():
    return Pseudo({one for one, _ in gathered()})


@pytest.fixture
def abroad(qtbot, settings, monkeypatch, pseudo):
    """The window in the language in which every text is between brackets."""
    monkeypatch.setattr(words, "catalogue", lambda code: pseudo)
    for left in QApplication.topLevelWidgets():  # of earlier windows, in other languages
        left.deleteLater()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    found = Window(Session(start(lessons.find("14"), Options(language=PSEUDO))), settings)
    qtbot.addWidget(found)
    found.resize(1280, 720)
    with qtbot.waitExposed(found):
        found.show()
    return found


def shown(root: QWidget) -> Iterator[str]:
    """Every text of a widget and of all inside."""
    for each in (root, *root.findChildren(QWidget)):
        yield from (str(getattr(each, name)()) for name in READ if callable(getattr(each, name, None)))
        if isinstance(each, QComboBox):
            yield from (each.itemText(k) for k in range(each.count()))
        if isinstance(each, QListView) and each.model() is not None:
            yield from (str(each.model().index(k, 0).data()) for k in range(each.model().rowCount()))
    for action in root.findChildren(QAction):
        yield from (action.text(), action.toolTip())


def forgotten() -> set[str]:
    """Texts that are seen somewhere and were not translated."""
    QApplication.processEvents()
    seen = {text for root in QApplication.topLevelWidgets() for text in shown(root)}
    return {bare(text) for text in seen if text not in OF_QT} - {""}


def test_no_word_of_the_window_is_forgotten(abroad):
    session = abroad.session
    for menu in (action.menu() for action in abroad.menuBar().actions()):
        for inside in (menu, *(action.menu() for action in menu.actions() if action.menu() is not None)):
            inside.aboutToShow.emit()
    assert forgotten() == set()
    abroad.presenter.open(abroad)
    for name in ("1", "4", "13", "20", "motivation", "4.2"):
        session.do(open_lesson, lessons.find(name))
        session.do(last)
        assert forgotten() == set(), name
    for option in ("matrix", "spectrum", "distances", "limit", "valences"):
        session.do(toggle, option)
    abroad.presenter.close()
    session.do(bench.enter)
    for name in ("cube", "quad-fan", "polygon", "landscape", "three-direction-net"):
        session.do(bench.take, name)
        assert forgotten() == set(), name
        session.do(pick, Picked("vertex", (0,)))
        session.do(forward)
        session.do(settle)
        assert forgotten() == set(), name
    session.do(bench.take, "cube")
    session.do(bench.compare)
    assert forgotten() == set()


def test_no_word_of_a_dialog_is_forgotten(abroad):
    dialog = ExportDialog(abroad, "light", abroad._wish)
    for kind in ("png", "gif", "obj", "html"):
        dialog.format.setCurrentIndex(dialog.format.findData(kind))
        assert forgotten() == set(), kind
    dialog.deleteLater()
    table = [text for command in COMMANDS for text in (command.name, command.group)]
    assert [text for text in (*table, *(text for row in MOUSE for text in row)) if bare(tr(text))] == []
    abroad.open_recent(Path("gone.obj"))
    assert "⟦" in abroad.banner.words.text()


def test_the_language_changes_while_the_window_stands(qtbot, window):
    session, viewport = window.session, window.viewport
    session.do(toggle, "labels")
    titles = [action.text() for action in window.menuBar().actions()]
    window.actions_by_id["language_de"].trigger()
    qtbot.waitUntil(lambda: not window.is_changing)
    assert window.viewport is viewport
    assert [action.text() for action in window.menuBar().actions()][:2] == ["&Datei", "&Bearbeiten"]
    assert window.actions_by_id["forward"].text() == "Nächste Phase"
    assert [entry.text for entry in viewport.picture().legend] == ["ursprünglich"]
    assert window.settings.value("language") == "de"
    session.undo()
    assert (session.state.options.labels, session.state.options.language) == (False, "de")
    window.actions_by_id["language_en"].trigger()
    qtbot.waitUntil(lambda: not window.is_changing)
    assert [action.text() for action in window.menuBar().actions()] == titles


def test_a_link_keeps_the_readers_language(window):
    told = link(choose(window.session.state, language="de"))
    QApplication.clipboard().setText(told)
    window.paste_link()
    assert window.session.state.options.language == ENGLISH

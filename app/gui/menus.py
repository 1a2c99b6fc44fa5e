"""The menus: commands by their names, and nothing that does nothing."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

from PySide6.QtGui import QActionGroup
from PySide6.QtWidgets import QMenu

import lessons
from app.draw.pointed import ACROSS
from app.draw.theme import THEMES
from app.gui.editing import EDITS, SHARPNESS
from app.gui.look import SCALES
from app.gui.shown import SHOWN
from app.gui.surface import SWITCHES
from app.gui.timeline import SPEEDS
from app.state import open_lesson
from app.words import LANGUAGES, SYSTEM, tr

if TYPE_CHECKING:
    from app.gui.window import Window

MENUS = (
    ("File", ("open", "@Recent", "lessons_folder", "", "save", "save_as", "copy_link", "paste_link", "",
              "save_picture", "copy", "export", "page", "", "quit")),
    ("Edit", ("undo", "redo", "", *(edit[0] for edit in EDITS), "", *(turn[0] for turn in SHARPNESS))),
    ("View", ("@Theme", "@Language", "@Interface scale", "reduced_motion", "", *(option for option, _, _ in SHOWN), "",
              *(option for option, _, _ in SWITCHES), "surface_next", "", *(f"across_{k}" for k in ACROSS), "",
              "camera", "contents", "shown")),
    ("Lesson", ("forward", "back", "play", "", "level_up", "level_down", "", "first", "last", "", "more", "less",
                "more_2", "less_2", "", "through",
                "@Speed", "", "asking", "take_back", "", "search", "@Lessons", "", "record", "new_lesson",
                "show_folder")),
    ("Present", ("present", "presenter", "blank", "", "laser", "magnifier")),
    ("Help", ("manual", "keys", "about")),
)  # fmt: skip
"""Title -> commands; a gap is a line, and ``@`` begins a menu inside."""


def fill(window: "Window") -> None:
    """Hang all menus into the window's menu bar."""
    inside = {
        "@Recent": _recent, "@Theme": _themes, "@Language": _languages, "@Interface scale": _scales,
        "@Speed": _speeds, "@Lessons": _lessons,
    }  # fmt: skip
    for name, ids in MENUS:
        menu = window.menuBar().addMenu("&" + tr(name))  # Alt and its first letter open it
        for id_ in ids:
            if not id_:
                menu.addSeparator()
            elif id_ in inside:
                inside[id_](window, menu.addMenu(tr(id_[1:])))
            else:
                menu.addAction(window.actions_by_id[id_])


def _recent(window: "Window", menu: QMenu) -> None:
    menu.setTitle(tr("Open recent"))
    menu.setToolTipsVisible(True)
    menu.aboutToShow.connect(lambda: _list_recent(window, menu))


def _list_recent(window: "Window", menu: QMenu) -> None:
    menu.clear()
    for path in window.document.recent():
        action = menu.addAction(path.name.replace("&", "&&"))
        action.setToolTip(str(path))
        action.triggered.connect(lambda _, path=path: window.open_recent(path))
    if menu.isEmpty():
        menu.addAction(window.actions_by_id["open"])


def _themes(window: "Window", menu: QMenu) -> None:
    _choices(window, menu, [f"theme_{name}" for name in (*THEMES, "system")])
    menu.aboutToShow.connect(lambda: window.actions_by_id[f"theme_{window.theme_choice()}"].setChecked(True))


def _languages(window: "Window", menu: QMenu) -> None:
    _choices(window, menu, [f"language_{code}" for code in (*LANGUAGES, SYSTEM)])
    menu.aboutToShow.connect(lambda: window.actions_by_id[f"language_{window.language_choice()}"].setChecked(True))


def _choices(window: "Window", menu: QMenu, ids: Iterable[str]) -> None:
    """Commands of which one holds at a time."""
    group = QActionGroup(menu)
    for id_ in ids:
        action = window.actions_by_id[id_]
        action.setCheckable(True)
        group.addAction(action)
        menu.addAction(action)


def _scales(window: "Window", menu: QMenu) -> None:
    _choices(window, menu, [f"scale_{scale:.0%}".removesuffix("%") for scale in SCALES])
    menu.addSeparator()
    for id_ in ("larger", "smaller", "usual_size"):
        menu.addAction(window.actions_by_id[id_])


def _speeds(window: "Window", menu: QMenu) -> None:
    for speed in SPEEDS:
        menu.addAction(window.actions_by_id[f"speed_{speed:g}"])
    menu.addSeparator()
    for id_ in ("faster", "slower"):
        menu.addAction(window.actions_by_id[id_])


def _lessons(window: "Window", menu: QMenu) -> None:
    menu.aboutToShow.connect(lambda: _list_lessons(window, menu))


def _list_lessons(window: "Window", menu: QMenu) -> None:
    menu.clear()
    section = ""
    for lesson in lessons.all_lessons():
        if lesson.section != section:
            section = lesson.section
            menu.addSection(tr(section))
        action = menu.addAction(tr(lesson.title))
        action.setCheckable(True)
        action.setChecked(lesson.id == window.session.state.lesson.id)
        action.triggered.connect(lambda _, lesson=lesson: window.session.do(open_lesson, lesson))

"""Every command of the window: one table for the menus, the keys and the sheet that lists the keys."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLineEdit,
    QWidget,
)

from app.asking import answers, is_open, predict, take_back
from app.draw.pointed import ACROSS
from app.gui.editing import EDITS, SHARPNESS
from app.gui.look import SCALES
from app.gui.shown import SHOWN
from app.gui.surface import NEXT, SWITCHES, show_next
from app.gui.timeline import SPEEDS, next_speed, spoken_speed
from app.gui.turns import OVER
from app.laboratory.editing import turn_sharpness
from app.state import (
    Options,
    State,
    choose,
    first,
    homeward,
    last,
    onward,
    skip,
    toggle,
    toggle_play,
    turn_knob,
    turn_level,
)
from app.words import LANGUAGES, SYSTEM, tr
from lessons.questions import MOST as MOST_ANSWERS
from subdivision.words import phrase

if TYPE_CHECKING:
    from app.gui.window import Window

Does: TypeAlias = "Callable[[Window], None]"


@dataclass(frozen=True)
class Command:
    """Something the user can do.

    ``keys`` as Qt spells them; ``on`` tells whether a switch is on; ``icon`` names a file of ``assets/icons``;
    ``when`` tells whether it can be done, so that a key may do one thing now and another then.
    """

    id: str
    name: str
    group: str
    keys: tuple[str, ...]
    does: Does
    on: Callable[[Options], bool] | None = None
    icon: str = ""
    repeats: bool = False
    when: Callable[[State], bool] | None = None


def _wish(transition: Callable[..., State], *args: object, **options: object) -> Does:
    return lambda w: w.session.do(transition, *args, **options)


def _edit(transition: Callable[..., State], *args: object) -> Does:
    return lambda w: w.editing.wish(transition, *args)


def _switch(option: str, name: str, key: str) -> Command:
    return Command(option, name, "View", (key,), _wish(toggle, option), lambda o: bool(getattr(o, option)))


def _theme(name: str) -> Command:
    return Command(f"theme_{name}", name.capitalize(), "Theme", (), lambda w: w.choose_theme(name))


def _language(code: str, name: str) -> Command:
    return Command(f"language_{code}", name, "Language", (), lambda w: w.choose_language(code))


def _speed(speed: float) -> Command:
    name = spoken_speed(speed)
    return Command(f"speed_{speed:g}", name, "Speed", (), _wish(choose, speed=speed), lambda o: o.speed == speed)


def _scale(scale: float) -> Command:
    name = f"{scale:.0%}"
    return Command(
        f"scale_{name[:-1]}", name, "Interface scale", (), lambda w: w.choose_scale(scale), lambda o: o.scale == scale
    )


def _across(key: int, across: str) -> Command:
    name = WEIGHTS[across]
    return Command(
        f"across_{across}", name, "View", (str(key),), _wish(choose, across=across), lambda o: o.across == across,
        when=lambda state: not answers(state),
    )  # fmt: skip


WEIGHTS = {
    "stage": "Weights across one stage",
    "step": "Weights across one whole step",
    "all": "Weights across all levels",
    "limit": "Weights across the limit",
}


def _answer(number: int) -> Command:
    name = phrase("Answer {number} to a question", number=number)
    return Command(
        f"answer_{number}", name, "Lesson", (str(number),), _wish(predict, number - 1),
        when=lambda state: number <= answers(state),
    )  # fmt: skip


def _pace(by: int) -> Does:
    return lambda w: w.session.do(choose, speed=held_speed(w.session.state.options.speed, by))


def held_speed(speed: float, by: int) -> float:
    """The next speed, or the same at either end."""
    following = next_speed(speed, by)
    return following if (following > speed) == (by > 0) else speed


COMMANDS = (
    Command("forward", "Next stage", "Lesson", ("PgDown", "Right"), _wish(onward), icon="forward", repeats=True),
    Command("back", "Previous stage", "Lesson", ("PgUp", "Left"), _wish(homeward), icon="back", repeats=True),
    Command("play", "Play or pause", "Lesson", ("Space",), _wish(toggle_play), icon="play"),
    Command("level_up", "Next level", "Lesson", ("]", "Up"), _wish(turn_level, 1), icon="level-up"),
    Command("level_down", "Previous level", "Lesson", ("[", "Down"), _wish(turn_level, -1), icon="level-down"),
    Command("skip", "Jump to the next stage", "Lesson", ("Shift+PgDown", "Shift+Right"), _wish(skip, 1)),
    Command("skip_back", "Jump to the stage before", "Lesson", ("Shift+PgUp", "Shift+Left"), _wish(skip, -1)),
    Command("first", "First stage", "Lesson", ("Home",), _wish(first), icon="first"),
    Command("last", "Last stage", "Lesson", ("End",), _wish(last), icon="last"),
    Command("through", "Play through stages", "Lesson", ("T",), _wish(toggle, "through"),
            lambda o: o.through, "through"),
    Command("faster", "Faster", "Lesson", ("+",), _pace(1)),
    Command("slower", "Slower", "Lesson", ("-",), _pace(-1)),
    Command("more", "More: degree, valence", "Lesson", ("Ctrl+Right",), _wish(turn_knob, 0, 1), repeats=True),
    Command("less", "Less: degree, valence", "Lesson", ("Ctrl+Left",), _wish(turn_knob, 0, -1), repeats=True),
    Command("more_2", "More of the second", "Lesson", ("Ctrl+Up",), _wish(turn_knob, 1, 1), repeats=True),
    Command("less_2", "Less of the second", "Lesson", ("Ctrl+Down",), _wish(turn_knob, 1, -1), repeats=True),
    Command("asking", "Ask for predictions", "Lesson", ("F6",), lambda w: w.toggle_asking(), lambda o: o.asking),
    *(_answer(number) for number in range(1, MOST_ANSWERS + 1)),
    Command("take_back", "Take the last prediction back", "Lesson", ("Backspace",), _wish(take_back),
            when=lambda state: is_open(state) and bool(state.predicted)),
    Command("search", "Find a lesson", "Lesson", ("Ctrl+K",), lambda w: w.find_lesson(), icon="search"),
    Command("record", "Record this view as a step…", "Lesson", ("Ctrl+R",), lambda w: w.recorder.choose()),
    Command("new_lesson", "New lesson…", "Lesson", (), lambda w: w.authoring.new_lesson()),
    Command("show_folder", "Show lessons folder", "Lesson", (), lambda w: w.authoring.show_folder()),
    Command("present", "Full screen", "Present", ("F5", "Shift+F5", "F11"), lambda w: w.toggle_presenting(),
            lambda o: o.presenting, "present"),
    Command("blank", "Blank the picture", "Present", (".", "B"), _wish(toggle, "blank"), lambda o: o.blank),
    Command("laser", "Laser pointer", "Present", ("F2",), lambda w: w.viewport.pointer.toggle()),
    Command("magnifier", "Magnify at the pointer", "Present", ("F3",), lambda w: w.viewport.toggle_magnifier()),
    Command("presenter", "Presenter's window", "Present", ("F4",), lambda w: w.toggle_presenter()),
    Command("escape", "Leave full screen, close what is open", "Present", ("Esc",), lambda w: w.escape()),
    *(_switch(option, name, key) for option, name, key in SHOWN),
    _switch("lattice", "Vectors of a box spline", "D"),
    *(_switch(option, name, key) for option, name, key in SWITCHES),
    Command("surface_next", "Surface shows the next", "View", (NEXT,), _wish(show_next)),
    *(_across(k, across) for k, across in enumerate(ACROSS, 1)),
    Command("contents", "Lessons panel", "View", ("F9",), lambda w: w.toggle_panel("contents"), icon="contents"),
    Command("shown", "Details panel", "View", ("F10",), lambda w: w.toggle_panel("details"), icon="shown"),
    Command("reduced_motion", "Reduced motion", "View", ("Ctrl+M",), lambda w: w.toggle_reduced_motion(),
            lambda o: o.reduced_motion),
    Command("larger", "Everything larger", "View", ("Ctrl++", "Ctrl+="), lambda w: w.turn_scale(1), repeats=True),
    Command("smaller", "Everything smaller", "View", ("Ctrl+-",), lambda w: w.turn_scale(-1), repeats=True),
    Command("usual_size", "Everything as large as usual", "View", ("Ctrl+0",), lambda w: w.choose_scale(1.0)),
    Command("camera", "Reset the view", "View", ("R",), lambda w: w.viewport.reset_camera()),
    Command("open", "Open…", "File", ("Ctrl+O",), lambda w: w.choose_file()),
    Command("lessons_folder", "Lessons folder…", "File", (), lambda w: w.authoring.choose_folder()),
    Command("save", "Save session", "File", ("Ctrl+S",), lambda w: w.save_session()),
    Command("save_as", "Save session as…", "File", ("Ctrl+Shift+S",), lambda w: w.save_session_as()),
    Command("copy_link", "Copy link", "File", ("Ctrl+L",), lambda w: w.copy_link()),
    Command("paste_link", "Paste link", "File", ("Ctrl+V",), lambda w: w.paste_link()),
    Command("save_picture", "Save picture as…", "File", ("Ctrl+E",), lambda w: w.save_picture()),
    Command("export", "Export…", "File", ("Ctrl+Shift+E",), lambda w: w.choose_export()),
    Command("page", "Export page…", "File", (), lambda w: w.choose_page()),
    Command("copy", "Copy picture", "File", ("Ctrl+C",), lambda w: w.copy_picture()),
    Command("quit", "Quit", "File", ("Ctrl+Q",), lambda w: w.quit()),
    Command("undo", "Undo", "Edit", ("Ctrl+Z",), lambda w: w.session.undo(), repeats=True),
    Command("redo", "Redo", "Edit", ("Ctrl+Shift+Z", "Ctrl+Y"), lambda w: w.session.redo(), repeats=True),
    *(Command(id_, name, "Edit", (key,) if key else (), _edit(how)) for id_, name, key, _, how in EDITS),
    *(Command(id_, name, "Edit", (key,), _edit(turn_sharpness, by), repeats=True) for id_, name, key, by in SHARPNESS),
    Command("manual", "Manual", "Help", ("F1",), lambda w: w.manual.open()),
    Command("keys", "Keys", "Help", ("?",), lambda w: w.toggle_keys()),
    Command("about", "About Subdivision Studio", "Help", (), lambda w: w.toggle_about()),
    *(_theme(name) for name in ("light", "dark", "projector", "system")),
    *(_language(code, name) for code, name in {SYSTEM: "System", **LANGUAGES}.items()),
    *(_speed(speed) for speed in SPEEDS),
    *(_scale(scale) for scale in SCALES),
)  # fmt: skip

BY_ID = {c.id: c for c in COMMANDS}

MOUSE = (
    ("Turn", phrase("drag")),
    ("Move", "Shift + drag, right drag"),
    ("Zoom", phrase("wheel")),
    ("Reset the view", "double click beside the points"),
    ("Why is a point here?", "point at it; click to keep it"),
    ("Move a control point", "drag it; hold X, Y or Z: along an axis"),
    ("Put it back", "double click it"),
    ("Predict", "click a place, a weight or a picture"),
    ("Pick a part to edit", "click it in the laboratory; Shift + click: more"),
)
"""What the mouse does, for the sheet of keys."""


PRINTED = {
    "PgDown": "Page Down", "PgUp": "Page Up", "Left": "←", "Right": "→", "Up": "↑", "Down": "↓", "-": "−",
    "Ctrl": phrase("Ctrl"), "Shift": phrase("Shift"), "Alt": phrase("Alt"), "Space": phrase("Space"),
    "Home": phrase("Home"), "End": phrase("End"), "Esc": phrase("Esc"), "Backspace": phrase("Backspace"),
    "Ins": phrase("Ins"), "Del": phrase("Del"),
}  # fmt: skip
"""What is printed on the keys, where it is not what Qt calls them."""


def spelled_keys(command: Command) -> tuple[str, ...]:
    """The keys as they are printed on keyboards."""
    return tuple("+".join(tr(PRINTED.get(part, part)) for part in _parts(key)) for key in command.keys)


def _parts(key: str) -> list[str]:
    return [*filter(None, key[:-1].split("+")), "+"] if key.endswith("+") else key.split("+")


HARMLESS = Qt.KeyboardModifier.ShiftModifier | Qt.KeyboardModifier.KeypadModifier


class KeyGuard(QObject):
    """Lets our keys through to their commands wherever the focus is.

    Qt asks the focus widget first whether it wants a key for itself.  A search box keeps what it can
    type, and its editing keys while there is something to edit; a number all plain keys; a list Up and Down; a button
    reached by Tab keeps Space; a widget with ``own_keys`` keeps those.  All other keys of the table are nobody's but
    the table's.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._ours = {QKeySequence(key).toString() for c in COMMANDS for key in c.keys}
        self._is_watching = False

    def watch(self, is_watching: bool) -> bool:
        """Look at what happens from now on, or not; whether it was so before."""
        was, self._is_watching = self._is_watching, is_watching
        app = QApplication.instance()
        if app is not None and was != is_watching:
            (app.installEventFilter if is_watching else app.removeEventFilter)(self)
        return was

    @contextmanager
    def away(self) -> Iterator[None]:
        """Look at nothing meanwhile: when all widgets change, thousands of events go round, and no key among them."""
        was = self.watch(False)
        try:
            yield
        finally:
            self.watch(was)

    def spared(self, steps: Iterator[object]) -> Iterator[None]:
        """Do steps, away in each of them and back between them."""
        while True:
            with self.away():
                if next(steps, OVER) is OVER:
                    return
            yield

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() != QEvent.Type.ShortcutOverride or not isinstance(event, QKeyEvent):
            return False
        if QApplication.activePopupWidget() or QApplication.activeModalWidget():
            return False
        kept = wants(QApplication.focusWidget(), event)
        if kept is None:
            return False
        event.setAccepted(kept)
        return kept or QKeySequence(event.keyCombination()).toString() in self._ours


def wants(focus: object, event: QKeyEvent) -> bool | None:
    """Whether the widget in focus keeps a key: yes, no, or as it says itself (None)."""
    key, plain = event.key(), not event.modifiers() & ~HARMLESS
    if isinstance(focus, QWidget) and getattr(focus.window(), "keeps_plain_keys", False):
        return plain or event.matches(QKeySequence.StandardKey.Copy)
    if own := getattr(focus, "own_keys", None):
        return plain and key in own
    if isinstance(focus, QAbstractSpinBox):
        return plain and key not in (Qt.Key.Key_PageDown, Qt.Key.Key_PageUp, Qt.Key.Key_Escape)
    if isinstance(focus, QLineEdit):
        if event.matches(QKeySequence.StandardKey.Paste):
            return None
        if focus.text() and key not in (Qt.Key.Key_PageDown, Qt.Key.Key_PageUp):
            return None
        is_typing = plain and event.text().isprintable() and event.text() != ""
        return is_typing or key in (Qt.Key.Key_Up, Qt.Key.Key_Down)
    if isinstance(focus, QComboBox):
        return plain and key in (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Space)
    if isinstance(focus, QAbstractItemView):
        return plain and key in (Qt.Key.Key_Up, Qt.Key.Key_Down)
    if isinstance(focus, QAbstractButton):
        return plain and key == Qt.Key.Key_Space
    return False

"""The panel of a lesson's knobs: numbers such as the degree or the valence, changed while it stands."""

from functools import partial

from PySide6.QtWidgets import QVBoxLayout, QWidget

from app.gui.look import GRID, px
from app.gui.parts import emptied, gap, heading
from app.gui.session import Session
from app.gui.stepper import Stepper
from app.state import State, turn_knob
from lessons.script import Knob

KEYS = (("Ctrl+←", "Ctrl+→"), ("Ctrl+↓", "Ctrl+↑"))
"""What lowers and raises the first knob, and the second."""


class Knobs(QWidget):
    """One row for each knob of the lesson; nothing at all where it has none."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self._session = session
        self._lesson = ""
        self.rows: list[Stepper] = []
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(0)

    def show_state(self, state: State) -> None:
        if state.lesson.id != self._lesson:
            self._lesson = state.lesson.id
            self._fill(state.lesson.knobs)
        for row, knob, value in zip(self.rows, state.lesson.knobs, state.lesson.values, strict=True):
            row.show_value(str(value), is_least=value <= knob.least, is_most=value >= knob.most)

    def _fill(self, knobs: tuple[Knob, ...]) -> None:
        emptied(self._column)
        self.rows = []
        for k, knob in enumerate(knobs):
            keys = KEYS[k] if k < len(KEYS) else ("", "")
            self.rows.append(Stepper(knob.label, partial(self._session.do, turn_knob, k), keys))
        for part in (heading("Change"), *self.rows, gap(px(2 * GRID))) if self.rows else ():
            self._column.addWidget(part)
        self.setVisible(bool(self.rows))

"""The panel of a lesson's knobs: numbers such as the degree or the valence, changed while it stands."""

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from app.gui.look import GRID, type_face
from app.gui.parts import gap, heading
from app.gui.session import Session
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
        self.rows: list[Row] = []
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(0)

    def show_state(self, state: State) -> None:
        if state.lesson.id != self._lesson:
            self._lesson = state.lesson.id
            self._fill(state.lesson.knobs)
        for row, value in zip(self.rows, state.lesson.values, strict=True):
            row.show_value(value)

    def _fill(self, knobs: tuple[Knob, ...]) -> None:
        while (item := self._column.takeAt(0)) is not None:
            if (old := item.widget()) is not None:
                old.hide()
                old.deleteLater()
        self.rows = [Row(knob, k, self._session) for k, knob in enumerate(knobs)]
        if self.rows:
            for part in (heading("Change"), *self.rows, gap(2 * GRID)):
                self._column.addWidget(part)
        self.setVisible(bool(self.rows))


class Row(QWidget):
    """A knob's name, its value, and a button on either side of it."""

    def __init__(self, knob: Knob, number: int, session: Session) -> None:
        super().__init__()
        self._knob = knob
        self._value = QLabel(alignment=Qt.AlignmentFlag.AlignCenter)
        self._value.setFont(type_face(16))
        self._value.setMinimumWidth(3 * GRID)
        lower, raise_ = KEYS[number] if number < len(KEYS) else ("", "")
        self.less = _button("−", f"Less {knob.label}", lower)
        self.more = _button("+", f"More {knob.label}", raise_)
        self.less.clicked.connect(lambda: session.do(turn_knob, number, -1))
        self.more.clicked.connect(lambda: session.do(turn_knob, number, 1))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(GRID // 2)
        row.addWidget(QLabel(knob.label.capitalize()), 1)
        for part in (self.less, self._value, self.more):
            row.addWidget(part)

    def show_value(self, value: int) -> None:
        self._value.setText(str(value))
        self.less.setEnabled(value > self._knob.least)
        self.more.setEnabled(value < self._knob.most)


def _button(sign: str, name: str, keys: str) -> QToolButton:
    button = QToolButton()
    button.setText(sign)
    button.setFont(type_face(16))
    button.setFixedSize(QSize(4 * GRID, 4 * GRID - 4))
    button.setAutoRepeat(True)
    button.setAccessibleName(name)
    button.setToolTip(f"{name} ({keys})" if keys else name)
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    return button

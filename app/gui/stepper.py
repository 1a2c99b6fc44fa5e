"""A number with a button on either side of it."""

from collections.abc import Callable

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QToolButton, QWidget

from app.gui.look import GRID, px, type_face
from app.words import headed, tr
from subdivision.words import phrase


class Stepper(QWidget):
    """A name, a value, less and more; ``step`` is called with -1 or 1."""

    def __init__(self, name: str, step: Callable[[int], None], keys: tuple[str, str] = ("", "")) -> None:
        super().__init__()
        self._value = QLabel(alignment=Qt.AlignmentFlag.AlignCenter)
        self._value.setFont(type_face(16))
        self._value.setMinimumWidth(px(3 * GRID))
        self.less, self.more = _button("−", "Less {name}", name, keys[0]), _button("+", "More {name}", name, keys[1])
        self.less.clicked.connect(lambda: step(-1))
        self.more.clicked.connect(lambda: step(1))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(px(GRID / 4))
        words = QLabel(headed(tr(name)))
        words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)  # never widens the panel
        row.addWidget(words, 1)
        for part in (self.less, self._value, self.more):
            row.addWidget(part)

    def show_value(self, text: str, *, is_least: bool, is_most: bool) -> None:
        self._value.setText(text)
        self.less.setEnabled(not is_least)
        self.more.setEnabled(not is_most)


def _button(sign: str, what: str, of: str, keys: str) -> QToolButton:
    name = tr(phrase(what, name=of))
    button = QToolButton()
    button.setText(sign)
    button.setFont(type_face(16))
    button.setFixedSize(QSize(px(3 * GRID + 4), px(3 * GRID + 4)))
    button.setAutoRepeat(True)
    button.setAccessibleName(name)
    button.setToolTip(f"{name} ({keys})" if keys else name)
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    return button

"""How far back the weights of a point are read: one of four buttons in a row."""

from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QSizePolicy, QToolButton, QWidget

from app.draw.pointed import ACROSS
from app.gui.look import px, sized, type_face
from app.gui.session import Session
from app.state import State, choose
from app.words import tr
from subdivision.words import phrase

NAMES = {"stage": "Stage", "step": "Step", "all": "All", "limit": "Limit"}


class Across(QWidget):
    """Stage, step, all levels, limit; keys 1 to 4."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self._group = QButtonGroup(self)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        self.buttons = {}
        for k, (across, meaning) in enumerate(ACROSS.items(), 1):
            button = QToolButton()
            button.setText(tr(NAMES[across]))
            button.setFont(type_face(12))
            button.setStyleSheet(sized("padding: 2px 0"))
            button.setCheckable(True)
            button.setFixedHeight(px(28))
            button.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            words = tr(phrase("Weights across {meaning}", meaning=meaning))
            button.setAccessibleName(words)
            button.setToolTip(f"{words} ({k})")
            button.clicked.connect(partial(session.do, choose, across=across))
            self._group.addButton(button)
            row.addWidget(button)
            self.buttons[across] = button

    def show_state(self, state: State) -> None:
        self.buttons[state.options.across].setChecked(True)

"""The panel 'Notes': what the lecturer may say, apart from the picture, and what is not the lecture's own."""

from html import escape

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from app.draw.theme import THEMES
from app.gui.look import GRID, colour, px
from app.gui.parts import gap, heading
from app.state import State
from app.words import tr
from subdivision.words import phrase


class Notes(QWidget):
    """Words to go with the step; hidden where there are none."""

    def __init__(self) -> None:
        super().__init__()
        self.words = QLabel(wordWrap=True, textFormat=Qt.TextFormat.RichText)
        self.words.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.words.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.words.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        for part in (heading("Notes"), self.words, gap(px(2 * GRID))):
            column.addWidget(part)

    def show_state(self, state: State) -> None:
        muted = colour(THEMES[state.options.theme].muted).name()
        ours = state.lesson.ours
        remark = phrase("Not in the lecture: {remark}", remark=ours)
        parts = [
            f"<p>{escape(tr(state.now.notes))}</p>" if state.now.notes else "",
            f'<p style="color:{muted}">{escape(tr(remark))}</p>' if ours else "",
        ]
        self.words.setText("".join(parts))
        self.setVisible(any(parts))

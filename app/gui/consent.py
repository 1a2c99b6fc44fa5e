"""Asks before lessons from elsewhere run: they are programs."""

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QFont, QIcon
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLabel, QVBoxLayout, QWidget

from app.gui.look import px, type_face
from app.gui.parts import scrolled
from app.words import tr
from subdivision.words import phrase

LISTED = 8
"""So many files are named."""

WHAT_THEY_ARE = (
    "Lessons are programs. They can do all that you can do on this computer: read, change and send your files. "
    "Run them only if you trust whoever wrote them."
)


class Consent(QDialog):
    """Accepted when the user agrees to what is in a folder; not to run it is what Enter and Esc choose."""

    def __init__(self, parent: QWidget, folder: Path, files: list[Path]) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Lessons from elsewhere"))
        question = QLabel(tr("Run the lessons in this folder?"))
        question.setFont(type_face(18, QFont.Weight.DemiBold))
        where = _plain(str(folder))
        where.setFont(type_face(14, QFont.Weight.Medium))
        where.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.buttons = QDialogButtonBox()
        self.run = self.buttons.addButton(tr("Run the lessons in this folder"), QDialogButtonBox.ButtonRole.AcceptRole)
        self.later = self.buttons.addButton(tr("Not now"), QDialogButtonBox.ButtonRole.RejectRole)
        for button in self.buttons.buttons():
            button.setIcon(QIcon())
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setContentsMargins(px(24), px(24), px(24), px(16))
        column.setSpacing(px(16))
        names = scrolled(_plain(_listed(files)))
        names.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        names.setAccessibleName(tr("Lessons from elsewhere"))
        for part in (question, where, names, _plain(tr(WHAT_THEY_ARE)), self.buttons):
            column.addWidget(part)
        width, room = min(px(520), parent.width()), parent.screen().availableGeometry().height()
        self.setMinimumWidth(width)
        self.setMaximumHeight(room)
        self.resize(width, min(column.totalHeightForWidth(width), room))
        self.later.setDefault(True)  # now that it has a dialog to be the default of
        self.later.setFocus()


def _plain(text: str) -> QLabel:
    """A label that takes nothing in a file's name for formatting."""
    label = QLabel(text, wordWrap=True)
    label.setTextFormat(Qt.TextFormat.PlainText)
    return label


def _listed(files: list[Path]) -> str:
    if not files:
        return tr("There is no lesson in it yet; those that you write or put there will be run.")
    names = "\n".join(each.name for each in files[:LISTED])
    more = len(files) - LISTED
    return f"{names}\n{tr(phrase('and {more} more', more=more))}" if more > 0 else names

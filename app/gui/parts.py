"""Small pieces that panels are put together from."""

from PySide6.QtGui import QFont
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from app.gui.look import type_face


def column(*parts: QWidget, stretched: QWidget | None = None) -> QWidget:
    """Parts one under another, without gaps; one of them takes what room is left."""
    found = QWidget()
    layout = QVBoxLayout(found)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.setSpacing(0)
    for part in parts:
        layout.addWidget(part, 1 if part is stretched else 0)
    return found


def heading(text: str) -> QLabel:
    """The name of a part of a panel."""
    label = QLabel(text)
    label.setFont(type_face(12, QFont.Weight.DemiBold))
    label.setContentsMargins(0, 0, 0, 4)
    return label


def gap(height: int) -> QWidget:
    """Nothing, so many pixels high."""
    nothing = QWidget()
    nothing.setFixedHeight(height)
    return nothing

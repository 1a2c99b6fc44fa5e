"""A list to choose from."""

from collections.abc import Callable, Sequence
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtGui import QPaintEvent
from PySide6.QtWidgets import QComboBox, QStyle, QStyleOptionComboBox, QStylePainter, QVBoxLayout, QWidget

from app.gui.look import px
from app.words import headed, tr


class Box(QComboBox):
    """Shortens the chosen name by an ellipsis where it has no room, and says it whole when pointed at."""

    def paintEvent(self, event: QPaintEvent) -> None:
        painter, option = QStylePainter(self), QStyleOptionComboBox()
        self.initStyleOption(option)
        painter.drawComplexControl(QStyle.ComplexControl.CC_ComboBox, option)
        field = QStyle.SubControl.SC_ComboBoxEditField
        room = self.style().subControlRect(QStyle.ComplexControl.CC_ComboBox, option, field, self)
        whole = option.currentText
        option.currentText = self.fontMetrics().elidedText(whole, Qt.TextElideMode.ElideRight, room.width() - px(2))
        painter.drawControl(QStyle.ControlElement.CE_ComboBoxLabel, option)
        painter.end()


class Choice(QWidget):
    """A name above a list to choose from; ``chosen`` is called with what is chosen by hand."""

    def __init__(self, name: str, chosen: Callable[[Any], None]) -> None:
        super().__init__()
        self.box = Box()
        self.box.setAccessibleName(tr(name))
        self.box.currentTextChanged.connect(lambda chosen: self.box.setToolTip(f"{tr(name)}: {chosen}"))
        self.box.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.box.setMinimumContentsLength(8)
        self.box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.box.activated.connect(lambda k: chosen(self.box.itemData(k)))
        self._values: list[tuple[str, Any]] = []
        row = QVBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        row.addWidget(self.box)

    def show_values(self, values: Sequence[tuple[str, Any]], chosen: Any) -> None:
        """Offer named values, one of them chosen."""
        if list(values) != self._values:
            self._values = list(values)
            self.box.clear()
            for name, value in values:
                self.box.addItem(headed(tr(name)), value)
        self.box.setCurrentIndex(next((k for k, (_, value) in enumerate(values) if value == chosen), -1))

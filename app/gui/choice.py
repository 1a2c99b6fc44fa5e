"""A list to choose from."""

from collections.abc import Callable, Sequence
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QVBoxLayout, QWidget

from app.words import headed, tr


class Choice(QWidget):
    """A name above a list to choose from; ``chosen`` is called with what is chosen by hand."""

    def __init__(self, name: str, chosen: Callable[[Any], None]) -> None:
        super().__init__()
        self.box = QComboBox()
        self.box.setAccessibleName(tr(name))
        self.box.setToolTip(tr(name))
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

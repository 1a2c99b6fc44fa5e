"""The panel at the right: what can be asked, changed and shown, in sections that fold and stay as they were left."""

from PySide6.QtCore import QSettings, Qt
from PySide6.QtWidgets import QScrollArea, QVBoxLayout, QWidget

from app.gui.look import GRID, px
from app.gui.parts import Head, column

FOLDED = "folded"
"""Where the settings keep the names of the sections that are folded away."""


class Details(QScrollArea):
    """Parts one under another."""

    def __init__(self) -> None:
        super().__init__(widgetResizable=True)
        inside = column()
        inside.setContentsMargins(px(2 * GRID), px(GRID + 4), px(2 * GRID), px(2 * GRID))
        self._column: QVBoxLayout = inside.layout()  # type: ignore[assignment]
        self.setWidget(inside)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setMinimumWidth(px(184))
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)

    def add(self, part: QWidget, *, is_stretched: bool) -> None:
        """One part more; of what room is left it takes all, or none."""
        self._column.addWidget(part, int(is_stretched))

    def keep(self, settings: QSettings) -> None:
        """Remember which sections are folded away."""
        settings.setValue(FOLDED, [head.text() for head in self._heads() if not head.isChecked()])

    def restore(self, settings: QSettings) -> None:
        """Fold away what was folded away."""
        kept = settings.value(FOLDED) or []
        folded = [kept] if isinstance(kept, str) else list(kept)
        for head in self._heads():
            head.setChecked(head.text() not in folded)

    def inherit(self, before: "Details") -> None:
        """Take over what is folded away."""
        for head, was in zip(self._heads(), before._heads(), strict=True):
            head.setChecked(was.isChecked())

    def _heads(self) -> list[Head]:
        return self.findChildren(Head)

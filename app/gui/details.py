"""The panel at the right: what can be asked, changed and shown, in sections that fold and stay as they were left."""

from PySide6.QtCore import QSettings, Qt
from PySide6.QtWidgets import QScrollArea, QWidget

from app.gui.furniture import scroll_alike
from app.gui.look import GRID, px
from app.gui.parts import Head, column

FOLDED = "folded"
"""Where the settings keep the names of the sections that are folded away."""


class Details(QScrollArea):
    """Parts one under another; ``stretched`` takes what room is left."""

    def __init__(self, *parts: QWidget, stretched: QWidget) -> None:
        super().__init__(widgetResizable=True)
        inside = column(*parts, stretched=stretched)
        inside.setContentsMargins(px(2 * GRID), px(GRID + 4), px(2 * GRID), px(2 * GRID))
        self.setWidget(inside)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setMinimumWidth(px(184))
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)

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
        """Take over what is folded away, and how far it is scrolled."""
        for head, was in zip(self._heads(), before._heads(), strict=True):
            head.setChecked(was.isChecked())
        scroll_alike(self, before)

    def _heads(self) -> list[Head]:
        return self.findChildren(Head)

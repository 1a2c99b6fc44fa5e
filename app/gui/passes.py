"""The passes of a box spline in their order, for the mouse and the keys."""

from collections.abc import Callable
from math import ceil

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QFont, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QSizePolicy

from app.gui.look import px, type_face
from app.gui.session import Session
from app.laboratory import boxlab
from app.state import State
from app.words import tr
from subdivision.catalogue import Vectors
from subdivision.passes import spelled
from subdivision.words import phrase

ROW, MOST = 24, 9
"""Height of a row in pixels at 100 %, and how many rows are seen at once."""

WAYS = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}
REMOVING = (Qt.Key.Key_Delete, Qt.Key.Key_Backspace)


class Passes(QListWidget):
    """Quadrupling first, then the averages; they are dragged up and down, and the story follows."""

    own_keys = frozenset((*WAYS, *REMOVING))

    def __init__(self, session: Session, wish: Callable[..., None]) -> None:
        super().__init__()
        self._session, self._wish = session, wish
        self._passes: Vectors | None = None
        self._held: int | None = None
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("Passes in their order"))
        self.setToolTip(tr("Drag a pass up or down; keys: Alt+↑ and Alt+↓ move it, Delete removes it"))

    def show_state(self, state: State) -> None:
        passes = state.lab.rules[0].passes if state.lab is not None else ()
        if passes != self._passes:
            self._passes = passes
            self._fill(passes)
        playing = _under_way(state)
        for row in range(self.count()):
            weight = QFont.Weight.DemiBold if row == playing else QFont.Weight.Normal
            if self.item(row).font().weight() != weight:
                self.item(row).setFont(type_face(14, weight))

    def _fill(self, passes: Vectors) -> None:
        here = self.currentRow()
        self.clear()
        for text in ("quadruple", *(phrase("average {vector}", vector=spelled(v)) for v in passes)):
            item = QListWidgetItem(f"{self.count() + 1}  {tr(text)}")
            item.setFont(type_face(14))
            item.setSizeHint(QSize(0, px(ROW)))
            self.addItem(item)
        self.item(0).setFlags(self.item(0).flags() & ~Qt.ItemFlag.ItemIsSelectable)
        self.setCurrentRow(min(max(here, 0), self.count() - 1))
        self.setFixedHeight(px(ROW) * min(self.count(), MOST) + px(4))

    def _move(self, number: int, to: int) -> None:
        """A pass to another place; the row that is chosen goes with it."""
        if number >= 0 and 0 <= to < self.count() - 1:
            self._wish(boxlab.move_pass, number, to)
            self.setCurrentRow(to + 1)

    # -- the hand ---------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:
        super().mousePressEvent(event)
        row = self.indexAt(event.position().toPoint()).row()
        self._held = row - 1 if row > 0 and event.button() == Qt.MouseButton.LeftButton else None
        self._session.let_go()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Rows change places as the hand passes over them."""
        row = self.indexAt(event.position().toPoint()).row()
        if self._held is not None and row > 0 and row - 1 != self._held:
            self._move(self._held, row - 1)
            self._held = row - 1

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        super().mouseReleaseEvent(event)
        self._held = None
        self._session.let_go()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key, number = Qt.Key(event.key()), self.currentRow() - 1
        if key in WAYS and event.modifiers() & Qt.KeyboardModifier.AltModifier:
            self._move(number, number + WAYS[key])
            self._session.let_go()
        elif key in REMOVING and number >= 0:
            self._wish(boxlab.remove_vector, number)
        else:
            super().keyPressEvent(event)


def _under_way(state: State) -> int:
    """The pass that plays or is just over; -1: none of them."""
    trace, at = state.now.lead.trace, state.now.lead.at(state.progress)
    if at == 0 or trace.telling == "stencils":
        return -1
    k = ceil(at) - 1
    return k - trace.begins(trace.levels[k])

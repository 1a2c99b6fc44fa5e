"""The mask of a box spline as a small table."""

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent
from PySide6.QtWidgets import QFrame, QLabel, QScrollArea, QSizePolicy, QVBoxLayout, QWidget

from app.draw.lattice import over_one, shade
from app.draw.theme import THEMES, mixed
from app.gui.look import GRID, colour, fine, px, type_face
from app.gui.session import Session
from app.words import tr
from subdivision.catalogue import Vectors
from subdivision.continuity import mask
from subdivision.words import phrase

ROW = 20
"""Height of a row in pixels at 100 %."""


class MaskTable(QWidget):
    """Whole numbers over one denominator, s to the right and t upwards; a wide one scrolls sideways."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self._head = QLabel()
        self.cells = Cells(session)
        self._scroll = QScrollArea(widgetResizable=True)
        self._scroll.setWidget(self.cells)
        self._scroll.setFrameShape(QFrame.Shape.NoFrame)
        self._scroll.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._scroll.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(px(GRID / 2))
        column.addWidget(self._head)
        column.addWidget(self._scroll)

    def show_vectors(self, vectors: Vectors) -> None:
        rows, below = over_one(mask(vectors))
        self._head.setText(tr(phrase("Mask × 1/{below}", below=below)) if below > 1 else tr("Mask"))
        self.cells.show_rows(rows)
        self._scroll.setFixedHeight(px(ROW) * len(rows) + px(GRID))
        self.setAccessibleName(self._head.text())
        self.setAccessibleDescription("; ".join(" ".join(map(str, row)) for row in rows))


class Cells(QWidget):
    """The numbers; the heavier the darker the ground."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self._session = session
        self.rows: list[list[int]] = [[0]]

    def show_rows(self, rows: list[list[int]]) -> None:
        self.rows = rows
        wide = max(QFontMetricsF(type_face(12)).horizontalAdvance(str(n)) for row in rows for n in row)
        self.setMinimumSize(round(len(rows[0]) * max(wide + fine(6), fine(18))), px(ROW) * len(rows))
        self.update()

    def sizeHint(self) -> QSize:
        return self.minimumSize()

    def paintEvent(self, event: QPaintEvent) -> None:
        theme = THEMES[self._session.state.options.theme]
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(type_face(12))
        heaviest = max(max(row) for row in self.rows)
        tall = px(ROW)
        wide = min(self.width() / len(self.rows[0]), 2.0 * tall)
        for j, row in enumerate(self.rows):
            for i, count in enumerate(row):
                ground = colour(mixed(theme.panel, theme.muted, shade(count, heaviest)))
                self._cell(painter, QRectF(i * wide, j * tall, wide, tall), count, ground, colour(theme.ink))
        painter.end()

    def _cell(self, painter: QPainter, room: QRectF, count: int, ground: QColor, ink: QColor) -> None:
        if not count:
            return
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(ground)
        painter.drawRoundedRect(room.adjusted(1, 1, -1, -1), fine(3), fine(3))
        painter.setPen(ink)
        painter.drawText(room, Qt.AlignmentFlag.AlignCenter, str(count))

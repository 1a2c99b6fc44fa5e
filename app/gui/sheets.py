"""Sheets that lie over the window: the keys, and what the program is."""

from importlib.metadata import PackageNotFoundError, version

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QFont, QFontMetricsF, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from app.draw.theme import THEMES, Theme, mixed
from app.gui.keys import COMMANDS, MOUSE, spelled_keys
from app.gui.look import GRID, colour, line_of, type_face
from app.gui.session import Session

COLUMNS = (("Lesson", "Present"), ("View",), ("File", "Edit", "Help", "Mouse"))

ABOUT = (
    "Subdivision Studio",
    "Watch subdivision curves and surfaces happen, one topological or geometric stage at a time.",
    "{version}MIT licence; the typeface Inter under the SIL Open Font License.",
    "Built on Python, numpy, scipy, VTK, PyVista, matplotlib and Qt.",
)


def rows() -> dict[str, list[tuple[str, tuple[str, ...]]]]:
    """Group -> (what, its keys): every command that has a key, and the mouse."""
    found: dict[str, list[tuple[str, tuple[str, ...]]]] = {}
    for c in COMMANDS:
        if c.keys:
            found.setdefault(c.group, []).append((c.name.rstrip("…"), spelled_keys(c)))
    found["Mouse"] = [(what, (how,)) for what, how in MOUSE]
    return found


class Sheet(QWidget):
    """Covers its parent; a click or Esc puts it away."""

    def __init__(self, session: Session, parent: QWidget) -> None:
        super().__init__(parent)
        self._session, self._under = session, parent
        self.hide()

    def toggle(self) -> None:
        self.setGeometry(self._under.rect())
        self.setVisible(self.isHidden())
        self.raise_()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        self.hide()

    def paintEvent(self, event: QPaintEvent) -> None:
        theme = THEMES[self._session.state.options.theme]
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        veil = colour(mixed(theme.background, (0, 0, 0), 0.35), 0.72)
        painter.fillRect(self.rect(), veil)
        self.paint_sheet(painter, theme)
        painter.end()

    def paint_sheet(self, painter: QPainter, theme: Theme) -> None:
        raise NotImplementedError

    def board(self, painter: QPainter, theme: Theme, width: float, height: float) -> QRectF:
        """A card in the middle; the room inside it."""
        room = QRectF(self.rect())
        width, height = min(width, room.width() - 2 * GRID), min(height, room.height() - 2 * GRID)
        card = QRectF((room.width() - width) / 2, (room.height() - height) / 2, width, height)
        painter.setPen(QPen(colour(line_of(theme)), 1))
        painter.setBrush(colour(theme.background))
        painter.drawRoundedRect(card, 12, 12)
        return card.adjusted(4 * GRID, 3 * GRID, -4 * GRID, -3 * GRID)


class Keys(Sheet):
    """Every key, from the table that also makes them work."""

    def paint_sheet(self, painter: QPainter, theme: Theme) -> None:
        line = min(26.0, (self.height() - 12 * GRID) / self._lines())
        room = self.board(painter, theme, 1200, line * self._lines() + 6 * GRID)
        wide = room.width() / len(COLUMNS)
        found = rows()
        for k, groups in enumerate(COLUMNS):
            y = room.top()
            for group in groups:
                painter.setFont(type_face(13, QFont.Weight.DemiBold))
                painter.setPen(colour(theme.muted))
                painter.drawText(QRectF(room.left() + k * wide, y, wide, line), Qt.AlignmentFlag.AlignVCenter, group)
                y += line
                for what, keys in found[group]:
                    self._row(painter, theme, QRectF(room.left() + k * wide, y, wide - 3 * GRID, line), what, keys)
                    y += line
                y += line / 2

    def _row(self, painter: QPainter, theme: Theme, box: QRectF, what: str, keys: tuple[str, ...]) -> None:
        x = box.right()
        small = type_face(12 if box.width() > 300 else 11, QFont.Weight.Medium)
        for key in reversed(keys):
            painter.setFont(small)
            wide = max(QFontMetricsF(small).horizontalAdvance(key) + 12, 22)
            cap = QRectF(x - wide, box.top() + 2, wide, box.height() - 5)
            painter.setPen(QPen(colour(line_of(theme)), 1))
            painter.setBrush(colour(theme.panel))
            painter.drawRoundedRect(cap, 4, 4)
            painter.setPen(colour(theme.ink))
            painter.drawText(cap, Qt.AlignmentFlag.AlignCenter, key)
            x -= wide + 4
        face = type_face(14 if box.width() > 300 else 12)
        painter.setFont(face)
        painter.setPen(colour(theme.ink))
        words = QFontMetricsF(face).elidedText(what, Qt.TextElideMode.ElideRight, x - box.left() - 4)
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter, words)

    def _lines(self) -> float:
        found = rows()
        return max(sum(len(found[g]) + 1.5 for g in groups) - 0.5 for groups in COLUMNS)


class About(Sheet):
    """What the program is."""

    def paint_sheet(self, painter: QPainter, theme: Theme) -> None:
        room = self.board(painter, theme, 560, 200)
        y = room.top()
        for k, text in enumerate(ABOUT):
            painter.setFont(type_face(22 if k == 0 else 14, QFont.Weight.DemiBold if k == 0 else QFont.Weight.Normal))
            painter.setPen(colour(theme.ink if k < 2 else theme.muted))
            words = text.format(version=_version())
            where = QRectF(room.left(), y, room.width(), 60)
            flags = Qt.AlignmentFlag.AlignLeft | Qt.TextFlag.TextWordWrap
            y += painter.boundingRect(where, flags, words).height() + 12
            painter.drawText(where, flags, words)


def _version() -> str:
    """As installed; run from a folder the program has none."""
    try:
        return f"Version {version('subdivision-studio')}. "
    except PackageNotFoundError:
        return ""

"""Sheets that lie over the window: the keys, and what the program is."""

from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version
from typing import TypeAlias

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import (
    QFont,
    QFontMetricsF,
    QHideEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QWheelEvent,
)
from PySide6.QtWidgets import QApplication, QWidget
from shiboken6 import isValid

from app.draw.theme import THEMES, Theme, mixed
from app.gui.keys import COMMANDS, MOUSE, spelled_keys
from app.gui.look import GRID, colour, fine, line_of, type_face
from app.gui.session import Session
from app.words import tr
from subdivision.words import phrase

COLUMNS = (("Lesson", "Present"), ("View",), ("File", "Edit", "Help", "Mouse"))

COLUMN, LINE, LEAST_LINE = 380, 26, 17
"""Width of a column of keys and height of a line of it, and to what it shrinks; pixels at 100 %."""

SCROLLING = {
    Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1, Qt.Key.Key_PageUp: -10, Qt.Key.Key_PageDown: 10,
    Qt.Key.Key_Home: -1000, Qt.Key.Key_End: 1000,
}  # fmt: skip
"""Key -> how many lines it scrolls."""

MEDIUM = QFont.Weight.Medium

Rows: TypeAlias = dict[str, list[tuple[str, tuple[str, ...]]]]

ABOUT = (
    "Subdivision Studio",
    "Watch subdivision curves and surfaces happen, one topological or geometric stage at a time.",
    "{version}MIT licence; the typeface Inter under the SIL Open Font License.",
    "Built on Python, numpy, scipy, VTK, PyVista, matplotlib and Qt.",
)


def rows() -> Rows:
    """Group -> (what, its keys): every command that has a key, and the mouse."""
    found: Rows = {}
    for c in COMMANDS:
        if c.keys:
            found.setdefault(c.group, []).append((tr(c.name).rstrip("…"), spelled_keys(c)))
    found["Mouse"] = [(tr(what), (tr(how),)) for what, how in MOUSE]
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
        space = fine(GRID)
        width, height = min(width, room.width() - 2 * space), min(height, room.height() - 2 * space)
        card = QRectF((room.width() - width) / 2, (room.height() - height) / 2, width, height)
        painter.setPen(QPen(colour(line_of(theme)), fine(1)))
        painter.setBrush(colour(theme.background))
        painter.drawRoundedRect(card, fine(12), fine(12))
        return card.adjusted(4 * space, 3 * space, -4 * space, -3 * space)


class Keys(Sheet):
    """Every key, from the table that also makes them work; what has no room is scrolled to."""

    def __init__(self, session: Session, parent: QWidget) -> None:
        super().__init__(session, parent)
        self._above = self._most = 0.0
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)

    @property
    def own_keys(self) -> tuple[Qt.Key, ...]:
        """Those that scroll, while there is something to scroll to."""
        return tuple(SCROLLING) if self._most else ()

    def toggle(self) -> None:
        self._above = 0.0
        super().toggle()
        if self.isVisible():
            self._before = QApplication.focusWidget()
            self.setFocus(Qt.FocusReason.PopupFocusReason)

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        if self.hasFocus() and self._before is not None and isValid(self._before):
            self._before.setFocus(Qt.FocusReason.PopupFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if (lines := SCROLLING.get(Qt.Key(event.key()))) is None:
            event.ignore()
        else:
            self._scroll(lines * fine(LINE))

    def wheelEvent(self, event: QWheelEvent) -> None:
        self._scroll(-event.angleDelta().y() / 120 * 3 * fine(LINE))

    def _scroll(self, by: float) -> None:
        self._above = min(max(self._above + by, 0.0), self._most)
        self.update()

    def paint_sheet(self, painter: QPainter, theme: Theme) -> None:
        found, space = rows(), fine(GRID)
        n = int(min(max((self.width() - 10 * space) / fine(COLUMN), 1), len(COLUMNS)))
        parts = columns(found, n)
        lines = max(_lines(found, groups) for groups in parts)
        line = max(min(fine(LINE), (self.height() - 8 * space) / lines), fine(LEAST_LINE))
        room = self.board(painter, theme, n * fine(400), line * lines + 6 * space)
        self._most = max(line * lines - room.height(), 0.0)
        self._scroll_bar(painter, theme, room)
        painter.setClipRect(room)
        wide = (room.width() + 3 * space) / n
        for k, groups in enumerate(parts):
            column = QRectF(room.left() + k * wide, room.top() - min(self._above, self._most), wide - 3 * space, line)
            self._column(painter, theme, column, {group: found[group] for group in groups})
        painter.setClipping(False)

    def _column(self, painter: QPainter, theme: Theme, box: QRectF, groups: Rows) -> None:
        small = min(13, 0.68 * box.height() / fine(1))
        for group, commands in groups.items():
            painter.setFont(type_face(small, QFont.Weight.DemiBold))
            painter.setPen(colour(theme.muted))
            painter.drawText(box, Qt.AlignmentFlag.AlignVCenter, tr(group))
            for what, keys in commands:
                box.translate(0, box.height())
                self._row(painter, theme, box, what, keys)
            box.translate(0, 1.5 * box.height())

    def _row(self, painter: QPainter, theme: Theme, box: QRectF, what: str, keys: tuple[str, ...]) -> None:
        x, unit = box.right(), box.height() / LINE
        small, face = type_face(min(12, 15 * unit / fine(1)), MEDIUM), type_face(min(14, 17 * unit / fine(1)))
        for key in reversed(keys):
            painter.setFont(small)
            wide = max(QFontMetricsF(small).horizontalAdvance(key) + fine(12), fine(22))
            cap = QRectF(x - wide, box.top() + fine(1.5), wide, box.height() - fine(3))
            painter.setPen(QPen(colour(line_of(theme)), fine(1)))
            painter.setBrush(colour(theme.panel))
            painter.drawRoundedRect(cap, fine(4), fine(4))
            painter.setPen(colour(theme.ink))
            painter.drawText(cap, Qt.AlignmentFlag.AlignCenter, key)
            x -= wide + fine(4)
        painter.setFont(face)
        painter.setPen(colour(theme.ink))
        words = QFontMetricsF(face).elidedText(what, Qt.TextElideMode.ElideRight, x - box.left() - fine(4))
        painter.drawText(box, Qt.AlignmentFlag.AlignVCenter, words)

    def _scroll_bar(self, painter: QPainter, theme: Theme, room: QRectF) -> None:
        """How much of the keys is seen, beside them."""
        if not self._most:
            return
        part = room.height() / (room.height() + self._most)
        top = room.top() + min(self._above / self._most, 1.0) * (1 - part) * room.height()
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour(line_of(theme)))
        painter.drawRoundedRect(QRectF(room.right() + fine(12), top, fine(6), part * room.height()), fine(3), fine(3))


def columns(found: Rows, n: int) -> Sequence[Sequence[str]]:
    """The groups in so many columns, as even as they can be without breaking one."""
    if n == len(COLUMNS):
        return COLUMNS
    every = [group for groups in COLUMNS for group in groups]
    cuts = {k: max(_lines(found, every[:k]), _lines(found, every[k:])) for k in range(1, len(every))}
    k = min(cuts, key=cuts.__getitem__) if n > 1 else len(every)
    return [part for part in (every[:k], every[k:]) if part]


def _lines(found: Rows, groups: Sequence[str]) -> float:
    """How many lines a column has."""
    return sum(len(found[group]) + 1.5 for group in groups) - 0.5


class About(Sheet):
    """What the program is."""

    def paint_sheet(self, painter: QPainter, theme: Theme) -> None:
        room = self.board(painter, theme, fine(560), fine(200))
        y = room.top()
        for k, text in enumerate(ABOUT):
            painter.setFont(type_face(22 if k == 0 else 14, QFont.Weight.DemiBold if k == 0 else QFont.Weight.Normal))
            painter.setPen(colour(theme.ink if k < 2 else theme.muted))
            words = tr(text).format(version=_version())
            where = QRectF(room.left(), y, room.width(), fine(60))
            flags = Qt.AlignmentFlag.AlignLeft | Qt.TextFlag.TextWordWrap
            y += painter.boundingRect(where, flags, words).height() + fine(12)
            painter.drawText(where, flags, words)


def _version() -> str:
    """As installed; run from a folder the program has none."""
    try:
        return tr(phrase("Version {version}. ", version=version("subdivision-studio")))
    except PackageNotFoundError:
        return ""

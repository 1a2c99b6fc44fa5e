"""The transparent sheet over the panes: everything flat of a picture, painted again only where it has changed."""

from collections.abc import Callable, Sequence

from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPixmap, QRegion, QResizeEvent
from PySide6.QtWidgets import QWidget

from app.draw.layout import extent
from app.draw.primitives import Mark, Plate, Primitive, Stroke, Text
from app.gui.brush import paint
from app.gui.lens import MAGNIFICATION

RIM = 3
"""Pixels round everything, for soft edges."""


class Flat(QWidget):
    """Shows primitives, perhaps through the magnifier; or nothing but black.  The mouse goes through it.

    ``below`` draws what is new below it, before it is painted itself: if Qt were told that the picture in space is to
    be drawn again, it would paint everything over it again too.
    """

    def __init__(self, parent: QWidget, below: Callable[[], None]) -> None:
        super().__init__(parent)
        self._below = below
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._shown: tuple[Primitive, ...] = ()
        self._sheet, self._stale = QPixmap(), QRegion()
        self._lens: QPointF | None = None
        self._is_blank = False

    def lay(self, shown: Sequence[Primitive], lens: QPointF | None = None, *, is_blank: bool = False) -> None:
        """Show these from now on, twice as large about ``lens``, if there is one."""
        was, self._shown = self._shown, tuple(shown)
        looks, self._lens, self._is_blank = (self._lens, self._is_blank), lens, is_blank
        is_usual = looks == (lens, is_blank) == (None, False)
        new = changed(was, self._shown) if is_usual else QRegion(self.rect())
        self._stale += new
        self.update(new + QRect(0, 0, 1, 1))  # at least so much, to be called for the rest

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._sheet = QPixmap()

    def paintEvent(self, event: QPaintEvent) -> None:
        self._below()
        painter = QPainter(self)
        if self._is_blank:
            painter.fillRect(self.rect(), Qt.GlobalColor.black)
        else:
            self._renew()
            painter.drawPixmap(0, 0, self._sheet)
        painter.end()

    def _renew(self) -> None:
        """Paint on the sheet what has changed."""
        scale = self.devicePixelRatioF()
        if self._sheet.isNull() or self._sheet.devicePixelRatio() != scale:
            self._sheet = QPixmap(self.size() * scale)
            self._sheet.setDevicePixelRatio(scale)
            self._sheet.fill(Qt.GlobalColor.transparent)
            self._stale = QRegion(self.rect())
        if self._stale.isEmpty():
            return
        painter, where = QPainter(self._sheet), self._stale
        self._stale = QRegion()
        painter.setClipRegion(where)
        painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_Clear)
        painter.fillRect(where.boundingRect(), Qt.GlobalColor.transparent)
        painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_SourceOver)
        if self._lens is not None:
            painter.translate(self._lens * (1 - MAGNIFICATION))
            painter.scale(MAGNIFICATION, MAGNIFICATION)
            paint(painter, self._shown)
        else:
            paint(painter, (each for each in self._shown if where.intersects(touched(each))))
        painter.end()


def changed(before: Sequence[Primitive], after: Sequence[Primitive]) -> QRegion:
    """Where two pictures differ: round what only one of them has; round all where their order differs."""
    if before == after:
        return QRegion()
    old, new = set(before), set(after)
    is_in_order = [each for each in before if each in new] == [each for each in after if each in old]
    found = QRegion()
    for each in old ^ new if is_in_order else old | new:
        found += touched(each)
    return found


def touched(each: Primitive) -> QRect:
    """The pixels that something flat may touch."""
    match each:
        case Text():
            left, top, wide, tall = extent(each)
            found, rim = QRectF(left, top, wide, tall), 0.3 * each.size
        case Plate():
            found, rim = QRectF(each.x, each.y, each.width, each.height), each.line
        case Stroke():
            found = QRectF(QPointF(each.x0, each.y0), QPointF(each.x1, each.y1)).normalized()
            rim = each.width
        case Mark():
            found, rim = QRectF(each.x, each.y, 0, 0), 2.2 * each.size
    rim += RIM
    return found.adjusted(-rim, -rim, rim, rim).toAlignedRect()

"""The transparent sheet over the panes: everything flat of a picture, painted again only where it has changed."""

from collections.abc import Callable, Iterable, Sequence
from itertools import chain, repeat
from typing import TypeAlias

from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPixmap, QRegion, QResizeEvent
from PySide6.QtWidgets import QWidget

from app.draw.layout import extent
from app.draw.primitives import Mark, Plate, Primitive, Stroke, Text
from app.gui.brush import paint, type_
from app.gui.lens import MAGNIFICATION
from app.gui.stamps import stamp

RIM = 3
"""Pixels round everything, for soft edges."""

Placed: TypeAlias = tuple[Primitive, QRect]
"""Something flat, and the pixels it may touch."""


class Flat(QWidget):
    """Shows primitives, perhaps through the magnifier; or nothing but black.  The mouse goes through it.

    ``below`` draws what is new below it, before it is painted itself: if Qt were told that the picture in space is to
    be drawn again, it would paint everything over it again too.
    """

    def __init__(self, parent: QWidget, below: Callable[[], None]) -> None:
        super().__init__(parent)
        self._below = below
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._shown: tuple[Placed, ...] = ()
        self._sheet, self._stale = QPixmap(), QRegion()
        self._lens: QPointF | None = None
        self._is_blank = self._is_hasty = False
        self._rough = QRegion()

    def lay(
        self,
        shown: Sequence[Primitive],
        lens: QPointF | None = None,
        *,
        is_blank: bool = False,
        is_hasty: bool = False,
    ) -> None:
        """Show these from now on, twice as large about ``lens``, if there is one; in haste while they move."""
        was, self._shown = self._shown, placed(self._shown, shown)
        looks, self._lens, self._is_blank = (self._lens, self._is_blank), lens, is_blank
        is_usual = looks == (lens, is_blank) == (None, False)
        new = changed(was, self._shown) if is_usual else QRegion(self.rect())
        self._is_hasty = is_hasty
        if not is_hasty:
            new, self._rough = new + self._rough, QRegion()
        self._stale += new
        self.update(new + QRect(0, 0, 1, 1))  # at least so much, to be called for the rest

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._sheet = QPixmap()

    def paintEvent(self, event: QPaintEvent) -> None:
        self._below()
        self._renew()
        with QPainter(self) as painter:
            if self._is_blank:
                painter.fillRect(self.rect(), Qt.GlobalColor.black)
            else:
                painter.drawPixmap(0, 0, self._sheet)

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
        where, self._stale = self._stale, QRegion()
        words = stamp if self._is_hasty else type_
        if self._is_hasty:
            self._rough += where
        with QPainter(self._sheet) as painter:
            painter.setClipRegion(where)
            painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_Clear)
            painter.fillRect(where.boundingRect(), Qt.GlobalColor.transparent)
            painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_SourceOver)
            if self._lens is not None:
                painter.translate(self._lens * (1 - MAGNIFICATION))
                painter.scale(MAGNIFICATION, MAGNIFICATION)
                paint(painter, (each for each, _ in self._shown), words)
            else:
                paint(painter, (each for each, there in self._shown if where.intersects(there)), words)


def placed(before: Sequence[Placed], after: Sequence[Primitive]) -> tuple[Placed, ...]:
    """Each of ``after`` with the pixels it may touch, as they were where the same stood at its turn ``before``."""
    old = chain(before, repeat((None, QRect())))
    return tuple((new, where if was == new else touched(new)) for (was, where), new in zip(old, after, strict=False))


def changed(before: Sequence[Placed], after: Sequence[Placed]) -> QRegion:
    """Where two pictures differ: round what is not the same at its turn, or, of another number, in the same order."""
    if len(before) == len(after):
        differ = [pair for pair in zip(before, after, strict=True) if pair[0] != pair[1]]
        return _joined(where for pair in differ for _, where in pair)
    old, new = dict(before), dict(after)
    both = old | new
    is_in_order = [each for each, _ in before if each in new] == [each for each, _ in after if each in old]
    return _joined(both[each] for each in (old.keys() ^ new.keys() if is_in_order else both))


def _joined(places: Iterable[QRect]) -> QRegion:
    found = QRegion()
    for each in places:
        found += each
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

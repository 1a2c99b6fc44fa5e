"""The transparent sheet over the panes: everything flat of a picture, painted again only where it has changed."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import reduce
from itertools import chain, repeat
from time import thread_time
from typing import TypeAlias

from PySide6.QtCore import QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPixmap, QRegion
from PySide6.QtWidgets import QWidget

from app.draw.primitives import Mark, Plate, Primitive, Stroke, Text, Tiles
from app.draw.type import extent
from app.gui.brush import paint, type_
from app.gui.lens import MAGNIFICATION
from app.gui.stamps import stamp
from app.gui.turns import Turns

RIM = 3
"""Pixels round everything, for soft edges."""

SLICE = 0.010
"""Seconds of the window's thread that painting takes in one turn of its event loop, where it is much."""

MUCH = 300.0
"""From so much on painting is much: letters without a halo, of a size of ``LETTER`` pixels, some 30 us each."""

LETTER, HALO, SHAPE = 24.0, 8.0, 0.5
"""That size; what a letter with a halo takes, and what is no letter, compared with such a letter."""

MANY = 300
"""So many places that have changed are told by the one that holds them all."""

Placed: TypeAlias = tuple[Primitive, QRect]
"""Something flat, and the pixels it may touch."""


class Flat(QWidget):
    """Shows primitives, perhaps through the magnifier; or nothing but black.  The mouse goes through it.

    ``below`` draws what is new below it, before it is painted itself: if Qt were told that the picture in space is to
    be drawn again, it would paint everything over it again too.

    Where much has changed it is painted in haste first and carefully then, both over turns of the event loop, on a
    sheet of its own that takes the place of the one that is shown when it is ready.
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
        self._haste, self._care = Turns(self), Turns(self)

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
        self._stale += new
        seen = new if is_hasty else new + self._rough
        self.update(seen + QRect(0, 0, 1, 1))  # at least so much, to be called for the rest

    @property
    def is_done(self) -> bool:
        """Whether everything that has been laid is painted, as carefully as at rest."""
        return (self._stale + self._rough).isEmpty() and not (self._haste.are_left or self._care.are_left)

    def paintEvent(self, event: QPaintEvent) -> None:
        self._below()
        self.renew()
        with QPainter(self) as painter:
            if self._is_blank:
                painter.fillRect(self.rect(), Qt.GlobalColor.black)
            else:
                painter.drawPixmap(0, 0, self._sheet)

    def renew(self) -> None:
        """Paint on the sheet what has changed, or begin to."""
        if self._haste.are_left:
            return  # it is called again when that is over
        sheet = self._fitting()
        todo = self._stale if self._is_hasty else self._stale + self._rough
        if todo.isEmpty():
            return
        is_much = toil(self._within(todo), self._scale()) > MUCH
        if not is_much:
            self._care.stop()
            self._stale, self._rough = QRegion(), self._rough + todo if self._is_hasty else QRegion()
            self._sheet = sheet
            for _ in self._painted(sheet, todo, is_hasty=self._is_hasty):
                pass
            return
        if not self._stale.isEmpty():
            self._care.stop()
            where, self._stale = self._stale, QRegion()
            self._rough += where
            self._haste.begin(self._hastened(sheet, where))
        if not (self._is_hasty or self._haste.are_left or self._care.are_left):
            self._care.begin(self._refined())

    def _scale(self) -> float:
        """Pixels of the sheet to one of the picture."""
        return self.devicePixelRatioF() * (1.0 if self._lens is None else MAGNIFICATION)

    def _fitting(self) -> QPixmap:
        """The sheet, or one that is all to be painted if it is not as large as the widget."""
        scale = self.devicePixelRatioF()
        size = self.size() * scale
        if self._sheet.size() == size and self._sheet.devicePixelRatio() == scale:
            return self._sheet
        sheet = QPixmap(size)
        sheet.setDevicePixelRatio(scale)
        sheet.fill(Qt.GlobalColor.transparent)
        self._stale, self._rough = QRegion(self.rect()), QRegion()
        return sheet

    def _within(self, where: QRegion) -> list[Primitive]:
        """What is to be painted there."""
        return [each for each, there in self._shown if self._lens is not None or where.intersects(there)]

    def _hastened(self, sheet: QPixmap, where: QRegion) -> Iterator[None]:
        """Paint there in haste, over turns."""
        is_late, sheet = False, QPixmap(sheet)
        for _ in self._painted(sheet, where, is_hasty=True):
            is_late = True
            yield
        self._sheet = sheet
        if is_late:
            self.update(where + QRect(0, 0, 1, 1))

    def _refined(self) -> Iterator[None]:
        """Paint carefully what was painted in haste, over later turns."""
        yield
        where, sheet = self._rough, QPixmap(self._sheet)
        yield from self._painted(sheet, where, is_hasty=False)
        self._sheet, self._rough = sheet, QRegion()
        self.update(where)

    def _painted(self, sheet: QPixmap, where: QRegion, *, is_hasty: bool) -> Iterator[None]:
        """Paint there what is shown now, in slices."""
        left, lens = deque(self._within(where)), self._lens
        with QPainter(sheet) as painter:
            painter.setClipRegion(where)
            painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_Clear)
            painter.fillRect(where.boundingRect(), Qt.GlobalColor.transparent)
        while left:
            with QPainter(sheet) as painter:
                painter.setClipRegion(where)
                if lens is not None:
                    painter.translate(lens * (1 - MAGNIFICATION))
                    painter.scale(MAGNIFICATION, MAGNIFICATION)
                paint(painter, _slice(left), stamp if is_hasty else type_)
            if left:
                yield


def _slice(left: deque[Primitive]) -> Iterator[Primitive]:
    """Take from what is ``left`` as many as can be painted in one turn."""
    end = thread_time() + SLICE
    while left and thread_time() < end:
        yield left.popleft()


def toil(primitives: Iterable[Primitive], scale: float) -> float:
    """About how long these take to paint carefully."""
    return sum(_toil(each, scale) for each in primitives)


def _toil(each: Primitive, scale: float) -> float:
    if isinstance(each, Tiles):
        return SHAPE * len(each.corners)
    if not isinstance(each, Text):
        return SHAPE
    return len(each.text) * scale * each.size / LETTER * (1.0 if each.halo is None else HALO)


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
    """All these places, or, of many, the rectangle round them."""
    many = list(places)
    if len(many) > MANY:
        return QRegion(reduce(QRect.united, many))
    found = QRegion()
    for each in many:
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
        case Tiles():
            (left, top), (right, bottom) = each.corners.min(axis=0).tolist(), each.corners.max(axis=0).tolist()
            found, rim = QRectF(left, top, right - left + each.width, bottom - top + each.height), 0.0
        case Stroke():
            found = QRectF(QPointF(each.x0, each.y0), QPointF(each.x1, each.y1)).normalized()
            rim = each.width
        case Mark():
            found, rim = QRectF(each.x, each.y, 0, 0), 2.2 * each.size
    rim += RIM
    return found.adjusted(-rim, -rim, rim, rim).toAlignedRect()

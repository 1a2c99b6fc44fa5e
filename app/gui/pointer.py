"""What the lecturer points with: an arrow that leaves when it rests, or a spot of light with a short trail.

Pointing changes nothing that is shown, so it is no part of the state, and no picture is composed for it.
"""

from PySide6.QtCore import QElapsedTimer, QPointF, QRectF, Qt, QTimer
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QRadialGradient
from PySide6.QtWidgets import QWidget

from app.state import Options

STILL = 2000
"""Milliseconds: a pointer that rests so long while presenting is hidden."""

TRAIL = 320
"""Milliseconds until a place where the light has been is dark again."""

FRAME = 16
"""Milliseconds between pictures of the trail."""

LIGHT = QColor(224, 0, 128)
"""Red-purple: no point or face of a lesson has it."""


class Pointer(QWidget):
    """The transparent sheet on which the light is; it also sees to the arrow of what lies under it."""

    def __init__(self, under: QWidget) -> None:
        super().__init__(under)
        self._under = under
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._is_presenting, self._is_trailing = False, True
        self.is_lit = False
        self.at: QPointF | None = None
        self._trail: list[tuple[int, QPointF]] = []
        self._clock = QElapsedTimer()
        self._clock.start()
        self._still = QTimer(self, singleShot=True, interval=STILL)
        self._still.timeout.connect(lambda: self._arrow(is_shown=False))
        self._fade = QTimer(self, interval=FRAME)
        self._fade.timeout.connect(self._faded)
        self.hide()

    @property
    def radius(self) -> float:
        """Of the light, in pixels: large enough for the back row."""
        return max(self.height() / 90, 7.0)

    def obey(self, options: Options) -> None:
        """While presenting, a pointer that rests is hidden; with reduced motion the light has no trail."""
        self._is_trailing = not options.reduced_motion
        if options.presenting != self._is_presenting:
            self._is_presenting = options.presenting
            self._woken()

    def toggle(self) -> None:
        """Light instead of the arrow, or the arrow again."""
        self.is_lit = not self.is_lit
        self._trail.clear()
        self.setVisible(self.is_lit)
        self._woken()

    def moved(self, here: QPointF) -> None:
        """The mouse is at another place."""
        before, self.at = self.at, here
        if self.is_lit:
            if before is not None and self._is_trailing:
                self._trail.append((self._clock.elapsed(), before))
                self._fade.start()
            self._repaint(before, here)
        self._woken()

    def left(self) -> None:
        """The mouse has gone."""
        self.at = None
        self._trail.clear()
        self.update()

    def _woken(self) -> None:
        self._arrow(is_shown=not self.is_lit)
        if self._is_presenting and not self.is_lit:
            self._still.start()
        else:
            self._still.stop()

    def _arrow(self, *, is_shown: bool) -> None:
        if is_shown:
            self._under.unsetCursor()
        else:
            self._under.setCursor(Qt.CursorShape.BlankCursor)

    def _faded(self) -> None:
        self._repaint(*(place for _, place in self._trail), self.at)
        since = self._clock.elapsed() - TRAIL
        self._trail = [(when, place) for when, place in self._trail if when > since]
        if not self._trail:
            self._fade.stop()

    def _repaint(self, *places: QPointF | None) -> None:
        """Just where the light is or was."""
        found, wide = QRectF(), 4 * self.radius
        for place in places:
            if place is not None:
                found |= QRectF(place.x() - wide / 2, place.y() - wide / 2, wide, wide)
        self.update(found.toAlignedRect())

    def paintEvent(self, event: QPaintEvent) -> None:
        if self.at is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint_trail(painter, self.at)
        glow = QRadialGradient(self.at, 1.8 * self.radius)
        for where, opacity in ((0.0, 1.0), (0.45, 0.95), (0.6, 0.35), (1.0, 0.0)):
            glow.setColorAt(where, _faint(opacity))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(glow)
        painter.drawEllipse(self.at, 1.8 * self.radius, 1.8 * self.radius)
        painter.end()

    def _paint_trail(self, painter: QPainter, here: QPointF) -> None:
        now, ends = self._clock.elapsed(), [*(place for _, place in self._trail[1:]), here]
        for (when, place), end in zip(self._trail, ends, strict=False):
            left = max(1 - (now - when) / TRAIL, 0.0)
            pen = QPen(_faint(0.5 * left), 1.6 * self.radius * left)
            pen.setCapStyle(Qt.PenCapStyle.FlatCap)
            painter.setPen(pen)
            painter.drawLine(place, end)


def _faint(opacity: float) -> QColor:
    light = QColor(LIGHT)
    light.setAlphaF(opacity)
    return light

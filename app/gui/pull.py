"""A slider for how far a vertex is pulled: what is C1 is marked on its track, and so are the pulls with a name."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QWheelEvent
from PySide6.QtWidgets import QAbstractSlider, QSizePolicy

from app.draw.theme import THEMES, Theme, mixed
from app.gui.look import colour, fine, line_of, px, type_face
from app.words import tr
from subdivision.catalogue import Parameter
from subdivision.extraordinary import EQUAL, Special
from subdivision.smoothness import Between
from subdivision.words import phrase

TRACK, ROW, INSET = 14.0, 15.0, 9.0
"""Where the track is below the top, how high a row of names is, how far from either side the track ends; at 100 %."""

NEAR = 5.0
"""Pixels at 100 % within which the hand takes a pull with a name."""


@dataclass(frozen=True)
class Track:
    """What the slider offers at a valence: a parameter's range, the pulls that are C1, and those with a name."""

    parameter: Parameter
    smooth: Between
    specials: tuple[Special, ...]

    def stops(self, here: Fraction) -> list[Fraction]:
        """Where the handle can be: every step, every named pull that is a fraction, and where it is."""
        p = self.parameter
        steps = {p.least + k * p.step for k in range(int((p.most - p.least) / p.step) + 1)}
        return sorted(steps | self.exact | {here})

    @property
    def exact(self) -> set[Fraction]:
        """The named pulls that are fractions."""
        pulls = (each.pull for each in self.specials)
        return {
            pull for pull in pulls if isinstance(pull, Fraction) and self.parameter.least <= pull <= self.parameter.most
        }

    @property
    def names(self) -> list[tuple[float, str]]:
        """Each named pull once, with all its names."""
        found: dict[float, list[str]] = {}
        for each in self.specials:
            pull = next((p for p in found if abs(p - float(each.pull)) <= EQUAL), float(each.pull))
            found.setdefault(pull, []).append(each.name)
        return [(pull, ", ".join(names)) for pull, names in sorted(found.items())]


class PullSlider(QAbstractSlider):
    """Its whole numbers count the places where the handle can be; ``moved`` is called with the pull there."""

    own_keys = (
        Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Home, Qt.Key.Key_End,
    )  # fmt: skip

    def __init__(self, theme: Callable[[], str], moved: Callable[[Fraction], None], let_go: Callable[[], None]) -> None:
        super().__init__()
        self._theme, self._moved, self._let_go = theme, moved, let_go
        self._track: Track | None = None
        self.places: Sequence[Fraction] = ()
        self.setOrientation(Qt.Orientation.Horizontal)
        self.setAccessibleName(tr("Pull"))
        self.setToolTip(tr("How far of the way to the centroid of the centroids an extraordinary vertex goes (← →)"))
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.valueChanged.connect(lambda k: self._moved(self.places[k]))

    def show_pull(self, track: Track, here: Fraction) -> None:
        """Offer a track, the handle ``here`` on it."""
        self._track, self.places = track, track.stops(here)
        self.blockSignals(True)
        self.setRange(0, len(self.places) - 1)
        self.setPageStep(8)
        self.setValue(self.places.index(here))
        self.blockSignals(False)
        self.setAccessibleDescription(tr(phrase("{part} of the way", part=here)))
        self.setFixedHeight(px(TRACK + 14 + ROW * len(track.names)))
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(px(140), px(TRACK + 14 + 3 * ROW))

    def x_of(self, pull: float) -> float:
        """Where a pull is on the track, in pixels."""
        least, most = self._limits()
        inset = fine(INSET)
        return inset + (pull - least) / (most - least) * (self.width() - 2 * inset)

    def _limits(self) -> tuple[float, float]:
        assert self._track is not None
        return float(self._track.parameter.least), float(self._track.parameter.most)

    def _nearest(self, x: float) -> int:
        """The place for the hand at ``x``: a pull with a name if one is near."""
        named = self._track.exact if self._track is not None else set()
        near = fine(NEAR)
        away = [(abs(self.x_of(float(p)) - x) - (near if p in named else 0.0), k) for k, p in enumerate(self.places)]
        return min(away)[1]

    # -- Qt's own -------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self.setSliderDown(True)
            self.setValue(self._nearest(event.position().x()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self.isSliderDown():
            self.setValue(self._nearest(event.position().x()))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self.setSliderDown(False)
        self._let_go()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        super().keyPressEvent(event)
        self._let_go()

    def wheelEvent(self, event: QWheelEvent) -> None:
        event.ignore()  # it scrolls the panel

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._track is None:
            return
        theme = THEMES[self._theme()]
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._paint_track(painter, theme, self._track)
        self._paint_names(painter, theme, self._track)
        self._paint_handle(painter, theme)
        painter.end()

    def _paint_track(self, painter: QPainter, theme: Theme, track: Track) -> None:
        """Thin where the surface has a tip, heavy where it is C1; a stroke across where that begins or ends."""
        least, most = self._limits()
        low, high = max(float(track.smooth.least), least), min(float(track.smooth.most), most)
        y, half = fine(TRACK), fine(8)
        quiet = QPen(colour(mixed(line_of(theme), theme.ink, 0.3)), fine(2), Qt.PenStyle.DotLine)
        painter.setPen(quiet)
        painter.drawLine(QPointF(self.x_of(least), y), QPointF(self.x_of(most), y))
        painter.setPen(QPen(colour(theme.accent), fine(5), Qt.PenStyle.SolidLine, Qt.PenCapStyle.FlatCap))
        painter.drawLine(QPointF(self.x_of(low), y), QPointF(self.x_of(high), y))
        painter.setPen(QPen(colour(theme.accent), fine(2)))
        for end in (float(track.smooth.least), float(track.smooth.most)):
            if least < end < most:
                painter.drawLine(QPointF(self.x_of(end), y - half), QPointF(self.x_of(end), y + half))

    def _paint_names(self, painter: QPainter, theme: Theme, track: Track) -> None:
        """Each name in a row of its own, led to from its place on the track, the rightmost first."""
        painter.setFont(type_face(12))
        painter.setPen(QPen(colour(theme.muted), fine(1)))
        tall, edge = fine(ROW), fine(2)
        top, names = fine(TRACK + 8), track.names[::-1]
        rows = [(self.x_of(pull), top + row * tall, tr(name)) for row, (pull, name) in enumerate(names)]
        for x, y, _ in rows:
            painter.drawLine(QPointF(x, fine(TRACK + 3)), QPointF(x, y + tall / 2))
        painter.setPen(colour(theme.ink))
        for x, y, name in rows:
            wide = painter.fontMetrics().horizontalAdvance(name) + 2 * edge
            place = QRectF(max(min(x + fine(3), self.width() - wide), 0), y, wide, tall)
            painter.fillRect(place.adjusted(0, 1, 0, -1), colour(theme.panel))  # no line runs through a name
            painter.drawText(place.translated(edge, 0), Qt.AlignmentFlag.AlignVCenter, name)

    def _paint_handle(self, painter: QPainter, theme: Theme) -> None:
        middle = QPointF(self.x_of(float(self.places[self.value()])), fine(TRACK))
        painter.setBrush(colour(theme.panel))
        painter.setPen(QPen(colour(theme.accent if self.hasFocus() or self.isSliderDown() else theme.ink), fine(2.5)))
        painter.drawEllipse(middle, fine(6.5), fine(6.5))
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(colour(theme.accent), fine(1.5)))
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), fine(4), fine(4))

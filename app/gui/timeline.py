"""The way through the lesson: a segment for every stage, a taller tick where a level ends, and its buttons."""

from collections.abc import Callable

from PySide6.QtCore import QEvent, QPointF, QRect, QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetricsF,
    QHelpEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QResizeEvent,
)
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QToolButton, QToolTip, QWidget

from app.asking import is_open
from app.draw.compose import said
from app.draw.theme import THEMES, Theme, mixed
from app.gui.look import GRID, colour, fine, icon, px, type_face
from app.gui.session import Session
from app.state import Segment, State, axis_of, choose, seek, segments
from app.words import tr
from subdivision.words import phrase

HEIGHT = 7 * GRID
"""Pixels at 100 %."""

PLAYING = ("first", "back", "play", "forward", "last")
LEVELS = ("level_down", "level_up", "through")
"""The buttons left and right of the track."""

NARROW = 480
"""Below this width the track takes the place of some buttons; pixels at 100 %."""

SNAP = 6.0
"""Pixels at 100 %: so near to a stage's end, scrubbing is at it."""

MARK = 7.5
"""Radius of a question's mark; pixels at 100 %."""

HANDLE = 7
"""Radius of the handle; pixels at 100 %."""

SPEEDS = (0.25, 0.5, 1.0, 2.0, 4.0)

Make = Callable[[str], QToolButton]
"""Makes the button of a command."""


class Timeline(QWidget):
    """Buttons and track in one row."""

    def __init__(self, session: Session, button: Make) -> None:
        super().__init__()
        self.setFixedHeight(px(HEIGHT))
        self.setMinimumWidth(px(NARROW / 2))
        self._track = Track(session)
        row = QHBoxLayout(self)
        row.setContentsMargins(px(GRID), 0, px(GRID), 0)
        row.setSpacing(0)
        self._buttons = {name: button(name) for name in (*PLAYING, *LEVELS)}
        for name in PLAYING:
            row.addWidget(self._buttons[name])
        row.addSpacing(px(GRID))
        row.addWidget(self._track, 1)
        row.addSpacing(px(GRID))
        for name in LEVELS:
            row.addWidget(self._buttons[name])
        self._speed = QToolButton()
        self._speed.setToolTip(tr("Speed: slower −, faster +"))
        self._speed.setAccessibleName(tr("Speed"))
        self._speed.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self._speed.setMinimumSize(QSize(px(48), px(32)))
        self._speed.clicked.connect(lambda: session.do(choose, speed=next_speed(session.state.options.speed)))
        row.addWidget(self._speed)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Where there is little room, the track has it before the buttons that keys and the track do as well."""
        super().resizeEvent(event)
        for name in ("first", "last", *LEVELS):
            self._buttons[name].setVisible(self.width() >= fine(NARROW))

    def show_state(self, state: State) -> None:
        self._speed.setText(spoken_speed(state.options.speed))
        self._track.show_state(state)


class Track(QWidget):
    """The segments; the mouse scrubs."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self._session = session
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(tr("Timeline"))
        self._is_held = False
        self._looks: tuple[object, ...] = ()
        self._stands = 0.0

    def show_state(self, state: State) -> None:
        here = current(state)
        stage, caption = here.name or phrase("question" if is_open(state) else "still"), said(state, state.now)
        words = phrase("level {level}, {stage}: {caption}", level=here.level, stage=stage, caption=caption)
        self.setAccessibleDescription(tr(words))
        looks, stands = (state.lesson, here, state.options), axis_of(state)
        if looks != self._looks:
            self.update()
        elif stands != self._stands:
            self.update(self._round(self._stands) | self._round(stands))
        self._looks, self._stands = looks, stands

    def _round(self, axis: float) -> QRect:
        """The pixels that the handle touches there."""
        half = fine(HANDLE) + 3
        return QRectF(self._x(axis) - half, 0, 2 * half, self.height()).toAlignedRect()

    # -- place and time -------------------------------------------------------------------------

    def _x(self, axis: float) -> float:
        end = segments(self._session.state.lesson)[-1].end
        margin = fine(GRID)
        return margin + axis / end * (self.width() - 2 * margin)

    def _axis(self, x: float) -> float:
        parts = segments(self._session.state.lesson)
        margin = fine(GRID)
        axis = (x - margin) / max(self.width() - 2 * margin, 1) * parts[-1].end
        near = min((e for s in parts for e in (s.begin, s.end)), key=lambda e: abs(e - axis))
        return near if abs(self._x(near) - x) <= fine(SNAP) else axis

    # -- the hand -------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._is_held = True
            self._session.let_go()
            self._session.do(seek, self._axis(event.position().x()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        if self._is_held:
            self._session.do(seek, self._axis(event.position().x()))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        self._is_held = False
        self._session.let_go()

    def event(self, event: QEvent) -> bool:
        if isinstance(event, QHelpEvent) and event.type() == QEvent.Type.ToolTip:
            found = self._segment_at(event.position().x() if hasattr(event, "position") else event.pos().x())
            state = self._session.state
            words = said(state, state.lesson.beats[found.beat])
            QToolTip.showText(event.globalPos(), f"{tr(found.name)}: {words}" if found.name else words, self)
            return True
        return super().event(event)

    def _segment_at(self, x: float) -> Segment:
        parts = segments(self._session.state.lesson)
        return next((s for s in parts if x <= self._x(s.end)), parts[-1])

    # -- paint ----------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:
        state = self._session.state
        theme = THEMES[state.options.theme]
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        axis, middle = axis_of(state), self.height() / 2 + fine(1)
        parts, now = segments(state.lesson), current(state)
        idle, done = mixed(theme.panel, theme.ink, 0.22), theme.accent
        taken, beside, where = -1e9, fine(30), event.rect()
        for s in parts:
            left, right = self._x(s.begin), self._x(s.end)
            has_word = s.ends_level and right - taken > fine(26)
            taken = right if has_word else taken
            if s is not now and not where.left() - beside <= right <= where.right() + beside + right - left:
                continue
            self._bar(painter, left, right, middle, colour(idle))
            if axis > s.begin:
                self._bar(painter, left, min(right, self._x(axis)), middle, colour(done))
            tall = fine(11 if s.ends_level else 6)
            painter.setPen(QPen(colour(theme.ink if s.ends_level else theme.muted), fine(1.6 if s.ends_level else 1)))
            painter.drawLine(QPointF(right, middle - tall), QPointF(right, middle + tall))
            self._name(painter, s, colour(theme.ink if s is now else theme.muted), is_now=s is now)
            if has_word:
                self._word(painter, f"×{s.level}", right, middle + fine(11), colour(theme.ink))
        for s in parts:
            if state.lesson.beats[s.beat].asks is not None:
                self._question(painter, QPointF(self._x(s.end), middle), theme)
        painter.setPen(QPen(colour(theme.panel), fine(2)))
        painter.setBrush(colour(theme.ink))
        painter.drawEllipse(QPointF(self._x(axis), middle), fine(HANDLE), fine(HANDLE))
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(colour(theme.accent), fine(2)))
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, fine(3), -1, -fine(3)), fine(6), fine(6))
        painter.end()

    def _bar(self, painter: QPainter, left: float, right: float, middle: float, ink: QColor) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(ink)
        painter.drawRect(QRectF(left, middle - fine(2), max(right - left, 0), fine(4)))

    def _name(self, painter: QPainter, s: Segment, ink: QColor, *, is_now: bool) -> None:
        """A stage's name over its segment, where all of the lesson's names fit; else only the one that plays."""
        face = type_face(12, QFont.Weight.DemiBold if is_now else QFont.Weight.Normal)
        left, right = self._x(s.begin), self._x(s.end)
        if not is_now and not self._has_room(face):
            return
        wide = QFontMetricsF(face).horizontalAdvance(tr(s.name)) + fine(2)
        x = min(max((left + right - wide) / 2, 0.0), self.width() - wide)
        painter.setFont(face)
        painter.setPen(ink)
        where = QRectF(x, self.height() / 2 - fine(24), wide, fine(16))
        painter.drawText(where, Qt.AlignmentFlag.AlignCenter, tr(s.name))

    def _has_room(self, face: QFont) -> bool:
        parts, wide = segments(self._session.state.lesson), QFontMetricsF(face).horizontalAdvance
        return all(wide(tr(s.name)) + fine(6) < self._x(s.end) - self._x(s.begin) for s in parts if s.name)

    def _question(self, painter: QPainter, at: QPointF, theme: Theme) -> None:
        """A mark on the track where the lesson rests at a question."""
        radius = fine(MARK)
        painter.setPen(QPen(colour(theme.guess), fine(1.6)))
        painter.setBrush(colour(theme.panel))
        painter.drawEllipse(at, radius, radius)
        painter.setFont(type_face(11, QFont.Weight.DemiBold))
        painter.setPen(colour(theme.ink))
        inside = QRectF(at.x() - radius, at.y() - radius, 2 * radius, 2 * radius)
        painter.drawText(inside, Qt.AlignmentFlag.AlignCenter, "?")

    def _word(self, painter: QPainter, text: str, x: float, top: float, ink: QColor) -> None:
        painter.setFont(type_face(12, QFont.Weight.DemiBold))
        painter.setPen(ink)
        painter.drawText(QRectF(x - fine(30), top, fine(60), fine(15)), Qt.AlignmentFlag.AlignCenter, text)


def current(state: State) -> Segment:
    """The segment the state stands in."""
    axis = axis_of(state)
    mine = [s for s in segments(state.lesson) if s.beat == state.beat]
    return next((s for s in mine if axis <= s.end), mine[-1])


def next_speed(speed: float, by: int = 1) -> float:
    """The next of the speeds, round and round upwards, or held at an end downwards."""
    k = min(range(len(SPEEDS)), key=lambda i: abs(SPEEDS[i] - speed)) + by
    return SPEEDS[k % len(SPEEDS)]


def spoken_speed(speed: float) -> str:
    """A speed as people write it."""
    return f"{speed:g}×"


def tool_button(icon_name: str, theme: str, size: int = 32) -> QToolButton:
    """A flat button that keeps the focus where it is unless it is reached with Tab."""
    button = QToolButton()
    button.setIcon(icon(icon_name, theme))
    button.setIconSize(QSize(px(size - 12), px(size - 12)))
    button.setFixedSize(QSize(px(size), px(size)))
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    return button

"""A vector set as arrows on the integer lattice, for the mouse and the keys."""

from collections import Counter
from collections.abc import Callable
from math import hypot
from typing import Any

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFocusEvent, QFont, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.draw.theme import THEMES, mixed
from app.gui.look import GRID, colour, fine, line_of, px, type_face
from app.gui.session import Session
from app.laboratory import boxlab
from app.state import State
from app.words import tr
from subdivision import Role
from subdivision.catalogue import Vectors
from subdivision.passes import Vector
from subdivision.words import phrase

SIDE = 168
"""Height of the widget in pixels at 100 %, and how wide the lattice is at most."""

LEAST = 2
"""The lattice goes at least so far each way, and one step further than the longest vector."""

HEAD = 7.0
"""Length of an arrow's head in pixels at 100 %."""

WAYS = {Qt.Key.Key_Left: (-1, 0), Qt.Key.Key_Right: (1, 0), Qt.Key.Key_Down: (0, -1), Qt.Key.Key_Up: (0, 1)}
ADDING = (Qt.Key.Key_Return, Qt.Key.Key_Enter)
REMOVING = (Qt.Key.Key_Delete, Qt.Key.Key_Backspace)

HELP = (
    "Drag a tip to another point; onto the middle takes the vector away. Click a free point to add a vector. "
    "Keys: arrows move the ring, Enter adds or repeats, Delete removes, Alt+arrows carry the vector."
)


class Lattice(QWidget):
    """Arrows from the origin to the vectors; ``ring`` is the lattice point that is ringed."""

    own_keys = frozenset((*WAYS, *ADDING, *REMOVING))

    def __init__(self, session: Session, wish: Callable[..., None], can: Callable[..., bool]) -> None:
        """``wish`` does a change or says why not; ``can`` does it at once, or not."""
        super().__init__()
        self._session, self._wish, self._can = session, wish, can
        self._vectors: Vectors = ()
        self._theme = ""
        self._reach = LEAST
        self._held: int | None = None
        self._target: Vector | None = None
        self._under: Vector | None = None
        self.ring: Vector = (1, 1)
        self.setFixedHeight(px(SIDE))
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.setAccessibleName(tr("Vectors on the lattice"))
        self.setToolTip(tr(HELP))

    def show_state(self, state: State) -> None:
        vectors = boxlab.numbered(state.lab.rules[0]) if state.lab is not None else ()
        if (vectors, state.options.theme) == (self._vectors, self._theme):
            return
        self._vectors, self._theme = vectors, state.options.theme
        if self._held is None:
            self._fit()
        self._tell()
        self.update()

    def repeat(self) -> None:
        """The vector in the ring once more, or for the first time."""
        self._wish(boxlab.add_vector, self.ring)

    def remove(self) -> None:
        """The vector in the ring once less."""
        if (number := self._number(self.ring)) is not None:
            self._wish(boxlab.remove_vector, number)

    def place(self, vector: Vector) -> QPointF:
        """Where a point of the lattice is, in pixels."""
        step = self._step()
        return QPointF(self.width() / 2 + step * vector[0], self.height() / 2 - step * vector[1])

    # -- what there is ----------------------------------------------------------------------------

    def _fit(self) -> None:
        """The lattice as large as the vectors need."""
        longest = max((abs(x) for v in self._vectors for x in v), default=0)
        self._reach = min(max(LEAST, longest + 1), boxlab.LONGEST)
        self._set_ring(self.ring)

    def _set_ring(self, to: Vector) -> None:
        a, b = (min(max(x, -self._reach), self._reach) for x in to)
        self.ring = a, b
        self._tell()
        self.update()

    def _tell(self) -> None:
        times = self._vectors.count(self.ring)
        a, b = self.ring
        some = "at ({a},{b}): a vector" if times == 1 else "at ({a},{b}): a vector {n} times"
        words = some if times else "at ({a},{b}): no vector"
        self.setAccessibleDescription(tr(phrase(words, a=a, b=b, n=times)))

    def _number(self, vector: Vector) -> int | None:
        """The last pass along a vector, else the one that quadrupling uses up."""
        *passes, _, _ = self._vectors or ((0, 0), (0, 0))
        numbers = [k for k, v in enumerate(passes) if v == vector] or [
            k for k, v in enumerate(self._vectors) if v == vector
        ]
        return numbers[-1] if numbers else None

    def _step(self) -> float:
        return (min(self.width(), self.height()) - fine(GRID)) / (2 * self._reach + 1)

    def _point_at(self, at: QPointF) -> Vector:
        """The nearest point of the lattice."""
        step, middle = self._step(), self.place((0, 0))
        a, b = round((at.x() - middle.x()) / step), round((middle.y() - at.y()) / step)
        return min(max(a, -self._reach), self._reach), min(max(b, -self._reach), self._reach)

    # -- the hand ---------------------------------------------------------------------------------

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() not in (Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton):
            return
        self._session.let_go()
        self._set_ring(self._point_at(event.position()))
        if event.button() == Qt.MouseButton.RightButton:
            self.remove()
            return
        self._held, self._target = self._number(self.ring), self.ring

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        here = self._point_at(event.position())
        if here != self._under:
            self._under = here
            self.update()
        if self._held is None or here == self._target:
            return
        self._target = here
        if here != (0, 0) and self._can(boxlab.move_vector, self._held, here):
            self._set_ring(here)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        held, target = self._held, self._target
        self._held = self._target = None
        if event.button() != Qt.MouseButton.LeftButton or target is None:
            return
        if held is None and target == self._point_at(event.position()) != (0, 0):
            self._wish(boxlab.add_vector, target)
        elif held is not None and self._vectors[held] != target:
            self._wish(boxlab.move_vector, held, target)
        self._session.let_go()
        self._fit()

    def leaveEvent(self, event: Any) -> None:
        self._under = None
        self.update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        key = Qt.Key(event.key())
        if key in WAYS:
            to = self.ring[0] + WAYS[key][0], self.ring[1] + WAYS[key][1]
            if event.modifiers() & Qt.KeyboardModifier.AltModifier:
                self._carry(to)
            else:
                self._set_ring(to)
        elif key in ADDING:
            self.repeat()
        elif key in REMOVING:
            self.remove()
        else:
            super().keyPressEvent(event)

    def _carry(self, to: Vector) -> None:
        if (number := self._number(self.ring)) is None:
            return
        self._wish(boxlab.move_vector, number, to)
        self._session.let_go()
        if to in self._vectors or to == (0, 0):
            self._set_ring(to)

    def focusInEvent(self, event: QFocusEvent) -> None:
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.update()

    # -- paint ------------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:
        theme = THEMES[self._session.state.options.theme]
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._rule(painter, colour(line_of(theme)), colour(theme.net))
        self._rings(painter, colour(theme.accent), colour(mixed(theme.panel, theme.accent, 0.22)))
        for vector, times in sorted(Counter(self._vectors).items(), key=lambda one: -hypot(*one[0])):
            self._arrow(painter, vector, colour(theme.ink))
            if times > 1:
                self._count(painter, vector, times, colour(theme.ink))
        if self._held is not None and self._target not in (None, self._vectors[self._held]):
            self._arrow(painter, self._target or (0, 0), colour(theme.roles[Role.FACE]), dashed=True)
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(colour(theme.accent), fine(2)))
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(1, 1, -1, -1), fine(6), fine(6))
        painter.end()

    def _rule(self, painter: QPainter, line: QColor, axis: QColor) -> None:
        end = self._reach + 0.4
        middle, step = self.place((0, 0)), self._step() * end
        for k in range(-self._reach, self._reach + 1):
            painter.setPen(QPen(axis if k == 0 else line, fine(1.5 if k == 0 else 1.0)))
            x, y = self.place((k, 0)).x(), self.place((0, k)).y()
            painter.drawLine(QPointF(x, middle.y() - step), QPointF(x, middle.y() + step))
            painter.drawLine(QPointF(middle.x() - step, y), QPointF(middle.x() + step, y))

    def _rings(self, painter: QPainter, ink: QColor, ground: QColor) -> None:
        """Round what is ringed, and under the mouse."""
        radius = min(0.4 * self._step(), fine(9))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(ground)
        if self._under is not None:
            painter.drawEllipse(self.place(self._under), radius, radius)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(ink, fine(2.0 if self.hasFocus() else 1.2)))
        painter.drawEllipse(self.place(self.ring), radius, radius)

    def _arrow(self, painter: QPainter, vector: Vector, ink: QColor, *, dashed: bool = False) -> None:
        start, tip = self.place((0, 0)), self.place(vector)
        pen = QPen(ink, fine(2.2), Qt.PenStyle.DashLine if dashed else Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap)
        painter.setPen(pen)
        painter.drawLine(start, tip)
        length = hypot(tip.x() - start.x(), tip.y() - start.y())
        if length == 0:
            return
        back = (start - tip) * (fine(HEAD) / length)
        aside = QPointF(-back.y(), back.x()) * 0.55
        painter.setPen(QPen(ink, fine(2.2), Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawPolyline([tip + back + aside, tip, tip + back - aside])

    def _count(self, painter: QPainter, vector: Vector, times: int, ink: QColor) -> None:
        right, up = (vector[0] >= 0) - (vector[0] < 0), (vector[1] > 0) - (vector[1] <= 0)
        off, wide, tall = max(0.5 * self._step(), fine(11)), fine(32), fine(16)
        middle = self.place(vector) + QPointF(off * right, -off * up)
        painter.setFont(type_face(12, QFont.Weight.DemiBold))
        painter.setPen(ink)
        place = QRectF(middle.x() - wide / 2, middle.y() - tall / 2, wide, tall)
        painter.drawText(place, Qt.AlignmentFlag.AlignCenter, f"×{times}")

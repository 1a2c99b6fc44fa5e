"""The panel 'Shown': what the picture has on it."""

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QCheckBox, QVBoxLayout, QWidget

from app.draw.theme import THEMES, mixed
from app.gui.look import GRID, colour, fine, line_of, px, type_face
from app.gui.session import Session
from app.state import State, toggle
from app.words import tr

SHOWN = (
    ("surface", "Surface", "U"),
    ("net", "Net", "N"),
    ("ghost", "Ghost", "G"),
    ("helpers", "Centroids", "C"),
    ("weights", "Weights", "W"),
    ("control", "Control points", "P"),
    ("matrix", "Matrix", "M"),
    ("spectrum", "Eigenvalues", "K"),
    ("basis", "Basis function", "H"),
    ("labels", "Numbers", "L"),
    ("valences", "Valences", "V"),
    ("legend", "Legend", "I"),
    ("as_caption", "As in the caption", "A"),
)
"""Option, name, key: in the order of the panel, the View menu and the keys."""


TIPS = {"As in the caption": "Colours as the lecture's own caption names them, where it does (A)"}


class Shown(QWidget):
    """One switch for each option."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        self._switches = {option: Switch(name, key, session) for option, name, key in SHOWN}
        for option, switch in self._switches.items():
            switch.clicked.connect(lambda _, option=option: session.do(toggle, option))
            column.addWidget(switch)

    def show_state(self, state: State) -> None:
        for option, switch in self._switches.items():
            switch.setChecked(getattr(state.options, option))
        self._switches["as_caption"].setEnabled(bool(state.lesson.colours))


class Switch(QCheckBox):
    """A check box in the colours of the theme, with its key at the right."""

    def __init__(self, name: str, key: str, session: Session) -> None:
        super().__init__(tr(name))
        self._key, self._session = key, session
        self.setToolTip(tr(TIPS[name]) if name in TIPS else f"{tr(name)} ({key})")
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)

    def sizeHint(self) -> QSize:
        return QSize(px(144), px(28))

    def hitButton(self, pos: object) -> bool:
        return True

    def paintEvent(self, event: QPaintEvent) -> None:
        theme = THEMES[self._session.state.options.theme]
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setOpacity(1.0 if self.isEnabled() else 0.45)
        side = fine(16)
        box = QRectF(fine(1), (self.height() - side) / 2, side, side)
        edge = theme.accent if self.isChecked() or self.underMouse() else mixed(line_of(theme), theme.ink, 0.3)
        painter.setPen(QPen(colour(edge), fine(1.5)))
        painter.setBrush(colour(theme.accent) if self.isChecked() else Qt.BrushStyle.NoBrush)
        painter.drawRoundedRect(box, fine(4), fine(4))
        if self.isChecked():
            painter.setPen(QPen(colour(theme.background), fine(2), Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
            painter.drawPolyline(QPolygonF([box.topLeft() + QPointF(fine(x), fine(y)) for x, y in TICK]))
        painter.setFont(type_face(14))
        painter.setPen(colour(theme.ink))
        words = QRectF(box.right() + fine(GRID), 0, self.width() - box.right() - fine(3 * GRID), self.height())
        painter.drawText(words, Qt.AlignmentFlag.AlignVCenter, self.text())
        painter.setFont(type_face(12))
        painter.setPen(colour(theme.muted))
        painter.drawText(self.rect(), Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignRight, self._key)
        if self.hasFocus():
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(colour(theme.accent), fine(1.5)))
            painter.drawRoundedRect(QRectF(self.rect()).adjusted(-1, 1, -1, -1), fine(4), fine(4))
        painter.end()


TICK = ((4, 8.4), (7, 11.4), (12.2, 5.2))

"""Small pieces that panels are put together from."""

from typing import Self

from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import QFont, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QAbstractButton, QLabel, QScrollArea, QVBoxLayout, QWidget

from app.gui.look import fine, px, type_face
from app.words import tr


def column(*parts: QWidget, stretched: QWidget | None = None) -> QWidget:
    """Parts one under another, without gaps; one of them takes what room is left."""
    found = QWidget()
    layout = QVBoxLayout(found)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.setSpacing(0)
    for part in parts:
        layout.addWidget(part, 1 if part is stretched else 0)
    return found


def scrolled(part: QWidget) -> QScrollArea:
    """What has no room is scrolled to, up and down."""
    found = QScrollArea(widgetResizable=True)
    found.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    found.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    found.setWidget(part)
    return found


def heading(text: str) -> QLabel:
    """The name of a part of a panel."""
    label = QLabel(tr(text))
    label.setFont(type_face(12, QFont.Weight.DemiBold))
    label.setContentsMargins(0, 0, 0, px(4))
    return label


class Late(QWidget):
    """A panel that makes its parts when they are needed first: what is never looked at costs nothing."""

    def __init__(self) -> None:
        super().__init__()
        self.is_made = False

    def make(self) -> None:
        """Make the parts."""
        raise NotImplementedError

    def need(self) -> None:
        """The parts are needed from now on."""
        if not self.is_made:
            self.is_made = True
            self.make()
            polish(self)

    def inherit(self, before: Self) -> None:
        """Have parts if the panel before had."""
        if before.is_made:
            self.need()


def polish(panel: QWidget) -> None:
    """Give all parts of a panel their style now, which else takes its time when it is shown first."""
    for part in panel.findChildren(QWidget):
        part.ensurePolished()


class Section(QWidget):
    """A part of a panel under its name; a click on the name folds it away."""

    def __init__(self, title: str, *parts: QWidget, stretched: QWidget | None = None) -> None:
        super().__init__()
        self.head = Head(title)
        self.inside = column(*parts, gap(px(12)), stretched=stretched)
        self.head.toggled.connect(self.inside.setVisible)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.head)
        layout.addWidget(self.inside, 1)

    def fill(self, part: QWidget) -> None:
        """Put a part in the place of nothing."""
        self.inside.layout().insertWidget(0, part)  # type: ignore[union-attr]
        part.show()


class Head(QAbstractButton):
    """The name of a section with a chevron that points down while it is unfolded."""

    def __init__(self, title: str) -> None:
        super().__init__()
        self.setText(tr(title))
        self.setCheckable(True)
        self.setChecked(True)
        self.setFont(type_face(12, QFont.Weight.DemiBold))
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setToolTip(tr("Fold away or unfold"))
        self.setAccessibleName(tr(title))

    def sizeHint(self) -> QSize:
        return QSize(px(120), px(24))

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        ink = self.palette().windowText().color()
        painter.setPen(ink)
        painter.drawText(self.rect(), Qt.AlignmentFlag.AlignVCenter, self.text())
        painter.translate(self.width() - fine(9), self.height() / 2)
        painter.rotate(0 if self.isChecked() else -90)
        painter.setOpacity(0.9 if self.underMouse() or self.hasFocus() else 0.55)
        painter.setPen(QPen(ink, fine(1.6), Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawPolyline([QPointF(fine(x), fine(y)) for x, y in ((-4, -2), (0, 2), (4, -2))])
        painter.end()


def gap(height: int) -> QWidget:
    """Nothing, so many pixels high."""
    nothing = QWidget()
    nothing.setFixedHeight(height)
    return nothing


def emptied(layout: QVBoxLayout) -> None:
    """Take every part out of a column."""
    while (item := layout.itemAt(0)) is not None:
        if (old := item.widget()) is not None:
            taken_out(layout, old)
        else:
            layout.takeAt(0)


def taken_out(layout: QVBoxLayout, part: QWidget) -> None:
    """Take one part out of a column."""
    layout.removeWidget(part)
    part.hide()
    part.deleteLater()

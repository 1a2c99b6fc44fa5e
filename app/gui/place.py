"""Where a control point is, as three numbers that can be typed."""

from PySide6.QtWidgets import QDoubleSpinBox, QHBoxLayout, QSizePolicy, QWidget

from app.gui.look import px
from app.gui.session import Session
from app.state import State, drag
from app.words import tr
from subdivision.words import phrase

MOST = 1e6


class Place(QWidget):
    """x, y and z of the control point in focus; hidden while there is none."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self._session = session
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(px(4))
        self.boxes = [QDoubleSpinBox() for _ in "xyz"]
        for name, box in zip("xyz", self.boxes, strict=True):
            box.setRange(-MOST, MOST)
            box.setDecimals(3)
            box.setSingleStep(0.1)
            box.setKeyboardTracking(False)
            box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
            box.setAccessibleName(name)
            box.setToolTip(tr(phrase("{name}: type a number, Enter; or ↑ and ↓", name=name)))
            box.valueChanged.connect(self._typed)
            row.addWidget(box)
        self._shown: tuple[float, ...] = ()
        self.hide()

    def show_state(self, state: State) -> None:
        spot = state.focus
        self.setVisible(spot is not None and spot.stage == 0)
        if spot is None or spot.stage != 0:
            return
        points = state.trace(state.now.views[spot.pane]).control.points
        self._shown = tuple(float(x) for x in points[spot.point])
        for box, value in zip(self.boxes, self._shown, strict=True):
            box.blockSignals(True)
            box.setValue(value)
            box.blockSignals(False)

    def _typed(self) -> None:
        """A number was typed: the others stay exactly as they were."""
        spot = self._session.state.focus
        if spot is None:
            return
        kept = [
            box.value() if abs(box.value() - was) > 0.0006 else was
            for box, was in zip(self.boxes, self._shown, strict=True)
        ]
        self._session.do(drag, spot.point, (kept[0], kept[1], kept[2]))
        self._session.let_go()

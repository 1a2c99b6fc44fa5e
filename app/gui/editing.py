"""The panel that edits the control object of the laboratory: what is offered depends on its kind and on what is picked.

An edit that would break the object is answered with the reason.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QPushButton, QSizePolicy, QSlider, QVBoxLayout, QWidget

from app.gui.banner import Banner
from app.gui.look import GRID, px, sized, type_face
from app.gui.parts import Late, Section, column
from app.gui.session import Session
from app.gui.shown import Switch
from app.gui.stepper import Stepper
from app.laboratory import bench, editing
from app.state import State
from app.words import tr
from subdivision import Connectivity, Grid, Polyline, Topology, TopologyError
from subdivision.editing import fan_of
from subdivision.topology import INFINITELY_SHARP
from subdivision.words import phrase

EDITS = (
    ("insert", "Insert point", "Ins", "A point more where the polygon's edge was clicked, or beyond its picked end",
     editing.insert),
    ("delete", "Delete", "Del", "Delete the picked faces, the faces at the picked vertices, or the polygon's points",
     editing.delete),
    ("fill", "Fill hole", "F", "One face over the hole that the picked edge is on", editing.fill),
    ("flip", "Flip edge", "E", "The other diagonal of the two triangles at the picked edge", editing.flip),
    ("triangulate", "Triangulate", "", "All faces cut into triangles, along their shorter diagonals",
     editing.triangulate),
    ("turn_over", "Turn over", "", "All faces seen from the other side", editing.turn_over),
)  # fmt: skip
"""Command, name, key, what it does, how."""

SHARPNESS = (
    ("sharper", "Sharper", "S", 1),
    ("smoother", "Smoother", "Shift+S", -1),
)
"""Command, name, key, steps."""

HINTS: tuple[tuple[type, str], ...] = (
    (Polyline, "Click an edge to insert a point, or a point; Shift-click for more."),
    (Grid, "Drag its points, or change their number."),
    (Topology, "Click a point, an edge or a face; Shift-click for more."),
)
HIDDEN = "Go to the first stage, or show the control points, to pick a part."


class Editing(Late):
    """Buttons, the sharpness of what is picked, and the numbers of nets and fans."""

    def __init__(self, session: Session, banner: Banner) -> None:
        super().__init__()
        self._session, self._banner = session, banner
        self._about: tuple[object, ...] = ()
        self._section = Section("Edit")
        outside = QVBoxLayout(self)
        outside.setContentsMargins(0, 0, 0, 0)
        outside.addWidget(self._section)

    def make(self) -> None:
        self.hint = QLabel(wordWrap=True)
        self.hint.setFont(type_face(12))
        self.sharpness = Sharpness(lambda value: self.wish(editing.sharpen, value))
        self.buttons = {name: _button(title, key, tip, partial(self.wish, how)) for name, title, key, tip, how in EDITS}
        self.closed = self._switch("Closed", "Join the last point to the first", self._close)
        self.wrap_s = self._switch("Wrap s", "Join the first and the last row in direction s", self._wrap)
        self.wrap_t = self._switch("Wrap t", "Join the first and the last row in direction t", self._wrap)
        self.n_s = Stepper("points s", lambda by: self.wish(editing.turn_size, by, 0))
        self.n_t = Stepper("points t", lambda by: self.wish(editing.turn_size, 0, by))
        self.valence = Stepper("valence", lambda by: self.wish(editing.turn_fan, by, 0))
        self.rings = Stepper("rings", lambda by: self.wish(editing.turn_fan, 0, by))
        grid = QWidget()
        self._cells = QGridLayout(grid)
        self._cells.setContentsMargins(0, px(GRID / 2), 0, px(GRID / 2))
        self._cells.setSpacing(px(GRID / 2))
        for button in self.buttons.values():
            button.setParent(grid)  # those that are not offered are in no cell
        numbers = (self.n_s, self.n_t, self.wrap_s, self.wrap_t, self.closed, self.valence, self.rings)
        self._section.fill(column(self.hint, self.sharpness, grid, *numbers))

    def wish(self, transition: Callable[..., State], *args: Any) -> None:
        """Do it, or say why not; say so too if it needs another scheme."""
        before = self._session.state
        if not bench.is_open(before):
            return
        try:
            self._session.do(transition, *args)
        except TopologyError as refusal:
            self._banner.say(phrase("{reason:sentence}", reason=str(refusal)))
            self._about = ()
            self.show_state(self._session.state)
            return
        if said := editing.replaced_rule(before, self._session.state):
            self._banner.tell(phrase("{said:sentence}", said=said))

    def show_state(self, state: State) -> None:
        is_open = bench.is_open(state) and state.lab is not None
        self.setVisible(is_open)
        about = (state.lab, state.picked, state.at > 0, state.options.control)
        if not is_open or state.lab is None or about == self._about:
            return
        self._about = about
        self.need()
        t = state.lab.control.topology
        self.hint.setText(tr(hint(state)))
        self._show_buttons(state, t)
        sharpness = editing.sharpness(state)
        self.sharpness.setVisible(isinstance(t, Topology))
        self.sharpness.show_value(sharpness)
        self._show_polygon_and_net(t)
        fan = fan_of(state.lab.control) or (0, 0)
        for stepper, value, least, most in ((self.valence, fan[0], 3, 12), (self.rings, fan[1], 1, 4)):
            stepper.setVisible(value > 0)
            stepper.show_value(str(value), is_least=value <= least, is_most=value >= most)

    def _show_buttons(self, state: State, t: Connectivity) -> None:
        kind = state.picked.kind if state.picked is not None else ""
        is_mesh = isinstance(t, Topology)
        offered = {
            "insert": isinstance(t, Polyline),
            "delete": not isinstance(t, Grid),
            **dict.fromkeys(("fill", "flip", "triangulate", "turn_over"), is_mesh),
        }
        usable = {
            "insert": editing.insertion(state) is not None,
            "delete": kind in ("vertex", "face"),
            "fill": kind == "edge",
            "flip": kind == "edge",
        }
        shown = [name for name in self.buttons if offered[name]]
        for k, name in enumerate(shown):
            self._cells.addWidget(self.buttons[name], k // 2, k % 2)
        for name, button in self.buttons.items():
            button.setVisible(offered[name])
            button.setEnabled(usable.get(name, True))

    def _show_polygon_and_net(self, t: Connectivity) -> None:
        self.closed.setVisible(isinstance(t, Polyline))
        for part in (self.n_s, self.n_t, self.wrap_s, self.wrap_t):
            part.setVisible(isinstance(t, Grid))
        if isinstance(t, Polyline):
            self.closed.setChecked(t.closed)
        if isinstance(t, Grid):
            self.wrap_s.setChecked(t.wrap_s)
            self.wrap_t.setChecked(t.wrap_t)
            self.n_s.show_value(str(t.n_s), is_least=t.n_s <= 2, is_most=t.n_s >= 24)
            self.n_t.show_value(str(t.n_t), is_least=t.n_t <= 2, is_most=t.n_t >= 24)

    def _switch(self, name: str, tip: str, done: Callable[[], None]) -> Switch:
        switch = Switch(name, "", self._session)
        switch.setToolTip(tr(tip))
        switch.setAccessibleName(tr(name))
        switch.clicked.connect(lambda: done())
        return switch

    def _close(self) -> None:
        self.wish(editing.close, self.closed.isChecked())

    def _wrap(self) -> None:
        self.wish(editing.wrap, self.wrap_s.isChecked(), self.wrap_t.isChecked())


class Sharpness(QWidget):
    """0 to 10 in halves, of the picked edges or vertices; ``chosen`` is called when the hand lets go."""

    def __init__(self, chosen: Callable[[float], None]) -> None:
        super().__init__()
        self._chosen = chosen
        self._value = QLabel(alignment=Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.slider = _Slider(Qt.Orientation.Horizontal)
        self.slider.setRange(0, round(INFINITELY_SHARP / editing.STEP))
        self.slider.setPageStep(2)
        self.slider.setTracking(False)
        self.slider.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.slider.setAccessibleName(tr("Sharpness"))
        tip = "Sharpness of what is picked: 0 smooth, 10 for ever; it is one less at every level (S, Shift+S)"
        self.slider.setToolTip(tr(tip))
        self.slider.sliderMoved.connect(lambda step: self._value.setText(f"{step * editing.STEP:g}"))
        self.slider.valueChanged.connect(lambda step: self._chosen(step * editing.STEP))
        row = QHBoxLayout()
        row.addWidget(QLabel(tr("Sharpness")), 1)
        row.addWidget(self._value)
        rows = QVBoxLayout(self)
        rows.setContentsMargins(0, px(GRID / 2), 0, 0)
        rows.setSpacing(0)
        rows.addLayout(row)
        rows.addWidget(self.slider)

    def show_value(self, value: float | None) -> None:
        """That of what is picked; None: nothing that can be sharp is."""
        self.setEnabled(value is not None)
        self._value.setText("" if value is None else f"{value:g}")
        self.slider.blockSignals(True)
        self.slider.setValue(round((value or 0.0) / editing.STEP))
        self.slider.blockSignals(False)


class _Slider(QSlider):
    """Keeps the keys that move it."""

    own_keys = (
        *(Qt.Key.Key_Left, Qt.Key.Key_Right, Qt.Key.Key_Up, Qt.Key.Key_Down),
        *(Qt.Key.Key_Home, Qt.Key.Key_End),
    )


def hint(state: State) -> str:
    """What can be picked, or how much is."""
    picked = state.picked
    if picked is not None:
        return phrase("Picked: {parts}.", parts=_listed(picked.kind, picked.numbers))
    t = editing.control(state).topology
    if state.at > 0 and not state.options.control:
        return HIDDEN
    return next(words for kind, words in HINTS if isinstance(t, kind))


ONE = {"vertex": "vertex {number}", "edge": "edge {number}", "face": "face {number}"}
MANY = {"vertex": "{n} vertices", "edge": "{n} edges", "face": "{n} faces"}
"""What is picked, in words: one by its number, several by how many they are."""


def _listed(kind: str, numbers: tuple[int, ...]) -> str:
    return phrase(ONE[kind], number=numbers[0]) if len(numbers) == 1 else phrase(MANY[kind], n=len(numbers))


def _button(title: str, key: str, tip: str, clicked: Callable[[], None]) -> QPushButton:
    button = QPushButton(tr(title))
    button.setFont(type_face(12))
    button.setStyleSheet(sized("padding: 4px 0"))
    button.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    button.setAccessibleName(tr(title))
    button.setToolTip(f"{tr(tip)} ({key})" if key else tr(tip))
    button.clicked.connect(lambda: clicked())
    return button

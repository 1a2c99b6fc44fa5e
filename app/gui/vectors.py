"""The panel of the box spline that leads the laboratory: its vectors, what they promise, the order of its passes."""

import re
from collections.abc import Callable
from typing import Any, Self

from PySide6.QtCore import Qt
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from app.gui.choice import Choice
from app.gui.lattice import Lattice
from app.gui.look import GRID, px, sized, type_face
from app.gui.mask import MaskTable
from app.gui.parts import Late, Section
from app.gui.passes import Passes
from app.gui.session import Session
from app.gui.shown import Switch
from app.laboratory import boxlab
from app.state import State, toggle
from app.words import tr
from subdivision import TopologyError
from subdivision.catalogue import Vectors as VectorSet
from subdivision.continuity import alpha, degree, promise, smoothness
from subdivision.words import phrase

RICH = Qt.TextFormat.RichText
OWN = "Own vectors"


class Vectors(Late):
    """Shown while a box spline leads; a wish that is refused is answered with its sentence."""

    def __init__(self, session: Session, wish: Callable[..., None]) -> None:
        super().__init__()
        self._session, self._wish = session, wish
        self._about: VectorSet = ()
        self._section = Section("Box spline")
        outside = QVBoxLayout(self)
        outside.setContentsMargins(0, 0, 0, 0)
        outside.addWidget(self._section)

    def make(self) -> None:
        session = self._session
        self.preset = Choice("Vector set", self._choose)
        self.lattice = Lattice(session, self.do, self.can)
        self.repeat = _button("Repeat", "The vector in the ring once more (Enter)")
        self.repeat.clicked.connect(self.lattice.repeat)
        self.remove = _button("Remove", "The vector in the ring once less (Delete)")
        self.remove.clicked.connect(self.lattice.remove)
        self.facts, self.promise = (QLabel(wordWrap=wraps, textFormat=RICH) for wraps in (False, True))
        self.table = MaskTable(session)
        self.passes = Passes(session, self.do)
        self.basis = _button("Basis function", "A flat net with one point lifted by 1, as large as the vectors need")
        self.basis.clicked.connect(lambda: self.do(boxlab.basis))
        self.overlay = _button("Overlay another order", "The same passes in another order, beside it and laid over it")
        self.overlay.setCheckable(True)
        self.overlay.clicked.connect(lambda is_on: self.do(boxlab.overlay, int(is_on)))
        self.next = _button("Yet another order", "The next order of the same passes")
        self.next.clicked.connect(self._turn_order)
        self.picture = Switch("On the picture", "D", session)
        self.picture.clicked.connect(lambda: session.do(toggle, "lattice"))
        self.facts.setFont(type_face(14, QFont.Weight.DemiBold))
        self.facts.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.promise.setMinimumWidth(1)
        for label in (self.facts, self.promise):
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
            label.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(0, px(GRID / 2), 0, px(GRID))
        column.setSpacing(px(GRID))
        for part in (
            self.preset, self.lattice, _row(self.repeat, self.remove), self.facts, self.passes, self.promise,
            self.table, self.basis, self.overlay, self.next, self.picture,
        ):  # fmt: skip
            column.addWidget(part)
        self._section.fill(inside)

    def do(self, transition: Callable[..., State], *args: Any) -> None:
        """At once where that is quick; else, and where it is refused, as the laboratory does it, which says why."""
        if not self.can(transition, *args):
            self._wish(transition, *args)

    def can(self, transition: Callable[..., State], *args: Any) -> bool:
        """Do it if it is quick and not refused; nothing is said."""
        if not boxlab.is_quick(self._session.state):
            return False
        try:
            self._session.do(transition, *args)
        except TopologyError:
            return False
        return True

    def show_state(self, state: State) -> None:
        vectors = state.vectors
        self.setVisible(bool(vectors))
        if not vectors or state.lab is None:
            return
        self.need()
        self.lattice.show_state(state)
        self.passes.show_state(state)
        name = boxlab.preset_of(vectors)
        names = [(each, each) for each in boxlab.PRESETS]
        self.preset.show_values(names if name else [(OWN, ""), *names], name)
        self.picture.setChecked(state.options.lattice)
        self.overlay.setChecked(state.lab.overlay > 0)
        self.next.setVisible(state.lab.overlay > 0)
        if vectors != self._about:
            self._about = vectors
            self._tell(vectors)

    def inherit(self, before: Self) -> None:
        """Take over which point is ringed and which pass is chosen."""
        super().inherit(before)
        if not before.is_made:
            return
        self.lattice.ring = before.lattice.ring
        self.passes.setCurrentRow(before.passes.currentRow())

    def _tell(self, vectors: VectorSet) -> None:
        k = smoothness(vectors)
        smooth = phrase("jumps") if k < 0 else f"C<sup>{k}</sup>"
        numbers = {"degree": degree(vectors), "alpha": alpha(vectors), "smooth": smooth}
        words = phrase("degree {degree}   alpha {alpha}   {smooth}", **numbers)
        self.facts.setText(tr(words).replace("   ", "&nbsp; "))
        self.promise.setText(re.sub(r"C\^(\d+)", r"C<sup>\1</sup>", tr(promise(vectors))))
        self.table.show_vectors(vectors)

    def _choose(self, name: str) -> None:
        if name:
            self.do(boxlab.preset, name)

    def _turn_order(self) -> None:
        if self._session.state.lab is not None:
            self.do(boxlab.overlay, self._session.state.lab.overlay + 1)


def _button(name: str, tip: str) -> QPushButton:
    button = QPushButton(tr(name))
    button.setToolTip(tr(tip))
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    button.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
    button.setStyleSheet(sized("padding-left: 4px; padding-right: 4px"))
    return button


def _row(*parts: QWidget) -> QWidget:
    found = QWidget()
    row = QHBoxLayout(found)
    row.setContentsMargins(0, 0, 0, 0)
    row.setSpacing(px(GRID / 2))
    for part in parts:
        row.addWidget(part)
    return found

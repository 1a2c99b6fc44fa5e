"""The panel of the laboratory: the object on the table, and the rules that subdivide it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, Self

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QToolButton, QVBoxLayout, QWidget

from app.gui.banner import Banner
from app.gui.choice import Choice
from app.gui.look import GRID, px
from app.gui.parts import Late, Section, column, taken_out
from app.gui.session import Session
from app.gui.stepper import Stepper
from app.gui.vectors import Vectors
from app.gui.worker import Worker
from app.laboratory import bench
from app.laboratory.lab import MOST_LEVELS, MOST_PANES, Lab, Rule, titled
from app.state import State
from app.words import tr
from subdivision import Boundary, Topology, TopologyError, shapes
from subdivision.catalogue import FAMILIES, Parameter, Value, suiting
from subdivision.words import phrase

LIGHT = 6_000
"""Up to so many faces a change is worked out at once."""

BOUNDARIES = tuple((b.value.replace("-", " "), b) for b in Boundary)


class Laboratory(Late):
    """Shown while the laboratory is open; a wish that a scheme refuses is answered with its sentence."""

    def __init__(self, session: Session, banner: Banner, worker: Worker) -> None:
        super().__init__()
        self._session, self._banner, self.worker = session, banner, worker
        self._about: tuple[object, ...] = ()
        self.panes: list[Pane] = []
        self._section, self.vectors = Section("Laboratory"), Vectors(session, self.wish)
        outside = QVBoxLayout(self)
        outside.setContentsMargins(0, 0, 0, 0)
        outside.addWidget(self._section)
        outside.addWidget(self.vectors)

    def make(self) -> None:
        self.shape = Choice("Object", self._take)
        self.levels = Stepper("levels", self._turn_levels)
        self.more = QPushButton(tr("Compare with …"))
        self.more.setToolTip(tr("Another scheme, telling or rule beside it"))
        self.more.clicked.connect(lambda: self.wish(bench.compare))
        rules = QWidget()
        self._column = QVBoxLayout(rules)
        self._column.setContentsMargins(0, px(GRID / 2), 0, px(GRID))
        self._column.setSpacing(px(GRID / 2))
        self._section.fill(column(self.shape, self.levels, rules, self.more))

    def wish(self, transition: Callable[..., State], *args: Any) -> None:
        """Do it, or say why not; with a large object, where nobody waits for a picture."""
        state = self._session.state
        if _weight(state.lab) > LIGHT:
            self._work_out(lambda: transition(state, *args), lambda _: self._do(transition, *args))
        else:
            self._do(transition, *args)

    def _work_out(self, work: Callable[[], State], then: Callable[[State], None]) -> None:
        """What a transition works out is kept: once it has run elsewhere, it is quick on the state of the moment."""
        self.worker.start(
            work, then, self._refused,
            waiting="Working out the stages …",
            too_large="There is not enough memory for this; choose fewer levels.",
            broken="Something went wrong inside the program; the log has the details.",
        )  # fmt: skip

    def _do(self, transition: Callable[..., State], *args: Any) -> None:
        try:
            self._session.do(transition, *args)
        except TopologyError as refusal:
            self._refused(str(refusal))

    def _refused(self, sentence: str) -> None:
        """Say why not; what is shown is then what is so."""
        self._banner.say(sentence)
        self._about = ()
        self._session.changed.emit(self._session.state)  # not to this panel: another may be in its place by now

    def inherit(self, before: Self) -> None:
        """Take over what the panel before had chosen."""
        super().inherit(before)
        self.vectors.inherit(before.vectors)

    def show_state(self, state: State) -> None:
        is_open = bench.is_open(state) and state.lab is not None
        self.setVisible(is_open)
        if not is_open or state.lab is None:
            return
        self.need()
        lab = state.lab
        about = (lab.control.topology, tuple(rule.family for rule in lab.rules))
        if about != self._about:
            self._about = about
            self._fill(lab)
        names = [(titled(name), name) for name in shapes.SHAPES]
        own = [] if lab.name in shapes.SHAPES else [(titled(lab.name), lab.name)]
        self.shape.show_values([*own, *names], lab.name)
        self.levels.show_value(str(lab.levels), is_least=lab.levels <= 1, is_most=lab.levels >= MOST_LEVELS)
        for pane, rule in zip(self.panes, lab.rules, strict=True):
            pane.show_rule(rule, lab.levels)
        self.more.setEnabled(len(lab.rules) < MOST_PANES)
        self.vectors.show_state(state)

    def _fill(self, lab: Lab) -> None:
        """A pane for every rule; those that would be as they are stay."""
        families = tuple((each.title, each.name) for each in suiting(lab.control.topology))
        is_open = isinstance(lab.control.topology, Topology) and bool(lab.control.topology.boundary.any())
        offers = [Offer(k, rule.family, families, is_open, len(lab.rules) > 1) for k, rule in enumerate(lab.rules)]
        before = {pane.offer: pane for pane in self.panes}
        self.panes = [before.pop(offer) if offer in before else Pane(offer, self.wish) for offer in offers]
        for pane in before.values():
            taken_out(self._column, pane)
        for k, pane in enumerate(self.panes):
            self._column.insertWidget(k, pane)

    def _take(self, name: str) -> None:
        if name in shapes.SHAPES:
            self.wish(bench.take, name)

    def _turn_levels(self, by: int) -> None:
        if self._session.state.lab is not None:
            self.wish(bench.set_levels, self._session.state.lab.levels + by)


def _weight(lab: Lab | None) -> int:
    """How many faces the laboratory has after its last level and one more, about."""
    return lab.control.topology.n_vertices * 4 ** (lab.levels + 1) if lab is not None else 0


@dataclass(frozen=True)
class Offer:
    """What pane ``number`` offers: the numbers of its ``family``, all ``families`` by title and name, boundaries."""

    number: int
    family: str
    families: tuple[tuple[str, str], ...]
    is_open: bool
    is_one_of_many: bool


class Pane(QWidget):
    """The rule of one pane: scheme, its numbers, telling, boundary."""

    def __init__(self, offer: Offer, wish: Callable[..., None]) -> None:
        super().__init__()
        self.offer, number = offer, offer.number
        self.family = Choice("Scheme", partial(wish, bench.choose_family, number))
        self.parameters = [
            (p, Stepper(p.name, partial(wish, bench.turn_parameter, number, k)))
            for k, p in enumerate(FAMILIES[offer.family].parameters)
            if not p.is_vectors
        ]
        self.telling = Choice("Told", partial(wish, bench.choose_telling, number))
        self.boundary = Choice("Boundary", partial(wish, bench.choose_boundary, number))
        self.boundary.setVisible(offer.is_open)
        self.until = Stepper("to level", partial(wish, bench.turn_until, number))
        self.until.setVisible(number > 0)
        rows = QVBoxLayout(self)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(px(GRID / 2))
        if offer.is_one_of_many:
            rows.addWidget(_numbered(number, partial(wish, bench.drop, number)))
        for part in (
            self.family,
            *(stepper for _, stepper in self.parameters),
            self.telling,
            self.boundary,
            self.until,
        ):
            rows.addWidget(part)

    def show_rule(self, rule: Rule, levels: int) -> None:
        until = min(rule.until or levels, levels)
        self.until.show_value(str(until), is_least=until <= 1, is_most=until >= levels)
        self.family.show_values(self.offer.families, rule.family)
        values = {p.name: v for p, v in zip(FAMILIES[rule.family].parameters, rule.values, strict=True)}
        for parameter, stepper in self.parameters:
            _show_parameter(stepper, parameter, values[parameter.name])
        self.telling.show_values([(t, t) for t in rule.scheme.tellings], rule.told)
        self.boundary.show_values(BOUNDARIES, rule.boundary)


def _show_parameter(stepper: Stepper, parameter: Parameter, value: Value) -> None:
    if isinstance(value, tuple):
        return
    stepper.show_value(str(value), is_least=value <= parameter.least, is_most=value >= parameter.most)


def _numbered(number: int, drop: Callable[[], None]) -> QWidget:
    """The pane's number, and a button that takes it away."""
    close = QToolButton()
    close.setText("×")
    close.setToolTip(tr("Take this pane away"))
    close.setAccessibleName(tr(phrase("Take pane {n} away", n=number + 1)))
    close.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    close.clicked.connect(lambda: drop())
    found = QWidget()
    row = QHBoxLayout(found)
    row.setContentsMargins(0, px(GRID / 2), 0, 0)
    row.addWidget(QLabel(tr(phrase("Pane {n}", n=number + 1))), 1)
    row.addWidget(close)
    return found

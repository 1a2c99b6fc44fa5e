"""The panel 'Extraordinary points': what becomes of the surface at a vertex, and how far one may pull it."""

from collections.abc import Callable
from fractions import Fraction
from html import escape

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from app.draw.theme import THEMES, Theme
from app.gui.look import GRID, colour, px, sized, type_face
from app.gui.parts import Late, Section
from app.gui.pull import PullSlider, Track
from app.gui.session import Session
from app.gui.stepper import Stepper
from app.laboratory import bench
from app.laboratory.lab import Rule
from app.state import VALENCES, State, turn_valence, valence_of
from app.words import tr
from subdivision import TopologyError
from subdivision.catalogue import FAMILIES
from subdivision.extraordinary import EQUAL, PULL_RULES, Analysis, Condition, analysis, pull_rule
from subdivision.words import phrase


class Spectrum(Late):
    """Shown in the laboratory; ``wish`` does what is wished, or says why not."""

    def __init__(self, session: Session, wish: Callable[..., None]) -> None:
        super().__init__()
        self._session, self._wish = session, wish
        self._asked: tuple[Rule, int, Theme] | None = None
        self._section = Section("Extraordinary points")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self._section)

    def make(self) -> None:
        session = self._session
        self.valence = Stepper("valence", lambda by: session.do(turn_valence, by))
        self.words, self.way = _label(), _label()
        self.slider = PullSlider(lambda: session.state.options.theme, self._pull, session.let_go)
        self.vary = QPushButton(tr("Let the vertex rule be varied"))
        self.vary.setFont(type_face(12))
        self.vary.setStyleSheet(sized("padding: 4px 0"))
        self.vary.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.vary.setAccessibleName(self.vary.text())
        self.vary.setToolTip(tr("The same rule at this valence, with a slider for how far a vertex is pulled"))
        self.vary.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.vary.clicked.connect(lambda: self._wish(bench.vary_vertex_rule))
        inside = QWidget()
        rows = QVBoxLayout(inside)
        rows.setContentsMargins(0, 0, 0, 0)
        rows.setSpacing(px(GRID / 2))
        for part in (self.valence, self.way, self.slider, self.vary, self.words):
            rows.addWidget(part)
        self._section.fill(inside)

    def show_state(self, state: State) -> None:
        is_open = bench.is_open(state) and state.lab is not None and bool(state.now.lead.trace.control.topology.n_faces)
        self.setVisible(is_open)
        if not is_open or state.lab is None:
            return
        self.need()
        n, rule, theme = valence_of(state), state.lab.rules[0], THEMES[state.options.theme]
        self.valence.show_value(str(n), is_least=n == VALENCES.start, is_most=n == VALENCES.stop - 1)
        if (asked := (rule, n, theme)) != self._asked:
            self._asked = asked
            self.words.setText(_words(rule, n, theme))
        is_varied = rule.family in PULL_RULES
        self.vary.setVisible(not is_varied and pull_rule(rule.scheme) is not None)
        self.slider.setVisible(is_varied)
        self.way.setVisible(is_varied)
        if is_varied:
            self._show_pull(rule, n)

    def _show_pull(self, rule: Rule, n: int) -> None:
        found, (way,) = PULL_RULES[rule.family], rule.values
        assert isinstance(way, int | Fraction)
        track = Track(FAMILIES[rule.family].parameters[0], found.smooth(n), found.specials(n))
        self.slider.show_pull(track, Fraction(way))
        beta = f", β = {Fraction(way) * Fraction(3, 8 * n)}" if found.regular == 6 else ""
        least, most = decimals(float(track.smooth.least)), decimals(float(track.smooth.most))
        smooth = tr(phrase("C¹ between {least} and {most}", least=least, most=most))
        pull = tr(phrase("Pull = {way}", way=f"<b>{way}</b>"))
        is_regular = n == found.regular
        self.way.setText(tr("Regular: always all the way.") if is_regular else f"{pull}{beta}<br>{smooth}")

    def _pull(self, way: Fraction) -> None:
        self._wish(bench.pull, way)


def _words(rule: Rule, n: int, theme: Theme) -> str:
    """What is said of a rule at a valence, or why nothing can be."""
    try:
        return said(analysis(rule.scheme, n), theme)
    except TopologyError as refusal:
        return f'<span style="color:{colour(theme.muted).name()}">{escape(tr(str(refusal)))}</span>'


def said(found: Analysis, theme: Theme) -> str:
    """The eigenvalues mode by mode, and what follows from them."""
    muted = colour(theme.muted).name()
    ring, mode = found.subdominant, escape(tr(phrase("mode")))
    rows = "".join(
        f'<tr><td style="color:{muted}; padding-right:{px(8)}px">{escape(_mode(k))}</td>'
        f'<td align="right">{values}</td></tr>'
        for k, values in _by_mode(found)
    )
    return (
        f"<p>λ = {decimals(ring)}<br>λ² = {decimals(ring**2)}</p>"
        f"<table cellspacing='{px(1)}'><tr><td style='color:{muted}'>{mode}</td><td></td></tr>{rows}</table>"
        + "".join(_verdict(c, muted) for c in found.conditions)
    )


def _by_mode(found: Analysis) -> list[tuple[int, str]]:
    modes = sorted({e.mode for e in found.eigenvalues})
    return [(k, ", ".join(decimals(e.value) for e in found.eigenvalues if e.mode == k)) for k in modes]


def _mode(k: int) -> str:
    return "0" if k == 0 else f"±{k}"


def _verdict(c: Condition, muted: str) -> str:
    verdict = "{name}: {word}" if c.name != "C¹" else "{name} holds: {word}" if c.holds else "{name} fails: {word}"
    words = tr(phrase(verdict, name=f"<b>{tr(c.name)}</b>", word=escape(tr(c.word))))
    return f'<p>{words}<br><span style="color:{muted}">{escape(tr(c.why))}</span></p>'


def decimals(value: float) -> str:
    """Five decimals, as the lecture's tables have them; whole numbers plainly."""
    if abs(value - round(value)) <= EQUAL:
        return str(round(value))
    return f"{value:.5f}".replace("-", "−").replace("0.", ".", 1)


def _label() -> QLabel:
    label = QLabel(wordWrap=True, textFormat=Qt.TextFormat.RichText)
    label.setFont(type_face(12))
    label.setAlignment(Qt.AlignmentFlag.AlignTop)
    label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    label.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    return label

"""The panel 'Why is it here?': the exact weights of the point pointed at, and what the mesh counts."""

from html import escape

from PySide6.QtCore import Qt
from PySide6.QtGui import QPalette
from PySide6.QtWidgets import QGridLayout, QLabel, QVBoxLayout, QWidget

from app.draw.compose import in_focus, pointed
from app.draw.pointed import Pointed, row_of
from app.draw.theme import NAMES, THEMES
from app.gui.across import Across
from app.gui.look import GRID, colour, px, type_face
from app.gui.place import Place
from app.gui.session import Session
from app.state import State, level_of
from app.words import headed, tr
from lessons.script import View
from subdivision import Role, Stencil, TopologyError
from subdivision.exact import spelled, spelled_together
from subdivision.words import phrase

EMPTY = "Point at a vertex to see how it is made."
FIRST = "A control point: it is given, not made."
MOST = 12
"""Parents of one weight that are listed by number."""


class Why(QWidget):
    """A sentence, the weights by size, and the counts of the level."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self.across, self.place = Across(session), Place(session)
        self._words = QLabel(wordWrap=True, textFormat=Qt.TextFormat.RichText)
        self._words.setAlignment(Qt.AlignmentFlag.AlignTop)
        self._words.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._words.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._words.setMinimumHeight(px(16 * GRID))
        self._counts = [(QLabel(), QLabel(name)) for name in ("V", "E", "F", "χ")]
        self._level = QLabel()
        for quiet in (self._level, *(name for _, name in self._counts)):
            quiet.setForegroundRole(QPalette.ColorRole.PlaceholderText)
        self._about: tuple[object, ...] = ()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(px(GRID))
        column.addWidget(self.across)
        column.addWidget(self._words, 1)
        column.addWidget(self.place)
        column.addWidget(self._level)
        grid = QGridLayout()
        grid.setHorizontalSpacing(px(GRID))
        grid.setVerticalSpacing(px(4))
        for k, (number, name) in enumerate(self._counts):
            number.setFont(type_face(16))
            grid.addWidget(name, k // 2, 2 * (k % 2))
            grid.addWidget(number, k // 2, 2 * (k % 2) + 1)
            grid.setColumnStretch(2 * (k % 2) + 1, 1)
        column.addLayout(grid)

    def show_state(self, state: State) -> None:
        self.across.show_state(state)
        self.place.show_state(state)
        view, o = state.now.lead, state.options
        about = (state.lesson, state.beat, state.at, state.focus, o.theme, o.across, state.edits)
        if about == self._about:
            return
        self._about = about
        if state.focus is not None:
            view = state.now.views[state.focus.pane]
        row = pointed(state, view)
        muted = colour(THEMES[state.options.theme].muted).name()
        self._words.setText(_explained(state, view, row, muted))
        topology = state.trace(view).topology_at(int(view.at(state.progress)))
        euler = topology.euler if topology.n_faces else "–"
        numbers = (topology.n_vertices, topology.n_edges, topology.n_faces or "–", euler)
        for (number, _), value in zip(self._counts, numbers, strict=True):
            number.setText((f"{value:,}" if isinstance(value, int) else str(value)).replace("-", "−"))
        self._level.setText(headed(tr(phrase("level {level}", level=level_of(state)))))


def _explained(state: State, view: View, row: Pointed | None, muted: str) -> str:
    if row is None:
        words = EMPTY if state.focus is None else _refusal(state, view) or FIRST
        return f'<span style="color:{muted}">{escape(tr(words), quote=False)}</span>'
    stencil = row.stencil
    rows = [
        f'<tr><td align="right" style="padding-right:{px(12)}px"><b>{escape(weight)}</b></td>'
        f'<td style="padding-right:{px(12)}px; color:{muted}">×</td><td>{escape(points)}</td></tr>'
        for weight, points in grouped(stencil)
    ]
    sentence = "{point} is the sum of" if row.place is None else "{point} tends to the sum of"
    made = tr(phrase(sentence, point=f"<b>{_named(state, view, row)}</b>"))
    total = sum((w for _, w in stencil.terms), start=0 * stencil.terms[0][1])
    return (
        f"<p>{made}</p>"
        f"<table cellspacing='{px(2)}'>{''.join(rows)}</table>"
        f'<p style="color:{muted}">{escape(tr(phrase("The weights sum to {total}.", total=spelled(total))))}</p>'
    )


def _refusal(state: State, view: View) -> str:
    """Why there is no row to read."""
    spot = in_focus(state, view)
    try:
        if spot is not None:
            row_of(state.trace(view), spot, state.options.across)
    except TopologyError as reason:
        return str(reason)
    return ""


def grouped(stencil: Stencil) -> list[tuple[str, str]]:
    """Each weight, and the points that have it."""
    spelt = spelled_together([w for _, w in stencil.terms])
    found: dict[str, list[int]] = {}
    for weight, (parent, _) in zip(spelt, stencil.terms, strict=True):
        found.setdefault(weight, []).append(parent)
    return [(weight.replace("-", "−"), _listed(parents)) for weight, parents in found.items()]


def _listed(parents: list[int]) -> str:
    words = ", ".join(f"v{p}" for p in parents[:MOST])
    return words if len(parents) <= MOST else tr(phrase("{words} and {n} more", words=words, n=len(parents) - MOST))


def _named(state: State, view: View, row: Pointed) -> str:
    role = Role(int(state.trace(view).roles_at(row.stage)[row.stencil.point]))
    return f"v{row.stencil.point} ({tr(NAMES[role])})"

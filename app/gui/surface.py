"""The panel 'Surface shows': what a surface wears, its limit, and how fast the levels go there."""

from PySide6.QtWidgets import QVBoxLayout, QWidget

from app.draw.surface import SHOWS
from app.gui.choice import Choice
from app.gui.look import GRID, px
from app.gui.session import Session
from app.gui.shown import Switch
from app.state import State, choose, toggle
from app.words import tr
from subdivision.words import phrase

NEXT = "O"
"""The key that goes on to the next of the choices."""

SWITCHES = (("limit", "Limit surface", "J"), ("distances", "Distances", "Q"))
"""Option, name, key."""

TIPS = {
    "limit": "Every vertex of this level where it tends to (J)",
    "distances": "How far each level is from its limit, and how its normals agree (Q)",
}


class Surface(QWidget):
    """One list to choose from, and a switch for each option."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self.shows = Choice("Surface shows", lambda kind: session.do(choose, surface_shows=kind))
        self.shows.box.setToolTip(tr(phrase("What the surface shows ({key}: the next)", key=NEXT)))
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.shows)
        column.addSpacing(px(GRID / 2))
        self.switches = {option: Switch(name, key, session) for option, name, key in SWITCHES}
        for option, switch in self.switches.items():
            switch.setToolTip(tr(TIPS[option]))
            switch.clicked.connect(lambda _, option=option: session.do(toggle, option))
            column.addWidget(switch)

    def show_state(self, state: State) -> None:
        self.shows.show_values([(name, kind) for kind, name in SHOWS.items()], state.options.surface_shows)
        for option, switch in self.switches.items():
            switch.setChecked(getattr(state.options, option))


def show_next(state: State) -> State:
    """The surface shows the next of what it can, in the order of the list, and then nothing again."""
    kinds = list(SHOWS)
    return choose(state, surface_shows=kinds[(kinds.index(state.options.surface_shows) + 1) % len(kinds)])

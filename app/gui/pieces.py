"""What stands round the picture: it is made anew for other words and for another size."""

from dataclasses import dataclass
from typing import Any

from PySide6.QtWidgets import QWidget

from app.gui.contents import Contents
from app.gui.details import Details
from app.gui.editing import Editing
from app.gui.knobs import Knobs
from app.gui.laboratory import Laboratory
from app.gui.notes import Notes
from app.gui.parts import Section
from app.gui.shown import Shown
from app.gui.spectrum import Spectrum
from app.gui.surface import Surface
from app.gui.timeline import Timeline
from app.gui.why import Why


@dataclass(frozen=True, eq=False)
class Furniture:
    """The timeline and the panels; ``details`` is to hold ``sections``, of which ``place`` has what room is left."""

    timeline: Timeline
    contents: Contents
    laboratory: Laboratory
    editing: Editing
    spectrum: Spectrum
    knobs: Knobs
    shown: Shown
    surface: Surface
    why: Why
    notes: Notes
    details: Details
    place: Section
    sections: tuple[QWidget, ...]

    @property
    def views(self) -> tuple[Any, ...]:
        """What shows the state."""
        return (
            self.timeline, self.contents, self.laboratory, self.editing, self.spectrum, self.knobs, self.shown,
            self.surface, self.why, self.notes,
        )  # fmt: skip

    @property
    def heirs(self) -> tuple[Any, ...]:
        """What takes over from what was there before."""
        return self.contents, self.details, self.laboratory, self.editing, self.spectrum

"""What may come next is got ready while nothing happens: lessons told, words set, so that they open at once.

Telling a lesson and laying out its first picture for the first time take as long as some pictures; done before, they
are remembered.
Pieces are small and one at a time, in another thread, and panels in the window's; after any change there is a pause.
"""

import gc
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import TypeAlias

from PySide6.QtCore import QObject, QThreadPool, QTimer

from app.draw.compose import compose
from app.draw.layout import overlay
from app.gui.chore import Chore
from app.gui.narration import room
from app.gui.parts import Late
from app.gui.session import Session
from app.gui.viewport import Viewport
from app.laboratory import bench
from app.state import State, at_stop, open_lesson, segments, stops, valence_of
from app.words import LANGUAGES, catalogue
from lessons import built_in
from lessons.script import Kind, Lesson
from subdivision.extraordinary import analysis

QUIET, BETWEEN = 500, 10
"""Milliseconds without a change before the first piece, and from one piece to the next."""

SWITCH = 0.001
"""Seconds a piece under way keeps the window's thread waiting."""

GARBAGE = 5_000, 10, 20
"""How many new objects are looked through at a time; how many times what is left of them; and all that is newer."""

WAY = (0.9, 0.7, 0.5, 0.3, 0.1)
"""How many stages before a step the words are looked at that boxes have on the way there."""

Piece: TypeAlias = Callable[[], object]


class Ahead(QObject):
    """Does the pieces one after the other while the session rests."""

    def __init__(self, session: Session, viewport: Viewport) -> None:
        super().__init__()
        self._session, self._window = session, viewport.window()
        self._pieces = pieces(lambda: session.state, viewport)
        self._chore: Chore | None = None
        self._quiet = QTimer(self, singleShot=True)
        self._quiet.timeout.connect(self._go_on)

    def begin(self) -> None:
        """Get ready what comes next from now on, whenever nothing has changed for a while."""
        sys.setswitchinterval(SWITCH)
        look_for_garbage_in_little()
        self._session.changed.connect(self._wait)
        self._wait()

    def stop(self) -> None:
        """The window is closing."""
        self._session.changed.disconnect(self._wait)
        self._quiet.stop()
        QThreadPool.globalInstance().waitForDone()
        gc.unfreeze()

    def _wait(self) -> None:
        self._quiet.start(QUIET)

    def _go_on(self) -> None:
        if self._chore is not None or self._session.state.is_playing:
            return
        if (panel := next((each for each in self._window.findChildren(Late) if not each.is_made), None)) is not None:
            panel.need()
            self._quiet.start(BETWEEN)
        elif (piece := next(self._pieces, None)) is not None:
            self._chore = Chore("ahead", piece, self._is_over)  # what fails tells why when it is opened
            self._chore.begin()

    def _is_over(self, _: object) -> None:
        self._chore = None
        if not self._quiet.isActive():
            self._quiet.start(BETWEEN)


def look_for_garbage_in_little() -> None:
    """What there is now stays: to look for garbage in all of it takes longer than a picture, in much of it as long."""
    gc.freeze()
    gc.set_threshold(*GARBAGE)


def pieces(state: Callable[[], State], viewport: Viewport) -> Iterator[Piece]:
    """Languages read, the laboratory and all lessons told; then pictures.

    Those of the open lesson from here to its end come first, the beginning of each other, all the rest of them.
    """
    here = state()
    for code in LANGUAGES:
        yield partial(catalogue, code)
    if not bench.is_open(here):
        yield partial(_entered, here, viewport)
    others = [each for each in built_in() if each is not here.lesson]
    for lesson in others:
        yield partial(segments, lesson)
    if not bench.is_open(here):
        yield from played(here.lesson, state, viewport)
    for lesson in others:
        yield partial(_drawn, lesson, 0, state(), viewport)
        yield partial(room, open_lesson(state(), lesson), viewport.width(), viewport.window().height())
    for lesson in others:
        yield from played(lesson, state, viewport)
    yield gc.freeze  # lessons stay told


def played(lesson: Lesson, state: Callable[[], State], viewport: Viewport) -> Iterator[Piece]:
    """A lesson from its first step to its last."""
    for k in range(len(stops(lesson))):
        yield partial(_drawn, lesson, k, state(), viewport)
        for before in WAY:
            yield partial(_drawn, lesson, k, state(), viewport, before)


def _entered(state: State, viewport: Viewport) -> None:
    """Open the laboratory, and look at what it says of itself."""
    there = bench.enter(state)
    room(there, viewport.width(), viewport.window().height())
    overlay(compose(there), *viewport.room(), words=False)
    if there.lab is not None and there.now.lead.trace.control.topology.n_faces:
        analysis(there.lab.rules[0].scheme, valence_of(there))


def _drawn(lesson: Lesson, step: int, state: State, viewport: Viewport, before: float = 0.0) -> None:
    """Lay out the picture of a step, or of so many stages ``before`` it where boxes change their words on the way."""
    there = at_stop(state, stops(lesson)[step]) if lesson is state.lesson else open_lesson(state, lesson, step)
    at = max(there.at - before, there.now.start)
    if not before or any(view.kind is Kind.DIAGRAM for view in there.now.views):
        overlay(compose(replace(there, at=at)), *viewport.room(), words=False)

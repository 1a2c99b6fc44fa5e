"""The one object that holds the state: views listen to ``changed``, and every wish goes through ``do``."""

from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any, TypeAlias

from PySide6.QtCore import QElapsedTimer, QObject, Qt, QTimer, Signal

from app.laboratory.bench import pull
from app.laboratory.boxlab import move_pass, move_vector
from app.report import Recent
from app.state import Options, State, drag, look, seek, settle, tick, turn_view

STAGE = 0.8
"""Seconds a stage takes at speed 1."""

FRAME = 16
"""Milliseconds between frames while playing."""

SLOWEST = 100
"""Milliseconds: a frame that took longer counts as this, so that motion is never skipped."""

REMEMBERED = 500
"""How many changes can be undone."""

NOT_UNDONE = ("presenting", "blank", "scale", "language")
"""Options that are no change of what is shown: undoing leaves them."""

USUAL = Options()

Transition: TypeAlias = Callable[..., State]

GESTURES = (seek, drag, turn_view, move_vector, move_pass, pull)
"""Many of these in a row are one change to undo, until the hand lets go."""


class Session(QObject):
    """The state over time: what was, what was undone, and the clock that plays."""

    changed = Signal(object)

    def __init__(self, state: State, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.state = state
        self._past: list[State] = []
        self._future: list[State] = []
        self.recent = Recent()
        self._gesture: Transition | None = None
        self._clock = QElapsedTimer()
        self._timer = QTimer(self, interval=FRAME, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._advance)

    @property
    def can_undo(self) -> bool:
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        return bool(self._future)

    def do(self, transition: Transition, *args: Any, **options: Any) -> None:
        """Apply a transition of ``app.state``, remember what was before, and tell everybody."""
        self.recent.add(transition)
        before, after = self.state, transition(self.state, *args, **options)
        if _parts(before) == _parts(after):
            return
        if not (_is_passing(transition, before, after) or (transition in GESTURES and transition == self._gesture)):
            self._past = [*self._past[-REMEMBERED:], settle(before)]
            self._future = []
        if transition not in (look, tick):
            self._gesture = transition
        self._become(after)

    def rewrite(self, transition: Transition, *args: Any) -> None:
        """Apply a transition to the state and to all that can be undone and redone.

        What they were told from has changed.
        """
        self._past = [transition(each, *args) for each in self._past]
        self._future = [transition(each, *args) for each in self._future]
        after = transition(self.state, *args)
        if after is not self.state:
            self._gesture = None
            self._become(after)

    def let_go(self) -> None:
        """The hand lets go: the next drag, scrub or turn is another change."""
        self._gesture = None

    def undo(self) -> None:
        self.recent.add(self.undo)
        self._travel(self._past, self._future)

    def redo(self) -> None:
        self.recent.add(self.redo)
        self._travel(self._future, self._past)

    def stop(self) -> None:
        """Play no more: the window is closing."""
        self._timer.stop()

    def _travel(self, source: list[State], other: list[State]) -> None:
        if source:
            other.append(settle(self.state))
            self._gesture = None
            now = self.state.options
            kept = source.pop()
            options = replace(kept.options, **{name: getattr(now, name) for name in NOT_UNDONE})
            self._become(kept if options == kept.options else replace(kept, options=options))

    def _become(self, state: State) -> None:
        self.state = state
        if state.is_playing and not self._timer.isActive():
            self._clock.start()
            self._timer.start()
        if not state.is_playing:
            self._timer.stop()
        self.changed.emit(state)

    def _advance(self) -> None:
        seconds = min(self._clock.restart(), SLOWEST) / 1000
        self.do(tick, seconds * self.state.options.speed / STAGE)


def is_same_picture(one: State, other: State) -> bool:
    """Whether two states rest at the same picture: nothing between them could be undone."""
    return _parts(_plain(settle(one))) == _parts(_plain(settle(other)))


def _parts(state: State) -> tuple[Any, ...]:
    return tuple(getattr(state, each.name) for each in fields(state))


def _is_passing(transition: Transition, before: State, after: State) -> bool:
    """Whether a change is part of one already remembered (playing on, pausing), or nothing anybody would undo."""
    is_pause = before.is_playing and not after.is_playing and (before.beat, before.at) == (after.beat, after.at)
    return transition in (tick, look) or is_pause or _parts(_plain(before)) == _parts(_plain(after))


def _plain(state: State) -> State:
    usual = replace(state.options, **{name: getattr(USUAL, name) for name in NOT_UNDONE})
    return replace(state, focus=None, picked=None, options=usual)

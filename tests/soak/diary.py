"""A session that keeps a diary: what it was told can be told again, purely, and must lead to the same state.

States are compared by their digests, taken when they were made: an array that is changed later shows.
"""

import hashlib
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

import numpy as np

from app.draw.fading import faded
from app.gui.session import NOT_UNDONE, REMEMBERED, USUAL, Session, Transition
from app.state import Options, State, settle
from lessons.script import Lesson


@dataclass(frozen=True)
class Told:
    """One entry: a transition, or "undo" or "redo"; ``is_remembered``: whether what was before it can be undone to."""

    transition: Transition | str
    args: tuple[Any, ...] = ()
    options: Mapping[str, Any] | None = None
    is_remembered: bool = False


class Diary(Session):
    """A session whose clock stands still, and that notes every change; ``faults`` are changes that are wrong."""

    def __init__(self, state: State) -> None:
        super().__init__(state)
        self._timer.timeout.disconnect()
        self.faults: list[str] = []
        self._telling: Told | None = None
        self._digests: dict[str, list[Mapping[str, str]]] = {"undo": [], "redo": []}
        self._top: State | None = None
        self.begin()

    def begin(self) -> None:
        """A new page."""
        self._first, self._entries = (self.state, list(self._past), list(self._future)), []
        self._known = self.state

    @property
    def length(self) -> int:
        """How many changes can be undone."""
        return len(self._past)

    def do(self, transition: Transition, *args: Any, **options: Any) -> None:
        self._telling = Told(transition, args, options)
        super().do(transition, *args, **options)

    def undo(self) -> None:
        self._telling = Told("undo")
        super().undo()

    def redo(self) -> None:
        self._telling = Told("redo")
        super().redo()

    def rewrite(self, transition: Transition, *args: Any) -> None:
        """What it was told from has changed, so a new page begins."""
        self._telling = None
        super().rewrite(transition, *args)
        sides = {"undo": self._past, "redo": self._future}
        self._digests = {way: [_digests(_plain(each)) for each in side] for way, side in sides.items()}
        self._top = self._past[-1] if self._past else None
        self.begin()

    def check(self) -> None:
        """Tell it all again, without a window: the state, its picture and what can be undone must be the same."""
        states = _told_again(*self._first, self._entries)
        for name, here, there in zip(("state", "past", "future"), (self.state, self._past, self._future), states,
                                     strict=True):  # fmt: skip
            if digest(here) != digest(there):
                self.faults.append(f"told again, the {name} is another one after {len(self._entries)} changes")
        if digest(faded(self.state)) != digest(faded(states[0])):
            self.faults.append("told again, the picture of the state is another one")
        self.begin()

    def _become(self, state: State) -> None:
        if self._known is not self.state:
            self.faults.append("the state was changed without being told")
        told, self._telling = self._telling, None
        if told is not None:
            self._entries.append(self._noted(told, state))
        self._known, self._top = state, self._past[-1] if self._past else None
        super()._become(state)

    def _noted(self, told: Told, state: State) -> Told:
        """What is told, and whether what was before it can be undone to."""
        if isinstance(told.transition, str):
            self._travelled(told.transition, state)
        elif self._past and self._past[-1] is not self._top:
            self._digests["undo"] = [*self._digests["undo"], _digests(_plain(self._past[-1]))][-REMEMBERED - 1 :]
            self._digests["redo"] = []
            return replace(told, is_remembered=True)
        return told

    def _travelled(self, way: str, state: State) -> None:
        """Undone or redone: it must be what was noted when it was."""
        other = {"undo": "redo", "redo": "undo"}[way]
        self._digests[other].append(_digests(_plain(settle(self.state))))
        was, now = self._digests[way].pop(), _digests(_plain(state))
        if was != now:
            others = ", ".join(name for name in now if was[name] != now[name])
            self.faults.append(f"{way} leads to another state than there was: {others}")


def _plain(state: State) -> State:
    """What undo brings back; the rest is of the room."""
    return _in_the_room_of(state, USUAL)  # whose language is always the same one


def _told_again(state: State, past: list[State], future: list[State], entries: Sequence[Told]) -> tuple[Any, ...]:
    """State, past and future as values of what was told."""
    for told in entries:
        if not isinstance(told.transition, str):
            after = told.transition(state, *told.args, **(told.options or {}))
            past, future = ([*past[-REMEMBERED:], settle(state)], []) if told.is_remembered else (past, future)
            state = after
        elif told.transition == "undo":
            past, kept, future = past[:-1], past[-1], [*future, settle(state)]
            state = _in_the_room_of(kept, state.options)
        else:
            future, kept, past = future[:-1], future[-1], [*past, settle(state)]
            state = _in_the_room_of(kept, state.options)
    return state, past, future


def _in_the_room_of(kept: State, now: Options) -> State:
    return replace(kept, options=replace(kept.options, **{name: getattr(now, name) for name in NOT_UNDONE}))


def _digests(state: State) -> Mapping[str, str]:
    """Of every part of a state."""
    return {each.name: digest(getattr(state, each.name)) for each in fields(state)}


def digest(value: Any) -> str:
    """Equal for equal values, whatever they are made of; a lesson of the lecture counts by its name and knobs."""
    found = hashlib.blake2b(digest_size=12)
    _feed(found, value)
    return found.hexdigest()


def _feed(found: Any, value: Any) -> None:
    found.update(type(value).__name__.encode())
    if isinstance(value, Lesson):
        _feed(found, (value.id, value.values))
    elif isinstance(value, np.ndarray):
        found.update(f"{value.shape}{value.dtype}".encode() + np.ascontiguousarray(value).tobytes())
    elif is_dataclass(value) and not isinstance(value, type):
        for each in fields(value):
            if each.compare or each.init:
                _feed(found, getattr(value, each.name))
    elif isinstance(value, Mapping):
        for name, inside in value.items():
            _feed(found, (name, inside))
    elif isinstance(value, Set):
        _feed(found, sorted(map(repr, value)))
    elif isinstance(value, tuple | list):
        found.update(str(len(value)).encode())
        for inside in value:
            _feed(found, inside)
    elif callable(value):
        found.update(getattr(value, "__qualname__", "").encode())
    else:
        found.update(repr(value).encode())

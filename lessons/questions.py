"""What a class is asked before it sees: where a point will go, how much a weight is, which picture comes next.

No answer is written down: it is read from the beat that gives it, and wrong ones are numbers and pictures that the
engine makes too.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from subdivision import Mesh, Stencil
from subdivision.exact import Exact

if TYPE_CHECKING:
    from lessons.script import Beat, View

MOST = 4
"""Answers to choose from; two are the fewest."""


@dataclass(frozen=True, eq=False)
class Where:
    """Asks where point number ``point`` will be when the beat is over, in its pane number ``pane``."""

    text: str
    point: int
    pane: int = 0

    def before(self, beat: "Beat") -> int:
        """The number that the point has when the beat begins; -1 where it is born on the way."""
        view, point = beat.views[self.pane], self.point
        for stage in reversed(view.trace.stages[int(view.start) : int(view.stop)]):
            point = int(stage.carries[point]) if point >= 0 else -1
        return point


@dataclass(frozen=True, eq=False)
class Weight:
    """Asks for the weight of ``parent`` in a ``row``; ``answers`` has it and wrong ones, the least first."""

    text: str
    row: Stencil
    parent: int
    answers: tuple[Exact, ...]

    def truth(self, beat: "Beat") -> int:
        """Which of the answers is the weight."""
        return _only([w == self.row.weight(self.parent) for w in self.answers], self.text)


@dataclass(frozen=True, eq=False)
class Which:
    """Asks which of some pictures, its ``answers``, the beat comes to."""

    text: str
    answers: "tuple[View, ...]"

    def truth(self, beat: "Beat") -> int:
        """Which of the pictures shows what one of the beat's does in the end."""
        return _only([any(_is_same(pane, view) for view in beat.views) for pane in self.answers], self.text)


Question: TypeAlias = Where | Weight | Which


def where(point: int, text: str, pane: int = 0) -> Where:
    """Ask where a point will go; ``point`` is its number when the beat is over."""
    return Where(text, point, pane)


def weight(row: Stencil, parent: int, text: str, *others: Exact) -> Weight:
    """Ask for the weight of one parent in a row.

    Wrong answers are ``others`` (say, the same weight by another rule), weights that the row gives elsewhere, an equal
    share, and what this parent leaves to the rest: the first that differ.
    """
    true = row.weight(parent)
    elsewhere = [w for _, w in row.terms]
    found = dict.fromkeys([true, *others, *elsewhere, Fraction(1, len(elsewhere)), 1 - true])
    return Weight(text, row, parent, tuple(sorted(list(found)[:MOST], key=float)))


def which(text: str, *panes: "View") -> Which:
    """Ask which of some pictures comes next."""
    return Which(text, panes)


def checked(beat: "Beat") -> Question:
    """The question of a beat, which it answers.

    Raises
    ------
    ValueError
        If the beat gives no answer, or there is not exactly one true among two to four; it says the mend too.
    """
    asked = beat.predict
    if asked is None:
        raise ValueError(f"'{beat.text}': nothing is asked here; give it 'predict'")
    if isinstance(asked, Where):
        if not 0 <= asked.pane < len(beat.views) or beat.is_still:
            raise ValueError(f"'{asked.text}': nothing moves there; ask it of a beat that plays, in one of its panes")
        n = len(beat.views[asked.pane].trace.roles_at(int(beat.views[asked.pane].stop)))
        if not 0 <= asked.point < n:
            raise ValueError(f"'{asked.text}': there is no point {asked.point} then; ask for one from 0 to {n - 1}")
        return asked
    if not 2 <= (n := len(asked.answers)) <= MOST:
        raise ValueError(f"'{asked.text}': {n} answers to choose from; give two to {MOST} that differ")
    asked.truth(beat)
    return asked


def _only(which: list[bool], text: str) -> int:
    if sum(which) != 1:
        raise ValueError(f"'{text}': {sum(which)} of the answers are true; give exactly one that is")
    return which.index(True)


def _is_same(one: "View", other: "View") -> bool:
    """Whether two views end in the same picture."""
    if one.stencil is not None and one.kind is other.kind and other.stencil is not None and one.trace is other.trace:
        return one.stencil == other.stencil
    a, b = (_end(view) for view in (one, other))
    return a.points.shape == b.points.shape and np.array_equal(a.topology.ends, b.topology.ends) and np.allclose(
        a.points, b.points, atol=1e-9
    )


def _end(view: "View") -> Mesh:
    return view.trace.mesh_at(int(view.stop))

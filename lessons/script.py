"""What a lesson is made of: beats, each a sentence over a stretch of a trace.

A lesson file holds one function that yields its beats; ``@lesson`` makes the lesson of it.
Beats are values: going back, jumping and exporting are indexing.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property
from typing import TypedDict, Unpack

import numpy as np

from subdivision import Boundary, Mesh, Stage, Stencil, Trace


class Kind(Enum):
    """How a trace is drawn."""

    SCENE = "scene"
    """As points, edges and faces in space."""
    DIAGRAM = "diagram"
    """As boxes of coefficients: a pyramid for a polygon, an array for a net."""


@dataclass(frozen=True, eq=False)
class View:
    """One pane of a beat: ``trace`` runs from stage position ``start`` to ``stop`` while the beat plays."""

    trace: Trace
    start: float
    stop: float
    kind: Kind = Kind.SCENE
    title: str = ""

    def at(self, progress: float) -> float:
        """The stage position at ``progress`` (0..1) through the beat."""
        return self.start + progress * (self.stop - self.start)


@dataclass(frozen=True)
class Look:
    """Where the camera stands: degrees round the z axis, degrees above the x-y plane (90: from above), zoom."""

    azimuth: float = -50.0
    elevation: float = 25.0
    zoom: float = 1.0
    parallel: bool = False


FLAT = Look(azimuth=-90.0, elevation=90.0, parallel=True)
"""Straight from above, x to the right and y up: for plane curves."""


@dataclass(frozen=True, eq=False)
class Beat:
    """Say ``text`` while the first view's trace runs from its start to its stop (equal: a still).

    Attributes
    ----------
    text : str
        The caption: short, present tense, readable from the back row.
    views : tuple of View
        What is shown, side by side; the first one leads the timeline.
    formula : str
        Mathematics between dollar signs, set beside the caption.
    notes : str
        What the lecturer may say; not on the picture.
    stencil : Stencil or None
        A row to point out: its point, its contributors, their weights.  It belongs to the end of the beat.
    span : int
        How many stages back the stencil's parents live (1: the stage just played).
    look : Look
        Where the camera stands.
    claim : bool
        What the text asserts about the numbers; the tests require it.
    """

    text: str
    views: tuple[View, ...]
    formula: str = ""
    notes: str = ""
    stencil: Stencil | None = None
    span: int = 1
    look: Look = Look()
    claim: bool = True

    @property
    def lead(self) -> View:
        return self.views[0]

    @property
    def start(self) -> float:
        return self.lead.start

    @property
    def stop(self) -> float:
        return self.lead.stop

    @property
    def is_still(self) -> bool:
        return self.start == self.stop

    def progress(self, at: float) -> float:
        """How far the beat has come when its leading view stands at ``at``."""
        return 1.0 if self.is_still else (at - self.start) / (self.stop - self.start)


Script = Callable[[], Iterator[Beat]]


@dataclass(frozen=True, eq=False)
class Lesson:
    """A story in beats.

    Attributes
    ----------
    id : str
        The name of its function and file: ``figure_14_cube``.
    title : str
    section : str
        The heading it stands under; headings sort by their number.
    ours : str
        What the lecture does not say and we inferred; empty where all is the lecture's own.
    """

    id: str
    title: str
    section: str
    script: Script
    ours: str = ""

    @cached_property
    def beats(self) -> tuple[Beat, ...]:
        return tuple(self.script())


def lesson(title: str, *, section: str, ours: str = "") -> Callable[[Script], Lesson]:
    """Make a lesson of the function that tells it."""
    return lambda script: Lesson(script.__name__, title, section, script, ours)


class Said(TypedDict, total=False):
    """What ``show`` and ``play`` may add to their sentence: the fields of a ``Beat``."""

    formula: str
    notes: str
    stencil: Stencil | None
    span: int
    look: Look
    claim: bool


def show(trace: Trace, after: Stage | None, text: str, **said: Unpack[Said]) -> Beat:
    """A still picture of the control object ``after`` a stage (None: before the first)."""
    at = trace.index(after) + 1 if after else 0
    return _beat(trace, (at, at), text, said)


def play(trace: Trace, first: Stage, text: str, *, until: Stage | None = None, **said: Unpack[Said]) -> Beat:
    """One stage, animated; or all stages from ``first`` ``until`` another one."""
    return _beat(trace, (trace.index(first), trace.index(until or first) + 1), text, said)


def beside(beat: Beat, *others: View) -> Beat:
    """The same beat with more panes beside it."""
    return replace(beat, views=(*beat.views, *others))


def diagram_of(beat: Beat, title: str = "") -> View:
    """The leading view's trace as a diagram, in step with it."""
    return replace(beat.lead, kind=Kind.DIAGRAM, title=title)


def fragment(mesh: Mesh) -> Mesh:
    """A piece of a larger mesh: the faces that touch its boundary are there for the others, and drawn faint."""
    return Mesh(mesh.surface.with_boundary(Boundary.HIDE), mesh.points)


def look_at(trace: Trace) -> Look:
    """From above at what lies in the x-y plane, else from the front right."""
    return FLAT if np.ptp(trace.control.points[:, 2]) < 1e-9 else Look()


def _beat(trace: Trace, stretch: tuple[float, float], text: str, said: Said) -> Beat:
    said.setdefault("look", look_at(trace))
    return Beat(text, (View(trace, *stretch),), **said)

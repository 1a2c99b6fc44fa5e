"""What recorded steps are made of: views of other lessons, control objects under a boundary rule or from a file."""

from dataclasses import dataclass, replace
from pathlib import Path

from lessons.script import View
from subdivision import Boundary, Mesh, Trace, files


@dataclass(frozen=True)
class Quoted:
    """Where a view is told: a pane of a beat (from 0) of a lesson, with its knobs."""

    lesson: str
    beat: int
    pane: int
    knobs: tuple[tuple[str, int], ...]


_origins: dict[Trace, Quoted] = {}


def quoted(lesson: str, beat: int, pane: int = 0, **knobs: int) -> View:
    """A view of a lesson of the program, by its id.

    Raises
    ------
    KeyError
        If there is no such lesson.
    IndexError
        If it has no such beat or pane.
    """
    from lessons import built_in

    told = next((each for each in built_in() if each.id == lesson), None)
    if told is None:
        raise KeyError(f"there is no lesson {lesson} to quote")
    view = told.turned(**knobs).beats[beat].views[pane]
    _origins.setdefault(view.trace, Quoted(lesson, beat, pane, tuple(knobs.items())))
    return view


def origin(trace: Trace) -> Quoted | None:
    """Where a trace has been quoted from."""
    return _origins.get(trace)


def bounded(mesh: Mesh, rule: Boundary) -> Mesh:
    """A polygon mesh under a boundary rule."""
    return replace(mesh, topology=mesh.surface.with_boundary(rule))


def mesh_beside(file: str, name: str) -> Mesh:
    """The control object in a file that lies beside a lesson: ``mesh_beside(__file__, "corner.obj")``."""
    return files.read(Path(file).with_name(name))

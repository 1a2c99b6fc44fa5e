"""Exports in the making: all files in a folder of their own first, then each in its place, so none is half there."""

import os
import shutil
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import lessons
from app.export.wish import ExportError, Wish
from app.figures import FigureError, file_name, png, stood_on, svg
from app.state import State, at_stop, last, settle, start, stops
from lessons.script import View
from subdivision import Mesh, TopologyError, Trace, files, subdivide
from subdivision.files.saving import part_of
from subdivision.words import phrase

Progress: TypeAlias = Callable[[float, str], None]
Part: TypeAlias = Callable[[float], None]
"""Told how much of one file is done, 0..1."""


@dataclass(frozen=True)
class Job:
    """One file: its name in a folder, what it is called while it is made, and what writes it."""

    name: str
    called: str
    write: Callable[[Path, Part], None]


def export(state: State, wish: Wish, out: Path, progress: Progress = lambda done, name: None) -> list[Path]:
    """Write what is wished for to a file, or where it is several into a folder; the paths.

    ``progress`` is called with the part done (0..1) and what is being made.  Whatever goes wrong, and whatever
    ``progress`` raises to stop it, leaves ``out`` as it was.

    Raises
    ------
    ExportError
    """
    wish = wish.checked(state.options.theme)
    out = wish.named(Path(out))
    try:
        jobs = list(_jobs(settle(state), wish))
        if not jobs:
            raise ExportError("there is no mesh in it: its control objects are polygons; choose a picture")
        with _aside(out) as folder:
            for k, job in enumerate(jobs):

                def part(done: float, k: int = k, called: str = job.called) -> None:
                    progress((k + done) / len(jobs), called)

                part(0.0)
                job.write(folder / job.name, part)
            return _placed(folder, jobs, wish, out)
    except (FigureError, TopologyError, files.FileError) as fault:
        raise ExportError(str(fault)) from fault
    except OSError as fault:
        raise ExportError(
            phrase("{out} cannot be written: {reason}; choose another folder", out=out, reason=fault.strerror or fault)
        ) from fault


@contextmanager
def _aside(out: Path) -> Iterator[Path]:
    """A folder beside ``out`` that goes, with all that is in it, when the work is over."""
    if not out.absolute().parent.is_dir():
        raise ExportError(phrase("there is no folder {folder}; choose another one", folder=out.absolute().parent))
    folder = part_of(out.absolute())
    try:
        folder.mkdir()
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _placed(folder: Path, jobs: Sequence[Job], wish: Wish, out: Path) -> list[Path]:
    """Everything is made, and on the disk: into its place."""
    made = [folder / job.name for job in jobs]
    for path in made:
        with path.open("rb+") as file:
            os.fsync(file.fileno())
    places = [out / path.name for path in made] if wish.is_folder else [out]
    if (taken := next((place for place in places if place.is_dir()), None)) is not None:
        raise ExportError(phrase("{path} is a folder; choose another name", path=taken))
    if wish.is_folder:
        out.mkdir(exist_ok=True)
    return [path.replace(place) for path, place in zip(made, places, strict=True)]


# -- what is to be made -----------------------------------------------------------------------


def _jobs(state: State, wish: Wish) -> Iterator[Job]:
    match wish.kind.each:
        case "step":
            yield from _pictures(state, wish)
        case "lesson":
            make = _page if wish.format == "html" else _film
            yield from (make(each, wish) for each in _lessons(state, wish))
        case "level":
            yield from _meshes(state, wish)
        case _:
            told = [_steps(each, wish) for each in _lessons(state, wish)]
            yield Job(
                file_name(state.lesson, wish.kind.suffix[1:]), "", lambda path, part: _bound(told, wish, path, part)
            )


def _lessons(state: State, wish: Wish) -> list[State]:
    """The lesson, or all of them in the looks of the state."""
    return [start(each, state.options) for each in lessons.all_lessons()] if wish.of == "everything" else [state]


def _steps(state: State, wish: Wish) -> list[State]:
    """The view, or every step of its lesson."""
    return [state] if wish.of == "view" else [at_stop(state, stop) for stop in stops(state.lesson)]


def _pictures(state: State, wish: Wish) -> Iterator[Job]:
    paint = png if wish.format == "png" else svg
    for each in _lessons(state, wish):
        for k, step in enumerate(_steps(each, wish), 1):

            def write(path: Path, part: Part, step: State = step) -> None:
                path.write_bytes(paint(step, wish.size, wish.background))

            yield Job(file_name(each.lesson, wish.format, k), _called(step, k), write)


def _page(state: State, wish: Wish) -> Job:
    """The lesson as a page that plays by itself."""

    def write(path: Path, part: Part) -> None:
        from app.page import page_of

        path.write_bytes(page_of(state, part))

    return Job(file_name(state.lesson, wish.format), state.lesson.title, write)


def _film(state: State, wish: Wish) -> Job:
    """The lesson played; of the view, the stage it shows."""

    def write(path: Path, part: Part) -> None:
        from app.draw import film

        rate = film.FINE if wish.format == "mp4" else film.RATE
        tell = film.stage_shots if wish.of == "view" else film.shots
        played, (width, height) = list(tell(state, rate, wish.pace)), wish.size
        if wish.format == "gif":
            path.write_bytes(film.gif(
                played, width, height, look=lambda p: stood_on(p, wish.background),
                transparent=wish.background == "transparent", progress=part,
            ))  # fmt: skip
            return
        try:
            film.film(played, width, height, path, look=lambda p: stood_on(p, wish.background), progress=part)
        except film.FilmError as fault:
            raise ExportError(str(fault)) from fault

    return Job(file_name(state.lesson, wish.format), state.lesson.title, write)


def _bound(told: Sequence[Sequence[State]], wish: Wish, path: Path, part: Part) -> None:
    """Many steps in one file."""
    match wish.format:
        case "pptx":
            from app.export.deck import deck as bind
        case "handout":
            from app.export.handout import handout as bind
        case _:
            from app.export.pages import pages as bind
    path.write_bytes(bind(told, wish.size, wish.background, part))


# -- meshes -----------------------------------------------------------------------------------


def _meshes(state: State, wish: Wish) -> Iterator[Job]:
    """The finest mesh in the view; of a lesson the finest one at its end, level by level."""
    if wish.of == "view":
        yield _mesh(file_name(state.lesson, wish.format), state, wish, wish.level)
        return
    for each in _lessons(state, wish):
        there = last(each)
        if (view := _finest(there)).trace.control.topology.n_faces:
            for level in range(_levels(there.trace(view), int(view.at(1.0))) + 1):
                name = Path(file_name(each.lesson, wish.format))
                yield _mesh(f"{name.stem}-level-{level}{name.suffix}", there, wish, level)


def _mesh(name: str, state: State, wish: Wish, level: int | None) -> Job:
    called = (
        state.lesson.title if level is None else phrase("{title}, level {level}", title=state.lesson.title, level=level)
    )
    return Job(name, called, lambda path, part: files.write(path, mesh_of(state, level, limit=wish.limit)))


def mesh_of(state: State, level: int | None = None, *, limit: bool = False) -> Mesh:
    """The finest mesh in the view, or its control object after ``level`` steps; on the limit surface if so wished.

    Raises
    ------
    TopologyError
        If it has no limit.
    """
    view = _finest(state)
    told = state.trace(view)
    mesh = told.mesh_at(int(view.at(state.progress))) if level is None else _at_level(told, level)
    if not limit:
        return mesh
    from subdivision.limit import limit_mesh

    return limit_mesh(mesh, told.scheme)


def _finest(state: State) -> View:
    """The view that shows the most faces, of several the first."""
    return max(state.now.views, key=lambda view: view.trace.topology_at(int(view.at(state.progress))).n_faces)


def _levels(told: Trace, stages: int) -> int:
    """How many steps are complete after so many stages."""
    return max(level for level in range(_known(told) + 1) if told.begins(level) <= stages)


def _known(told: Trace) -> int:
    return told.levels[-1] + 1 if told.levels else 0


def _at_level(told: Trace, level: int) -> Mesh:
    """After so many steps, of which the story may tell fewer."""
    known = _known(told)
    mesh = told.mesh_at(told.begins(min(level, known)))
    return subdivide(mesh, told.scheme, level - known) if level > known else mesh


def _called(state: State, step: int) -> str:
    return phrase("{title}, step {step}", title=state.lesson.title, step=step)

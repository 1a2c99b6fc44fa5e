"""What a file or a link leads to, as a transition of the state."""

import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TypeAlias

import numpy as np

from app.laboratory.bench import put
from app.laboratory.lab import lab_of, lesson_of
from app.sessions.keeping import SUFFIX, read, taken_up
from app.sessions.link import followed, is_link
from app.state import State
from subdivision import Mesh, files
from subdivision.files.faults import printable
from subdivision.words import phrase

OPENABLE = (*files.READABLE, SUFFIX)
"""Suffixes of what can be opened."""

FARTHEST = 1e15
"""Coordinates beyond it cannot be drawn: pictures are made in single precision, which squares them."""

Opening: TypeAlias = Callable[[State], State]


def is_file(name: str) -> bool:
    """Whether a word of the command line means a file, not a lesson."""
    return os.sep in name or Path(name).suffix.lower() in OPENABLE


def opening(path: Path) -> Opening:
    """The session in a file; or the mesh in it, in the laboratory.

    Raises
    ------
    KeepingError, FileError, TopologyError
    """
    if path.suffix.lower() == SUFFIX:
        return partial(taken_up, other=read(path))
    mesh = files.read(path)
    _require_near(mesh, path)
    lab = lab_of(mesh, path.stem)
    lesson_of(lab)  # here, where perhaps nobody waits for a picture
    return partial(put, lab=lab)


def _require_near(mesh: Mesh, path: Path) -> None:
    farthest = float(np.abs(mesh.points).max(initial=0.0))
    if farthest > FARTHEST:
        raise files.FileError(
            phrase(
                "{name}: a coordinate is {farthest:.3g}, too far away to be drawn; scale the mesh down "
                "to {most:g} at most",
                name=printable(path.name),
                farthest=farthest,
                most=FARTHEST,
            )
        )


def meant(name: str) -> tuple[Opening, Path | None] | None:
    """What a word of the command line leads to, and the file it is; None if it can only be a lesson.

    Raises
    ------
    KeepingError, FileError, TopologyError
    """
    if is_link(name):
        return partial(taken_up, other=followed(name)), None
    return (opening(Path(name)), Path(name)) if is_file(name) else None

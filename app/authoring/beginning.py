"""A lesson to begin with: what a new file holds."""

import keyword
import re
import unicodedata
from pathlib import Path

from subdivision.files.saving import save

SUFFIX = ".py"

TEXT = '''\
"""A lesson of my own.  Save this file, and the window shows what you have changed."""

from collections.abc import Iterator

from lessons.script import Beat, lesson, play, show
from subdivision import shapes, trace
from subdivision.schemes import CATMULL_CLARK


@lesson("{title}")
def {id}() -> Iterator[Beat]:
    # A control object, a scheme, how it is told, how many levels.  Others: shapes.torus(), LOOP, ...
    told = trace(CATMULL_CLARK, shapes.cube(), "centroid averaging", levels=1)
    topology, centroids, geometry = told.stages[:3]

    # One yield is one step.  show() stands still after a stage (None: at the start), play() moves through one.
    yield show(told, None, "What the class sees first.", notes="What only you see.")
    yield play(told, topology, "New points on every edge and face. Nothing moves.")
    yield play(told, centroids, "Mark the centroids.", until=geometry)
    yield show(told, geometry, "Why is the corner here?", stencil=told.whole.stencil(7), span=3)
'''


def identifier(name: str) -> str:
    """A name as Python can use it for a function."""
    letters = unicodedata.normalize("NFKD", name.lower()).encode("ascii", "ignore").decode()
    plain = re.sub(r"\W+", "_", letters, flags=re.ASCII).strip("_") or "lesson"
    return f"lesson_{plain}" if plain[0].isdigit() or keyword.iskeyword(plain) else plain


def titled(name: str) -> str:
    """The same name as a title."""
    words = identifier(name).replace("_", " ")
    return f"{words[:1].upper()}{words[1:]}"


def file_in(folder: Path, name: str) -> Path:
    """The file of that name in a folder; a program's name whatever is asked for."""
    return folder / f"{identifier(Path(name).stem)}{SUFFIX}"


def free_file(folder: Path, stem: str) -> Path:
    """A file that is not there yet: lesson.py, lesson_2.py, ..."""
    names = (file_in(folder, f"{stem}_{k}" if k > 1 else stem) for k in range(1, 10_000))
    return next(each for each in names if not each.exists())


def begin(path: Path) -> None:
    """Write a lesson to begin with into a new file.

    Raises
    ------
    OSError
        If it is there already, or cannot be written.
    """
    if path.exists():
        raise FileExistsError(17, "it is there already", str(path))
    save(path, [TEXT.format(title=titled(path.stem), id=identifier(path.stem)).encode()])

"""Lessons from elsewhere: which folder, whether it was agreed to, and which of its files have stood their trial.

A lesson is a program that can do all its user can, so nothing of a folder runs before the user has agreed to just that
folder.  Neither sessions nor links can agree, or bring a folder along.
"""

import json
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from subprocess import DEVNULL, TimeoutExpired, run
from typing import Any, TypeAlias

from platformdirs import user_config_path, user_documents_path

import app
import lessons
from app.authoring.trial import GRACE, SECONDS, Outcome, command, judged
from app.laboratory.lab import LABORATORY
from lessons.own import Fault, LessonError, files_in, guarded, load, require_within
from lessons.script import Lesson
from subdivision.files.saving import save
from subdivision.words import Phrase, phrase

MOST_BYTES = 1 << 20
REMEMBERED = 500
"""Files whose trial is remembered."""


def usual_place() -> Path:
    """Where the system keeps what programs remember."""
    return user_config_path("subdivision-studio", appauthor=False) / "lessons.json"


def suggested_folder() -> Path:
    """Where lessons may lie if nobody says otherwise."""
    return user_documents_path() / "Subdivision lessons"


@dataclass(frozen=True)
class Shelf:
    """What is remembered: the ``folder`` last chosen, folders ``agreed`` to, and the digests of files ``tried``."""

    folder: str = ""
    agreed: tuple[str, ...] = ()
    tried: tuple[str, ...] = ()

    def is_agreed(self, folder: Path) -> bool:
        """Whether lessons in this very folder may run; those of folders within it may not."""
        return str(folder.resolve()) in self.agreed

    def agree(self, folder: Path) -> "Shelf":
        """From now on they may."""
        there = str(folder.resolve())
        return replace(self, agreed=tuple(dict.fromkeys((*self.agreed, there))))

    def chosen(self, folder: Path) -> "Shelf":
        """The folder that is opened at the next start."""
        return replace(self, folder=str(folder.resolve()))

    def has_stood(self, digest: str) -> "Shelf":
        """A file that was tried and can be loaded."""
        return replace(self, tried=tuple(dict.fromkeys((*self.tried, digest)))[-REMEMBERED:])


def remembered(place: Path) -> Shelf:
    """The shelf in a file; an empty one where there is none or it cannot be understood."""
    with suppress(OSError, ValueError, AttributeError):
        if place.stat().st_size > MOST_BYTES:
            return Shelf()
        told: dict[str, Any] = json.loads(place.read_bytes())
        folder, agreed, tried = (told.get(name) for name in ("folder", "agreed", "tried"))
        if isinstance(folder, str) and isinstance(agreed, list) and isinstance(tried, list):
            return Shelf(folder, tuple(map(str, agreed)), tuple(map(str, tried)))
    return Shelf()


def remember(place: Path, shelf: Shelf) -> None:
    """Write the shelf into its file.

    Raises
    ------
    OSError
    """
    place.parent.mkdir(parents=True, exist_ok=True)
    save(place, [json.dumps(vars(shelf), indent=2).encode()])


def digest(path: Path) -> str:
    """What a file says and what lies beside it: another one when it must be tried again.

    Raises
    ------
    OSError
    """
    told = sha256(f"{app.__file__}\0{path}\0".encode())
    told.update(path.read_bytes())
    lessons_there = files_in(path.parent)  # each stands its own trial
    for each in sorted(path.parent.iterdir()):
        if each not in lessons_there and each.is_file():
            seen = each.stat()
            told.update(f"{each.name}\0{seen.st_size}\0{seen.st_mtime_ns}\0".encode())
    return told.hexdigest()


# -- opening ----------------------------------------------------------------------------------

Tell: TypeAlias = Callable[[Fault], None]


@dataclass(frozen=True)
class Opened:
    """The lessons of a folder, file by file; what was wrong with its other files; the shelf afterwards."""

    found: Mapping[Path, tuple[Lesson, ...]]
    faults: tuple[Fault, ...]
    shelf: Shelf


def opened(folder: Path, shelf: Shelf, tell: Tell, try_out: Callable[[Path, frozenset[str]], Outcome | None]) -> Opened:
    """Load the files of a folder that was agreed to; those never tried before as ``try_out`` says, None: not now.

    ``tell`` is told what goes wrong later, while a picture is made.

    Raises
    ------
    OSError
        If there is no such folder.
    """
    found: dict[Path, tuple[Lesson, ...]] = {}
    faults: list[Fault] = []
    for path in files_in(folder.resolve()):
        taken = ids(found)
        try:
            require_within(path)
            if (mark := digest(path)) not in shelf.tried:
                outcome = try_out(path, taken)
                if outcome is None:
                    continue
                faults.extend(each for each in (outcome.fault, outcome.remark) if each is not None)
                if outcome.fault is not None:
                    continue
                shelf = shelf.has_stood(mark)
            found[path] = loaded(path, taken, tell)
        except LessonError as error:
            faults.append(error.fault)
    return Opened(found, tuple(faults), shelf)


def loaded(path: Path, taken: frozenset[str], tell: Tell) -> tuple[Lesson, ...]:
    """The lessons of a file that has stood its trial, told to the end.

    Raises
    ------
    LessonError
    """
    made = tuple(guarded(each, path, tell) for each in load(path, taken))
    for each in made:
        _ = each.beats  # here, where perhaps nobody waits for a picture
    return made


def ids(found: Mapping[Path, tuple[Lesson, ...]], beside: Path | None = None) -> frozenset[str]:
    """The ids that a file may not use: those of the program, and of all files ``beside`` it."""
    others = (each.id for path, those in found.items() if path != beside for each in those)
    return frozenset((*(each.id for each in lessons.built_in()), LABORATORY, *others))


def tried_now(path: Path, taken: frozenset[str]) -> Outcome:
    """Try a file and wait for what comes of it."""
    try:
        done = run(command(path, taken), stdin=DEVNULL, capture_output=True, timeout=SECONDS + GRACE, cwd=ROOT)
    except TimeoutExpired:
        return judged(path, b"", b"", is_late=True)
    return judged(path, done.stdout, done.stderr)


ROOT = Path(app.__file__).parent.parent
"""Where Python finds this program."""


def no_folder(folder: Path) -> Phrase:
    """Why there are no lessons to be had."""
    return phrase("there is no folder {folder}; choose another one for your lessons", folder=str(folder))

"""Lessons of one's own: Python files in a folder outside the installation.

A lesson is a program, so nothing here runs before somebody has agreed to the folder: ``files_in`` only reads names,
``load`` runs a file.
"""

import sys
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from functools import wraps
from pathlib import Path
from types import ModuleType, TracebackType
from typing import Any

from lessons.script import Beat, Lesson, Reading, View
from subdivision.words import Phrase, phrase

LONGEST_LINE = 60
"""Letters of a line that a sentence repeats."""

MEND = "mend that line and save the file"


@dataclass(frozen=True)
class Fault:
    """What is wrong with a file of lessons: ``line`` (0: none in particular), as it stands there, and the mend."""

    file: str
    line: int
    text: str
    what: str
    mend: str = MEND

    @property
    def sentence(self) -> Phrase:
        """All of it, for the user."""
        if not self.line:
            return phrase("{file}: {what}; {mend}.", file=self.file, what=self.what, mend=self.mend)
        if not self.text:
            return phrase("{file}, line {line}: {what}; {mend}.", **asdict(self))
        return phrase("{file}, line {line}, '{text}': {what}; {mend}.", **asdict(self))


class LessonError(ValueError):
    """Why a file of lessons was not loaded; ``fault`` says where."""

    def __init__(self, fault: Fault) -> None:
        super().__init__(fault.sentence)
        self.fault = fault


def files_in(folder: Path) -> list[Path]:
    """The files of lessons in a folder, not in folders within, by name; those that begin with _ only help others.

    Raises
    ------
    OSError
        If it cannot be read.
    """
    return sorted(each for each in folder.iterdir() if each.suffix == ".py" and each.name[0] not in "_.")


def require_within(path: Path) -> None:
    """Refuse a file that is a link to somewhere else: what was agreed to is what is in the folder.

    Raises
    ------
    LessonError
    """
    if path.resolve().parent != path.parent.resolve():
        what = "it is a link that leads out of the folder, and is not run"
        raise LessonError(Fault(path.name, 0, "", what, "put the file itself there"))


def load(path: Path, taken: Collection[str] = (), source: bytes | None = None) -> tuple[Lesson, ...]:
    """Run a file, and the lessons it makes; ``taken`` are ids it may not use, ``source`` is what it would say.

    Raises
    ------
    LessonError
        That names the line.
    """
    require_within(path)
    try:
        source = path.read_bytes() if source is None else source
    except OSError as error:
        what = phrase("it cannot be read ({reason})", reason=error.strerror or str(error))
        raise LessonError(Fault(path.name, 0, "", what, "see who may read it")) from error
    module = ModuleType(f"own lessons: {path.stem}")
    module.__file__ = str(path)
    sys.modules[module.__name__] = module
    with faults_named(path), _helpers_from(path.parent):
        exec(compile(source, str(path), "exec"), vars(module))
    found = [each for each in vars(module).values() if isinstance(each, Lesson) and is_of(each, module)]
    _require_own_ids(found, path, taken)
    return tuple(found)


def is_of(lesson: Lesson, module: ModuleType) -> bool:
    """Whether a lesson is told in a module, not only imported there."""
    return getattr(lesson.script, "__module__", "") == module.__name__


def _require_own_ids(found: list[Lesson], path: Path, taken: Collection[str]) -> None:
    if not found:
        what = "there is no lesson in it"
        mend = "write @lesson(…) before a function that yields beats, or begin the file's name with _"
        raise LessonError(Fault(path.name, 0, "", what, mend))
    ids = [each.id for each in found]
    for each in found:
        if each.id in taken or ids.count(each.id) > 1:
            what = phrase("there is another lesson called {id}", id=each.id)
            line = first_line(each)
            mend = "give the function another name"
            raise LessonError(Fault(path.name, line, text_at(path, line), what, mend))


def first_line(lesson: Lesson) -> int:
    """Where the function begins that tells a lesson; 0 where it is none."""
    return int(getattr(getattr(lesson.script, "__code__", None), "co_firstlineno", 0))


# -- what goes wrong --------------------------------------------------------------------------


@contextmanager
def faults_named(path: Path, line: int = 0) -> Iterator[None]:
    """Whatever is raised in here becomes a ``LessonError`` about a file; ``line`` is meant where it names none."""
    try:
        yield
    except (KeyboardInterrupt, GeneratorExit, LessonError):
        raise
    except BaseException as error:
        raise LessonError(fault_of(error, path, line)) from error


def fault_of(error: BaseException, path: Path, line: int = 0) -> Fault:
    """What was raised, at the innermost line of the file that led there, else at ``line``."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        line, what = error.lineno or 0, phrase("this is not Python: {reason}", reason=error.msg)
        return Fault(path.name, line, text_at(path, line), what)
    line = _innermost(error.__traceback__, path) or line
    return Fault(path.name, line, text_at(path, line), *_spelled(error))


def _innermost(trace: TracebackType | None, path: Path) -> int:
    found = 0
    while trace is not None:
        found = trace.tb_lineno if trace.tb_frame.f_code.co_filename == str(path) else found
        trace = trace.tb_next
    return found


def _spelled(error: BaseException) -> tuple[str, str]:
    """What was raised and how to mend it."""
    if isinstance(error, MemoryError):
        return "it needs more memory than a lesson may have", "take fewer levels or points"
    if isinstance(error, SystemExit):
        return "it ends the program", "take that call out"
    if isinstance(error, ModuleNotFoundError):
        mend = "import from subdivision, lessons and numpy, or put the module into the folder"
        return phrase("there is no module {name}", name=error.name or ""), mend
    said = str(error).strip().partition("\n")[0][:200].rstrip(".")
    return (f"{type(error).__name__}: {said}" if said else type(error).__name__), MEND


def text_at(path: Path, line: int) -> str:
    """A line of a file as a sentence repeats it."""
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    text = " ".join(lines[line - 1].split()) if 0 < line <= len(lines) else ""
    plain = "".join(c if c.isprintable() else "?" for c in text)
    return f"{plain[:LONGEST_LINE]}…" if len(plain) > LONGEST_LINE else plain


# -- guards -----------------------------------------------------------------------------------


def guarded(lesson: Lesson, path: Path, tell: Callable[[Fault], None]) -> Lesson:
    """The lesson with the faults of its file named.

    Those of its script are raised as ``LessonError``; those of its readings, which are taken while a picture is made,
    are told to ``tell``, and the picture is made without them.
    """

    def script(**settings: int) -> Iterator[Beat]:
        with faults_named(path, first_line(lesson)):
            for beat in lesson.script(**settings):
                yield replace(beat, views=tuple(_guarded(view, path, tell) for view in beat.views))

    return replace(lesson, script=script, _turned={})


def _guarded(view: View, path: Path, tell: Callable[[Fault], None]) -> View:
    if view.reading is None:
        return view
    reading: Reading = view.reading

    @wraps(reading)
    def measured(*meshes: Any) -> str:
        try:
            return reading(*meshes)
        except Exception as error:
            fault = fault_of(error, path)
            tell(fault)
            return phrase("not measured: {file}, line {line}", file=fault.file, line=fault.line)

    return replace(view, reading=measured)


@contextmanager
def _helpers_from(folder: Path) -> Iterator[None]:
    """Modules beside a lesson can be imported by it, and are read anew for each file."""
    before = set(sys.modules)
    sys.path.append(str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        for name in set(sys.modules) - before:
            file = getattr(sys.modules[name], "__file__", None)
            if file and Path(file).is_relative_to(folder):
                del sys.modules[name]

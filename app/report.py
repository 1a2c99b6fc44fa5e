"""What went wrong inside the program, as a text for whoever mends it.

It goes nowhere by itself.  Of a path it keeps what is below the program's own folders, else the last part only.
"""

import platform
import re
import sys
import sysconfig
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from traceback import TracebackException, extract_tb
from typing import Any

from subdivision.words import phrase

REMEMBERED = 24
"""How many of the last actions are told."""

LONGEST = 12_000
"""Characters of a traceback; a longer one is told from its end, where the fault is."""

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = {
    str(ROOT): "", sysconfig.get_path("purelib"): "site-packages/", sysconfig.get_path("stdlib"): "python/",
}  # fmt: skip
"""What may be known of a path: the folder it begins with, and how that is told."""

OURS = tuple(str(ROOT / name) for name in ("app", "lessons", "subdivision"))
SEPARATOR = re.compile(r"[/\\]")
QUOTED = re.compile(r"""(['"])((?:[A-Za-z]:)?[/\\][^'"\n]+)\1""")
BARE = re.compile(r"(?<![\w'\"./…])(?:[A-Za-z]:)?[/\\][^\s'\":,;)]+[/\\][^\s'\":,;)]+")


class Recent:
    """The names of the last actions, of many alike in a row one and their number."""

    def __init__(self) -> None:
        self._found: deque[tuple[str, int]] = deque(maxlen=REMEMBERED)

    def add(self, action: Callable[..., Any]) -> None:
        """One more action, by the name of what did it."""
        name = _name(action)
        if self._found and self._found[-1][0] == name:
            self._found[-1] = name, self._found[-1][1] + 1
        else:
            self._found.append((name, 1))

    def told(self) -> tuple[str, ...]:
        """The oldest first."""
        return tuple(name if n == 1 else f"{name} ({n} times)" for name, n in list(self._found))


def _name(action: Callable[..., Any]) -> str:
    while isinstance(action, partial):
        action = action.func
    return str(getattr(action, "__qualname__", type(action).__name__)).replace(".<locals>", "").replace("<lambda>", "_")


@dataclass(frozen=True)
class Report:
    """``place`` says which fault it is: those of one kind from one line are the same."""

    sentence: str
    place: str
    trace: str
    recent: tuple[str, ...]

    def told(self, versions: Mapping[str, str], count: int = 1) -> str:
        """All of it, to be copied."""
        often = [f"It has happened {count} times."] if count > 1 else []
        made_with = [f"{name}: {value}" for name, value in versions.items()]
        recent = self.recent or ("nothing yet",)
        return "\n".join([
            self.sentence, *often, "", *made_with, "", "The last actions:", *(f"  {each}" for each in recent), "",
            self.trace,
        ])  # fmt: skip


def report_of(fault: BaseException, recent: Iterable[str] = ()) -> Report:
    """The report of a fault that was not caught."""
    trace = extract_tb(fault.__traceback__)
    ours = [each for each in trace if each.filename.startswith(OURS)]
    last = (ours or list(trace))[-1:]
    where = f"{_path(last[0].filename)}, line {last[0].lineno}" if last else "the program"
    kind = type(fault).__name__
    said = plain(" ".join(str(fault).split()))[:200]
    sentence = phrase("{kind} in {where}: {said}", kind=kind, where=where, said=said or "nothing more is known")
    told = plain("".join(TracebackException.from_exception(fault, limit=-40).format()))
    return Report(sentence, f"{kind} in {where}", told[-LONGEST:].rstrip(), tuple(recent))


@contextmanager
def apart() -> Iterator[None]:
    """What fails within is told of as if nobody had caught it, and what comes after goes on."""
    try:
        yield
    except Exception as fault:
        sys.excepthook(type(fault), fault, fault.__traceback__)


def versions(more: Mapping[str, str]) -> dict[str, str]:
    """What the program is made of and runs on; the window knows ``more``."""
    return {
        "Subdivision Studio": _version("subdivision-studio"),
        "Python": platform.python_version(),
        "numpy": _version("numpy"),
        "VTK": _version("vtk"),
        "PyVista": _version("pyvista"),
        **more,
        "System": f"{platform.system()} {platform.release()} {platform.machine()}, {sys.byteorder} endian",
    }


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"


def plain(text: str) -> str:
    """``text`` without private paths."""
    text = QUOTED.sub(lambda found: f"{found[1]}{_path(found[2])}{found[1]}", text)
    return BARE.sub(lambda found: _path(found[0]), text)


def _path(name: str) -> str:
    """As much of a path as must be known."""
    for folder, told in sorted(FOLDERS.items(), key=lambda each: -len(each[0])):
        if name.startswith(f"{folder}/"):
            return told + name.removeprefix(f"{folder}/")
    return name if name.startswith("<") else f"…/{SEPARATOR.split(name.rstrip('/'))[-1]}"

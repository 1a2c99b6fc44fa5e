"""Children that write until they die: forked from a parent that has imported everything, and has no threads."""

import os
import random
import shutil
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import cycle
from pathlib import Path

from tests.faults.kinds import Kind, digests

PLANNED = ("open", "os.rename", "os.remove", "os.mkdir", "os.rmdir", "os.chmod", "shutil.rmtree", "shutil.copymode")
"""What a program may be about to do to the disk when it dies, as audit events."""


@dataclass(frozen=True)
class Sound:
    """A kind of file as it is when nothing goes wrong: both versions, and how long and how many events one takes."""

    folder: Path
    versions: list[dict[str, str]]
    seconds: float
    events: int

    def lay(self, kind: Kind, folder: Path) -> Path:
        """Version 0 in another folder; its place there."""
        shutil.copytree(self.folder, folder, dirs_exist_ok=True)
        return folder / kind.place


def forked(work: Callable[[int], object]) -> tuple[int, int]:
    """A child that does some work, told where to say what it finds, and ends; its number, and where it is heard."""
    hears, says = os.pipe()
    sys.stdout.flush()
    if number := os.fork():
        os.close(says)
        return number, hears
    try:
        os.close(hears)
        work(says)
    except BaseException as fault:
        os.write(says, f"FAULT {type(fault).__name__}: {fault}\n".encode())
    finally:
        os._exit(0)


def asked(work: Callable[[], str]) -> str:
    """What a child finds, or how it has failed."""
    number, hears = forked(lambda says: os.write(says, work().encode()))
    status, said = over(number, hears)
    return said if status == 0 else f"the child died of {status}: {said}"


def writing(kind: Kind, place: Path, at: int | None) -> None:
    """Write one version over the other for ever; or until event number ``at``, and die just before it."""
    if at is not None:
        Events().at(at, lambda: os.kill(os.getpid(), signal.SIGKILL))
    for version in cycle((1, 0)):
        kind.write(place, version)


class Events:
    """What the program does to the disk, counted; something else happens in between."""

    def __init__(self) -> None:
        self.count, self._due, self._then = 0, -1, lambda: None
        sys.addaudithook(self._heard)

    def at(self, count: int, then: Callable[[], object]) -> None:
        """From now on, before event ``count`` (from 0) ``then`` happens, once."""
        self.count, self._due, self._then = 0, count, then

    def _heard(self, event: str, _: object) -> None:
        if event in PLANNED:
            self.count += 1
            if self.count > self._due >= 0:
                self._due = -1
                self._then()


def sound(kind: Kind, folder: Path) -> Sound:
    """Written here and now, into a folder of its own, until everything is loaded that is needed."""
    events, place = Events(), folder / kind.place
    kind.write(place, 0)
    versions, seconds = [], 0.0
    for version in (1, 0):
        versions.append(digests(place))
        events.at(-1, lambda: None)
        begin = time.perf_counter()
        kind.write(place, version)
        seconds = time.perf_counter() - begin
    versions[0] = digests(place)  # as it lies there: some kinds carry the time they were written
    return Sound(folder, versions, seconds, events.count)


def kill_sometime(number: int, seconds: float) -> None:
    """End a child at a moment that nobody has chosen."""
    time.sleep(random.uniform(0, 2.2 * seconds))
    os.kill(number, signal.SIGKILL)


def over(number: int, hears: int) -> tuple[int, str]:
    """Wait for a child; its status (negative: the signal), and what it has said since."""
    said = b""
    while more := os.read(hears, 65536):
        said += more
    os.close(hears)
    return os.waitstatus_to_exitcode(os.waitpid(number, 0)[1]), said.decode(errors="replace")

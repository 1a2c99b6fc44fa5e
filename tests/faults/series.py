"""One fault many times: each series gives what it has seen as a line, and what went wrong as sentences."""

import os
import random
import resource
import shutil
import subprocess
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

from app.export.wish import ExportError
from app.figures import FigureError
from app.gui.saving import SavingError
from app.sessions.strict import KeepingError
from subdivision import TopologyError
from subdivision.files import FileError
from tests.faults.child import Events, Sound, asked, forked, kill_sometime, over, writing
from tests.faults.kinds import Kind, digests, is_whole, parts

SENTENCES = (ExportError, FigureError, FileError, KeepingError, SavingError, TopologyError)
SELDOM = 4
"""Faults that are not sudden are tried so many times less often."""

RESTING = 0.5
"""Seconds after which an encoder has noticed that its program is gone."""

DISK = 24 << 20
"""Bytes of a disk that is to become full."""


@dataclass
class Verdict:
    """What a series has seen, and where it did not see what it should."""

    name: str
    seen: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        seen = ", ".join(f"{what} {n}" for what, n in sorted(self.seen.items()))
        return f"{'ok  ' if not self.wrong else 'FAIL'} {self.name}: {seen}"

    def add(self, what: str, wrong: str = "") -> None:
        """One more trial."""
        self.seen[what] += 1
        if wrong:
            self.wrong.append(f"{self.name}, {what}: {wrong}")


def killed(kind: Kind, times: int, sound: Sound) -> Verdict:
    """The program dies while it writes: by kill -9 at any moment, or just before one of the things it does to files."""
    verdict = Verdict(f"{kind.name}, killed while it is written")
    for trial in range(times):
        with tempfile.TemporaryDirectory() as name:
            place = sound.lay(kind, Path(name))
            at = random.randrange(2 * sound.events) if trial % 2 else None
            number, hears = forked(lambda _, p=place, at=at: writing(kind, p, at))
            if at is None:
                kill_sometime(number, sound.seconds)
            status, said = over(number, hears)
            left = "half a file put aside" if parts(place.parent) else "nothing left beside it"
            wrong = said or ("" if status == -9 else f"it ended with {status}")
            wrong = wrong or ("" if is_whole(kind, place, sound.versions) else "no whole file")
            verdict.add(left, wrong or _goes_on(kind, place))
    return verdict


def _goes_on(kind: Kind, place: Path) -> str:
    """What is wrong after the next write, long after: nothing half written may be left then."""
    if place.suffix == ".mp4":
        time.sleep(RESTING)
    for each in parts(place.parent):
        os.utime(each, (0, 0))

    def again() -> str:
        kind.write(place, 1)
        return "".join(f"{each.name} is left" for each in parts(place.parent))

    return asked(again) if parts(place.parent) else ""


def full(kind: Kind, times: int, sound: Sound) -> Verdict:
    """No room for what is to be written, at any of its bytes."""
    verdict = Verdict(f"{kind.name}, the disk is full")
    size = max(each.stat().st_size for each in sound.folder.rglob("*") if each.is_file())
    for trial in range(max(times // SELDOM, 2)):
        with _disk() as (folder, is_ours):
            place, room = sound.lay(kind, folder), int(random.uniform(0, 1.1) * size)
            limit = _fill if is_ours and trial % 2 == 0 else _hold
            verdict.add(*_outcome(asked(lambda p=place, r=room, limit=limit: limit(p, r) or _tried(kind, p, sound))))
    return verdict


def _fill(place: Path, room: int) -> None:
    """So many bytes are left on the disk."""
    disk = os.statvfs(place.parent)
    (place.parent / "filling").write_bytes(bytes(max(disk.f_bavail * disk.f_frsize - room, 0)))


def _hold(place: Path, room: int) -> None:
    """No file may have more bytes, of this program and those it starts."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, -1))


def _tried(kind: Kind, place: Path, sound: Sound) -> str:
    """Write version 1 over version 0: what has come of it, and what is wrong with that."""
    try:
        kind.write(place, 1)
    except SENTENCES as fault:
        said = str(fault)
        wrong = "" if digests(place) == sound.versions[0] else "what was there has changed"
        wrong = wrong or ("" if said and "\n" not in said else f"no sentence: {said!r}")
        return f"refused|{wrong or ''.join(f'{each.name} is left' for each in parts(place.parent))}"
    is_new = is_whole(kind, place, sound.versions) and digests(place) != sound.versions[0]
    return f"written|{'' if is_new else 'it is not there'}"


def _outcome(said: str) -> tuple[str, str]:
    what, bar, wrong = said.partition("|")
    return (what, wrong) if bar else ("failed", said or "no answer")


def forbidden(kind: Kind, times: int, sound: Sound) -> Verdict:
    """A folder that cannot be written to; always the same, so tried less often."""
    verdict = Verdict(f"{kind.name}, the folder cannot be written to")
    for _ in range(max(times // 20, 1)):
        with _disk() as (folder, is_ours):
            place = sound.lay(kind, folder)
            if os.geteuid() == 0 and not is_ours:
                verdict.add("left out, for nothing is forbidden to root")
                continue
            if is_ours:
                subprocess.run(["mount", "-o", "remount,ro", str(folder)], check=True)
            else:
                _protect(folder, 0o555)
            what, wrong = _outcome(asked(lambda p=place: _tried(kind, p, sound)))
            verdict.add(what, wrong or ("" if what == "refused" else "it was written all the same"))
            if not is_ours:
                _protect(folder, 0o755)
    return verdict


def _protect(folder: Path, mode: int) -> None:
    for each in (folder, *[each for each in folder.iterdir() if each.is_dir()]):
        each.chmod(mode)


def removed(kind: Kind, times: int, sound: Sound) -> Verdict:
    """The folder is taken away while something is written into it; then it is there again."""
    verdict = Verdict(f"{kind.name}, its folder is removed while it is written")
    for _ in range(max(times // SELDOM, 1)):
        with tempfile.TemporaryDirectory() as name:
            place, at = sound.lay(kind, Path(name) / "inside"), random.randrange(sound.events)
            verdict.add(*_outcome(asked(lambda p=place, at=at: _bereft(kind, p, at, sound))))
    return verdict


def _bereft(kind: Kind, place: Path, at: int, sound: Sound) -> str:
    events = Events()
    events.at(at, lambda: shutil.rmtree(place.parent, ignore_errors=True))
    try:
        kind.write(place, 1)
        what = "written|"
    except SENTENCES as fault:
        what = "refused|" if str(fault) and "\n" not in str(fault) else f"refused|no sentence: {fault}"
    events.at(-1, lambda: None)  # no two writes have quite as many events: it may still be to come
    place.parent.mkdir(exist_ok=True)
    kind.write(place, 1)
    return f"{what}{'' if is_whole(kind, place, sound.versions) else 'the next one is not whole'}"


# -- what is kept by itself ---------------------------------------------------------------------


def autosave(times: int) -> Verdict:
    """The program dies while it keeps what is open: the next start offers it, whole."""
    verdict = Verdict("autosave, killed while it is written")
    for trial in range(times):
        with tempfile.TemporaryDirectory() as name:
            folder, planned = Path(name), random.random() if trial % 2 else None
            number, hears = forked(lambda says, f=folder, p=planned: _keeping(f, p, says))
            seconds = float(os.read(hears, 100).split()[0])
            if planned is None:
                kill_sometime(number, 4 * seconds)
            status, said = over(number, hears)
            answer = asked(lambda f=folder: _next_start(f))
            what, wrong = _outcome(answer)
            verdict.add(what, said or ("" if status == -9 else f"it ended with {status}") or wrong)
    return verdict


def _session(folder: Path) -> tuple[object, object, object]:
    from PySide6.QtCore import QCoreApplication

    from app.gui.autosave import Autosave
    from app.gui.session import Session
    from tests.faults.kinds import state

    program = QCoreApplication.instance() or QCoreApplication([])
    session = Session(state(0))
    return program, session, Autosave(session, folder)


def _keeping(folder: Path, at: float | None, says: int) -> None:
    import signal
    from time import perf_counter

    from app.state import drag

    events = Events()
    _, session, autosave = _session(folder)
    for k in count():
        begin = perf_counter()
        session.do(drag, 3, (1.0, -0.25, float(k)))
        autosave.keep_now()
        if k == 1:
            os.write(says, f"{perf_counter() - begin} ".encode())
            if at is not None:
                events.at(round(3 * at * events.count), lambda: os.kill(os.getpid(), signal.SIGKILL))
        if k == 0:
            events.at(-1, lambda: None)


def _next_start(folder: Path) -> str:
    _, session, autosave = _session(folder)
    if autosave.left is None:
        return "lost|nothing is offered"
    edits = autosave.restored()(session.state).edits
    autosave.end()
    left = [each.name for each in folder.iterdir() if each not in parts(folder)]
    wrong = "" if edits and edits[0][1][2] >= 1 else f"it is not the last one: {edits}"
    return f"offered and restored|{wrong or ', '.join(left)}"


# -- a disk of our own --------------------------------------------------------------------------


@contextmanager
def _disk() -> Iterator[tuple[Path, bool]]:
    """A folder, and whether it is a small disk of its own, which only root can make."""
    with tempfile.TemporaryDirectory() as name:
        is_ours = os.geteuid() == 0 and _has_mounted(name)
        try:
            yield Path(name), is_ours
        finally:
            if is_ours:
                subprocess.run(["umount", "-l", name], check=False, capture_output=True)


def _has_mounted(name: str) -> bool:
    if shutil.which("mount") is None:
        return False
    command = ["mount", "-t", "tmpfs", "-o", f"size={DISK}", "none", name]
    return subprocess.run(command, check=False, capture_output=True).returncode == 0


Series = Callable[[Kind, int, Sound], Verdict]
EACH: tuple[Series, ...] = (killed, full, forbidden, removed)

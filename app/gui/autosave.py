"""Keeps what is open so that a crash takes nothing: a file that is there only while the program has not ended well."""

import logging
import secrets
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from platformdirs import user_state_path
from PySide6.QtCore import QLockFile, QObject, QThreadPool, QTimer, Signal

from app.gui.session import Session, is_same_picture
from app.sessions.keeping import SUFFIX, read, taken_up, write
from app.sessions.strict import KeepingError
from app.state import State
from subdivision.words import phrase

SOON = 2000
"""Milliseconds after a change at which it is kept."""

PATIENCE = 5000
"""Milliseconds that the end of the program waits for the disk."""

AGAIN = 20_000
"""Milliseconds after which what could not be kept is tried once more: disks are emptied."""

LOG = logging.getLogger(__name__)


def folder() -> Path:
    """Where the system keeps what programs need to go on."""
    return user_state_path("subdivision-studio", appauthor=False) / "open"


class Autosave(QObject):
    """Writes every change that could be undone, away from the window's thread; ``end`` takes it all away again.

    Every program has a file of its own and a lock beside it that dies with it; a file whose lock is dead is what a
    crash has left.
    """

    failed = Signal(str)
    """Why changes are not kept; said once."""

    _unkept = Signal(str)

    def __init__(self, session: Session, folder: Path) -> None:
        super().__init__()
        self._session, self._folder = session, folder
        self._kept: State | None = session.state
        self._path = folder / f"{secrets.token_hex(8)}{SUFFIX}"
        self._lock: QLockFile | None = None
        self._has_failed = False
        self._writer = QThreadPool(maxThreadCount=1)
        self._soon = QTimer(self, singleShot=True, interval=SOON)
        self._soon.timeout.connect(self.keep)
        self._unkept.connect(self._fail)
        self._left = _left_over(folder)
        session.changed.connect(self._noticed)

    @property
    def left(self) -> Path | None:
        """What a crash has left, the newest."""
        return next(iter(self._left), None)

    def restored(self) -> Callable[[State], State]:
        """The transition to what a crash has left.

        Raises
        ------
        KeepingError
            If it cannot be read.
        """
        assert self.left is not None
        other = read(self.left, self._session.state.options)
        return lambda state: taken_up(state, other)

    def keep(self) -> None:
        """Write what has changed, now."""
        state = self._session.state
        if self._kept is None or not is_same_picture(state, self._kept):
            self._kept = state
            self._writer.start(lambda: self._write(state))

    def keep_now(self) -> None:
        """Write what has changed and wait until it is there: the program is about to end."""
        self.keep()
        self._writer.waitForDone(PATIENCE)

    def end(self) -> None:
        """The program has ended well: there is nothing to restore."""
        self._soon.stop()
        self._session.changed.disconnect(self._noticed)
        self._writer.waitForDone(PATIENCE)
        mine = {self._path: self._lock} if self._lock is not None else {}
        for path, lock in {**self._left, **mine}.items():
            with suppress(OSError):
                path.unlink(missing_ok=True)
            lock.unlock()

    def _noticed(self, _: State) -> None:
        if not self._soon.isActive() or self._soon.interval() != SOON:
            self._soon.start(SOON)

    def _write(self, state: State) -> None:
        try:
            self._take_place()
            write(self._path, state)
        except (KeepingError, OSError) as fault:
            LOG.warning("not kept: %s", fault)
            self._unkept.emit(str(fault))

    def _take_place(self) -> None:
        """The folder and the lock, which somebody may have cleared away since."""
        self._folder.mkdir(parents=True, exist_ok=True)
        if self._lock is not None and self._path.with_suffix(".lock").exists():
            return
        if self._lock is not None:
            self._lock.unlock()  # before another takes its name
        if (lock := _locked(self._path)) is None:
            raise KeepingError(phrase("{folder} cannot be written to; mend its permissions", folder=self._folder))
        self._lock = lock

    def _fail(self, sentence: str) -> None:
        self._kept = None
        self._soon.start(AGAIN)
        if not self._has_failed:
            self._has_failed = True
            self.failed.emit(sentence)


def _left_over(folder: Path) -> dict[Path, QLockFile]:
    """What crashed programs have left, the newest first, and the locks that make it ours."""
    found = {}
    for path in {each.with_suffix(SUFFIX) for each in (*folder.glob("*.lock"), *folder.glob(f"*{SUFFIX}"))}:
        if (lock := _locked(path)) is None:
            continue  # its program runs
        if path.exists():
            found[path] = lock
        else:
            lock.unlock()
    return dict(sorted(found.items(), key=lambda each: each[0].stat().st_mtime, reverse=True))


def _locked(path: Path) -> QLockFile | None:
    """The lock of a file, if its program is dead or it is new."""
    lock = QLockFile(str(path.with_suffix(".lock")))
    lock.setStaleLockTime(0)
    return lock if lock.tryLock(0) else None

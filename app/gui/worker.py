"""Work that takes long, done off the window's thread: reading a file, telling a large object."""

import sys
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, QThreadPool, QTimer, Signal

from app.gui.banner import Banner
from app.gui.saving import SavingError
from app.sessions.strict import KeepingError
from subdivision import TopologyError
from subdivision.files import FileError

PATIENCE = 100
"""Milliseconds before a wait is announced."""

REFUSALS = (FileError, KeepingError, SavingError, TopologyError)
"""Faults that are sentences for the user."""


class Stopped(Exception):
    """The work was told to stop."""


class Worker(QObject):
    """One piece of work at a time; a newer one replaces an older one, which is then no longer wanted."""

    def __init__(self, parent: QObject, banner: Banner, pool: QThreadPool | None = None) -> None:
        super().__init__(parent)
        self._banner, self._pool = banner, pool or QThreadPool.globalInstance()
        self._job: _Job | None = None
        self._running: set[_Job] = set()  # a job must outlive its run, wanted or not
        self._patience = QTimer(self, singleShot=True, interval=PATIENCE)
        self._patience.timeout.connect(self._announce)
        self._waiting = ""
        self._stop: Callable[[], None] | None = None

    @property
    def is_busy(self) -> bool:
        return self._job is not None

    def start(
        self,
        work: Callable[[], Any],
        done: Callable[[Any], None],
        failed: Callable[[str], None],
        *,
        waiting: str,
        too_large: str,
        broken: str,
        patience: int = PATIENCE,
        stop: Callable[[], None] | None = None,
    ) -> None:
        """Do ``work`` elsewhere; here ``done`` is told what it made, or ``failed`` a sentence.

        ``waiting`` is said when it takes longer than ``patience`` milliseconds, ``too_large`` and ``broken`` where it
        ends in no sentence of its own.  ``stop`` makes ``work`` end before its time, by raising ``Stopped``; without it
        what is no longer wanted is done nevertheless.
        """
        self.forget()
        self._waiting, self._stop = waiting, stop
        self._job = _Job(work, done, failed, too_large, broken)
        self._running.add(self._job)
        self._job.told.over.connect(self._running.discard)
        self._job.told.done.connect(self._succeeded)  # methods of ours, so that they are called in our thread
        self._job.told.failed.connect(self._failed)
        self._patience.start(patience)
        self._pool.start(self._job)

    def forget(self) -> None:
        """What is being worked on is no longer wanted."""
        self._patience.stop()
        self._banner.done()
        self._job = None

    def cancel(self) -> None:
        """Stop what is being worked on."""
        if self._job is not None and self._stop is not None:
            self._stop()
        self.forget()

    def _announce(self) -> None:
        if self._job is not None:
            self._banner.wait(self._waiting, self.cancel)

    def _succeeded(self, job: "_Job", made: object) -> None:
        if job is self._job:
            self.forget()
            job.done(made)

    def _failed(self, job: "_Job", sentence: str) -> None:
        if job is self._job:
            self.forget()
            job.failed(sentence)


class _Told(QObject):
    done = Signal(object, object)
    failed = Signal(object, str)
    over = Signal(object)


class _Job:
    def __init__(
        self,
        work: Callable[[], Any],
        done: Callable[[Any], None],
        failed: Callable[[str], None],
        too_large: str,
        broken: str,
    ) -> None:
        self.work, self.done, self.failed = work, done, failed
        self.too_large, self.broken, self.told = too_large, broken, _Told()

    def __call__(self) -> None:
        try:
            self.told.done.emit(self, self.work())
        except Stopped:
            self.told.failed.emit(self, "")
        except REFUSALS as fault:
            self.told.failed.emit(self, str(fault))
        except MemoryError:
            self.told.failed.emit(self, self.too_large)
        except Exception as fault:
            sys.excepthook(type(fault), fault, fault.__traceback__)
            self.told.failed.emit(self, self.broken)
        finally:
            self.told.over.emit(self)

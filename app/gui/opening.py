"""Reads a file off the window's thread: a mesh for the laboratory, or a session."""

import logging
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QObject, QRunnable, QThreadPool, QTimer, Signal

from app.gui.banner import Banner
from app.gui.session import Session
from app.opening import Opening, opening
from app.strict import KeepingError
from subdivision import TopologyError
from subdivision.files import FileError

PATIENCE = 100
"""Milliseconds before a wait is announced."""

LOG = logging.getLogger(__name__)


class Opener(QObject):
    """One file at a time; a newer wish replaces an older one.  ``opened`` is told what has been opened."""

    def __init__(self, session: Session, banner: Banner, opened: Callable[[Path], None]) -> None:
        super().__init__(session)
        self._session, self._banner, self._opened = session, banner, opened
        self._job: _Job | None = None
        self._running: set[_Job] = set()  # a job must outlive its run, wanted or not
        self._patience = QTimer(self, singleShot=True, interval=PATIENCE)
        self._patience.timeout.connect(self._announce)

    @property
    def is_busy(self) -> bool:
        return self._job is not None

    def open(self, path: str) -> None:
        self._forget()
        self._job = _Job(Path(path))
        self._running.add(self._job)
        self._job.told.over.connect(self._running.discard)
        self._job.told.done.connect(self._done)
        self._job.told.failed.connect(self._failed)
        self._patience.start()
        QThreadPool.globalInstance().start(self._job)

    def _announce(self) -> None:
        if self._job is not None:
            self._banner.wait(f"Reading {self._job.path.name} …", self._forget)

    def _done(self, job: "_Job", found: Opening) -> None:
        if job is self._job:
            self._forget()
            self._session.do(found)
            self._opened(job.path)

    def _failed(self, job: object, sentence: str) -> None:
        if job is self._job:
            self._forget()
            self._banner.say(sentence)

    def _forget(self) -> None:
        """What is still being read is no longer wanted."""
        self._patience.stop()
        self._banner.done()
        self._job = None


class _Told(QObject):
    done = Signal(object, object)
    failed = Signal(object, str)
    over = Signal(object)


class _Job(QRunnable):
    def __init__(self, path: Path) -> None:
        super().__init__()
        self.setAutoDelete(False)
        self.path, self.told = path, _Told()

    def run(self) -> None:
        try:
            self.told.done.emit(self, opening(self.path))
        except (FileError, KeepingError, TopologyError) as fault:
            self.told.failed.emit(self, str(fault))
        except MemoryError:
            self.told.failed.emit(self, f"{self.path.name} is too large for this computer's memory.")
        except Exception:
            LOG.exception("reading %s", self.path)
            self.told.failed.emit(self, f"{self.path.name} could not be opened; the log has the details.")
        finally:
            self.told.over.emit(self)

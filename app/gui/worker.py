"""Large changes, worked out where nobody waits for a picture, then made in the window's thread."""

import logging
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QObject, QRunnable, QThreadPool, QTimer, Signal

from app.gui.session import Session
from app.state import State
from subdivision import TopologyError

PATIENCE = 100
"""Milliseconds before a wait is announced."""

LOG = logging.getLogger(__name__)


class Worker(QObject):
    """One change at a time; a newer wish replaces an older one.

    A transition is a function, and what it works out is kept: once it has run elsewhere, running it
    again on the state of the moment is quick.
    """

    def __init__(
        self,
        session: Session,
        say: Callable[[str], None],
        wait: Callable[[str, Callable[[], None]], None],
        done: Callable[[], None],
    ) -> None:
        super().__init__(session)
        self._session, self._say, self._wait, self._over = session, say, wait, done
        self._job: _Job | None = None
        self._running: set[_Job] = set()  # a job must outlive its run, wanted or not
        self._patience = QTimer(self, singleShot=True, interval=PATIENCE)
        self._patience.timeout.connect(lambda: self._wait("Working out the stages …", self.forget))

    @property
    def is_busy(self) -> bool:
        return self._job is not None

    def do(self, transition: Callable[..., State], *args: Any) -> None:
        """Work the transition out elsewhere, then make it here."""
        self.forget()
        self._job = _Job(self._session.state, transition, args)
        self._running.add(self._job)
        self._job.told.done.connect(self._done)
        self._job.told.failed.connect(self._failed)
        self._patience.start()
        QThreadPool.globalInstance().start(self._job)

    def forget(self) -> None:
        """What is being worked out is no longer wanted."""
        self._patience.stop()
        if self._job is not None:
            self._job = None
            self._over()

    def _done(self, job: "_Job") -> None:
        self._running.discard(job)
        if job is self._job:
            self.forget()
            try:
                self._session.do(job.transition, *job.args)
            except TopologyError as refusal:
                self._say(str(refusal))

    def _failed(self, job: "_Job", sentence: str) -> None:
        self._running.discard(job)
        if job is self._job:
            self.forget()
            self._say(sentence)


class _Told(QObject):
    done = Signal(object)
    failed = Signal(object, str)


class _Job(QRunnable):
    def __init__(self, state: State, transition: Callable[..., State], args: tuple[Any, ...]) -> None:
        super().__init__()
        self.setAutoDelete(False)
        self.state, self.transition, self.args, self.told = state, transition, args, _Told()

    def run(self) -> None:
        try:
            self.transition(self.state, *self.args)
        except TopologyError as refusal:
            self.told.failed.emit(self, str(refusal))
        except MemoryError:
            self.told.failed.emit(self, "There is not enough memory for this; choose fewer levels.")
        except Exception:
            LOG.exception("working out %s", self.transition)
            self.told.failed.emit(self, "Something went wrong inside the program; the log has the details.")
        else:
            self.told.done.emit(self)

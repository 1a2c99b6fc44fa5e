"""Has pictures drawn in processes beside the window, and keeps one of them for the next picture."""

import pickle
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from threading import Lock
from typing import IO, TypeAlias
from weakref import WeakSet

from PySide6.QtCore import QThreadPool

import app
from app.draw.darkroom import PROTOCOL, Failure, Order
from app.gui.worker import Stopped

START = """
from app.lean import put_off
put_off("matplotlib.pyplot")  # which pyvista brings along
from app.draw.darkroom import main
main()
"""

AT_ONCE = 2
"""Pictures: one that is copied does not wait for a large one that is being saved."""

LAST = 120_000
"""Milliseconds that what is being drawn has when the window is closed."""

KILLED = -9
"""How a process has ended that nobody here has killed: the system does it where memory runs out."""

Process: TypeAlias = subprocess.Popen[bytes]


class DarkroomError(Exception):
    """Why there is no picture, for the log."""


class Darkroom:
    """``draw`` is called in the threads of ``pool``, everything else in the window's; nothing keeps that waiting."""

    def __init__(self) -> None:
        self.pool = QThreadPool()
        self.pool.setMaxThreadCount(AT_ONCE)
        self._lock = Lock()
        self._spare: Process | None = None
        self._at: dict[Order, Process] = {}
        self._stopped: WeakSet[Order] = WeakSet()

    def warm(self) -> None:
        """A picture will soon be wanted."""
        with self._lock:
            self._spare = self._spare or _started()

    def draw(self, order: Order) -> bytes:
        """The picture, once it is drawn.

        Raises
        ------
        Stopped, MemoryError, DarkroomError
        """
        process = self._begun(order)
        try:
            answer = _asked(process, order)
        except (OSError, EOFError, pickle.UnpicklingError) as fault:
            process.kill()
            status = process.wait()
            if order in self._stopped:
                raise Stopped from fault
            if status == KILLED:
                raise MemoryError from fault
            raise DarkroomError(f"the process that draws pictures has ended: {status}") from fault
        finally:
            self._is_over(order, process)
        if isinstance(answer, bytes):
            return answer
        raise MemoryError if answer.is_memory else DarkroomError(answer.traceback)

    def stop(self, order: Order) -> None:
        """The picture is no longer wanted, whether it is being drawn or waits for its turn."""
        with self._lock:
            self._stopped.add(order)
            if (process := self._at.get(order)) is not None:
                process.kill()

    def close(self) -> None:
        """What is being drawn is drawn first; then nothing is left."""
        if not self.pool.waitForDone(LAST):
            for order in tuple(self._at):
                self.stop(order)
            self.pool.waitForDone()
        if self._spare is not None:
            _end(self._spare)
            self._spare = None

    def _begun(self, order: Order) -> Process:
        with self._lock:
            if order in self._stopped:
                raise Stopped
            spare, self._spare = self._spare, None
            process = spare if spare is not None and spare.poll() is None else _started()
            self._at[order] = process
            return process

    def _is_over(self, order: Order, process: Process) -> None:
        with self._lock:
            del self._at[order]
            is_kept = self._spare is None and order not in self._stopped and process.poll() is None
            if is_kept:
                self._spare = process
        if not is_kept:
            _end(process)


def _started() -> Process:
    here = Path(app.__file__).parent.parent
    pipe = subprocess.PIPE
    return subprocess.Popen(
        [sys.executable, "-c", START], cwd=here, stdin=pipe, stdout=pipe,
        start_new_session=True,  # what ends the window from a terminal lets it finish what is being saved
    )  # fmt: skip


def _asked(process: Process, order: Order) -> bytes | Failure:
    orders, answers = _pipes(process)
    pickle.dump(order, orders, PROTOCOL)
    orders.flush()
    answer: bytes | Failure = pickle.load(answers)  # of nobody but our own process
    return answer


def _pipes(process: Process) -> tuple[IO[bytes], IO[bytes]]:
    """Where it hears, and where it answers."""
    assert process.stdin is not None
    assert process.stdout is not None
    return process.stdin, process.stdout


def _end(process: Process) -> None:
    """It has no order, so nothing is lost."""
    process.kill()
    process.wait()
    for pipe in _pipes(process):
        with suppress(OSError):  # what could not be written any more
            pipe.close()

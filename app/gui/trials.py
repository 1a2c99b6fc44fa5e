"""Files of lessons on trial, one after another, each in a process of its own beside the window."""

import sys
from pathlib import Path

from PySide6.QtCore import QObject, QProcess, QTimer, Signal

from app.authoring.shelf import ROOT
from app.authoring.trial import GRACE, SECONDS, Outcome, command, judged
from app.gui.banner import Banner
from subdivision.words import phrase

PATIENCE = 1500
"""Milliseconds before a trial is announced."""


LAST = 1000
"""Milliseconds that a process is given to be gone."""


class Trials(QObject):
    """Tries one file at a time; one that changes on trial is tried anew."""

    over = Signal(object, object)
    """The file, and what was found."""

    def __init__(self, parent: QObject, banner: Banner) -> None:
        super().__init__(parent)
        self._banner = banner
        self._process: QProcess | None = None
        self._path: Path | None = None
        self._is_late = self._is_announced = False
        self._patience = QTimer(self, singleShot=True, interval=PATIENCE)
        self._patience.timeout.connect(self._announce)
        self._limit = QTimer(self, singleShot=True, interval=1000 * (SECONDS + GRACE))
        self._limit.timeout.connect(self._end_late)

    @property
    def path(self) -> Path | None:
        """What is on trial."""
        return self._path

    def start(self, path: Path, taken: frozenset[str]) -> None:
        """Try a file instead of what is on trial."""
        self.stop()
        self._path, self._is_late = path, False
        self._process = QProcess(self)
        self._process.setWorkingDirectory(str(ROOT))
        self._process.finished.connect(self._finished)
        self._process.errorOccurred.connect(self._failed)
        program, *arguments = command(path, taken)
        self._process.start(program, arguments)
        self._patience.start()
        self._limit.start()

    def stop(self) -> None:
        """What is on trial is no longer wanted."""
        self._patience.stop()
        self._limit.stop()
        if self._process is not None:
            process, self._process, self._path = self._process, None, None
            process.finished.disconnect(self._finished)
            process.errorOccurred.disconnect(self._failed)
            if process.state() == QProcess.ProcessState.NotRunning:
                process.deleteLater()
            else:
                process.finished.connect(process.deleteLater)
                process.kill()
        if self._is_announced:
            self._is_announced = False
            self._banner.done()

    def end(self) -> None:
        """The window is closing: no process is left behind."""
        self.stop()
        for process in self.findChildren(QProcess):
            process.waitForFinished(LAST)

    def _announce(self) -> None:
        if self._path is not None:
            self._is_announced = True
            self._banner.wait(phrase("Trying {file} …", file=self._path.name), self._end_late)

    def _end_late(self) -> None:
        if self._process is not None:
            self._is_late = True
            self._process.kill()

    def _finished(self) -> None:
        if self._process is not None and self._path is not None:
            process, path = self._process, self._path
            told = bytes(process.readAllStandardOutput().data()), bytes(process.readAllStandardError().data())
            self._tell(judged(path, *told, is_late=self._is_late))

    def _failed(self) -> None:
        if self._process is not None and self._process.error() == QProcess.ProcessError.FailedToStart:
            self._tell(judged(self._path or Path(sys.executable), b"", b""))

    def _tell(self, outcome: Outcome) -> None:
        path = self._path
        self.stop()
        self.over.emit(path, outcome)

"""Everything that must not happen: exceptions, and warnings of Python, of Qt, of VTK and in the log."""

import logging
import sys
import threading
import traceback
import warnings
from types import TracebackType
from typing import Any

import vtk
from PySide6.QtCore import QMessageLogContext, QtMsgType, qInstallMessageHandler

LOUD = (QtMsgType.QtWarningMsg, QtMsgType.QtCriticalMsg, QtMsgType.QtFatalMsg)


class Faults:
    """What was complained about since it was last looked at."""

    def __init__(self) -> None:
        self._found: list[str] = []
        sys.excepthook = self._raised
        sys.unraisablehook = lambda said: self._raised(said.exc_type, said.exc_value, said.exc_traceback)
        threading.excepthook = lambda said: self._raised(said.exc_type, said.exc_value, said.exc_traceback)
        warnings.simplefilter("always")
        warnings.showwarning = lambda said, kind, file, line, *_: self.add(f"{file}:{line}: {kind.__name__}: {said}")
        qInstallMessageHandler(self._heard)
        handler = logging.Handler(logging.WARNING)
        handler.emit = lambda record: self.add(f"log: {logging.Formatter().format(record)}")  # type: ignore[method-assign]
        logging.getLogger().addHandler(handler)
        self._vtk = vtk.vtkStringOutputWindow()
        vtk.vtkOutputWindow.SetInstance(self._vtk)

    def add(self, sentence: str) -> None:
        self._found.append(sentence)

    def taken(self) -> list[str]:
        """What there is, and it is forgotten."""
        if said := self._vtk.GetOutput():
            self.add(f"VTK: {said}")
            self._vtk = vtk.vtkStringOutputWindow()
            vtk.vtkOutputWindow.SetInstance(self._vtk)
        found, self._found = self._found, []
        return found

    def _raised(self, kind: type[BaseException], fault: Any, trace: TracebackType | None) -> None:
        self.add("".join(traceback.format_exception(kind, fault, trace)))

    def _heard(self, kind: QtMsgType, context: QMessageLogContext, message: str) -> None:
        if kind in LOUD:
            self.add(f"Qt: {message}")

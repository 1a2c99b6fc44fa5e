"""Faults inside the program end here: in the log, and in one dialog with a report to copy and the session to save."""

import logging
import sys
import threading
from collections.abc import Callable, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QFont, QGuiApplication
from PySide6.QtWidgets import QDialog, QHBoxLayout, QLabel, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from app.gui.look import GRID, px, type_face
from app.gui.parts import Section
from app.gui.window import Window
from app.log import LOG
from app.report import Report, report_of, versions
from app.state import rest
from app.words import tr
from subdivision.words import phrase

TITLE = "Something went wrong inside the program"
SOOTHING = (
    "What is open is still there; save the session to be safe. The report says what happened to those who mend the "
    "program; it goes nowhere by itself."
)
AGAIN = "{sentence} This has happened {count} times by now; the report is in {log}."
SO_OFTEN = "It has happened {count} times."
MOST_TOLD = 5
"""Different faults that one dialog tells; more of them follow from the first."""


class Faults(QObject):
    """Hears of every exception that nobody has caught, whatever its thread.

    One dialog tells the first, how often it has come, and what else came while it was open.  Once put away it does
    not come back for the same fault: then the banner tells, so that a fault in every frame leaves the window usable.
    """

    _heard = Signal()

    def __init__(self, window: Window, log: Path, more: Mapping[str, str]) -> None:
        super().__init__()
        self._window, self._log, self._more = window, log, more
        self._counts: dict[str, int] = {}
        self._new: list[Report] = []
        self._last: Report | None = None
        self._lock = threading.Lock()
        self._is_due = False
        self._before: tuple[Any, Any, Any] | None = None
        self.dialog = FaultDialog(window)
        self._heard.connect(self._tell, Qt.ConnectionType.QueuedConnection)  # never inside the event that failed

    def listen(self) -> None:
        """From now on nothing that is raised goes by."""
        self._before = sys.excepthook, threading.excepthook, sys.unraisablehook
        sys.excepthook = self._caught
        threading.excepthook = lambda found: self._caught(found.exc_type, found.exc_value, found.exc_traceback)
        sys.unraisablehook = lambda found: self._caught(found.exc_type, found.exc_value, found.exc_traceback)

    def leave(self) -> None:
        """Listen no more: the program ends."""
        if self._before is not None:
            sys.excepthook, threading.excepthook, sys.unraisablehook = self._before

    def _caught(self, kind: type[BaseException], fault: BaseException | None, trace: TracebackType | None) -> None:
        if issubclass(kind, KeyboardInterrupt):
            self._window.close()
            return
        try:
            self._hear((fault or kind()).with_traceback(trace))
        except Exception:  # whatever fails here must not come here again
            LOG.critical("a fault could not be told", exc_info=True)

    def _hear(self, fault: BaseException) -> None:
        report = report_of(fault, self._window.session.recent.told())
        with self._lock:
            count = self._counts[report.place] = self._counts.get(report.place, 0) + 1
            if count == 1:
                self._new.append(report)
            self._last, was_due, self._is_due = report, self._is_due, True
        if not count & (count - 1):  # the 1st, 2nd, 4th, ...: one in every frame would push all else out of the log
            LOG.log(logging.CRITICAL, "uncaught, number %d", count, exc_info=fault)
        if not was_due:
            self._heard.emit()

    def _tell(self) -> None:
        with self._lock:
            new, self._new, last, self._is_due = self._new, [], self._last, False
        session = self._window.session
        if session.state.is_playing:
            session.do(rest)
        assert last is not None
        if new and not self.dialog.isVisible():
            self.dialog.begin()
        if self.dialog.isVisible():
            self.dialog.tell(new, self._counts, versions(self._more))
        else:
            count = self._counts[last.place]
            self._window.say(
                phrase(AGAIN, sentence=phrase("{fault}.", fault=last.sentence), count=count, log=self._log)
            )


class FaultDialog(QDialog):
    """Stands beside the work, not before it: the window goes on taking keys and clicks."""

    def __init__(self, window: Window) -> None:
        super().__init__(window)
        self._window = window
        self._reports: list[Report] = []
        self._counts: Mapping[str, int] = {}
        self._versions: Mapping[str, str] = {}
        self.setWindowTitle(tr(TITLE))
        title = _words(15)
        title.setFont(type_face(15, QFont.Weight.DemiBold))
        title.setText(tr(TITLE))
        self.sentence, self.often = _words(14), _words(14)
        soothing = _words(14)
        soothing.setText(tr(SOOTHING))
        self.text = QPlainTextEdit(readOnly=True)
        self.text.setAccessibleName(tr("Report"))
        self.text.setMinimumHeight(px(24 * GRID))
        self.details = Section(tr("Details"), self.text, stretched=self.text)
        self.details.head.toggled.connect(lambda _: self.adjustSize())
        self.save = _button(tr("Save the session…"), window.save_session_as)
        self.copy = _button(tr("Copy report"), self._copy)
        self.go_on = _button(tr("Go on"), self.hide)
        self.go_on.setDefault(True)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(px(3 * GRID), px(3 * GRID), px(3 * GRID), px(2 * GRID))
        layout.setSpacing(px(2 * GRID))
        for part in (title, self.sentence, self.often, soothing):
            layout.addWidget(part)
        layout.addWidget(self.details, 1)
        layout.addLayout(_row(self.save, self.copy, self.go_on))
        self.setFixedWidth(min(px(72 * GRID), window.width()))

    def begin(self) -> None:
        """Empty, for new faults."""
        self._reports = []
        self.details.head.setChecked(False)
        self.copy.setText(tr("Copy report"))
        self.show()
        self.go_on.setFocus()

    def tell(self, new: list[Report], counts: Mapping[str, int], made_with: Mapping[str, str]) -> None:
        """Faults that have come, and how often each has."""
        self._reports = [*self._reports, *new][:MOST_TOLD]
        self._counts, self._versions = counts, made_with
        first, others = self._reports[0], len(self._reports) - 1
        self.sentence.setText(tr(phrase("{fault}.", fault=first.sentence)))
        count = counts[first.place]
        often = "It has happened {count} times, and {others} other faults with it." if others else SO_OFTEN
        self.often.setText(tr(phrase(often, count=count, others=others)))
        self.often.setVisible(count > 1 or others > 0)
        self.setAccessibleDescription(self.sentence.text())
        if new:
            self.text.setPlainText(self.report)
            self.copy.setText(tr("Copy report"))
        self.adjustSize()

    @property
    def report(self) -> str:
        """All that is told, to be copied."""
        return "\n\n".join(each.told(self._versions, self._counts[each.place]) for each in self._reports)

    def _copy(self) -> None:
        self.text.setPlainText(self.report)
        QGuiApplication.clipboard().setText(self.report)
        self.copy.setText(tr("Copied"))


def _words(size: int) -> QLabel:
    label = QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    label.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    label.setFont(type_face(size))
    return label


def _button(name: str, does: Callable[[], Any]) -> QPushButton:
    button = QPushButton(name)
    button.own_keys = (Qt.Key.Key_Escape, Qt.Key.Key_Space)  # type: ignore[attr-defined]
    button.clicked.connect(lambda: does())
    return button


def _row(*buttons: QWidget) -> QHBoxLayout:
    row = QHBoxLayout()
    row.setSpacing(px(GRID))
    row.addStretch(1)
    for each in buttons:
        row.addWidget(each)
    return row

"""One run of some actions in a process of its own: ``python -m tests.soak.run REPORT JOURNAL [LINK]``.

The actions come from stdin; the link is where they begin, else at the cube.
The journal has every step before it is over, so that it tells where a process died.
"""

import faulthandler
import json
import sys
import tempfile
import time
import traceback
from collections import defaultdict
from collections.abc import Iterator
from contextlib import AbstractContextManager, suppress
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any, TextIO

from PySide6.QtCore import QSettings, QTimer
from PySide6.QtGui import QCursor, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QDialog, QFileDialog, QMessageBox

import lessons
from app.export.wish import Wish
from app.gui.application import application
from app.gui.autosave import Autosave
from app.gui.export import ExportDialog
from app.gui.window import Window
from app.gui.worker import Worker
from app.sessions.keeping import taken_up
from app.sessions.link import followed, link
from app.sessions.strict import KeepingError
from app.state import settle, start
from tests.gui.watchdog import Watchdog
from tests.soak.diary import Diary, digest
from tests.soak.faults import Faults
from tests.soak.hand import Action, Hand, Steps, described
from tests.soak.memory import resident

PAGE = 500
"""Actions after which all is told again, and undone to the beginning."""

SAMPLE = 100
"""Actions between two looks at the memory."""

PATIENCE = 180.0
"""Seconds that work beside the window may take."""

STALLED = 60.0
"""Seconds after which a step will never be over: the process is then ended where it is."""

PLACES = 4
"""Of the calls that the window was held up in, so many are kept: the last ones."""

TOLD = 200
"""Actions between two lines about how it goes."""

QUICK = ("view",)
"""What is exported to its end; more than that is cancelled."""


class Run:
    """Lets the hand do one action after the other, whenever the event loop has nothing else to do."""

    def __init__(self, actions: list[Action], journal: TextIO, folder: Path, begin: str) -> None:
        self.actions, self.journal, self.folder = actions, journal, folder
        self.faults = Faults()
        first = start(lessons.find("14"))
        self.session = Diary(taken_up(first, followed(begin)) if begin else first)
        settings = QSettings(str(folder / "window.ini"), QSettings.Format.IniFormat)
        self.window = Window(self.session, settings)
        self.autosave = Autosave(self.session, folder / "open")
        self.hand = Hand(self.window, folder / "files")
        self.window.viewport._pause.timeout.disconnect()  # whether the wheel rested is for the hand to say
        self.report: dict[str, Any] = {
            "faults": [], "memory": [], "gaps": [], "digests": {}, "kinds": {}, "done": 0, "link": "",
            "labours": 0,
        }  # fmt: skip
        self._before = self.session.state
        self._times: dict[str, list[float]] = defaultdict(list)
        self._worst: dict[tuple[str, ...], Any] = {}
        self._since: float | None = None
        self._watching: AbstractContextManager[None] | None = None
        self._begun = time.perf_counter()
        self._what, self._is_within = "", False
        self._ask_nobody()

    def start(self) -> None:
        """Show the window, and begin."""
        self.window.setGeometry(0, 0, 1280, 720)
        self.window.show()
        QTest.qWaitForWindowExposed(self.window)
        self.window.viewport.start()
        self.window.activateWindow()
        QCursor.setPos(self.window.screen().geometry().bottomRight())  # the real mouse is out of the way
        QTest.qWait(500)
        self.dog = Watchdog(self.window)
        self.dog.__enter__()
        self._story: Iterator[Steps] = self._told()
        self._steps: Steps = next(self._story)
        self._next = QTimer(interval=0, singleShot=True)
        self._next.timeout.connect(self._step)
        self._attending = QTimer(interval=20)
        self._attending.timeout.connect(self._attend)
        self._attending.start()
        self._next.start()

    # -- the story ------------------------------------------------------------------------------

    def _told(self) -> Iterator[Steps]:
        """Every action, and at the end of every page its being undone; what is done between them is not watched."""
        for count, action in enumerate(self.actions, 1):
            begun, self._before = time.perf_counter(), self.session.state
            self._note(f"{action.number} {action.kind}")
            yield self.hand.do(action)
            while (popup := QApplication.activePopupWidget()) is not None:
                popup.close()
            self._times[action.kind].append(time.perf_counter() - begun)
            self.report["digests"][action.number] = digest(self.session.state)
            if count % PAGE == 0 or count == len(self.actions):
                yield from self._turn_the_page(Random(action.seed))
            self._measure(count)

    def _turn_the_page(self, rng: Random) -> Iterator[Steps]:
        """Tell it all again; undo it all; and sometimes redo it all."""
        self._note("tell it all again")
        self.session.check()
        last, count = self.session.state, self.session.length
        yield self._pressed("Ctrl+Z", count)
        if self.session.length:
            there = f"focus: {described(QApplication.focusWidget())}, window: {described(QApplication.activeWindow())}"
            self.faults.add(f"{count} changes were to be undone, and {self.session.length} more are there; {there}")
        if rng.random() < 0.5:
            yield self._pressed("Ctrl+Y", count)
            if digest(settle(last)) != digest(self.session.state):
                self.faults.add("undoing it all and redoing it all leads to another state")
        self.session.begin()

    def _pressed(self, chord: str, count: int) -> Steps:
        self.window.viewport.setFocus()
        for _ in range(count):
            self.hand.key(QKeySequence(chord))
            yield f"{chord}, all of it"

    def _measure(self, count: int) -> None:
        self.report["done"] = count
        if count % SAMPLE == 0 or count == len(self.actions):
            view = self.window.viewport
            self.report["memory"].append((count, resident(), view.width() * view.height()))
        if count % TOLD == 0:
            seconds = time.perf_counter() - self._begun
            megabytes = self.report["memory"][-1][1]
            print(f"{count} actions, {seconds:.0f} s, {megabytes:.0f} MB", flush=True)

    def _note(self, words: str) -> None:
        self._what = words
        self.journal.write(words.replace("\n", " ") + "\n")
        self.journal.flush()

    # -- the loop -------------------------------------------------------------------------------

    def _step(self) -> None:
        faulthandler.dump_traceback_later(STALLED, exit=True)
        if self._is_busy() or not self._has_focus():
            self._next.start(2)
            return
        self._see()
        if self._has_faults():
            self._finish()
            return
        self._watching = self.dog.during(self._what.partition(" ")[2])  # until it says what it does
        self._watching.__enter__()
        try:
            is_over = self._go_on()
        except Exception:
            self.faults.add(traceback.format_exc())
            is_over = False
        if is_over:
            self._finish()
        else:
            self._next.start(0)

    def _go_on(self) -> bool:
        """One step of the story; whether there is none."""
        self._is_within = True
        said = next(self._steps, None)
        self._is_within = False
        if said is not None:
            if (words := f"{self._what.partition(': ')[0]}: {said}") != self._what:
                self._note(words)
            self.dog._what = said.partition(" at ")[0]
            return False
        self._see()
        self._steps = next(self._story, iter(()))
        return self.report["done"] == len(self.actions)

    def _is_busy(self) -> bool:
        """Whether the window changes its looks, or work goes on beside it; too long is a fault."""
        workers = (w for of in (self.session, *QApplication.topLevelWidgets()) for w in of.findChildren(Worker))
        is_busy = self.window.is_changing or self.window.exporter.is_busy or any(each.is_busy for each in workers)
        now = time.perf_counter()
        self._since = (self._since or now) if is_busy else None
        if self._since is not None and now - self._since > PATIENCE:
            self.faults.add(f"work beside the window took more than {PATIENCE:.0f} s")
            return False
        return is_busy

    def _has_focus(self) -> bool:
        """Whether keys go to the window; where no window manager gives the focus back, it asks for it."""
        others = QApplication.activeModalWidget(), QApplication.activePopupWidget()
        if QApplication.activeWindow() is self.window or any(others):
            return True
        self.window.activateWindow()
        return False

    def _see(self) -> None:
        """What the watchdog saw of the step that is over."""
        if self._watching is not None:
            self._watching.__exit__(None, None, None)
            self._watching = None
        self.report["labours"] += len(self.dog.labours())
        for gap in self.dog.blocks():
            gap = replace(gap, stack=gap.stack[-PLACES:])
            place = gap.stack or (gap.what,)
            worst, count = self._worst.get(place, (gap, 0))
            self._worst[place] = max(gap, worst, key=lambda each: each.excess), count + 1
        self.dog.gaps.clear()

    def _has_faults(self) -> bool:
        found = [*self.faults.taken(), *self.session.faults]
        self.report["faults"] += [{"at": self._what, "said": said} for said in found]
        if found:
            with suppress(KeepingError):
                self.report["link"] = link(self._before)
        return bool(found)

    def _finish(self) -> None:
        faulthandler.cancel_dump_traceback_later()
        self._attending.stop()
        self.dog.__exit__(None, None, None)
        worst = sorted(self._worst.values(), key=lambda each: -each[0].excess)[:40]
        self.report["gaps"] = [(count, gap.excess, gap.what, str(gap)) for gap, count in worst]
        self.report["kinds"] = {kind: (len(t), sum(t), max(t)) for kind, t in self._times.items()}
        self.window.document.path = None  # nothing is to be asked
        self.window.close()
        self.autosave.end()
        self._has_faults()
        QApplication.exit(0)

    # -- what would wait for an answer ------------------------------------------------------------

    def _ask_nobody(self) -> None:
        """The system's own dialogs cannot be driven: their answers are made up."""
        hand, out = self.hand, self.folder / "files"

        def saving(_: object, title: str, suggested: str, *__: object, **___: object) -> tuple[str, str]:
            name = hand.rng.choice((suggested.rpartition("/")[2], "a", "b", f"c{hand.rng.randrange(9)}"))
            suffix = hand.rng.choice((".png", ".svg", ".pdf", ".xyz", "")) if "picture" in title else ""
            path = str((out / name).with_suffix(suffix) if suffix else out / name)
            return hand.rng.choice((path, path, path, "")), ""

        QFileDialog.getSaveFileName = staticmethod(saving)
        QFileDialog.getOpenFileName = staticmethod(lambda *_, **__: (str(hand.file(hand.rng)), ""))
        QFileDialog.getExistingDirectory = staticmethod(lambda *_, **__: str(out / "folder"))
        self._wish, export_to = Wish("png"), self.window.export_to

        def exporting(wish: Wish, path: Path) -> None:
            self._wish = wish
            export_to(wish, path)

        self.window.export_to = exporting  # type: ignore[method-assign]
        Window.ask_to_save = lambda _: QMessageBox.StandardButton.Cancel

    def _attend(self) -> None:
        """Answer the dialog that is open; cancel the export of more than a view."""
        if self._is_within and (popup := QApplication.activePopupWidget()) is not None:
            popup.close()  # a button's menu, which holds its click up until it is answered
        dialog = QApplication.activeModalWidget()
        if isinstance(dialog, ExportDialog):
            self._answer(dialog, self.hand.rng)
        elif isinstance(dialog, QDialog):
            self.faults.add(f"a question nobody expected: {dialog.windowTitle()}")
            dialog.reject()
        exporter = self.window.exporter
        if exporter.is_busy and self._wish.of not in QUICK and not exporter._is_cancelled:
            exporter.cancel()

    def _answer(self, dialog: ExportDialog, rng: Random) -> None:
        for box in dialog.findChildren(QComboBox):
            if box.count() and rng.random() < 0.6:
                box.setCurrentIndex(rng.randrange(box.count()))
        dialog.limit.setChecked(rng.random() < 0.3)
        if rng.random() < 0.3 and dialog.go.isEnabled():
            dialog.go.click()
        else:
            dialog.reject()


def main() -> int:
    report, journal = map(Path, sys.argv[1:3])
    actions = [Action(*each) for each in json.load(sys.stdin)]
    application()
    with tempfile.TemporaryDirectory(prefix="soak-") as folder, journal.open("w") as written:
        (Path(folder) / "files").mkdir()
        run = Run(actions, written, Path(folder), "".join(sys.argv[3:4]))
        run.start()
        QApplication.exec()
        report.write_text(json.dumps(run.report))
    return int(bool(run.report["faults"]))


if __name__ == "__main__":
    raise SystemExit(main())

"""Lessons of one's own in the window: a folder is agreed to, its files are tried and loaded, again when they change.

What is wrong with a file is said with its line, and the last version that was well stays.
"""

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QFileSystemWatcher, QObject, QTimer, QUrl, Signal
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QFileDialog

import lessons
from app.authoring import shelf
from app.authoring.beginning import SUFFIX, begin, file_in, free_file
from app.authoring.retold import retold
from app.authoring.shelf import Shelf
from app.authoring.trial import Outcome
from app.gui.consent import Consent
from app.gui.trials import Trials
from app.gui.worker import Worker
from app.state import open_lesson
from app.words import tr
from lessons.own import Fault, LessonError, files_in, require_within
from lessons.script import Lesson
from subdivision.words import phrase

if TYPE_CHECKING:
    from app.gui.window import Window

SOON = 150
"""Milliseconds in which an editor may write a file in several goes."""


class Authoring(QObject):
    """The folder that is open, its lessons as they are shown, and the files that could not be loaded."""

    measured_wrong = Signal(object)
    """The fault of a reading, from wherever the picture was made."""

    def __init__(self, window: "Window", place: Path) -> None:
        super().__init__(window)
        self._window, self._place = window, place
        self.folder: Path | None = None
        self.found: dict[Path, tuple[Lesson, ...]] = {}
        self.faults: dict[Path, Fault] = {}
        self._marks: dict[Path, str] = {}
        self._waiting: list[Path] = []
        self._said: set[Fault] = set()
        self._wanted: Path | None = None
        self._expected: dict[Path, str] = {}
        self._is_opening = False
        self._watcher = QFileSystemWatcher(self)
        self._soon = QTimer(self, singleShot=True, interval=SOON)
        self._soon.timeout.connect(self.look_again)
        for changed in (self._watcher.directoryChanged, self._watcher.fileChanged):
            changed.connect(self._soon.start)
        self._trials = Trials(self, window.banner)
        self._trials.over.connect(self._tried)
        self._loader = Worker(self, window.banner)
        self.measured_wrong.connect(self._say_once)

    @property
    def is_busy(self) -> bool:
        """Whether a file is waited for."""
        return bool(self._waiting) or self._trials.path is not None or self._loader.is_busy or self._soon.isActive()

    # -- the folder -----------------------------------------------------------------------------

    def begin(self, place: Path, folder: Path | None = None, is_trusted: bool = False) -> None:
        """At the start of the program: the folder that is named, else the one that was open last."""
        self._place = place
        kept = shelf.remembered(place)
        if folder is not None:
            self.open(folder, is_trusted=is_trusted)
        elif kept.folder and kept.is_agreed(Path(kept.folder)):
            self.open(Path(kept.folder))

    def choose_folder(self) -> None:
        """Ask which folder has the lessons."""
        start = self.folder or Path(shelf.remembered(self._place).folder or self._suggested())
        chosen = QFileDialog.getExistingDirectory(self._window, tr("Lessons folder"), str(start))
        self._is_opening = bool(chosen)
        if chosen and self.open(Path(chosen)):
            self._keep(lambda kept: kept.chosen(Path(chosen)))

    def open(self, folder: Path, is_trusted: bool = False) -> bool:
        """Show the lessons of a folder if the user agrees, or has agreed before; whether so."""
        try:
            files = files_in(folder)
        except OSError:
            self._window.banner.say(shelf.no_folder(folder))
            return False
        if not (is_trusted or shelf.remembered(self._place).is_agreed(folder)):
            if Consent(self._window, folder.resolve(), files).exec() != Consent.DialogCode.Accepted:
                said = phrase("The lessons in {folder} were not run; File > Lessons folder… asks again.", folder=folder)
                self._window.banner.tell(said)
                return False
            self._keep(lambda kept: kept.agree(folder))
        self._take(folder)
        return True

    def fault_of(self, lesson: Lesson) -> Fault | None:
        """What is wrong with the file of a lesson, which is then shown in an older version."""
        path = next((path for path, those in self.found.items() if lesson.id in {each.id for each in those}), None)
        return self.faults.get(path) if path is not None else None

    def expect(self, path: Path, sentence: str) -> None:
        """A file has been written; the sentence is said when it is loaded."""
        self._expected[path] = sentence
        self.look_again()

    def show_folder(self) -> None:
        """Open the folder where the system shows folders; choose one if there is none."""
        if self.folder is None:
            self.choose_folder()
        else:
            QDesktopServices.openUrl(QUrl.fromLocalFile(str(self.folder)))

    def stop(self) -> None:
        """The window is closing."""
        self._soon.stop()
        self._trials.end()
        self._loader.forget()
        lessons.bring(())

    def _suggested(self) -> Path:
        """The usual folder, or the nearest there is above it."""
        wished = shelf.suggested_folder()
        return next((each for each in (wished, *wished.parents) if each.is_dir()), Path.home())

    def _take(self, folder: Path) -> None:
        """From now on this is the folder."""
        self._trials.stop()
        self._loader.forget()
        if old := [*self._watcher.files(), *self._watcher.directories()]:
            self._watcher.removePaths(old)
        self.folder = folder.resolve()
        self.found, self.faults, self._marks, self._waiting, self._expected = {}, {}, {}, [], {}
        self.look_again()
        self._publish()

    def _keep(self, change: Callable[[Shelf], Shelf]) -> None:
        try:
            shelf.remember(self._place, change(shelf.remembered(self._place)))
        except OSError as error:
            said = phrase("It cannot be remembered: {reason}. It holds until the program ends.", reason=str(error))
            self._window.banner.say(said)

    # -- files ----------------------------------------------------------------------------------

    def look_again(self) -> None:
        """See which files are new, have changed or have gone, and try those."""
        assert self.folder is not None
        try:
            paths = files_in(self.folder)
        except OSError:
            self._window.banner.say(shelf.no_folder(self.folder))
            return
        self._watcher.addPaths([str(self.folder), *map(str, paths)])  # again: a file that was replaced is another one
        if gone := set(self._marks) - set(paths):
            for path in gone:
                self._marks.pop(path), self.found.pop(path, None), self.faults.pop(path, None)
            self._publish()
        for path in paths:
            self._notice(path)
        self._go_on()

    def _notice(self, path: Path) -> None:
        """Have a file tried if it is not the one that was tried last."""
        try:
            require_within(path)
            mark = shelf.digest(path)
        except (LessonError, OSError) as error:
            fault = getattr(error, "fault", None) or Fault(path.name, 0, "", str(error))
            if self.faults.get(path) != fault:
                self._marks[path] = ""
                self._refuse(path, fault)
            return
        if self._marks.get(path) != mark:
            self._marks[path] = mark
            self._queue(path)

    def _queue(self, path: Path) -> None:
        """Have a file wait for its trial: one that is shown goes before all others, also before what is on trial."""
        others = [each for each in self._waiting if each != path]
        on_trial = self._trials.path
        if path in self.found:
            self._waiting = [path, *others, *([on_trial] if on_trial not in (None, path) else [])]
        else:
            self._waiting = [*others, path]
        if on_trial == path or path in self.found:
            self._trials.stop()

    def _go_on(self) -> None:
        """Try or load the next file that waits; when none does, tell what has come of it all."""
        if self._trials.path is not None or self._loader.is_busy:
            return
        if not self._waiting:
            self._finish()
            return
        path = self._waiting.pop(0)
        if self._marks.get(path, "") in shelf.remembered(self._place).tried:
            self._load(path, Outcome())
        elif path in self._marks:
            self._trials.start(path, shelf.ids(self.found, beside=path))

    def _tried(self, path: Path, outcome: Outcome) -> None:
        if outcome.fault is not None:
            self._refuse(path, outcome.fault)
            self._go_on()
            return
        mark = self._marks.get(path, "")
        with suppress(OSError):
            if shelf.digest(path) == mark:
                if outcome.remark is None:  # one that is odd is tried, and told of, at the next start too
                    self._keep(lambda kept: kept.has_stood(mark))
                self._load(path, outcome)
                return
        self.look_again()  # it has changed while it was on trial

    def _load(self, path: Path, outcome: Outcome) -> None:
        taken, tell = shelf.ids(self.found, beside=path), self.measured_wrong.emit

        def work() -> tuple[Lesson, ...] | Fault:
            try:
                return shelf.loaded(path, taken, tell)
            except LessonError as error:
                return error.fault

        def done(made: tuple[Lesson, ...] | Fault) -> None:
            if isinstance(made, Fault):
                self._refuse(path, made)
            else:
                self._show(path, made, outcome)
            self._go_on()

        def failed(sentence: str) -> None:
            self._window.banner.say(sentence)
            self._go_on()

        name = path.name
        self._loader.start(
            work, done, failed,
            waiting=phrase("Loading {file} …", file=name),
            too_large=phrase("{file} is too large for this computer's memory.", file=name),
            broken=phrase("{file} could not be loaded; the log has the details.", file=name),
        )  # fmt: skip

    def _refuse(self, path: Path, fault: Fault) -> None:
        """The file is not loaded; what was loaded before stays."""
        self.faults[path] = fault
        self._publish()
        self._window.banner.say(fault.sentence)

    def _show(self, path: Path, made: tuple[Lesson, ...], outcome: Outcome) -> None:
        """The lessons of a file are these now."""
        is_again = path in self.found
        self.found[path] = made
        self.faults.pop(path, None)
        self._said = {each for each in self._said if each.file != path.name}
        self._publish()
        for each in made:
            self._window.document.rewrite(retold, each)
            self._window.session.rewrite(retold, each)
        expected = self._expected.pop(path, "")
        if outcome.remark is not None:
            self._window.banner.say(outcome.remark.sentence)
        elif expected:
            self._window.banner.tell(expected)
        elif is_again:
            self._window.banner.tell(phrase("Reloaded {file}", file=path.name))
        if path == self._wanted:
            self._wanted = None
            self._window.session.do(open_lesson, made[0])

    def _finish(self) -> None:
        if not self._is_opening:
            return
        self._is_opening = False
        number = sum(map(len, self.found.values()))
        if not self.faults:
            said = phrase("Lessons of your own: {number}, from {folder}", number=number, folder=self.folder)
            self._window.banner.tell(said)

    def _publish(self) -> None:
        """Let everybody know which lessons there are."""
        lessons.bring(each for those in self.found.values() for each in those)
        faults = {each.id: self.faults[path].sentence for path in self.faults for each in self.found.get(path, ())}
        lost = {path.name: fault.sentence for path, fault in self.faults.items() if path not in self.found}
        self._window.contents.offer(lessons.all_lessons(), faults, lost)

    def _say_once(self, fault: Fault) -> None:
        if fault not in self._said:
            self._said.add(fault)
            self._window.banner.say(fault.sentence)

    # -- a new one ------------------------------------------------------------------------------

    def new_lesson(self) -> None:
        """Ask for a name, write a file to start from, and show it."""
        if self.folder is None:
            self.choose_folder()
        if self.folder is None:
            return
        wished = str(free_file(self.folder, "lesson"))
        name, _ = QFileDialog.getSaveFileName(self._window, tr("New lesson"), wished, f"Python (*{SUFFIX})")
        if name:
            self.write_new(file_in(self.folder, name))

    def write_new(self, path: Path) -> None:
        """Write a lesson to begin with, show it when it is loaded, and where it is."""
        try:
            begin(path)
        except OSError as error:
            said = phrase("{file} was not written: {reason}; choose another name.", file=path.name,
                          reason=error.strerror or str(error))  # fmt: skip
            self._window.banner.say(said)
            return
        self._wanted = path
        self.look_again()
        self.show_folder()

"""Lesson > Record this view as a step: asks where to, and adds the lines to a lesson of one's own."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QFileDialog

from app.authoring import shelf
from app.authoring.beginning import SUFFIX, file_in, free_file, identifier, titled
from app.authoring.pieces import RecordingError
from app.authoring.recording import Recorded, recorded
from app.gui.worker import Worker
from app.state import State, settle
from app.words import tr
from subdivision.files import FileError
from subdivision.words import phrase

if TYPE_CHECKING:
    from app.gui.window import Window


class Recorder(QObject):
    """Remembers for each lesson which file its steps go to."""

    def __init__(self, window: "Window") -> None:
        super().__init__(window)
        self._window = window
        self._files: dict[str, Path] = {}
        self._worker = Worker(self, window.banner)

    def choose(self) -> None:
        """Record what is shown into the lesson's file, which is asked for the first time."""
        authoring, state = self._window.authoring, settle(self._window.session.state)
        if authoring.folder is None:
            authoring.choose_folder()
        if authoring.folder is None:
            return
        path = self._files.get(state.lesson.id)
        if path is None or path.parent != authoring.folder:
            path = self._ask(authoring.folder, state)
        if path is not None:
            self._files[state.lesson.id] = path
            self.record(state, path)

    def record(self, state: State, path: Path) -> None:
        """Add the view to a file; what cannot be recorded as it is shown is said before."""
        authoring = self._window.authoring
        if path.exists() and (path not in authoring.found or path in authoring.faults):
            fault = authoring.faults.get(path)
            reason = fault.sentence if fault else phrase("{file} is not loaded yet.", file=path.name)
            self._window.banner.say(phrase("Nothing was recorded. {reason}", reason=reason))
            return
        taken = shelf.ids(authoring.found, beside=path)

        def work() -> Recorded | str:
            try:
                return recorded(state, path, titled(path.stem), identifier(path.stem), taken)
            except RecordingError as error:
                return str(error)

        self._worker.start(
            work, self._recorded, self._window.banner.say,
            waiting="Recording …",
            too_large="This view is too large to be recorded.",
            broken="This view could not be recorded; the log has the details.",
        )  # fmt: skip

    def _ask(self, folder: Path, state: State) -> Path | None:
        """A new file, or one that is there."""
        name, _ = QFileDialog.getSaveFileName(
            self._window, tr("Record into a new lesson, or one of yours"),
            str(free_file(folder, f"my_{state.lesson.id}")), f"Python (*{SUFFIX})",
            options=QFileDialog.Option.DontConfirmOverwrite,
        )  # fmt: skip
        return file_in(folder, name) if name else None

    def _recorded(self, found: Recorded | str) -> None:
        if isinstance(found, str):
            self._window.banner.say(phrase("Nothing was recorded: {reason}.", reason=found.rstrip(".")))
        elif found.differs:
            said = phrase("Not everything can be recorded as it is shown: {what} will differ.", what=found.differs)
            self._window.banner.offer(said, "Record it all the same", partial(self._write, found))
        else:
            self._write(found)

    def _write(self, found: Recorded) -> None:
        """Write the file; it is then loaded as any other that has changed."""
        try:
            found.write()
        except (OSError, FileError, RecordingError) as error:
            self._window.banner.say(phrase("Nothing was recorded: {reason}.", reason=str(error).rstrip(".")))
            return
        said = phrase("Recorded as the last step of {file}; its words can be changed there.", file=found.path.name)
        self._window.authoring.expect(found.path, said)

"""File > Export: a dialog that asks what, how and where, and the process that makes it."""

import logging
import secrets
import sys
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from PySide6.QtCore import QObject, QProcess, QProcessEnvironment, Qt, QTimer
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QLabel,
    QWidget,
)

import app
from app.export.wish import FORMATS, OPAQUE, ExportError, Wish
from app.export.worker import told
from app.figures import BACKGROUNDS
from app.gui.banner import Banner
from app.gui.look import GRID, px
from app.sessions import keeping
from app.sessions.strict import KeepingError
from app.state import State
from app.words import headed, tr
from subdivision.files.saving import BEGIN, clear
from subdivision.words import phrase

OF = {"view": "What is shown", "lesson": "This lesson", "everything": "The whole lecture"}
SIZES = {
    "1920 × 1080": (1920, 1080),
    "3840 × 2160": (3840, 2160),
    "1280 × 720": (1280, 720),
    "1440 × 1080": (1440, 1080),
    "1080 × 1080": (1080, 1080),
}
PACES = {0.5: "Half as fast", 1.0: "As usual", 1.5: "Half as fast again", 2.0: "Twice as fast"}

REFUSED = 1
"""What a process ends with that has told in a sentence why it makes nothing."""

GRACE = 4000
"""Milliseconds that a process is given to clear up after itself."""

LOG = logging.getLogger(__name__)


class ExportDialog(QDialog):
    """What is wished for, as far as the format has a choice."""

    def __init__(self, parent: QWidget, theme: str, first: Wish) -> None:
        super().__init__(parent)
        self._theme = theme
        self.setWindowTitle(tr("Export"))
        self.of = _choice("What", "Which part is exported", OF)
        self.format = _choice("Format", "What kind of file", {name: kind.title for name, kind in FORMATS.items()})
        self.pixels = _choice(
            "Size", "Pixels; type and strokes grow with it", {size: name for name, size in SIZES.items()}
        )
        self.pixels.setEditable(True)
        self.background = _choice("Background", "What is behind the picture", {b: b.capitalize() for b in BACKGROUNDS})
        self.pace = _choice("Pace", "How fast a film plays", PACES)
        self.limit = QCheckBox(tr("On the limit surface"))
        self.limit.setAccessibleName(tr("On the limit surface"))
        self.limit.setToolTip(tr("Push the vertices of the mesh to where they tend"))
        self.remark = QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.go = self.buttons.addButton(tr("Export…"), QDialogButtonBox.ButtonRole.AcceptRole)
        self.go.setDefault(True)
        for button in self.buttons.buttons():
            button.setIcon(QIcon())
        self._lay_out()
        self._begin(first)

    @property
    def wish(self) -> Wish:
        """What is chosen.

        Raises
        ------
        ExportError
        """
        found = Wish(
            self.format.currentData(), self.of.currentData(), self._size(), self.background.currentData(),
            self.pace.currentData(), limit=self.limit.isChecked(),
        )  # fmt: skip
        return found.checked(self._theme)

    def _size(self) -> tuple[int, int]:
        width, _, height = self.pixels.currentText().lower().replace("×", "x").replace(" ", "").partition("x")
        if not (width.isdecimal() and height.isdecimal()):
            raise ExportError(phrase("'{text}' is no size; write it as 1920 x 1080", text=self.pixels.currentText()))
        return int(width), int(height)

    def _lay_out(self) -> None:
        self._form = QFormLayout(self)
        self._form.setContentsMargins(px(3 * GRID), px(3 * GRID), px(3 * GRID), px(2 * GRID))
        self._form.setSpacing(px(2 * GRID))
        rows = (self.of, self.format, self.pixels, self.background, self.pace)
        for box in rows:
            self._form.addRow(box.accessibleName(), box)
        self._form.addRow("", self.limit)
        self._form.addRow(self.remark)
        self._form.addRow(self.buttons)
        self.setMinimumWidth(px(400))

    def _begin(self, first: Wish) -> None:
        """As it was chosen last time."""
        for box, value in ((self.of, first.of), (self.format, first.format), (self.background, first.background)):
            box.setCurrentIndex(max(box.findData(value), 0))
        self.pace.setCurrentIndex(max(self.pace.findData(first.pace), 0))
        self.pixels.setCurrentText("{} × {}".format(*first.size))
        self.limit.setChecked(first.limit)
        for box in (self.of, self.format, self.background, self.pace):
            box.currentIndexChanged.connect(self._look_again)
        self.pixels.editTextChanged.connect(self._look_again)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        self._look_again()

    def _look_again(self) -> None:
        """Only choices that make a difference can be made; what cannot be is said."""
        wants = FORMATS[self.format.currentData()].wants
        for name, box in (("size", self.pixels), ("background", self.background), ("pace", self.pace)):
            self._form.setRowVisible(box, name in wants)
        self._form.setRowVisible(self.limit, "limit" in wants)
        if self.format.currentData() in OPAQUE and self.background.currentData() == "transparent":
            self.background.setCurrentIndex(self.background.findData("theme"))
        try:
            wish = self.wish
        except ExportError as fault:
            self._say(str(fault), is_good=False)
        else:
            self._say("Several files, into a folder of your choice." if wish.is_folder else "", is_good=True)

    def _say(self, sentence: str, *, is_good: bool) -> None:
        self.remark.setText(headed(tr(sentence)))
        self._form.setRowVisible(self.remark, bool(sentence))
        self.go.setEnabled(is_good)
        self.adjustSize()


def _choice(name: str, tip: str, values: Mapping[Any, str]) -> QComboBox:
    box = QComboBox()
    box.setAccessibleName(tr(name))
    box.setToolTip(tr(tip))
    for value, shown in values.items():
        box.addItem(tr(shown), value)
    return box


class Exporter(QObject):
    """One export at a time, in a process of its own; its progress is in the banner, and can be cancelled there."""

    def __init__(self, parent: QObject, banner: Banner) -> None:
        super().__init__(parent)
        self._banner = banner
        self._process: QProcess | None = None
        self._folder: TemporaryDirectory[str] | None = None
        self._is_cancelled = False

    @property
    def is_busy(self) -> bool:
        return self._process is not None

    def start(self, state: State, wish: Wish, out: Path, own: Path | None = None) -> None:
        """Make what is wished for; the banner tells how it goes.  ``own`` is a folder of lessons that was agreed to."""
        if self.is_busy:
            self._banner.say("An export is under way; wait for it, or cancel it first.")
            return
        self._folder, self._is_cancelled = TemporaryDirectory(prefix="studio-"), False
        try:
            kept = keeping.write(Path(self._folder.name) / "view", state)
        except KeepingError as fault:
            self._end()
            self._banner.say(str(fault))
            return
        self._out = out = out.absolute()
        self._process, self._begin = QProcess(self), secrets.token_hex(4)
        surroundings = QProcessEnvironment.systemEnvironment()
        surroundings.insert(BEGIN, self._begin)
        self._process.setProcessEnvironment(surroundings)
        self._process.finished.connect(self._finished)
        self._process.errorOccurred.connect(self._failed)
        self._process.readyReadStandardOutput.connect(self._heard)
        self._process.setWorkingDirectory(str(Path(app.__file__).parent.parent))
        self._process.start(sys.executable, ["-m", "app", *arguments(kept, state, wish, out, own)])
        self._banner.wait(phrase("Exporting {name} …", name=out.name), self.cancel)

    def cancel(self) -> None:
        """Stop; what was begun goes."""
        if self._process is not None:
            self._is_cancelled = True
            process = self._process
            process.closeWriteChannel()
            QTimer.singleShot(GRACE, process, process.kill)

    def stop(self) -> None:
        """The window is closing: stop and wait until all is cleared up."""
        if self._process is not None:
            self.cancel()
            with suppress(RuntimeError):
                if not self._process.waitForFinished(GRACE):
                    self._process.kill()
                    self._process.waitForFinished(GRACE)

    def _heard(self) -> None:
        assert self._process is not None
        while self._process.canReadLine():
            found = told(bytes(self._process.readLine().data()).decode().strip())
            if found is not None and not self._is_cancelled:
                done, name = found
                words = phrase("Exporting {name} … {done:.0%}", name=name or self._out.name, done=done)
                self._banner.progress(done, words)

    def _failed(self) -> None:
        if self._process is not None and self._process.error() == QProcess.ProcessError.FailedToStart:
            self._end()
            self._banner.done()
            self._banner.say("The export could not be started: there is no Python to run it.")

    def _finished(self, status: int) -> None:
        assert self._process is not None
        said = bytes(self._process.readAllStandardError().data()).decode(errors="replace").strip()
        self._end()
        self._banner.done()
        if self._is_cancelled:
            self._banner.tell("The export was cancelled; nothing is left of it.")
        elif status == 0:
            self._banner.tell(phrase("Exported {path}", path=self._out))
        else:
            LOG.log(logging.INFO if status == REFUSED else logging.WARNING, "export: %s", said)
            sentence = said.rpartition("\n")[2].removeprefix("subdivision-studio: ")
            told_why = phrase("{reason:sentence}", reason=sentence)
            self._banner.say(told_why if sentence else "The export failed; see the log.")

    def _end(self) -> None:
        if self._process is not None:
            self._process.deleteLater()
            self._process = None
            for folder in (self._out, self._out.parent):  # one that had to be killed cleared nothing up
                clear(folder, self._begin)
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None


def arguments(kept: Path, state: State, wish: Wish, out: Path, own: Path | None = None) -> list[str]:
    """The command that makes it, of a state kept in a file."""
    width, height = wish.size
    return [
        "export", str(kept), "--output", str(out), "--format", wish.format, "--of", wish.of,
        "--size", f"{width}x{height}", "--background", wish.background, "--pace", str(wish.pace),
        "--theme", state.options.theme, "--scale", f"{state.options.scale:.0%}", "--progress",
        "--language", state.options.language, *(["--limit"] if wish.limit else []),
        *(["--lessons", str(own), "--trust"] if own is not None else []),
    ]  # fmt: skip

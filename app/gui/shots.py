"""Pictures of the window for the manual: ``python -m app.gui.shots FOLDER``, on a screen, virtual or not."""

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory

from PySide6.QtCore import QBuffer, QEventLoop, QSettings, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QWidget

import lessons
from app import asking
from app.export.wish import Wish
from app.gallery import few_colours
from app.gui.application import application
from app.gui.export import ExportDialog
from app.gui.session import Session
from app.gui.window import Window
from app.laboratory import bench
from app.state import Spot, State, choose, first, last, look, onward, open_lesson, settle, start
from lessons.questions import Where

SIZE = 1280, 720
SETTLED = 2000
"""Milliseconds in which a picture comes to rest, and what is drawn in another thread is there."""


@dataclass(frozen=True)
class Shot:
    """``does`` leads the window there; what it returns is taken instead of the window."""

    name: str
    lesson: str
    does: Callable[[Window], QWidget | None]


def draw(folder: Path) -> Iterator[Path]:
    """A file for every shot."""
    from PIL import Image

    folder.mkdir(parents=True, exist_ok=True)
    application()
    with TemporaryDirectory() as kept:
        window = Window(Session(start(lessons.find("14"))), QSettings(f"{kept}/shots.ini", QSettings.Format.IniFormat))
        window.resize(*SIZE)
        window.show()
        QTest.qWaitForWindowExposed(window)
        window.viewport.start()
        for shot in SHOTS:
            window.session.do(choose, asking=False, lattice=False, spectrum=False)
            window.session.do(open_lesson, lessons.find(shot.lesson))
            window.session.do(first)
            target = shot.does(window) or window
            _wait(SETTLED)
            path = folder / f"{shot.name}.png"
            path.write_bytes(few_colours(Image.open(BytesIO(grabbed(target))).convert("RGB")))
            if target is not window:
                target.close()
            yield path
        window.close()


def _wait(milliseconds: int) -> None:
    loop = QEventLoop()
    QTimer.singleShot(milliseconds, loop.quit)
    loop.exec()


def grabbed(widget: QWidget) -> bytes:
    """What stands on the screen, as PNG: the viewport, too."""
    buffer = QBuffer()
    buffer.open(QBuffer.OpenModeFlag.WriteOnly)
    widget.screen().grabWindow(widget.winId()).save(buffer, "PNG")
    return bytes(buffer.data().data())


# -- what is shown ----------------------------------------------------------------------------


def _geometry(window: Window) -> None:
    """After one level."""
    for _ in range(3):
        window.session.do(onward)
        window.session.do(settle)


def _points(window: Window) -> None:
    """At the corner in front, after one level."""
    _geometry(window)
    window.session.do(look, Spot(0, round(window.session.state.at), 5))


def _presents(window: Window) -> QWidget:
    _geometry(window)
    window.presenter.open(window)
    return window.presenter


def _asks(window: Window) -> None:
    """Where the corner in front will go: three guesses."""
    window.session.do(choose, asking=True)
    window.session.do(asking_anew)
    while not asking.is_open(window.session.state) or asking.answers(window.session.state):
        window.session.do(onward)
        window.session.do(settle)
    asked = asking.question(window.session.state)
    assert isinstance(asked, Where)
    truth = asking.place(window.session.state, asked)
    for away in ((0.15, -0.1, 0.1), (-0.2, 0.1, -0.1), (0.25, -0.2, 0.3)):
        window.session.do(asking.predict, tuple(truth + away))


def asking_anew(state: State) -> State:
    """The same lesson with its questions."""
    return open_lesson(state, state.lesson)


def _enters(window: Window, shape: str, family: str = "") -> None:
    window.session.do(bench.enter)
    window.session.do(bench.take, shape)
    if family:
        window.session.do(bench.choose_family, 0, family)


def _compares(window: Window) -> None:
    _enters(window, "torus")
    window.session.do(bench.compare)
    window.session.do(last)


def _lays_out(window: Window) -> None:
    _enters(window, "landscape", "box-spline")
    window.session.do(choose, lattice=True)
    window.session.do(last)


def _analyses(window: Window) -> None:
    _enters(window, "cube")
    window.session.do(choose, spectrum=True)
    window.session.do(last)


def _exports(window: Window) -> QWidget:
    dialog = ExportDialog(window, window.session.state.options.theme, Wish("pptx"))
    dialog.show()
    return dialog


SHOTS = (
    Shot("window", "14", _geometry),
    Shot("why", "14", _points),
    Shot("presenter", "14", _presents),
    Shot("question", "14", _asks),
    Shot("export", "14", _exports),
    Shot("laboratory", "14", _compares),
    Shot("box_spline", "14", _lays_out),
    Shot("eigenvalues", "14", _analyses),
)


if __name__ == "__main__":
    for drawn in draw(Path(sys.argv[1])):
        print(drawn)

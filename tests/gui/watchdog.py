"""Sees when the window's thread is held up, for how long, and by what.

    with Watchdog(window) as dog:
        with dog.during("next lesson"):
            window.session.do(...)
            qtbot.wait(300)
    assert not dog.blocks(), dog.table()

Within ``during`` a timer beats in the thread of the window.  When two beats are more than a blink apart something
held it up; another thread has looked meanwhile at what it was doing.  What an empty viewport of the same size costs to
draw on this machine, as often as the window drew, is taken off: on software OpenGL that alone can be 50 ms.

Keep one event loop or another running within ``during``: what a test itself computes there counts too.
"""

import sys
import threading
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QSurfaceFormat
from PySide6.QtWidgets import QApplication, QWidget

LIMIT = 0.050
"""Seconds the window's thread may be away from its event loop, besides drawing."""

BLINK = 0.020
"""What is shorter is not looked at."""

BEAT, GLANCE = 5, 0.005
"""Milliseconds between beats; seconds between two looks at what the thread is doing."""

FRAMES = 9
DEPTH = 40


@dataclass(frozen=True)
class Block:
    """One gap of ``seconds`` between two beats, while ``what`` was done.

    ``busy`` seconds of it the thread had a processor; the rest it waited, for OpenGL's threads or for other programs.
    ``drawn`` seconds an empty viewport would have drawn.  ``stack`` is where it was most of the time, outermost first.
    """

    what: str
    seconds: float
    busy: float
    drawn: float
    stack: tuple[str, ...]

    @property
    def excess(self) -> float:
        """Seconds besides what an empty viewport costs."""
        return self.seconds - self.drawn

    def __str__(self) -> str:
        times = " ".join(f"{1e3 * x:6.0f}" for x in (self.excess, self.seconds, self.busy, self.drawn))
        return f"{times}  {self.what:<40} {' > '.join(self.stack[-4:]) or '(Qt)'}"


class Watchdog:
    """Beats in the window's thread while something is done, and remembers every gap."""

    def __init__(self, window: QWidget) -> None:
        self.gaps: list[Block] = []
        self._window, self._what, self._is_over = window, "", threading.Event()
        self._thread = threading.get_ident()
        self._seen: list[tuple[str, ...]] = []
        self._draws: list[int] = []
        self._timer = QTimer(interval=BEAT, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._beat)
        self._glances = threading.Thread(target=self._glance, daemon=True)

    def __enter__(self) -> "Watchdog":
        view = self._window.viewport._plotter
        self._rendering = view.render_window
        self._tag = self._rendering.AddObserver("EndEvent", self._drew)
        self._size = view.width(), view.height()
        for samples in (0, 4):
            empty_frame(*self._size, samples)
        self._glances.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._is_over.set()
        self._timer.stop()
        self._glances.join()
        with suppress(AttributeError):  # the window may have been closed, and its OpenGL with it
            self._rendering.RemoveObserver(self._tag)

    @contextmanager
    def during(self, what: str) -> Iterator[None]:
        """Watch, and call it so."""
        self._again()
        self._what = what
        self._timer.start()
        try:
            yield
        finally:
            self._beat()
            self._timer.stop()
            self._what = ""

    def blocks(self, limit: float = LIMIT) -> list[Block]:
        """The gaps longer than ``limit`` besides drawing, the worst first."""
        return sorted((gap for gap in self.gaps if gap.excess > limit), key=lambda gap: -gap.excess)

    def labours(self, limit: float = LIMIT) -> list[Block]:
        """Those of them in which the thread itself computed so long: on a busy machine no other program causes them."""
        return [gap for gap in self.blocks(limit) if gap.busy > limit]

    def table(self, limit: float = LIMIT) -> str:
        """The blocks as lines of text, times in ms."""
        head = "excess  whole   busy  empty  while                                    at"
        return "\n".join([head, *map(str, self.blocks(limit))])

    def _again(self) -> None:
        self._seen, self._draws = [], []
        self._last, self._busy = time.perf_counter(), time.thread_time()

    def _beat(self) -> None:
        seconds, busy = time.perf_counter() - self._last, time.thread_time() - self._busy
        if seconds > BLINK:
            stack = Counter(self._seen).most_common(1)[0][0] if self._seen else ()
            drawn = sum(empty_frame(*self._size, samples) for samples in self._draws)
            self.gaps.append(Block(self._what, seconds, busy, drawn, stack))
        self._again()

    def _drew(self, *_: object) -> None:
        self._draws.append(self._rendering.GetMultiSamples())

    def _glance(self) -> None:
        while not self._is_over.wait(GLANCE):
            if self._what and time.perf_counter() - self._last > BLINK:
                self._seen.append(_stack(sys._current_frames().get(self._thread)))


def _stack(frame: object) -> tuple[str, ...]:
    """Where a thread is, in the program's own files and the last step outside of them."""
    found: list[str] = []
    while frame is not None and len(found) < DEPTH:
        code = frame.f_code
        name = code.co_filename
        if any(part in name for part in ("/app/", "/subdivision/", "/lessons/")) or not found:
            found.append(f"{'/'.join(name.split('/')[-2:])}:{frame.f_lineno} {code.co_name}")
        frame = frame.f_back
    return tuple(reversed(found))


@cache
def empty_frame(width: int, height: int, samples: int) -> float:
    """Seconds the thread of the window is held up by drawing a viewport with nothing in it: the median of some."""
    times = empty_frames(width, height, samples, FRAMES)
    return sorted(times)[len(times) // 2]


def empty_frames(width: int, height: int, samples: int, count: int) -> list[float]:
    """Seconds of each of so many pictures of a bare viewport, from the wish to the screen."""
    from pyvistaqt import QtInteractor

    usual = QSurfaceFormat.defaultFormat()
    holder = QWidget()
    plotter = QtInteractor(holder, auto_update=False, multi_samples=samples)
    holder.resize(width, height)
    plotter.setGeometry(holder.rect())
    holder.show()
    times = [_redrawn(plotter) for _ in range(count + 2)][2:]
    plotter.close()
    holder.close()
    holder.deleteLater()
    QSurfaceFormat.setDefaultFormat(usual)
    return times


def _redrawn(plotter: QWidget) -> float:
    done: list[float] = []
    tag = plotter.render_window.AddObserver("EndEvent", lambda *_: done.append(1.0))
    QApplication.processEvents()
    done.clear()
    start = time.perf_counter()
    plotter.update()
    while not done and time.perf_counter() - start < 2:
        QApplication.processEvents()
    plotter.render_window.RemoveObserver(tag)
    return time.perf_counter() - start

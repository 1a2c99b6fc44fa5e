"""How fast the window is, beside an empty viewport in an empty window of the same sizes.

Software OpenGL on a virtual screen; ours and the empty one take turns.  Each part runs in a process of its own, which
prints a row a line: what, ours, theirs (null: nothing to compare with), the bound, the unit.
"""

import compileall
import json
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeAlias

ROOT = Path(__file__).parent.parent
SIZE = 1280, 720
SCREEN = "-screen 0 1920x1080x24"
STEP = 0.2
"""Stages from one picture to the next."""

PLAYS = 2
"""How often each lesson is played."""

CLOCKED, SECONDS = 4, 5.0
"""So many lessons, those that take longest, are played at the program's own clock too; an empty viewport so long."""

CHANGES = (("theme", "dark", "light"), ("scale", 1.25, 1.0), ("language", "de", "en"))
"""What of the window's looks is changed, to what, and back to what."""

CHANGED = 3
"""How often there and back."""

STARTS = 7
FACES, LEVEL = 2000, 3
DRAGGED = (1000, 700, 1300, 400, 1600)
"""Control points that are dragged, one after the other."""


Row: TypeAlias = tuple[str, float, float | None, float, str]


def rows() -> Iterator[Row]:
    """What is measured, part by part."""
    for part in ("start", "answers", "motion", "rest", "dragging", "lessons", "looks", "figures"):
        command = [sys.executable, "-m", "benchmarks.window", part]
        screen = [] if os.environ.get("DISPLAY") else ["xvfb-run", "-a", "-s", SCREEN]
        with subprocess.Popen([*screen, *command], cwd=ROOT, stdout=subprocess.PIPE, text=True) as child:
            assert child.stdout
            yield from (json.loads(line) for line in child.stdout if line.startswith("["))


# -- the two windows --------------------------------------------------------------------------


class Pair:
    """The window of the program and an empty one, on the same screen."""

    def __init__(self, **options: Any) -> None:
        from PySide6.QtCore import QSettings
        from PySide6.QtWidgets import QWidget
        from pyvistaqt import QtInteractor

        from app.gui.application import application
        from app.gui.session import Session
        from app.gui.window import Window
        from app.state import Options, start
        from lessons import all_lessons

        self.app = application()
        self.lessons = all_lessons()
        settings = QSettings("/dev/null", QSettings.Format.IniFormat)
        self.window = Window(Session(start(self.lessons[0], Options(**options))), settings)
        self.session = self.window.session
        self.window.resize(*SIZE)
        self.window.show()
        self.wait(0.2)
        self.window.viewport.start()
        self.wait(0.5)
        self.session._timer.timeout.disconnect()
        view = self.window.viewport._plotter
        self.holder = QWidget()
        self.holder.resize(*SIZE)
        self.plain = QtInteractor(self.holder, auto_update=False, multi_samples=0)
        self.plain.setGeometry(self.window.viewport.canvas.geometry())
        self.holder.show()
        self.wait(0.3)
        self.drawn = 0
        for each in (view, self.plain):
            each.render_window.AddObserver("EndEvent", self._drew)

    def _drew(self, *_: object) -> None:
        self.drawn += 1

    def wait(self, seconds: float) -> None:
        end = time.perf_counter() + seconds
        while time.perf_counter() < end:
            self.app.processEvents()
            time.sleep(0.002)

    def throw_away(self) -> None:
        """Delete what the window has thrown away, as the program's own event loop does."""
        from PySide6.QtCore import QCoreApplication, QEvent

        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        self.wait(0.2)

    def until_drawn(self, wish: Callable[[], object]) -> float:
        """Seconds of the processor from a wish until its picture is on the screen: other programs take none of them."""
        self.window.viewport.stay()  # or it is smoothed, or drawn in full, while the empty one is looked at
        self.app.processEvents()
        drawn, end, start = self.drawn, time.perf_counter() + 5, time.process_time()
        wish()
        while (self.drawn == drawn or self.window.viewport.canvas.is_awaited) and time.perf_counter() < end:
            self.app.processEvents()
        return time.process_time() - start

    def both(self, wish: Callable[[], object]) -> tuple[float, float]:
        """The same, and the seconds that pass meanwhile."""
        self.app.processEvents()
        start = time.perf_counter()
        return self.until_drawn(wish), time.perf_counter() - start

    def until_shown(self, wish: Callable[[], object]) -> float:
        """Seconds that pass from a wish until the screen has its picture."""
        start = time.perf_counter()
        self.until_drawn(wish)
        self.app.sync()
        return time.perf_counter() - start

    @contextmanager
    def holding(self, vertex: int) -> Iterator[Callable[[float, float], None]]:
        """A control point of the leading view in the hand; what is given moves it so many pixels right and down."""
        from PySide6.QtCore import QEvent, QPointF, Qt
        from PySide6.QtGui import QMouseEvent

        view, state = self.window.viewport, self.session.state
        (x, y, w, h), seen = view.areas()[0], view.cameras()[0]
        assert seen is not None
        right, down, _ = seen.project(state.trace(state.now.lead).control.points[vertex], w, h)[0]

        def send(kind: QEvent.Type, button: Qt.MouseButton, dx: float = 0.0, dy: float = 0.0) -> None:
            at, none = QPointF(x + right + dx, y + down + dy), Qt.KeyboardModifier.NoModifier
            held = Qt.MouseButton.NoButton if kind == QEvent.Type.MouseButtonRelease else Qt.MouseButton.LeftButton
            self.app.sendEvent(view.canvas, QMouseEvent(kind, at, view.canvas.mapToGlobal(at), button, held, none))

        send(QEvent.Type.MouseButtonPress, Qt.MouseButton.LeftButton)
        yield lambda dx, dy: send(QEvent.Type.MouseMove, Qt.MouseButton.NoButton, dx, dy)
        send(QEvent.Type.MouseButtonRelease, Qt.MouseButton.LeftButton)
        self.wait(0.3)

    def empty(self) -> float:
        return self.until_drawn(self.plain.update)

    def close(self) -> None:
        sys.stdout.flush()
        os._exit(0)  # two OpenGL windows in one process come down in no good order


def say(what: str, ours: float, theirs: float | None, bound: float, unit: str = "ms") -> None:
    print(json.dumps([what, ours, theirs, bound, unit]), flush=True)


# -- parts ------------------------------------------------------------------------------------


def motion() -> None:
    """Every stage of every lesson, with all labels and the legend, its words set while the window rested.

    Seconds that pass from a tick of the session until its picture is on the screen, beside those of an empty viewport;
    the two take turns, picture for picture, so that what else the machine does meets both.  For every beat the median,
    over all the times it is played; added up over the lesson.  The same then at the program's own clock.
    """
    from app.gui.ahead import played
    from app.state import first, open_lesson

    pair = Pair(labels=True, legend=True)
    session, ratios = pair.session, {}
    for lesson in pair.lessons:
        session.do(open_lesson, lesson)
        for piece in played(lesson, lambda: session.state, pair.window.viewport):
            piece()
        pair.wait(0.3)
        beats: dict[int, list[tuple[float, float]]] = {}
        for _ in range(PLAYS):
            session.do(first)
            _play_by_ticks(pair, beats)
        if beats:
            ours, theirs = (sum(statistics.median(two[k] for two in each) for each in beats.values()) for k in (0, 1))
            ratios[lesson.id] = ours / theirs
            say(f"a picture of {lesson.id} while it plays", ours, theirs, 2.0)
    session._timer.timeout.connect(session._advance)
    for name in sorted(ratios, key=lambda name: -ratios[name])[:CLOCKED]:
        _play_by_the_clock(pair, name)
    pair.close()


def _play_by_ticks(pair: Pair, beats: dict[int, list[tuple[float, float]]]) -> None:
    """The lesson from where it stands to its end: for each beat the seconds of its pictures, and of empty ones."""
    from app.state import forward, tick

    do = pair.session.do
    while True:
        place = pair.session.state.beat, pair.session.state.at
        do(forward)
        if (pair.session.state.beat, pair.session.state.at) == place and not pair.session.state.is_playing:
            return
        beat = pair.session.state.beat
        while pair.session.state.is_playing:
            ours = pair.until_shown(lambda: do(tick, STEP))
            beats.setdefault(beat, []).append((ours, pair.until_shown(pair.plain.update)))


def _play_by_the_clock(pair: Pair, name: str) -> None:
    """What the audience sees: pictures a second of a lesson, and of an empty viewport that is wished for as often."""
    from PySide6.QtCore import Qt, QTimer

    from app.gui.session import FRAME
    from app.state import first, forward, open_lesson

    do, passed, drawn = pair.session.do, 0.0, 0
    do(open_lesson, next(lesson for lesson in pair.lessons if lesson.id == name))
    do(first)
    pair.wait(0.5)
    while True:
        place, begin, before = (pair.session.state.beat, pair.session.state.at), time.perf_counter(), pair.drawn
        do(forward)
        if (pair.session.state.beat, pair.session.state.at) == place and not pair.session.state.is_playing:
            break
        while pair.session.state.is_playing:
            pair.app.processEvents()
        passed, drawn = passed + time.perf_counter() - begin, drawn + pair.drawn - before
        pair.wait(0.3)
    timer = QTimer(interval=FRAME, timerType=Qt.TimerType.PreciseTimer)
    timer.timeout.connect(pair.plain.update)
    begin, before = time.perf_counter(), pair.drawn
    timer.start()
    while time.perf_counter() < begin + min(passed, SECONDS):
        pair.app.processEvents()
    timer.stop()
    empty = (time.perf_counter() - begin) / max(pair.drawn - before, 1)
    say(f"a picture of {name} at the program's own clock", passed / max(drawn, 1), empty, 2.0)


def rest() -> None:
    """Nothing is drawn while nothing changes, and what stands is smooth."""
    pair = Pair()
    pair.wait(1.0)
    drawn = pair.drawn
    pair.wait(3.0)
    say("pictures drawn in 3 s in which nothing happens", pair.drawn - drawn, None, 0, "")
    samples = pair.window.viewport.samples
    say(f"samples wanting of 4 in a picture at rest ({samples} are there)", max(4 - samples, 0), None, 0, "")
    pair.close()


def dragging() -> None:
    """From the mouse to the picture: some points in turn of a control mesh of 2,000 faces that is shown at level 3."""
    import numpy as np

    from app.laboratory.bench import put
    from app.laboratory.lab import Lab, Rule
    from app.state import choose, last
    from subdivision import Grid, Mesh

    pair = Pair(control=True)
    n, m = 40, FACES // 40
    grid = Grid(n + 1, m + 1)
    topology = grid.mesh()
    x, y = np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, m + 1), indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), 0.2 * np.sin(4 * x.ravel()) * np.cos(3 * y.ravel())], axis=1)
    pair.session.do(put, Lab("sheet", Mesh(topology, points), (Rule("catmull-clark", telling="stencils"),), LEVEL))
    pair.session.do(last)
    shown = pair.session.state.trace(pair.session.state.now.lead)
    n_faces = shown.topology_at(len(shown.stages)).n_faces
    what = f"{FACES:,} faces at level {LEVEL} ({n_faces:,})"
    for words, is_on in (("", False), (" with all its control points", True)):
        ours, theirs = [], []
        for vertex in DRAGGED:
            pair.session.do(choose, control=True)  # what is not shown cannot be taken hold of
            pair.wait(1.5)
            with pair.holding(vertex) as move:
                pair.session.do(choose, control=is_on)
                for k in range(1, 9):
                    ours.append(pair.both(lambda k=k: move(5 * k, -3 * k)))
                    theirs.append(pair.both(pair.plain.update))
        assert len(pair.session.state.edits) == len(DRAGGED)
        for kind, bound, at in (("", 2.0, 0), (", by the clock on the wall", float("inf"), 1)):
            times = ([each[at] for each in found] for found in (ours, theirs))
            say(f"mouse to picture, {what}{words}{kind}", *medians(*times), bound)
    pair.close()


def lessons() -> None:
    """From one lesson to the next; and the longest time the thread of the window was away meanwhile."""
    from app.gui.ahead import look_for_garbage_in_little
    from app.state import forward, open_lesson
    from tests.gui.watchdog import LIMIT, Watchdog

    pair = Pair()
    look_for_garbage_in_little()  # as the program does when it has begun
    pair.wait(1.0)
    pair.session._timer.timeout.connect(pair.session._advance)
    with Watchdog(pair.window) as dog:
        for turn in ("for the first time", "again"):
            times = {}
            for lesson in (*pair.lessons[1:], pair.lessons[0]):  # which is open at first
                with dog.during(f"opening {lesson.id} {turn}"):
                    taken = pair.until_drawn(lambda lesson=lesson: pair.session.do(open_lesson, lesson))
                    times[lesson.id] = taken - pair.empty()
                    pair.wait(0.4)
                with dog.during(f"playing {lesson.id} {turn}"):
                    pair.session.do(forward)
                    pair.wait(0.3)
            worst = max(times, key=lambda name: times[name])
            say(f"opening a lesson {turn}, besides an empty picture; the worst: {worst}", times[worst], None, 0.150)
            say(f"opening a lesson {turn}, half of them take less", statistics.median(times.values()), None, 0.150)
    worst = max(dog.gaps, key=lambda gap: min(gap.excess, gap.busy))
    say(f"the window's thread away: at most, {worst.what}", min(worst.excess, worst.busy), None, LIMIT)
    print(dog.table(), file=sys.stderr)
    pair.close()


def looks() -> None:
    """Another theme, size or language, over a lesson and in the laboratory: how long the window's thread is away."""
    from app.gui.ahead import look_for_garbage_in_little
    from app.laboratory import bench
    from app.state import choose
    from tests.gui.watchdog import LIMIT, Watchdog

    pair = Pair()
    look_for_garbage_in_little()
    pair.wait(1.0)
    with Watchdog(pair.window) as dog:
        for place in ("over a lesson", "in the laboratory"):
            for what, other, usual in CHANGES:
                times = []
                for value in (other, usual) * CHANGED:
                    dog.gaps.clear()
                    with dog.during(what):
                        pair.session.do(choose, **{what: value})
                        pair.wait(0.6)
                    times.append(max((min(gap.excess, gap.busy) for gap in dog.gaps), default=0.0))
                    pair.throw_away()
                words = f"another {what} {place}: the window's thread away at most; half of the times less"
                say(words, statistics.median(times), None, LIMIT)
            pair.session.do(bench.take, "cube")
            pair.wait(1.0)
    pair.close()


def medians(*times: list[float]) -> list[float]:
    return [statistics.median(each) for each in times]


# -- processes of their own -------------------------------------------------------------------

FIRST = "import benchmarks.window as w; w.{}()"


def start() -> None:
    """From the command to the first picture, beside a program that imports the same and shows an empty viewport.

    The best of the turns, by the clock and in seconds of the processor, which other programs take none of; all that
    is imported has been compiled, as installing does.
    """
    from PySide6.QtGui import QGuiApplication

    _compile()
    screen = QGuiApplication([])  # a virtual screen that all have left begins anew, which takes its time
    times: dict[str, list[tuple[float, float]]] = {"program": [], "bare": []}
    libraries: dict[str, set[str]] = {}
    for _ in range(STARTS):
        for name, found in times.items():
            begin, spent = time.time(), _spent()
            done = subprocess.run([sys.executable, "-c", FIRST.format(name)], capture_output=True, text=True, cwd=ROOT)
            seen, *imported = done.stdout.split()
            found.append((float(seen) - begin, _spent() - spent))
            libraries[name] = set(imported)
    del screen
    for k, what in enumerate(("", ", of the processor")):
        say(f"from the command to the first picture{what}", *(min(t[k] for t in each) for each in times.values()), 1.3)
    more = libraries["program"] - libraries["bare"]
    say("modules of libraries that the empty viewport is spared", len(more), None, 0, "")


def _spent() -> float:
    """Seconds that the processor has spent on programs that were started from here and have ended."""
    times = os.times()
    return times.children_user + times.children_system


def _compile() -> None:
    for package in ("app", "lessons", "subdivision", "benchmarks"):
        compileall.compile_dir(ROOT / package, quiet=2)


def program() -> None:
    """The window as the command opens it, until its first picture is on the screen."""
    from app import cli

    opened = cli._opened

    def watched(options: Any) -> int:  # in the order in which the command itself imports, which counts
        from app.gui.viewport import QTimer, Viewport

        begun = Viewport.start

        def start(self: Any) -> None:
            begun(self)  # what is drawn is on the screen when Qt has painted it
            self._plotter.render_window.AddObserver("EndEvent", lambda *_: QTimer.singleShot(0, _seen))

        Viewport.start = start  # type: ignore[method-assign]
        return opened(options)

    cli._opened = watched
    cli.main([])


def bare() -> None:
    """A viewport with nothing in it, and nothing else, with the libraries that the program has."""
    os.environ["QT_API"] = "pyside6"
    import matplotlib.textpath  # noqa: F401
    import scipy.sparse  # noqa: F401
    from PySide6 import QtSvg  # noqa: F401
    from PySide6.QtWidgets import QApplication
    from pyvistaqt import QtInteractor

    app = QApplication([])
    plotter = QtInteractor(auto_update=False, multi_samples=0)
    plotter.resize(*SIZE)
    plotter.frameSwapped.connect(_seen)
    plotter.show()
    app.exec()


def _seen() -> None:
    print(time.time())
    ours = {*sys.stdlib_module_names, "app", "lessons", "subdivision", "benchmarks", "__main__"}
    print(*(name for name in sys.modules if name.partition(".")[0] not in ours), flush=True)
    os._exit(0)


def answers() -> None:
    """What is answered without a window needs none of its libraries; and how long it takes."""
    _compile()
    for words in (["--help"], ["lessons"]):
        command = [sys.executable, "-X", "importtime", "-m", "app", *words]
        told = subprocess.run(command, capture_output=True, text=True, cwd=ROOT).stderr
        names = [line.rpartition("|")[2].strip() for line in told.splitlines()]
        heavy = [name for name in names if name.split(".")[0] in ("PySide6", "vtkmodules", "pyvista", "pyvistaqt")]
        say(f"modules of Qt and VTK that '{' '.join(words)}' imports", len(heavy), None, 0, "")
        begin = time.perf_counter()
        subprocess.run([sys.executable, "-m", "app", *words], capture_output=True, cwd=ROOT, check=True)
        say(f"until '{' '.join(words)}' has answered", time.perf_counter() - begin, None, float("inf"))


def figures() -> None:
    """All figures of the lecture as PNG, and what of it takes how long."""
    begin = time.perf_counter()
    import tempfile

    from PIL import Image

    from app import figures as app_figures
    from app.draw import raster
    from lessons import all_lessons
    from lessons.script import Lesson

    spent = {"importing": time.perf_counter() - begin}
    told = all_lessons()
    begin = time.perf_counter()
    for lesson in told:
        assert isinstance(lesson, Lesson)
        assert lesson.beats
    spent["telling"] = time.perf_counter() - begin
    _timed(app_figures, "seen", "composing", spent)
    _timed(raster, "image", "drawing", spent)
    _timed(Image.Image, "save", "encoding", spent)
    windows: list[int] = []
    built = raster._Studio.__init__
    raster._Studio.__init__ = lambda self: (windows.append(1), built(self))[1]  # type: ignore[method-assign]
    with tempfile.TemporaryDirectory() as folder:
        whole = time.perf_counter()
        for lesson in told:
            app_figures.render(lesson, folder)
        whole = time.perf_counter() - whole
    for name, seconds in spent.items():
        say(f"{len(told)} figures as PNG of 1920x1080: {name}", seconds, None, float("inf"))
    whole += spent["importing"] + spent["telling"]
    say(f"{len(told)} figures as PNG of 1920x1080: all of it", whole, None, float("inf"))
    say("off-screen windows made for them", len(windows), None, 1, "")


def _timed(holder: Any, name: str, what: str, spent: dict[str, float]) -> None:
    """Count the seconds that a function takes."""
    made = getattr(holder, name)

    def timed(*arguments: Any, **options: Any) -> Any:
        begin = time.perf_counter()
        try:
            return made(*arguments, **options)
        finally:
            spent[what] = spent.get(what, 0.0) + time.perf_counter() - begin

    setattr(holder, name, timed)


if __name__ == "__main__":
    globals()[sys.argv[1]]()

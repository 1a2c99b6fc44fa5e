"""What a user does: each kind of action is a function of the hand and of random numbers, told step by step.

Between steps the event loop runs.  An action depends on its own seed and on what the window shows, so a run can be
repeated, and shortened by leaving actions out.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from random import Random

from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QGuiApplication, QKeySequence, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSlider,
    QApplication,
    QComboBox,
    QDoubleSpinBox,
    QLineEdit,
    QMenu,
    QScrollBar,
    QWidget,
)

from app.draw.picture import Scene
from app.gui.keys import COMMANDS
from app.gui.window import Window
from app.laboratory import bench
from app.state import tick
from tests.hostile.corpus import corpus, sound

NOBODY = ("quit",)
"""Commands that would end the run."""

NO, CTRL, SHIFT, ALT = (
    Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)  # fmt: skip
LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
SIZES = ((720, 480), (900, 600), (1000, 640), (1280, 720), (1280, 720), (1366, 768), (1600, 900))
WORDS = ("cube", "3.", "loop box", "xyz", "14", "figure", "Exercise 1", "", "  ", "lane")
NUMBERS = ("0", "1", "-1", "0.25", "1e3", "-0.5", "2.125", "x", "999999")
KEYS = tuple((each.name, QKeySequence(key)) for each in COMMANDS if each.id not in NOBODY for key in each.keys)

Steps = Iterator[str]
Does = Callable[["Hand", Random], Steps]
ACTIONS: dict[str, tuple[float, Does]] = {}
"""Kind -> (how often, against the others; what is done)."""


@dataclass(frozen=True)
class Action:
    """Number ``number`` of a run; ``seed`` is where its random numbers begin."""

    number: int
    kind: str
    seed: int


def actions(seed: int, count: int) -> list[Action]:
    """Those of a run."""
    rng, weights = Random(seed), [weight for weight, _ in ACTIONS.values()]
    kinds = rng.choices(list(ACTIONS), weights, k=count)
    return [Action(k, kind, rng.getrandbits(32)) for k, kind in enumerate(kinds)]


class Hand:
    """The mouse, the keyboard and the files of a user, at a window."""

    def __init__(self, window: Window, folder: Path) -> None:
        self.window, self.folder, self.rng = window, folder, Random(0)
        self.good = [self._file(name, data) for name, data in sound().items()]
        self.bad = [self._file(name, data) for name, data in corpus(worst=False)]

    def do(self, action: Action) -> Steps:
        """The steps of an action."""
        self.rng = Random(action.seed)
        return ACTIONS[action.kind][1](self, self.rng)

    def file(self, rng: Random) -> Path:
        """One that could be opened: a mesh, a session that was saved, or something broken."""
        sessions = sorted(self.folder.glob("*.subdivision"))
        return rng.choice(rng.choice([self.good, self.good, self.bad, sessions or self.good]))

    def key(self, chord: QKeySequence) -> None:
        """As the keyboard sends it: to whatever has the focus, or to the menu that is open."""
        combination = chord[0]
        target = QApplication.activePopupWidget() or self.window.windowHandle()
        QTest.keyClick(target, combination.key(), combination.keyboardModifiers())

    def place(self, widget: QWidget, x: float, y: float) -> QPoint:
        """Where a part of a widget is in the window; it is scrolled to first."""
        if self.window.details.isAncestorOf(widget):
            self.window.details.ensureWidgetVisible(widget)
        return widget.mapTo(self.window, QPoint(round(x * (widget.width() - 1)), round(y * (widget.height() - 1))))

    def mouse(self, how: Callable[..., None], at: QPoint, button: Qt.MouseButton = LEFT,
              held: Qt.KeyboardModifier = NO) -> None:  # fmt: skip
        """A mouse button, to whatever is there."""
        how(self.window.windowHandle(), button, held, self.inside(at))

    def move(self, at: QPoint) -> None:
        """The mouse over the window."""
        QTest.mouseMove(self.window.windowHandle(), self.inside(at))

    def inside(self, at: QPoint) -> QPoint:
        """The nearest place in the window."""
        return QPoint(min(max(at.x(), 0), self.window.width() - 1), min(max(at.y(), 0), self.window.height() - 1))

    def seen(self, *kinds: type) -> list[QWidget]:
        """The widgets of some kinds that can be used now, but for the button in a line of text, which fades away."""
        every = (w for kind in kinds for w in self.window.findChildren(kind))
        found = (w for w in every if not isinstance(w.parent(), QLineEdit))
        return [w for w in found if w.isVisible() and w.isEnabled() and not isinstance(w, QScrollBar)]

    def in_view(self, rng: Random) -> QPoint:
        """Somewhere on the picture: mostly at one of the points that are shown."""
        view = self.window.viewport
        scenes = [
            (pane.content, area, camera)
            for pane, area, camera in zip(view.picture().panes, view.areas(), view.cameras(), strict=True)
            if isinstance(pane.content, Scene) and camera is not None and pane.content.markers
        ]
        if not scenes or rng.random() < 0.3:
            return self.place(view, rng.random(), rng.random())
        content, (left, top, wide, tall), camera = rng.choice(scenes)
        points = rng.choice(content.markers).points
        if not len(points):
            return self.place(view, rng.random(), rng.random())
        x, y, _ = camera.project(points[rng.randrange(len(points))], wide, tall)[0]
        x, y = (min(max(left + x, 0), view.width() - 1), min(max(top + y, 0), view.height() - 1))
        return view.mapTo(self.window, QPoint(round(x), round(y)))

    def _file(self, name: str, data: bytes) -> Path:
        path = self.folder / name.replace("/", "-")
        path.write_bytes(data)
        return path


def often(weight: float) -> Callable[[Does], Does]:
    """Enter a kind of action, done so often against the others."""

    def entered(does: Does) -> Does:
        ACTIONS[does.__name__] = weight, does
        return does

    return entered


# -- keys and menus -----------------------------------------------------------------------------


@often(24)
def key(hand: Hand, rng: Random) -> Steps:
    name, chord = rng.choice(KEYS)
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        hand.key(chord)
        yield f"{chord.toString()} ({name})"


@often(2)
def undo(hand: Hand, rng: Random) -> Steps:
    chord = QKeySequence(rng.choice(("Ctrl+Z", "Ctrl+Z", "Ctrl+Shift+Z")))
    for _ in range(rng.randrange(1, 12)):
        hand.key(chord)
        yield chord.toString()


@often(3)
def focus(hand: Hand, rng: Random) -> Steps:
    for _ in range(rng.randrange(1, 6)):
        hand.key(QKeySequence(rng.choice(("Tab", "Shift+Tab"))))
        yield "Tab"
    name = described(hand.window.focusWidget())
    hand.key(QKeySequence(rng.choice(("Space", "Up", "Down", "Left", "Return"))))
    yield f"a key to {name}"


@often(4)
def menu(hand: Hand, rng: Random) -> Steps:
    yield from _chosen(hand, rng, rng.choice([a.menu() for a in hand.window.menuBar().actions() if a.menu()]))


def _chosen(hand: Hand, rng: Random, menu: QMenu) -> Steps:
    menu.popup(hand.window.mapToGlobal(QPoint(40, 30)))
    yield f"the menu {menu.title()}"
    quitting = hand.window.actions_by_id["quit"]
    entries = [a for a in menu.actions() if a.isEnabled() and not a.isSeparator() and a is not quitting]
    if not entries:
        menu.close()
        return
    entry = rng.choice(entries)
    if entry.menu() is not None:
        menu.close()
        yield from _chosen(hand, rng, entry.menu())
        return
    menu.setActiveAction(entry)
    said = f"{menu.title()} > {entry.text()}"
    QTest.keyClick(menu, Qt.Key.Key_Return)
    yield said


# -- the mouse on the picture -------------------------------------------------------------------


@often(6)
def point(hand: Hand, rng: Random) -> Steps:
    for _ in range(rng.randrange(1, 4)):
        at = hand.in_view(rng)
        hand.move(at)
        yield f"point at {at.x()}, {at.y()}"


@often(8)
def click(hand: Hand, rng: Random) -> Steps:
    at, held = hand.in_view(rng), rng.choice((NO, NO, SHIFT))
    hand.mouse(QTest.mouseClick, at, rng.choice((LEFT, LEFT, LEFT, RIGHT)), held)
    yield f"click at {at.x()}, {at.y()}{' with Shift' if held == SHIFT else ''}"


@often(1.5)
def double_click(hand: Hand, rng: Random) -> Steps:
    at = hand.in_view(rng)
    hand.mouse(QTest.mouseDClick, at)
    yield f"double click at {at.x()}, {at.y()}"


@often(9)
def drag(hand: Hand, rng: Random) -> Steps:
    start, stop = hand.in_view(rng), hand.place(hand.window.viewport, rng.random(), rng.random())
    button, held = rng.choice(((LEFT, NO), (LEFT, NO), (LEFT, NO), (LEFT, SHIFT), (RIGHT, NO)))
    yield from _dragged(hand, start, stop, rng.randrange(1, 6), button, held)


def _dragged(hand: Hand, start: QPoint, stop: QPoint, steps: int, button: Qt.MouseButton = LEFT,
             held: Qt.KeyboardModifier = NO) -> Steps:  # fmt: skip
    said = f"drag from {start.x()}, {start.y()} to {stop.x()}, {stop.y()}"
    hand.mouse(QTest.mousePress, start, button, held)
    yield said
    for k in range(1, steps + 1):
        hand.move(start + (stop - start) * (k / steps))
        yield said
    hand.mouse(QTest.mouseRelease, stop, button, held)
    yield said


@often(3)
def wheel(hand: Hand, rng: Random) -> Steps:
    at, view = hand.in_view(rng), hand.window.viewport.canvas
    here = QPointF(view.mapFrom(hand.window, at))
    for _ in range(rng.randrange(1, 5)):
        turn = QPoint(0, rng.choice((-240, -120, -15, 15, 120, 240)))
        QApplication.sendEvent(view, QWheelEvent(
            here, view.mapToGlobal(here), QPoint(), turn, Qt.MouseButton.NoButton, NO, Qt.ScrollPhase.NoScrollPhase,
            False,
        ))  # fmt: skip
        yield f"wheel {turn.y()} at {at.x()}, {at.y()}"
    if rng.random() < 0.7:  # so long a pause that the next turn is another change
        hand.window.session.let_go()


# -- the mouse round the picture ----------------------------------------------------------------


@often(14)
def press(hand: Hand, rng: Random) -> Steps:
    buttons = [b for b in hand.seen(QAbstractButton) if b.width() > 2]
    if buttons:
        button = rng.choice(buttons)
        name = described(button)
        hand.mouse(QTest.mouseClick, hand.place(button, 0.5, 0.5))
        yield f"press {name}"


@often(5)
def choose(hand: Hand, rng: Random) -> Steps:
    if boxes := hand.seen(QComboBox):
        box = rng.choice(boxes)
        hand.place(box, 0.5, 0.5)
        box.setFocus(Qt.FocusReason.TabFocusReason)
        name = described(box)
        for _ in range(rng.randrange(1, 6)):
            hand.key(QKeySequence(rng.choice(("Down", "Down", "Up"))))
            yield name


@often(2)
def number(hand: Hand, rng: Random) -> Steps:
    if boxes := hand.seen(QDoubleSpinBox):
        box, words = rng.choice(boxes), rng.choice(NUMBERS)
        name = described(box)
        hand.mouse(QTest.mouseClick, hand.place(box, 0.3, 0.5))
        box.selectAll()
        QTest.keyClicks(box, words)
        yield f"{words} into {name}"
        hand.key(QKeySequence("Return"))
        yield f"Return in {name}"


@often(3)
def slide(hand: Hand, rng: Random) -> Steps:
    if sliders := hand.seen(QAbstractSlider):
        slider = rng.choice(sliders)
        start, stop = (hand.place(slider, rng.random(), 0.3) for _ in "ab")
        yield from _dragged(hand, start, stop, 3)


@often(5)
def scrub(hand: Hand, rng: Random) -> Steps:
    track = hand.window.timeline._track
    if track.isVisible():
        start, stop = (hand.place(track, rng.random(), 0.5) for _ in "ab")
        yield from _dragged(hand, start, stop, rng.randrange(1, 5))


@often(5)
def poke(hand: Hand, rng: Random) -> Steps:
    """Anything at all: click it or drag over it."""
    leaves = [w for w in hand.seen(QWidget) if w.width() > 4 and w.height() > 4 and not _has_children(w)]
    widget = rng.choice(leaves)
    name = described(widget)
    start, stop = (hand.place(widget, rng.random(), rng.random()) for _ in "ab")
    held = rng.choice((NO, NO, SHIFT, CTRL, ALT))
    yield from _dragged(hand, start, rng.choice((start, stop)), 2, rng.choice((LEFT, LEFT, RIGHT)), held)
    yield f"poke {name}"


def _has_children(widget: QWidget) -> bool:
    return any(child.isVisible() for child in widget.findChildren(QWidget))


@often(5)
def lesson(hand: Hand, rng: Random) -> Steps:
    listed = hand.window.contents.list
    if listed.isVisible() and (rows := listed.model().rowCount()):
        row = listed.model().index(rng.randrange(rows), 0)
        listed.scrollTo(row)
        at = listed.visualRect(row).center()
        hand.mouse(QTest.mouseClick, listed.viewport().mapTo(hand.window, at))
        yield f"lesson {row.data()}"


@often(2)
def search(hand: Hand, rng: Random) -> Steps:
    hand.key(QKeySequence("Ctrl+K"))
    yield "Ctrl+K"
    words = rng.choice(WORDS)
    QTest.keyClicks(hand.window.contents.search, words)
    yield f"search {words!r}"
    hand.key(QKeySequence(rng.choice(("Return", "Return", "Escape", "Down"))))
    yield "end of the search"


@often(1.5)
def resize(hand: Hand, rng: Random) -> Steps:
    size = rng.choice(SIZES)
    hand.window.resize(*size)
    QGuiApplication.sync()
    yield f"resize to {size[0]} x {size[1]}"


# -- the laboratory -----------------------------------------------------------------------------


@often(3)
def laboratory(hand: Hand, rng: Random) -> Steps:
    if not bench.is_open(hand.window.session.state):
        listed = hand.window.contents.list.model()
        rows = [listed.index(k, 0) for k in range(listed.rowCount())]
        hand.window.contents.list.activated.emit(rows[-1])
        yield "the laboratory"
    box = hand.window.laboratory.shape.box
    if box.isVisible():
        box.setFocus(Qt.FocusReason.TabFocusReason)
        QTest.keyClicks(box, rng.choice("abcdefghijklmnopqrstuvwxyz"))
        yield f"the object {box.currentText()}"


@often(5)
def edit(hand: Hand, rng: Random) -> Steps:
    """Pick parts of the control object, and do something to them."""
    if not bench.is_open(hand.window.session.state):
        return
    hand.key(QKeySequence("Home"))
    yield "Home"
    for held in (NO, SHIFT, SHIFT)[: rng.randrange(1, 4)]:
        at = hand.in_view(rng) if rng.random() < 0.5 else hand.place(hand.window.viewport, rng.random(), rng.random())
        hand.mouse(QTest.mouseClick, at, LEFT, held)
        yield f"pick at {at.x()}, {at.y()}"
    chord = QKeySequence(rng.choice(("Ins", "Del", "F", "E", "S", "S", "S", "Shift+S")))
    hand.key(chord)
    yield chord.toString()


# -- time ---------------------------------------------------------------------------------------


@often(6)
def watch(hand: Hand, rng: Random) -> Steps:
    """Let it play for a while."""
    session = hand.window.session
    for _ in range(rng.randrange(2, 25)):
        if session.state.is_playing:
            session.do(tick, rng.choice((0.02, 0.05, 0.1, 0.5)))
            yield "watch"


@often(0.3)
def rest(hand: Hand, rng: Random) -> Steps:
    QTest.qWait(rng.choice((200, 600)))
    yield "rest"


# -- files, sessions, links ---------------------------------------------------------------------


@often(1.5)
def open_file(hand: Hand, rng: Random) -> Steps:
    path = hand.file(rng)
    hand.window.open_file(str(path))
    yield f"open {path.name}"


@often(0.7)
def drop(hand: Hand, rng: Random) -> Steps:
    path = hand.file(rng)
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path))])
    how = Qt.DropAction.CopyAction, data, LEFT, NO
    entering = QDragEnterEvent(QPoint(100, 100), *how)
    QApplication.sendEvent(hand.window, entering)
    if entering.isAccepted():
        QApplication.sendEvent(hand.window, QDropEvent(QPointF(100, 100), *how))
    yield f"drop {path.name}"


@often(1)
def save(hand: Hand, rng: Random) -> Steps:
    hand.key(QKeySequence(rng.choice(("Ctrl+S", "Ctrl+Shift+S"))))
    yield "save"


@often(1.5)
def link(hand: Hand, rng: Random) -> Steps:
    hand.key(QKeySequence("Ctrl+L"))
    yield "Ctrl+L"
    if rng.random() < 0.3:
        QGuiApplication.clipboard().setText(rng.choice(("hello", QGuiApplication.clipboard().text()[:-7])))
    yield from _chosen_lesson(hand, rng)
    hand.window.viewport.setFocus()
    hand.key(QKeySequence("Ctrl+V"))
    yield "Ctrl+V"


def _chosen_lesson(hand: Hand, rng: Random) -> Steps:
    if rng.random() < 0.5:
        yield from lesson(hand, rng)


@often(0.3)
def close(hand: Hand, rng: Random) -> Steps:
    """Ask to quit, and think better of it."""
    if hand.window.document.is_modified:
        hand.window.actions_by_id["quit"].trigger()
        yield "quit, cancelled"


def described(widget: QWidget | None) -> str:
    """A widget by its class and name."""
    if widget is None:
        return "nothing"
    name = widget.accessibleName() or (widget.text() if hasattr(widget, "text") else "") or widget.objectName()
    return f"{type(widget).__name__} {str(name)[:40]!r}"

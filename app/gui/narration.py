"""The caption and its formula, under the picture and large enough for the back row."""

from bisect import bisect_left
from functools import lru_cache
from typing import TypeAlias

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from app.asking import answers, is_open
from app.draw.compose import said
from app.draw.primitives import Text
from app.draw.theme import THEMES
from app.draw.type import measure, wrapped
from app.gui.brush import type_
from app.gui.flat import touched
from app.gui.look import GRID, colour
from app.gui.session import Session
from app.state import Options, State, stops
from app.words import tr
from lessons.script import Lesson

SMALL, LARGE = 1 / 34, 1 / 28
"""Size of the caption relative to the window's height, at a desk and when presenting."""

ROOM, STEPS = 1 / 4, 32
"""Enlarged, it takes no more of the window's height than the first; it is fitted in so many steps."""

HINT_ROOM = 0.5
"""Relative to the size of the caption."""

LINE = 1.32
"""From one baseline to the next."""

Piece: TypeAlias = tuple[str, float, float, str]
"""Type: its words, x from the middle, baseline, alignment."""

Told: TypeAlias = tuple[str, str, bool]
"""What a beat says: its caption, its formula, whether it asks."""

HINT = "Space or PageDown: next stage"
WHERE_HINT = "Click where you think it goes, up to 8 times. Backspace: take one back. Next: see"
ANSWER_HINT = "Click an answer or press its number. Next: see"


class Narration(QWidget):
    """What the beat says.  Its height is the tallest beat's, so that the picture does not jump within a lesson."""

    def __init__(self, session: Session, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._session = session
        self._now: tuple[object, ...] = ()

    def show_state(self, state: State) -> None:
        o = state.options
        now = (state.now, o.theme, o.as_caption, o.presenting, o.blank, self._hint(state))
        if now != self._now:
            self._now = now
            self.setAccessibleName(f"{said(state, state.now)} {state.now.formula}")
            self.update()

    def furnish(self) -> None:
        """Say it again, in other words or another size."""
        self._now = ()

    def height_for(self, width: int, window_height: int) -> int:
        """Room for every beat of the lesson, on the grid."""
        return room(self._session.state, width, window_height)

    def paintEvent(self, event: QPaintEvent) -> None:
        state = self._session.state
        if state.options.blank:
            return
        theme = THEMES[state.options.theme]
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(self.rect(), colour(theme.background))
        size = self._size(self.width(), self.window().height())
        lines, tall = _laid(said(state, state.now), state.now.formula, size, self.width())
        room = self.height() - 1.1 * size - (HINT_ROOM * size if self._hint(state) else 0.0)
        top = 0.3 * size + max(room - tall, 0) / 2
        for text, x, y, align in lines:
            line = Text(self.width() / 2 + x, top + y, text, size, theme.ink, align)
            if event.region().intersects(touched(line)):
                type_(painter, line)
        if hint := self._hint(state):
            small = min(0.62 * size, 0.94 * self.width() / measure(hint, 1.0)[0])
            type_(painter, Text(self.width() / 2, self.height() - 0.55 * small, hint, small, theme.muted, "center"))
        painter.end()

    def _hint(self, state: State) -> str:
        """What to do first, until it has been done; and at a question."""
        if is_open(state):
            return tr(ANSWER_HINT if answers(state) else WHERE_HINT)
        first = stops(state.lesson)[0]
        if len(stops(state.lesson)) == 1:
            return ""
        return tr(HINT) if (state.beat, state.at) == (first.beat, first.at) and not state.is_playing else ""

    def _size(self, width: int, window_height: int) -> float:
        return _size(self._session.state, width, window_height)


def room(state: State, width: int, window_height: int) -> int:
    """What the words of every beat of the lesson take, on the grid."""
    told = _told(state.lesson, state.options)
    tall = _tall(told, _size(state, width, window_height), width)
    return int(min(-(-tall // GRID) * GRID, window_height // 3))


@lru_cache(maxsize=64)
def _told(lesson: Lesson, options: Options) -> tuple[Told, ...]:
    """Every beat of the lesson."""
    state = State(lesson, options=options)
    return tuple((said(state, b), b.formula, b.asks is not None) for b in lesson.beats)


def _size(state: State, width: int, window_height: int) -> float:
    """Of the caption's type: at a larger scale of the window larger, as far as there is room."""
    o = state.options
    usual = max(window_height * (LARGE if o.presenting else SMALL), 19.0) * THEMES[o.theme].type
    wished = usual * max(o.scale, 1.0)
    return _fitted(_told(state.lesson, o), usual, wished, width, window_height * ROOM) if wished > usual else usual


@lru_cache(maxsize=64)
def _fitted(told: tuple[Told, ...], usual: float, wished: float, width: float, room: float) -> float:
    """The largest size up to what is wished at which every beat has room; never less than the usual one."""
    sizes = [wished + k / STEPS * (usual - wished) for k in range(STEPS + 1)]
    return sizes[bisect_left(sizes[:-1], True, key=lambda size: _tall(told, size, width) <= room)]


def _tall(told: tuple[Told, ...], size: float, width: float) -> float:
    """What the tallest of the beats takes; the first one, and questions, have a hint below them."""
    heights = [
        _laid(text, formula, size, width)[1] + (HINT_ROOM * size if asks or k == 0 else 0.0)
        for k, (text, formula, asks) in enumerate(told)
    ]
    return max(heights) + 1.1 * size


@lru_cache(maxsize=512)
def _laid(text: str, formula: str, size: float, width: float) -> tuple[tuple[Piece, ...], float]:
    """The type of a beat and the height it takes.

    The formula stands beside the caption where that leaves room for it in two lines, else below.
    """
    wide = measure(formula, size)[0] if formula else 0.0
    rows = wrapped(text, size, max(0.94 * width - wide - 1.6 * size, 12 * size))
    if formula and rows and len(rows) <= 2 and wide <= 0.4 * width:
        return _beside(rows, formula, size)
    return _below(wrapped(text, size, min(0.94 * width, 46 * size)), formula, size)


def _below(rows: tuple[str, ...], formula: str, size: float) -> tuple[tuple[Piece, ...], float]:
    tall = LINE * size * len(rows)
    found = tuple((row, 0.0, (0.98 + LINE * k) * size, "center") for k, row in enumerate(rows))
    if not formula:
        return found, tall
    _, ascent, descent = measure(formula, size)
    return (*found, (formula, 0.0, tall + ascent, "center")), tall + ascent + descent + 0.1 * size


def _beside(rows: tuple[str, ...], formula: str, size: float) -> tuple[tuple[Piece, ...], float]:
    wide, ascent, descent = measure(formula, size)
    block = max(measure(row, size)[0] for row in rows)
    left = -(block + 1.6 * size + wide) / 2
    tall = max(LINE * size * len(rows), ascent + descent)
    top = (tall - LINE * size * len(rows)) / 2
    found = tuple((row, left + block / 2, top + (0.98 + LINE * k) * size, "center") for k, row in enumerate(rows))
    base = found[0][2] if len(rows) == 1 else (tall + ascent - descent) / 2
    return (*found, (formula, left + block + 1.6 * size, base, "left")), max(tall, base + descent)

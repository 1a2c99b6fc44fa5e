"""The presenter's window: what the lecturer reads while the class sees the picture."""

from PySide6.QtCore import QElapsedTimer, Qt, QTime, QTimer
from PySide6.QtGui import QFont, QGuiApplication, QHideEvent, QPainter, QPaintEvent, QScreen, QShowEvent
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QPushButton, QScrollArea, QVBoxLayout, QWidget

from app.asking import is_open, spoken_truth
from app.draw.compose import said
from app.draw.primitives import Text
from app.draw.theme import THEMES
from app.draw.type import measure
from app.gui.brush import type_
from app.gui.furniture import throw_away
from app.gui.look import GRID, fine, px, type_face
from app.gui.parts import heading
from app.gui.session import Session
from app.gui.timeline import current
from app.state import State, at_stop, settle, stops
from lessons import all_lessons
from subdivision.words import phrase

TICK = 250
"""Milliseconds between looks at the clock."""

SIZE = 960, 600
"""Where there is no second screen to fill."""

FORMULA = 30.0
"""Pixels at 100 %."""


class Presenter(QWidget):
    """Caption, notes, what comes next, the step, the time of day and the time that has passed."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self._session = session
        self.setWindowTitle("Presenter")
        self.setAttribute(Qt.WidgetAttribute.WA_QuitOnClose, False)
        self.setAttribute(Qt.WidgetAttribute.WA_ShowWithoutActivating)
        self.setMinimumSize(480, 360)
        self.resize(*SIZE)
        self._since = QElapsedTimer()
        self._tick = QTimer(self, interval=TICK)
        self._tick.timeout.connect(self._show_time)
        self._outside = QVBoxLayout(self)
        self._outside.setContentsMargins(0, 0, 0, 0)
        self._build()

    def furnish(self) -> None:
        """The same on new paper; the clock goes on."""
        old = self._inside
        self._build()
        throw_away((old,))
        if self.isVisible():
            self._show_time()
            self.show_state(self._session.state)

    def _build(self) -> None:
        self._inside = QWidget()
        self._outside.addWidget(self._inside)
        self.lesson, self.step = _words(18, QFont.Weight.DemiBold), _words(18)
        self.caption, self.formula = _words(28, QFont.Weight.DemiBold), Formula()
        self.notes, self.following = _words(20), _words(20)
        self.clock, self.elapsed = _words(28), _words(28)
        self.again = QPushButton("Start again")
        self.again.setToolTip("Count the time from now")
        self.again.setAccessibleName("Count the time from now")
        self.again.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.again.clicked.connect(self.reset)
        self._lay_out()

    def _lay_out(self) -> None:
        column = QVBoxLayout(self._inside)
        column.setContentsMargins(px(4 * GRID), px(3 * GRID), px(4 * GRID), px(3 * GRID))
        column.setSpacing(px(GRID))
        top, bottom = QHBoxLayout(), QGridLayout()
        top.addWidget(self.lesson, 1)
        top.addWidget(self.step)
        reader = QScrollArea(widgetResizable=True)
        reader.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        reader.setAccessibleName("Notes")
        reader.setWidget(self.notes)
        for k, (name, value) in enumerate((("Time", self.clock), ("Elapsed", self.elapsed))):
            bottom.addWidget(heading(name), 0, k)
            bottom.addWidget(value, 1, k)
        bottom.addWidget(self.again, 1, 2)
        bottom.setColumnStretch(3, 1)
        bottom.setHorizontalSpacing(px(4 * GRID))
        column.addLayout(top)
        column.addSpacing(px(GRID))
        for part in (self.caption, self.formula):
            column.addWidget(part)
        column.addSpacing(px(2 * GRID))
        column.addWidget(heading("Notes"))
        column.addWidget(reader, 1)
        column.addWidget(heading("Next"))
        column.addWidget(self.following)
        column.addSpacing(px(2 * GRID))
        column.addLayout(bottom)

    def open(self, beside: QWidget) -> None:
        """On the other screen if there is one, all over it; else as a window."""
        if (screen := spare_screen(beside)) is not None:
            self.setGeometry(screen.availableGeometry())
            self.showMaximized()
        else:
            self.showNormal()
        self.raise_()

    def reset(self) -> None:
        """The time that has passed is none."""
        self._since.start()
        self._show_time()

    def show_state(self, state: State) -> None:
        if not self.isVisible():
            return
        now, total = step_of(state)
        self.lesson.setText(state.lesson.title)
        self.step.setText(f"Step {now} of {total}")
        self.caption.setText(said(state, state.now))
        self.formula.show_state(state)
        self.notes.setText(noted(state))
        self.following.setText(upcoming(state))

    def _show_time(self) -> None:
        self.clock.setText(QTime.currentTime().toString("HH:mm"))
        self.elapsed.setText(spoken_time(self._since.elapsed() // 1000))

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if not self._since.isValid():
            self._since.start()
        self._show_time()
        self._tick.start()
        self.show_state(self._session.state)

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        self._tick.stop()


class Formula(QWidget):
    """The formula of the step; no room where there is none."""

    def __init__(self) -> None:
        super().__init__()
        self._text = Text(0.0, 0.0, "", fine(FORMULA), (0.0, 0.0, 0.0))
        self.hide()

    def show_state(self, state: State) -> None:
        words = state.now.formula
        self.setVisible(bool(words))
        if words:
            size, edge = fine(FORMULA), px(2)
            _, ascent, descent = measure(words, size)
            self._text = Text(0.0, ascent + edge, words, size, THEMES[state.options.theme].ink)
            self.setFixedHeight(round(ascent + descent) + 2 * edge)
            self.setAccessibleName(words)
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        type_(painter, self._text)
        painter.end()


def spare_screen(window: QWidget) -> QScreen | None:
    """A screen that the window is not on."""
    return next((s for s in QGuiApplication.screens() if s is not window.screen()), None)


def step_of(state: State) -> tuple[int, int]:
    """The number of the step that is shown, or played; and how many there are."""
    there, places = settle(state), stops(state.lesson)
    return max(sum((s.beat, s.at) <= (there.beat, there.at) for s in places), 1), len(places)


def noted(state: State) -> str:
    """What may be said to the step, and what is not the lecture's own; at a question, the answer."""
    ours = f"Not in the lecture: {state.lesson.ours}" if state.lesson.ours else ""
    said_so_far = phrase("Predictions: {n}.", n=len(state.predicted)) if is_open(state) else ""
    return "\n\n".join(words for words in (spoken_truth(state), said_so_far, state.now.notes, ours) if words)


def upcoming(state: State) -> str:
    """What the next step says: its stage and its caption; at the end of a lesson, the next lesson."""
    there = settle(state)
    later = [s for s in stops(state.lesson) if (s.beat, s.at) > (there.beat, there.at)]
    if not later:
        return _next_lesson(state)
    then = at_stop(there, later[0])
    stage, words = current(then).name, said(then, then.now)
    return f"{stage.capitalize()}: {words}" if stage else words


def _next_lesson(state: State) -> str:
    every = all_lessons()
    here = next((k for k, lesson in enumerate(every) if lesson.id == state.lesson.id), len(every) - 1)
    return f"The lesson ends here. Next: {every[here + 1].title}" if here + 1 < len(every) else "The lesson ends here."


def spoken_time(seconds: int) -> str:
    """Minutes and seconds, with hours from the first one on."""
    minutes, hours = seconds // 60 % 60, seconds // 3600
    return f"{hours}:{minutes:02}:{seconds % 60:02}" if hours else f"{minutes}:{seconds % 60:02}"


def _words(size: float, weight: QFont.Weight = QFont.Weight.Normal) -> QLabel:
    label = QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText)
    label.setFont(type_face(size, weight))
    label.setAlignment(Qt.AlignmentFlag.AlignTop)
    return label

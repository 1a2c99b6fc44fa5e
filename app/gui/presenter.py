"""The presenter's window: what the lecturer reads while the class sees the picture."""

from PySide6.QtCore import QElapsedTimer, QSize, Qt, QTime, QTimer
from PySide6.QtGui import QFont, QGuiApplication, QHideEvent, QPainter, QPaintEvent, QResizeEvent, QScreen, QShowEvent
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QPushButton, QScrollArea, QVBoxLayout, QWidget

from app.asking import is_open, spoken_truth
from app.draw.compose import said
from app.draw.primitives import Text
from app.draw.theme import THEMES
from app.draw.type import measure
from app.gui.brush import type_
from app.gui.furniture import throw_away
from app.gui.look import GRID, fine, px, type_face
from app.gui.parts import column, gap, heading, scrolled
from app.gui.preview import Preview
from app.gui.session import Session
from app.gui.timeline import current
from app.state import State, at_stop, settle, stops
from app.words import headed, tr
from lessons import all_lessons
from subdivision.words import phrase

TICK = 250
"""Milliseconds between looks at the clock."""

SIZE = 960, 600
"""Where there is no second screen to fill; pixels at 100 %."""

FORMULA = 30.0
"""Pixels at 100 %."""

PART = 0.42
"""Of the window's width, and of its height: so large may the picture of what comes next be."""


class Presenter(QWidget):
    """Caption, notes, what comes next, the step, the time of day and the time that has passed."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self._session = session
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
        self.setWindowTitle(tr("Presenter"))
        self._inside = QWidget()
        self._outside.addWidget(self._inside)
        self.lesson, self.step = _words(18, QFont.Weight.DemiBold), _words(18)
        self.caption, self.formula = _words(28, QFont.Weight.DemiBold), Formula()
        self.notes, self.following, self.preview = _words(20), _words(20), Preview(self._session)
        self.clock, self.elapsed = _words(28), _words(28)
        self.again = QPushButton(tr("Start again"))
        self.again.setFont(type_face(14))
        self.again.setToolTip(tr("Count the time from now"))
        self.again.setAccessibleName(tr("Count the time from now"))
        self.again.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.again.clicked.connect(self.reset)
        self._lay_out()

    def _lay_out(self) -> None:
        page = QVBoxLayout(self._inside)
        page.setContentsMargins(px(4 * GRID), px(2 * GRID), px(4 * GRID), px(2 * GRID))
        page.setSpacing(px(GRID))
        top, bottom = QHBoxLayout(), QHBoxLayout()
        top.addWidget(self.lesson, 1)
        top.addWidget(self.step)
        reader = QScrollArea(widgetResizable=True)
        reader.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        reader.setAccessibleName(tr("Notes"))
        reader.setWidget(self.notes)
        reader.setMinimumHeight(px(10 * GRID))
        now = _spaced(self.caption, self.formula, gap(px(GRID)), heading("Notes"), reader, stretched=reader)
        below, self._times = QVBoxLayout(), self._lay_out_times()
        below.addWidget(heading("Next"))
        below.addWidget(scrolled(self.following), 1)
        below.addSpacing(px(GRID))
        below.addLayout(self._times)
        bottom.addLayout(below, 1)
        bottom.addSpacing(px(3 * GRID))
        bottom.addWidget(self.preview, 0, Qt.AlignmentFlag.AlignBottom)
        page.addLayout(top)
        page.addSpacing(px(GRID))
        page.addWidget(scrolled(now), 1)
        page.addSpacing(px(GRID))
        page.addLayout(bottom)
        self._fit()

    def _lay_out_times(self) -> QGridLayout:
        times = QGridLayout()
        for k, (name, value) in enumerate((("Time", self.clock), ("Elapsed", self.elapsed))):
            value.setWordWrap(False)
            times.addWidget(heading(name), 0, k)
            times.addWidget(value, 1, k)
        times.addWidget(self.again, 1, 2)
        times.setColumnStretch(3, 1)
        times.setHorizontalSpacing(px(3 * GRID))
        return times

    def _fit(self) -> None:
        """What comes next is as large as it leaves room for the words and the times."""
        room = self.width() - px(11 * GRID) - self._times.sizeHint().width()
        self.preview.fit(min(round(self.width() * PART), room), round(self.height() * PART))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def open(self, beside: QWidget) -> None:
        """On the other screen if there is one, all over it; else as a window."""
        if (screen := spare_screen(beside)) is not None:
            self.setGeometry(screen.availableGeometry())
            self.showMaximized()
        else:
            wished = QSize(px(SIZE[0]), px(SIZE[1])).boundedTo(beside.screen().availableSize())
            self.resize(self.size().expandedTo(wished))
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
        self.lesson.setText(tr(state.lesson.title))
        self.step.setText(tr(phrase("Step {now} of {total}", now=now, total=total)))
        self.caption.setText(said(state, state.now))
        self.formula.show_state(state)
        self.notes.setText(noted(state))
        self.following.setText(announced(state))
        self.preview.show_state(state)

    def _show_time(self) -> None:
        self.clock.setText(QTime.currentTime().toString("HH:mm"))
        self.elapsed.setText(spoken_time(self._since.elapsed() // 1000))
        self._fit()

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
            self.setFixedHeight(round(ascent + descent) + px(4))
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
    ours = phrase("Not in the lecture: {remark}", remark=state.lesson.ours) if state.lesson.ours else ""
    said_so_far = phrase("Predictions: {n}.", n=len(state.predicted)) if is_open(state) else ""
    return "\n\n".join(tr(words) for words in (spoken_truth(state), said_so_far, state.now.notes, ours) if words)


def announced(state: State) -> str:
    """What the next step says: its stage and its caption; at the end of a lesson, the next lesson."""
    there = settle(state)
    later = [s for s in stops(state.lesson) if (s.beat, s.at) > (there.beat, there.at)]
    if not later:
        return _next_lesson(state)
    then = at_stop(there, later[0])
    stage, words = headed(tr(current(then).name)), said(then, then.now)
    return words if words.startswith(stage) else f"{stage}: {words}"


def _next_lesson(state: State) -> str:
    every = all_lessons()
    here = next((k for k, lesson in enumerate(every) if lesson.id == state.lesson.id), len(every) - 1)
    if here + 1 == len(every):
        return tr("The lesson ends here.")
    return tr(phrase("The lesson ends here. Next: {title}", title=every[here + 1].title))


def spoken_time(seconds: int) -> str:
    """Minutes and seconds, with hours from the first one on."""
    minutes, hours = seconds // 60 % 60, seconds // 3600
    return f"{hours}:{minutes:02}:{seconds % 60:02}" if hours else f"{minutes}:{seconds % 60:02}"


def _spaced(*parts: QWidget, stretched: QWidget) -> QWidget:
    """A column with the spaces of a page."""
    found = column(*parts, stretched=stretched)
    found.layout().setSpacing(px(GRID))  # type: ignore[union-attr]
    return found


def _words(size: float, weight: QFont.Weight = QFont.Weight.Normal) -> QLabel:
    label = QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText)
    label.setFont(type_face(size, weight))
    label.setAlignment(Qt.AlignmentFlag.AlignTop)
    return label

"""A strip in the window for what went wrong or takes a while; it is never in the way of the keys."""

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QPushButton, QSizePolicy, QWidget

from app.draw.theme import THEMES, mixed
from app.gui.furniture import throw_away
from app.gui.look import GRID, chosen_of, colour, icon, px
from app.gui.session import Session
from app.gui.timeline import tool_button
from app.state import State
from app.words import tr
from subdivision import Role


class Banner(QWidget):
    """One message at a time, the newest."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self._session = session
        self._is_fault, self._said_in = False, session.state.lesson
        self._on_cancel: Callable[[], None] = self.hide
        self._on_accept: Callable[[], None] = self.hide
        self._row = QHBoxLayout(self)
        self._build()
        self.hide()

    def _build(self) -> None:
        self.words = QLabel(wordWrap=True, textFormat=Qt.TextFormat.PlainText)  # names of files are no markup
        self.words.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.words.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.words.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self._busy = QProgressBar(minimum=0, maximum=0, textVisible=False)
        self._busy.setFixedWidth(px(96))
        self._cancel = QPushButton(tr("Cancel"))
        self._cancel.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self._cancel.clicked.connect(self._cancelled)
        self.accept = QPushButton()
        self.accept.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.accept.clicked.connect(self._accepted)
        self._close = tool_button("close", self._session.state.options.theme)
        self._close.setToolTip(tr("Close this message (Esc)"))
        self._close.setAccessibleName(tr("Close this message"))
        self._close.clicked.connect(self.hide)
        self._row.setContentsMargins(px(2 * GRID), px(GRID), px(GRID), px(GRID))
        self._row.setSpacing(px(2 * GRID))
        for each in self._parts():
            self._row.addWidget(each)

    def _parts(self) -> tuple[QWidget, ...]:
        return self.words, self._busy, self.accept, self._cancel, self._close

    def furnish(self) -> None:
        """The same message on a new strip."""
        words, busy, accept = self.words, self._busy, self.accept
        parts = self._parts()
        hidden = [each.isHidden() for each in parts]
        self._build()
        self.words.setText(words.text())
        self._busy.setRange(busy.minimum(), busy.maximum())
        self._busy.setValue(busy.value())
        self.accept.setText(accept.text())
        for each, is_hidden in zip(self._parts(), hidden, strict=True):
            each.setHidden(is_hidden)
        throw_away(parts)

    def show_state(self, state: State) -> None:
        """A message goes when the lesson it was said in goes; what is still under way or offered stays."""
        if state.lesson is not self._said_in and self._busy.isHidden() and self.accept.isHidden():
            self.hide()
        if not self.isHidden():
            self._close.setIcon(icon("close", state.options.theme))

    def say(self, sentence: str) -> None:
        """Something went wrong, or is worth knowing."""
        self._set(sentence, is_fault=True, is_busy=False)

    def tell(self, sentence: str) -> None:
        """Something went well."""
        self._set(sentence, is_fault=False, is_busy=False)

    def offer(self, sentence: str, name: str, on_accept: Callable[[], None]) -> None:
        """Something that a button would do."""
        self._on_accept = on_accept
        self.accept.setText(tr(name))
        self._set(sentence, is_fault=False, is_busy=False, is_offer=True)

    def wait(self, sentence: str, on_cancel: Callable[[], None]) -> None:
        """Something takes a while."""
        self._on_cancel = on_cancel
        self._busy.setRange(0, 0)
        self._set(sentence, is_fault=False, is_busy=True)

    def progress(self, part: float, sentence: str) -> None:
        """How much of what takes a while is done, 0..1; it stays away where it was put away."""
        if not self.isHidden() and not self._busy.isHidden():
            self._busy.setRange(0, 1000)
            self._busy.setValue(round(1000 * part))
            self.words.setText(tr(sentence))

    def done(self) -> None:
        """What took a while is over."""
        if not self._busy.isHidden():
            self.hide()

    def _set(self, sentence: str, *, is_fault: bool, is_busy: bool, is_offer: bool = False) -> None:
        self._is_fault, self._said_in = is_fault, self._session.state.lesson
        self.words.setText(tr(sentence))
        self.setAccessibleName(tr(sentence))
        self._close.setIcon(icon("close", self._session.state.options.theme))
        self._busy.setVisible(is_busy)
        self._cancel.setVisible(is_busy)
        self.accept.setVisible(is_offer)
        self._close.setVisible(not is_busy)
        self.show()

    def _accepted(self) -> None:
        self.hide()
        self._on_accept()

    def _cancelled(self) -> None:
        self.hide()
        self._on_cancel()

    def paintEvent(self, event: QPaintEvent) -> None:
        theme = THEMES[self._session.state.options.theme]
        vermilion = theme.roles[Role.FACE]
        painter = QPainter(self)
        ground = mixed(theme.panel, vermilion, 0.16) if self._is_fault else chosen_of(theme)
        painter.fillRect(self.rect(), colour(ground))
        painter.fillRect(0, 0, px(4), self.height(), colour(vermilion if self._is_fault else theme.accent))
        painter.end()

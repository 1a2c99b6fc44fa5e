"""The lessons, section by section, with a box to search them."""

from collections.abc import Iterable, Mapping

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRect, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetrics, QKeyEvent, QPainter, QPen, QStandardItem, QStandardItemModel
from PySide6.QtWidgets import (
    QLineEdit,
    QListView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from app.draw.theme import THEMES
from app.gui.look import GRID, chosen_of, colour, fine, icon, px, tint_of, type_face
from app.gui.session import Session
from app.laboratory.bench import enter
from app.laboratory.lab import LABORATORY, SECTION
from app.state import State, open_lesson
from app.words import tr
from lessons.script import OWN, Lesson
from subdivision import Role

LESSON = Qt.ItemDataRole.UserRole + 1
RIGHT = Qt.AlignmentFlag.AlignRight
FAULT = Qt.ItemDataRole.UserRole + 2
"""What is wrong with the file of a lesson; empty where the version shown is the file's."""

BENCH = Lesson(LABORATORY, "Your own object", SECTION, lambda: iter(()))
"""The row of the laboratory, whatever is on its table."""


NARROWEST = 86
"""Of the search box, in pixels at 100 %: it is no wider with the button that clears it, which comes and goes."""


class Contents(QWidget):
    """Arrow keys choose, Enter or a click opens; the search box filters as one types.

    ``found`` tells that a search has ended with a lesson.
    """

    found = Signal()
    asked = Signal(str)
    """What is wrong with a file was asked for."""

    def __init__(self, session: Session, lessons: Iterable[Lesson]) -> None:
        super().__init__()
        self._session = session
        self._shown: State | None = None
        self.search = QLineEdit(placeholderText=tr("Search   Ctrl+K"), clearButtonEnabled=True)
        self.search.setMinimumWidth(px(NARROWEST))
        self.search.setAccessibleName(tr("Search the lessons"))
        self.search.textChanged.connect(self._filter)
        self.search.returnPressed.connect(self._open_first)
        self._model = QStandardItemModel(self)
        self.list = _List()
        self.list.setModel(self._model)
        self.list.setItemDelegate(_Painter(session, self.list))
        self.list.activated.connect(self._open)
        self.list.clicked.connect(self._open)
        self.search.installEventFilter(self)
        column = QVBoxLayout(self)
        column.setContentsMargins(px(GRID), px(GRID), px(GRID), 0)
        column.setSpacing(px(GRID))
        column.addWidget(self.search)
        column.addWidget(self.list, 1)
        self._faults: Mapping[str, str] = {}
        self._lessons = [*lessons, BENCH]
        self._fill()

    def offer(self, lessons: Iterable[Lesson], faults: Mapping[str, str], lost: Mapping[str, str]) -> None:
        """List these lessons from now on.

        ``faults`` says of some, by id, what is wrong with their file now; ``lost`` of files, by name, that never were
        well enough to have a lesson.
        """
        self._faults = {**faults, **lost}
        files = (Lesson(name, name, OWN, lambda: iter(())) for name in lost)
        self._lessons = [*lessons, *files, BENCH]
        self._fill()
        self.show_state(self._session.state)
        self.list.setCurrentIndex(self._index_of(self._session.state.lesson))

    def show_state(self, state: State) -> None:
        if state.lesson.id not in {each.id for each in self._lessons}:
            self._lessons.append(state.lesson)
            self._fill()
        was = self._shown
        if was is None or was.lesson.id != state.lesson.id:
            self.list.setCurrentIndex(self._index_of(state.lesson))
            for lesson in (state.lesson, was.lesson if was is not None else state.lesson):
                self.list.update(self._index_of(lesson))
        if was is None or was.options.theme != state.options.theme:
            self._dress(state.options.theme)
        self._shown = state

    def inherit(self, before: "Contents") -> None:
        """Take over what is searched for, and lessons from elsewhere."""
        self._faults, self._lessons = before._faults, before._lessons
        self._fill()
        self.list.setCurrentIndex(self._index_of(self._session.state.lesson))
        self.search.setText(before.search.text())

    def _dress(self, theme: str) -> None:
        for action in self.search.actions():
            self.search.removeAction(action)
        self.search.addAction(icon("search", theme), QLineEdit.ActionPosition.LeadingPosition)

    def _fill(self) -> None:
        self._model.clear()
        section = ""
        for each in sorted(self._lessons, key=lambda lesson: lesson.section):
            if each.section != section:
                section = each.section
                heading = QStandardItem(tr(section))
                heading.setFlags(Qt.ItemFlag.NoItemFlags)
                self._model.appendRow(heading)
            row = QStandardItem(tr(each.title))
            row.setEditable(False)
            row.setData(self._faults.get(each.id, ""), FAULT)
            row.setToolTip(tr(self._faults.get(each.id) or each.title))
            row.setData(each, LESSON)
            self._model.appendRow(row)
        self._filter(self.search.text())

    def _filter(self, text: str) -> None:
        """Hide what does not hold every word typed, and headings of nothing."""
        words = text.lower().split()
        heading, has_any = -1, False
        for k in range(self._model.rowCount()):
            lesson = self._model.item(k).data(LESSON)
            if lesson is None:
                if heading >= 0:
                    self.list.setRowHidden(heading, not has_any)
                heading, has_any = k, False
                continue
            hit = all(w in f"{lesson.title} {lesson.section} {lesson.id}".lower() for w in words)
            self.list.setRowHidden(k, not hit)
            has_any = has_any or hit
        if heading >= 0:
            self.list.setRowHidden(heading, not has_any)
        if not words:
            self.list.scrollTo(self.list.currentIndex())
        self.list.empty = "No lesson has these words in its title." if self._first_visible() is None else ""
        self.list.viewport().update()

    def _first_visible(self) -> QModelIndex | None:
        for k in range(self._model.rowCount()):
            if self._model.item(k).data(LESSON) is not None and not self.list.isRowHidden(k):
                return self._model.index(k, 0)
        return None

    def _index_of(self, lesson: Lesson) -> QModelIndex:
        listed = [self._model.item(k).data(LESSON) for k in range(self._model.rowCount())]
        rows = (k for k, each in enumerate(listed) if each is not None and each.id == lesson.id)
        return self._model.index(next(rows, -1), 0)

    def _open_first(self) -> None:
        chosen = self.list.currentIndex()
        if not chosen.isValid() or self.list.isRowHidden(chosen.row()):
            chosen = self._first_visible() or QModelIndex()
        self._open(chosen)
        if chosen.isValid():
            self.found.emit()

    def _open(self, index: QModelIndex) -> None:
        lesson = index.data(LESSON)
        if lesson is None or lesson.id == self._session.state.lesson.id:
            return
        if lesson is BENCH:
            self._session.do(enter)
        elif lesson.id in self._faults and not lesson.beats:
            self.asked.emit(self._faults[lesson.id])
        else:
            self._session.do(open_lesson, lesson)

    def eventFilter(self, watched: object, event: object) -> bool:
        """Up and Down in the search box go to the list."""
        if not isinstance(event, QKeyEvent) or event.type() != QKeyEvent.Type.KeyPress:
            return False
        if event.key() not in (Qt.Key.Key_Down, Qt.Key.Key_Up):
            return False
        self.list.setFocus(Qt.FocusReason.TabFocusReason)
        self.list.keyPressEvent(event)
        return True


class _List(QListView):
    """A quiet list with something to say when it is empty."""

    def __init__(self) -> None:
        super().__init__()
        self.empty = ""
        self.setAccessibleName(tr("Lessons"))
        self.setMouseTracking(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollMode(QListView.ScrollMode.ScrollPerPixel)

    def paintEvent(self, event: object) -> None:
        super().paintEvent(event)  # type: ignore[arg-type]
        if self.empty:
            painter = QPainter(self.viewport())
            where = self.viewport().rect().adjusted(px(GRID), px(GRID), -px(GRID), 0)
            painter.drawText(where, Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextWordWrap, self.empty)
            painter.end()


class _Painter(QStyledItemDelegate):
    """Headings in small capitals' weight; the open lesson with a bar before it."""

    def __init__(self, session: Session, parent: QWidget) -> None:
        super().__init__(parent)
        self._session = session

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        if index.data(LESSON) is None:
            return QSize(px(10), px(4 * GRID) if index.row() else px(3 * GRID))
        return QSize(px(10), px(4 * GRID))

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        state = self._session.state
        theme = THEMES[state.options.theme]
        box: QRect = option.rect  # type: ignore[attr-defined]
        lesson = index.data(LESSON)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if lesson is None:
            painter.setFont(type_face(12, QFont.Weight.DemiBold))
            painter.setPen(colour(theme.muted))
            where = Qt.AlignmentFlag.AlignBottom | Qt.AlignmentFlag.AlignLeft
            painter.drawText(box.adjusted(px(GRID), 0, 0, -px(4)), where, str(index.data()))
            painter.restore()
            return
        is_open = lesson.id == state.lesson.id
        flags = option.state  # type: ignore[attr-defined]
        if is_open or flags & QStyle.StateFlag.State_MouseOver:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(colour(chosen_of(theme) if is_open else tint_of(theme)))
            painter.drawRoundedRect(box.adjusted(0, px(1), 0, -px(1)), fine(6), fine(6))
        if is_open:
            painter.setBrush(colour(theme.accent))
            bar = QRect(box.left(), box.top() + px(8), px(3), box.height() - 2 * px(8))
            painter.drawRoundedRect(bar, fine(1.5), fine(1.5))
        if flags & QStyle.StateFlag.State_HasFocus:
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(colour(theme.accent), fine(1)))
            painter.drawRoundedRect(box.adjusted(px(1), px(2), -px(1), -px(2)), fine(6), fine(6))
        number, title = numbered(str(index.data()))
        ink, muted = colour(theme.ink), colour(theme.ink if is_open else theme.muted)
        if number:
            painter.setFont(type_face(13, QFont.Weight.Medium))
            painter.setPen(muted)
            place = QRect(box.left() + px(GRID), box.top(), px(3 * GRID - 2), box.height())
            painter.drawText(place, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, number)
        face = type_face(14, QFont.Weight.DemiBold if is_open else QFont.Weight.Normal)
        room = box.adjusted(px((4 if number else 1) * GRID), 0, -px(4), 0)
        room = room.adjusted(0, 0, -px(2 * GRID), 0) if index.data(FAULT) else room
        cut = QFontMetrics(face).elidedText(title, Qt.TextElideMode.ElideRight, room.width())
        painter.setFont(face)
        painter.setPen(ink)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, cut)
        if index.data(FAULT):
            painter.setFont(type_face(14, QFont.Weight.Bold))
            painter.setPen(colour(theme.roles[Role.FACE]))
            painter.drawText(box.adjusted(0, 0, -px(GRID), 0), Qt.AlignmentFlag.AlignVCenter | RIGHT, "!")
        painter.restore()


def numbered(title: str) -> tuple[str, str]:
    """The number of a figure or an exercise and the rest of its title: in a list of them the word says nothing."""
    head, _, rest = title.partition("  ")
    word, _, number = head.partition(" ")
    return (number, rest.strip()) if rest and word in (tr("Figure"), tr("Exercise")) else ("", title)

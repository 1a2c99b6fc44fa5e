"""The manual's window: its chapters on the left, one of them on the right, and a search through all of them."""

import html
import re
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QSettings, Qt, QUrl
from PySide6.QtGui import QDesktopServices, QKeyEvent, QTextCursor
from PySide6.QtWidgets import (
    QFileDialog,
    QHBoxLayout,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from app.draw.markup import code
from app.draw.theme import THEMES, Theme
from app.gui.banner import Banner
from app.gui.look import GRID, fine, px, type_face
from app.gui.session import Session
from app.gui.sheets import rows
from app.gui.worker import Worker
from app.manual.chapters import FOLDER, Chapter, chapters, written
from app.manual.page import write
from app.state import State
from app.words import tr
from subdivision.words import phrase

SIZE = 1080, 720
LEFT = 260
"""Width of the list of chapters, in pixels at 100 %."""

PATIENCE = "The manual is being put together…"
BROKEN = "The manual could not be put together; the log says why."
NOT_FOUND = "No chapter has all these words; try fewer, or another one."
TOO_LARGE = "There is no memory left for the manual; close something else and open it again."

WIDTHS = re.compile(r'width="(\d+)"')
PICTURE = re.compile(r"<p>(<img [^>]*>)</p>")
TAG = re.compile(r"<[^>]+>")


class Manual(QWidget):
    """Put together from lessons and docstrings when it is first opened, in another thread.

    ``keeps_plain_keys``: keys that scroll or type here do not step through the lesson behind.
    """

    keeps_plain_keys = True

    def __init__(self, session: Session, banner: Banner, settings: QSettings) -> None:
        super().__init__()
        self._session, self._settings, self._banner = session, settings, banner
        self._worker = Worker(self, banner)
        self.chapters: tuple[Chapter, ...] = ()
        self._looks: tuple[object, ...] = ()
        self.setAttribute(Qt.WidgetAttribute.WA_QuitOnClose, False)
        self.setWindowTitle(tr("Manual"))
        self.search, self.list, self.text = QLineEdit(), QListWidget(), QTextBrowser()
        self.save = QPushButton(tr("Save as one page…"))
        self._lay_out()
        self.resize(px(SIZE[0]), px(SIZE[1]))

    def _lay_out(self) -> None:
        self.search.setPlaceholderText(tr("Search the manual"))
        self.search.setAccessibleName(tr("Search the manual"))
        self.search.setClearButtonEnabled(True)
        self.search.textChanged.connect(self._narrow)
        self.search.returnPressed.connect(self.find_next)
        self.list.setAccessibleName(tr("Chapters"))
        self.list.setSpacing(px(3))
        self.list.currentItemChanged.connect(lambda now, _: self._show(now))
        self.text.setOpenLinks(False)
        self.text.setSearchPaths([str(FOLDER)])
        self.text.setAccessibleName(tr("Manual"))
        self.text.anchorClicked.connect(self.follow)
        self.save.setToolTip(tr("The whole manual as an HTML file for any browser, pictures inside"))
        self.save.clicked.connect(self._ask_where)
        left, both = QVBoxLayout(), QHBoxLayout(self)
        for part in (self.search, self.list, self.save):
            left.addWidget(part)
        left.setSpacing(px(GRID))
        both.setContentsMargins(px(GRID), px(GRID), px(GRID), px(GRID))
        both.setSpacing(px(GRID))
        both.addLayout(left)
        both.addWidget(self.text, 1)

    def open(self) -> None:
        """Show the manual; the first time it is made meanwhile."""
        self.show_state(self._session.state)
        self.show()
        self.raise_()
        self.activateWindow()
        self.search.setFocus()
        if not self.chapters:
            self.text.setPlainText(tr(PATIENCE))
            self._make(written, self._begun)

    def show_state(self, state: State) -> None:
        """In the theme, the scale and the language of the window."""
        o = state.options
        if (looks := (o.theme, o.scale, o.language)) == self._looks:
            return
        if self._looks and self._looks[2] != o.language:
            self.chapters = ()
            if self.isVisible():
                self.close()
        self._looks = looks
        self.setWindowTitle(tr("Manual"))
        self.text.setFont(type_face(15))
        self.list.setFont(type_face(14))
        self.list.setFixedWidth(px(LEFT))
        self.text.document().setDocumentMargin(fine(2 * GRID))
        self.text.document().setDefaultStyleSheet(style(THEMES[o.theme]))
        self._show(self.list.currentItem())

    def _make(self, work: Callable[[], tuple[Chapter, ...]], done: Callable[[tuple[Chapter, ...]], None]) -> None:
        self._worker.start(work, done, self._failed, waiting=tr(PATIENCE), too_large=tr(TOO_LARGE), broken=tr(BROKEN))

    def _begun(self, made: tuple[Chapter, ...]) -> None:
        """What stands in files can be read while the rest is told."""
        self._made(made)
        keys = rows()
        self._make(lambda: chapters(keys), self._made)

    def _made(self, made: tuple[Chapter, ...]) -> None:
        self.chapters = made
        self._narrow(self.search.text())

    def _failed(self, sentence: str) -> None:
        self.text.setPlainText(sentence)

    # -- reading --------------------------------------------------------------------------------

    def _show(self, item: QListWidgetItem | None) -> None:
        wanted = item.data(Qt.ItemDataRole.UserRole) if item is not None else ""
        if (chapter := next((c for c in self.chapters if c.id == wanted), None)) is not None:
            self.text.setHtml(fitted(chapter.html))
            self._mark()

    def go(self, id_: str) -> None:
        """To a chapter; or to what has that name in one."""
        for chapter in self.chapters:
            if chapter.id == id_ or f'id="{id_}"' in chapter.html:
                self.search.clear()
                row = self.chapters.index(chapter)
                self.list.setCurrentRow(row)
                if chapter.id != id_:
                    self.text.scrollToAnchor(id_)
                return

    def follow(self, url: QUrl) -> None:
        """A link inside the manual; another one in the browser."""
        if url.scheme() in ("http", "https"):
            QDesktopServices.openUrl(url)
        else:
            self.go(url.fragment())

    # -- searching ------------------------------------------------------------------------------

    def _narrow(self, wanted: str) -> None:
        """List the chapters in which all the words are."""
        here = self.list.currentItem()
        kept = here.data(Qt.ItemDataRole.UserRole) if here is not None else ""
        self.list.blockSignals(True)
        self.list.clear()
        for chapter in found_in(self.chapters, wanted):
            item = QListWidgetItem(chapter.title, self.list)
            item.setData(Qt.ItemDataRole.UserRole, chapter.id)
            if chapter.id == kept:
                self.list.setCurrentItem(item)
        self.list.blockSignals(False)
        if self.chapters and not self.list.count():
            self.text.setPlainText(tr(NOT_FOUND))
        if self.list.currentItem() is None and self.list.count():
            self.list.setCurrentRow(0)
        else:
            self._mark()

    def _mark(self) -> None:
        """Choose the first place in the chapter where the words are."""
        if wanted := self.search.text():
            self.text.moveCursor(QTextCursor.MoveOperation.Start)
            self._find(wanted)

    def _find(self, wanted: str) -> bool:
        """Choose the next place of the words, or of the longest if they do not stand together; whether there is one."""
        together = wanted.casefold() in self.text.toPlainText().casefold()
        return self.text.find(wanted if together else max(wanted.split(), key=len, default=wanted))

    def find_next(self) -> None:
        """The next place; after the last in a chapter, the first in the next one."""
        wanted = self.search.text()
        if wanted and not self._find(wanted) and self.list.count():
            self.list.setCurrentRow((self.list.currentRow() + 1) % self.list.count())
            self._mark()

    # -- taking away ----------------------------------------------------------------------------

    def _ask_where(self) -> None:
        folder = Path(str(self._settings.value("folder_exports", str(Path.home()))))
        suggested = str(folder / "subdivision-studio-manual.html")
        path, _ = QFileDialog.getSaveFileName(self, tr("Save the manual"), suggested, "HTML (*.html)")
        if path:
            self.save_to(Path(path))

    def save_to(self, path: Path) -> None:
        """The whole manual in one file."""
        try:
            write(path, self.chapters)
        except OSError as fault:
            said = phrase("The manual could not be written to {path}: {reason}.", path=path, reason=fault.strerror)
            self._banner.say(said)
        else:
            self._banner.tell(phrase("Saved {path}", path=path))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.close()
        else:
            super().keyPressEvent(event)


def fitted(text: str) -> str:
    """Pictures as wide as they are at the scale of the window, in lines as high as they are."""
    return WIDTHS.sub(lambda found: f'width="{px(int(found[1]))}"', PICTURE.sub(r"<div>\1</div>", text))


def found_in(chapters: tuple[Chapter, ...], wanted: str) -> tuple[Chapter, ...]:
    """The chapters that have all the words."""
    words = wanted.casefold().split()
    return tuple(each for each in chapters if all(word in _said(each).casefold() for word in words))


def style(theme: Theme) -> str:
    """Type and colours of the text."""
    accent, muted, panel = code(theme.accent), code(theme.muted), code(theme.panel)
    return (
        f"h1 {{ font-size: {px(28)}px; }} h2 {{ font-size: {px(19)}px; margin-top: {px(24)}px; }}"
        f"a {{ color: {accent}; text-decoration: none; }} i {{ color: {muted}; }}"
        f"p, li {{ line-height: 140%; }} pre {{ background-color: {panel}; }}"
        f"td, th {{ padding-right: {px(16)}px; }} th {{ text-align: left; }}"
    )


def _said(chapter: Chapter) -> str:
    return f"{chapter.title} {html.unescape(TAG.sub('', chapter.html))}"

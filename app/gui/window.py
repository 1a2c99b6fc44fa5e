"""The window: the picture in the middle, everything else round it."""

from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import QSettings, QSize, Qt, QTimer
from PySide6.QtGui import (
    QAction,
    QCloseEvent,
    QDragEnterEvent,
    QDropEvent,
    QGuiApplication,
    QImage,
    QKeySequence,
    QResizeEvent,
)
from PySide6.QtWidgets import (
    QAbstractScrollArea,
    QApplication,
    QFileDialog,
    QHBoxLayout,
    QLayout,
    QMainWindow,
    QMenuBar,
    QMessageBox,
    QSplitter,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

import lessons
from app.asking import toggle_asking
from app.draw.darkroom import Order
from app.draw.theme import THEMES
from app.export.wish import Wish
from app.gui import menus, saving
from app.gui.authoring import Authoring
from app.gui.autosave import Autosave
from app.gui.banner import Banner
from app.gui.contents import Contents
from app.gui.darkroom import Darkroom
from app.gui.details import Details
from app.gui.document import Document
from app.gui.editing import EDITS, SHARPNESS, Editing
from app.gui.export import ExportDialog, Exporter
from app.gui.furniture import enter_what_is_typed, scroll, scrolled, seat_of, sit_down, throw_away
from app.gui.keys import BY_ID, COMMANDS, KeyGuard, spelled_keys
from app.gui.knobs import Knobs
from app.gui.laboratory import Laboratory
from app.gui.look import GRID, SCALES, colour, dressing, fine, icon, line_of, px, rescale, system_theme
from app.gui.manual import Manual
from app.gui.notes import Notes
from app.gui.opening import Opener
from app.gui.parts import Section, column, polish
from app.gui.pieces import Furniture
from app.gui.presenter import Presenter, spare_screen
from app.gui.recorder import Recorder
from app.gui.session import Session
from app.gui.sheets import About, Keys
from app.gui.shown import Shown
from app.gui.spectrum import Spectrum
from app.gui.surface import Surface
from app.gui.timeline import Timeline, tool_button
from app.gui.tongue import speak_everywhere
from app.gui.turns import Turns, ended
from app.gui.viewport import Viewport
from app.gui.why import Why
from app.gui.worker import Worker
from app.laboratory import bench
from app.report import apart
from app.sessions.keeping import SUFFIX, named, taken_up
from app.sessions.link import followed, link
from app.sessions.opening import OPENABLE
from app.sessions.strict import KeepingError
from app.state import State, choose, pick
from app.words import SYSTEM, language, system_language, tr
from subdivision.words import phrase

NAME = "Subdivision Studio"
DRAWING = 500
"""Milliseconds in which a picture is usually drawn: only beyond that a wait is announced."""

WIDE = {"contents": 200, "details": 200}
"""Widths of the side panels, in pixels at 100 %."""

ROOMY = {"contents": 700, "details": 1100}
"""In a window narrower than this a panel waits behind its button; in pixels at 100 %."""


class Window(QMainWindow):
    """Builds the parts, hands them every state, and does what is not a change of state."""

    session: Session
    authoring: Authoring
    recorder: Recorder
    viewport: Viewport
    manual: Manual
    timeline: Timeline
    contents: Contents
    laboratory: Laboratory
    editing: Editing
    details: Details
    _furniture: Furniture
    _body: QWidget
    _sides: dict[str, QWidget]

    def __init__(self, session: Session, settings: QSettings) -> None:
        super().__init__()
        speak_everywhere(session.state.options.language)
        self.session, self.settings = session, settings
        self._scale, self._wide = session.state.options.scale, {name: float(wide) for name, wide in WIDE.items()}
        rescale(self._scale)
        ended(dressing(QApplication.instance(), THEMES[session.state.options.theme]))  # type: ignore[arg-type]
        self.document = Document(session, settings)
        self._entitle()
        self.setAcceptDrops(True)
        self.setMinimumSize(720, 480)
        self._theme = ""
        self._played: tuple[bool, str] | None = None
        self.actions_by_id = {c.id: self._action(c.id) for c in COMMANDS}
        self.viewport = Viewport(session)
        self.banner, self.presenter = Banner(session), Presenter(session)
        self.manual = Manual(session, self.banner, settings)
        self.worker = Worker(session, self.banner)
        self.darkroom = Darkroom()
        self.copier, self.saver = (Worker(session, self.banner, self.darkroom.pool) for _ in range(2))
        self._turns = Turns(self)
        self._build()
        new = ended(self._made())
        self._put_up(new)
        for section in new.sections:
            new.details.add(section, is_stretched=section is new.place)
        self.exporter, self._wish = Exporter(self, self.banner), Wish("pptx")
        self.opener = Opener(session, self.banner, self.opened)
        self.authoring = Authoring(self, Path(settings.fileName()).with_name("lessons.json"))
        self.recorder = Recorder(self)
        self.sheets = (Keys(session, self), About(session, self))
        self._guard = KeyGuard(self)
        self._guard.watch(True)
        self._restore()
        session.changed.connect(self.show_state)
        QGuiApplication.styleHints().colorSchemeChanged.connect(self._follow_system)
        self.show_state(session.state)
        self._turns.finish()
        self.viewport.setFocus()

    # -- showing --------------------------------------------------------------------------------

    def show_state(self, state: State) -> None:
        if self._turns.are_left:
            return  # the window changes its looks, and then shows the state of the moment
        if self._changes(state) is None:
            self._show(state)
        else:
            self._turns.begin(self._changing())

    def _show(self, state: State) -> None:
        with self._guard.away():
            for view in self._views:
                with apart():  # a panel that fails keeps no other from showing the state
                    view.show_state(state)
        self._act(state)
        if state.options.presenting != self._is_presenting:
            self._present(state.options.presenting)

    def _act(self, state: State) -> None:
        """What can be done, and what is on."""
        for id_, action in self.actions_by_id.items():
            if (on := BY_ID[id_].on) is not None:
                action.setChecked(on(state.options))
            if (when := BY_ID[id_].when) is not None:
                action.setEnabled(when(state))
        self.actions_by_id["undo"].setEnabled(self.session.can_undo)
        self.actions_by_id["redo"].setEnabled(self.session.can_redo)
        for id_, *_ in (*EDITS, *SHARPNESS):
            self.actions_by_id[id_].setEnabled(bench.is_open(state))
        self._star()
        playing = state.is_playing, state.options.theme
        if playing != self._played:
            self._played = playing
            self.actions_by_id["play"].setIcon(icon("pause" if state.is_playing else "play", state.options.theme))

    @property
    def is_changing(self) -> bool:
        """Whether the window changes its looks, which takes it some turns of its event loop."""
        return self._turns.are_left

    @contextmanager
    def _unseen(self) -> Iterator[None]:
        """The screen stays as it is until everything has changed."""
        windows, parts = (self, self.presenter, self.manual), [scrolled(area) for area in self._scrolled()]
        self._middle.setEnabled(False)  # the picture changes its size once, at the end
        for window in windows:
            window.setUpdatesEnabled(False)
        try:
            yield
        finally:
            for window in windows:
                window.setUpdatesEnabled(True)
            self._middle.setEnabled(True)
            self._middle.activate()
            for area, part in zip(self._scrolled(), parts, strict=True):
                scroll(area, part)

    def _scrolled(self) -> tuple[QAbstractScrollArea, ...]:
        """What can be scrolled round the picture."""
        return self.contents.list, self.details

    def _changes(self, state: State) -> Iterator[None] | None:
        """What must be done, step by step, before the window looks as the state wants it; None: nothing."""
        if state.options.language != language() or state.options.scale != self._scale:
            return self._furnishing()
        return self._dressed() if state.options.theme != self._theme else None

    def _changing(self) -> Iterator[None]:
        """Other words, another size, another theme; everything else is as it was."""
        while (changes := self._changes(self.session.state)) is not None:
            with self._unseen():
                yield from changes
                yield
                self._show(self.session.state)

    def _dressed(self) -> Iterator[None]:
        """Everything that there is in the theme, and at the scale, of the state."""
        self._theme = theme = self.session.state.options.theme
        yield from self._guard.spared(dressing(QApplication.instance(), THEMES[theme]))  # type: ignore[arg-type]
        yield
        for id_, action in self.actions_by_id.items():
            if name := BY_ID[id_].icon:
                action.setIcon(icon(name, theme))
        self._played = None
        line = colour(line_of(THEMES[theme])).name()
        for hairline in self._hairlines:
            hairline.setStyleSheet(f"background: {line}")
            hairline.setFixedHeight(px(1))

    def _note_widths(self) -> None:
        """How wide the hand has made the panels."""
        for (name, side), wide in zip(self._sides.items(), self._splitter.sizes()[::2], strict=True):
            if side.isVisible():
                self._wide[name] = wide / self._scale

    def _widen(self) -> None:
        """Each panel as wide as it was, at the scale of the window."""
        self._splitter.setHandleWidth(px(1))
        left, right = (px(self._wide[name]) for name in self._sides)
        taken = sum(px(self._wide[name]) for name, side in self._sides.items() if not side.isHidden())
        self._splitter.setSizes([left, max(self._splitter.width() - taken, 1), right])

    # -- commands -------------------------------------------------------------------------------

    def escape(self) -> None:
        """Close the topmost thing that is open."""
        state = self.session.state
        for open_ in (*self.sheets, self.banner):
            if open_.isVisible():
                open_.hide()
                return
        if state.options.blank:
            self.session.do(choose, blank=False)
        elif self.viewport.is_magnified:
            self.viewport.toggle_magnifier()
        elif state.options.presenting:
            self.toggle_presenting()
        elif self.presenter.isActiveWindow():
            self.presenter.close()
        elif self.contents.search.hasFocus():
            self.leave_search()
        elif state.picked is not None:
            self.session.do(pick, None)

    def toggle_presenting(self) -> None:
        is_on = not self.session.state.options.presenting
        self.session.do(choose, presenting=is_on, blank=False)

    def toggle_presenter(self) -> None:
        """Show or close the presenter's window."""
        if self.presenter.isVisible():
            self.presenter.close()
        else:
            self.presenter.open(self)

    def toggle_keys(self) -> None:
        self.sheets[1].hide()
        self.sheets[0].toggle()

    def toggle_about(self) -> None:
        self.sheets[0].hide()
        self.sheets[1].toggle()

    def toggle_panel(self, name: str) -> None:
        """Show or hide one of the side panels."""
        side = self._sides[name]
        side.setVisible(side.isHidden())
        self._wants[name] = not side.isHidden()
        self._widen()

    def find_lesson(self) -> None:
        self._sides["contents"].show()
        self.contents.search.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.contents.search.selectAll()

    def leave_search(self) -> None:
        """Give the keys back to the lesson."""
        self.contents.search.clear()
        self.viewport.setFocus()

    def choose_language(self, code: str) -> None:
        """A language, or the system's own from now on; the window remembers it."""
        self.settings.setValue("language", code)
        self.session.do(choose, language=system_language() if code == SYSTEM else code)

    def choose_theme(self, name: str) -> None:
        """A theme, or the system's own from now on."""
        self.settings.setValue("theme", name)
        self.session.do(choose, theme=system_theme() if name == "system" else name)

    def choose_scale(self, scale: float) -> None:
        """Everything larger or smaller; the window remembers it."""
        self.settings.setValue("scale", f"{scale:.0%}".removesuffix("%"))
        self.session.do(choose, scale=scale)

    def turn_scale(self, by: int) -> None:
        """The next larger or smaller size, if there is one."""
        k = SCALES.index(self.session.state.options.scale) + by
        if 0 <= k < len(SCALES):
            self.choose_scale(SCALES[k])

    def toggle_reduced_motion(self) -> None:
        """Let stages fade instead of moving, or move again; the window remembers it."""
        is_on = not self.session.state.options.reduced_motion
        self.settings.setValue("reduced_motion", "on" if is_on else "off")
        self.session.do(choose, reduced_motion=is_on)

    def toggle_asking(self) -> None:
        """Let lessons ask before they show, or not; the window remembers it."""
        self.settings.setValue("asking", "off" if self.session.state.options.asking else "on")
        self.session.do(toggle_asking)

    def choose_file(self) -> None:
        patterns = " ".join(f"*{suffix}" for suffix in OPENABLE)
        names = tr(phrase("Meshes and sessions ({patterns})", patterns=patterns))
        path, _ = QFileDialog.getOpenFileName(self, tr("Open a mesh or a session"), self._folder("meshes"), names)
        if path:
            self.settings.setValue("folder_meshes", str(Path(path).parent))
            self.open_file(path)

    def open_file(self, path: str) -> None:
        """Read a mesh or a session; what is open stays until that has worked."""
        self.opener.open(path)

    def open_recent(self, path: Path) -> None:
        """Open a file again, or say that it has gone."""
        if path.exists():
            self.open_file(str(path))
            return
        self.document.forget(path)
        gone = "{path} is no longer there, so it is no longer in the list; open it from where it is now."
        self.banner.say(phrase(gone, path=path))

    def opened(self, path: Path) -> None:
        """A file has been opened: a session stays open, a mesh is in the laboratory."""
        if path.suffix.lower() == SUFFIX:
            self.document.opened(path, self.session.state)
        else:
            self.document.remember(path)
        self._entitle()

    def save_session(self) -> None:
        """Save the session into its file; into a new one if it has none."""
        if self.document.path is None:
            self.save_session_as()
        else:
            self.save_session_to(self.document.path)

    def save_session_as(self) -> None:
        suggested = self.document.path or Path(self._folder("sessions")) / f"{self.session.state.lesson.id}{SUFFIX}"
        kind = tr(phrase("Sessions ({pattern})", pattern=f"*{SUFFIX}"))
        path, _ = QFileDialog.getSaveFileName(self, tr("Save the session"), str(suggested), kind)
        if not path:
            return
        self.settings.setValue("folder_sessions", str(Path(path).parent))
        if (whole := named(Path(path))) != Path(path) and whole.exists():
            there = "{name} is there already; choose it by its whole name to replace it."
            self.banner.say(phrase(there, name=whole.name))
        else:
            self.save_session_to(whole)

    def save_session_to(self, path: Path) -> None:
        """Keep what is open in a file, which is then the one that is open."""
        try:
            written = self.document.save(path)
        except KeepingError as fault:
            self.banner.say(str(fault))
        else:
            self.banner.tell(phrase("Saved {path}", path=written))
            self._entitle()

    def copy_link(self) -> None:
        """Put a link to what is open on the clipboard."""
        try:
            QGuiApplication.clipboard().setText(link(self.session.state))
        except KeepingError as fault:
            self.banner.say(str(fault))
        else:
            self.banner.tell("The link is on the clipboard: 'subdivision-studio LINK' or Ctrl+V opens just this.")

    def paste_link(self) -> None:
        """Open what the link on the clipboard stands for."""
        try:
            self.session.do(taken_up, followed(QGuiApplication.clipboard().text()))
        except KeepingError as fault:
            self.banner.say(str(fault))

    def offer_to_restore(self, autosave: Autosave) -> None:
        """Offer what a crash has left, if it has left anything."""
        if autosave.left is not None:
            sentence = "The program did not end properly last time."
            self.banner.offer(sentence, "Restore what was open", lambda: self._restore_left(autosave))

    def _restore_left(self, autosave: Autosave) -> None:
        try:
            self.session.do(autosave.restored())
        except KeepingError as fault:
            self.banner.say(str(fault))

    def save_picture(self) -> None:
        suggested = str(Path(self._folder("pictures")) / f"{self.session.state.lesson.id}.png")
        kinds = "PNG (*.png);;SVG (*.svg);;PDF (*.pdf)"
        self.darkroom.warm()
        path, _ = QFileDialog.getSaveFileName(self, tr("Save the picture"), suggested, kinds)
        if path:
            self.settings.setValue("folder_pictures", str(Path(path).parent))
            self.save_picture_to(path)

    def save_picture_to(self, path: str) -> None:
        """Write what the viewport shows, finer than on the screen."""
        try:
            whole = saving.named(Path(path))
        except saving.SavingError as fault:
            self.banner.say(str(fault))
            return
        kind = whole.suffix.lower().removeprefix(".")
        order = saving.ordered(self.viewport.picture(), kind, self.viewport.size())
        self._draw(self.saver, order, lambda data: saving.save(whole, data), self._saved)

    def _saved(self, path: Path) -> None:
        self.banner.tell(phrase("Saved {path}", path=path))

    def choose_export(self) -> None:
        """Ask what is to be taken away, and where to; then make it."""
        dialog = ExportDialog(self, self.session.state.options.theme, self._wish)
        if dialog.exec() == ExportDialog.DialogCode.Accepted:
            self._wish = dialog.wish
            if path := self._ask_where(self._wish):
                self.export_to(self._wish, path)

    def export_to(self, wish: Wish, path: Path) -> None:
        """Make what is wished for of what is open."""
        if (fault := self.authoring.fault_of(self.session.state.lesson)) is not None:
            self.banner.say(phrase("Nothing was exported: the lesson's file is broken. {fault}", fault=fault.sentence))
            return
        self.exporter.start(self.session.state, wish, wish.named(path), self.authoring.folder)

    def _ask_where(self, wish: Wish) -> Path | None:
        folder = Path(self._folder("exports"))
        if wish.is_folder:
            chosen = QFileDialog.getExistingDirectory(self, tr("Export into a folder"), str(folder))
        else:
            name = "lecture" if wish.of == "everything" else self.session.state.lesson.id
            kind = f"{tr(wish.kind.title)} (*{wish.kind.suffix})"
            suggested = str(folder / f"{name}{wish.kind.suffix}")
            chosen, _ = QFileDialog.getSaveFileName(self, tr("Export"), suggested, kind)
        if not chosen:
            return None
        self.settings.setValue("folder_exports", str(Path(chosen) if wish.is_folder else Path(chosen).parent))
        return Path(chosen)

    def choose_page(self) -> None:
        """Ask where to, then write the lesson as a page that plays by itself."""
        wish = Wish("html")
        if path := self._ask_where(wish):
            self.export_to(wish, path)

    def copy_picture(self) -> None:
        """Put what the viewport shows on the clipboard, finer than on the screen."""
        order = saving.ordered(self.viewport.picture(), "pixels", self.viewport.size())
        self._draw(self.copier, order, lambda pixels: saving.image(order, pixels), self._copied)

    def _copied(self, image: QImage) -> None:
        QGuiApplication.clipboard().setImage(image)
        self.banner.tell("The picture is on the clipboard.")

    def _draw(self, worker: Worker, order: Order, keep: Callable[[bytes], Any], then: Callable[[Any], None]) -> None:
        """Draw a picture and keep it, both elsewhere; and then do something here."""
        worker.start(
            lambda: keep(self.darkroom.draw(order)), then, self.banner.say,
            waiting="Drawing the picture …",
            too_large="There is not enough memory for this picture; make the window smaller.",
            broken="Something went wrong inside the program; the log has the details.",
            patience=DRAWING, stop=lambda: self.darkroom.stop(order),
        )  # fmt: skip

    def quit(self) -> None:
        self.close()

    def say(self, sentence: str) -> None:
        """Tell of something that went wrong, where the user looks."""
        self.banner.say(sentence)

    # -- building -------------------------------------------------------------------------------

    def _action(self, id_: str) -> QAction:
        command = BY_ID[id_]
        action = QAction(self)
        action.setShortcuts([QKeySequence(key) for key in command.keys])
        action.setShortcutContext(Qt.ShortcutContext.ApplicationShortcut)
        action.setAutoRepeat(command.repeats)
        action.setIconVisibleInMenu(False)
        action.setCheckable(command.on is not None)
        action.triggered.connect(lambda: command.does(self))
        self.addAction(action)
        return action

    def _button(self, id_: str, size: int = 32) -> QToolButton:
        button = tool_button(BY_ID[id_].icon, self.session.state.options.theme, size)
        button.setDefaultAction(self.actions_by_id[id_])
        button.setAccessibleName(tr(BY_ID[id_].name))
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        return button

    def _build(self) -> None:
        """What stays while the window stays: the picture, and places for the furniture round it."""
        self._is_presenting = False
        self._wants, self._has_room = dict.fromkeys(WIDE, True), dict.fromkeys(WIDE, True)
        self._hairlines: list[QWidget] = []
        self._foot = QWidget()
        self._under = QVBoxLayout(self._foot)
        self._under.setContentsMargins(0, 0, 0, 0)
        middle = column(self.banner, self.viewport, self._hairline(), self._foot, stretched=self.viewport)
        self._middle: QLayout = middle.layout()  # type: ignore[assignment]
        self._splitter = QSplitter(Qt.Orientation.Horizontal)
        for part in (QWidget(), middle, QWidget()):
            self._splitter.addWidget(part)
        self._splitter.setStretchFactor(1, 1)
        self._splitter.setChildrenCollapsible(False)
        self._splitter.splitterMoved.connect(self._note_widths)
        self._body = column(self._hairline(), self._splitter, stretched=self._splitter)
        self.setCentralWidget(self._body)

    def furnish(self) -> None:
        """Change the furniture for new at once."""
        self._turns.finish()
        with self._unseen():
            ended(self._furnishing())
            self._show(self.session.state)

    def _furnishing(self) -> Generator[None, None, None]:
        """Change the furniture for new, for other words or another size."""
        options = self.session.state.options
        speak_everywhere(options.language)
        if options.scale != self._scale:
            self._scale = options.scale
            rescale(self._scale)
            yield from self._dressed()  # what is made after it is dressed once
            yield
        new = yield from self._made()
        for view in new.views:
            yield
            with apart(), self._guard.away():
                view.show_state(self.session.state)
                polish(view)
        for step in self._changing_for(new):
            yield
            with self._guard.away():
                step()

    def _changing_for(self, new: Furniture) -> Iterator[Callable[[], None]]:
        """How the new furniture is put where the old was, with all that it inherits."""
        seat, before, old = None, self._furniture.heirs, list[QWidget]()

        def clear() -> None:
            nonlocal seat
            seat = seat_of(self._places(), QApplication.focusWidget())
            if seat is not None:
                enter_what_is_typed()

        def put() -> None:
            is_bare = self.timeline.isHidden(), self.menuBar().isHidden()
            old.extend(self._put_up(new))
            for part, is_hidden in zip((self.timeline, self.menuBar()), is_bare, strict=True):
                part.setHidden(is_hidden)

        def inherit() -> None:
            for part, was in zip(new.heirs, before, strict=True):
                part.inherit(was)
            throw_away(old)
            for sheet in self.sheets:
                sheet.update()
            self._make_room()

        yield clear
        yield put
        yield from (partial(new.details.add, each, is_stretched=each is new.place) for each in new.sections)
        yield from (each.furnish for each in (self.banner, self.presenter, self.viewport.narration))
        yield inherit
        yield lambda: sit_down(self._places(), seat)

    def _places(self) -> dict[str, QWidget]:
        """Everything that is made anew, piece by piece."""
        return {**self._sides, "foot": self._foot, "banner": self.banner, "presenter": self.presenter}

    def _made(self) -> Generator[None, None, Furniture]:
        """The panels and the timeline, made."""
        session = self.session
        timeline, contents = Timeline(session, self._button), Contents(session, lessons.all_lessons())
        contents.found.connect(self.leave_search)
        contents.asked.connect(self.banner.say)
        yield
        laboratory, editing = Laboratory(session, self.banner, self.worker), Editing(session, self.banner)
        spectrum, knobs, shown = Spectrum(session, laboratory.wish), Knobs(session), Shown(session)
        surface, why, notes = Surface(session), Why(session), Notes()
        yield
        place, tools = Section("Why is it here?", why, stretched=why), Section("Shown", shown)
        sections = laboratory, knobs, place, notes, editing, tools, Section("Surface shows", surface), spectrum
        return Furniture(
            timeline,
            contents,
            laboratory,
            editing,
            spectrum,
            knobs,
            shown,
            surface,
            why,
            notes,
            Details(),
            place,
            sections,
        )

    def _put_up(self, new: Furniture) -> list[QWidget]:
        """Put the panels, the timeline and new menus in their places; what was there before."""
        self._name_actions()
        self._furniture = new
        for name, piece in vars(new).items():  # each by its name
            setattr(self, name, piece)
        self._views = self.viewport, self.banner, *new.views, self.presenter, self.manual
        self._sides = {"contents": self.contents, "details": self.details}
        old: list[QWidget] = self._foot.findChildren(Timeline)
        for k, side in zip((0, 2), self._sides.values(), strict=True):
            old += [each for each in (self._splitter.replaceWidget(k, side),) if each is not None]
        self._under.addWidget(self.timeline)
        old += [corner for corner in (self.menuBar().cornerWidget(),) if corner is not None]
        self.setMenuBar(QMenuBar())
        menus.fill(self)
        self._put_up_corner()
        return old

    def _put_up_corner(self) -> None:
        corner = QWidget(self.menuBar())
        row = QHBoxLayout(corner)
        row.setContentsMargins(0, 0, px(GRID / 2), 0)
        row.setSpacing(0)
        for id_ in ("contents", "shown", "present"):
            row.addWidget(self._button(id_, 28))
        self.menuBar().setCornerWidget(corner)

    def _name_actions(self) -> None:
        for id_, action in self.actions_by_id.items():
            command = BY_ID[id_]
            keys = ", ".join(spelled_keys(command))
            action.setText(tr(command.name))
            action.setToolTip(f"{tr(command.name)} ({keys})" if keys else tr(command.name))

    def _hairline(self) -> QWidget:
        line = QWidget()
        self._hairlines.append(line)
        return line

    # -- the window itself ----------------------------------------------------------------------

    def _entitle(self) -> None:
        """The file's name in the title, with a star for what is not saved."""
        path = self.document.path
        self.setWindowTitle(f"{path.name}[*] – {NAME}" if path else NAME)
        self._star()

    def _star(self) -> None:
        if (is_modified := self.document.is_modified) != self.isWindowModified():  # Qt would write the title anew
            self.setWindowModified(is_modified)

    def _present(self, is_on: bool) -> None:
        """Nothing but the picture, on the whole screen; or everything as it was."""
        self._is_presenting = is_on
        if is_on:
            self._before = (self.windowState(), [side.isHidden() for side in self._sides.values()])
        was, hidden = self._before
        for side, was_hidden in zip(self._sides.values(), hidden, strict=True):
            side.setVisible(not is_on and not was_hidden)
        for part in (self.menuBar(), self.timeline, *self._hairlines):
            part.setVisible(not is_on)
        if is_on:
            self.viewport.setFocus()
            self.setWindowState(was | Qt.WindowState.WindowFullScreen)
            if spare_screen(self) is not None:
                self.presenter.open(self)
        else:
            self.presenter.close()
            self._widen()
            self.setWindowState(was)
        QTimer.singleShot(0, self._show_again)

    def _show_again(self) -> None:
        self.viewport.show_state(self.session.state)

    def _restore(self) -> None:
        """As large as last time, or as a lecture likes it; never larger than the screen."""
        geometry = self.settings.value("geometry")
        if geometry is None or not self.restoreGeometry(geometry):
            room = QGuiApplication.primaryScreen().availableSize()
            self.resize(QSize(1440, 900).boundedTo(room))
        for name, side in self._sides.items():
            kept = str(self.settings.value(f"{name}_width"))
            self._wide[name] = float(kept) if kept.isdecimal() else WIDE[name]
            side.setHidden(self.settings.value(name, "shown") == "hidden")
            self._wants[name] = not side.isHidden()
        self.details.restore(self.settings)

    def _make_room(self) -> None:
        """Panels that would leave too little of the picture wait behind their buttons, until there is room again."""
        if self._is_presenting:
            return
        for name, side in self._sides.items():
            if (has_room := self.width() >= fine(ROOMY[name])) != self._has_room[name]:
                side.setVisible(self._wants[name] and has_room)
                self._has_room[name] = has_room
        self._widen()

    def _keep(self) -> None:
        if self._is_presenting:
            return
        self.settings.setValue("geometry", self.saveGeometry())
        for name, wide in self._wide.items():
            self.settings.setValue(f"{name}_width", round(wide))
        for name, is_wanted in self._wants.items():
            self.settings.setValue(name, "shown" if is_wanted else "hidden")
        self.details.keep(self.settings)
        self.settings.sync()

    def _may_close(self) -> bool:
        """Whether the window may close, after asking what becomes of what is not saved."""
        answer = self.ask_to_save()
        if answer == QMessageBox.StandardButton.Save:
            self.save_session()
        is_done = answer == QMessageBox.StandardButton.Save and not self.document.is_modified
        return is_done or answer == QMessageBox.StandardButton.Discard

    def ask_to_save(self) -> QMessageBox.StandardButton:
        """Save, discard or cancel."""
        path, choices = self.document.path, QMessageBox.StandardButton
        question = tr(phrase("Save the changes to {name}?", name=path.name if path else NAME))
        return QMessageBox.question(self, NAME, question, choices.Save | choices.Discard | choices.Cancel)

    def _folder(self, kind: str) -> str:
        return str(self.settings.value(f"folder_{kind}", str(Path.home())))

    def language_choice(self) -> str:
        """The language as it was chosen: perhaps the system's."""
        return str(self.settings.value("language", SYSTEM))

    def theme_choice(self) -> str:
        """The theme as it was chosen: perhaps the system's."""
        return str(self.settings.value("theme", self._theme))

    def _follow_system(self) -> None:
        if self.theme_choice() == "system":
            self.session.do(choose, theme=system_theme())

    # -- Qt's own -------------------------------------------------------------------------------

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._make_room()
        for sheet in self.sheets:
            sheet.setGeometry(self.rect())

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        if any(Path(u.toLocalFile()).suffix.lower() in OPENABLE for u in event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        paths = [u.toLocalFile() for u in event.mimeData().urls()]
        self.open_file(next(p for p in paths if Path(p).suffix.lower() in OPENABLE))

    def closeEvent(self, event: QCloseEvent) -> None:
        if self.document.is_modified and not self._may_close():
            event.ignore()
            return
        self._turns.finish()
        self.session.stop()
        self.exporter.stop()
        self.authoring.stop()
        self.session.changed.disconnect(self.show_state)
        QGuiApplication.styleHints().colorSchemeChanged.disconnect(self._follow_system)
        self._guard.watch(False)
        self._keep()
        self.presenter.close()
        self.manual.close()
        self.viewport.close_vtk()
        self.copier.cancel()
        self.saver.forget()
        self.hide()
        self.darkroom.close()
        super().closeEvent(event)

"""What comes next as a small picture, drawn in another thread: it appears a moment later and nothing waits for it."""

from dataclasses import dataclass, fields, replace
from functools import partial

from PySide6.QtCore import QRectF, QSize, Qt, QTimer
from PySide6.QtGui import QImage, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QWidget

from app.draw.compose import compose
from app.draw.picture import Picture, Scene
from app.draw.theme import THEMES
from app.gui.chore import Chore
from app.gui.look import colour, line_of, px
from app.gui.session import Session
from app.state import State, choose, onward, settle
from app.words import tr

SHAPE = 16 / 9
"""Width to height."""

PAUSE = 200
"""Milliseconds without a change before the first picture is drawn."""

KEPT = 6
"""How many pictures are kept, for going on and back."""

FINEST = 40_000
"""Faces: to draw more of them takes a processor for seconds, and they would be smaller than a pixel."""


@dataclass(frozen=True, eq=False)
class Drawn:
    """What comes after a state, at a size in pixels; ``then`` None: nothing; ``image`` None: it is too fine."""

    state: State
    size: QSize
    then: State | None = None
    image: QImage | None = None


class Preview(QWidget):
    """The picture of the state that comes next; the one after it is got ready too."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self.setAccessibleName(tr("What comes next"))
        self._session = session
        self._state = _plain(settle(session.state))
        self._kept: list[Drawn] = []
        self._chore: Chore | None = None
        self._wanted = Drawn(self._state, QSize())
        self._pause = QTimer(self, singleShot=True, interval=PAUSE)
        self._pause.timeout.connect(self._draw)

    @property
    def image(self) -> QImage | None:
        """The picture, once it is there."""
        found = self._found(self._state)
        return found.image if found is not None else None

    def show_state(self, state: State) -> None:
        """Show what comes after a state."""
        here = _plain(settle(state))
        if not _are_same(here, self._state):
            self._state = here
            self.update()
        self._pause.start()

    def fit(self, width: int, height: int) -> None:
        """Be as large as there is room for."""
        wide = max(min(float(width), height * SHAPE), 1.0)
        self.setFixedSize(round(wide), round(wide / SHAPE))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._pause.start()

    def paintEvent(self, event: QPaintEvent) -> None:
        theme, place = THEMES[self._session.state.options.theme], self.rect()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.fillRect(place, colour(theme.background))
        found = self._found(self._state)
        if found is not None and found.image is not None:
            painter.drawImage(place, found.image)
        elif found is not None:
            painter.setPen(colour(theme.muted))
            words = "Nothing comes next" if found.then is None else "Too fine for a small picture"
            painter.drawText(place, Qt.AlignmentFlag.AlignCenter, tr(words))
        painter.setPen(QPen(colour(line_of(theme)), px(1)))
        painter.drawRect(QRectF(place).adjusted(0.5, 0.5, -0.5, -0.5))
        painter.end()

    def _pixels(self) -> QSize:
        finely = self.devicePixelRatioF()
        return QSize(round(finely * self.width()), round(finely * self.height()))

    def _found(self, state: State) -> Drawn | None:
        """What has been drawn after a state, at whichever size."""
        return next((each for each in reversed(self._kept) if _are_same(each.state, state)), None)

    def _draw(self) -> None:
        """Draw what is missing, one after the other, while nothing moves."""
        state = self._session.state
        if self._chore is not None or not self.isVisible():
            return
        if state.is_playing and not state.wait:
            self._pause.start()
            return
        if (missing := self._missing()) is not None:
            pixels = self._pixels()
            self._wanted = Drawn(missing, pixels)
            self._chore = Chore("preview", partial(drawn, missing, pixels), self._is_drawn)
            self._chore.begin()

    def _missing(self) -> State | None:
        """The state after which nothing is drawn yet: this one, or the next."""
        here = self._found(self._state)
        if here is None or here.size != self._pixels():
            return self._state
        there = self._found(here.then) if here.then is not None else None
        return here.then if there is None or there.size != self._pixels() else None

    def _is_drawn(self, made: object) -> None:
        self._chore = None
        drawn = made if isinstance(made, Drawn) else self._wanted  # the window itself tells why, when it comes to it
        self._kept = [*self._kept[1 - KEPT :], drawn]
        self.update()
        self._pause.start()


def drawn(state: State, size: QSize) -> Drawn:
    """The picture of what comes after a state, without its caption, by no OpenGL."""
    from app.draw import raster

    there = onward(state)
    if there is state:
        return Drawn(state, size)
    then = settle(there)
    picture = compose(then)
    if n_faces(picture) > FINEST:
        return Drawn(state, size, then)
    pixels = raster.image(picture, size.width(), size.height(), words=False, flat=True)
    height, width = pixels.shape[:2]
    image = QImage(pixels.tobytes(), width, height, 4 * width, QImage.Format.Format_RGBA8888).copy()
    return Drawn(state, size, then, image)


def n_faces(picture: Picture) -> int:
    """How many faces all its surfaces have."""
    scenes = (pane.content for pane in picture.panes if isinstance(pane.content, Scene))
    return sum(len(faces.sizes) for scene in scenes for faces in scene.faces)


def _plain(state: State) -> State:
    """Without what belongs to the moment."""
    return choose(replace(state, focus=None, picked=None), presenting=False, blank=False, speed=1.0, through=False)


def _are_same(one: State, other: State) -> bool:
    """Whether two states are drawn alike."""
    return all(getattr(one, each.name) == getattr(other, each.name) for each in fields(State))

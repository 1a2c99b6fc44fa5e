"""Opens a file: a mesh for the laboratory, or a session, read off the window's thread."""

from collections.abc import Callable
from pathlib import Path

from app.gui.banner import Banner
from app.gui.session import Session
from app.gui.worker import Worker
from app.sessions.opening import Opening, opening
from subdivision.words import phrase


class Opener(Worker):
    """One file at a time; a newer wish replaces an older one.  ``opened`` is told what has been opened."""

    def __init__(self, session: Session, banner: Banner, opened: Callable[[Path], None]) -> None:
        super().__init__(session, banner)
        self._session, self._opened = session, opened

    def open(self, path: str) -> None:
        file = Path(path)

        def done(found: Opening) -> None:
            self._session.do(found)
            self._opened(file)

        self.start(
            lambda: opening(file), done, self._banner.say,
            waiting=phrase("Reading {name} …", name=file.name),
            too_large=phrase("{name} is too large for this computer's memory.", name=file.name),
            broken=phrase("{name} could not be opened; the log has the details.", name=file.name),
        )  # fmt: skip

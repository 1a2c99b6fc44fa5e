"""The session in a file: which one is open, whether it has changed since, and what was open before."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QSettings

from app.gui.session import Session, is_same_picture
from app.sessions.keeping import write
from app.state import State

REMEMBERED = 8
"""How many files the menu offers again."""


class Document:
    """``path`` is None while no session is open."""

    def __init__(self, session: Session, settings: QSettings) -> None:
        self._session, self._settings = session, settings
        self.path: Path | None = None
        self._saved: State = session.state

    @property
    def is_modified(self) -> bool:
        """Whether saving would change the file."""
        return self.path is not None and not is_same_picture(self._saved, self._session.state)

    def rewrite(self, transition: Callable[..., State], *args: Any) -> None:
        """What the state in the file is told from has changed: it is still what was saved."""
        self._saved = transition(self._saved, *args)

    def save(self, path: Path) -> Path:
        """Keep the state in a file, and that file open.

        Raises
        ------
        KeepingError
            If it could not be written; what was open then stays open.
        """
        state = self._session.state
        self.opened(write(path, state), state)
        assert self.path is not None
        return self.path

    def opened(self, path: Path, state: State) -> None:
        """A file holds this state."""
        self.path, self._saved = path.absolute(), state
        self.remember(path)

    def recent(self) -> list[Path]:
        """The files that were open last, the newest first."""
        kept = str(self._settings.value("recent", "[]"))
        try:
            names = json.loads(kept)
        except ValueError:
            return []
        return [Path(name) for name in names if isinstance(name, str)] if isinstance(names, list) else []

    def remember(self, path: Path) -> None:
        """A session or a mesh that has been opened."""
        path = path.absolute()
        self._keep([path, *(each for each in self.recent() if each != path)][:REMEMBERED])

    def forget(self, path: Path) -> None:
        """A file that is no longer there."""
        self._keep([each for each in self.recent() if each != path])

    def _keep(self, paths: list[Path]) -> None:
        self._settings.setValue("recent", json.dumps([str(path) for path in paths]))

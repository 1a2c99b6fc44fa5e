"""A piece of work done in another thread, which nobody waits for: only that it is over is told."""

from collections.abc import Callable

from PySide6.QtCore import QObject, QThreadPool, Signal

from app.log import LOG


class _Told(QObject):
    over = Signal(object)


class Chore:
    """``work``; ``over`` is called with what comes of it, or with None where it fails, which the log says by ``name``.

    ``over`` is a method of a ``QObject``, so that it is called in that one's thread.
    """

    def __init__(self, name: str, work: Callable[[], object], over: Callable[[object], None]) -> None:
        self._name, self._work, self._told = name, work, _Told()
        self._told.over.connect(over)

    def begin(self) -> None:
        """Do it as soon as a thread is free; who begins it keeps it until it is over."""
        QThreadPool.globalInstance().start(self)  # not a ``QRunnable``, of which Qt's pool keeps every one for ever

    def __call__(self) -> None:
        made: object = None
        try:
            made = self._work()
        except Exception:
            LOG.exception(self._name)
        finally:
            self._told.over.emit(made)

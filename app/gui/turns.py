"""Work on the window's thread that would hold it up: a step in each turn of the event loop, and it answers between."""

from collections.abc import Generator, Iterator
from typing import TypeVar

from PySide6.QtCore import QObject, QTimer

Made = TypeVar("Made")

OVER = object()


class Turns(QObject):
    """Does the steps of one piece of work, the first at once."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._steps: Iterator[object] | None = None
        self._timer = QTimer(self, singleShot=True, interval=0)
        self._timer.timeout.connect(self._go_on)

    @property
    def are_left(self) -> bool:
        """Whether the work is not over."""
        return self._steps is not None

    def begin(self, steps: Iterator[object]) -> None:
        """Do these from now on."""
        self.finish()
        self._steps = steps
        self._go_on()

    def stop(self) -> None:
        """Leave undone what is left."""
        self._steps = None

    def finish(self) -> None:
        """Do all that is left at once."""
        while self.are_left:
            self._go_on()

    def _go_on(self) -> None:
        if self._steps is None:
            return
        is_over = True
        try:
            is_over = next(self._steps, OVER) is OVER
        finally:
            if is_over:  # or it has failed
                self._steps = None
        if not is_over:
            self._timer.start()


def ended(steps: Generator[object, None, Made]) -> Made:
    """What comes of steps that are all done at once."""
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value

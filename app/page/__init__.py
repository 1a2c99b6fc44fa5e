"""A lesson as one page of HTML that plays by itself: no network, nothing to install.

``record`` writes down what ``app.draw.compose`` shows at some instants of every stage; ``html`` packs that into a
page; the scripts beside them only interpolate between those instants, and draw.
"""

from collections.abc import Callable
from pathlib import Path

from app.figures import write
from app.page.html import page
from app.page.record import record
from app.state import State

__all__ = ["page_of", "write_page_of"]


def page_of(state: State, progress: Callable[[float], None] = lambda done: None) -> bytes:
    """The page of a state's lesson, with its knobs, its options and the control points as they were dragged."""
    return page(record(state, progress))


def write_page_of(state: State, path: Path) -> int:
    """Write the page of a state's lesson, whole or not at all; its size in bytes.

    Raises
    ------
    FigureError
        If it cannot be written there.
    """
    return write(path, page_of(state)).stat().st_size

"""A lesson as one page of HTML that plays by itself: no network, nothing to install.

``record`` writes down what ``app.draw.compose`` shows at some instants of every stage; ``html`` packs that into a
page; the scripts beside them only interpolate between those instants, and draw.
"""

from app.page.html import page
from app.page.record import record
from app.state import State

__all__ = ["page_of"]


def page_of(state: State) -> bytes:
    """The page of a state's lesson, with its knobs, its options and the control points as they were dragged."""
    return page(record(state))

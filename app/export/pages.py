"""Steps as a PDF, one a page: for slides, for print at any size."""

from collections.abc import Callable, Sequence

from app.draw.pdf import Paper
from app.draw.seen import seen
from app.figures import stood_on
from app.state import State
from app.words import tr


def pages(
    told: Sequence[Sequence[State]], size: tuple[int, int], background: str, progress: Callable[[float], None]
) -> bytes:
    """The bytes of the file; ``told`` has the steps of every lesson."""
    steps = [step for lesson in told for step in lesson]
    paper = Paper(tr(steps[0].lesson.title if len(told) == 1 else "Subdivision Curves and Surfaces"))
    width, height = size
    for k, step in enumerate(steps, 1):
        paper.turn(width, height)
        is_clear = background == "transparent"
        paper.picture(stood_on(seen(step), background), (0, 0, width, height), width, transparent=is_clear)
        progress(k / len(steps))
    return paper.done()

"""What a click says to a question: a place in space, a weight, or a picture."""

from collections.abc import Sequence

from PySide6.QtCore import QPointF

from app import asking
from app.draw.picture import Box, Camera
from app.draw.primitives import Area
from app.state import Prediction, State
from lessons.questions import Where, Which


def predicted(
    state: State, here: QPointF, areas: Sequence[Area], cameras: Sequence[Camera | None], part: Box | None
) -> Prediction | None:
    """The prediction that a click means; ``part`` is the box of a diagram under it.

    A place lies as far from the eye as the point will be, since nobody can point at a depth: its distance from the
    truth is what is seen between them.
    """
    question = state.now.asks
    pane = next((k for k, area in enumerate(areas) if _is_in(area, here)), -1)
    if part is not None and part.choice >= 0:
        return part.choice
    if isinstance(question, Which):
        return pane if pane >= 0 else None
    camera = cameras[pane] if pane >= 0 else None
    if not isinstance(question, Where) or pane != question.pane or camera is None:
        return None
    x, y, wide, tall = areas[pane]
    depth = float(camera.project(asking.place(state, question), wide, tall)[0, 2])
    at = camera.place(here.x() - x, here.y() - y, depth, wide, tall)
    return float(at[0]), float(at[1]), float(at[2])


def _is_in(area: Area, here: QPointF) -> bool:
    x, y, wide, tall = area
    return x <= here.x() < x + wide and y <= here.y() < y + tall

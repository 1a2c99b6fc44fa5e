"""Reduced motion: on the way through a stage nothing moves, the picture before fades into the one after.

The new comes over the old, then the old leaves: at any time one of them is whole, so that no surface is like glass.
"""

from dataclasses import replace
from math import ceil, floor
from typing import TypeVar

from app.draw.compose import compose
from app.draw.motion import eased
from app.draw.picture import Box, Diagram, Faces, Label, Lines, Link, Markers, Note, Picture, Scene, Squares
from app.state import State

Drawn = TypeVar("Drawn", Faces, Lines, Markers, Label, Box, Squares, Link, Note)


def faded(state: State, *, is_hasty: bool = False) -> Picture:
    """The picture of a state, ``is_hasty`` as in ``compose``; with reduced motion, between two stages, both theirs."""
    low, high = float(floor(state.at)), float(ceil(state.at))
    if not state.options.reduced_motion or low == high:
        return compose(state, is_hasty=is_hasty)
    before, after = compose(replace(state, at=low)), compose(replace(state, at=high))
    return crossed(before, after, eased(state.at - low))


def crossed(before: Picture, after: Picture, t: float) -> Picture:
    """``t`` (0..1) of the way from one picture to another of the same panes; words change half way."""
    left, come = min(2 * (1 - t), 1.0), min(2 * t, 1.0)
    leading = before if t < 0.5 else after
    contents = [_both(a.content, b.content, left, come) for a, b in zip(before.panes, after.panes, strict=True)]
    panes = tuple(replace(pane, content=each) for pane, each in zip(leading.panes, contents, strict=True))
    return replace(leading, panes=panes)


def _both(before: Scene | Diagram, after: Scene | Diagram, left: float, come: float) -> Scene | Diagram:
    """The parts of both; of diagrams with other cells, the one that is whole."""
    if isinstance(before, Scene) and isinstance(after, Scene):
        a, b = _pale_scene(before, left), _pale_scene(after, come)
        return replace(
            a if come < 1 else b,
            faces=a.faces + b.faces,
            lines=a.lines + b.lines,
            markers=a.markers + b.markers,
            labels=a.labels + b.labels,
        )
    if isinstance(before, Diagram) and isinstance(after, Diagram) and before.cells == after.cells:
        was, is_ = _pale_diagram(before, left), _pale_diagram(after, come)
        return replace(is_, boxes=was.boxes + is_.boxes, squares=was.squares + is_.squares,
                       links=was.links + is_.links, notes=was.notes + is_.notes)  # fmt: skip
    return before if come < 1 else after


def _pale_scene(scene: Scene, part: float) -> Scene:
    """What is left of a scene when a ``part`` of its opacity is."""
    return replace(
        scene,
        faces=_pale(scene.faces, part),
        lines=_pale(scene.lines, part),
        markers=_pale(scene.markers, part),
        labels=_pale(scene.labels, part),
    )


def _pale_diagram(diagram: Diagram, part: float) -> Diagram:
    return replace(
        diagram,
        boxes=_pale(diagram.boxes, part),
        squares=_pale(diagram.squares, part),
        links=_pale(diagram.links, part),
        notes=_pale(diagram.notes, part),
    )


def _pale(drawn: tuple[Drawn, ...], part: float) -> tuple[Drawn, ...]:
    return tuple(replace(each, opacity=part * each.opacity) for each in drawn)

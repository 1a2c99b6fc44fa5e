"""Every formula of the lessons into the table of those set beforehand: ``python -m tests.formulas``.

What is shown at each step and on the way there counts, and what boxes of diagrams say where they have more room.
"""

import json
from collections.abc import Iterator
from dataclasses import replace
from unittest import mock

import matplotlib

import lessons
from app.draw import formulas
from app.draw import type as type_
from app.draw.compose import compose
from app.draw.layout import overlay
from app.draw.picture import Diagram, Picture
from app.state import State, at_stop, start, stops

SIZE = 1920, 1080
WAY = 0.0, 0.9
"""How many stages before a step: at it, and when its boxes say what they said before."""


def shown() -> Iterator[State]:
    """Every lesson at each step, and on the way there."""
    for lesson in lessons.built_in():
        for stop in stops(lesson):
            there = at_stop(start(lesson), stop)
            yield from (replace(there, at=max(there.at - before, there.now.start)) for before in WAY)


def met() -> dict[str, formulas.Box]:
    """The formulas that are set for it."""
    found: dict[str, formulas.Box] = {}
    boxed = formulas.boxed

    def noted(text: str) -> formulas.Box:
        return found.setdefault(text, boxed(text))

    for known in (formulas.formula, type_._set):
        known.cache_clear()
    with mock.patch.object(formulas, "prepared", dict), mock.patch.object(formulas, "boxed", noted):
        for state in shown():
            type_.measure(state.now.formula, 1.0)
            picture = compose(state)
            overlay(picture, *SIZE)
            for text in in_boxes(picture):
                type_.measure(text, 1.0)
    return found


def in_boxes(picture: Picture) -> set[str]:
    """All that its diagrams may say, in windows of any size."""
    diagrams = (pane.content for pane in picture.panes if isinstance(pane.content, Diagram))
    return {line for each in diagrams for box in each.boxes for text in box.texts for line in text.splitlines()}


def main() -> None:
    rows = sorted(f"{text}\t{json.dumps(box, separators=(',', ':'))}\n" for text, box in met().items())
    formulas.TABLE.write_text(f"matplotlib {matplotlib.__version__}\n{''.join(rows)}", encoding="utf-8")


if __name__ == "__main__":
    main()

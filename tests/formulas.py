"""Every formula of the lessons into the table of those set beforehand: ``python -m tests.formulas``.

What is shown at each step and on the way there counts, and what was tried for the boxes of diagrams.
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
from app.gui.ahead import WAY
from app.state import State, at_stop, start, stops

SIZES = (1920, 1080), (1000, 560)


def shown() -> Iterator[State]:
    """Every lesson at each step, and on the way there."""
    for lesson in lessons.built_in():
        for stop in stops(lesson):
            there = at_stop(start(lesson), stop)
            yield from (replace(there, at=max(there.at - before, there.now.start)) for before in (0.0, *WAY))


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
            for size in SIZES:
                overlay(compose(state), *size)
    return found


def main() -> None:
    found = sorted(met().items())
    rows = ",\n".join(f"{json.dumps(text)}: {json.dumps(box, separators=(',', ':'))}" for text, box in found)
    head = f'"matplotlib": {json.dumps(matplotlib.__version__)}'
    formulas.TABLE.write_text(f'{{{head},\n"formulas": {{\n{rows}\n}}}}\n', encoding="utf-8")


if __name__ == "__main__":
    main()

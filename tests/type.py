"""The type of the lessons into the tables of what is set beforehand: ``python -m tests.type``.

Of formulas, what is shown at each step and on the way there counts, and what boxes of diagrams say where they have more
room; of letters, what is read in every language.
"""

import json
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from unittest import mock

import matplotlib

import lessons
from app.draw import formulas, letters
from app.draw import type as type_
from app.draw.compose import compose, said
from app.draw.layout import overlay
from app.draw.picture import Diagram, Picture
from app.state import Options, State, at_stop, start, stops
from app.words import LANGUAGES

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
    with mock.patch.object(formulas, "prepared", return_value={}), mock.patch.object(formulas, "boxed", noted):
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


def read() -> tuple[letters.Known, letters.Known]:
    """The letters of all captions, wherever their lines end, and of what stands round the pictures."""
    found: tuple[letters.Known, letters.Known] = {}, {}
    type_._set.cache_clear()
    with mock.patch.object(letters, "asked", return_value=found):
        for language in LANGUAGES:
            for lesson in lessons.built_in():
                for stop in stops(lesson):
                    state = at_stop(start(lesson, Options(language=language, labels=True, legend=True)), stop)
                    overlay(compose(state), *SIZE)
                    for word in said(state, state.now).split():
                        type_.measure(word, 1.0)
    type_._set.cache_clear()
    return found


def kept(table: Path, rows: Iterable[str]) -> None:
    table.write_text("\n".join([f"matplotlib {matplotlib.__version__}", *sorted(rows), ""]), encoding="utf-8")


def main() -> None:
    kept(formulas.TABLE, (f"{text}\t{json.dumps(box, separators=(',', ':'))}" for text, box in met().items()))
    kept(
        letters.TABLE,
        (
            f"{weight}\t{key}\t{step}\t{above}\t{name}"
            for weight, known in zip(("regular", "bold"), read(), strict=True)
            for key, (step, above, name) in known.items()
        ),
    )


if __name__ == "__main__":
    main()

"""Texts that are there only when the program runs: what the lessons say with every knob at every value, and tables."""

import re
from collections.abc import Iterable, Iterator
from itertools import product

import lessons
from app.draw.surface import SHOWS
from app.draw.theme import NAMES, THEMES
from app.export.wish import FORMATS
from app.figures import BACKGROUNDS
from app.laboratory.boxlab import PRESETS
from app.laboratory.lab import SENTENCES, titled
from lessons.script import Beat, Lesson, View
from subdivision import Boundary, Grid, Mesh, Topology, shapes
from subdivision.catalogue import FAMILIES, scheme
from subdivision.words import Phrase
from tests.words.source import Text

WORD = re.compile(r"[^\W\d_]{2}")
GAP = re.compile(r"\{[^{}]*\}")
FORMULA = re.compile(r"^\s*\$.*\$\s*$", re.DOTALL)


def is_word(text: str) -> bool:
    """Whether there is anything to translate: letters that are no formula's and no gap's."""
    return WORD.search(GAP.sub("", text)) is not None and not FORMULA.match(text)


def parts(text: object, file: str) -> Iterator[Text]:
    """What a text is looked up by: itself, or its template and the words in its gaps."""
    if isinstance(text, Phrase):
        if is_word(text.template):
            yield Text(text.template, file, text.many)
        for value in text.values.values():
            yield from parts(value, file)
    elif isinstance(text, str) and is_word(text):
        yield Text(text, file)


def of_lessons() -> Iterator[Text]:
    """All that the lessons say, each under the name of its file."""
    for lesson in lessons.built_in():
        file = f"lessons/{lesson.id}.py"
        for text in _of_lesson(lesson):
            yield from parts(text, file)


def _of_lesson(lesson: Lesson) -> Iterator[str]:
    yield from (lesson.title, lesson.section, lesson.ours, *(knob.label for knob in lesson.knobs))
    for told in every_way(lesson):
        for beat in told.beats:
            yield from _of_beat(beat)


def every_way(lesson: Lesson) -> Iterator[Lesson]:
    """The lesson with its knobs at every value."""
    for values in product(*(range(knob.least, knob.most + 1) for knob in lesson.knobs)):
        yield lesson.turned(**dict(zip((knob.name for knob in lesson.knobs), values, strict=True)))


def _of_beat(beat: Beat) -> Iterator[str]:
    yield from (beat.text, beat.notes)
    views = list(beat.views)
    if beat.asks is not None:
        yield beat.asks.text
        views.extend(each for each in getattr(beat.asks, "answers", ()) if isinstance(each, View))
    for view in views:
        yield from (view.title, *(words for _, words in view.marks), *(stage.name for stage in view.trace.stages))


def of_tables() -> Iterator[Text]:
    """What menus, panels and pictures call things."""
    for file, texts in (
        ("app/export/wish.py", (kind.title for kind in FORMATS.values())),
        ("app/draw/theme.py", (*NAMES.values(), *(w for theme in THEMES.values() for w in theme.words.values()))),
        ("app/draw/theme.py", ("yellow", "System", *(name.capitalize() for name in THEMES))),
        ("app/draw/surface.py", SHOWS.values()),
        ("app/figures.py", (name.capitalize() for name in BACKGROUNDS)),
        ("app/laboratory/boxlab.py", PRESETS),
        ("app/laboratory/lab.py", (*SENTENCES.values(), *(titled(name) for name in shapes.SHAPES))),
        ("subdivision/topology.py", (boundary.value.replace("-", " ") for boundary in Boundary)),
        ("subdivision/catalogue.py", _of_schemes()),
    ):
        for text in texts:
            yield from parts(text, file)


def _of_schemes() -> Iterator[str]:
    objects = [make() for make in shapes.SHAPES.values()]
    for family in FAMILIES.values():
        made = scheme(family.name)
        yield from (family.title, made.title, *(p.name for p in family.parameters), *made.tellings)
        for mesh in _accepted(objects, made):
            for telling in made.tellings:
                yield from (stage.name for stage in made.step(mesh.topology, telling).stages)


def _accepted(objects: Iterable[Mesh], made: object) -> Iterator[Mesh]:
    """An object of each kind that a scheme takes."""
    for kind in (Topology, Grid, object):
        yield from [each for each in objects if isinstance(each.topology, kind) and made.accepts(each.topology)][:1]

"""The lessons, one file each.  A new file with a ``@lesson`` in it is found by itself."""

import pkgutil
import re
from collections.abc import Callable, Iterable
from functools import cache
from importlib import import_module

from lessons.script import Lesson

_brought: tuple[Lesson, ...] = ()


def all_lessons() -> tuple[Lesson, ...]:
    """Every lesson of this folder and every one brought along, in order: by section, then by file name."""
    return _in_order((*built_in(), *_brought))


def bring(own: Iterable[Lesson]) -> None:
    """From now on these are the lessons from elsewhere, instead of those brought before; their ids are new ones."""
    global _brought  # the one registry beside the modules that Python itself has imported
    _brought = tuple(own)


@cache
def built_in() -> tuple[Lesson, ...]:
    """Every lesson in this folder."""
    modules = [import_module(f"lessons.{m.name}") for m in pkgutil.iter_modules(__path__) if m.name != "script"]
    found = [value for module in modules for value in vars(module).values() if isinstance(value, Lesson)]
    return _in_order(found)


def _in_order(found: Iterable[Lesson]) -> tuple[Lesson, ...]:
    return tuple(sorted(found, key=lambda each: (each.section, each.id)))


def find(name: str) -> Lesson:
    """The lesson called ``name``: a figure's number, an id, the start of one or of a word in it, a section's number.

    Of several that fit it is the first of the lecture; so a section's number means its first lesson.

    Raises
    ------
    KeyError
        With a sentence that lists what there is.
    """
    wanted = "_".join(re.findall(r"[\w.]+", name.lower()))
    if (number := wanted.removeprefix("figure_")).isdecimal():
        wanted = f"figure_{int(number):02d}"
    begins = re.compile(rf"(^|_){re.escape(wanted)}(?!\d)")
    readings: tuple[Callable[[Lesson], bool], ...] = (
        lambda each: f"{each.id}_".startswith(f"{wanted}_"),
        lambda each: each.section.split()[0].lower() == wanted,
        lambda each: bool(wanted) and begins.search(each.id) is not None,
    )
    for fits in readings:
        for each in all_lessons():
            if fits(each):
                return each
    raise KeyError(f"there is no lesson '{name}'; there are {', '.join(each.id for each in all_lessons())}")

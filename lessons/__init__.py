"""The lessons, one file each.  A new file with a ``@lesson`` in it is found by itself."""

import pkgutil
from functools import cache
from importlib import import_module

from lessons.script import Lesson


@cache
def all_lessons() -> tuple[Lesson, ...]:
    """Every lesson in this folder, in the order of the lecture: by section, then by file name."""
    modules = [import_module(f"lessons.{m.name}") for m in pkgutil.iter_modules(__path__) if m.name != "script"]
    found = [value for module in modules for value in vars(module).values() if isinstance(value, Lesson)]
    return tuple(sorted(found, key=lambda each: (each.section, each.id)))


def find(name: str) -> Lesson:
    """The lesson called ``name``: its whole id, the start of one, or just a figure's number.

    Raises
    ------
    KeyError
        With a sentence that lists what there is.
    """
    wanted = f"figure_{int(name):02d}" if name.isdigit() else name
    matches = [each for each in all_lessons() if each.id == wanted or each.id.startswith(wanted + "_")]
    if not matches:
        raise KeyError(f"there is no lesson '{name}'; there are {', '.join(each.id for each in all_lessons())}")
    return matches[0]

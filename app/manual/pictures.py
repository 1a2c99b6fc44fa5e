"""Small pictures of the lessons for the manual: ``python -m app.manual.pictures FOLDER``."""

import sys
from collections.abc import Iterator
from pathlib import Path

import lessons
from app.figures import poster
from app.gallery import few_colours, tile
from app.state import at_stop, start
from subdivision.files.saving import save

SIZE = 840, 473
"""One and a half times as fine as they are shown."""


def draw(folder: Path) -> Iterator[Path]:
    """A picture of every lesson, without its words; each path when its file is there."""
    folder.mkdir(parents=True, exist_ok=True)
    for lesson in lessons.all_lessons():
        path = folder / f"{lesson.id}.png"
        save(path, (few_colours(tile(at_stop(start(lesson), poster(lesson)), SIZE)),))
        yield path


if __name__ == "__main__":
    for drawn in draw(Path(sys.argv[1])):
        print(drawn)

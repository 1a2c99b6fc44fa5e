"""Everything that the program writes, each as a function that writes one of two versions and one that looks at it."""

import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import lessons
from app.export import FORMATS, Wish, export
from app.figures import write as write_figure
from app.sessions import keeping
from app.state import State, choose, drag, last, start
from subdivision import Mesh, files, shapes, subdivide
from subdivision.schemes import CATMULL_CLARK

SIZE = (160, 90)
FASTEST = 10.0


@dataclass(frozen=True)
class Kind:
    """``write`` writes version 0 or 1 to a place called ``name``; written again, a version has the same bytes."""

    name: str
    place: str
    write: Callable[[Path, int], object]
    is_stamped: bool = False
    """... but for the time it was made at."""


def state(version: int) -> State:
    """Two that differ in everything that is written."""
    found = last(start(lessons.find("14")))
    return choose(drag(found, 3, (1.0, -0.25, 0.5)), theme="projector") if version else found


def _session(path: Path, version: int) -> object:
    return keeping.write(path, state(version))


def _picture(path: Path, version: int) -> object:
    from PySide6.QtCore import QSize

    from app.draw.darkroom import drawn
    from app.draw.seen import seen
    from app.gui.saving import ordered, save

    return save(path, drawn(ordered(seen(state(version)), "png", QSize(*SIZE))))


def _mesh(path: Path, version: int) -> object:
    fine = subdivide(shapes.cube(), CATMULL_CLARK, 5)
    return files.write(path, Mesh(fine.topology, fine.points * (1 + version)))


def _page(path: Path, version: int) -> object:
    from app.page import page_of

    return write_figure(path, page_of(state(version)))


def _exported(format_: str, of: str) -> Callable[[Path, int], object]:
    return lambda path, version: export(state(version), Wish(format_, of, SIZE, pace=FASTEST), path)


KINDS: Mapping[str, Kind] = {
    kind.name: kind
    for kind in (
        Kind("session", "talk.subdivision", _session),
        Kind("mesh", "fine.obj", _mesh),
        Kind("picture", "view.png", _picture),
        *(
            Kind(f"export {name}", f"view{of.suffix}", _exported(name, "view"), name in ("pptx", "pdf", "handout"))
            for name, of in FORMATS.items() if name != "html"
        ),
        Kind("export html", "page.html", _page),
        Kind("export many", "pictures", _exported("svg", "lesson")),
    )
}  # fmt: skip


def digests(place: Path) -> dict[str, str]:
    """The bytes of a file, or of all in a folder, told apart."""
    if place.is_dir():
        return {each.name: sha256(each.read_bytes()).hexdigest() for each in sorted(place.iterdir())}
    return {place.name: sha256(place.read_bytes()).hexdigest()} if place.exists() else {}


def is_whole(kind: Kind, place: Path, versions: list[dict[str, str]]) -> bool:
    """Whether each file that is there is one of the versions, byte for byte; or whole, where it has a stamp."""
    found = digests(place)
    if kind.is_stamped:
        return bool(found) and _is_complete(place)
    return found.keys() == versions[0].keys() and all(
        digest in (versions[0][name], versions[1][name]) for name, digest in found.items()
    )


def _is_complete(path: Path) -> bool:
    data = path.read_bytes()
    if path.suffix == ".pptx":
        with zipfile.ZipFile(path) as inside:
            return inside.testzip() is None and "ppt/presentation.xml" in inside.namelist()
    return data.startswith(b"%PDF") and data.rstrip().endswith(b"%%EOF")


def parts(folder: Path) -> list[Path]:
    """What is half written in a folder."""
    return [each for each in folder.iterdir() if each.name.startswith(".") and each.name.endswith(".part")]

"""Figures of lessons as files, without a window and without a screen."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from io import BytesIO
from pathlib import Path

from app.draw.compose import compose
from app.draw.picture import Picture
from app.state import Options, State, at_stop, start, stops
from lessons.script import Lesson
from subdivision.files.saving import save

FORMATS = ("png", "svg", "gif")
BACKGROUNDS = ("white", "black", "transparent", "theme")

PLAIN = {"white": (1.0, 1.0, 1.0), "black": (0.0, 0.0, 0.0)}

LEAST, MOST = 64, 16384
"""Pixels."""


class FigureError(ValueError):
    """Why there is no figure, in a sentence for the user."""


def render(
    lesson: Lesson,
    out_dir: Path | str,
    formats: Sequence[str] = ("png",),
    size: tuple[int, int] = (1920, 1080),
    background: str = "white",
    steps: bool = False,
    *,
    theme: str = "",
    progress: Callable[[float, str], None] = lambda done, name: None,
) -> list[Path]:
    """Write a lesson's last stop, or with ``steps`` each of its stops, in each of the formats.

    Parameters
    ----------
    formats : sequence of str
        Some of png, svg and gif; a gif is the whole lesson played, once, also with ``steps``.
    background : str
        white, black, transparent or theme (the theme's own).
    theme : str
        light, dark or projector; if not named, the one that suits the background.
    progress : callable
        Called with the part done (0..1) and the name of the file just written.

    Raises
    ------
    FigureError
        If a choice is unknown or a file cannot be written.  No half-written file is left.
    """
    formats = _checked(formats, size, background)
    state = start(lesson, Options(theme=theme or ("dark" if background == "black" else "light")))
    jobs = list(_jobs(state, formats, steps))
    folder = _folder(Path(out_dir))
    written: list[Path] = []
    for k, (name, paint) in enumerate(jobs):

        def part(done: float, k: int = k, name: str = name) -> None:
            progress((k + done) / len(jobs), name)

        data = paint(size, background, part)
        written.append(_write(folder / name, data))
        part(1.0)
    return written


def png(state: State, size: tuple[int, int], background: str = "theme") -> bytes:
    """The picture of a state as the bytes of a PNG file."""
    from PIL import Image

    from app.draw.raster import image

    pixels = image(_on(compose(state), background), *size, transparent=background == "transparent")
    picture = Image.fromarray(pixels)
    out = BytesIO()
    (picture if background == "transparent" else picture.convert("RGB")).save(out, "PNG")
    return out.getvalue()


def svg(state: State, size: tuple[int, int], background: str = "theme") -> bytes:
    """The picture of a state as the bytes of an SVG file."""
    from app.draw.vector import svg

    return svg(_on(compose(state), background), *size, transparent=background == "transparent").encode()


Progress = Callable[[float], None]
Paint = Callable[[tuple[int, int], str, Progress], bytes]


def _jobs(state: State, formats: Sequence[str], steps: bool) -> Iterator[tuple[str, Paint]]:
    """Names of files and what paints them."""
    name, places = state.lesson.id, stops(state.lesson)
    chosen = list(enumerate(places, 1)) if steps else [(0, places[-1])]
    digits = max(2, len(str(len(places))))
    for kind in formats:
        if kind == "gif":
            yield f"{name}.gif", _played(state)
            continue
        for number, stop in chosen:
            ending = f"-{number:0{digits}}" if number else ""
            yield f"{name}{ending}.{kind}", _still(at_stop(state, stop), png if kind == "png" else svg)


def _still(state: State, paint: Callable[[State, tuple[int, int], str], bytes]) -> Paint:
    return lambda size, background, progress: paint(state, size, background)


def _played(state: State) -> Paint:
    from app.draw.film import gif

    return lambda size, background, progress: gif(
        state, *size, look=lambda p: _on(p, background), transparent=background == "transparent", progress=progress
    )


def _on(picture: Picture, background: str) -> Picture:
    """The picture on white or black instead of its theme's background."""
    colour = PLAIN.get(background)
    return replace(picture, background=colour) if colour else picture


def _checked(formats: Sequence[str], size: tuple[int, int], background: str) -> tuple[str, ...]:
    for kind in formats:
        if kind not in FORMATS:
            raise FigureError(f"figures come as {', '.join(FORMATS[:-1])} or {FORMATS[-1]}, not as {kind}")
    if background not in BACKGROUNDS:
        raise FigureError(f"the background is one of {', '.join(BACKGROUNDS)}, not {background}")
    if not all(LEAST <= n <= MOST for n in size):
        raise FigureError(f"a figure has {LEAST} to {MOST} pixels each way, not {size[0]}x{size[1]}")
    return tuple(dict.fromkeys(formats))


def _folder(folder: Path) -> Path:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        reason = fault.strerror or fault
        raise FigureError(f"the folder {folder} cannot be made: {reason}; choose another folder") from fault
    return folder


def _write(path: Path, data: bytes) -> Path:
    try:
        save(path, [data])
    except OSError as fault:
        raise FigureError(f"{path} cannot be written: {fault.strerror or fault}; choose another folder") from fault
    return path

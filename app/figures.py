"""Figures of lessons as files, without a window and without a screen."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from io import BytesIO
from pathlib import Path

from app.draw.picture import Picture
from app.draw.seen import seen
from app.draw.theme import THEMES
from app.state import Options, State, Stop, at_stop, start, stops
from lessons.script import Lesson
from subdivision.files.saving import save
from subdivision.words import phrase

FORMATS = ("png", "svg", "gif")
BACKGROUNDS = ("white", "black", "transparent", "theme")

PLAIN = {"white": (1.0, 1.0, 1.0), "black": (0.0, 0.0, 0.0)}

UNREADABLE = {("dark", "white"): "white", ("light", "black"): "black", ("projector", "black"): "black"}
"""The words' colour, where a theme's words cannot be read on a background."""

LEAST, MOST = 64, 16384
"""Pixels."""


class FigureError(ValueError):
    """Why there is no figure, in a sentence for the user."""


def render(
    lesson: Lesson,
    out_dir: Path | str,
    formats: Sequence[str] = ("png",),
    size: tuple[int, int] = (1920, 1080),
    background: str = "",
    steps: bool = False,
    *,
    theme: str = "",
    as_caption: bool = False,
    scale: float = 1.0,
    progress: Callable[[float, str], None] = lambda done, name: None,
) -> list[Path]:
    """Write the picture that stands for a lesson, or with ``steps`` each of its stops, in each of the formats.

    Parameters
    ----------
    formats : sequence of str
        Some of png, svg and gif; a gif is the whole lesson played, once, also with ``steps``.
    background : str
        white, black, transparent or theme (the theme's own); if not named, white, or that of the theme named.
    theme : str
        light, dark or projector; if not named, the one that suits the background.
    as_caption : bool
        Colours as in the lecture's own caption.
    scale : float
        From 1 on: how much larger type, strokes and points are than usual, as far as there is room.
    progress : callable
        Called with the part done (0..1) and the name of the file just written.

    Raises
    ------
    FigureError
        If a choice is unknown or a file cannot be written.  No half-written file is left.
    """
    formats = _checked(formats, size, background, theme)
    theme, background = looks(theme, background)
    state = start(lesson, Options(theme=theme, as_caption=as_caption, scale=scale))
    jobs = list(_jobs(state, formats, steps))
    folder = _folder(Path(out_dir))
    written: list[Path] = []
    for k, (name, paint) in enumerate(jobs):

        def part(done: float, k: int = k, name: str = name) -> None:
            progress((k + done) / len(jobs), name)

        data = paint(size, background, part)
        written.append(write(folder / name, data))
        part(1.0)
    return written


def looks(theme: str, background: str) -> tuple[str, str]:
    """Theme and background, of which either or both may be left open ("")."""
    return theme or ("dark" if background == "black" else "light"), background or ("theme" if theme else "white")


def poster(lesson: Lesson) -> Stop:
    """Where the picture stands that stands for the lesson: the end of its poster beat, else its last stop."""
    marked = [stop for stop in stops(lesson) if lesson.beats[stop.beat].poster]
    return (marked or stops(lesson))[-1]


def file_name(lesson: Lesson, kind: str, step: int = 0) -> str:
    """What the file of a lesson is called, or that of one of its steps (from 1): its id, and the knobs it turned."""
    turned = [f"-{k.name}-{v}" for k, v in zip(lesson.knobs, lesson.values, strict=True) if v != k.start]
    digits = max(2, len(str(len(stops(lesson)))))
    return "".join([lesson.id, *turned, f"-{step:0{digits}}" if step else "", f".{kind}"])


def write(path: Path, data: bytes) -> Path:
    """Write a file whole or not at all; a FigureError tells why not."""
    try:
        save(path, [data])
    except OSError as fault:
        raise FigureError(
            phrase(
                "{path} cannot be written: {reason}; choose another folder", path=path, reason=fault.strerror or fault
            )
        ) from fault
    return path


def png(state: State, size: tuple[int, int], background: str = "theme") -> bytes:
    """The picture of a state as the bytes of a PNG file."""
    from PIL import Image

    from app.draw.raster import image

    pixels = image(stood_on(seen(state), background), *size, transparent=background == "transparent")
    picture = Image.fromarray(pixels)
    out = BytesIO()
    (picture if background == "transparent" else picture.convert("RGB")).save(out, "PNG")
    return out.getvalue()


def svg(state: State, size: tuple[int, int], background: str = "theme") -> bytes:
    """The picture of a state as the bytes of an SVG file."""
    from app.draw.vector import svg

    return svg(stood_on(seen(state), background), *size, transparent=background == "transparent").encode()


Progress = Callable[[float], None]
Paint = Callable[[tuple[int, int], str, Progress], bytes]


def _jobs(state: State, formats: Sequence[str], steps: bool) -> Iterator[tuple[str, Paint]]:
    """Names of files and what paints them."""
    lesson = state.lesson
    chosen = list(enumerate(stops(lesson), 1)) if steps else [(0, poster(lesson))]
    for kind in formats:
        if kind == "gif":
            yield file_name(lesson, kind), _played(state)
            continue
        for number, stop in chosen:
            yield file_name(lesson, kind, number), _still(at_stop(state, stop), png if kind == "png" else svg)


def _still(state: State, paint: Callable[[State, tuple[int, int], str], bytes]) -> Paint:
    return lambda size, background, progress: paint(state, size, background)


def _played(state: State) -> Paint:
    from app.draw.film import gif, shots

    return lambda size, background, progress: gif(
        list(shots(state)),
        *size,
        look=lambda p: stood_on(p, background),
        transparent=background == "transparent",
        progress=progress,
    )


def stood_on(picture: Picture, background: str) -> Picture:
    """The picture on white or black instead of its theme's background."""
    colour = PLAIN.get(background)
    return replace(picture, background=colour) if colour else picture


def _checked(formats: Sequence[str], size: tuple[int, int], background: str, theme: str) -> tuple[str, ...]:
    for kind in formats:
        if kind not in FORMATS:
            raise FigureError(
                phrase(
                    "figures come as {names} or {last}, not as {kind}",
                    names=", ".join(FORMATS[:-1]),
                    last=FORMATS[-1],
                    kind=kind,
                )
            )
    if background and background not in BACKGROUNDS:
        raise FigureError(
            phrase(
                "the background is one of {names}, not {background}",
                names=", ".join(BACKGROUNDS),
                background=background,
            )
        )
    if theme and theme not in THEMES:
        raise FigureError(phrase("the theme is one of {names}, not {theme}", names=", ".join(THEMES), theme=theme))
    if (words := UNREADABLE.get((theme, background))) is not None:
        raise FigureError(
            phrase(
                "the {theme} theme writes in {words}, which {background} hides: choose background theme",
                theme=theme,
                words=words,
                background=background,
            )
        )
    if not all(LEAST <= n <= MOST for n in size):
        raise FigureError(
            phrase(
                "a figure has {least} to {most} pixels each way, not {width}x{height}",
                least=LEAST,
                most=MOST,
                width=size[0],
                height=size[1],
            )
        )
    return tuple(dict.fromkeys(formats))


def _folder(folder: Path) -> Path:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        reason = fault.strerror or fault
        raise FigureError(
            phrase("the folder {folder} cannot be made: {reason}; choose another folder", folder=folder, reason=reason)
        ) from fault
    return folder

"""What is wished for, as a value that is checked before any work is done."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from app.figures import BACKGROUNDS, LEAST, MOST, UNREADABLE
from subdivision.words import phrase

SCOPES = ("view", "lesson", "everything")

SLOWEST, FASTEST = 0.1, 10.0
"""Pace: 1 is a second for a stage."""

MOST_LEVEL = 8


class ExportError(ValueError):
    """Why nothing was exported, in a sentence for the user."""


@dataclass(frozen=True)
class Format:
    """A kind of file; ``each`` says what one file holds: a step, a lesson, a level of a mesh, or all there is.

    ``wants`` are the choices that make a difference to it.
    """

    title: str
    suffix: str
    each: str
    wants: tuple[str, ...]


LOOKS = ("size", "background")

FORMATS: Mapping[str, Format] = MappingProxyType({
    "png": Format("PNG picture", ".png", "step", LOOKS),
    "svg": Format("SVG picture", ".svg", "step", LOOKS),
    "pdf": Format("PDF, a page a step", ".pdf", "all", LOOKS),
    "handout": Format("PDF handout with notes", ".pdf", "all", ()),
    "pptx": Format("PowerPoint deck", ".pptx", "all", LOOKS),
    "html": Format("Page for any browser", ".html", "lesson", ()),
    "mp4": Format("MP4 film", ".mp4", "lesson", (*LOOKS, "pace")),
    "gif": Format("GIF film", ".gif", "lesson", (*LOOKS, "pace")),
    "obj": Format("OBJ mesh", ".obj", "level", ("limit",)),
    "ply": Format("PLY mesh", ".ply", "level", ("limit",)),
    "stl": Format("STL mesh, triangles", ".stl", "level", ("limit",)),
    "glb": Format("glTF mesh, binary", ".glb", "level", ("limit",)),
})  # fmt: skip
"""What can be taken away, by name."""

OPAQUE = ("pptx", "mp4")
"""Nothing shows through these."""


@dataclass(frozen=True)
class Wish:
    """``format`` of what is ``of``: the view, the lesson or everything.

    ``level`` is which level of a view's mesh, None the one it shows; ``limit`` pushes its vertices to the limit.
    """

    format: str
    of: str = "lesson"
    size: tuple[int, int] = (1920, 1080)
    background: str = "theme"
    pace: float = 1.0
    level: int | None = None
    limit: bool = False

    @property
    def kind(self) -> Format:
        return FORMATS[self.format]

    @property
    def is_folder(self) -> bool:
        """Whether there will be several files."""
        return (self.of != "view" and self.kind.each in ("step", "level")) or (self.of, self.kind.each) == MANY_FILMS

    def checked(self, theme: str) -> "Wish":
        """The wish, if it can be fulfilled in a theme.

        Raises
        ------
        ExportError
        """
        if self.format not in FORMATS:
            raise ExportError(
                phrase(
                    "there is no format '{format}'; choose one of {names}", format=self.format, names=", ".join(FORMATS)
                )
            )
        if self.of not in SCOPES:
            raise ExportError(
                phrase("'{scope}' cannot be exported; choose one of {names}", scope=self.of, names=", ".join(SCOPES))
            )
        if not all(LEAST <= n <= MOST for n in self.size):
            width, height = self.size
            raise ExportError(
                phrase(
                    "a picture has {least} to {most} pixels each way, not {width} x {height}",
                    least=LEAST,
                    most=MOST,
                    width=width,
                    height=height,
                )
            )
        if self.background not in BACKGROUNDS:
            raise ExportError(
                phrase(
                    "the background is one of {names}, not {background}",
                    names=", ".join(BACKGROUNDS),
                    background=self.background,
                )
            )
        if self.background == "transparent" and self.format in OPAQUE:
            raise ExportError(phrase("a {kind} cannot be transparent; choose another background", kind=self.kind.title))
        if "background" in self.kind.wants and (words := UNREADABLE.get((theme, self.background))) is not None:
            raise ExportError(
                phrase(
                    "the {theme} theme writes in {words}, which {background} hides; choose another",
                    theme=theme,
                    words=words,
                    background=self.background,
                )
            )
        if not SLOWEST <= self.pace <= FASTEST:
            raise ExportError(
                phrase(
                    "the pace is from {least:g} to {most:g}, not {pace:g}", least=SLOWEST, most=FASTEST, pace=self.pace
                )
            )
        if self.level is not None and not 0 <= self.level <= MOST_LEVEL:
            raise ExportError(phrase("levels go from 0 to {most}, not to {level}", most=MOST_LEVEL, level=self.level))
        return self

    def named(self, path: Path) -> Path:
        """Where it goes: a folder, or a file with the format's suffix."""
        if self.is_folder or path.suffix.lower() == self.kind.suffix:
            return path
        return path.with_name(path.name + self.kind.suffix)


MANY_FILMS = ("everything", "lesson")

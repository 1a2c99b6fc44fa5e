"""Pictures as pages of a PDF: shapes stay shapes and type stays type, in the shipped typefaces.

What stands in space is what the SVG of the same picture has, hidden surfaces removed once for both; what is flat
is painted from the same layout.  matplotlib writes the file, so nothing more is installed.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from io import BytesIO
from typing import Any
from xml.etree import ElementTree

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_pdf import PdfFile, RendererPdf
from matplotlib.colors import to_rgb
from matplotlib.font_manager import FontEntry, FontProperties, fontManager
from matplotlib.path import Path as Outline
from matplotlib.transforms import Affine2D, Bbox

from app.draw.formulas import MATHEMATICS, MATHEMATICS_SIZE
from app.draw.layout import overlay, pane_areas
from app.draw.letters import BOLD, FEATURES, REGULAR
from app.draw.picture import Colour, Picture, Scene
from app.draw.primitives import ANCHOR, RIM, Area, Plate, Primitive, Text
from app.draw.projection import projected
from app.draw.raster import Brush
from app.draw.type import FAMILY, measure, path, runs

_FILE: Any = PdfFile
_RENDERER: Any = RendererPdf

INCH = 72.0
"""Points: the unit of a page."""

EMBEDDED = 3
"""Letters as drawings with their characters: of the typefaces here the kind that every reader shows alike."""

FAR = 1e6
"""Points: only balls beside the eye are so large or so far away, and matplotlib would walk round them for ever."""

SHIPPED = f"{FAMILY} of the studio"

_PLACE = re.compile(r"([ML])([-\d.]+) ([-\d.]+)")


def pdf(picture: Picture, width: int, height: int, *, transparent: bool = False) -> bytes:
    """The picture as a PDF of one page."""
    paper = Paper(picture.title)
    paper.turn(width, height)
    paper.picture(picture, (0.0, 0.0, width, height), width, transparent=transparent)
    return paper.done()


class Paper:
    """A PDF while its pages are painted; places are points from the upper left, y downwards."""

    def __init__(self, title: str) -> None:
        self._held = BytesIO()
        with rc_context({"pdf.fonttype": EMBEDDED}):
            self._file = _FILE(self._held, {"Title": title, "Creator": "Subdivision Studio", "CreationDate": None})
        self._renderer: Any = None

    def turn(self, width: float, height: float) -> None:
        """A new page."""
        self._end_page()
        self._height = height
        self._file.newPage(width / INCH, height / INCH)
        self._renderer = _RENDERER(self._file, INCH, height, width)

    def picture(
        self, picture: Picture, area: Area, width: float, *, transparent: bool = False, words: bool = True
    ) -> None:
        """A picture of a ``width`` in pixels, made as small as its place; ``words`` includes the caption."""
        x, y, w, h = area
        height = width * h / w
        pen = self._pen(x, y, w / width)
        if not transparent:
            pen.paint(Plate(0, 0, width, height, picture.background))
        for pane, place in zip(picture.panes, pane_areas(picture, width, height, words), strict=True):
            if isinstance(pane.content, Scene):
                drawn = "".join(projected(pane.content, place, height, "pane"))
                self._pen(x, y, pen.scale, place).shapes(ElementTree.fromstring(f"<svg>{drawn}</svg>"))
        self._paint(pen, overlay(picture, width, height, words=words))

    def paint(self, flat: Sequence[Primitive]) -> None:
        """Words and strokes on the page."""
        self._paint(self._pen(0, 0, 1), flat)

    def done(self) -> bytes:
        """The file."""
        self._end_page()
        with rc_context({"pdf.fonttype": EMBEDDED}):
            self._file.finalize()
        self._file.close()
        return self._held.getvalue()

    def _paint(self, pen: "Pen", flat: Sequence[Primitive]) -> None:
        with rc_context({"pdf.fonttype": EMBEDDED}):
            for each in flat:
                pen.paint(each)

    def _pen(self, x: float, y: float, scale: float, room: Area | None = None) -> "Pen":
        onto = Affine2D().scale(scale, -scale).translate(x, self._height - y)
        return Pen(self._renderer, onto, room)

    def _end_page(self) -> None:
        if self._renderer is not None:
            self._renderer.finalize()


@dataclass(frozen=True)
class _Setting:
    """How letters are set, as matplotlib asks for it."""

    features: tuple[str, ...] = FEATURES

    def get_fontfeatures(self) -> tuple[str, ...]:
        return self.features

    def get_language(self) -> None:
        return None


class Pen(Brush):
    """Paints on a page, within ``room`` if it is given; type is set as type."""

    def __init__(self, canvas: Any, onto: Affine2D, room: Area | None) -> None:
        super().__init__(canvas, onto)
        if room is not None:
            x, y, w, h = room
            self.clip = Bbox(onto.transform([(x, y + h), (x + w, y)]))

    def text(self, text: Text) -> None:
        left = text.x - ANCHOR[text.align] * measure(text.text, text.size, text.bold)[0]
        if text.halo is not None:
            rim = path(text.text, text.size, text.bold).transformed(Affine2D().scale(1, -1).translate(left, text.y))
            self.draw(rim, None, text.halo, RIM * text.size, text.opacity)
        gc = self.canvas.new_gc()
        gc.set_foreground((*text.colour, text.opacity), isRGBA=True)
        gc.set_alpha(text.opacity)
        for run in runs(text.text, text.bold):
            x, y = self.onto.transform((left + run.x * text.size, text.y))
            size = text.size * self.scale
            words = f"${run.text}$" if run.is_math else run.text
            face = _mathematics(size) if run.is_math else _inter(text.bold, size)
            self.canvas.draw_text(gc, x, y, words, face, 0, ismath=run.is_math, mtext=_Setting())
        gc.restore()

    def shapes(self, group: ElementTree.Element, dx: float = 0.0, dy: float = 0.0, opacity: float = 1.0) -> None:
        """The shapes of a group of SVG as ``projection`` writes it, in their order."""
        for each in group:
            strength = opacity * float(each.get("opacity", 1))
            if each.tag == "g":
                aside, down = _shift(each.get("transform", ""))
                self.shapes(each, dx + aside, dy + down, strength)
                continue
            shape = _outline(each)
            if shape is not None:
                width = float(each.get("stroke-width", 0))
                moved = shape.transformed(Affine2D().translate(dx, dy))
                fill, stroke = _colour(each.get("fill")), _colour(each.get("stroke"))
                self.draw(moved, fill, stroke, width, strength, is_butt=each.get("stroke-linecap") == "butt")


def _outline(each: ElementTree.Element) -> Outline | None:
    """A polygon, a circle or a path of straight strokes."""
    match each.tag:
        case "polygon":
            corners = [tuple(map(float, corner.split(","))) for corner in each.get("points", "").split()]
            return Outline([*corners, corners[0]], closed=True)
        case "circle":
            x, y, radius = (float(each.get(name, 0)) for name in ("cx", "cy", "r"))
            return Outline.circle((x, y), radius) if max(abs(x), abs(y), radius) < FAR else None
        case "path":
            return _stretches(each.get("d", ""))
    return None


def _stretches(data: str) -> Outline:
    """``M`` and ``L`` with absolute places."""
    found = _PLACE.findall(data)
    places = np.array([(x, y) for _, x, y in found], dtype=float)
    return Outline(places, [Outline.MOVETO if letter == "M" else Outline.LINETO for letter, _, _ in found])


def _shift(transform: str) -> tuple[float, float]:
    x, y = transform.removeprefix("translate(").removesuffix(")").split() if transform else ("0", "0")
    return float(x), float(y)


def _colour(code: str | None) -> Colour | None:
    return None if code is None or code == "none" else to_rgb(code)


def _inter(bold: bool, size: float) -> FontProperties:
    """The shipped typeface, and for characters it lacks the one that outlines have, too."""
    _register()
    return FontProperties(family=[SHIPPED, "DejaVu Sans"], weight=700 if bold else 400, size=size)


def _mathematics(size: float) -> FontProperties:
    return FontProperties(math_fontfamily=MATHEMATICS, size=size * MATHEMATICS_SIZE)


@cache
def _register() -> None:
    """Tell matplotlib of the shipped files, under a name that no installed typeface has."""
    for file, weight in ((REGULAR, 400), (BOLD, 700)):
        fontManager.ttflist.append(FontEntry(str(file), name=SHIPPED, weight=weight, size="scalable"))

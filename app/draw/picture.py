"""The display list: all that is on a picture, as values.  Above it nothing paints, below it nothing decides.

Lengths in space are in the units of the control object, so that they scale with it; strokes and
type are in *logical points* (1/1000 of the picture's height), so that they scale with the picture.
"""

from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import TypeAlias

import numpy as np

from subdivision.arrays import Floats, Indices

Colour: TypeAlias = tuple[float, float, float]
"""Red, green, blue in 0..1."""


class Shape(Enum):
    """Marker shapes; each role has its own, so that colour is never the only difference."""

    SPHERE = "sphere"
    DIAMOND = "diamond"
    CUBE = "cube"
    BEAD = "bead"
    """A small sphere with a ring: a helper, never a vertex."""
    HALO = "halo"
    """A sphere with a halo round it: a point that has moved."""
    CLEAR = "clear"
    """An unfilled diamond: the point a stencil makes.  Flat pictures only."""
    AIM = "aim"
    """A ring with cross-hairs: where somebody thinks a point will go.  Flat pictures only."""


@dataclass(frozen=True, eq=False)
class Markers:
    """Points of one kind.

    ``points`` (n, 3); ``radius`` (n,) in units of space; ``opacity`` (n,) in 0..1;
    ``ids`` (n,) point numbers in the trace (-1: not to be picked).
    """

    points: Floats
    shape: Shape
    colour: Colour
    radius: Floats
    opacity: Floats
    ids: Indices
    name: str = ""
    stage: int = -1
    """After how many stages they have these numbers; -1: now."""


@dataclass(frozen=True, eq=False)
class Lines:
    """Straight strokes between ``points`` (n, 3) along ``pairs`` (m, 2), ``width`` logical points thick."""

    points: Floats
    pairs: Indices
    colour: Colour
    width: float
    opacity: float = 1.0
    dashed: bool = False


@dataclass(frozen=True, eq=False)
class Faces:
    """Polygons: ``sizes`` (n_faces,) and ``corners`` laid end to end, on ``points`` (n, 3).

    ``colours`` (n, 3), if there are any, are worn at the points instead of the one ``colour``.
    """

    points: Floats
    sizes: Indices
    corners: Indices
    colour: Colour
    opacity: float = 1.0
    colours: Floats | None = None


@dataclass(frozen=True, eq=False)
class Label:
    """Words at a point of space; ``away`` in logical points moves them off it, right and up."""

    at: Floats
    text: str
    colour: Colour
    size: float = 22.0
    away: tuple[float, float] = (14.0, 14.0)
    opacity: float = 1.0


@dataclass(frozen=True, eq=False)
class Pin:
    """A flat mark over all that is in space, at a place of it; a thin line ties it to another one, if there is one."""

    at: Floats
    shape: Shape
    colour: Colour
    to: Floats | None = None


@dataclass(frozen=True, eq=False)
class Camera:
    """A view of space: ``position``, ``focal`` point and ``up`` (3,); ``angle`` in degrees from top to bottom.

    A parallel camera has ``scale``: half the visible height in units of space; else 0.  ``aspect`` is width to height
    of what it must show; in a narrower pane it steps back.
    """

    position: Floats
    focal: Floats
    up: Floats
    angle: float = 30.0
    scale: float = 0.0
    aspect: float = 1.4

    def project(self, points: Floats, width: float, height: float) -> Floats:
        """(n, 3): pixels right and down from the upper left, and depth away from the eye."""
        right, above, back = self.axes
        away = np.asarray(points, dtype=float).reshape(-1, 3) - self.position
        depth = -(away @ back)
        half = (
            np.full(len(away), self.scale)
            if self.scale
            else np.maximum(depth, 1e-9) * np.tan(np.radians(self.angle) / 2)
        )
        x, y = away @ right / half, away @ above / half
        return np.stack([width / 2 + x * height / 2, height / 2 - y * height / 2, depth], axis=1)

    def place(self, x: float, y: float, depth: float, width: float, height: float) -> Floats:
        """(3,): what ``project`` sends to a pixel and a depth."""
        right, above, back = self.axes
        half = self.scale or depth * np.tan(np.radians(self.angle) / 2)
        aside, up = (2 * x - width) / height * half, (height - 2 * y) / height * half
        return np.asarray(self.position - depth * back + aside * right + up * above)

    @cached_property
    def axes(self) -> Floats:
        """(3, 3): right, up and towards the eye, each of length one."""
        back = unit(self.position - self.focal)
        right = unit(np.cross(self.up, back))
        return np.stack([right, np.cross(back, right), back])


@dataclass(frozen=True)
class Bar:
    """What colours stand for: ``colours`` from the least value to the most, and numbers at places 0..1 between."""

    title: str
    colours: tuple[Colour, ...]
    ticks: tuple[tuple[float, str], ...]


@dataclass(frozen=True, eq=False)
class Scene:
    """One pane in space; ``remark`` is a sentence about it, where something asked for cannot be shown.

    One that ``is_hasty`` is drawn from fewer triangles: it lasts for as long as the hand moves.
    """

    camera: Camera
    faces: tuple[Faces, ...] = ()
    lines: tuple[Lines, ...] = ()
    markers: tuple[Markers, ...] = ()
    labels: tuple[Label, ...] = ()
    pins: tuple[Pin, ...] = ()
    bar: Bar | None = None
    remark: str = ""
    is_hasty: bool = False

    @property
    def is_translucent(self) -> bool:
        """Whether there are surfaces through which others are seen."""
        return any(faces.opacity < 1 for faces in self.faces)


@dataclass(frozen=True)
class Box:
    """A box of a diagram round ``(x, y)``, y downwards, in cells.

    ``texts`` says the same ever more tersely, with mathematics between dollars: the first that has room is shown,
    the same one in all boxes of a ``group``; where none has, the box stays empty.
    ``point`` and ``stage`` tell which point of the trace it is, after how many stages; ``choice`` which answer.
    """

    x: float
    y: float
    texts: tuple[str, ...]
    fill: Colour
    ink: Colour
    stroke: Colour
    width: float = 0.9
    height: float = 0.7
    opacity: float = 1.0
    point: int = -1
    stage: int = -1
    group: int = 0
    line: float = 2.0
    choice: int = -1


@dataclass(frozen=True, eq=False)
class Squares:
    """Many small squares of a diagram, as the marks of a matrix, over its boxes.

    ``places`` (n, 2) are their middles, in cells; ``colours`` (n, 3); ``points`` (n,) the points of the trace that they
    are about, after ``stage`` stages; ``side`` theirs, in cells.
    """

    places: Floats
    colours: Floats
    points: Indices
    stage: int
    side: float = 0.86
    opacity: float = 1.0

    def box(self, k: int) -> Box:
        """One of them, as a box."""
        (x, y), (red, green, blue) = self.places[k].tolist(), self.colours[k].tolist()
        fill, point = (red, green, blue), int(self.points[k])
        return Box(x, y, ("",), fill, fill, fill, self.side, self.side, self.opacity, point, self.stage, line=0.0)


@dataclass(frozen=True)
class Link:
    """A stroke of a diagram from one place to another, in cells; an arrow has a head at the second one."""

    x0: float
    y0: float
    x1: float
    y1: float
    colour: Colour
    opacity: float = 1.0
    width: float = 2.0
    is_arrow: bool = False


@dataclass(frozen=True)
class Note:
    """Words in a diagram, in cells; ``align`` is left, center or right."""

    x: float
    y: float
    text: str
    colour: Colour
    align: str = "left"
    opacity: float = 1.0


@dataclass(frozen=True)
class Dot:
    """A flat marker of a diagram, in cells; ``size`` is its radius in logical points.

    ``text`` stands beside it, off in the direction ``way`` (right and down), as large as there is room for.
    """

    x: float
    y: float
    shape: Shape
    size: float
    colour: Colour
    point: int = -1
    stage: int = -1
    text: str = ""
    way: tuple[float, float] = (1.0, 0.0)


@dataclass(frozen=True)
class Diagram:
    """One flat pane: boxes, dots, strokes, words, squares.

    ``cells`` is (left, top, right, bottom) of what must be visible.
    """

    cells: tuple[float, float, float, float]
    boxes: tuple[Box, ...] = ()
    links: tuple[Link, ...] = ()
    notes: tuple[Note, ...] = ()
    dots: tuple[Dot, ...] = ()
    largest: float = 150.0
    """No cell is drawn higher than this, in logical points."""
    shape: tuple[float, float] = (1.0, 1.0)
    """Least and most width to height of a cell: within them it takes the room that its pane has."""
    squares: tuple[Squares, ...] = ()


@dataclass(frozen=True, eq=False)
class Pane:
    """A part of the picture, in fractions of it from the upper left: x, y, width, height.

    ``title`` stands above it, ``reading`` (a measurement) below; ``frame`` is the colour of a frame round it.
    """

    content: Scene | Diagram
    rect: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0)
    title: str = ""
    reading: str = ""
    frame: Colour | None = None


@dataclass(frozen=True)
class Entry:
    """A line of the legend."""

    shape: Shape
    colour: Colour
    text: str


@dataclass(frozen=True, eq=False)
class Picture:
    """Everything to paint: panes, and the words that belong to the whole."""

    panes: tuple[Pane, ...]
    background: Colour
    ink: Colour
    muted: Colour
    legend: tuple[Entry, ...] = ()
    title: str = ""
    caption: str = ""
    formula: str = ""
    corner: str = ""
    stroke: float = 1.0
    scale: float = 1.0
    growth: float = 1.0
    """The part of ``scale`` that is given up where words would leave too little of the picture."""

    @property
    def scenes(self) -> tuple[Scene, ...]:
        return tuple(p.content for p in self.panes if isinstance(p.content, Scene))


def unit(vector: Floats) -> Floats:
    """The vector at length one; nothing stays nothing."""
    return np.asarray(vector / max(float(np.linalg.norm(vector)), 1e-300), dtype=float)

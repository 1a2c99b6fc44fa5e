"""Paints a layout's strokes, marks and type with Qt."""

from collections.abc import Callable, Iterable
from functools import lru_cache

import numpy as np
import numpy.typing as npt
from PySide6.QtCore import QByteArray, QDataStream, QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPainterPath, QPen, QPolygonF

from app.draw.flat import FLAT, Disc, Polygon
from app.draw.picture import Colour
from app.draw.primitives import ANCHOR, RIM, Mark, Plate, Primitive, Stroke, Text, Tiles
from app.draw.type import measure, outline
from app.gui.look import colour
from subdivision.arrays import Floats, Indices

ROUNDED = 1.0
"""Round corners of tiles of a smaller radius, in pixels, are not seen."""

KINDS = MOVE, LINE, CURVE, CUBIC, CLOSE = 1, 2, 3, 4, 79
"""How matplotlib calls the vertices of an outline."""


def paint(painter: QPainter, primitives: Iterable[Primitive], words: Callable[[QPainter, Text], None]) -> None:
    """Paint everything in order, type by ``words``."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    for each in primitives:
        match each:
            case Text():
                words(painter, each)
            case Plate():
                _plate(painter, each)
            case Tiles():
                _tiles(painter, each)
            case Stroke():
                painter.setPen(_pen(each.colour, each.width, each.opacity, dashed=each.dashed))
                painter.drawLine(QLineF(each.x0, each.y0, each.x1, each.y1))
            case Mark():
                mark(painter, each)


def type_(painter: QPainter, text: Text) -> None:
    """Words and mathematics, as the same outlines that every other painter uses."""
    width = measure(text.text, text.size, text.bold)[0]
    painter.save()
    painter.translate(text.x - ANCHOR[text.align] * width, text.y)
    painter.scale(text.size, text.size)
    painter.setOpacity(text.opacity)
    path = glyphs(text.text, text.bold)
    if text.halo is not None:
        pen = QPen(_pen(text.halo, RIM))
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        painter.strokePath(path, pen)
    painter.fillPath(path, colour(text.colour))
    painter.restore()


@lru_cache(maxsize=1024)
def glyphs(text: str, bold: bool = False) -> QPainterPath:
    """The outline of type of size 1, y downwards."""
    vertices, codes = outline(text, 1.0, bold)
    elements = _elements(vertices * (1.0, -1.0), codes)
    path = QPainterPath()
    if len(elements):
        ends = np.array([0, Qt.FillRule.WindingFill.value], dtype=">i4").tobytes()
        told = np.array(len(elements), dtype=">i4").tobytes() + elements.tobytes() + ends
        # as Qt keeps paths, which is a hundred times quicker than a call for each of its points
        QDataStream(QByteArray(told)) >> path
    path.setFillRule(Qt.FillRule.WindingFill)
    return path


def _elements(points: Floats, codes: Indices) -> npt.NDArray[np.void]:
    """Lines and cubic curves as Qt keeps them, of matplotlib's codes: a quadratic curve is a cubic one too."""
    control, starts = np.flatnonzero(codes == CURVE)[::2], np.flatnonzero(codes == MOVE)
    begin = starts[np.searchsorted(starts, np.arange(len(codes)), side="right") - 1]
    places = np.where((codes == CLOSE)[:, None], points[begin], points)
    is_still = ((codes == LINE) | (codes == CLOSE)) & (places == np.roll(places, 1, axis=0)).all(axis=1)
    thirds = (places[[control - 1, control + 1]] + 2 * places[control]) / 3
    kinds = np.choose(np.searchsorted(KINDS, codes), [0, 1, 3, 3, 1])
    kinds[np.flatnonzero(codes == CUBIC)[::3]] = 2
    count = np.where(is_still, 0, 1)
    count[control] = 2
    found = np.zeros(count.sum(), dtype=[("kind", ">i4"), ("x", ">f8"), ("y", ">f8")])
    at = np.repeat(places, count, axis=0)
    kind = np.repeat(kinds, count)
    first = (np.cumsum(count) - count)[control]
    at[first], at[first + 1] = thirds
    kind[first] = 2
    found["kind"], found["x"], found["y"] = kind, at[:, 0], at[:, 1]
    return found


def mark(painter: QPainter, mark: Mark) -> None:
    """A marker as it looks in the legend."""
    ink, centre = colour(mark.colour, mark.opacity), QPointF(mark.x, mark.y)
    for part in FLAT[mark.shape]:
        width = 0.0 if isinstance(part, Disc) else part.width
        painter.setPen(QPen(ink, width * mark.size) if width else Qt.PenStyle.NoPen)
        painter.setBrush(Qt.BrushStyle.NoBrush if width else ink)
        if isinstance(part, Polygon):
            painter.drawPolygon(QPolygonF([centre + QPointF(mark.size * x, mark.size * y) for x, y in part.corners]))
        else:
            painter.drawEllipse(centre, part.radius * mark.size, part.radius * mark.size)


def _plate(painter: QPainter, plate: Plate) -> None:
    painter.setBrush(Qt.BrushStyle.NoBrush if plate.fill is None else colour(plate.fill, plate.opacity))
    pen = Qt.PenStyle.NoPen if plate.stroke is None else _pen(plate.stroke, plate.line, plate.opacity)
    painter.setPen(pen)
    painter.drawRoundedRect(QRectF(plate.x, plate.y, plate.width, plate.height), plate.radius, plate.radius)


def _tiles(painter: QPainter, tiles: Tiles) -> None:
    """All of one colour at once; round corners that nobody sees are none."""
    painter.setPen(Qt.PenStyle.NoPen)
    shades, which = np.unique(tiles.colours, axis=0, return_inverse=True)
    for k, (red, green, blue) in enumerate(shades.tolist()):
        painter.setBrush(colour((red, green, blue), tiles.opacity))
        rooms = [QRectF(x, y, tiles.width, tiles.height) for x, y in tiles.corners[which == k].tolist()]
        if tiles.radius < ROUNDED:
            painter.drawRects(rooms)
            continue
        for room in rooms:
            painter.drawRoundedRect(room, tiles.radius, tiles.radius)


@lru_cache(maxsize=1024)
def _pen(ink: Colour, width: float, opacity: float = 1.0, *, dashed: bool = False) -> QPen:
    pen = QPen(colour(ink, opacity), width)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap if dashed else Qt.PenCapStyle.RoundCap)
    if dashed:
        pen.setDashPattern([4.0, 3.0])
    return pen

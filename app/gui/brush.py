"""Paints a layout's strokes, marks and type with Qt."""

from collections.abc import Iterable
from functools import lru_cache

from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPainterPath, QPen, QPolygonF

from app.draw.flat import FLAT, Disc, Polygon
from app.draw.picture import Colour
from app.draw.primitives import ANCHOR, RIM, Mark, Plate, Primitive, Stroke, Text
from app.draw.type import measure, outline
from app.gui.look import colour


def paint(painter: QPainter, primitives: Iterable[Primitive]) -> None:
    """Paint everything in order."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    for each in primitives:
        match each:
            case Text():
                type_(painter, each)
            case Plate():
                _plate(painter, each)
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
        pen = _pen(text.halo, RIM)
        pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
        painter.strokePath(path, pen)
    painter.fillPath(path, colour(text.colour))
    painter.restore()


@lru_cache(maxsize=1024)
def glyphs(text: str, bold: bool = False) -> QPainterPath:
    """The outline of type of size 1, y downwards."""
    vertices, codes = outline(text, 1.0, bold)
    path = QPainterPath()
    path.setFillRule(Qt.FillRule.WindingFill)
    at = [QPointF(x, -y) for x, y in vertices]
    k = 0
    while k < len(codes):
        match int(codes[k]):
            case 1:
                path.moveTo(at[k])
            case 2:
                path.lineTo(at[k])
            case 3:
                path.quadTo(at[k], at[k + 1])
                k += 1
            case 4:
                path.cubicTo(at[k], at[k + 1], at[k + 2])
                k += 2
            case 79:
                path.closeSubpath()
        k += 1
    return path


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


def _pen(ink: Colour, width: float, opacity: float = 1.0, *, dashed: bool = False) -> QPen:
    pen = QPen(colour(ink, opacity), width)
    pen.setCapStyle(Qt.PenCapStyle.FlatCap if dashed else Qt.PenCapStyle.RoundCap)
    if dashed:
        pen.setDashPattern([4.0, 3.0])
    return pen

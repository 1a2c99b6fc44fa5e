"""Type as images made before, for as long as it moves: its outlines take ten times as long to fill."""

from functools import lru_cache
from math import ceil, log

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QPixmap

from app.draw.picture import Colour
from app.draw.primitives import ANCHOR, Text
from app.draw.type import measure
from app.gui.brush import type_

GROWTH = 2**0.25
"""From one size of stamps to the next."""

EDGE = 0.3
"""Room for what reaches beyond the extent of type, relative to its size."""


def stamp(painter: QPainter, text: Text) -> None:
    """Words and mathematics, a little blurred, from a stamp of their size or a little larger."""
    scale = painter.device().devicePixelRatio()
    size = GROWTH ** ceil(log(text.size * scale, GROWTH))
    image, left, top = _stamp(text.text, text.bold, text.colour, text.halo, size)
    part = text.size / size
    x = text.x - ANCHOR[text.align] * measure(text.text, text.size, text.bold)[0]
    where = QRectF(x - part * left, text.y - part * top, part * image.width(), part * image.height())
    painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
    painter.setOpacity(text.opacity)
    painter.drawPixmap(where, image, QRectF(image.rect()))
    painter.setOpacity(1.0)


@lru_cache(maxsize=1024)
def _stamp(words: str, bold: bool, ink: Colour, halo: Colour | None, size: float) -> tuple[QPixmap, int, int]:
    """The image of type of a size, and how far right and down in it the type begins."""
    width, ascent, descent = measure(words, size, bold)
    room = ceil(EDGE * size) + 1
    left, top = room, ceil(ascent) + room
    image = QPixmap(ceil(width) + 2 * room, top + ceil(descent) + room)
    image.fill(Qt.GlobalColor.transparent)
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        type_(painter, Text(left, top, words, size, ink, bold=bold, halo=halo))
    return image.copy(), left, top  # without all that Qt keeps with what has been painted on

"""A picture as SVG: shapes stay shapes and type stays type, so that it can be edited and printed at any size.

The same picture gives the same bytes.
"""

from collections.abc import Iterator
from xml.sax.saxutils import escape

import numpy as np

from app.draw.flat import FLAT, Disc, Polygon
from app.draw.layout import overlay, pane_areas
from app.draw.markup import code, faded, number, places
from app.draw.picture import Picture, Scene
from app.draw.primitives import ANCHOR, RIM, Mark, Plate, Primitive, Stroke, Text, Tiles
from app.draw.projection import projected
from app.draw.type import FAMILY, measure, outline, runs

LETTERS = {1: "M", 2: "L", 3: "Q", 4: "C", 79: "Z"}
ANCHORS = {"left": "start", "center": "middle", "right": "end"}
FALLBACKS = f"{FAMILY}, 'Helvetica Neue', Arial, sans-serif"


def svg(picture: Picture, width: int, height: int, *, transparent: bool = False, words: bool = True) -> str:
    """The picture as the text of an SVG file; ``words`` includes the caption."""
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}"'
        f' font-family="{FALLBACKS}" style="font-variant-numeric: tabular-nums">',
        f"<title>{escape(picture.title)}</title>",
        f"<desc>{escape(picture.caption)}</desc>",
    ]
    if not transparent:
        parts.append(f'<rect width="{width}" height="{height}" fill="{code(picture.background)}"/>')
    for k, (pane, area) in enumerate(zip(picture.panes, pane_areas(picture, width, height, words), strict=True)):
        if isinstance(pane.content, Scene):
            parts.extend(projected(pane.content, area, height, f"pane{k}"))
    for each in overlay(picture, width, height, words=words):
        parts.extend(_flat(each))
    return "\n".join([*parts, "</svg>", ""])


def _flat(each: Primitive) -> Iterator[str]:
    match each:
        case Text():
            yield from _text(each)
        case Plate():
            yield _plate(each)
        case Tiles():
            yield from map(_plate, each.plates())
        case Stroke():
            dash = f' stroke-dasharray="{number(4 * each.width)} {number(3 * each.width)}"' if each.dashed else ""
            ends = f"M{number(each.x0)} {number(each.y0)}L{number(each.x1)} {number(each.y1)}"
            look = f'stroke="{code(each.colour)}" stroke-width="{number(each.width)}" stroke-linecap="round"'
            yield f'<path d="{ends}" {look}{dash}{faded(each.opacity)}/>'
        case Mark():
            yield from _mark(each)


def _plate(plate: Plate) -> str:
    place = f'x="{number(plate.x)}" y="{number(plate.y)}" width="{number(plate.width)}" height="{number(plate.height)}"'
    fill = code(plate.fill) if plate.fill is not None else "none"
    line = f' stroke="{code(plate.stroke)}" stroke-width="{number(plate.line)}"' if plate.stroke is not None else ""
    return f'<rect {place} rx="{number(plate.radius)}" fill="{fill}"{line}{faded(plate.opacity)}/>'


def _text(text: Text) -> Iterator[str]:
    """Words as type; mathematics, and the rim behind both, as outlines."""
    width = measure(text.text, text.size, text.bold)[0]
    left = text.x - ANCHOR[text.align] * width
    look = f'fill="{code(text.colour)}"{faded(text.opacity)}'
    if text.halo is not None:
        rim = f'fill="none" stroke="{code(text.halo)}" stroke-width="{number(RIM * text.size)}" stroke-linejoin="round"'
        yield f'<path d="{traced(text.text, text.size, left, text.y, text.bold)}" {rim}{faded(text.opacity)}/>'
    parts = runs(text.text, text.bold)
    for run in parts:
        x = left + run.x * text.size
        if run.is_math:
            shape = traced(f"${run.text}$", text.size, x, text.y, text.bold)
            yield f'<path d="{shape}" {look}><title>{escape(run.text)}</title></path>'
            continue
        # Words alone are anchored where the layout anchors them: another typeface then keeps its place.
        alone = len(parts) == 1
        anchor = f' text-anchor="{ANCHORS[text.align]}"' if alone and text.align != "left" else ""
        weight = ' font-weight="600"' if text.bold else ""
        yield (
            f'<text x="{number(text.x if alone else x)}" y="{number(text.y)}" font-size="{number(text.size)}"'
            f'{weight}{anchor} {look} xml:space="preserve">{escape(run.text)}</text>'
        )


def traced(words: str, size: float, x: float, y: float, bold: bool = False) -> str:
    """Words and mathematics as the outline of a ``path``, from ``x`` on the baseline ``y``."""
    vertices, codes = outline(words, size, bold)
    parts: list[str] = []
    k = 0
    while k < len(codes):
        kind = int(codes[k])
        count = {3: 2, 4: 3}.get(kind, 1)
        here = "" if kind == 79 else " ".join(f"{number(x + a)} {number(y - b)}" for a, b in vertices[k : k + count])
        parts.append(LETTERS.get(kind, "") + here)
        k += count
    return "".join(parts)


def _mark(mark: Mark) -> Iterator[str]:
    colour, look = code(mark.colour), faded(mark.opacity)
    at = f'cx="{number(mark.x)}" cy="{number(mark.y)}"'
    for part in FLAT[mark.shape]:
        if isinstance(part, Polygon):
            corners = np.array(part.corners) * mark.size + [mark.x, mark.y]
            paint = f'fill="{colour}"' if not part.width else _outlined(colour, part.width * mark.size)
            yield f'<polygon points="{places(corners)}" {paint}{look}/>'
        elif isinstance(part, Disc):
            yield f'<circle {at} r="{number(part.radius * mark.size)}" fill="{colour}"{look}/>'
        else:
            yield (
                f'<circle {at} r="{number(part.radius * mark.size)}"'
                f" {_outlined(colour, part.width * mark.size)}{look}/>"
            )


def _outlined(colour: str, width: float) -> str:
    return f'fill="none" stroke="{colour}" stroke-width="{number(width)}"'

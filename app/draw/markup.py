"""Numbers, places and colours as SVG writes them: short, and the same every time."""

from app.draw.picture import Colour
from subdivision.arrays import Floats


def number(value: float) -> str:
    """A number in hundredths, never -0."""
    text = f"{float(value):.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def places(corners: Floats) -> str:
    """The corners of a polygon."""
    return " ".join(f"{number(c[0])},{number(c[1])}" for c in corners)


def faded(value: float) -> str:
    """The attribute for an opacity; none for 1."""
    return f' opacity="{number(value)}"' if value < 1 else ""


def code(colour: Colour) -> str:
    """``#rrggbb``."""
    return "#" + "".join(f"{round(255 * min(max(c, 0.0), 1.0)):02x}" for c in colour)


def shone(colour: Colour, glow: float) -> Colour:
    """A colour under a light."""
    r, g, b = (min(c * float(glow), 1.0) for c in colour)
    return r, g, b

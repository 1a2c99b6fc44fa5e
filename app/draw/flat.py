"""Flat markers as discs, rings and polygons: the same in a legend on paper, on the screen and in a vector figure."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeAlias

from app.draw.picture import Shape


@dataclass(frozen=True)
class Disc:
    """A filled circle round the middle."""

    radius: float


@dataclass(frozen=True)
class Ring:
    """A circle's stroke; ``radius`` is that of its middle line."""

    radius: float
    width: float


@dataclass(frozen=True)
class Polygon:
    """Filled, or with a ``width`` only its outline; y downwards."""

    corners: tuple[tuple[float, float], ...]
    width: float = 0.0


Part: TypeAlias = Disc | Ring | Polygon

CROSS_HAIRS = ((-1.8, -0.17, -1.0, 0.17), (1.0, -0.17, 1.8, 0.17), (-0.17, -1.8, 0.17, -1.0), (-0.17, 1.0, 0.17, 1.8))
"""Left, top, right and bottom of each."""

FLAT: Mapping[Shape, tuple[Part, ...]] = MappingProxyType(
    {
        Shape.SPHERE: (Disc(1.0),),
        Shape.DIAMOND: (Polygon(((1.28, 0.0), (0.0, 1.28), (-1.28, 0.0), (0.0, -1.28))),),
        Shape.CUBE: (Polygon(((0.9, 0.9), (-0.9, 0.9), (-0.9, -0.9), (0.9, -0.9))),),
        Shape.BEAD: (Disc(0.7), Ring(1.3, 0.25)),
        Shape.CLEAR: (Polygon(((1.6, 0.0), (0.0, 1.6), (-1.6, 0.0), (0.0, -1.6)), 0.26),),
        Shape.AIM: (
            Ring(1.0, 0.34),
            *(Polygon(((x0, y0), (x1, y0), (x1, y1), (x0, y1))) for x0, y0, x1, y1 in CROSS_HAIRS),
        ),
        Shape.HALO: (Disc(0.85), Ring(1.45, 0.3)),
    }
)
"""The parts of each marker, for a mark of size 1."""

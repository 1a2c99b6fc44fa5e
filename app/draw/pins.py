"""Flat marks over a scene: where they are painted, and what words keep off."""

import numpy as np

from app.draw.picture import Camera, Picture, Scene, Shape
from app.draw.primitives import Area, Mark, Primitive, Stroke
from subdivision.arrays import Floats

SIZE, TIE = 15.0, 2.6
"""Radius of a mark, and width of the line that ties it to another place, in logical points."""

GROUND, REACH = 1.35, 1.9
"""Radius of the light disc under a mark, and how far its cross-hairs reach, relative to the mark."""


def drawn(scene: Scene, camera: Camera, area: Area, picture: Picture, height: float) -> list[Primitive]:
    """The marks as far as they are in the pane, and their lines under them."""
    unit = height / 1000 * picture.stroke
    light = max(picture.background, picture.ink, key=sum)
    lines, marks = list[Primitive](), list[Primitive]()
    for pin in scene.pins:
        x, y = _flat(pin.at, camera, area)
        if not (area[0] <= x <= area[0] + area[2] and area[1] <= y <= area[1] + area[3]):
            continue
        marks.append(Mark(x, y, Shape.SPHERE, GROUND * SIZE * unit, light, 0.6))
        marks.append(Mark(x, y, pin.shape, SIZE * unit, pin.colour))
        if pin.to is not None:
            lines.append(Stroke(x, y, *_flat(pin.to, camera, area), pin.colour, TIE * unit))
    return [*lines, *marks]


def discs(scene: Scene, camera: Camera, area: Area, picture: Picture, height: float) -> Floats:
    """(n, 3): centre and reach of every mark, in pixels."""
    reach = REACH * SIZE * height / 1000 * picture.stroke
    return np.array([(*_flat(pin.at, camera, area), reach) for pin in scene.pins]).reshape(-1, 3)


def _flat(place: Floats, camera: Camera, area: Area) -> tuple[float, float]:
    x, y, _ = camera.project(place, area[2], area[3])[0].tolist()
    return area[0] + x, area[1] + y

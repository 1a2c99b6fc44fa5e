"""Words at points: none over a marker, none over other words, none outside its pane.

Each label takes the nearest free place round its point, first where it would like to be; one that
must go further is tied to its point by a thin line.
"""

from dataclasses import dataclass, field, replace
from typing import TypeAlias

import numpy as np

from app.draw import pins
from app.draw.picture import Camera, Label, Picture, Scene, Shape
from app.draw.places import Ground, Point, Wish, nearest
from app.draw.primitives import LEAST, Area, Primitive, Stroke, Text
from app.draw.type import measure
from subdivision.arrays import Floats

LEADER = 0.9
"""A label further off than this many of its heights needs a line to its point."""

REACH = {Shape.SPHERE: 1.0, Shape.DIAMOND: 1.28, Shape.CUBE: 1.2, Shape.BEAD: 1.75, Shape.HALO: 1.75}
"""How far a marker reaches, relative to its radius."""

Name: TypeAlias = tuple[Area, int, str]
"""A label's pane, number and words."""

Named: TypeAlias = tuple[Name, Label, Point]
"""A label, and where its point is on the picture."""

FEW = 400
"""Up to so many strokes, labels try to keep off them."""


NOTHING = np.zeros((4, 0))
"""No rooms."""


@dataclass(frozen=True, eq=False)
class Kept:
    """Where labels stand beside their points, filled as they are placed: given again, they go along with these.

    ``beside`` tells how far right and down a label is, and how far off in heights; ``growth`` how much the labels of
    a pane are enlarged.
    """

    beside: dict[Name, tuple[Point, float]] = field(default_factory=dict)
    growth: dict[Area, float] = field(default_factory=dict)


def placed(
    scene: Scene,
    camera: Camera,
    area: Area,
    height: float,
    picture: Picture,
    kept: Kept | None = None,
    rooms: Floats = NOTHING,
) -> list[Primitive]:
    """The labels of a scene in its pane, the largest placed first; enlarged as far as none then covers another.

    They keep off ``rooms``, (4, n): left, top, right and bottom.
    Where all of them are ``kept`` they go along with their points.
    """
    if not scene.labels:
        return []
    kept = kept or Kept()
    flat = _flat(np.stack([label.at for label in scene.labels]), camera, area)[:, :2]
    is_in = ((flat >= area[:2]) & (flat <= np.add(area[:2], area[2:]))).all(axis=1)  # else turned or zoomed out of it
    there = [
        ((area, k, scene.labels[k].text), scene.labels[k], (float(flat[k, 0]), float(flat[k, 1])))
        for k in map(int, np.flatnonzero(is_in))
    ]
    there.sort(key=lambda one: -one[1].size)
    if area in kept.growth and all(name in kept.beside for name, _, _ in there):
        found: list[Primitive] | None = _along(there, height, _grown(picture, kept.growth[area]), kept)
    else:
        for growth in dict.fromkeys((picture.growth, picture.growth**0.5, 1.0)):
            kept.growth[area] = growth
            is_last = growth == 1.0
            found = _placed(
                there, scene, camera, area, height, _grown(picture, growth), kept, rooms, must_be_clear=not is_last
            )
            if found is not None:
                break
    return sorted(found or (), key=lambda one: isinstance(one, Text))


def _grown(picture: Picture, growth: float) -> Picture:
    return replace(picture, scale=picture.scale * growth / picture.growth, growth=growth)


def _along(there: list[Named], height: float, picture: Picture, kept: Kept) -> list[Primitive]:
    """The labels where they are kept beside their points."""
    unit = height / 1000
    found: list[Primitive] = []
    for name, label, (x, y) in there:
        (right, below), off = kept.beside[name]
        found.extend(_drawn(label, (x, y), x + right, y + below, off, picture, unit))
    return found


def _placed(
    there: list[Named],
    scene: Scene,
    camera: Camera,
    area: Area,
    height: float,
    picture: Picture,
    kept: Kept,
    rooms: Floats,
    *,
    must_be_clear: bool,
) -> list[Primitive] | None:
    """The labels at the size of the picture's type; None: one lies over another, though none may."""
    unit = height / 1000
    discs = np.vstack([_discs(scene, camera, area), pins.discs(scene, camera, area, picture, height)])
    ground = Ground(area, discs, _samples(scene, camera, area), rooms)
    around = ground.around(np.array([at for *_, at in there]).reshape(-1, 2)).tolist()
    wishes = [_wish(label, at, clear, picture, unit) for (_, label, at), clear in zip(there, around, strict=True)]
    found: list[Primitive] = []
    for (name, label, (x, y)), place in zip(there, nearest(wishes, ground), strict=True):
        if must_be_clear and not place.is_clear:
            return None
        kept.beside[name] = (place.left - x, place.top - y), place.off
        found.extend(_drawn(label, (x, y), place.left, place.top, place.off, picture, unit))
    return found


def _size(label: Label, picture: Picture, unit: float) -> float:
    return max(label.size * picture.scale, LEAST) * unit


def _wish(label: Label, at: Point, clear: float, picture: Picture, unit: float) -> Wish:
    """A label that keeps ``clear`` of its point, besides what it would like to be apart from it."""
    wide, up, down = measure(label.text, _size(label, picture, unit))
    return Wish(at, wide, up + down, clear + _apart(label) * unit, label.away)


def _apart(label: Label) -> float:
    """How far a label would like to be from its point, in logical points."""
    return 0.5 * max(map(abs, label.away))


def _drawn(
    label: Label, at: Point, left: float, top: float, off: float, picture: Picture, unit: float
) -> list[Primitive]:
    """The words from a corner on, and the line that ties them to their point where they are far ``off``."""
    size = _size(label, picture, unit)
    wide, up, down = measure(label.text, size)
    tall = up + down
    text = Text(left, top + up, label.text, size, label.colour, opacity=label.opacity, halo=picture.background)
    if off <= LEADER:
        return [text]
    x, y = min(max(at[0], left), left + wide), min(max(at[1], top), top + tall)
    return [Stroke(at[0], at[1], x, y, label.colour, 1.4 * unit, 0.6 * label.opacity), text]


def _flat(points: Floats, camera: Camera, area: Area) -> Floats:
    """(n, 3): pixels of the whole picture, and depth."""
    return np.asarray(camera.project(points, area[2], area[3]) + np.array([area[0], area[1], 0.0]))


def _discs(scene: Scene, camera: Camera, area: Area) -> Floats:
    """(n, 3): centre and radius of every marker on the picture."""
    found = [np.zeros((0, 3))]
    for m in scene.markers:
        flat = _flat(m.points, camera, area)
        half = np.full(len(flat), camera.scale) if camera.scale else flat[:, 2] * np.tan(np.radians(camera.angle) / 2)
        found.append(np.column_stack([flat[:, :2], REACH[m.shape] * m.radius * area[3] / 2 / np.maximum(half, 1e-9)]))
    return np.vstack(found)


def _samples(scene: Scene, camera: Camera, area: Area) -> Floats:
    """(n, 2): places along the strokes; none where there are too many to keep off."""
    if sum(len(k.pairs) for k in scene.lines) > FEW:
        return np.zeros((0, 2))
    at = (np.arange(16) + 0.5)[:, None, None] / 16
    ends = [_flat(k.points[k.pairs].reshape(-1, 3), camera, area)[:, :2].reshape(-1, 2, 2) for k in scene.lines]
    both = np.concatenate([np.zeros((0, 2, 2)), *ends])
    return np.asarray(((1 - at) * both[:, 0] + at * both[:, 1]).reshape(-1, 2))

"""Words at points: none over a marker, none over other words, none outside its pane.

Each label takes the nearest free place round its point, first where it would like to be; one that
must go further is tied to its point by a thin line.
"""

from dataclasses import dataclass, field, replace
from functools import cache
from typing import TypeAlias

import numpy as np

from app.draw import pins
from app.draw.picture import Camera, Label, Picture, Scene, Shape
from app.draw.primitives import LEAST, Area, Primitive, Stroke, Text
from app.draw.type import measure
from subdivision.arrays import Floats

DIRECTIONS = np.array([
    (1, 1), (1, 0), (-1, 1), (-1, 0), (1, -1), (-1, -1), (0, 1), (0, -1),
    (0.5, 1), (-0.5, 1), (1, 0.5), (-1, 0.5), (0.5, -1), (-0.5, -1), (1, -0.5), (-1, -0.5),
])  # fmt: skip
"""Right and up, in the order of preference."""

RINGS = np.concatenate([np.arange(12) * 0.5, 6 + np.arange(14) * 2.0])
"""How much further off each round of places is, in heights of the label."""

ROUNDS = np.split(RINGS, [2, 8, 14])
"""Near places are tried first, for mostly one of them is free."""

NEARER = 3.0
"""What it costs to be further off, for each height of the label."""

OVER, MOST_OVER = 0.35, 8
"""What it costs to lie over a place of a stroke, and how many of them count."""

LEADER = 0.9
"""A label further off than this many of its heights needs a line to its point."""

REACH = {Shape.SPHERE: 1.0, Shape.DIAMOND: 1.28, Shape.CUBE: 1.2, Shape.BEAD: 1.75, Shape.HALO: 1.75}
"""How far a marker reaches, relative to its radius."""

Point: TypeAlias = tuple[float, float]

Name: TypeAlias = tuple[Area, int, str]
"""A label's pane, number and words."""

Named: TypeAlias = tuple[Name, Label, Point]
"""A label, and where its point is on the picture."""

FEW = 400
"""Up to so many strokes, labels try to keep off them."""


@dataclass(frozen=True, eq=False)
class Kept:
    """Where labels stand beside their points, filled as they are placed: given again, they go along with these.

    ``beside`` tells how far right and down a label is, and how far off in heights; ``growth`` how much the labels of
    a pane are enlarged.
    """

    beside: dict[Name, tuple[Point, float]] = field(default_factory=dict)
    growth: dict[Area, float] = field(default_factory=dict)


def placed(
    scene: Scene, camera: Camera, area: Area, height: float, picture: Picture, kept: Kept | None = None
) -> list[Primitive]:
    """The labels of a scene in its pane, the largest placed first; enlarged as far as none then covers another.

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
                there, scene, camera, area, height, _grown(picture, growth), kept, must_be_clear=not is_last
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
        size = max(label.size * picture.scale, LEAST) * unit
        wide, up, down = measure(label.text, size)
        box = np.array([x + right, y + below, wide, up + down])
        found.extend(_drawn(label, (x, y), size, box, off, picture, unit))
    return found


def _placed(
    there: list[Named],
    scene: Scene,
    camera: Camera,
    area: Area,
    height: float,
    picture: Picture,
    kept: Kept,
    *,
    must_be_clear: bool,
) -> list[Primitive] | None:
    """The labels at the size of the picture's type; None: one lies over another, though none may."""
    unit = height / 1000
    discs, strokes = _discs(scene, camera, area), _samples(scene, camera, area)
    discs = np.vstack([discs, pins.discs(scene, camera, area, picture, height)])
    around = _around(np.array([at for *_, at in there]).reshape(-1, 2), discs)
    taken = np.zeros((len(there), 4))
    found: list[Primitive] = []
    for k, ((name, label, (x, y)), clear) in enumerate(zip(there, around, strict=True)):
        size = max(label.size * picture.scale, LEAST) * unit
        box, off = _best(label, (x, y), size, clear + _apart(label) * unit, area, discs, strokes, taken[:k])
        if must_be_clear and _overlaps(box[None], taken[:k]).any():
            return None
        kept.beside[name] = (float(box[0]) - x, float(box[1]) - y), off
        taken[k] = box + np.array([-0.25, 0, 0.5, 0]) * box[3]  # words side by side read as two
        found.extend(_drawn(label, (x, y), size, box, off, picture, unit))
    return found


def _around(points: Floats, discs: Floats) -> list[float]:
    """For each point the radius of the largest marker it is in; 0: it is in none."""
    far = np.hypot(points[:, None, 0] - discs[:, 0], points[:, None, 1] - discs[:, 1])
    radii: list[float] = np.where(far < discs[:, 2], discs[:, 2], 0.0).max(axis=1, initial=0.0).tolist()
    return radii


def _apart(label: Label) -> float:
    """How far a label would like to be from its point, in logical points."""
    return 0.5 * max(map(abs, label.away))


def _best(
    label: Label, at: Point, size: float, clear: float, area: Area, discs: Floats, strokes: Floats, taken: Floats
) -> tuple[Floats, float]:
    """The box (left, top, width, height) of the nearest place that is free, and how far off it is in heights."""
    wide, up, down = measure(label.text, size)
    tall = up + down
    least, found = np.inf, (np.zeros(4), 0.0)
    for places in _rounds(label.away):
        if least <= NEARER * places.ring[0]:
            break  # whatever is further off costs more
        boxes, room = places.boxes(at, wide, tall, clear)
        marked = discs[(np.abs(discs[:, :2] - at) <= room + discs[:, 2:]).all(axis=1)]
        hard = 1e3 * (_outside(boxes, area) + 4 * _overlaps(boxes, taken) + _covered(boxes, marked))
        without = places.price + hard
        likely = np.flatnonzero(without <= min(without.min() + OVER * MOST_OVER, least))  # no other can be the best
        if not len(likely):
            continue
        cost = places.price[likely] + OVER * np.minimum(_inside(boxes[likely], strokes), MOST_OVER) + hard[likely]
        best = int(np.argmin(cost))
        if cost[best] < least:
            least, found = float(cost[best]), (boxes[likely[best]], float(places.ring[likely[best]]))
    return found


@dataclass(frozen=True, eq=False)
class _Places:
    """Places round a point: ``ring`` (n,) heights of the label off, ``way`` (n, 2) right and down, ``price`` (n,).

    ``part`` (n,) is how much of the room round the point they keep: on the diagonal a corner of the label touches the
    marker, so it may come nearer than a side.
    """

    ring: Floats
    way: Floats
    part: Floats
    price: Floats

    def boxes(self, at: Point, wide: float, tall: float, clear: float) -> tuple[Floats, Floats]:
        """(n, 4): left, top, width, height of a label there; and how far from the point any of them reaches."""
        reach = clear * self.part + self.ring * tall
        extent = np.array([wide, tall])
        off = self.way * (reach[:, None] + np.array([wide, tall * 0.8]) / 2)
        found = np.empty((len(off), 4))
        found[:, :2], found[:, 2:] = np.array(at) + off - extent / 2, extent
        return found, extent + float(reach.max())


@cache
def _rounds(away: tuple[float, float]) -> tuple[_Places, ...]:
    """The places for labels that would like to be there, the near ones first."""
    first = np.array(away) / max(*np.abs(away), 1e-9)
    ways = np.vstack([first, DIRECTIONS]) if max(*np.abs(away)) else DIRECTIONS
    found = []
    for rings in ROUNDS:
        ring, turn = (m.ravel() for m in np.meshgrid(rings, np.arange(len(ways)), indexing="ij"))
        way = ways[turn]
        part = np.where(np.abs(way).min(axis=1) > 0.3, 0.75, 1.0)
        found.append(_Places(ring, way * [1, -1], part, ring * NEARER + turn * 0.12))
    return tuple(found)


def _drawn(
    label: Label, at: Point, size: float, box: Floats, off: float, picture: Picture, unit: float
) -> list[Primitive]:
    _, up, _ = measure(label.text, size)
    left, top, wide, tall = map(float, box)
    text = Text(left, top + up, label.text, size, label.colour, opacity=label.opacity, halo=picture.background)
    if off <= LEADER:
        return [text]
    x, y = float(np.clip(at[0], left, left + wide)), float(np.clip(at[1], top, top + tall))
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


def _outside(boxes: Floats, area: Area) -> Floats:
    low, high = boxes[:, :2] - area[:2], np.array([area[0] + area[2], area[1] + area[3]]) - boxes[:, :2] - boxes[:, 2:]
    return np.asarray(50.0 * (np.minimum(low, high).min(axis=1) < 0))


def _overlaps(boxes: Floats, taken: Floats) -> Floats:
    """(n,): how many of the taken boxes each box overlaps."""
    far = boxes[:, :2] + boxes[:, 2:]
    end = taken[:, :2] + taken[:, 2:]
    meet = np.ones((len(boxes), len(taken)), dtype=bool)
    for k in (0, 1):
        meet &= (boxes[:, k, None] < end[:, k]) & (taken[:, k] < far[:, k, None])
    return np.asarray(meet.sum(axis=1), dtype=float)


def _covered(boxes: Floats, discs: Floats) -> Floats:
    """(n,): how many markers each box covers, at least in part."""
    far = boxes[:, :2] + boxes[:, 2:]
    x, y = (np.clip(discs[:, k], boxes[:, k, None], far[:, k, None]) - discs[:, k] for k in (0, 1))
    return np.asarray((x * x + y * y < discs[:, 2] ** 2).sum(axis=1), dtype=float)


def _inside(boxes: Floats, points: Floats) -> Floats:
    """(n,): how many of the points lie in each box."""
    if not len(points):
        return np.zeros(len(boxes))
    x, y, wide, tall = (boxes[:, k, None] for k in range(4))
    across, down = points[:, 0] - x, points[:, 1] - y
    return np.asarray(((across >= 0) & (across <= wide) & (down >= 0) & (down <= tall)).sum(axis=1), dtype=float)

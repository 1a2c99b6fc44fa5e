"""Shapes to remember, modelled by hand in quads: a rubber duck, a coffee mug and a chess pawn."""

import numpy as np

from subdivision.shapes.build import mesh, turns
from subdivision.shapes.clay import Clay, Point
from subdivision.topology import INFINITELY_SHARP
from subdivision.trace import Mesh

SIDES = 8
"""How many points a turned ring has."""


def duck() -> Mesh:
    """A rubber duck looking along the x axis, pulled out of a box: V/E/F 80/156/78.

    Valence 4 at 40 vertices, 3 at 26, 5 at 10 and 6 at 4.
    """
    body = [
        _frame(-1.5, 0.55, 0.0, 0.7),
        _frame(-0.9, 1.05, -0.75, 0.75),
        _frame(0.35, 1.2, -0.9, 0.7),
        _frame(1.45, 0.75, -0.55, 0.55),
    ]
    clay = Clay.tube(body).with_face(3, 2, 1, 0).with_face(12, 13, 14, 15)
    left, right, top, back = 5, 7, 10, 12
    clay = clay.pulled(back, [(-2.2, -0.35, 1.2), (-2.2, 0.35, 1.2), (-2.05, 0.35, 0.85), (-2.05, -0.35, 0.85)])
    for face, side in ((left, 1.0), (right, -1.0)):
        clay = _wing(clay, face, side)
    clay = clay.pulled(top, _floor(0.3, 1.15, 0.5, 0.9))
    clay = clay.pulled(top, _floor(0.0, 1.45, 0.85, 1.2))
    lower = len(clay.faces)
    clay = clay.pulled(top, _floor(-0.05, 1.5, 0.95, 1.75))
    upper = len(clay.faces)
    clay = clay.pulled(top, _floor(0.15, 1.2, 0.65, 2.45))
    clay = _beak(clay, lower + 2)
    for face, side in ((upper + 3, 1.0), (upper + 1, -1.0)):
        clay = _eye(clay, face, side)
    return mesh(clay.centred(), clay.faces)


def mug() -> Mesh:
    """A coffee mug, by topology a torus, for its handle (V - E + F = 0): V/E/F 102/204/102.

    Valence 4 at 86 vertices, 3 at 8 and 5 at 8: they make up for each other.
    """
    outside = [(0.0, -1.1), (0.85, -1.1), (0.98, -0.9), (0.95, -0.3), (0.95, 0.3), (0.95, 0.85), (1.02, 1.1)]
    inside = [(0.86, 1.1), (0.78, 0.8), (0.78, -0.65), (0.6, -0.85), (0.0, -0.85)]
    clay = _turned([*outside, *inside])
    low, high = SIDES + SIDES - 1, 3 * SIDES + SIDES - 1  # the sides that look along x
    for lower, upper in (
        ((1.25, -0.72), (1.25, -0.45)),
        ((1.72, -0.6), (1.5, -0.32)),
        ((1.88, 0.0), (1.6, 0.02)),
        ((1.75, 0.62), (1.5, 0.38)),
    ):
        clay = clay.pulled(low, _strap(lower, upper))
    clay = clay.pulled(high, _strap((1.25, 0.46), (1.25, 0.73)))
    clay = clay.joined(low, high, turn=3)
    return mesh(clay.centred(), clay.faces)


def pawn() -> Mesh:
    """A chess pawn of eight-sided rings, edged by semi-sharp creases [DKT98]_: V/E/F 90/176/88.

    From the foot up, sharpness 10, 3 and 1; about the collar 3 and 2.  Valence 4 but for four vertices of each lid.
    """
    foot = [(0.0, -1.7), (1.0, -1.7), (1.0, -1.35), (0.8, -1.15), (0.48, -0.75), (0.34, 0.1)]
    head = [(0.7, 0.3), (0.66, 0.44), (0.36, 0.55), (0.62, 0.8), (0.66, 1.2), (0.4, 1.55), (0.0, 1.72)]
    clay = _turned([*foot, *head])
    sharpness = {0: INFINITELY_SHARP, 1: 3.0, 2: 1.0, 5: 3.0, 6: 2.0}
    creases = {
        (SIDES * ring + k, SIDES * ring + (k + 1) % SIDES): sharp
        for ring, sharp in sharpness.items()
        for k in range(SIDES)
    }
    return mesh(clay.centred(), clay.faces, creases)


def _turned(profile: list[tuple[float, float]]) -> Clay:
    """A closed surface about the z axis through (radius, height); the first and last are the lids' middles."""
    angles = turns(SIDES, start=0.5)
    rings: list[list[Point]] = [[(r * np.cos(a), r * np.sin(a), z) for a in angles] for r, z in profile[1:-1]]
    below, above = range(SIDES), range(SIDES * (len(rings) - 1), SIDES * len(rings))
    clay = Clay.tube(rings).with_lid([*reversed(below)], (0.0, 0.0, profile[0][1]))
    return clay.with_lid(above, (0.0, 0.0, profile[-1][1]))


def _strap(lower: tuple[float, float], upper: tuple[float, float]) -> list[Point]:
    """The cross-section of a handle in the x-z plane, from its lower edge to its upper one."""
    (x, z), (u, w) = lower, upper
    return [(x, -0.17, z), (x, 0.17, z), (u, 0.17, w), (u, -0.17, w)]


def _wing(clay: Clay, face: int, side: float) -> Clay:
    """Out of a side of the body, then back and up."""
    near = [(-0.65, 1.4, -0.3), (-0.75, 1.4, 0.4), (0.15, 1.4, 0.35), (0.15, 1.4, -0.3)]
    far = [(-1.35, 1.65, 0.35), (-1.45, 1.6, 0.65), (-0.7, 1.6, 0.5), (-0.7, 1.65, 0.2)]
    for corners in (near, far):
        clay = clay.pulled(face, _mirrored(corners, side))
    return clay


def _beak(clay: Clay, face: int) -> Clay:
    """A smaller square in the face, pulled forward, then again: wide, flat and turned up."""
    for x, width, low, high in ((1.55, 0.55, 1.2, 1.6), (1.8, 0.5, 1.28, 1.5), (2.4, 0.6, 1.42, 1.6)):
        clay = clay.pulled(face, [(x, -width, low), (x, width, low), (x, width, high), (x, -width, high)])
    return clay


def _eye(clay: Clay, face: int, side: float) -> Clay:
    """A small square in the cheek, then a button pulled out of it."""
    for y, size in ((0.7, 0.19), (0.86, 0.17)):
        front, back, low, high = 0.95 + size, 0.95 - size, 1.95 - size, 1.95 + size
        square = [(front, y, low), (back, y, low), (back, y, high), (front, y, high)]
        clay = clay.pulled(face, _mirrored(square, side))
    return clay


def _floor(x0: float, x1: float, width: float, z: float) -> list[Point]:
    """A level rectangle in the corner order of the faces on top of a tube along x."""
    return [(x0, width, z), (x0, -width, z), (x1, -width, z), (x1, width, z)]


def _frame(x: float, width: float, low: float, high: float) -> list[Point]:
    """A rectangle across the x axis, counter-clockwise as seen from its far end."""
    return [(x, -width, low), (x, width, low), (x, width, high), (x, -width, high)]


def _mirrored(corners: list[Point], side: float) -> list[Point]:
    """``corners`` of a face at the left, or the same for the face opposite at the right."""
    mirrored = [(x, side * y, z) for x, y, z in corners]
    return mirrored if side > 0 else [mirrored[k] for k in (1, 0, 3, 2)]

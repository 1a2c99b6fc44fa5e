"""How things in space look, whichever painter paints them: lights, marker shapes, dashes."""

import numpy as np

from app.draw.picture import Camera, Faces
from subdivision.arrays import Floats

LIGHTS = (((-0.75, 0.8, 0.65), 0.8), ((0.9, -0.35, 0.7), 0.24))
"""A soft light over the left shoulder and a weak one from the right below: direction (right, up, towards the eye) and
intensity.  They go with the camera."""

SURFACE_LIGHT, MARKER_LIGHT = (0.46, 0.7), (0.66, 0.46)
"""What a surface and a marker show without light, and what light adds."""

HIDDEN = 0.17
"""How much of a hidden marker is seen."""

DASH = 11.0
"""Length of a dash in logical points, at the distance of the camera's focal point."""

# Marker shapes, each about as heavy as a ball of radius 1.
BEAD, RING = 0.78, (1.5, 0.2)
"""A bead's ball; the radius and the thickness of its ring."""

RING_AXIS = np.array([0.32, -0.42, 0.85])
"""The ring of a bead leans, so that it reads as a ring from the side and from above."""

HALO_RADIUS = 1.75
"""Outer radius of a halo; its inner radius is ``HALO_INSIDE`` of it."""

HALO_INSIDE = 0.85

_NO_COLOUR = (0.0, 0.0, 0.0)

OCTAHEDRON = Faces(
    1.28 * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float),
    np.full(8, 3),
    np.array([0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5]),
    _NO_COLOUR,
)
CUBE = Faces(
    0.84 * np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], dtype=float),
    np.full(6, 4),
    np.array([0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6]),
    _NO_COLOUR,
)
"""Corners counter-clockwise from outside."""


def dash_of(camera: Camera) -> float:
    """The length of a dash in space; it depends on the camera of the lesson, so it stays while the user turns."""
    half = camera.scale or float(np.linalg.norm(camera.position - camera.focal)) * np.tan(np.radians(camera.angle) / 2)
    return float(DASH / 1000 * 2 * half)


def across(axis: Floats) -> tuple[Floats, Floats]:
    """Two unit vectors at right angles to a unit ``axis`` and to each other."""
    u = np.cross(axis, [1.0, 0.0, 0.0] if abs(axis[0]) < 0.9 else [0.0, 1.0, 0.0])
    u = u / np.linalg.norm(u)
    return u, np.cross(axis, u)


def lit(normals: Floats, amount: tuple[float, float]) -> Floats:
    """(n,): how bright a side is with its unit normal (right, up, towards the eye); 1 shows the colour as it is."""
    ambient, diffuse = amount
    glow = np.full(len(normals), ambient)
    for position, intensity in LIGHTS:
        direction = np.array(position) / np.linalg.norm(position)
        glow += diffuse * intensity * np.maximum(normals @ direction, 0.0)
    return glow

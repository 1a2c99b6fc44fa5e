"""A scene as SVG shapes.

Surfaces are painted from back to front.  Strokes are cut where surfaces hide them, and drawn on top with
the markers; a hidden marker is faint.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from app.draw.depth import Depth, depth_of
from app.draw.geometry import dashes, face_colours, facets, normals
from app.draw.layout import fitted
from app.draw.markup import code, number, places, shone
from app.draw.picture import Camera, Colour, Faces, Lines, Markers, Scene, Shape
from app.draw.primitives import Area
from app.draw.solid import (
    BEAD,
    CUBE,
    HALO_INSIDE,
    HALO_RADIUS,
    HIDDEN,
    MARKER_LIGHT,
    OCTAHEDRON,
    RING,
    RING_AXIS,
    SURFACE_LIGHT,
    across,
    dash_of,
    lit,
)
from subdivision.arrays import Floats, Indices

PIECES = 24
"""How finely strokes are cut to find where they are hidden: pieces for each stroke that is as long as the pane."""

SLACK = 0.012
"""How far behind a surface something counts as on it, relative to the width of the view."""


@dataclass(frozen=True, eq=False)
class _View:
    """How space gets onto a pane."""

    camera: Camera
    area: Area
    depth: Depth
    slack: float

    def project(self, points: Floats) -> Floats:
        """(n, 3): pixels of the pane, and depth."""
        return self.camera.project(points, self.area[2], self.area[3])

    def per_unit(self, depth: Floats) -> Floats:
        """(n,): how many pixels a unit of space is at a depth."""
        tangent = np.tan(np.radians(self.camera.angle) / 2)
        half = np.full(len(depth), self.camera.scale) if self.camera.scale else np.maximum(depth, 1e-9) * tangent
        return np.asarray(self.area[3] / 2 / half)


def projected(scene: Scene, area: Area, height: float, name: str) -> Iterator[str]:
    """The group of a scene in its pane; ``name`` is that of the pane's outline."""
    camera = fitted(scene.camera, area)
    corners, owners = _triangles(scene, camera, area)
    span = 2 * (camera.scale or np.linalg.norm(camera.position - camera.focal) * np.tan(np.radians(camera.angle) / 2))
    view = _View(camera, area, depth_of(corners, area[2], area[3]), float(SLACK * span))
    x, y, w, h = (number(v) for v in area)
    yield f'<defs><clipPath id="{name}"><rect width="{w}" height="{h}"/></clipPath></defs>'
    yield f'<g transform="translate({x} {y})"><g clip-path="url(#{name})" stroke-linejoin="round">'
    yield from _surfaces(scene, view, owners)
    for lines in scene.lines:
        yield from _strokes(dashes(lines, dash_of(scene.camera)) if lines.dashed else lines, view, height)
    yield from _markers(scene.markers, view)
    yield "</g></g>"


def _triangles(scene: Scene, camera: Camera, area: Area) -> tuple[Floats, Indices]:
    """Triangles of the solid surfaces on the pane, and for each the number of its polygon among all."""
    corners, owners, before = [np.zeros((0, 3, 3))], [np.zeros(0, dtype=np.intp)], 0
    for faces in scene.faces:
        if faces.opacity >= 1:
            cut = facets(faces)
            corners.append(camera.project(cut.points, area[2], area[3])[cut.triangles])
            owners.append(before + cut.owner)
        before += len(faces.sizes)
    return np.concatenate(corners), np.concatenate(owners)


def _surfaces(scene: Scene, view: _View, owners: Indices) -> Iterator[str]:
    """Polygons from back to front; what is wholly hidden is left out."""
    seen = np.unique(owners[view.depth.owner[view.depth.owner >= 0]])
    found: list[tuple[float, str]] = []
    before = 0
    for faces in scene.faces:
        for f, text, away in _polygons(faces, view):
            if faces.opacity < 1 or before + f in seen:
                found.append((-away, text))
        before += len(faces.sizes)
    yield from (text for _, text in sorted(found, key=lambda one: one[0]))


def _polygons(faces: Faces, view: _View) -> Iterator[tuple[int, str, float]]:
    flat = view.project(faces.points)
    facing = normals(faces) @ view.camera.axes.T
    facing = facing * np.where(facing[:, 2:] < 0, -1.0, 1.0)
    glow = lit(facing, SURFACE_LIGHT)
    ends = np.cumsum(faces.sizes)
    own = None if faces.colours is None else face_colours(faces, faces.colours)
    for f, (end, size) in enumerate(zip(ends, faces.sizes, strict=True)):
        corners = flat[faces.corners[end - size : end]]
        plain = faces.colour if own is None else (own[f, 0], own[f, 1], own[f, 2])
        colour = code(shone(plain, glow[f]))
        # A thin rim of its own colour closes the hairlines between neighbours.
        rim = f' stroke="{colour}" stroke-width="0.7"' if faces.opacity >= 1 else f' opacity="{number(faces.opacity)}"'
        yield f, f'<polygon points="{places(corners)}" fill="{colour}"{rim}/>', float(corners[:, 2].mean())


def _strokes(lines: Lines, view: _View, height: float) -> Iterator[str]:
    """The visible stretches of all strokes of a kind, as one path."""
    ends = view.project(lines.points)[lines.pairs]
    data: list[str] = []
    lengths = np.linalg.norm(ends[:, 1, :2] - ends[:, 0, :2], axis=1)
    counts = np.clip(np.ceil(lengths / max(view.area[2:]) * PIECES * 8), 1, 400).astype(np.intp)
    owner = np.repeat(np.arange(len(ends)), counts)
    k = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    t = ((k + 0.5) / counts[owner])[:, None]
    shown = view.depth.shows((1 - t) * ends[owner, 0] + t * ends[owner, 1], view.slack)
    for pair, pieces in zip(ends, np.split(shown, np.cumsum(counts))[:-1], strict=True):
        edges = np.flatnonzero(np.diff(np.concatenate([[0], pieces.astype(int), [0]])))
        for start, stop in edges.reshape(-1, 2) / len(pieces):
            a, b = (pair[0, :2] * (1 - at) + pair[1, :2] * at for at in (start, stop))
            data.append(f"M{number(a[0])} {number(a[1])}L{number(b[0])} {number(b[1])}")
    if data:
        opacity = f' opacity="{number(lines.opacity)}"' if lines.opacity < 1 else ""
        width = number(lines.width * height / 1000)
        cap = "butt" if lines.dashed else "round"
        yield (
            f'<path d="{"".join(data)}" fill="none" stroke="{code(lines.colour)}" stroke-width="{width}"'
            f' stroke-linecap="{cap}"{opacity}/>'
        )


def _markers(groups: Iterable[Markers], view: _View) -> Iterator[str]:
    """All markers from back to front."""
    found: list[tuple[float, str]] = []
    for m in groups:
        flat = view.project(m.points)
        size = m.radius * view.per_unit(flat[:, 2])
        slack = view.slack + 1.8 * m.radius.max(initial=0.0)
        shown = view.depth.shows(flat, slack)
        front = flat[:, 2] - m.radius  # of two at one place the larger is seen
        for (x, y, _), away, r, opacity, is_seen in zip(flat, front, size, m.opacity, shown, strict=True):
            strength = float(opacity) if is_seen else HIDDEN * float(opacity)
            inner = "".join(_marker(m.shape, m.colour, float(r), view.camera.axes))
            faint = f' opacity="{number(strength)}"' if strength < 1 else ""
            found.append((-away, f'<g transform="translate({number(x)} {number(y)})"{faint}>{inner}</g>'))
    yield from (text for _, text in sorted(found, key=lambda one: one[0]))


def _marker(shape: Shape, colour: Colour, r: float, axes: Floats) -> Iterator[str]:
    if shape in (Shape.DIAMOND, Shape.CUBE):
        yield from _sides(OCTAHEDRON if shape is Shape.DIAMOND else CUBE, colour, r, axes)
        return
    if shape is Shape.BEAD:
        behind, before = _ring(axes, r)
        stroke = f'fill="none" stroke="{code(colour)}" stroke-width="{number(2 * RING[1] * r)}"'
        yield f'<path d="{behind}" {stroke}/>'
        yield from _ball(colour, BEAD * r)
        yield f'<path d="{before}" {stroke}/>'
        return
    yield from _ball(colour, r)
    if shape is Shape.HALO:
        middle, width = HALO_RADIUS * (1 + HALO_INSIDE) / 2, HALO_RADIUS * (1 - HALO_INSIDE)
        stroke = f'stroke="{code(colour)}" stroke-width="{number(width * r)}"'
        yield f'<circle r="{number(middle * r)}" fill="none" {stroke}/>'


def _ball(colour: Colour, r: float) -> Iterator[str]:
    """A disc with a lighter spot where the light comes from."""
    yield f'<circle r="{number(r)}" fill="{code(shone(colour, 0.92))}"/>'
    red, green, blue = (0.62 * c + 0.38 for c in colour)
    at = f'cx="{number(-0.3 * r)}" cy="{number(-0.34 * r)}" r="{number(0.3 * r)}"'
    yield f'<circle {at} fill="{code((red, green, blue))}" opacity="0.55"/>'


def _sides(solid: Faces, colour: Colour, r: float, axes: Floats) -> Iterator[str]:
    """The sides of a small solid that face the eye."""
    flat = solid.points @ axes.T * r * [1, -1, 1]
    facing = normals(solid) @ axes.T
    glow = lit(facing, MARKER_LIGHT)
    size = int(solid.sizes[0])
    for k, corners in enumerate(solid.corners.reshape(-1, size)):
        if facing[k, 2] > 1e-6:
            shade = code(shone(colour, glow[k]))
            yield f'<polygon points="{places(flat[corners])}" fill="{shade}" stroke="{shade}" stroke-width="0.4"/>'


def _ring(axes: Floats, r: float) -> tuple[str, str]:
    """The half of a bead's ring behind its ball, and the half before it, as path data."""
    axis = axes @ (RING_AXIS / np.linalg.norm(RING_AXIS))
    right = np.array([-axis[1], axis[0], 0.0])
    length = np.linalg.norm(right)
    right = right / length if length > 1e-9 else across(axis)[0]
    down = np.cross(axis, right)
    half = np.linspace(0, np.pi, 17)[:, None]
    parts = [RING[0] * r * (np.cos(half) * right + sign * np.sin(half) * down) for sign in (1, -1)]
    parts.sort(key=lambda part: float(part[8, 2]))
    behind, before = ("M" + "L".join(f"{number(x)} {number(-y)}" for x, y, _ in part) for part in parts)
    return behind, before

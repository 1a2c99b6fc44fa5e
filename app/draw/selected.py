"""What is picked of a control object, pointed out on the scene that shows it."""

from dataclasses import replace

import numpy as np

from app.draw.picture import Faces, Lines, Markers, Scene, Shape
from app.draw.theme import Theme, mixed
from app.state import Picked, State
from lessons.script import View
from subdivision import Mesh, Polyline
from subdivision.arrays import Indices, Mask, next_corners

PICKED = "picked"
"""The name of its markers."""

WIDTH, WIDER, MORE = 9.0, 1.6, 3.0
"""Of a picked edge that was not drawn, in logical points; one that was becomes so many times as wide, and so much."""

TINT = 0.5
"""How much of the selection's colour a picked face takes on."""

INSET = 0.12
"""How far within a picked face its outline is drawn over a finer surface: part of the way to its middle."""

AMID = 0.03
"""Radius of a marker where there are no others, relative to half the diagonal of the control object."""


def is_pickable(state: State, view: View) -> bool:
    """Whether a view shows the control object itself, so that its parts can be picked."""
    return view.at(state.progress) == 0 or state.options.control


def selected(scene: Scene, control: Mesh, picked: Picked, theme: Theme, *, is_control: bool) -> Scene:
    """The scene with what is picked in the selection's colour; ``is_control``: its surface is the control object's."""
    t, numbers = control.topology, np.array(picked.numbers, dtype=np.intp)
    if picked.kind == "vertex":
        return _with_markers(scene, control, numbers[numbers < t.n_vertices], theme, 1.5)
    if picked.kind == "edge":
        pairs = t.ends[numbers[numbers < t.n_edges]]
        return _with_place(_with_strokes(scene, control, pairs, theme), control, picked, theme)
    chosen = np.isin(np.arange(t.n_faces), numbers)
    if is_control:
        return replace(scene, faces=tuple(part for f in scene.faces for part in _parted(f, chosen[~t.hidden], theme)))
    faces = _only(Faces(control.points, t.face_sizes, t.origin, theme.selection), chosen)
    return replace(scene, lines=(*scene.lines, _outlined(faces, theme)))


def _with_strokes(scene: Scene, control: Mesh, pairs: Indices, theme: Theme) -> Scene:
    """The scene with some edges of the control object wider, in the selection's colour; drawn if they were not."""
    chosen = set(map(tuple, pairs.tolist()))
    rest: list[Lines] = []
    found: list[Lines] = []
    for lines in scene.lines:
        is_net = len(lines.points) == len(control.points) and not lines.dashed
        picked = np.array([is_net and pair in chosen for pair in map(tuple, lines.pairs.tolist())], dtype=np.bool_)
        rest.append(replace(lines, pairs=lines.pairs[~picked]))
        width = WIDER * lines.width + MORE * theme.stroke
        found.append(Lines(lines.points, lines.pairs[picked], theme.selection, width))
    found = [lines for lines in found if len(lines.pairs)] or [
        Lines(control.points, pairs, theme.selection, WIDTH * theme.stroke)
    ]
    return replace(scene, lines=(*(lines for lines in rest if len(lines.pairs)), *found))


def _outlined(faces: Faces, theme: Theme) -> Lines:
    """The outline of every face, a little within it."""
    owner = np.repeat(np.arange(len(faces.sizes)), faces.sizes)
    corners = faces.points[faces.corners]
    middles = np.stack([np.bincount(owner, axis) for axis in corners.T], axis=1) / faces.sizes[:, None]
    points = corners + INSET * (middles[owner] - corners)
    pairs = np.stack([np.arange(len(corners)), next_corners(faces.sizes)], axis=1)
    return Lines(points, pairs, faces.colour, WIDTH / 2 * theme.stroke)


def _with_markers(scene: Scene, control: Mesh, numbers: Indices, theme: Theme, size: float) -> Scene:
    radius = np.full(len(numbers), size * radius_of(scene, control))
    none = np.full(len(numbers), -1)
    halo = Markers(
        control.points[numbers], Shape.HALO, theme.selection, radius, np.ones(len(numbers)), none, PICKED
    )  # fmt: skip
    return replace(scene, markers=(*scene.markers, halo))


def _with_place(scene: Scene, control: Mesh, picked: Picked, theme: Theme) -> Scene:
    """The scene with a dot where a point would be inserted into a polygon."""
    if not isinstance(control.topology, Polyline):
        return scene
    a, b = control.points[control.topology.ends[picked.numbers[-1]]]
    at, radius = (1 - picked.along) * a + picked.along * b, np.array([radius_of(scene, control)])
    dot = Markers(at[None], Shape.SPHERE, theme.selection, radius, np.ones(1), np.full(1, -1), PICKED)
    return replace(scene, markers=(*scene.markers, dot))


def radius_of(scene: Scene, control: Mesh) -> float:
    """As large as the markers that are there."""
    found = [float(m.radius.max()) for m in scene.markers if len(m.radius)]
    return max(found, default=AMID * float(np.linalg.norm(np.ptp(control.points, axis=0))) / 2)


def _parted(faces: Faces, chosen: Mask, theme: Theme) -> tuple[Faces, ...]:
    """The faces that are not chosen, and those that are in their colour."""
    if len(faces.sizes) != len(chosen):
        return (faces,)
    tinted = replace(_only(faces, chosen), colour=mixed(faces.colour, theme.selection, TINT))
    return tuple(part for part in (_only(faces, ~chosen), tinted) if len(part.sizes))


def _only(faces: Faces, chosen: Mask) -> Faces:
    """Some of the faces."""
    return replace(faces, sizes=faces.sizes[chosen], corners=faces.corners[np.repeat(chosen, faces.sizes)])

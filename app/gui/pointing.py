"""Which point, edge or face the mouse means."""

import numpy as np

from app.draw.geometry import facets
from app.draw.picture import Camera, Faces, Scene
from app.draw.primitives import Area
from app.state import Picked
from subdivision import Grid, Mesh
from subdivision.arrays import Floats
from subdivision.rows import shown_faces

REACH = 14.0
"""How near to a marker the mouse must be to mean it, in pixels."""

EDGE_REACH = 8.0
"""The same for an edge."""

BEHIND = 0.15
"""How far behind a face an edge still lies on it, relative to half the diagonal of the control object."""

AS_NEAR = 4.0
"""Markers whose distances differ by no more pixels are equally near: the one in front is meant."""


def nearest(scene: Scene, camera: Camera, area: Area, x: float, y: float) -> tuple[int, int] | None:
    """After how many stages (-1: now), and the number of, the point whose marker is nearest to a place, if near."""
    found = [(m.points, m.ids, np.full(len(m.ids), m.stage)) for m in scene.markers if (m.ids >= 0).any()]
    if not found:
        return None
    points, ids, stages = (np.concatenate(each) for each in zip(*found, strict=True))
    flat = camera.project(points, area[2], area[3]) + np.array([area[0] - x, area[1] - y, 0.0])
    apart = np.where(ids >= 0, np.hypot(flat[:, 0], flat[:, 1]), np.inf)
    near = np.flatnonzero(apart < min(REACH, float(apart.min()) + AS_NEAR))
    if not near.size:
        return None
    chosen = near[np.argmin(flat[near, 2])]
    return int(stages[chosen]), int(ids[chosen])


def part(control: Mesh, camera: Camera, area: Area, x: float, y: float, *, is_solid: bool) -> Picked | None:
    """The edge of a control object that is near to a place, else the face there; ``is_solid``: faces hide edges.

    A net has only points to be picked.
    """
    if isinstance(control.topology, Grid):
        return None
    here = np.array([area[0] - x, area[1] - y, 0.0])
    face, depth = _face(control, camera, area, here)
    slack = BEHIND * float(np.linalg.norm(np.ptp(control.points, axis=0))) / 2
    return _edge(control, camera, area, here, depth + slack if is_solid else np.inf) or face


def _edge(control: Mesh, camera: Camera, area: Area, here: Floats, farthest: float) -> Picked | None:
    """The nearest edge no farther away than ``farthest``, the one in front where two are equally near."""
    flat = camera.project(control.points, area[2], area[3]) + here
    a, b = flat[control.topology.ends[:, 0]], flat[control.topology.ends[:, 1]]
    way = b[:, :2] - a[:, :2]
    t = np.clip(-(a[:, :2] * way).sum(axis=1) / np.maximum((way**2).sum(axis=1), 1e-12), 0.0, 1.0)
    apart = np.linalg.norm(a[:, :2] + t[:, None] * way, axis=1)
    along = t if camera.scale else t * a[:, 2] / np.maximum(t * a[:, 2] + (1 - t) * b[:, 2], 1e-12)
    depth = (1 - along) * a[:, 2] + along * b[:, 2]
    apart = np.where((depth <= farthest) & (np.minimum(a[:, 2], b[:, 2]) > 0), apart, np.inf)
    near = np.flatnonzero(apart < min(EDGE_REACH, float(apart.min(initial=np.inf)) + AS_NEAR))
    if not near.size:
        return None
    chosen = int(near[np.argmin(depth[near])])
    return Picked("edge", (chosen,), float(along[chosen]))


def _face(control: Mesh, camera: Camera, area: Area, here: Floats) -> tuple[Picked | None, float]:
    """The face in front at a place, and how far away it is there."""
    sizes, corners = shown_faces(control.topology)
    if not len(sizes):
        return None, np.inf
    cut = facets(Faces(control.points, sizes, corners, (0.0, 0.0, 0.0)))
    a, b, c = ((camera.project(cut.points, area[2], area[3]) + here)[cut.triangles[:, k]] for k in range(3))
    shares = np.stack([_turn(b, c), _turn(c, a), _turn(a, b)], axis=1)
    total = shares.sum(axis=1)
    depths = np.stack([a[:, 2], b[:, 2], c[:, 2]], axis=1)
    hit = np.flatnonzero((shares * np.sign(total)[:, None] >= 0).all(axis=1) & (total != 0) & (depths > 0).all(axis=1))
    if not hit.size:
        return None, np.inf
    shares, depths = shares[hit] / total[hit, None], depths[hit]
    away = (shares * depths).sum(axis=1) if camera.scale else 1 / (shares / depths).sum(axis=1)
    front = int(np.argmin(away))
    numbers = np.flatnonzero(~control.topology.hidden)
    return Picked("face", (int(numbers[cut.owner[hit[front]]]),)), float(away[front])


def _turn(a: Floats, b: Floats) -> Floats:
    """Twice the area of the triangles from the place of the mouse, with its sign."""
    return np.asarray(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])

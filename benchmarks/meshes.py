"""Control meshes of any size, made here: solids, and closed, open and creased meshes of every valence."""

import numpy as np
from scipy.spatial import ConvexHull, KDTree

from benchmarks.files import Control
from subdivision import Mesh, Topology, shapes, subdivide
from subdivision.arrays import inverse
from subdivision.schemes import CATMULL_CLARK


def solid(name: str) -> Control:
    mesh = shapes.SHAPES[name]()
    return _control(name, mesh.points, np.array(mesh.surface.loops()))


def ball(n: int) -> Control:
    """The hull of ``n`` random points of a sphere: closed, triangles, valence 3 to 12 or so."""
    points = np.random.default_rng(n).normal(size=(n, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    faces = ConvexHull(points).simplices.astype(np.intp)
    a, b, c = (points[faces[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a) < 0
    faces[inward] = faces[inward][:, ::-1]
    return _control(f"ball of {n} points", points, faces)


def along(control: Control) -> Control:
    """Numbered along its surface, as meshes that were modelled or scanned are: neighbours are near in memory."""
    order = KDTree(control.points, leafsize=8).indices
    faces = inverse(order)[control.faces]
    faces = faces[np.lexsort((faces.max(axis=1), faces.min(axis=1)))]
    return _control(f"{control.name}, in order", control.points[order], faces)


def opened(control: Control) -> Control:
    """Without the faces of a band of bites: a boundary through one face in twenty or so."""
    middle = control.points[control.faces].mean(axis=1)
    kept = control.faces[~((np.abs(middle[:, 2]) < 0.05) & (middle[:, 0] > 0))]
    used = np.unique(kept)
    number = np.zeros(len(control.points), dtype=np.intp)
    number[used] = np.arange(len(used))
    return _control(f"{control.name}, open", control.points[used], number[kept])


def creased(control: Control, sharpness: float) -> Control:
    """With creases all round, where three planes part its faces."""
    t = Topology.from_corners(control.sizes, control.corners)
    side = control.points[control.faces].mean(axis=1) > 0
    h = np.flatnonzero(t.twin > np.arange(t.n_halfedges))
    h = h[(side[t.face[h]] != side[t.face[t.twin[h]]]).any(axis=1)]
    creases = np.stack([t.origin[h], t.origin[t.next[h]]], axis=1)
    name = f"{control.name}, creases of {sharpness:g}"
    return Control(name, control.points, control.sizes, control.corners, creases, sharpness)


def quadrangulated(control: Control) -> Control:
    """All quads, by one step of Catmull-Clark."""
    made = subdivide(Mesh(Topology.from_corners(control.sizes, control.corners), control.points), CATMULL_CLARK, 1)
    return _control(f"quads of a {control.name}", made.points, made.topology.origin.reshape(-1, 4))


def _control(name: str, points: np.ndarray, faces: np.ndarray) -> Control:
    sizes = np.full(len(faces), faces.shape[1], dtype=np.intp)
    return Control(name, np.array(points), sizes, faces.ravel().astype(np.intp), np.zeros((0, 2), dtype=np.intp))

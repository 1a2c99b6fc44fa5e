"""Measurements of control objects as they stand: angles, distances, counts.

They read positions and connectivity only, so they hold for meshes and nets, at every level and between two stages.
"""

from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array

from subdivision.arrays import Floats, Indices
from subdivision.manifold import TopologyError
from subdivision.rows import Connectivity
from subdivision.trace import Mesh
from subdivision.words import phrase

PAIRS = 1 << 18
"""How many points are compared with one another at once."""


class Counts(NamedTuple):
    """How many vertices, edges and faces there are, and V - E + F."""

    vertices: int
    edges: int
    faces: int
    euler: int


def counts(t: Connectivity) -> Counts:
    """V, E, F and the Euler characteristic."""
    return Counts(t.n_vertices, t.n_edges, t.n_faces, t.euler)


def angle_sum(mesh: Mesh, vertex: int) -> float:
    """Degrees in space of all corners of faces at ``vertex``: 360 on the flat, less on a tip, more on a saddle.

    Raises
    ------
    TopologyError
        If no face has this corner.
    """
    ahead, behind = _sides(mesh, vertex)
    return float(_angles(ahead, behind).sum())


def normal_spread(mesh: Mesh, vertex: int) -> float:
    """The largest angle between the normals of two corners at ``vertex``, in degrees: 0 where they lie in a plane.

    Raises
    ------
    TopologyError
        If no face has this corner.
    """
    normals = np.cross(*_sides(mesh, vertex))
    return float(_angles(normals[:, None], normals[None, :]).max())


def largest_distance(a: Mesh, b: Mesh) -> float:
    """How far apart the points with the same number are, where they are farthest.

    Raises
    ------
    ValueError
        If the two have not equally many points.
    """
    if a.points.shape != b.points.shape:
        raise ValueError(
            phrase(
                "{n} points have no partners among {others}; compare meshes of the same connectivity",
                n=len(a.points),
                others=len(b.points),
            )
        )
    return float(np.linalg.norm(a.points - b.points, axis=1).max(initial=0.0))


def largest_gap(points: Floats, among: Floats) -> float:
    """How far the loneliest of ``points`` (n, 3) is from the nearest point ``among`` others (m, 3)."""
    part = max(PAIRS // max(len(among), 1), 1)
    gaps = [
        np.linalg.norm(points[k : k + part, None] - among, axis=2).min(axis=1).max()
        for k in range(0, len(points), part)
    ]
    return float(max(gaps, default=0.0))


def edges_apart(t: Connectivity, vertices: Indices) -> Floats:
    """(k, k): how many edges the shortest way between each two of ``vertices`` has; inf where there is none."""
    n, (here, there) = t.n_vertices, t.ends.T
    along = csr_array((np.ones(2 * len(here)), (np.r_[here, there], np.r_[there, here])), (n, n))
    ways = np.full((n, len(vertices)), np.inf)
    front = np.zeros(ways.shape, dtype=np.bool_)
    front[vertices, np.arange(len(vertices))] = True
    far = 0
    while front.any():
        ways[front] = far
        front = (along @ front.astype(float) > 0) & np.isinf(ways)
        far += 1
    return ways[vertices].T


def _sides(mesh: Mesh, vertex: int) -> tuple[Floats, Floats]:
    """(k, 3) each: from ``vertex`` to the next and to the previous corner of each of its k faces."""
    t, p = mesh.topology, mesh.points
    here = np.flatnonzero(t.origin == vertex)
    if not len(here):
        raise TopologyError(phrase("there is no face at vertex {vertex} to measure", vertex=vertex), vertices=[vertex])
    last = np.cumsum(t.face_sizes)
    face = np.searchsorted(last, here, side="right")
    size = t.face_sizes[face]
    first = last[face] - size
    ahead, behind = (t.origin[first + (here - first + turn) % size] for turn in (1, -1))
    return p[ahead] - p[vertex], p[behind] - p[vertex]


def _angles(a: Floats, b: Floats) -> Floats:
    """Degrees between vectors along the last axis; 0 beside a vector without length."""
    sine, cosine = np.linalg.norm(np.cross(a, b), axis=-1), (a * b).sum(axis=-1)
    return np.asarray(np.degrees(np.arctan2(sine, cosine)))

"""The characteristic map of a vertex: the plane net that a step copies, only smaller by lambda.

A surface is C1 at a vertex if everything else shrinks faster and this map is regular and one to one
[PR98]_.  Here both are *sampled*, on limit points and their tangents: a fold that is seen is there,
and what is not seen is no proof (for the schemes of the lecture there is one).
"""

from dataclasses import dataclass, replace

import numpy as np

from subdivision.arrays import Floats, Indices, Mask
from subdivision.limit import limit_points, normals
from subdivision.scheme import Scheme
from subdivision.spectrum import ring, step_on_fan
from subdivision.topology import Topology
from subdivision.trace import Mesh, subdivide

STEPS = 2
"""How often the net is refined before it is sampled."""


@dataclass(frozen=True, eq=False)
class CharacteristicMap:
    """A map of the faces round a vertex into the plane, the vertex at 0, its first neighbour at (1, 0).

    Attributes
    ----------
    net : Mesh
        Two rings of faces; the outer one is hidden: it only supports the surface.
    sheet : Mesh
        The same refined, its vertices at their limits.
    upright : (n,) float
        For the vertices of ``sheet``, but for the first, the vertex itself: how upright their normals are, from
        -1 (folded over) to 1.
    """

    net: Mesh
    sheet: Mesh
    upright: Floats

    @property
    def is_regular(self) -> bool:
        """Whether no sample within the inner ring is folded over."""
        t = self.sheet.surface
        shown = np.zeros(t.n_vertices, dtype=bool)
        shown[t.origin[_shown(t)]] = True
        return bool((self.upright[shown[1:]] > 0).all())

    @property
    def is_one_to_one(self) -> bool:
        """Whether it is regular and its rim goes round the vertex once, always onwards."""
        t, points = self.sheet.surface, self.sheet.points
        place = points[:, 0] + 1j * points[:, 1]
        rim = _shown(t) & ~np.where(t.twin >= 0, _shown(t)[t.twin], False)
        turns = np.angle(place[t.origin[t.next[rim]]] / place[t.origin[rim]])
        return self.is_regular and bool((turns > 0).all()) and abs(float(turns.sum()) - 2 * np.pi) < 1e-9


def characteristic_map(scheme: Scheme, valence: int) -> CharacteristicMap:
    """The characteristic map of a mesh scheme; the rule of the vertex itself has no part in it.

    Raises
    ------
    TopologyError
        As ``spectrum.ring``.
    """
    net = _net(scheme, valence)
    fine = net
    for _ in range(STEPS):
        fine = subdivide(fine, scheme, 1)
    sheet = Mesh(fine.topology, limit_points(fine, scheme))
    return CharacteristicMap(net, sheet, normals(fine, scheme)[1:, 2])


def _net(scheme: Scheme, n: int) -> Mesh:
    """Two rings of faces: the inner points are the ring's eigenvectors, the outer ones what copies itself with them."""
    step, names, successors = step_on_fan(scheme, n)
    t, local = step.topology, ring(scheme, n)
    assert isinstance(t, Topology)
    inner = np.array([successors[name] for name in names])
    outer = np.setdiff1d(np.arange(t.n_vertices), inner)
    finer = scheme.step(t)
    rows = finer.matrix.toarray()[_copies(t, finer.topology.origin, n)]
    points, known = np.zeros((t.n_vertices, 3)), local.characteristic_map()
    shrink = local.subdominant * np.eye(len(outer))
    points[inner, :2] = known
    points[outer, :2] = np.linalg.solve(shrink - rows[np.ix_(outer, outer)], rows[np.ix_(outer, inner)] @ known)
    reaching = np.bincount(t.face, weights=np.isin(t.origin, outer)) > 0
    return Mesh(replace(t, hidden=reaching), points)


def _copies(t: Topology, finer: Indices, n: int) -> Indices:
    """(n_vertices,) int: for every point of two rings the one half as far away, among the ``finer`` corners.

    Arithmetic, since faces are numbered by the corners they are split at: see ``refine``.
    """
    h = np.arange(t.n_halfedges)
    if t.is_quadrilateral:
        there = h + 48 * (h // 16)
    else:
        there = np.where(h < 9 * n, h + 18 * (h // 9), 27 * n + h + 6 * ((h - 9 * n) // 3))
    found = np.zeros(t.n_vertices, dtype=np.intp)
    found[t.origin] = finer[there]
    return found


def _shown(t: Topology) -> Mask:
    """(n_halfedges,) bool: half-edges of the inner ring's faces."""
    return np.asarray(~t.hidden[t.face])

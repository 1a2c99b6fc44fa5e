"""Open pieces of meshes: sheets, and fragments round one place with enough faces about it.

In every fragment the part worth looking at comes first, in vertices and in faces; what
follows is the ring that gives those vertices all their faces, so that none of them meets
a boundary rule.
"""

from functools import partial

import numpy as np

from subdivision.arrays import Floats
from subdivision.manifold import TopologyError
from subdivision.shapes.build import mesh, meshed, turns
from subdivision.shapes.nets import net
from subdivision.trace import Mesh
from subdivision.words import phrase


def quad_sheet(n: int = 4) -> Mesh:
    """The hilly net of ``n`` by ``n`` squares as a quad mesh: V/E/F 25/40/16 at n = 4; inside all valences are 4."""
    return meshed(net(n + 1, n + 1))


def triangle_sheet(n: int = 4) -> Mesh:
    """The same with squares cut along (1,1): V/E/F 25/56/32 at n = 4; inside all valences are 6."""
    return meshed(net(n + 1, n + 1, diagonal=True))


def quad_fan(n: int = 6, rings: int = 1) -> Mesh:
    """``n`` quads round vertex 0, of valence ``n``, then ``rings - 1`` rings of quads: Figure 13 has n = 6.

    V = 1 + n r (r + 1) and F = n r^2 for r rings: V/E/F 13/18/6 for a plain fan of six, 37/60/24
    with a second ring.  Inside, all valences but vertex 0's are 4.  Ring ``r`` begins at
    vertex ``1 + n r (r - 1)`` and face ``n (r - 1)^2``, so the first ``n`` faces are the fan.
    """
    _require_fan(n, rings)
    number = partial(_quad_number, n)
    faces = [
        [number(s, i, j), number(s, i + 1, j), number(s, i + 1, j + 1), number(s, i, j + 1)]
        for r in range(rings)
        for s in range(n)
        for i, j in _corner_path(r)
    ]
    places = [
        (np.hypot(i, j), (s + np.arctan2(j, i) * 2 / np.pi) / n)
        for r in range(1, rings + 1)
        for s in range(n)
        for i, j in _corner_path(r)[:-1]
    ]
    return mesh(_dome(np.array([(0.0, 0.0), *places])), faces)


def triangle_fan(n: int = 8, rings: int = 1) -> Mesh:
    """``n`` triangles round vertex 0, of valence ``n``, then ``rings - 1`` rings of triangles: Figure 23 has n = 8.

    V = 1 + n r (r + 1)/2 and F = n r^2 for r rings: V/E/F 9/16/8 for a plain fan of eight, 25/56/32
    with a second ring.  Inside, all valences but vertex 0's are 6.  Ring ``r`` begins at
    vertex ``1 + n r (r - 1)/2`` and face ``n (r - 1)^2``, so the first ``n`` faces are the fan.
    """
    _require_fan(n, rings)
    number = partial(_triangle_number, n)
    faces = []
    for r in range(rings):
        for s in range(n):
            faces += [[number(r, s, j), number(r + 1, s, j), number(r + 1, s, j + 1)] for j in range(r + 1)]
            faces += [[number(r, s, j), number(r + 1, s, j + 1), number(r, s, j + 1)] for j in range(r)]
    places = [_between(n, r, s, j) for r in range(1, rings + 1) for s in range(n) for j in range(r)]
    return mesh(_dome(np.array([(0.0, 0.0), *places])), faces)


def quad_star(n: int = 6, rings: int = 1) -> Mesh:
    """The fan of quads drawn flat, all sides of length 1: ``n`` rhombi round vertex 0, the first spoke up.

    Vertices and faces are numbered as in ``quad_fan``; at n = 4 it is a piece of the square grid.
    """
    places = [(s, i, j) for r in range(1, rings + 1) for s in range(n) for i, j in _corner_path(r)[:-1]]
    return Mesh(quad_fan(n, rings).topology, _rhombic(n, places))


def triangle_star(n: int = 6, rings: int = 1) -> Mesh:
    """The fan of triangles drawn flat, all spokes of length 1, the first one up; equilateral at n = 6.

    Vertices and faces are numbered as in ``triangle_fan``.
    """
    places = [(s, r - j, j) for r in range(1, rings + 1) for s in range(n) for j in range(r)]
    return Mesh(triangle_fan(n, rings).topology, _rhombic(n, places))


def dome(star: Mesh, reach: float = 0.85) -> Mesh:
    """A star's points raised to the unit sphere, vertex 0 to its top; the outermost is ``reach`` from the axis."""
    flat = star.points * reach / np.linalg.norm(star.points, axis=1).max()
    flat[:, 2] = np.sqrt(1 - (flat**2).sum(axis=1))
    return Mesh(star.topology, flat)


def face_and_ring() -> Mesh:
    """A quad, face 0 on vertices 0 to 3, and the eight quads about it: Figure 12.  V/E/F 16/24/9.

    All four vertices have valence 4.  The points are those of ``net(4, 4)``, the middle ones first.
    """
    old = net(4, 4)
    order = np.array([5, 9, 10, 6, 0, 4, 8, 12, 13, 14, 15, 11, 7, 3, 2, 1])
    new = np.argsort(order)
    loops = [new[loop].tolist() for loop in meshed(old).surface.loops()]
    return mesh(old.points[order], [loops[4], *loops[:4], *loops[5:]])


def two_triangles_and_ring() -> Mesh:
    """Two triangles, faces 0 and 1 on vertices 0 to 3, and the fourteen about them: Figure 22.  V/E/F 14/29/16.

    A piece of the three-direction mesh, drawn with equal sides: vertices 0 and 2 end the shared
    edge, and all four have valence 6.
    """
    at = [(1, 1), (2, 1), (2, 2), (1, 2)]
    at += [(0, 0), (1, 0), (2, 0), (3, 1), (3, 2), (3, 3), (2, 3), (1, 3), (0, 2), (0, 1)]
    number = {place: k for k, place in enumerate(at)}
    cells = [(1, 1), *((i, j) for i in range(3) for j in range(3) if (i, j) != (1, 1))]
    halves = [half for i, j in cells for half in (((i + 1, j), (i + 1, j + 1)), ((i + 1, j + 1), (i, j + 1)))]
    corners = [((i, j), *half) for (i, j), half in zip(np.repeat(cells, 2, axis=0).tolist(), halves, strict=True)]
    faces = [[number[p] for p in corner] for corner in corners if all(p in number for p in corner)]
    s, t = np.array(at, dtype=float).T - 1.5
    x, y = 0.7 * np.sqrt(3) / 2 * (s - t), 0.7 * (s + t) / 2
    z = 0.3 - 0.3 * (x**2 + y**2) + 0.12 * np.sin(3.1 * x - 1.7 * y)
    return mesh(np.stack([x, y, z], axis=1), faces)


def _require_fan(n: int, rings: int) -> None:
    if n < 3 or rings < 1:
        raise TopologyError(
            phrase("a fan needs three faces and one ring or more, not {n} faces and {rings} rings", n=n, rings=rings)
        )


def _corner_path(r: int) -> list[tuple[int, int]]:
    """Places (i, j) of a sector with max(i, j) = r: out along j, back along i."""
    return [(r, j) for j in range(r)] + [(i, r) for i in range(r, -1, -1)]


def _quad_number(n: int, s: int, i: int, j: int) -> int:
    """Vertex ``i`` steps along spoke ``s`` and ``j`` along the next; where i = 0 it is the next sector's."""
    r = max(i, j)
    if r == 0:
        return 0
    along = j if i == r else 2 * r - i
    return 1 + n * r * (r - 1) + (2 * r * s + along) % (2 * r * n)


def _triangle_number(n: int, r: int, s: int, j: int) -> int:
    """Vertex ``j`` steps after spoke ``s`` on ring ``r``."""
    return 1 + n * r * (r - 1) // 2 + (s * r + j) % (n * r) if r else 0


def _between(n: int, r: int, s: int, j: int) -> tuple[float, float]:
    """Radius, and angle in turns, of the point ``j/r`` of the way from spoke ``s`` to the next."""
    step = 2 * np.pi / n
    x, y = r - j + j * np.cos(step), j * np.sin(step)
    straight = np.hypot(x, y)
    return (straight + r) / 2, (s + np.arctan2(y, x) / step) / n


def _rhombic(n: int, places: list[tuple[int, int, int]]) -> Floats:
    """(1 + n_places, 3): the middle, then places (s, i, j): ``i`` steps along spoke ``s`` and ``j`` along the next."""
    angles = turns(n) + np.pi / 2
    spokes = np.stack([np.cos(angles), np.sin(angles), np.zeros(n)], axis=1)
    s, i, j = np.array(places).T
    return np.vstack([np.zeros(3), i[:, None] * spokes[s] + j[:, None] * spokes[(s + 1) % n]])


def _dome(polar: Floats) -> Floats:
    """(n, 3): places given by radius and turns, scaled to radius 1.4 and raised like a tent that hangs a little."""
    radius = 1.4 * polar[:, 0] / polar[:, 0].max()
    angle = 2 * np.pi * polar[:, 1]
    z = 0.35 - 0.4 * radius**1.5
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=1)

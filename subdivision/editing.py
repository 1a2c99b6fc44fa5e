"""Changes of a control object, each a new one: what is left of it keeps its order, its places and its sharpness.

Whatever would break the polygon, the net or the mesh is refused with a ``TopologyError`` that names the place and
says how to mend it.  Sharpness of the boundary is the boundary rule's, so an edge that comes to lie within the
mesh is smooth; pins of vertices stay.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import compress
from math import isqrt

import numpy as np

from subdivision.arrays import Floats
from subdivision.manifold import TopologyError
from subdivision.rows import Grid, Polyline
from subdivision.shapes.fans import quad_fan, triangle_fan
from subdivision.topology import INFINITELY_SHARP, Boundary, Topology
from subdivision.trace import Mesh
from subdivision.words import phrase

LEAST_OPEN, LEAST_CLOSED = 2, 3
"""Points that a polygon needs."""

LEAST_ACROSS = 2
"""Points that a net needs in each direction; 3 where it is wrapped."""

Loops = list[list[int]]


# -- polygons ---------------------------------------------------------------------------------


def insert_point(polygon: Mesh, after: int, at: Sequence[float] | Floats) -> Mesh:
    """One point more, behind number ``after``; -1: before the first."""
    t = _polyline(polygon)
    if not -1 <= after < t.n_vertices:
        raise TopologyError(
            phrase(
                "there is no point {after} to follow; choose one from 0 to {last}", after=after, last=t.n_vertices - 1
            )
        )
    return Mesh(replace(t, n_vertices=t.n_vertices + 1), np.insert(polygon.points, after + 1, at, axis=0))


def remove_points(polygon: Mesh, points: Iterable[int]) -> Mesh:
    """The polygon without some of its points."""
    t, gone = _polyline(polygon), _known(points, polygon.topology.n_vertices, phrase("point"))
    left, least = t.n_vertices - len(gone), LEAST_CLOSED if t.closed else LEAST_OPEN
    if left < least:
        why = (
            "without point {gone} only {left} would be left, and a closed polygon needs {least}; open it first, or "
            "keep one"
            if t.closed
            else "without point {gone} only {left} would be left, and an open polygon needs {least}; keep one"
        )
        raise TopologyError(phrase(why, gone=gone[-1], left=left, least=least), vertices=gone)
    return Mesh(replace(t, n_vertices=left), np.delete(polygon.points, gone, axis=0))


def set_closed(polygon: Mesh, closed: bool) -> Mesh:
    """The polygon with its last point joined to its first, or parted from it."""
    t = _polyline(polygon)
    if closed and t.n_vertices < LEAST_CLOSED:
        raise TopologyError(
            phrase(
                "a closed polygon needs {least} points, not {n}; insert one first", least=LEAST_CLOSED, n=t.n_vertices
            )
        )
    return Mesh(replace(t, closed=closed), polygon.points)


# -- nets -------------------------------------------------------------------------------------


def resize(net: Mesh, n_s: int, n_t: int) -> Mesh:
    """The net with ``n_s`` by ``n_t`` points on the same bilinear patches, so that its shape is kept."""
    t = _grid(net)
    for direction, n, wrap in (("s", n_s, t.wrap_s), ("t", n_t, t.wrap_t)):
        _require_across(direction, n, wrap)
    points = net.points.reshape(t.n_s, t.n_t, 3)
    along_s = _resampled(points, n_s, t.wrap_s)
    along_t = _resampled(along_s.transpose(1, 0, 2), n_t, t.wrap_t).transpose(1, 0, 2)
    return Mesh(replace(t, n_s=n_s, n_t=n_t), along_t.reshape(-1, 3))


def set_wrap(net: Mesh, wrap_s: bool, wrap_t: bool) -> Mesh:
    """The same points with opposite sides joined, or parted."""
    t = _grid(net)
    for direction, n, wrap in (("s", t.n_s, wrap_s), ("t", t.n_t, wrap_t)):
        _require_across(direction, n, wrap)
    return Mesh(replace(t, wrap_s=wrap_s, wrap_t=wrap_t), net.points)


def _require_across(direction: str, n: int, wrap: bool) -> None:
    least = LEAST_CLOSED if wrap else LEAST_ACROSS
    if n < least:
        why = (
            "a net, wrapped, needs {least} points or more in direction {direction}, not {n}; open it in {direction}, "
            "or keep more"
            if wrap
            else "a net needs {least} points or more in direction {direction}, not {n}; keep more"
        )
        raise TopologyError(phrase(why, least=least, direction=direction, n=n))


def _resampled(rows: Floats, n: int, wrap: bool) -> Floats:
    """(n, m, 3): rows at equal steps along the old ones, in straight lines between them."""
    old = len(rows)
    places = np.arange(n) * old / n if wrap else np.linspace(0, old - 1, n)
    low = np.minimum(places.astype(np.intp), old - 1)
    high = (low + 1) % old if wrap else np.minimum(low + 1, old - 1)
    t = (places - low)[:, None, None]
    return np.asarray((1 - t) * rows[low] + t * rows[high])


# -- fans -------------------------------------------------------------------------------------


def fan_of(mesh: Mesh) -> tuple[int, int] | None:
    """Valence and rings, if the mesh is connected as a fan of quads or triangles is; None: it is no fan."""
    t = mesh.topology
    if not isinstance(t, Topology) or not (t.is_quadrilateral or t.is_triangular) or not t.n_vertices:
        return None
    n = int(t.valence[0])
    rings = isqrt(t.n_faces // n) if n else 0
    if n < 3 or n * rings**2 != t.n_faces:
        return None
    return (n, rings) if np.array_equal(_fan(t, n, rings).surface.origin, t.origin) else None


def refan(mesh: Mesh, valence: int, rings: int) -> Mesh:
    """The fan with another valence in the middle, or another number of rings; all points as a new fan has them."""
    if fan_of(mesh) is None:
        raise TopologyError("this is no fan, so it has no valence to set; take a fan of quads or triangles")
    return _fan(mesh.surface, valence, rings)


def _fan(t: Topology, valence: int, rings: int) -> Mesh:
    return (quad_fan if t.is_quadrilateral else triangle_fan)(valence, rings)


# -- sharpness --------------------------------------------------------------------------------


def sharpen_edges(mesh: Mesh, edges: Iterable[int], sharpness: float) -> Mesh:
    """The mesh with a crease along some edges: 0 smooth, up to 10 which never wears off."""
    t = _surface(mesh)
    chosen = _known(edges, t.n_edges, phrase("edge"))
    for e in chosen:
        if t.boundary[e]:
            a, b = sorted(t.ends[e].tolist())
            raise TopologyError(
                phrase(
                    "the edge between vertices {a} and {b} is on the boundary, which has a rule of its own; "
                    "choose another boundary rule instead",
                    a=a,
                    b=b,
                ),
                vertices=[a, b],
            )
    values = t.edge_sharpness.copy()
    values[chosen] = _checked(sharpness)
    return Mesh(replace(t, edge_sharpness=values), mesh.points)


def sharpen_vertices(mesh: Mesh, vertices: Iterable[int], sharpness: float) -> Mesh:
    """The mesh with some vertices pinned: 0 smooth, up to 10 which never wears off."""
    t = _surface(mesh)
    values = t.vertex_sharpness.copy()
    values[_known(vertices, t.n_vertices, phrase("vertex"))] = _checked(sharpness)
    return Mesh(replace(t, vertex_sharpness=values), mesh.points)


def _checked(sharpness: float) -> float:
    if not 0 <= sharpness <= INFINITELY_SHARP:
        raise TopologyError(
            phrase(
                "sharpness {sharpness:g} is not between 0 (smooth) and 10 (for ever); choose one that is",
                sharpness=sharpness,
            )
        )
    return float(sharpness)


# -- faces ------------------------------------------------------------------------------------


def delete_faces(mesh: Mesh, faces: Iterable[int]) -> Mesh:
    """The mesh without some faces, and without vertices that no face has any more."""
    t = _surface(mesh)
    gone = _known(faces, t.n_faces, phrase("face"))
    if len(gone) == t.n_faces:
        raise TopologyError(phrase("without face {gone} no face would be left; keep one", gone=gone[-1]), faces=gone)
    _require_no_new_bow_ties(t, gone)
    stays = np.isin(np.arange(t.n_faces), gone, invert=True)
    return _rebuilt(mesh, list(compress(t.loops(), stays)))


def fill_hole(mesh: Mesh, edge: int) -> Mesh:
    """The mesh with the hole that ``edge`` is on filled by one face, the last."""
    t = _surface(mesh)
    (e,) = _known([edge], t.n_edges, phrase("edge"))
    if not t.boundary[e]:
        a, b = sorted(t.ends[e].tolist())
        raise TopologyError(
            phrase(
                "the edge between vertices {a} and {b} has faces on both sides; choose one along the hole", a=a, b=b
            ),
            vertices=[a, b],
        )
    return _rebuilt(mesh, [*t.loops(), boundary_loop(t, e)])


def boundary_loop(t: Topology, edge: int) -> list[int]:
    """The vertices round the hole that a boundary edge is on, in the order of a face that fills it."""
    rim = np.flatnonzero(t.twin < 0)
    before = dict(zip(t.origin[t.next[rim]].tolist(), t.origin[rim].tolist(), strict=True))
    h = int(rim[t.edge[rim] == edge][0])
    found = [int(t.origin[t.next[h]])]
    while (v := before[found[-1]]) != found[0]:
        found.append(v)
    return found


def flip_edge(mesh: Mesh, edge: int) -> Mesh:
    """The two triangles at an edge cut along the other diagonal, which is smooth."""
    t = _surface(mesh)
    (e,) = _known([edge], t.n_edges, phrase("edge"))
    sides = np.flatnonzero(t.edge == e)
    a, b = sorted(t.ends[e].tolist())
    if len(sides) < 2:
        raise TopologyError(
            phrase(
                "the edge between vertices {a} and {b} has one face only, so it has no other diagonal; "
                "choose one between two triangles",
                a=a,
                b=b,
            ),
            vertices=[a, b],
        )
    one, other = (int(f) for f in t.face[sides])
    for f in (one, other):
        if t.face_sizes[f] != 3:
            raise TopologyError(
                phrase(
                    "face {f} at the edge between vertices {a} and {b} has {n} corners; triangulate the mesh first",
                    f=f,
                    a=a,
                    b=b,
                    n=t.face_sizes[f],
                ),
                faces=[f],
            )
    a, b = int(t.origin[sides[0]]), int(t.origin[t.next[sides[0]]])
    c, d = (int(t.origin[t.prev[h]]) for h in sides)
    if _is_edge(t, c, d):
        raise TopologyError(
            phrase(
                "vertices {c} and {d} have an edge already, so the one between {a} and {b} cannot be "
                "flipped; choose another edge",
                c=c,
                d=d,
                a=a,
                b=b,
            ),
            vertices=[c, d],
        )
    loops = t.loops()
    loops[one], loops[other] = [c, a, d], [d, b, c]
    return _rebuilt(mesh, loops)


def triangulate(mesh: Mesh) -> Mesh:
    """The mesh in triangles: from every larger face its best ear is cut until a triangle is left.

    The best ear has the shortest diagonal that is not an edge yet; of equally short ones that at the corner with the
    smallest number.  A quad is thus cut along its shorter diagonal.  The triangles of a face stand in its place.
    """
    t = _surface(mesh)
    taken = {frozenset(pair) for pair in t.ends.tolist()}
    size = float(np.ptp(mesh.points, axis=0).max(initial=0.0)) or 1.0
    places = mesh.points / size
    loops = [triangle for f, loop in enumerate(t.loops()) for triangle in _ears(f, loop, places, taken)]
    return _rebuilt(mesh, loops)


def turn_over(mesh: Mesh) -> Mesh:
    """The mesh with all its faces seen from the other side; each begins at the same corner."""
    return _rebuilt(mesh, [[loop[0], *reversed(loop[1:])] for loop in _surface(mesh).loops()])


def _ears(face: int, loop: list[int], places: Floats, taken: set[frozenset[int]]) -> Iterator[list[int]]:
    """The triangles of a face; the diagonals are ``taken`` from then on."""
    loop = list(loop)
    while len(loop) > 3:
        n = len(loop)
        free = [k for k in range(n) if frozenset((loop[k - 1], loop[(k + 1) % n])) not in taken]
        if not free:
            raise TopologyError(
                phrase(
                    "face {face} cannot be cut: all its diagonals are edges of other faces; delete one of them first",
                    face=face,
                ),
                faces=[face],
            )
        length = {k: round(float(np.linalg.norm(places[loop[k - 1]] - places[loop[(k + 1) % n]])), 9) for k in free}
        k = min(free, key=lambda k: (length[k], loop[k]))
        taken.add(frozenset((loop[k - 1], loop[(k + 1) % n])))
        yield [loop[k - 1], loop[k], loop[(k + 1) % n]]
        del loop[k]
    yield loop


# -- common to all ----------------------------------------------------------------------------


def _rebuilt(mesh: Mesh, loops: Loops) -> Mesh:
    """The faces that ``loops`` say on the vertices they have, numbered in the old order, as sharp as they were."""
    t = mesh.surface
    sizes = np.array([len(loop) for loop in loops], dtype=np.intp)
    kept, corners = np.unique([v for loop in loops for v in loop], return_inverse=True)
    bare = Topology.from_corners(sizes, corners, len(kept), boundary=Boundary.LITERAL)
    sharp = {
        (min(pair), max(pair)): value
        for pair, value, rim in zip(t.ends.tolist(), t.edge_sharpness.tolist(), t.boundary.tolist(), strict=True)
        if value and not rim
    }
    ends = np.sort(kept[bare.ends], axis=1)
    edges = np.array([sharp.get((a, b), 0.0) for a, b in ends.tolist()])
    pinned = replace(bare, edge_sharpness=edges, vertex_sharpness=t.vertex_sharpness[kept])
    return Mesh(pinned.with_boundary(Boundary.EDGE), mesh.points[kept])


def _require_no_new_bow_ties(t: Topology, gone: list[int]) -> None:
    """At every vertex the faces that are left hang together."""
    stays = np.ones(t.n_faces, dtype=bool)
    stays[gone] = False
    half = stays[t.face]
    is_start = half & ((t.twin < 0) | ~half[t.twin])
    starts = np.bincount(t.origin[is_start], minlength=t.n_vertices)
    if (torn := np.flatnonzero(starts > 1)).size:
        v = int(torn[0])
        there = sorted({int(f) for f in t.face[half & (t.origin == v)]})
        named = phrase("these {n} faces", n=len(gone))
        if len(gone) <= 2:
            named = phrase("face {a}" if len(gone) == 1 else "faces {a} and {b}", a=gone[0], b=gone[-1])
        raise TopologyError(
            phrase(
                "without {named} two fans of faces would touch at vertex {v} without sharing an edge; "
                "delete one of the fans (of faces {faces}) too, or choose other faces",
                named=named,
                v=v,
                faces=", ".join(map(str, there)),
            ),
            faces=there,
            vertices=[v],
        )


def _is_edge(t: Topology, a: int, b: int) -> bool:
    return bool((np.sort(t.ends, axis=1) == sorted((a, b))).all(axis=1).any())


def _known(numbers: Iterable[int], n: int, kind: str) -> list[int]:
    """The numbers in order, each once."""
    found = sorted({int(k) for k in numbers})
    if not found:
        raise TopologyError(phrase("no {kind} is chosen; choose one", kind=kind))
    for k in found:
        if not 0 <= k < n:
            raise TopologyError(
                phrase("there is no {kind} {k}; choose one from 0 to {last}", kind=kind, k=k, last=n - 1)
            )
    return found


def _polyline(mesh: Mesh) -> Polyline:
    if not isinstance(mesh.topology, Polyline):
        raise TopologyError("this is no polygon; take one, or edit its faces instead")
    return mesh.topology


def _grid(mesh: Mesh) -> Grid:
    if not isinstance(mesh.topology, Grid):
        raise TopologyError("this is no net of rows and columns; take one, or edit its faces instead")
    return mesh.topology


def _surface(mesh: Mesh) -> Topology:
    if not isinstance(mesh.topology, Topology):
        raise TopologyError("this is a polygon or a net, which has no faces of its own to edit; take a mesh")
    return mesh.topology

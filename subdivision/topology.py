"""Half-edge connectivity of an oriented polygon mesh, as plain read-only index arrays.

Half-edge ``h`` leaves vertex ``origin[h]``, runs along edge ``edge[h]`` with face
``face[h]`` on its left, and is followed there by ``next[h]``.  ``twin[h]`` runs the
other way along the same edge; it is negative where the mesh ends.  Half-edges are
stored face by face, in loop order, so ``origin`` is also the flat list of corners.

Sharpness belongs to the topology because weights depend on it as they do on valence.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from subdivision.arrays import Floats, Indices, Mask, columns, frozen, next_corners, taken
from subdivision.manifold import TopologyError, paired, require_faces
from subdivision.words import phrase

INFINITELY_SHARP = 10.0
"""Sharpness from here on never wears off, as in OpenSubdiv."""


class Boundary(Enum):
    """What happens where the mesh ends.  The lecture has no rule; these are additions to it."""

    EDGE = "edge"
    """Boundary edges are infinitely sharp: the outline is a cubic B-spline curve."""
    EDGE_AND_CORNER = "edge-and-corner"
    """... and vertices with a single face stay where they are."""
    HIDE = "hide"
    """Faces that touch the boundary support the surface but are not part of it."""
    LITERAL = "literal"
    """The interior rule with the faces that exist: the sheet shrinks at every level."""


@dataclass(frozen=True, eq=False)
class Topology:
    """Everything subdivision weights depend on, and nothing else: no positions.

    Attributes
    ----------
    origin, next, twin, edge, face : (n_halfedges,) int
        See the module docstring.
    n_vertices : int
        Vertices are numbered ``0 .. n_vertices - 1``; some may be isolated.
    edge_sharpness : (n_edges,) float
        0 smooth; between them semi-sharp; 10 and more never wears off.
    vertex_sharpness : (n_vertices,) float
        Likewise.
    hidden : (n_faces,) bool
        Faces that support the surface but are not drawn.
    """

    origin: Indices
    next: Indices
    twin: Indices
    edge: Indices
    face: Indices
    n_vertices: int
    edge_sharpness: Floats
    vertex_sharpness: Floats
    hidden: Mask

    def __post_init__(self) -> None:
        known = self.__dict__
        known.update({name: frozen(known[name]) for name in known if name != "n_vertices"})

    @classmethod
    def deferred(cls, make: Mapping[str, Callable[[], Any]], **known: Any) -> Self:
        """Attributes ``known`` now, and others to ``make`` one by one when they are asked for."""
        t = cls.__new__(cls)
        t.__dict__.update({name: frozen(v) if isinstance(v, np.ndarray) else v for name, v in known.items()})
        t.__dict__["_make"] = make
        return t

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            make = self.__dict__.get("_make", {}).get(name)
            if make is None:
                raise AttributeError(f"a {type(self).__name__} has no attribute '{name}'")
            made = self.__dict__[name] = frozen(make())
            return made

    @classmethod
    def from_faces(
        cls,
        faces: Sequence[Sequence[int]],
        n_vertices: int | None = None,
        *,
        boundary: Boundary = Boundary.EDGE,
        creases: Mapping[tuple[int, int], float] | None = None,
        corners: Mapping[int, float] | None = None,
    ) -> Self:
        """Build connectivity from counter-clockwise vertex loops.

        Parameters
        ----------
        creases : {(vertex, vertex): sharpness}
        corners : {vertex: sharpness}

        Raises
        ------
        TopologyError
            If the loops are not an oriented manifold, or a crease is not one of its edges.
        """
        sizes = np.array([len(f) for f in faces], dtype=np.intp)
        flat = [int(v) for loop in faces for v in loop]
        return cls.from_corners(
            sizes, np.array(flat, dtype=np.intp), n_vertices, boundary=boundary, creases=creases, corners=corners
        )

    @classmethod
    def from_corners(
        cls,
        sizes: Indices,
        origin: Indices,
        n_vertices: int | None = None,
        *,
        boundary: Boundary = Boundary.EDGE,
        creases: Mapping[tuple[int, int], float] | None = None,
        corners: Mapping[int, float] | None = None,
    ) -> Self:
        """Build connectivity from face ``sizes`` (n_faces,) int and their corners laid end to end."""
        sizes, origin = sizes.astype(np.intp, copy=False), origin.astype(np.intp, copy=False)
        n = n_vertices if n_vertices is not None else int(origin.max(initial=-1)) + 1
        face = np.repeat(np.arange(len(sizes)), sizes)
        require_faces(sizes, origin, face, n)
        next_ = next_corners(sizes)
        twin, edge, ends = paired(origin, origin[next_], face, n)
        bare = cls(
            origin, next_, twin, edge, face, n,
            edge_sharpness=_crease_sharpness(ends, creases or {}),
            vertex_sharpness=_corner_sharpness(n, corners or {}),
            hidden=np.zeros(len(sizes), dtype=bool),
        )  # fmt: skip
        _require_single_fans(bare)
        return bare.with_boundary(boundary)

    def with_boundary(self, rule: Boundary) -> Self:
        """The mesh under a boundary rule; inner sharpness stays.  Start from the mesh as read: pins stay in."""
        edges, vertices = self.edge_sharpness.copy(), self.vertex_sharpness.copy()
        edges[self.boundary] = 0.0 if rule is Boundary.LITERAL else INFINITELY_SHARP
        if rule is Boundary.EDGE_AND_CORNER:
            vertices[self.on_boundary & (np.bincount(self.origin, minlength=self.n_vertices) == 1)] = INFINITELY_SHARP
        hidden = np.zeros(self.n_faces, dtype=bool)
        if rule is Boundary.HIDE:
            hidden[self.face[self.on_boundary[self.origin]]] = True
        return replace(self, edge_sharpness=edges, vertex_sharpness=vertices, hidden=hidden)

    @property
    def n_halfedges(self) -> int:
        return len(self.origin)

    @property
    def n_edges(self) -> int:
        return len(self.edge_sharpness)

    @property
    def n_faces(self) -> int:
        return len(self.hidden)

    @cached_property
    def prev(self) -> Indices:
        """(n_halfedges,) int: the inverse permutation of ``next``."""
        prev, end = np.arange(-1, self.n_halfedges - 1), np.cumsum(self.face_sizes)
        prev[end - self.face_sizes] = end - 1
        return frozen(prev)

    @cached_property
    def is_smooth(self) -> bool:
        """Whether nothing is sharp."""
        return not (self.edge_sharpness.any() or self.vertex_sharpness.any())

    @cached_property
    def ends(self) -> Indices:
        """(n_edges, 2) int: the two vertices of every edge."""
        h = np.zeros(self.n_edges, dtype=np.intp)
        h[self.edge] = np.arange(self.n_halfedges)  # of two the later
        return frozen(columns(taken(self.origin, h), taken(self.origin, taken(self.next, h))).reshape(-1, 2))

    @cached_property
    def face_sizes(self) -> Indices:
        """(n_faces,) int: how many corners each face has."""
        return frozen(np.bincount(self.face, minlength=self.n_faces))

    @cached_property
    def valence(self) -> Indices:
        """(n_vertices,) int: how many edges meet at each vertex."""
        valence, rim = np.bincount(self.origin, minlength=self.n_vertices), np.flatnonzero(self.twin < 0)
        np.add.at(valence, self.origin[self.next[rim]], 1)
        return frozen(valence)

    @cached_property
    def boundary(self) -> Mask:
        """(n_edges,) bool: edges with a face on one side only."""
        mask = np.zeros(self.n_edges, dtype=bool)
        mask[self.edge[self.twin < 0]] = True
        return frozen(mask)

    @cached_property
    def on_boundary(self) -> Mask:
        """(n_vertices,) bool: vertices at the end of a boundary edge."""
        mask = np.zeros(self.n_vertices, dtype=bool)
        rim = np.flatnonzero(self.twin < 0)
        mask[self.origin[rim]] = mask[self.origin[self.next[rim]]] = True
        return frozen(mask)

    @cached_property
    def extraordinary(self) -> Mask:
        """(n_vertices,) bool: interior vertices whose valence is not 4 (6 on triangle meshes)."""
        return frozen(~self.on_boundary & (self.valence > 0) & (self.valence != (6 if self.is_triangular else 4)))

    @property
    def euler(self) -> int:
        """V - E + F."""
        return self.n_vertices - self.n_edges + self.n_faces

    @cached_property
    def is_triangular(self) -> bool:
        return bool((self.face_sizes == 3).all())

    @cached_property
    def is_quadrilateral(self) -> bool:
        return bool((self.face_sizes == 4).all())

    def loops(self) -> list[list[int]]:
        """Vertex loops of the faces, in face order (for drawing and export)."""
        return [loop.tolist() for loop in np.split(self.origin, np.cumsum(self.face_sizes)[:-1])]


def _require_single_fans(t: Topology) -> None:
    """The faces around every vertex hang together: as many corners as edges, one more edge at the boundary.

    Most often one walk round each vertex meets all.  A vertex where ``k`` open fans meet has ``k``
    more edges than corners, so counting finds it unless closed fans meet; those are told apart by
    walking around once.
    """
    if _walked(t) == t.n_halfedges:
        return
    corners = np.bincount(t.origin, minlength=t.n_vertices)
    bad = t.valence - corners > 1
    label, rounds = np.arange(t.n_halfedges), int(corners.max(initial=1)).bit_length() + 1
    label = _smallest_around(label, taken(t.twin, t.prev), rounds)
    if t.boundary.any():  # the other way round too, where an open fan stops the first walk
        label = _smallest_around(label, np.where(t.twin >= 0, taken(t.next, t.twin), -1), rounds)
    any_of = np.zeros(t.n_vertices, dtype=np.intp)
    any_of[t.origin] = label
    apart = label != taken(any_of, t.origin)
    if bad.any() or apart.any():
        v = int(np.flatnonzero(bad)[0]) if bad.any() else int(t.origin[np.flatnonzero(apart)[0]])
        raise TopologyError(
            phrase(
                "at vertex {v} two fans of faces touch without sharing an edge (a bow tie); give each "
                "fan a vertex of its own",
                v=v,
            ),
            faces=sorted({int(f) for f in t.face[t.origin == v]}),
            vertices=[v],
        )


def _walked(t: Topology, most: int = 32) -> int:
    """How many corners are met on one walk round each vertex, of ``most`` corners at most."""
    first, around = np.full(t.n_vertices, -1), taken(t.twin, t.prev)
    first[t.origin] = np.arange(t.n_halfedges)
    rim = np.flatnonzero(t.twin < 0)
    first[t.origin[rim]] = rim
    here = start = first[first >= 0]
    met = 0
    while len(here) and most:
        met, most, here = met + len(here), most - 1, taken(around, here)
        goes_on = (here >= 0) & (here != start)
        here, start = here[goes_on], start[goes_on]
    return met


def _smallest_around(label: Indices, around: Indices, rounds: int) -> Indices:
    """The smallest label along ``around``, which is negative at its ends; ``2 ** rounds`` steps far."""
    around = np.where(around >= 0, around, np.arange(len(around)))
    for _ in range(rounds):
        label, around = np.minimum(label, taken(label, around)), taken(around, around)
    return label


def _crease_sharpness(ends: Indices, creases: Mapping[tuple[int, int], float]) -> Floats:
    """(n_edges,) float; ``ends`` are in the order of their smaller vertices, then of their larger ones."""
    sharpness = np.zeros(len(ends))
    if not creases:
        return sharpness
    known, wanted = np.sort(ends, axis=1), np.sort(np.array(list(creases), dtype=np.intp), axis=1)
    base = max(int(known.max()), int(wanted.max())) + 1
    keys, places = known @ [base, 1], wanted @ [base, 1]
    found = np.minimum(np.searchsorted(keys, places), len(keys) - 1)
    if (missing := np.flatnonzero((keys[found] != places) | (wanted[:, 0] < 0))).size:
        pair = list(creases)[missing[0]]
        raise TopologyError(
            phrase("there is no edge between vertices {a} and {b} to crease", a=pair[0], b=pair[1]), vertices=pair
        )
    values = np.array(list(creases.values()), dtype=float)
    if not (values >= 0).all():
        _checked(float(values[~(values >= 0)][0]))
    sharpness[found] = np.minimum(values, INFINITELY_SHARP)
    return sharpness


def _corner_sharpness(n_vertices: int, corners: Mapping[int, float]) -> Floats:
    sharpness = np.zeros(n_vertices)
    for v, value in corners.items():
        if not 0 <= v < n_vertices:
            raise TopologyError(phrase("there is no vertex {v} to sharpen", v=v), vertices=[v])
        sharpness[v] = _checked(value)
    return sharpness


def _checked(sharpness: float) -> float:
    if not sharpness >= 0:
        raise TopologyError(
            phrase(
                "sharpness {sharpness} is not a number from 0 (smooth) to 10 (infinitely sharp)", sharpness=sharpness
            )
        )
    return min(float(sharpness), INFINITELY_SHARP)

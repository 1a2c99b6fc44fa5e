"""Control objects without extraordinary vertices: the polygon and the rectangular net.

They answer the same questions as a mesh's ``Topology`` (vertices, edges, faces), so that
whatever draws or traces one draws and traces all three.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TypeAlias

import numpy as np

from subdivision.arrays import Indices, Mask, frozen
from subdivision.manifold import TopologyError
from subdivision.topology import Topology
from subdivision.words import phrase


@dataclass(frozen=True)
class Polyline:
    """A control polygon of ``n_vertices`` points, open or closed."""

    n_vertices: int
    closed: bool = False

    def __post_init__(self) -> None:
        least = 3 if self.closed else 1
        if self.n_vertices < least:
            kind = "a closed polygon" if self.closed else "a polygon"
            raise TopologyError(
                phrase("{kind} needs at least {least} points, not {n}", kind=kind, least=least, n=self.n_vertices)
            )

    @cached_property
    def ends(self) -> Indices:
        """(n_edges, 2) int: the two vertices of every edge."""
        a = np.arange(self.n_vertices if self.closed else self.n_vertices - 1)
        return frozen(np.stack([a, (a + 1) % self.n_vertices], axis=1))

    @property
    def n_edges(self) -> int:
        return len(self.ends)

    @property
    def n_faces(self) -> int:
        return 0

    @property
    def face_sizes(self) -> Indices:
        return np.zeros(0, dtype=np.intp)

    @property
    def origin(self) -> Indices:
        return np.zeros(0, dtype=np.intp)

    @property
    def hidden(self) -> Mask:
        return np.zeros(0, dtype=bool)

    @cached_property
    def valence(self) -> Indices:
        """(n_vertices,) int: how many edges meet at each vertex."""
        return frozen(np.bincount(self.ends.ravel(), minlength=self.n_vertices))

    @property
    def euler(self) -> int:
        """V - E."""
        return self.n_vertices - self.n_edges


@dataclass(frozen=True)
class Grid:
    """A rectangular net of ``n_s`` by ``n_t`` points; point ``(i, j)`` is number ``i * n_t + j``.

    ``wrap_s`` and ``wrap_t`` identify opposite sides: a cylinder, or with both a torus.
    ``diagonal`` draws the triangles that the vector (1, 1) makes, instead of quads.
    """

    n_s: int
    n_t: int
    wrap_s: bool = False
    wrap_t: bool = False
    diagonal: bool = False

    def __post_init__(self) -> None:
        for name, n, wrap in (("s", self.n_s, self.wrap_s), ("t", self.n_t, self.wrap_t)):
            least = 3 if wrap else 1
            if n < least:
                why = (
                    "a net, wrapped, needs at least {least} points in direction {name}, not {n}"
                    if wrap
                    else "a net needs at least {least} points in direction {name}, not {n}"
                )
                raise TopologyError(phrase(why, least=least, name=name, n=n))

    @property
    def n_vertices(self) -> int:
        return self.n_s * self.n_t

    @property
    def shape(self) -> tuple[int, int]:
        return self.n_s, self.n_t

    @cached_property
    def numbers(self) -> Indices:
        """(n_s, n_t) int: the number of every point."""
        return frozen(np.arange(self.n_vertices).reshape(self.n_s, self.n_t))

    @cached_property
    def _wrapped(self) -> Indices:
        """The numbers with the first row and column repeated behind the last where sides are identified."""
        return np.pad(self.numbers, ((0, int(self.wrap_s)), (0, int(self.wrap_t))), mode="wrap")

    @cached_property
    def ends(self) -> Indices:
        """(n_edges, 2) int: the two vertices of every edge, along s, then along t, then along the diagonal."""
        w = self._wrapped
        s, t = w[:, : self.n_t], w[: self.n_s]
        pairs = [(s[:-1], s[1:]), (t[:, :-1], t[:, 1:])]
        if self.diagonal:
            pairs.append((w[:-1, :-1], w[1:, 1:]))
        return frozen(np.concatenate([np.stack([a.ravel(), b.ravel()], axis=1) for a, b in pairs]))

    @property
    def n_edges(self) -> int:
        return len(self.ends)

    @cached_property
    def boundary(self) -> Mask:
        """(n_edges,) bool: the edges along an open side."""
        i, j = np.divmod(self.ends, self.n_t)
        along_t = (i[:, 0] == i[:, 1]) & np.isin(i[:, 0], [0, self.n_s - 1]) & (not self.wrap_s)
        along_s = (j[:, 0] == j[:, 1]) & np.isin(j[:, 0], [0, self.n_t - 1]) & (not self.wrap_t)
        return frozen(along_s | along_t)

    @cached_property
    def _loops(self) -> Indices:
        w = self._wrapped
        a, b, c, d = (x.ravel() for x in (w[:-1, :-1], w[1:, :-1], w[1:, 1:], w[:-1, 1:]))
        if self.diagonal:
            return np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)
        return np.stack([a, b, c, d], axis=1)

    @property
    def n_faces(self) -> int:
        return len(self._loops)

    @property
    def face_sizes(self) -> Indices:
        return np.full(len(self._loops), self._loops.shape[1], dtype=np.intp)

    @property
    def origin(self) -> Indices:
        """The corners of the faces, laid end to end."""
        return self._loops.ravel()

    @property
    def hidden(self) -> Mask:
        return np.zeros(self.n_faces, dtype=bool)

    @cached_property
    def valence(self) -> Indices:
        """(n_vertices,) int: how many edges meet at each vertex."""
        return frozen(np.bincount(self.ends.ravel(), minlength=self.n_vertices))

    @property
    def euler(self) -> int:
        """V - E + F."""
        return self.n_vertices - self.n_edges + self.n_faces

    def mesh(self) -> Topology:
        """The same net as a polygon mesh, same numbering."""
        return Topology.from_corners(self.face_sizes, self.origin, self.n_vertices)


Connectivity: TypeAlias = Topology | Grid | Polyline
"""What a control object is connected by."""


def shown_corners(t: Connectivity) -> Mask:
    """(n_corners,) bool: corners of faces that are part of the surface."""
    return np.repeat(~t.hidden, t.face_sizes)


@lru_cache(maxsize=8)
def shown_faces(t: Connectivity) -> tuple[Indices, Indices]:
    """Sizes and corners, laid end to end, of the faces that are part of the surface; asked again, the same arrays."""
    return t.face_sizes[~t.hidden], t.origin[shown_corners(t)]

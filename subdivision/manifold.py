"""From faces to half-edges: the checks that the faces make an oriented surface, and the only search there is."""

from collections.abc import Sequence

import numpy as np

from subdivision.arrays import Indices, stable_order, taken
from subdivision.words import phrase


class TopologyError(ValueError):
    """The faces do not make an oriented manifold, or not one that a scheme accepts.

    ``faces`` and ``vertices`` name the culprits, so that a reader can find their lines.
    """

    def __init__(self, message: str, *, faces: Sequence[int] = (), vertices: Sequence[int] = ()) -> None:
        super().__init__(message)
        self.faces = tuple(int(f) for f in faces)
        self.vertices = tuple(int(v) for v in vertices)


def require_faces(sizes: Indices, origin: Indices, face: Indices, n_vertices: int) -> None:
    """Every face has three corners or more, all of them different and all of them there."""
    if len(sizes) == 0:
        raise TopologyError("there are no faces; a mesh needs at least one")
    if (small := np.flatnonzero(sizes < 3)).size:
        f = int(small[0])
        raise TopologyError(phrase("face {f} has {n} corners; a face needs three or more", f=f, n=sizes[f]), faces=[f])
    if (bad := np.flatnonzero((origin < 0) | (origin >= n_vertices))).size:
        f = int(face[bad[0]])
        raise TopologyError(
            phrase(
                "face {f} names vertex {vertex}, but there are only {n_vertices} vertices (0 to {last})",
                f=f,
                vertex=origin[bad[0]],
                n_vertices=n_vertices,
                last=n_vertices - 1,
            ),
            faces=[f],
        )
    if _differ(sizes, origin):
        return
    visits = np.sort(face * n_vertices + origin)
    if (twice := np.flatnonzero(visits[1:] == visits[:-1])).size:
        f, v = divmod(int(visits[twice[0]]), n_vertices)
        raise TopologyError(phrase("face {f} visits vertex {v} twice; remove the repeated corner", f=f, v=v), faces=[f])


def _differ(sizes: Indices, origin: Indices) -> bool:
    """Whether all corners of each face differ; told only where faces are small and alike."""
    k = int(sizes[0])
    if k > 4 or (sizes != k).any():
        return False
    columns = np.ascontiguousarray(origin.reshape(-1, k).T)
    return not any((columns[i] == columns[j]).any() for i in range(k) for j in range(i))


def paired(a: Indices, b: Indices, face: Indices, n: int) -> tuple[Indices, Indices, Indices]:
    """Twin and edge of the half-edges from ``a`` to ``b``, and the ends of the edges: the only search there is."""
    key = np.minimum(a, b)
    key *= n
    key += np.maximum(a, b)
    order = stable_order(key, n * n)
    sorted_key = taken(key, order)
    first = np.r_[True, sorted_key[1:] != sorted_key[:-1]]
    start = np.flatnonzero(first)
    count = np.diff(np.r_[start, len(key)])
    _require_two_faces_an_edge(a, b, face, order, start, count)
    edge = np.empty(len(key), dtype=np.intp)
    edge[order] = np.cumsum(first) - 1
    twin = np.full(len(key), -1, dtype=np.intp)
    pair = start[count == 2]
    one, other = order[pair], order[pair + 1]
    if (same := np.flatnonzero(a[one] == a[other])).size:
        g, h = int(one[same[0]]), int(other[same[0]])
        raise TopologyError(
            phrase(
                "faces {face} and {other} both run from vertex {a} to vertex {b}; reverse the corner "
                "order of one of them",
                face=face[g],
                other=face[h],
                a=a[g],
                b=b[g],
            ),
            faces=[int(face[g]), int(face[h])],
            vertices=[int(a[g]), int(b[g])],
        )
    twin[one], twin[other] = other, one
    return twin, edge, np.stack([a[order[start]], b[order[start]]], axis=1)


def _require_two_faces_an_edge(
    a: Indices, b: Indices, face: Indices, order: Indices, start: Indices, count: Indices
) -> None:
    if (many := np.flatnonzero(count > 2)).size:
        e = many[0]
        around = [int(face[h]) for h in order[start[e] : start[e] + count[e]]]
        h = order[start[e]]
        raise TopologyError(
            phrase(
                "the edge between vertices {a} and {b} has {n} faces ({faces}); a surface has at most "
                "two there, so remove the others or split the edge",
                a=a[h],
                b=b[h],
                n=count[e],
                faces=", ".join(map(str, around)),
            ),
            faces=around,
            vertices=[int(a[h]), int(b[h])],
        )

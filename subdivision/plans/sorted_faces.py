"""The faces of a mesh sorted by kind: by what each corner sees round it."""

from dataclasses import dataclass

import numpy as np

from subdivision.arrays import Floats, Indices, Mask, distinct, taken
from subdivision.plans.rings import Fan, Kind, Shape, Ways, ring
from subdivision.plans.sharp_rows import creases
from subdivision.topology import Topology

LARGEST_FAN = 32
"""Vertices of more faces are too rare, and their rings too large, for a table of their own."""


@dataclass(frozen=True, eq=False)
class Sorted:
    """The faces of a mesh by kind: those of ``kinds[i]`` are ``faces[start[i]:start[i + 1]]``.

    In a mirror that keeps the first corner they are ``kinds[images[i]]``, or none of them where that is -1.
    """

    kinds: tuple[Kind, ...]
    images: tuple[int, ...]
    faces: Indices
    start: Indices

    def rings(self, t: Topology) -> list[Indices]:
        """What is round the faces of each kind; kinds whose rings are alike are walked together."""
        alike: dict[Shape, list[int]] = {}
        for i, kind in enumerate(self.kinds):
            alike.setdefault(kind.shape, []).append(i)
        ways, start, found = Ways(t), self.start.tolist(), dict[int, Indices]()
        for shape, some in alike.items():
            together = ring(shape).around(ways, np.concatenate([self.faces[start[i] : start[i + 1]] for i in some]))
            begin = 0
            for i in some:
                end = begin + start[i + 1] - start[i]
                found[i], begin = together[:, begin:end], end
        return [found[i] for i in range(len(self.kinds))]


def sorted_faces(t: Topology, apart: Mask, at_most: int) -> Sorted | None:
    """The faces of ``t``, all quads or all triangles; those ``apart`` are never of one kind with others.

    None where there are more than ``at_most`` kinds, or one that cannot be unfolded: with a
    vertex of two faces, or of very many.
    """
    k = t.n_halfedges // t.n_faces
    counts = np.bincount(t.origin, minlength=t.n_vertices)
    if counts.max() > LARGEST_FAN:
        return None
    code, fans = _fans(t, counts)
    corners = code.reshape(-1, k)
    kind = apart.astype(np.intp)
    for i in range(k):
        kind = _ranked(kind * len(fans) + corners[:, i])
        if kind.max() >= at_most:
            return None
    order = np.argsort(kind.astype(np.uint16), kind="stable")
    start = np.concatenate([[0], np.cumsum(np.bincount(kind))])
    first = corners[order[start[:-1]]].tolist()
    kinds = tuple(Kind(tuple(fans[c] for c in row)) for row in first)
    if any(fan.closed and fan.left < 2 for kind in kinds for fan in kind.fans):
        return None
    return Sorted(kinds, _images(first, fans), order, start)


def _images(kinds: list[list[int]], fans: list[Fan]) -> tuple[int, ...]:
    """The place of the image of each of ``kinds``, which are told by the numbers of their fans; -1 for none."""
    numbers = {fan: c for c, fan in enumerate(fans)}
    image = [numbers.get(fan.mirrored, -1) for fan in fans]
    places = {tuple(row): i for i, row in enumerate(kinds)}
    return tuple(places.get(tuple(image[row[-i]] for i in range(len(row))), -1) for row in kinds)


def _fans(t: Topology, counts: Indices) -> tuple[Indices, list[Fan]]:
    """Which of the fans each corner sees."""
    code = taken(counts, t.origin)
    smooth = np.flatnonzero(np.bincount(code))
    fans = [Fan(int(n) - 1, 0, closed=True) for n in smooth]
    rank = np.zeros(len(counts) and int(counts.max()) + 1, dtype=np.intp)
    rank[smooth] = np.arange(len(smooth))
    code = taken(rank, code)
    if not t.is_smooth:
        special = np.zeros(t.n_vertices, dtype=bool)
        special[creases(t).vertices] = True
        at = np.flatnonzero(taken(special, t.origin))
        features = _features(t, at, int(counts.max()))
        first, which = distinct(features)
        code[at] = len(fans) + which
        fans += map(_fan, features[first].tolist())
    return code, fans


def _features(t: Topology, at: Indices, largest: int) -> Floats:
    """(len(at), 4 + 2 (largest + 1)) float: numbers in a fan, closed or not, and sharpness left and right."""
    left, right = (np.zeros((len(at), largest + 1)) for _ in range(2))
    faces = np.zeros((len(at), 2), dtype=np.intp)
    closed = np.zeros(len(at), dtype=bool)
    left[:, 0] = taken(t.edge_sharpness, taken(t.edge, at))
    here, g = np.arange(len(at)), at
    for j in range(1, largest + 1):
        back = taken(t.prev, g)
        ahead = taken(t.twin, back)
        closed[here[ahead == at[here]]] = True
        here, back, ahead = (x[ahead != at[here]] for x in (here, back, ahead))
        left[here, j] = taken(t.edge_sharpness, taken(t.edge, back))
        here, g = here[ahead >= 0], ahead[ahead >= 0]
        faces[here, 0] = j
    here = np.flatnonzero(~closed)
    g = at[here]
    for j in range(1, largest + 1):
        across = taken(t.twin, g)
        here, g = here[across >= 0], taken(t.next, across[across >= 0])
        right[here, j] = taken(t.edge_sharpness, taken(t.edge, g))
        faces[here, 1] = j
    return np.column_stack([faces, closed, taken(t.vertex_sharpness, taken(t.origin, at)), left, right])


def _fan(features: list[float]) -> Fan:
    left, right, closed = (int(x) for x in features[:3])
    first, second = 4, 4 + len(features) // 2 - 2
    sharpness = (*features[first : first + left + 1 + (not closed)], *features[second + 1 : second + right + 1])
    return Fan(left, right, bool(closed), sharpness if any(sharpness) else (), features[3])


def _ranked(numbers: Indices) -> Indices:
    """The same numbers with the gaps closed, in the same order."""
    present = np.bincount(numbers) > 0
    return taken(np.cumsum(present) - 1, numbers)

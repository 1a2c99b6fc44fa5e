"""A face split several times, whatever mesh it is in: which small faces it becomes, and their corners."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from subdivision import refine
from subdivision.arrays import Indices, frozen, inverse
from subdivision.topology import Topology


@dataclass(frozen=True, eq=False)
class Template:
    """A face with ``k`` corners after ``depth`` splits: its corners, the points inside, then those on its sides.

    Attributes
    ----------
    corners : (4 ** depth, k) int
        The corners of its small faces.
    first : (n_points,) int
        Where in ``corners``, flattened, each point comes first.
    image : (n_points,) int
        Where each point is in a mirror that keeps the first corner.
    """

    k: int
    depth: int
    corners: Indices
    first: Indices
    image: Indices

    @property
    def on_side(self) -> int:
        """How many points there are between two corners."""
        return (1 << self.depth) - 1

    @property
    def n_inside(self) -> int:
        return len(self.first) - self.k * (1 + self.on_side)

    def until_side(self, i: int) -> int:
        """How many points there are before those between corner ``i`` and the next."""
        return self.k + self.n_inside + i * self.on_side


@lru_cache(maxsize=16)
def template(k: int, depth: int) -> Template:
    """The split face, whatever mesh it is in: nothing but arithmetic."""
    t = Topology.from_corners(np.array([k]), np.arange(k))
    at = np.array([[0, 0], [1, 0], [1, 1], [0, 1]] if k == 4 else [[0, 0], [1, 0], [0, 1]], dtype=float)
    ends = np.stack([at, np.roll(at, -1, axis=0)], axis=1)
    for _ in range(depth):
        centres = [at[t.origin.reshape(-1, 4)].mean(axis=1)] if k == 4 else []
        at = np.concatenate([at, *centres, at[t.ends].mean(axis=1)])
        t = refine.quads(t) if k == 4 else refine.triangles(t)
    n = 2**depth
    places = (at * n).astype(int).tolist()
    number = {(x, y): v for v, (x, y) in enumerate(places)}
    sides = [
        number[int(n * a[0] + j * (b[0] - a[0])), int(n * a[1] + j * (b[1] - a[1]))]
        for a, b in ends.tolist()
        for j in range(1, n)
    ]
    order = [*range(k), *sorted(set(range(k, len(at))) - set(sides)), *sides]
    renumbered = inverse(np.array(order, dtype=np.intp))
    small, _ = descendants(k, 1, depth)
    corners = renumbered[t.origin.reshape(-1, k)[small]]
    image = renumbered[[number[y, x] for x, y in (places[v] for v in order)]]
    return Template(k, depth, corners, np.unique(corners, return_index=True)[1], image)


@lru_cache(maxsize=64)
def descendants(k: int, n_faces: int, depth: int) -> tuple[Indices, Indices]:
    """Face ``f`` of ``n_faces`` has, ``depth`` splits on, the small faces ``first + each * f``: ``first``, ``each``."""
    first, each = np.zeros(1, dtype=np.intp), np.ones(1, dtype=np.intp)
    for _ in range(depth):
        if k == 4:
            first, each = (4 * first[:, None] + np.arange(4)).ravel(), np.repeat(4 * each, 4)
        else:
            outer = (3 * first[:, None] + np.arange(3)).ravel(), np.repeat(3 * each, 3)
            first, each = np.concatenate([outer[0], 3 * n_faces + first]), np.concatenate([outer[1], each])
        n_faces *= 4
    return frozen(first), frozen(each)


@lru_cache(maxsize=64)
def blocks(k: int, n_faces: int, depth: int) -> tuple[tuple[slice, Indices], ...]:
    """Which small faces follow each other, and which of every split face they are."""
    first, each = descendants(k, n_faces, depth)
    order = np.argsort(first)
    blocks, done = list[tuple[slice, Indices]](), 0
    while done < len(order):
        begin, count = int(first[order[done]]), int(each[order[done]])
        blocks.append((slice(begin, begin + count * n_faces), order[done : done + count]))
        done += count
    return tuple(blocks)

"""Modelling by hand: start with a tube of quads, pull faces out, join two of them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from subdivision.arrays import Floats

Point: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True)
class Clay:
    """A quad mesh under the modeller's hands; every operation gives a new one.

    Faces keep their numbers, so the same face can be pulled again; new ones are added at the end.
    """

    points: tuple[Point, ...]
    faces: tuple[tuple[int, ...], ...]

    @classmethod
    def tube(cls, rings: Sequence[Sequence[Point]]) -> "Clay":
        """Faces between rings of ``m`` points, counter-clockwise as seen from the last ring; both ends are open.

        Side ``k`` between rings ``i`` and ``i + 1`` is face ``i m + k``, and point ``k`` of ring
        ``i`` is number ``i m + k``.
        """
        m = len(rings[0])
        sides = [(i * m + k, i * m + (k + 1) % m) for i in range(len(rings) - 1) for k in range(m)]
        faces = tuple((a, b, b + m, a + m) for a, b in sides)
        return cls(tuple(p for ring in rings for p in ring), faces)

    def with_face(self, *corners: int) -> "Clay":
        """One more face on points that are there."""
        return Clay(self.points, (*self.faces, corners))

    def with_lid(self, ring: Sequence[int], centre: Point) -> "Clay":
        """Close a ring of 2k points, in the lid's own counter-clockwise order, with k quads round a new point."""
        middle, n = len(self.points), len(ring)
        quads = tuple((middle, ring[k], ring[k + 1], ring[(k + 2) % n]) for k in range(0, n, 2))
        return Clay((*self.points, centre), self.faces + quads)

    def pulled(self, face: int, to: Sequence[Point]) -> "Clay":
        """``face`` moves to new corners, listed in its own order, and a wall follows each of its sides.

        The wall behind side ``k`` is face ``len(faces) + k``.
        """
        old, first = self.faces[face], len(self.points)
        new = tuple(range(first, first + len(old)))
        walls = tuple((old[k - 1], old[k], new[k], new[k - 1]) for k in (*range(1, len(old)), 0))
        faces = (*self.faces[:face], new, *self.faces[face + 1 :])
        return Clay(self.points + tuple(to), faces + walls)

    def joined(self, face: int, other: int, turn: int) -> "Clay":
        """Two quads that look at each other become a tunnel; corner 0 of one meets corner ``turn`` of the other."""
        a, b = self.faces[face], self.faces[other]
        end = [b[(turn - k) % 4] for k in range(4)]
        walls = tuple((a[k - 1], a[k], end[k], end[k - 1]) for k in range(4))
        return Clay(self.points, tuple(f for k, f in enumerate(self.faces) if k not in (face, other)) + walls)

    def centred(self, radius: float = 1.4) -> Floats:
        """(n, 3): the points with the middle of their box at the origin, the farthest ``radius`` away."""
        points = np.array(self.points, dtype=float)
        points -= (points.min(axis=0) + points.max(axis=0)) / 2
        points *= radius / np.linalg.norm(points, axis=1).max()
        return points

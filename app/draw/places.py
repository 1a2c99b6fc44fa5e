"""Places for words round points: near, within their pane, over no marker and no other words, and off the strokes.

Which places are free of what is drawn is found for many words at once; what they then take from one another, one
after another.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import islice, pairwise
from typing import TypeAlias

import numpy as np

from app.draw.primitives import Area
from app.draw.scattered import scattered
from subdivision.arrays import Floats, Indices, Mask

DIRECTIONS = np.array([
    (1, 1), (1, 0), (-1, 1), (-1, 0), (1, -1), (-1, -1), (0, 1), (0, -1),
    (0.5, 1), (-0.5, 1), (1, 0.5), (-1, 0.5), (0.5, -1), (-0.5, -1), (1, -0.5), (-1, -0.5),
])  # fmt: skip
"""Right and up, in the order of preference."""

RINGS = np.concatenate([np.arange(12) * 0.5, 6 + np.arange(14) * 2.0])
"""How much further off each round of places is, in heights of the words."""

ROUNDS = np.split(RINGS, [4, 14])
"""Near places are tried first, for mostly one of them is free."""

AT_ONCE = (64, 16, 16)
"""For how many words each round is tried at once; for twice as many each time, as more of them come to it."""

FIRST = 12
"""So many of the best places are tried before all others."""

NEARER = 3.0
"""What it costs to be further off, for each height of the words."""

OVER, MOST_OVER = 0.35, 8
"""What it costs to lie over a place of a stroke, and how many of them count."""

COVERED, TAKEN, OUTSIDE = 1e3, 4e3, 5e4
"""What each marker costs that is covered, at least in part; other words; to reach out of the pane."""

LARGE = 0.125
"""A marker is large with this part of its pane's height as radius, as just before the eye."""

APART = 0.25
"""How far words side by side keep apart, in their heights: they read as two."""

Point: TypeAlias = tuple[float, float]

Room: TypeAlias = tuple[Floats, Floats, Floats, Floats]
"""Left, top, right and bottom."""


@dataclass(frozen=True)
class Wish:
    """Words of ``wide`` by ``tall`` pixels, ``clear`` of the point ``at``; ``away``, right and up, is liked best."""

    at: Point
    wide: float
    tall: float
    clear: float
    away: Point


@dataclass(frozen=True)
class Place:
    """The upper left corner of words, how far ``off`` they are in heights, and whether they lie over no others."""

    left: float
    top: float
    off: float
    is_clear: bool = True


class Ground:
    """What words keep off in a pane: ``discs`` (n, 3), centre and radius of its markers; ``dots`` (n, 2) of strokes.

    ``rooms`` (4, n) are left, top, right and bottom of what lies over the pane already.
    """

    def __init__(self, area: Area, discs: Floats, dots: Floats, rooms: Floats) -> None:
        self.area, self.rooms = area, rooms
        centre, radius = discs[:, :2], discs[:, 2:]
        low, high = np.array(area[:2]), np.add(area[:2], area[2:])
        seen = discs[((centre + radius > low) & (centre - radius < high)).all(axis=1)]
        self._discs = seen[np.argsort(seen[:, 2], kind="stable")]
        self._n_small = int(np.searchsorted(self._discs[:, 2], LARGE * area[3]))
        self._most = float(self._discs[: self._n_small, 2].max(initial=0.0))
        self._centres = scattered(self._discs[: self._n_small, :2], area)
        self._dots = scattered(dots[((dots >= low) & (dots <= high)).all(axis=1)], area)

    def around(self, points: Floats) -> Floats:
        """For each point the radius of the largest marker it is in; 0: it is in none."""
        x, y = points.T
        owner, disc = self._near(x, y, x, y)
        off = self._discs[disc, :2] - points[owner]
        radius = self._discs[disc, 2]
        found = np.zeros(len(points))
        is_in = np.hypot(off[:, 0], off[:, 1]) < radius
        np.maximum.at(found, owner[is_in], radius[is_in])
        return found

    def outside(self, left: Floats, top: Floats, wide: Floats, tall: Floats) -> Mask:
        """Which rooms reach out of the pane."""
        x, y, w, h = self.area
        return np.asarray((left < x) | (top < y) | (x + w - left - wide < 0) | (y + h - top - tall < 0))

    def covered(self, left: Floats, top: Floats, wide: Floats, tall: Floats) -> Indices:
        """(n,): how many markers each room covers, at least in part."""
        right, bottom = left + wide, top + tall
        room, disc = self._near(left, top, right, bottom)
        across, down, radius = self._discs[disc].T
        x = np.minimum(np.maximum(across, left[room]), right[room]) - across
        y = np.minimum(np.maximum(down, top[room]), bottom[room]) - down
        return np.bincount(room[x * x + y * y < radius**2], minlength=len(left))

    def _near(self, left: Floats, top: Floats, right: Floats, bottom: Floats) -> tuple[Indices, Indices]:
        """Pairs of a room and a marker that may reach it: the large ones may reach all."""
        most, n_large = self._most, len(self._discs) - self._n_small
        room, disc = self._centres.near(left - most, top - most, right + most, bottom + most)
        if n_large:
            any_room, large = np.divmod(np.arange(len(left) * n_large), n_large)
            room, disc = np.concatenate([room, any_room]), np.concatenate([disc, large + self._n_small])
        return room, disc

    def over(self, left: Floats, top: Floats, wide: Floats, tall: Floats) -> Floats:
        """(n,): what it costs each room to lie over strokes."""
        room, dot = self._dots.near(left - 1, top - 1, left + wide + 1, top + tall + 1)
        x, y = self._dots.at[dot, 0] - left[room], self._dots.at[dot, 1] - top[room]
        is_in = (x >= 0) & (x <= wide[room]) & (y >= 0) & (y <= tall[room])
        return OVER * np.minimum(np.bincount(room[is_in], minlength=len(left)), MOST_OVER)


def nearest(wishes: Sequence[Wish], ground: Ground) -> Iterator[Place]:
    """The places of the words, one after another: where there is a free one, the best of these."""
    offers, begin = _Offers(wishes, ground), ground.rooms.shape[1]
    rooms = np.concatenate([ground.rooms, np.zeros((4, len(wishes)))], axis=1)
    for k, wish in enumerate(wishes):
        taken = rooms[:, : begin + k]
        place = offers.best(k, taken) or _least_bad(wish, ground, taken)
        left, wide = place.left - APART * wish.tall, wish.wide + 2 * APART * wish.tall
        rooms[:, begin + k] = left, place.top, left + wide, place.top + wish.tall
        yield place


@dataclass(frozen=True, eq=False)
class _Places:
    """Places round a point: ``ring`` (n,) heights of the words off, ``right`` and ``below``, with their ``price``.

    ``part`` (n,) is how much of the room round the point they keep: on the diagonal a corner of the words touches the
    marker, so it may come nearer than a side.
    """

    ring: Floats
    right: Floats
    below: Floats
    part: Floats
    price: Floats

    def corners(self, wishes: Sequence[Wish]) -> tuple[Floats, Floats, Floats, Floats]:
        """(n_wishes, n): left and top of the words at each place; (n_wishes, 1): their width and height."""
        x, y, wide, tall, clear = np.array([(*w.at, w.wide, w.tall, w.clear) for w in wishes]).T[:, :, None]
        reach = clear * self.part + self.ring * tall
        left = x + self.right * (reach + wide / 2) - wide / 2
        top = y + self.below * (reach + tall * 0.8 / 2) - tall / 2
        return left, top, wide, tall


@cache
def _rounds(away: Point) -> tuple[_Places, ...]:
    """The places for words that would like to be there, the near ones first."""
    return tuple(_places(away, tuple(rings.tolist())) for rings in ROUNDS)


@cache
def _places(away: Point, rings: tuple[float, ...]) -> _Places:
    first = np.array(away) / max(*np.abs(away), 1e-9)
    ways = np.vstack([first, DIRECTIONS]) if max(*np.abs(away)) else DIRECTIONS
    ring, turn = np.repeat(np.array(rings), len(ways)), np.tile(np.arange(len(ways)), len(rings))
    way = ways[turn]
    part = np.where(np.abs(way).min(axis=1) > 0.3, 0.75, 1.0)
    return _Places(ring, way[:, 0], -way[:, 1], part, ring * NEARER + turn * 0.12)


@dataclass(frozen=True, eq=False)
class _Offer:
    """Places (n,) that nothing drawn is under, and what they cost, the best first; ``room`` holds all words there."""

    left: Floats
    top: Floats
    ring: Floats
    cost: Floats
    room: Room


class _Offers:
    """The places free of what is drawn, for all words; found for some of them at once, when the first needs them."""

    def __init__(self, wishes: Sequence[Wish], ground: Ground) -> None:
        self._wishes, self._ground = wishes, ground
        self._at_once = list(AT_ONCE)
        self._found: dict[tuple[int, int], _Offer] = {}

    def best(self, k: int, taken: Floats) -> Place | None:
        """The best place for words number ``k`` that is over none of the ``taken`` (4, n) rooms, if any is."""
        least, found, wish = np.inf, None, self._wishes[k]
        for number, places in enumerate(_rounds(wish.away)):
            if least <= NEARER * places.ring[0]:
                break  # whatever is further off costs more
            offer = self._of(number, k)
            n = int(offer.cost.searchsorted(least))
            near = taken[:, meeting(offer.room, taken)] if n else taken
            for some in (slice(0, min(n, FIRST)), slice(FIRST, n)):
                free = ~_over(offer.left[some], offer.top[some], wish, near).any(axis=0)
                if free.any():
                    best = some.start + int(free.argmax())
                    least = float(offer.cost[best])
                    found = Place(float(offer.left[best]), float(offer.top[best]), float(offer.ring[best]))
                    break
        return found

    def _of(self, number: int, k: int) -> _Offer:
        """What a round offers to words number ``k``."""
        if (number, k) not in self._found:
            away = self._wishes[k].away
            alike = (j for j in range(k, len(self._wishes)) if self._wishes[j].away == away)
            members = list(islice(alike, self._at_once[number]))
            self._at_once[number] = min(2 * self._at_once[number], AT_ONCE[0])
            offers = _offered(_rounds(away)[number], [self._wishes[j] for j in members], self._ground)
            self._found.update(((number, j), offer) for j, offer in zip(members, offers, strict=True))
        return self._found.pop((number, k))


def _offered(places: _Places, wishes: Sequence[Wish], ground: Ground) -> Iterator[_Offer]:
    """What the same places offer to each of the words."""
    left, top, wide, tall = places.corners(wishes)
    rooms = np.stack([left.min(axis=1), top.min(axis=1), (left + wide).max(axis=1), (top + tall).max(axis=1)], axis=1)
    who, which = np.nonzero(~ground.outside(left, top, wide, tall))
    free = ground.covered(left[who, which], top[who, which], wide[who, 0], tall[who, 0]) == 0
    who, which = who[free], which[free]
    left, top = left[who, which], top[who, which]
    cost = places.price[which] + ground.over(left, top, wide[who, 0], tall[who, 0])
    order = np.lexsort((cost, who))
    left, top, ring, cost = left[order], top[order], places.ring[which[order]], cost[order]
    ends = np.searchsorted(who, np.arange(len(wishes) + 1)).tolist()
    for (start, stop), (x0, y0, x1, y1) in zip(pairwise(ends), rooms, strict=True):
        there = slice(start, stop)
        yield _Offer(left[there], top[there], ring[there], cost[there], (x0, y0, x1, y1))


def _least_bad(wish: Wish, ground: Ground, taken: Floats) -> Place:
    """The best of all places where none is free."""
    places = _places(wish.away, tuple(RINGS.tolist()))
    left, top, wide, tall = (np.broadcast_to(m, (1, len(places.ring)))[0] for m in places.corners([wish]))
    over = _over(left, top, wish, taken).sum(axis=0)
    cost = places.price + OUTSIDE * ground.outside(left, top, wide, tall)
    cost += TAKEN * over + COVERED * ground.covered(left, top, wide, tall)
    likely = np.flatnonzero(cost <= cost.min() + OVER * MOST_OVER)
    left, top, wide, tall = (m[likely] for m in (left, top, wide, tall))
    best = int((cost[likely] + ground.over(left, top, wide, tall)).argmin())
    k = likely[best]
    return Place(float(left[best]), float(top[best]), float(places.ring[k]), is_clear=not over[k])


def _over(left: Floats, top: Floats, wish: Wish, taken: Floats) -> Mask:
    """(m, n): which of the ``taken`` (4, m) rooms words with their corner at each place are over."""
    return meeting((left, top, left + wish.wide, top + wish.tall), taken[:, :, None])


def meeting(room: Room, taken: Floats) -> Mask:
    """Which of the ``taken`` (4, ...) rooms meet a room, or each its own."""
    left, top, right, bottom = room
    return np.asarray((left < taken[2]) & (taken[0] < right) & (top < taken[3]) & (taken[1] < bottom))

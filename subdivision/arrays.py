"""Array types used everywhere; shapes are written in docstrings as ``(n, 3) float``."""

from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Indices: TypeAlias = NDArray[np.signedinteger[Any]]
Small: TypeAlias = NDArray[np.int32]
"""As scipy wants them."""
Floats: TypeAlias = NDArray[np.float64]
Mask: TypeAlias = NDArray[np.bool_]
Scalar = TypeVar("Scalar", bound=np.generic)


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """Return a read-only view of ``array``."""
    view = array.view()
    view.setflags(write=False)
    return view


def columns(*parts: Indices) -> Indices:
    """Interleave equally long arrays: first of each, then second of each, and so on."""
    table = np.empty((len(parts[0]), len(parts)), dtype=np.intp)
    for k, part in enumerate(parts):
        table[:, k] = part
    return table.ravel()


def short(n: int) -> type[np.signedinteger[Any]]:
    """The type of numbers below ``n``: what is half as long is written in half the time."""
    return np.int32 if n < 2**31 else np.int64


def constant(value: float, n: int) -> NDArray[Any]:
    """``n`` times the same, kept once."""
    once = np.asarray(value)
    return np.ndarray(n, once.dtype, once.data, strides=(0,))  # np.broadcast_to takes ten times as long


def turned(rows: NDArray[Scalar], by: int) -> NDArray[Scalar]:
    """Every entry of (n, k, ...) is the one ``by`` (1 or -1) further on in its row, round and round."""
    out = np.empty_like(rows)
    if by == 1:
        out[:, :-1], out[:, -1] = rows[:, 1:], rows[:, 0]
    else:
        out[:, 1:], out[:, 0] = rows[:, :-1], rows[:, -1]
    return out


def next_corners(sizes: Indices) -> Indices:
    """(n_corners,): the corner after each, round its face, where faces of ``sizes`` corners lie end to end."""
    end = np.cumsum(sizes)
    after = np.arange(1, (int(end[-1]) if len(end) else 0) + 1)
    after[end - 1] = end - sizes
    return after


def stretches(start: Indices, counts: Indices) -> Indices:
    """(sum of counts,): from each ``start`` on so many numbers, one after the other."""
    return np.repeat(start - np.cumsum(counts) + counts, counts) + np.arange(int(counts.sum()))


def inverse(order: Indices) -> Indices:
    """Where each number is in ``order``, which has all of 0, 1, 2, ... once."""
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return place


def stable_order(key: Indices, below: int) -> Indices:
    """What sorts ``key``, (n,) int from 0 and ``below``, equal ones in their order; packed with places if they fit."""
    bits = len(key).bit_length()
    if below >= 2 ** (63 - bits):
        return np.argsort(key, kind="stable")
    packed = key << bits
    packed |= np.arange(len(key))
    packed.sort()
    packed &= 2**bits - 1
    return packed


def taken(array: NDArray[Scalar], index: Indices) -> NDArray[Scalar]:
    """``array[index]`` (rows of it), fast; an index outside stands for the nearest inside."""
    return array.take(index, axis=0, mode="clip")


def distinct(rows: Floats) -> tuple[Indices, Indices]:
    """Where each row of (n, k) there is comes first, and which of those every row is; told apart by weighed sums."""
    sums = (rows * np.random.default_rng(0).random(rows.shape[1])).sum(axis=1)
    _, first, which = np.unique(sums, return_index=True, return_inverse=True)
    if not np.array_equal(rows[first[which]], rows):  # two sums are the same by chance
        _, first, which = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return first, which.ravel()

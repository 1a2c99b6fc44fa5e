"""Kinds of faces in a mirror that keeps the first corner: a kind and its image have one table, read differently."""

from functools import lru_cache

import numpy as np

from subdivision.arrays import Floats, Indices
from subdivision.plans.rings import Kind, Shape, ring
from subdivision.plans.templates import template


def seen_mirrored(table: Floats, kind: Kind, depth: int) -> Floats:
    """The table of ``kind``, made of the ``table`` of its image."""
    return table.take(_places(kind.shape, depth))


@lru_cache(maxsize=256)
def _places(shape: Shape, depth: int) -> Indices:
    """Where each entry of a table is in the table, flattened, of the image."""
    columns = ring_image(shape)
    return template(len(shape), depth).image[:, None] * len(columns) + columns


def ring_image(shape: Shape) -> Indices:
    """(n_vertices,) int: which vertex of the ring of the image each vertex of the ring is.

    Left of a corner becomes right of it; the first face on the right is the first on the left of the next corner,
    and round a closed fan all others are on the left.
    """
    k = len(shape)
    there = {(face.corner, face.turn): face.vertices for face in ring(_image(shape)).faces}
    image = np.empty(ring(shape).n_vertices, dtype=np.intp)
    image[:k] = -np.arange(k) % k
    for face in ring(shape).faces:
        corner, (left, _, closed) = -face.corner % k, shape[face.corner]
        if face.turn == 1:
            found = np.roll(there[(corner + 1) % k, 1], -1)
        else:
            found = np.array(there[corner, left + 1 - face.turn if closed else -face.turn])
        image[list(face.vertices)] = found[-np.arange(k)]
    return image


def _image(shape: Shape) -> Shape:
    """Of open fans left and right change places."""
    turned = [shape[-i] for i in range(len(shape))]
    return tuple((left if closed else right, right if closed else left, closed) for left, right, closed in turned)

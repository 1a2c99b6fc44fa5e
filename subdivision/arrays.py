"""Array types used everywhere; shapes are written in docstrings as ``(n, 3) float``."""

from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Indices: TypeAlias = NDArray[np.intp]
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


def taken(array: NDArray[Scalar], index: Indices) -> NDArray[Scalar]:
    """``array[index]`` (rows of it), fast; an index outside stands for the nearest inside."""
    return array.take(index, axis=0, mode="clip")

"""Slow in, slow out: how time becomes movement.

Source: smoothstep, ``3 t^2 - 2 t^3``; stages keep their ends, where it has slope 0.
"""

import numpy as np

from subdivision.arrays import Floats


def eased(at: float) -> float:
    """A stage position with the fraction eased; whole positions stay."""
    k = np.floor(at)
    t = at - k
    return float(k + t * t * (3 - 2 * t))


def grown(birth: Floats) -> Floats:
    """(n,) size of points whose ``birth`` is 0..1: they overshoot a little and settle, so that the eye finds them."""
    t = np.clip(birth, 0, 1)
    return np.asarray(t * (1 + 0.45 * np.sin(np.pi * t)), dtype=float)

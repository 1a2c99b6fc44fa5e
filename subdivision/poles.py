"""A vertex of any valence in a closed mesh of triangles, with nothing but regular vertices near."""

import numpy as np

from subdivision import refine
from subdivision.topology import Topology


def pole(valence: int, splits: int) -> Topology:
    """A double cone, every triangle split in four ``splits`` times: 2 ** splits steps from either tip to its rim.

    Half-edge 0 leaves a tip.
    """
    rim = np.arange(valence)
    here, ahead = 2 + rim, 2 + (rim + 1) % valence
    cones = np.stack([0 * rim, here, ahead, 0 * rim + 1, ahead, here], axis=1)
    t = Topology.from_corners(np.full(2 * valence, 3), cones.ravel())
    for _ in range(splits):
        t = refine.triangles(t)
    return t

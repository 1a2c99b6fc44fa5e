"""The light on a surface, worked out at the corners of its triangles.

A processor that draws a picture works it out at every pixel otherwise, which takes longer than all the rest.
"""

import numpy as np

from app.draw.picture import Camera
from app.draw.regular import Facets
from app.draw.solid import SURFACE_LIGHT, lit
from subdivision.arrays import Floats


def glow(cut: Facets, camera: Camera) -> Floats:
    """(n,): how bright each point of the facets is, on the side of its polygon that is seen; 1 shows the colour."""
    first, second, third = (cut.points[cut.triangles[:, k]] for k in range(3))
    to_eye = camera.axes[2] if camera.scale else camera.position - first
    front = np.bincount(cut.owner, (np.cross(second - first, third - first) * to_eye).sum(axis=1))
    side = np.ones(len(cut.points))
    side[cut.triangles[front[cut.owner] < 0]] = -1.0
    return lit(cut.normals @ camera.axes.T * side[:, None], SURFACE_LIGHT)

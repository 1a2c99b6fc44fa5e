"""What hides what, for painters without a z-buffer of their own: one in numpy, at about the size of the picture."""

from dataclasses import dataclass

import numpy as np

from subdivision.arrays import Floats, Indices, Mask

MOST = 1200
"""Columns or rows of the buffer."""


@dataclass(frozen=True, eq=False)
class Depth:
    """A z-buffer.

    ``nearest`` (rows, columns): distance from the eye of what is seen there, infinite where nothing is;
    ``owner``: the number of the triangle, -1 where there is none; ``scale``: cells to a pixel.
    """

    nearest: Floats
    owner: Indices
    scale: float

    def shows(self, places: Floats, slack: float) -> Mask:
        """(n,) bool: whether points (n, 3) of pixels and depth are in front, or no more than ``slack`` behind.

        The farthest of the cells around decides, so that a point on the rim of a face is not hidden by it.
        """
        rows, columns = self.nearest.shape
        x = np.floor(places[:, 0] * self.scale).astype(np.intp)
        y = np.floor(places[:, 1] * self.scale).astype(np.intp)
        farthest = np.zeros(len(places))
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                inside = (x + dx >= 0) & (x + dx < columns) & (y + dy >= 0) & (y + dy < rows)
                here = np.full(len(places), np.inf)
                here[inside] = self.nearest[y[inside] + dy, x[inside] + dx]
                farthest = np.maximum(farthest, here)
        return np.asarray(places[:, 2] <= farthest + slack)


def depth_of(corners: Floats, width: float, height: float) -> Depth:
    """Of triangles (n, 3, 3), corners in pixels and depth."""
    scale = min(1.0, MOST / max(width, height))
    rows, columns = int(np.ceil(height * scale)), int(np.ceil(width * scale))
    nearest, owner = np.full((rows, columns), np.inf), np.full((rows, columns), -1, dtype=np.intp)
    flat = corners * [scale, scale, 1.0]
    low = np.clip(np.floor(flat[:, :, :2].min(axis=1) - 0.5), 0, [columns, rows]).astype(np.intp)
    high = np.clip(np.ceil(flat[:, :, :2].max(axis=1) + 0.5), 0, [columns, rows]).astype(np.intp)
    for k, ((x0, y0), (x1, y1)) in enumerate(zip(low, high, strict=True)):
        if x1 > x0 and y1 > y0:
            _fill(nearest[y0:y1, x0:x1], owner[y0:y1, x0:x1], flat[k] - [x0, y0, 0.0], k)
    return Depth(nearest, owner, scale)


def _fill(nearest: Floats, owner: Indices, triangle: Floats, number: int) -> None:
    """One triangle in its own corner of the buffer.  Depth is linear on the screen enough at this size."""
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = triangle
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if abs(area) < 1e-9:
        return
    y, x = np.mgrid[0.5 : nearest.shape[0], 0.5 : nearest.shape[1]]
    v = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
    w = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
    depth = az + v * (bz - az) + w * (cz - az)
    seen = (v >= -1e-9) & (w >= -1e-9) & (v + w <= 1 + 1e-9) & (depth < nearest)
    nearest[seen], owner[seen] = depth[seen], number

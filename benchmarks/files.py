"""A control mesh as plain arrays, and the binary file in which other processes are given one."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Control:
    """Plain arrays, as any engine takes them; ``creases`` are pairs of vertices, all of one ``sharpness``."""

    name: str
    points: np.ndarray
    sizes: np.ndarray
    corners: np.ndarray
    creases: np.ndarray
    sharpness: float = 10.0

    @property
    def faces(self) -> np.ndarray:
        """(n, k) int, where all faces have k corners."""
        return self.corners.reshape(len(self.sizes), -1)


def write(control: Control, path: Path) -> None:
    """The file that opensubdiv.cpp reads."""
    counts = [len(control.points), len(control.sizes), len(control.corners), len(control.creases)]
    sharpness = np.full(len(control.creases), control.sharpness, dtype=np.float32)
    parts = [np.array(counts, np.int32), control.points.astype(float)]
    parts += [x.astype(np.int32) for x in (control.sizes, control.corners, control.creases)]
    path.write_bytes(b"".join(np.ascontiguousarray(x).tobytes() for x in (*parts, sharpness)))


def read(path: Path) -> Control:
    """What ``write`` wrote; all sharpness counts as infinite."""
    counts = np.fromfile(path, np.int32, 4).astype(int)
    points = np.fromfile(path, float, 3 * counts[0], offset=16).reshape(-1, 3)
    rest = np.fromfile(path, np.int32, offset=16 + points.nbytes).astype(np.intp)
    sizes, corners, creases, _ = np.split(rest, np.cumsum([counts[1], counts[2], 2 * counts[3]]))
    return Control(path.name, points, sizes, corners, creases.reshape(-1, 2))

"""Rectangular control nets, flat topologically and never flat in space; cylinder and torus by wrapping."""

import numpy as np

from subdivision.rows import Grid
from subdivision.shapes.build import turns
from subdivision.trace import Mesh


def net(n_s: int = 5, n_t: int = 5, *, diagonal: bool = False) -> Mesh:
    """A hilly net of ``n_s`` by ``n_t`` points over a square: Figures 2-5 and 8-10; ``diagonal`` for 6 and 7.

    Bicubics and quartics need 4 points a side to make a surface at all, and 5 for it to grow.
    """
    x, y = np.meshgrid(np.linspace(-1.1, 1.1, n_s), np.linspace(-1.1, 1.1, n_t), indexing="ij")
    z = 0.4 * np.sin(2.1 * x + 1.1 * y - 0.6) + 0.3 * np.sin(1.3 * x - 1.8 * y + 1.8)
    points = np.stack([x, y, z - (z.min() + z.max()) / 2], axis=-1)
    return Mesh(Grid(n_s, n_t, diagonal=diagonal), points.reshape(-1, 3))


def landscape(*, diagonal: bool = False) -> Mesh:
    """A net of six by six points with steep sides, for what smooths: Figures 8-10.  V/E/F 36/60/25; or 36/85/50 cut.

    A tableland, a hollow before it, a hill beside it.  The outer points stand closer, since nets lose their rim.
    """
    side = np.array([-1.0, -0.68, -0.24, 0.24, 0.68, 1.0])
    x, y = np.meshgrid(side, side, indexing="ij")
    z = 0.8 * np.array([
        [0.0, 0.1, 0.2, 0.1, 0.0, -0.1],
        [0.1, 0.2, 1.2, 1.1, 0.2, 0.0],
        [0.1, 0.1, 1.1, 1.3, 0.1, 0.1],
        [0.0, -0.8, -0.7, 0.1, 0.2, 0.3],
        [0.1, -0.6, -0.7, 0.0, 0.8, 0.4],
        [0.3, 0.0, 0.0, 0.1, 0.5, 0.5],
    ])  # fmt: skip
    points = np.stack([x, y, z - (z.min() + z.max()) / 2], axis=-1)
    return Mesh(Grid(6, 6, diagonal=diagonal), points.reshape(-1, 3))


def cylinder_net(n_s: int = 7, n_t: int = 6, *, diagonal: bool = False) -> Mesh:
    """A net wrapped in t to a vase: ``n_s`` rings from the rim down, ``n_t`` points each, counter-clockwise."""
    down = np.linspace(0, 1, n_s)[:, None]
    angle = turns(n_t)[None, :]
    radius = 0.72 + 0.33 * np.sin(2 * np.pi * (down + 0.45))
    height = 1.2 * (1 - 2 * down) + 0 * angle
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=-1)
    return Mesh(Grid(n_s, n_t, wrap_t=True, diagonal=diagonal), points.reshape(-1, 3))


def torus_net(n_s: int = 5, n_t: int = 4, *, diagonal: bool = False) -> Mesh:
    """A net wrapped both ways: ``n_s`` points the long way round, ``n_t`` round the tube; no rim to lose."""
    around, tube = turns(n_s)[:, None], turns(n_t, start=0.5)[None, :]
    out, height = 1 + 0.55 * np.cos(tube), 0.55 * np.sin(tube) + 0 * around
    points = np.stack([out * np.cos(around), out * np.sin(around), height], axis=-1)
    return Mesh(Grid(n_s, n_t, wrap_s=True, wrap_t=True, diagonal=diagonal), points.reshape(-1, 3))

"""How large what a scheme makes will be, known before it is made; and what this machine has room for."""

import os
from pathlib import Path

from subdivision.manifold import TopologyError
from subdivision.rows import Connectivity, Grid, Polyline
from subdivision.scheme import Scheme
from subdivision.topology import Topology
from subdivision.words import phrase

SWIFT, STAGED, TRACED = 200, 1_000, 1_600
"""Bytes that a face takes at most while it is made: by whole arrays, stage by stage, and with all stages kept.

Measured: 25 to 192 for points alone, 200 to 930 by stages, 370 to 1580 where the stages stay."""

SHARE = 0.8
"""How much of the memory that is free may be filled."""

UNKNOWN = 4 << 30
"""Bytes that a machine is thought to have if it does not tell."""

FEW = 100_000
"""So many faces fit anywhere; the machine is not asked."""

MOST_LEVELS = 64
"""However small, whatever grows has more faces than fit long before."""

SAMPLE = 40
"""Points each way of a net that shows how much a step shortens one, whatever its size."""


class TooLarge(TopologyError):
    """What there is no room for, with the numbers and the deepest level that there is room for."""


def faces_after(scheme: Scheme, t: Connectivity, levels: int) -> int:
    """How many faces, or points of a polygon, ``levels`` steps make.

    Raises
    ------
    TopologyError
        If the scheme refuses the control object.
    """
    scheme.require(t)
    if isinstance(t, Topology):
        return scheme.faces_after(t, levels)
    return after(t, lost(scheme, t) if levels else (0, 0), levels)


def after(t: Polyline | Grid, less: tuple[int, int], levels: int) -> int:
    """The same, where it is known by how much a step shortens what it has doubled."""
    if isinstance(t, Polyline):
        return _side(t.n_vertices, less[0], levels)
    s, u = (_side(n, each, levels) for n, each in zip(t.shape, less, strict=True))
    return (s - (not t.wrap_s)) * (u - (not t.wrap_t)) * (1 + t.diagonal)


def lost(scheme: Scheme, t: Polyline | Grid) -> tuple[int, int]:
    """By how much a step shortens a polygon, or the sides of a net, that it has doubled; read off a small one."""
    small = sample(t)
    fine = scheme.step(small).topology
    if isinstance(small, Polyline):
        return 2 * small.n_vertices - fine.n_vertices, 0
    assert isinstance(fine, Grid)
    return 2 * small.n_s - fine.n_s, 2 * small.n_t - fine.n_t


def sample(t: Polyline | Grid) -> Polyline | Grid:
    """A small polygon or net of the same kind."""
    if isinstance(t, Polyline):
        return Polyline(min(t.n_vertices, SAMPLE), t.closed)
    return Grid(min(t.n_s, SAMPLE), min(t.n_t, SAMPLE), t.wrap_s, t.wrap_t, t.diagonal)


def _side(n: int, less: int, levels: int) -> int:
    return max((n - less << levels) + less, 0)


def require_room(scheme: Scheme, t: Connectivity, levels: int, bytes_a_face: int, most: int | None = None) -> None:
    """Ask for no more levels than fit: ``most`` faces, or as many as this machine has memory for.

    Raises
    ------
    TooLarge
    """
    held = min(levels, MOST_LEVELS)
    corners = t.n_halfedges if isinstance(t, Topology) else t.n_vertices
    if held <= 0 or (most is None and corners * 4**held <= FEW) or scheme.refuses(t):
        return  # who refuses says why when it is made
    fitting = room(bytes_a_face) if most is None else most
    for level in range(1, held + 1):
        if (faces := faces_after(scheme, t, level)) > fitting:
            raise TooLarge(_too_deep(levels, level, faces, fitting))


def _too_deep(levels: int, level: int, faces: int, most: int) -> str:
    """What to choose instead of ``levels``, where ``level`` is the first that does not fit."""
    if level == 1:
        return phrase("a level would make {faces:,} faces, and there is room for {most:,}; choose a smaller control "
                      "object", faces=faces, most=most)  # fmt: skip
    return phrase(
        "{levels} levels would make {faces:,} faces; choose fewer levels (at most {fitting}, for there is room for "
        "{most:,} faces)"
        if level == levels
        else "{levels} levels would make {faces:,} faces at level {level} already; choose fewer levels (at most "
        "{fitting}, for there is room for {most:,} faces)",
        levels=levels, faces=faces, level=level, fitting=level - 1, most=most,
    )  # fmt: skip


def room(bytes_a_face: int) -> int:
    """How many faces the free memory has room for."""
    return int(SHARE * free_memory()) // bytes_a_face


def free_memory() -> int:
    """Bytes that this process may still fill, as far as the system tells."""
    told = [each for each in (_of_linux(), _of_container()) if each is not None]
    return min(told) if told else _of_others()


def _of_linux() -> int | None:
    try:
        rows = Path("/proc/meminfo").read_text().splitlines()
    except OSError:
        return None
    return next((int(row.split()[1]) << 10 for row in rows if row.startswith("MemAvailable:")), None)


def _of_container() -> int | None:
    """What a container leaves, if this is one with a limit."""
    group = Path("/sys/fs/cgroup")
    try:
        return int((group / "memory.max").read_text()) - int((group / "memory.current").read_text())
    except (OSError, ValueError):  # there is none, or it says "max"
        return None


def _of_others() -> int:
    """Half of what is built in, where it is not told how much is free."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2
    except (AttributeError, ValueError, OSError):
        return UNKNOWN

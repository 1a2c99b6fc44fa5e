"""How much memory the process has, and whether it grows."""

import ctypes
import gc
import sys
from contextlib import suppress
from itertools import combinations
from pathlib import Path
from statistics import median

MOST = 30.0
"""Megabytes by which the second half of a run may grow."""

FEWEST = 5000
"""Actions: in a shorter run all that is kept for later is still being filled."""

ALIKE = 1.1
"""Memory is compared where the picture is at most so much larger: several bytes go with each of its pixels."""

Sample = tuple[int, float, int]
"""Actions done, megabytes, pixels of the picture."""


def resident() -> float:
    """Megabytes, when everything that is free has been given back; 0 where the system does not tell."""
    gc.collect()
    if sys.platform == "linux":
        with suppress(OSError, AttributeError):
            ctypes.CDLL("libc.so.6").malloc_trim(0)
    try:
        rows = Path("/proc/self/status").read_text().splitlines()
    except OSError:
        return 0.0
    return next((int(row.split()[1]) / 1024 for row in rows if row.startswith("VmRSS")), 0.0)


def growth(samples: list[Sample]) -> float:
    """Megabytes that the second half of a run has grown: the median slope of its alike pairs, over its length."""
    half = [each for each in samples if each[0] >= samples[-1][0] / 2]
    slopes = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in combinations(half, 2) if _are_alike(a[2], b[2])]
    return median(slopes) * (half[-1][0] - half[0][0]) if slopes else 0.0


def _are_alike(pixels: int, others: int) -> bool:
    return max(pixels, others) <= ALIKE * min(pixels, others)


def curve(samples: list[Sample], columns: int = 20) -> str:
    """So many samples of the run, in a row."""
    some = samples[:: max(len(samples) // columns, 1)]
    return "  ".join(f"{count}: {megabytes:.0f}" for count, megabytes, _ in some)

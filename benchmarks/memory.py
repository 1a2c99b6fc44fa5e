"""``python -m benchmarks.memory MESH SCHEME LEVELS``: bytes that one cold run adds to the peak of a fresh process."""

import sys
from pathlib import Path

from benchmarks.engines import Ours, peak
from benchmarks.files import read
from subdivision.schemes import SCHEMES

path, name, levels = sys.argv[1:]
scheme = next(scheme for scheme in SCHEMES if scheme.name == name)
control = read(Path(path))
Ours(control, scheme, 1).refined()
before = peak()
Ours(control, scheme, int(levels)).refined()
print(peak() - before)

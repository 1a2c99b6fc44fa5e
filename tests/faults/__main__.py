"""What the program writes, and everything that can befall it meanwhile: ``python -m tests.faults --times 100``.

Each kind of file is written while the program is killed, the disk runs full, the folder may not be written to or is
taken away.  What was there before must stay, byte for byte, until the new one is whole.
"""

import argparse
import importlib
import random
import sys
import tempfile
import time
from functools import cache
from pathlib import Path

from tests.faults.child import sound
from tests.faults.kinds import KINDS
from tests.faults.series import EACH, autosave

LOADED = (
    "app.draw.film", "app.draw.pdf", "app.draw.raster", "app.draw.seen", "app.export.deck", "app.export.handout",
    "app.export.pages", "app.gui.autosave", "app.gui.saving", "app.page", "pptx", "pyvista",
    "vtkmodules.vtkRenderingOpenGL2",
)  # fmt: skip
"""What takes long to import, so before children are made."""


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.faults", description=__doc__)
    parser.add_argument("--times", type=int, default=100, help="how often each fault (100)")
    parser.add_argument("--only", nargs="*", default=[], metavar="KIND", help=f"some of autosave, {', '.join(KINDS)}")
    parser.add_argument("--seed", type=int, default=None, help="to see the same again")
    options = parser.parse_args()
    random.seed(options.seed)
    for name in LOADED:
        importlib.import_module(name)
    sys.modules["app.draw.raster"]._studio = cache(lambda: None)  # pictures without OpenGL, which outlives no fork
    begin, wrong, trials = time.perf_counter(), [], 0
    for verdict in _verdicts(options.times, options.only or ["autosave", *KINDS]):
        print(verdict, flush=True)
        for each in verdict.wrong[:5]:
            print(f"     {each}", flush=True)
        wrong += verdict.wrong
        trials += verdict.seen.total()
    took = time.perf_counter() - begin
    print(f"{trials} faults in {took:.0f} s: " + (f"{len(wrong)} failures" if wrong else "nothing was lost"))
    return int(bool(wrong))


def _verdicts(times, names):
    for name in names:
        if name == "autosave":
            yield autosave(times)
            continue
        with tempfile.TemporaryDirectory() as folder:
            made = sound(KINDS[name], Path(folder))
            yield from (series(KINDS[name], times, made) for series in EACH)


if __name__ == "__main__":
    sys.exit(main())

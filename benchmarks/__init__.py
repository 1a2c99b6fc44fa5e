"""How fast the engine is, beside the engines a lecturer could use instead, in one run on one machine."""

import os

for pool in ("OPENBLAS", "OMP", "MKL"):  # one thread; numpy reads this when it is imported, which is later
    os.environ[f"{pool}_NUM_THREADS"] = "1"

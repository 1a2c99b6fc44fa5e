"""The program: state, drawing, figures, command line and window."""

import gc
import os
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # small products wait for busy threads, which costs pictures

gc.set_threshold(50_000, 20, 50)  # what is imported stays: to look for garbage in it takes a quarter of the start

HERE = Path(__file__).parent
ASSETS = HERE / "assets" if (HERE / "assets").is_dir() else HERE.parent / "assets"
"""Fonts, icons and meshes: inside an installed package, beside it in a checkout."""

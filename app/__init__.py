"""The program: state, drawing, figures, command line and window."""

import os
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # small products wait for busy threads, which costs pictures

HERE = Path(__file__).parent
ASSETS = HERE / "assets" if (HERE / "assets").is_dir() else HERE.parent / "assets"
"""Fonts, icons and meshes: inside an installed package, beside it in a checkout."""

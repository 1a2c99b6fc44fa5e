"""The program: state, drawing, figures, command line and window."""

from pathlib import Path

HERE = Path(__file__).parent
ASSETS = HERE / "assets" if (HERE / "assets").is_dir() else HERE.parent / "assets"
"""Fonts, icons and meshes: inside an installed package, beside it in a checkout."""

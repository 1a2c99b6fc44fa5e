"""The window: the only place that knows Qt."""

import os

from app.lean import put_off

os.environ["QT_API"] = "pyside6"  # before pyvistaqt asks
put_off("matplotlib.pyplot")  # which pyvista brings along

import pyvista.plotting  # noqa: E402, F401  (before Qt, which looks into every import that comes after its own)

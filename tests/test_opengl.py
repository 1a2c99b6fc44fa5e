"""Where there is no OpenGL, or one too old: pictures are drawn all the same, nearly as they are with it."""

import os
import subprocess
import sys
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import lessons
from app.figures import png, poster
from app.state import at_stop, start

ROOT = Path(__file__).parent.parent
HIDDEN = {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}
WITHOUT = ({"__EGL_VENDOR_LIBRARY_FILENAMES": "/nowhere"}, {"MESA_GL_VERSION_OVERRIDE": "2.1"})


@pytest.mark.skipif(sys.platform != "linux", reason="OpenGL is taken away by variables of Linux")
@pytest.mark.parametrize("lacking", WITHOUT)
def test_without_opengl_pictures_are_drawn_from_their_shapes(tmp_path, lacking):
    env = {name: value for name, value in os.environ.items() if name not in HIDDEN} | lacking
    done = subprocess.run(
        [sys.executable, "-m", "app", "figures", "14", "--format", "png", "--size", "960x540", "--out", str(tmp_path)],
        cwd=ROOT, env=env, capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stderr.startswith("2 files")
    lesson = lessons.find("14")
    usual = Image.open(BytesIO(png(at_stop(start(lesson), poster(lesson)), (960, 540), "white")))
    drawn = np.asarray(Image.open(tmp_path / "figure_14_cube.png"), dtype=float)
    assert np.abs(drawn - np.asarray(usual)).mean() < 2
    assert drawn.std() > 20

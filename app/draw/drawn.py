"""A scene as pixels where there is no OpenGL: the shapes of its vector picture, filled in."""

import sys
from functools import cache
from typing import Any
from xml.etree import ElementTree

from matplotlib.transforms import Affine2D

from app.draw.pdf import Pen
from app.draw.picture import Scene
from app.draw.primitives import Area
from app.draw.projection import projected


@cache
def has_opengl() -> bool:
    """Whether VTK can draw off the screen here; where it cannot, its first picture would end the process."""
    from vtkmodules import vtkRenderingOpenGL2  # noqa: F401  (the class below needs its overrides)
    from vtkmodules.vtkCommonCore import vtkLogger
    from vtkmodules.vtkRenderingCore import vtkRenderWindow

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # the answer is all that is wanted
    try:
        window: Any = vtkRenderWindow()
        window.SetOffScreenRendering(1)
        # This class is what VTK takes where nothing else works; it answers yes, and draws by a library of its own.
        if window.GetClassName() == "vtkOSOpenGLRenderWindow" and sys.platform.startswith("linux"):
            return False
        return bool(window.SupportsOpenGL())
    finally:
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)


def draw(canvas: Any, scene: Scene, area: Area, height: float) -> None:
    """Fill the shapes of a scene into its pane of a canvas of matplotlib's, ``height`` pixels high."""
    parser = ElementTree.XMLParser()
    for text in ("<svg>", *projected(scene, area, height, "pane"), "</svg>"):
        parser.feed(text)  # in small pieces: other threads need not wait for a long one
    Pen(canvas, Affine2D().scale(1, -1).translate(0, height), area).shapes(parser.close())

"""The OpenGL that the screen offers, and whether a graphics card does its work."""

from functools import cache

from PySide6.QtGui import QOffscreenSurface, QOpenGLContext

GL_RENDERER, GL_VERSION = 0x1F01, 0x1F02
BY_PROCESSOR = ("llvmpipe", "softpipe", "swrast", "swiftshader", "software")


def has_opengl() -> bool:
    """Whether the screen offers the OpenGL that VTK needs."""
    return opengl()[0] >= (3, 2)


def is_software() -> bool:
    """Whether the processor draws, slowly, and no graphics card."""
    return any(name in opengl()[1].lower() for name in BY_PROCESSOR)


@cache
def opengl() -> tuple[tuple[int, int], str]:
    """The version of OpenGL that the screen offers, (0, 0) if none; and who makes it, in its own words."""
    context = QOpenGLContext()
    surface = QOffscreenSurface()
    surface.create()
    if not context.create() or not context.makeCurrent(surface):
        return (0, 0), "none"
    functions = context.functions()
    words = ", ".join(str(functions.glGetString(which)) for which in (GL_RENDERER, GL_VERSION))
    major, minor = context.format().version()
    context.doneCurrent()
    return (major, minor), words

"""A picture as pixels: panes in space from an off-screen window, everything flat painted over them by Agg.

There is one off-screen window for the whole program; it changes its size but is not built anew.
It needs no display: without one VTK is asked for EGL before it makes its first window.  Where there is no OpenGL
at all, the shapes of the vector picture are filled in instead.
"""

import os
import sys
from collections.abc import Iterable
from functools import cache
from math import ceil
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.path import Path as Outline
from matplotlib.transforms import Affine2D, Bbox
from numpy.typing import NDArray

from app.draw.flat import FLAT, Disc, Part, Polygon
from app.draw.layout import fitted, overlay, pane_areas
from app.draw.picture import Colour, Picture, Scene
from app.draw.primitives import ANCHOR, RIM, Area, Mark, Plate, Primitive, Stroke, Text, Tiles
from app.draw.samples import PLACES, Mean
from app.draw.type import measure, path
from subdivision.arrays import Floats

MANY = 20_000
"""With more faces a scene is drawn once for all samples of a pixel."""

Pixels = NDArray[np.uint8]
"""(height, width, 4): red, green, blue, opacity."""

_AGG: Any = RendererAgg
_QUARTER = 0.5522847498307936
"""How far a cubic's handle is from its end, for a quarter of a circle of radius 1."""


def image(
    picture: Picture,
    width: int,
    height: int,
    *,
    transparent: bool = False,
    words: bool = True,
    flat: bool = False,
    is_frame: bool = False,
) -> Pixels:
    """The picture at a size in pixels; ``words`` includes the caption.

    ``flat`` fills shapes in, in any thread.  A frame of a film takes half as long and is not as smooth.
    """
    canvas = _AGG(width, height, 72)
    pixels = np.asarray(canvas.buffer_rgba())
    pixels[:] = (0, 0, 0, 0) if transparent else (*_bytes(picture.background), 255)
    for pane, area in zip(picture.panes, pane_areas(picture, width, height, words), strict=True):
        if not isinstance(pane.content, Scene):
            continue
        if flat or (studio := _studio()) is None:
            from app.draw.drawn import draw

            draw(canvas, pane.content, area, height)
            continue
        x, y, w, h = area
        seen = studio.picture(
            pane.content,
            picture.background,
            (int(w), int(h)),
            height,
            transparent=transparent,
            at_once=(is_frame or _is_much(pane.content)) and not pane.content.is_translucent,
        )
        pixels[int(y) : int(y + h), int(x) : int(x + w)] = seen
    brush = Brush(canvas, Affine2D().scale(1, -1).translate(0, height))
    for each in overlay(picture, width, height, words=words):
        brush.paint(each)
    return pixels.copy()


def painted(flat: Iterable[Primitive], area: Area, scale: float) -> Pixels:
    """Flat things alone on nothing: what of them is in an area, so many times as fine."""
    x, y, w, h = area
    canvas = _AGG(ceil(w * scale), ceil(h * scale), 72)
    brush = Brush(canvas, Affine2D().translate(-x, -y).scale(scale, -scale).translate(0, canvas.height))
    for each in flat:
        brush.paint(each)
    return np.array(canvas.buffer_rgba())


def _is_much(scene: Scene) -> bool:
    """Whether it takes long to draw a scene for each sample of a pixel."""
    return sum(len(faces.sizes) for faces in scene.faces) > MANY


class _Studio:
    """The off-screen window."""

    def __init__(self) -> None:
        import pyvista
        from vtkmodules.vtkCommonCore import vtkLogger
        from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

        from app.draw.vtk import ScenePainter

        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # a DISPLAY that leads nowhere is not worth a warning
        self._plotter = pyvista.Plotter(off_screen=True, lighting="none", border=False)
        window: Any = self._plotter.render_window
        window.SetAlphaBitPlanes(1)
        self._window = window
        self._painter = ScenePainter(self._plotter)
        self._filter = vtkWindowToImageFilter

    def picture(
        self,
        scene: Scene,
        background: Colour,
        size: tuple[int, int],
        height: float,
        *,
        transparent: bool,
        at_once: bool,
    ) -> Pixels:
        """A scene alone; ``height`` is the whole picture's; ``at_once``: drawn once for all samples of a pixel."""
        self._window.SetSize(*size)
        self._window.SetMultiSamples(len(PLACES) if at_once else 0)
        self._painter.background((0.0, 0.0, 0.0) if transparent else background)
        self._painter.renderer.SetBackgroundAlpha(0.0 if transparent else 1.0)
        self._painter.look(fitted(scene.camera, (0.0, 0.0, *size)))
        self._painter.paint(scene, height)
        self._painter.clip(scene)
        pixels = self._grabbed(size) if at_once else self._one_by_one(size)
        if transparent:
            return _unmultiplied(pixels)
        pixels[..., 3] = 255
        return pixels

    def _one_by_one(self, size: tuple[int, int]) -> Pixels:
        """What is in the window, drawn for each sample of a pixel."""
        mean = Mean()
        for place in PLACES:
            self._painter.nudge(*place)
            mean.add(self._grabbed(size))
        return mean.picture()

    def _grabbed(self, size: tuple[int, int]) -> Pixels:
        from vtkmodules.util import numpy_support

        self._window.Render()
        to_numpy: Any = numpy_support.vtk_to_numpy
        grab: Any = self._filter()
        grab.SetInput(self._window)
        grab.SetInputBufferTypeToRGBA()
        grab.ReadFrontBufferOff()
        grab.ShouldRerenderOff()
        grab.Update()
        flat = to_numpy(grab.GetOutput().GetPointData().GetScalars())
        return np.array(flat.reshape(size[1], size[0], 4)[::-1], dtype=np.uint8)

    def shrink(self) -> None:
        """Give back the buffers of a large picture, some 100 MB and more."""
        self._window.SetSize(8, 8)
        self._window.Render()

    def close(self) -> None:
        self._painter.close()
        self._plotter.close()
        self._window.Finalize()


@cache
def _studio() -> _Studio | None:
    """None where there is no OpenGL."""
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    from app.draw.drawn import has_opengl

    return _Studio() if has_opengl() else None


def shrink() -> None:
    """Take little memory until the next picture; that needs no new window."""
    if _studio.cache_info().currsize and (studio := _studio()) is not None:
        studio.shrink()


def close() -> None:
    """Give the off-screen window back, as is needed before its display ends; the next picture makes another."""
    if _studio.cache_info().currsize and (studio := _studio()) is not None:
        studio.close()
    _studio.cache_clear()


def _unmultiplied(pixels: Pixels) -> Pixels:
    """Painted over transparent black, colours come darkened by their opacity: undone."""
    alpha = pixels[..., 3:].astype(np.float32)
    bright = pixels[..., :3] * np.divide(255.0, alpha, out=np.zeros_like(alpha), where=alpha > 0)
    return np.asarray(np.concatenate([np.minimum(np.round(bright), 255), alpha], axis=2), dtype=np.uint8)


class Brush:
    """Paints flat things with a renderer of matplotlib's; ``onto`` leads from our places, y downwards, to its own."""

    clip: Bbox | None = None
    """What is outside this, in the renderer's places, is not painted."""

    def __init__(self, canvas: Any, onto: Affine2D) -> None:
        self.canvas, self.onto = canvas, onto
        self.scale = float(onto.get_matrix()[0, 0])

    def paint(self, each: Primitive) -> None:
        match each:
            case Text():
                self.text(each)
            case Plate():
                shape = _rounded(each.x, each.y, each.width, each.height, each.radius)
                self.draw(shape, each.fill, each.stroke, each.line, each.opacity)
            case Tiles():
                for plate in each.plates():
                    self.paint(plate)
            case Stroke():
                line = Outline([(each.x0, each.y0), (each.x1, each.y1)])
                self.draw(line, None, each.colour, each.width, each.opacity, dashed=each.dashed)
            case Mark():
                self.mark(each)

    def text(self, text: Text) -> None:
        shift = ANCHOR[text.align] * measure(text.text, text.size, text.bold)[0]
        glyphs = path(text.text, text.size, text.bold)
        placed = glyphs.transformed(Affine2D().scale(1, -1).translate(text.x - shift, text.y))
        if text.halo is not None:
            self.draw(placed, None, text.halo, RIM * text.size, text.opacity)
        self.draw(placed, text.colour, None, 0.0, text.opacity)

    def mark(self, mark: Mark) -> None:
        for part in FLAT[mark.shape]:
            width = 0.0 if isinstance(part, Disc) else part.width
            fill, stroke = (None, mark.colour) if width else (mark.colour, None)
            self.draw(_placed(part, mark), fill, stroke, width * mark.size, mark.opacity)

    def draw(
        self, shape: Outline, fill: Colour | None, stroke: Colour | None, width: float, opacity: float,
        *, dashed: bool = False, is_butt: bool = False,
    ) -> None:  # fmt: skip
        gc = self.canvas.new_gc()
        gc.set_linewidth(width * self.scale if stroke is not None else 0.0)
        gc.set_foreground((*(stroke or (0.0, 0.0, 0.0)), opacity), isRGBA=True)
        gc.set_joinstyle("round")
        gc.set_capstyle("butt" if dashed or is_butt else "round")
        gc.set_antialiased(True)
        gc.set_snap(False)
        gc.set_clip_rectangle(self.clip)
        if dashed:
            gc.set_dashes(0, [4 * width * self.scale, 3 * width * self.scale])
        self.canvas.draw_path(gc, shape, self.onto, (*fill, opacity) if fill is not None else None)
        gc.restore()


def _placed(part: Part, mark: Mark) -> Outline:
    if isinstance(part, Polygon):
        shape = Outline([*part.corners, part.corners[0]], closed=True)
    else:
        shape = Outline.circle(radius=part.radius)
    return shape.transformed(Affine2D().scale(mark.size).translate(mark.x, mark.y))


def _rounded(x: float, y: float, width: float, height: float, radius: float) -> Outline:
    """A rectangle with round corners."""
    r = min(radius, width / 2, height / 2)
    k = r * (1 - _QUARTER)
    corners: Floats = np.array([
        (r, 0), (width - r, 0), (width - k, 0), (width, k), (width, r), (width, height - r), (width, height - k),
        (width - k, height), (width - r, height), (r, height), (k, height), (0, height - k), (0, height - r), (0, r),
        (0, k), (k, 0), (r, 0),
    ])  # fmt: skip
    codes = [1, 2, 4, 4, 4, 2, 4, 4, 4, 2, 4, 4, 4, 2, 4, 4, 4]
    return Outline(corners + np.array([x, y]), codes)


def _bytes(colour: Colour) -> tuple[int, int, int]:
    r, g, b = (round(255 * c) for c in colour)
    return r, g, b

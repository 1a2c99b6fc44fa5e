"""The picture in space where the processor does the work of a graphics card: copied into the window.

With a widget of OpenGL in it Qt puts the whole window together by OpenGL, picture for picture.  A graphics card does
that for nothing; a processor takes longer over it than over most pictures.  Nor does it get several samples of each
pixel at once, which holds the window up: it gets one after another, over turns of the event loop.

A picture is drawn in two steps: this thread says what there is, and others fill in the pixels, while this one does what
else there is to do, until it needs them.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import ceil
from time import process_time
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QWidget
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

from app.draw.samples import PLACES, Mean
from app.gui.turns import Turns

DPI = 72
"""What VTK is told to be the resolution of a screen whose pixels are not scaled."""

OPAQUE = np.frombuffer(bytes((0, 0, 0, 255)), dtype=np.uint32)
"""A pixel of which nothing shines through."""

QUICK = 0.030
"""Seconds of the processor that a picture takes at most whose samples are taken one after another."""


class Canvas(QWidget):
    """Shows what a plotter draws that is on no screen itself, and is drawn again only when it is told to.

    ``nudge`` moves everything in the picture so many pixels right and up; ``meanwhile`` does what can be done while
    pixels are filled in.
    """

    def __init__(
        self, parent: QWidget, plotter: Any, nudge: Callable[[float, float], None], meanwhile: Callable[[], None]
    ) -> None:
        super().__init__(parent)
        self._plotter, self._pixels = plotter, vtkUnsignedCharArray()
        self._nudge, self._meanwhile = nudge, meanwhile
        self._rows = np.zeros((0, 0), dtype=np.uint32)
        self._is_stale, self._took = True, 0.0
        self._begun: _Begun | None = None
        self._smoothing = Turns(self)
        self.samples = 1
        """How many samples each pixel has that is shown."""
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.WheelFocus)
        plotter.grabFramebuffer()  # brings up OpenGL

    @property
    def is_quick(self) -> bool:
        """Whether what is in space is drawn again soon."""
        return self._took <= QUICK

    def refresh(self, tall: float) -> None:
        """What is in space has changed, as far down as nothing covers it."""
        self._smoothing.stop()
        self._is_stale = True
        self.update(0, 0, self.width(), ceil(tall))

    def begin(self) -> None:
        """Draw it already, if it is to be drawn again, and once at most until it is shown."""
        if self._is_stale and self._begun is None and self.isVisible():
            self._begun = self._draw()
            self._is_stale = False

    @property
    def is_awaited(self) -> bool:
        """Whether it is being drawn, and not shown yet."""
        return self._begun is not None

    def smooth(self) -> None:
        """Draw it for each sample of a pixel, in turns of the event loop, and show what they are together."""
        self._smoothing.begin(self._smoothed())

    def stop(self) -> None:
        """Leave it as it is."""
        self._smoothing.stop()

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._plotter.resize(self.size())
        self.refresh(self.height())

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._is_stale or self._begun is not None:
            begun = self._draw() if self._is_stale or self._begun is None else self._begun
            self._is_stale, self._begun = False, None
            self._meanwhile()
            self._rows = self._drawn(begun)
            self.samples = max(self._plotter.render_window.GetMultiSamples(), 1)
        tall, wide = self._rows.shape
        shown = QImage(self._rows.data, wide, tall, QImage.Format.Format_RGBX8888)
        shown.setDevicePixelRatio(self.devicePixelRatioF())
        painter = QPainter(self)
        painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_Source)
        painter.drawImage(0, 0, shown)
        painter.end()

    def _smoothed(self) -> Iterator[None]:
        mean = Mean()
        for place in PLACES:
            self._nudge(*place)
            mean.add(self._drawn(self._draw()).view(np.uint8))
            self._nudge(0.0, 0.0)
            yield
        self._rows = mean.picture().view(np.uint32)
        self._is_stale, self.samples = False, len(PLACES)
        self.update()

    def _draw(self) -> "_Begun":
        """Say what is in space, and have the pixels filled in: instead of those of what has been begun, if it has."""
        self._is_stale, self._begun = self._is_stale or self._begun is not None, None
        begin = process_time()
        window, scale = self._plotter.render_window, self.devicePixelRatioF()
        wide, tall = (max(round(scale * side), 1) for side in (self.width(), self.height()))
        window.SetSize(wide, tall)
        window.SetDPI(round(DPI * scale))
        is_front = window.GetMultiSamples() > 0  # only there VTK makes one of several samples as it should
        window.SetSwapBuffers(is_front)  # which waits for the pixels
        window.Render()
        self._plotter.context().functions().glFlush()
        return _Begun(wide, tall, is_front, process_time() - begin)

    def _drawn(self, begun: "_Begun") -> NDArray[np.uint32]:
        """What is in space, (height, width) pixels from the top down."""
        begin = process_time()
        wide, tall = begun.wide, begun.tall
        self._plotter.render_window.GetRGBACharPixelData(0, 0, wide - 1, tall - 1, begun.is_front, self._pixels, 0)
        rows = vtk_to_numpy(self._pixels).view(np.uint32).reshape(tall, wide)[::-1] | OPAQUE
        self._took = begun.took + process_time() - begin
        return rows


@dataclass(frozen=True)
class _Begun:
    """A picture of ``wide`` by ``tall`` pixels that is being drawn, in VTK's front buffer or its back one.

    ``took``: the processor's seconds until this thread was free again.
    """

    wide: int
    tall: int
    is_front: bool
    took: float

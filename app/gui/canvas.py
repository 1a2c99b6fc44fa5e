"""The picture in space where the processor does the work of a graphics card: copied into the window.

With a widget of OpenGL in it Qt puts the whole window together by OpenGL, picture for picture.  A graphics card does
that for nothing; a processor takes longer over it than over most pictures.
"""

from math import ceil
from typing import Any

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage, QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import QWidget
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

DPI = 72
"""What VTK is told to be the resolution of a screen whose pixels are not scaled."""

OPAQUE = np.frombuffer(bytes((0, 0, 0, 255)), dtype=np.uint32)
"""A pixel of which nothing shines through."""


class Canvas(QWidget):
    """Shows what a plotter draws that is on no screen itself, and is drawn again only when it is told to."""

    def __init__(self, parent: QWidget, plotter: Any) -> None:
        super().__init__(parent)
        self._plotter, self._pixels = plotter, vtkUnsignedCharArray()
        self._rows = np.zeros((0, 0), dtype=np.uint32)
        self._is_stale = True
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.WheelFocus)
        plotter.grabFramebuffer()  # brings up OpenGL

    def refresh(self, tall: float) -> None:
        """What is in space has changed, as far down as nothing covers it."""
        self._is_stale = True
        self.update(0, 0, self.width(), ceil(tall))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._plotter.resize(self.size())
        self.refresh(self.height())

    def paintEvent(self, event: QPaintEvent) -> None:
        if self._is_stale:
            self._is_stale = False
            self._draw()
        tall, wide = self._rows.shape
        shown = QImage(self._rows.data, wide, tall, QImage.Format.Format_RGBX8888)
        shown.setDevicePixelRatio(self.devicePixelRatioF())
        painter = QPainter(self)
        painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_Source)
        painter.drawImage(0, 0, shown)
        painter.end()

    def _draw(self) -> None:
        window, scale = self._plotter.render_window, self.devicePixelRatioF()
        wide, tall = (max(round(scale * side), 1) for side in (self.width(), self.height()))
        window.SetSize(wide, tall)
        window.SetDPI(round(DPI * scale))
        window.Render()
        window.GetRGBACharPixelData(0, 0, wide - 1, tall - 1, 1, self._pixels, 0)
        self._rows = vtk_to_numpy(self._pixels).view(np.uint32).reshape(tall, wide)[::-1] | OPAQUE

"""From numpy to VTK, copied so that nothing dangles."""

from typing import Any

import numpy as np
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray

from app.draw.picture import Colour
from subdivision.arrays import Floats, Indices

_TO_VTK: Any = numpy_support.numpy_to_vtk
_TO_IDS: Any = numpy_support.numpy_to_vtkIdTypeArray


def array(values: Floats) -> Any:
    """Numbers in single precision."""
    return _TO_VTK(np.ascontiguousarray(values, dtype=np.float32), deep=True)


def colours(colour: Floats) -> Any:
    """Colours in bytes."""
    return _TO_VTK(np.ascontiguousarray(np.round(np.clip(colour, 0, 1) * 255), dtype=np.uint8), deep=True)


def points(places: Floats) -> Any:
    """(n, 3) places."""
    held = vtkPoints()
    held.SetData(array(places))
    return held


def cells(rows: Indices) -> Any:
    """Lines or triangles of (n, 2) or (n, 3) point numbers."""
    n, size = rows.shape
    cells = vtkCellArray()
    cells.SetData(
        _TO_IDS(np.arange(0, (n + 1) * size, size, dtype=np.int64), deep=True),
        _TO_IDS(np.ascontiguousarray(rows, dtype=np.int64).ravel(), deep=True),
    )
    return cells


def rgba(colour: Colour, opacity: Floats) -> Floats:
    """(n, 4): one colour with an opacity for each point."""
    return np.column_stack([np.tile(colour, (len(opacity), 1)), opacity])

"""From numpy to VTK, copied so that nothing dangles."""

from typing import Any

import numpy as np
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkIdTypeArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray

from app.draw.picture import Colour
from subdivision.arrays import Floats, Indices


def array(values: Floats) -> Any:
    """Numbers in single precision."""
    return _copied(np.asarray(values, dtype=np.float32), vtkFloatArray())


def colours(colour: Floats) -> Any:
    """Colours in bytes."""
    return _copied(np.round(np.clip(colour, 0, 1) * 255).astype(np.uint8), vtkUnsignedCharArray())


def _copied(rows: Any, found: Any) -> Any:
    """The rows in an array of VTK's; its own ``numpy_to_vtk`` takes three times as long over a few."""
    found.SetNumberOfComponents(rows.shape[1] if rows.ndim == 2 else 1)
    found.SetNumberOfTuples(len(rows))
    if rows.size:
        np.frombuffer(found, dtype=rows.dtype)[:] = rows.ravel()
    return found


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
        _copied(np.arange(0, (n + 1) * size, size, dtype=np.int64), vtkIdTypeArray()),
        _copied(np.asarray(rows, dtype=np.int64).ravel(), vtkIdTypeArray()),
    )
    return cells


def rgba(colour: Colour, opacity: Floats) -> Floats:
    """(n, 4): one colour with an opacity for each point."""
    return np.column_stack([np.tile(colour, (len(opacity), 1)), opacity])

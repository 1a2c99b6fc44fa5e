"""Meshes in files: OBJ, OFF, PLY and STL are read, OBJ, PLY, STL and binary glTF written; the suffix chooses.

Vertices and faces keep their order, polygons stay polygons, and vertices without a face stay.
Every fault is a ``FileError`` that names the line (the byte in binary files) and the mend.
"""

import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TypeAlias, TypeVar

import numpy as np

from subdivision.files import gltf, obj, off, ply, stl
from subdivision.files.content import Content, mesh_of
from subdivision.files.faults import Fault, FileError, fault_of_system, printable
from subdivision.files.saving import save
from subdivision.trace import Mesh
from subdivision.words import phrase

__all__ = ["READABLE", "WRITABLE", "FileError", "read", "write"]

AnyPath: TypeAlias = str | os.PathLike[str]
_Format = TypeVar("_Format")

_READERS: Mapping[str, Callable[[bytes], Content]] = {
    ".obj": obj.read, ".off": off.read, ".ply": ply.read, ".stl": stl.read
}  # fmt: skip
_WRITERS: Mapping[str, Callable[[Mesh], Iterator[bytes]]] = {
    ".obj": obj.written, ".ply": ply.written, ".stl": stl.written, ".glb": gltf.written
}  # fmt: skip

READABLE = tuple(_READERS)
"""Suffixes that ``read`` knows."""
WRITABLE = tuple(_WRITERS)
"""Suffixes that ``write`` knows."""


def read(path: AnyPath) -> Mesh:
    """The polygon mesh in a file; creases and corners too if it is OBJ with OpenSubdiv's tags.

    Raises
    ------
    FileError
        If there is no such file, or no oriented polygon mesh in it.
    """
    path = Path(path)
    try:
        reader = _chosen(_READERS, path, phrase("read"))
        _require_file(path)
        return mesh_of(reader(_bytes_of(path)))
    except Fault as fault:
        raise fault.in_file(path) from None
    except (OSError, MemoryError) as error:
        raise fault_of_system(error, path).in_file(path) from error


def write(path: AnyPath, mesh: Mesh) -> None:
    """Save a mesh or net, whole or not at all: OBJ and PLY at full precision, STL and glTF as triangles in single.

    Only OBJ keeps creases and corners.

    Raises
    ------
    FileError
        If it cannot be written there, or could not be read again; an older file then stays as it was.
    """
    path = Path(path)
    try:
        writer = _chosen(_WRITERS, path, phrase("written"))
        _require_mesh(mesh)
        _require_writable(path)
        save(path, writer(mesh))
    except Fault as fault:
        raise fault.in_file(path) from None
    except (OSError, MemoryError) as error:
        raise fault_of_system(error, path).in_file(path) from error


def _chosen(formats: Mapping[str, _Format], path: Path, done: str) -> _Format:
    suffix = printable(path.suffix.lower())
    if "\0" in str(path):
        raise Fault("a file's name has no NUL character", "choose another name")
    if suffix in formats:
        return formats[suffix]
    _require_no_folder(path)
    known = ", ".join(formats)
    raise Fault(
        phrase("files ending in '{suffix}' are not {done}", suffix=suffix, done=done)
        if suffix
        else "the name has no suffix",
        phrase("use one of {known}", known=known),
    )


def _bytes_of(path: Path) -> bytes:
    data = path.read_bytes()
    if not data or data.isspace():
        raise Fault("the file is empty", "export the mesh again")
    return data


def _require_no_folder(path: Path) -> None:
    if path.is_dir():
        raise Fault("it is a folder", "choose a file in it")


def _require_file(path: Path) -> None:
    _require_no_folder(path)
    if path.exists() and not path.is_file():  # a pipe or a device would never end
        raise Fault("it is a pipe or a device", "choose an ordinary file")


def _require_writable(path: Path) -> None:
    _require_file(path)
    if not path.absolute().parent.is_dir():
        raise Fault(
            phrase("there is no folder {folder}", folder=printable(str(path.absolute().parent))),
            "create it or choose another",
        )
    if path.exists() and not os.access(path, os.W_OK):
        raise Fault("the file there is protected from writing", "change its permissions or choose another name")


def _require_mesh(mesh: Mesh) -> None:
    if mesh.topology.n_faces == 0:
        raise Fault("the control object has no faces", "save a mesh or a net instead")
    if mesh.topology.hidden.all():
        raise Fault("no face is left to save: all touch the boundary, and this rule hides those", "choose another one")
    if not np.isfinite(mesh.points).all():
        v = int(np.flatnonzero(~np.isfinite(mesh.points).all(axis=1))[0])
        raise Fault(phrase("point {v} is not finite", v=v), "move it to a finite position first")

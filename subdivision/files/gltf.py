"""glTF 2.0 in its binary form (``.glb``), written only: triangles with normals, for viewers, the web and slides.

The file is a header, a table in JSON and three arrays, which numpy writes as they are: no package is needed for that.
"""

import json
from collections.abc import Iterator
from typing import Any

import numpy as np

from subdivision.arrays import Floats, Indices
from subdivision.files.triangles import triangles
from subdivision.trace import Mesh

_FLOAT, _WHOLE = 5126, 5125
_VERTICES, _TRIANGLES = 34962, 34963
_JSON, _BINARY = 0x4E4F534A, 0x004E4942

UPRIGHT = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]
"""A quarter turn: up is y in glTF, and z here."""

CLAY = {"baseColorFactor": [0.82, 0.79, 0.74, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.75}


def written(mesh: Mesh) -> Iterator[bytes]:
    """The file in pieces: header, table, arrays."""
    points, cut = triangles(mesh)
    arrays = [points.astype("<f4"), _smooth(points, cut).astype("<f4"), cut.astype("<u4")]
    table = json.dumps(_table(arrays), separators=(",", ":")).encode()
    table += b" " * (-len(table) % 4)
    size = sum(each.nbytes for each in arrays)
    yield b"glTF" + _numbers(2, 12 + 8 + len(table) + 8 + size)
    yield _numbers(len(table), _JSON) + table
    yield _numbers(size, _BINARY)
    yield from (each.tobytes() for each in arrays)


def _table(arrays: list[np.ndarray[Any, Any]]) -> dict[str, Any]:
    points, _, cut = arrays
    views, begin = [], 0
    for each, target in zip(arrays, (_VERTICES, _VERTICES, _TRIANGLES), strict=True):
        views.append({"buffer": 0, "byteOffset": begin, "byteLength": each.nbytes, "target": target})
        begin += each.nbytes
    place = {"bufferView": 0, "componentType": _FLOAT, "count": len(points), "type": "VEC3"}
    return {
        "asset": {"version": "2.0", "generator": "Subdivision Studio"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "rotation": UPRIGHT}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": CLAY, "doubleSided": True}],
        "accessors": [
            {**place, "min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()},
            {**place, "bufferView": 1},
            {"bufferView": 2, "componentType": _WHOLE, "count": cut.size, "type": "SCALAR"},
        ],
        "bufferViews": views,
        "buffers": [{"byteLength": begin}],
    }


def _smooth(points: Floats, cut: Indices) -> Floats:
    """(n, 3): unit normals of the points, of the triangles round them by their areas; a lone point looks up."""
    a, b, c = (points[cut[:, k]] for k in range(3))
    found = np.zeros_like(points)
    np.add.at(found, cut, np.cross(b - a, c - a)[:, None])
    length = np.linalg.norm(found, axis=1, keepdims=True)
    upward = np.broadcast_to(np.array([0.0, 0.0, 1.0]), found.shape).copy()
    return np.asarray(np.divide(found, length, out=upward, where=length > 0))


def _numbers(*values: int) -> bytes:
    return np.array(values, dtype="<u4").tobytes()

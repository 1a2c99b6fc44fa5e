"""STL, text or binary: triangles without connectivity; corners at the same position become one vertex.

It is written in binary: single precision is all the format has.
"""

from array import array
from collections.abc import Iterator

import numpy as np

from subdivision.arrays import Floats, Indices, inverse
from subdivision.files.content import Content
from subdivision.files.faults import Fault, quoted
from subdivision.files.text import BYTE_ORDER_MARK, Row, Vertices, require_finite, rows, text_lines
from subdivision.files.triangles import normals, triangles
from subdivision.trace import Mesh
from subdivision.words import phrase

_HEADER, _TRIANGLE = 84, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_PASSED_OVER = (b"outer", b"endloop")


def read(data: bytes) -> Content:
    """What the file says.

    Raises
    ------
    Fault
    """
    announced = int.from_bytes(data[80:_HEADER], "little")
    size = _HEADER + announced * _TRIANGLE.itemsize
    if len(data) == size:  # asked before the first word, for binary files may begin with 'solid' too
        return _binary(data, announced)
    begins_as_text = data.removeprefix(BYTE_ORDER_MARK).lstrip()[:5].lower() == b"solid"
    if begins_as_text and b"\0" not in data[:_HEADER]:  # a binary header has some: in its padding or its count
        return _text(data)
    if len(data) < _HEADER or b"\0" not in data:
        raise Fault.at_byte(
            0, "it begins neither with 'solid' nor as binary STL does", "choose an STL file or its right suffix"
        )
    raise Fault.at_byte(
        80,
        phrase(
            "{announced} triangles are announced, which takes {size} bytes, but the file has {found}",
            announced=announced,
            size=size,
            found=len(data),
        ),
        "export the mesh again, it was cut short or its count is wrong",
    )


def _binary(data: bytes, n: int) -> Content:
    triangles = np.frombuffer(data, _TRIANGLE, n, _HEADER)
    with np.errstate(invalid="ignore"):  # a NaN may protest when it is widened; it is refused below
        corners = triangles["corners"].reshape(-1, 3).astype(np.float64)
    where = _HEADER + _TRIANGLE.itemsize * np.arange(n)
    require_finite(corners, np.repeat(where, 3), "byte")
    return _merged(corners, np.full(n, 3, dtype=np.intp), where, "byte")


def _text(data: bytes) -> Content:
    lines = text_lines(data)
    facets = _Facets()
    for row in rows(lines):
        facets.take(row)
    if facets.open_facet or facets.open_solid:
        raise Fault.at_line(
            len(lines),
            "the file ends before 'endfacet'" if facets.open_facet else "the file ends before 'endsolid'",
            "export the mesh again, it was cut short",
        )
    return _merged(facets.vertices.points(), np.array(facets.sizes), np.array(facets.lines), "line")


class _Facets:
    """The words of a text file as they come."""

    def __init__(self) -> None:
        self.vertices = Vertices()
        self.sizes, self.lines = array("q"), array("q")
        self.open_solid = self.open_facet = False

    def take(self, row: Row) -> None:
        line, words = row
        match words[0].lower():
            case b"vertex":
                self._vertex(line, words)
            case b"facet":
                self._require(not self.open_facet, row)
                self.open_facet = True
                self.sizes.append(0)
                self.lines.append(line)
            case b"endfacet":
                self._require(self.open_facet, row)
                self.open_facet = False
            case b"solid" | b"endsolid":
                self.open_solid = words[0].lower() == b"solid"
                self._require(not self.open_facet, row)
            case word:
                self._require(word in _PASSED_OVER, row)

    def _vertex(self, line: int, words: list[bytes]) -> None:
        self._require(self.open_facet, (line, words))
        if len(words) < 4:
            raise Fault.at_line(
                line,
                phrase("this vertex has {found} of 3 coordinates", found=len(words) - 1),
                "write it as 'vertex x y z'",
            )
        self.vertices.add(line, words[1:4])
        self.sizes[-1] += 1

    def _require(self, expected: bool, row: Row) -> None:
        if not expected:
            raise Fault.at_line(
                row[0],
                phrase("{word} does not belong here", word=quoted(row[1][0])),
                "write each triangle as facet, outer loop, three vertices, endloop, endfacet",
            )


def _merged(corners: Floats, sizes: Indices, where: Indices, unit: str) -> Content:
    """Corners at the same position as one vertex, in order of first appearance."""
    corners = corners + 0.0  # -0.0 is the same place as 0.0
    order = np.lexsort(corners.T)
    opens = np.r_[True, (np.diff(corners[order], axis=0) != 0).any(axis=1)][: len(order)]
    first = order[opens]  # the sort is stable: the first of equals opens their group
    rank = inverse(np.argsort(first))
    vertex = np.empty(len(corners), dtype=np.intp)
    vertex[order] = rank[np.cumsum(opens) - 1]
    points = corners[np.sort(first)]
    return Content(points, sizes, vertex, where, unit, lambda v: "the corner ({:g}, {:g}, {:g})".format(*points[v]))


def written(mesh: Mesh) -> Iterator[bytes]:
    """The file in pieces: header, triangles."""
    points, cut = triangles(mesh)
    rows = np.zeros(len(cut), dtype=_TRIANGLE)
    rows["normal"], rows["corners"] = normals(points, cut), points[cut]
    yield b"Subdivision Studio".ljust(80, b"\0") + np.array([len(cut)], dtype="<u4").tobytes()
    yield rows.tobytes()

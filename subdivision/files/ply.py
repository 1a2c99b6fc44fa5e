"""PLY, text or binary: elements in any order, of which ``vertex`` and ``face`` are read.

It is written in binary with points as doubles: exact, and quick to read back.
"""

from collections.abc import Iterator

import numpy as np

from subdivision.arrays import Indices
from subdivision.files.content import Content, require_known
from subdivision.files.faults import Fault
from subdivision.files.ply_body import Wanted, binary_content, text_content
from subdivision.files.ply_header import Element, Header, Property, header_of
from subdivision.rows import shown_faces
from subdivision.trace import Mesh
from subdivision.words import phrase


def read(data: bytes) -> Content:
    """What the file says.

    Raises
    ------
    Fault
    """
    header = header_of(data)
    wanted = {"vertex": _xyz(header.element("vertex"), header), "face": (_loop(header.element("face"), header),)}
    return require_known(_content(data, header, wanted))


def _content(data: bytes, header: Header, wanted: Wanted) -> Content:
    return binary_content(data, header, wanted) if header.order else text_content(data, header, wanted)


def _xyz(vertex: Element | None, header: Header) -> tuple[Property, ...]:
    if vertex is None:
        raise Fault.at_line(header.n_lines, "the header declares no element 'vertex'", "export a polygon mesh")
    found = [vertex.property(name) for name in "xyz"]
    for name, p in zip("xyz", found, strict=True):
        if p is None or p.count:
            raise Fault.at_line(
                vertex.line, phrase("vertices have no property '{name}'", name=name), "export them with x, y and z"
            )
    return tuple(p for p in found if p)


def _loop(face: Element | None, header: Header) -> Property:
    if face is None:
        raise Fault.at_line(
            header.n_lines, "the header declares no element 'face'", "export a polygon mesh with its faces"
        )
    loop = face.property("vertex_indices", "vertex_index")
    if loop is None or not loop.count or loop.kind[0] == "f":
        raise Fault.at_line(
            face.line, "faces have no list of whole numbers 'vertex_indices'", "export them with that property"
        )
    return loop


def written(mesh: Mesh) -> Iterator[bytes]:
    """The file in pieces: header, vertices, faces."""
    sizes, corners = shown_faces(mesh.topology)
    count, width = ("uchar", 1) if sizes.max() < 256 else ("uint", 4)
    lines = (
        "ply", "format binary_little_endian 1.0",
        f"element vertex {len(mesh.points)}", "property double x", "property double y", "property double z",
        f"element face {len(sizes)}", f"property list {count} int vertex_indices", "end_header", "",
    )  # fmt: skip
    yield "\n".join(lines).encode()
    yield mesh.points.astype("<f8").tobytes()
    yield _rows(sizes, corners, width)


def _rows(sizes: Indices, corners: Indices, width: int) -> bytes:
    """Every face's size, in ``width`` bytes, and its corners, in four bytes each."""
    begin = np.cumsum(width + 4 * sizes) - (width + 4 * sizes)
    counts = np.zeros(width * len(sizes) + 4 * len(corners), dtype=bool)
    counts[begin[:, None] + np.arange(width)] = True
    data = np.empty(len(counts), dtype=np.uint8)
    data[counts] = sizes.astype(f"<u{width}").view(np.uint8)
    data[~counts] = corners.astype("<i4").view(np.uint8)
    return data.tobytes()

"""Wavefront OBJ with the tags of OpenSubdiv: ``t crease 2/1/0 a b s`` and ``t corner 1/1/0 v s``.

Faces count vertices from 1, or backwards from -1; tags count them from 0.  Whatever is neither
vertex, face nor one of these tags is passed over: texture coordinates, normals, lines, groups,
materials, free-form curves, and the tags for boundaries and holes, which are the user's choice.
"""

from array import array
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import repeat

import numpy as np

from subdivision.arrays import Indices
from subdivision.files.content import Content
from subdivision.files.faults import Fault, quoted
from subdivision.files.text import Faces, Vertices, number, rows, text_lines, whole
from subdivision.rows import shown_faces
from subdivision.topology import Topology
from subdivision.trace import Mesh
from subdivision.words import phrase

_MODEL = {
    b"crease": "'t crease 2/1/0 a b s' with vertices a and b, counted from 0, and sharpness s",
    b"corner": "'t corner 1/1/0 v s' with vertex v, counted from 0, and sharpness s",
}


@dataclass(eq=False)
class _Found:
    """What a file says as it comes; ``before`` counts the vertices in front of every face."""

    vertices: Vertices = field(default_factory=Vertices)
    faces: Faces = field(default_factory=Faces)
    before: "array[int]" = field(default_factory=lambda: array("q"))
    creases: dict[tuple[int, int], float] = field(default_factory=dict)
    crease_lines: dict[tuple[int, int], int] = field(default_factory=dict)
    sharp: dict[int, float] = field(default_factory=dict)
    sharp_lines: dict[int, int] = field(default_factory=dict)

    def vertex(self, line: int, words: list[bytes]) -> None:
        if len(words) < 4:
            raise Fault.at_line(
                line, phrase("this vertex has {found} of 3 coordinates", found=len(words) - 1), "write it as 'v x y z'"
            )
        self.vertices.add(line, words[1:4])

    def face(self, line: int, words: list[bytes]) -> None:
        self.before.append(len(self.vertices))
        self.faces.add(line, [word.partition(b"/")[0] for word in words[1:]])

    def tag(self, line: int, words: list[bytes]) -> None:
        name = words[1] if len(words) > 1 else b""
        if name not in _MODEL:
            return
        numbers, sharpness = _arguments(line, words)
        per = 2 if name == b"crease" else 1
        if not numbers or len(numbers) % per or len(sharpness) not in (1, len(numbers) // per):
            raise Fault.at_line(
                line,
                phrase("this {tag} has too many or too few arguments", tag=name.decode()),
                phrase("write {model}", model=_MODEL[name]),
            )
        for k in range(len(numbers) // per):
            value = sharpness[k] if len(sharpness) > 1 else sharpness[0]
            self._sharpen(line, tuple(sorted(numbers[per * k : per * k + per])), value)

    def _sharpen(self, line: int, vertices: tuple[int, ...], value: float) -> None:
        match vertices:
            case a, b:
                self.creases[a, b], self.crease_lines[a, b] = value, line
            case (v,):
                self.sharp[v], self.sharp_lines[v] = value, line


def read(data: bytes) -> Content:
    """What the file says.

    Raises
    ------
    Fault
    """
    found = _Found()
    lines = text_lines(data)
    for line, words in rows(_continued(lines) if b"\\" in data else lines):
        match words[0]:
            case b"v":
                found.vertex(line, words)
            case b"f":
                found.face(line, words)
            case b"t":
                found.tag(line, words)
    points = found.vertices.points()
    for a, b in found.creases:
        if b >= len(points):
            raise Fault.at_line(
                found.crease_lines[a, b],
                phrase("there is no vertex {b} to crease", b=b),
                phrase("write {model}", model=_MODEL[b"crease"]),
            )
    for v in found.sharp:
        if v >= len(points):
            raise Fault.at_line(
                found.sharp_lines[v],
                phrase("there is no vertex {v} to sharpen", v=v),
                phrase("write {model}", model=_MODEL[b"corner"]),
            )
    return Content(
        points, np.array(found.faces.sizes), _from_zero(found), np.array(found.faces.lines),
        vertex=lambda v: phrase("vertex {number}", number=v + 1), creases=found.creases, sharp_corners=found.sharp,
        tag_lines=found.crease_lines,
    )  # fmt: skip


def _continued(lines: Iterable[bytes]) -> Iterator[bytes]:
    """Lines that end with a backslash joined with the next one; an empty line keeps the place of each joined one."""
    held, n = bytearray(), 0
    for line in lines:
        if line.endswith(b"\\") and not line.lstrip().startswith(b"#"):
            held += line[:-1] + b" "
            n += 1
        elif n:
            yield bytes(held + line)
            yield from repeat(b"", n)
            held, n = bytearray(), 0
        else:
            yield line
    yield bytes(held)


def _from_zero(found: _Found) -> Indices:
    """(n_corners,) int: the vertices of all faces, relative and absolute ones, counted from 0."""
    written = found.faces.corners()
    before = np.repeat(np.array(found.before), found.faces.sizes)
    corners = np.where(written < 0, written + before, written - 1)
    n = len(found.vertices)
    if (bad := np.flatnonzero((corners < 0) | (corners >= n))).size:
        face = found.faces.face(bad[0])
        raise _unknown_vertex(int(written[bad[0]]), n, found.before[face], found.faces.lines[face])
    return corners


def _unknown_vertex(written: int, n: int, before: int, line: int) -> Fault:
    if written < 0:
        return Fault.at_line(
            line,
            phrase(
                "this face names vertex {written}, but only {before} come before it", written=written, before=before
            ),
            "correct the number or move the face down",
        )
    known = phrase("the vertices are numbered from 1 to {n}", n=n) if n else "there are no vertices"
    return Fault.at_line(
        line,
        phrase("this face names vertex {written}, but {known}", written=written, known=known),
        "correct the number or add the vertex",
    )


def _arguments(line: int, words: list[bytes]) -> tuple[list[int], list[float]]:
    """The whole numbers and the sharpnesses of a tag, as many as it announces."""
    counts = words[2].split(b"/") if len(words) > 2 else []
    if len(counts) != 3:
        raise Fault.at_line(
            line, "this tag does not say how many arguments it has", phrase("write {model}", model=_MODEL[words[1]])
        )
    n, m, _ = (whole(word, "a number of arguments", line) for word in counts)
    if len(words) < 3 + n + m:
        raise Fault.at_line(
            line,
            phrase("this tag announces {announced} arguments and has {found}", announced=n + m, found=len(words) - 3),
            phrase("write {model}", model=_MODEL[words[1]]),
        )
    numbers = [whole(word, "a tagged vertex", line) for word in words[3 : 3 + n]]
    sharpness = [number(word, "a sharpness", line) for word in words[3 + n : 3 + n + m]]
    for word, value in zip(words[3 + n :], sharpness, strict=False):
        if not value >= 0:
            raise Fault.at_line(
                line, phrase("a sharpness is {word}", word=quoted(word)), "write a number from 0 (smooth) to 10 (sharp)"
            )
    return numbers, sharpness


def written(mesh: Mesh) -> Iterator[bytes]:
    """The file in pieces: vertices as shortest decimals that read back the same, faces, tags."""
    for point in mesh.points.tolist():
        yield b"v %a %a %a\n" % tuple(point)
    t = mesh.topology
    sizes, flat = shown_faces(t)
    corners, end = [b" %d" % (v + 1) for v in flat.tolist()], 0
    for size in sizes.tolist():
        yield b"f" + b"".join(corners[end : end + size]) + b"\n"
        end += size
    if isinstance(t, Topology):
        yield from _tags(t)


def _tags(t: Topology) -> Iterator[bytes]:
    """Creases inside and corners; the sharpness of boundary edges is the boundary rule's."""
    creased = ~t.boundary & (t.edge_sharpness > 0)
    for (a, b), value in zip(np.sort(t.ends[creased]).tolist(), t.edge_sharpness[creased].tolist(), strict=True):
        yield b"t crease 2/1/0 %d %d %a\n" % (a, b, value)
    sharp = np.flatnonzero(t.vertex_sharpness > 0)
    for v, value in zip(sharp.tolist(), t.vertex_sharpness[sharp].tolist(), strict=True):
        yield b"t corner 1/1/0 %d %a\n" % (v, value)

"""OFF: counts, then vertices, then faces, one to a line; colours, normals and texture coordinates are passed over."""

import re
from collections.abc import Iterator
from itertools import islice

import numpy as np

from subdivision.files.content import Content, require_known
from subdivision.files.faults import Fault, quoted
from subdivision.files.text import Faces, Row, Vertices, rows, text_lines, whole
from subdivision.words import phrase

_KEYWORD = re.compile(rb"(ST)?C?N?(4?n?)OFF")


def read(data: bytes) -> Content:
    """What the file says.

    Raises
    ------
    Fault
    """
    lines = text_lines(data)
    body = rows(lines)
    n_vertices, n_faces, line = _counts(body)
    vertices = _vertices(islice(body, min(n_vertices, len(lines))))
    faces = _faces(islice(body, min(n_faces, len(lines))))
    if len(vertices) + len(faces) < n_vertices + n_faces:
        raise Fault.at_line(
            len(lines),
            phrase(
                "the file ends after {vertices} of {n_vertices} vertices and {faces} of {n_faces} faces",
                vertices=len(vertices),
                n_vertices=n_vertices,
                faces=len(faces),
                n_faces=n_faces,
            ),
            phrase("correct the counts in line {line}, or export the mesh again if it was cut short", line=line),
        )
    if extra := next(body, None):
        raise Fault.at_line(
            extra[0],
            phrase(
                "there is more than the {n_vertices} vertices and {n_faces} faces that line {line} counts",
                n_vertices=n_vertices,
                n_faces=n_faces,
                line=line,
            ),
            "correct the counts or remove the rest",
        )
    return require_known(Content(vertices.points(), np.array(faces.sizes), faces.corners(), np.array(faces.lines)))


def _counts(body: Iterator[Row]) -> tuple[int, int, int]:
    """How many vertices and faces, and the line that says so, which may be that of the keyword."""
    line, words = next(body, (1, [b""]))
    keyword = _KEYWORD.match(words[0])
    if not keyword:
        raise Fault.at_line(
            line,
            phrase("it begins with {word}, not 'OFF'", word=quoted(words[0])),
            "choose an OFF file or its right suffix",
        )
    if keyword[2]:
        raise Fault.at_line(
            line, phrase("{word} has points that are not in space", word=quoted(words[0])), "export it as plain OFF"
        )
    rest = [word for word in (words[0][keyword.end() :], *words[1:]) if word]
    if rest[:1] == [b"BINARY"]:
        raise Fault.at_line(line, "it is binary OFF", "export it as text, or as PLY")
    line, words = (line, rest) if rest else next(body, (line, []))
    if len(words) < 2:
        raise Fault.at_line(line, "the counts of vertices and faces are missing", "write both in the line below 'OFF'")
    return whole(words[0], "the number of vertices", line), whole(words[1], "the number of faces", line), line


def _vertices(body: Iterator[Row]) -> Vertices:
    found = Vertices()
    for line, words in body:
        if len(words) < 3:
            raise Fault.at_line(
                line,
                phrase("this vertex has {found} of 3 coordinates", found=len(words)),
                "write all three, or correct the counts",
            )
        found.add(line, words[:3])
    return found


def _faces(body: Iterator[Row]) -> Faces:
    found = Faces()
    for line, words in body:
        size = whole(words[0], "the number of this face's corners", line)
        if len(words) <= size:
            raise Fault.at_line(
                line,
                phrase("this face announces {size} corners and names {found}", size=size, found=len(words) - 1),
                "name them all in this line, or correct the number",
            )
        found.add(line, words[1 : size + 1])
    return found

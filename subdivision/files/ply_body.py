"""The rows of a PLY file: those of one element after another, as text or as bytes."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import cycle, islice
from struct import Struct
from struct import error as StructError
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from subdivision.arrays import Indices
from subdivision.files.content import Content
from subdivision.files.faults import Fault
from subdivision.files.ply_header import Element, Header, Property
from subdivision.files.text import Row, coordinates, require_finite, rows, text_lines, vertex_numbers, whole

_CUT = "export the mesh again if it was cut short, or correct the number of rows in the header"
_CODES = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "i8": "q", "u8": "Q"}

Wanted: TypeAlias = dict[str, tuple[Property, ...]]
"""The properties to read of the elements ``vertex`` (three) and ``face`` (a list)."""


@dataclass(eq=False)
class _Words:
    """What the chosen properties of all rows of an element say, how many words a row has, and on which line."""

    words: list[bytes] = field(default_factory=list)
    sizes: list[int] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)


def text_content(data: bytes, header: Header, wanted: Wanted) -> Content:
    """The rows of a text file, one to a line."""
    lines = text_lines(data, header.size)
    remaining = rows(lines, header.n_lines + 1)
    last = header.n_lines + len(lines)
    found: dict[str, _Words] = {}
    for element in header.elements:
        found[element.name] = _words(element, wanted.get(element.name, ()), remaining)
        if len(found[element.name].lines) < element.n and element.properties:
            n = len(found[element.name].lines)
            raise Fault.at_line(last, f"the file ends after {n} of {element.n} rows of element {element.name}", _CUT)
    if extra := next(remaining, None):
        raise Fault.at_line(
            extra[0], "there are more rows than the header declares", "correct its numbers or remove them"
        )
    vertex, face = found["vertex"], found["face"]
    points = coordinates(vertex.words, np.array(vertex.lines, dtype=np.intp))
    corners = vertex_numbers(face.words, face.sizes, face.lines)
    return Content(points, np.array(face.sizes, dtype=np.intp), corners, np.array(face.lines, dtype=np.intp))


def _words(element: Element, chosen: tuple[Property, ...], remaining: Iterator[Row]) -> _Words:
    found = _Words()
    columns = [element.properties.index(p) for p in chosen]
    rows_that_can_be = min(element.n, 2**62) if element.properties else 0
    for line, row in islice(remaining, rows_that_can_be):
        found.lines.append(line)
        try:
            words = _walked(element, chosen, row, line) if element.has_lists else [row[c] for c in columns]
        except IndexError:
            raise Fault.at_line(
                line,
                f"this row of element {element.name} has only {len(row)} words",
                "complete it or export the mesh again",
            ) from None
        found.words += words
        found.sizes.append(len(words))
    return found


def _walked(element: Element, chosen: tuple[Property, ...], row: list[bytes], line: int) -> list[bytes]:
    """The words of the chosen properties in a row with lists."""
    spans: dict[Property, slice] = {}
    at = 0
    for p in element.properties if chosen else ():
        start, at = (at + 1, at + 1 + whole(row[at], "the length of a list", line)) if p.count else (at, at + 1)
        spans[p] = slice(start, at)
    if at > len(row):
        raise IndexError
    return [word for p in chosen for word in row[spans[p]]]


def binary_content(data: bytes, header: Header, wanted: Wanted) -> Content:
    """The rows of a binary file, without gaps."""
    at = header.size
    begins: dict[str, Indices] = {}
    for element in header.elements:
        begins[element.name], at = _begins(element, wanted.get(element.name, ()), data, at, header.order)
    if data[at:].strip():
        raise Fault.at_byte(at, "more follows than the header declares", "correct its numbers or export the mesh again")
    order = header.order
    columns = [_gathered(data, b, order + p.kind) for b, p in zip(begins["vertex"].T, wanted["vertex"], strict=True)]
    with np.errstate(invalid="ignore"):  # a NaN may protest when it is widened; it is refused below
        points = np.stack([column.astype(np.float64) for column in columns], axis=1)
    require_finite(points, begins["vertex"].min(axis=1, initial=len(data)), "byte")
    loop, begin = wanted["face"][0], begins["face"][:, 0]
    sizes = _gathered(data, begin, order + loop.count).astype(np.intp)
    first = begin + np.dtype(loop.count).itemsize
    within = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    corners = _gathered(data, np.repeat(first, sizes) + np.dtype(loop.kind).itemsize * within, order + loop.kind)
    return Content(points, sizes, corners.astype(np.intp), begin, "byte")


def _begins(element: Element, chosen: tuple[Property, ...], data: bytes, at: int, order: str) -> tuple[Indices, int]:
    """(n, n_chosen) int: the byte where each chosen property begins in every row; and the byte behind all rows."""
    widths = [np.dtype(p.count or p.kind).itemsize for p in element.properties]
    if element.n * sum(widths) > len(data) - at:  # before anything of that size is made
        raise _cut(element, data)
    columns = [element.properties.index(p) for p in chosen]
    if element.has_lists:
        begins, end = _walked_bytes(element, data, at, order)
        return begins[:, columns], end
    n = element.n if chosen else 0
    offsets = (np.cumsum(widths, dtype=np.intp) - widths)[columns]
    return at + sum(widths) * np.arange(n)[:, None] + offsets, at + element.n * sum(widths)


def _walked_bytes(element: Element, data: bytes, at: int, order: str) -> tuple[Indices, int]:
    """Likewise for all properties, where lists make every row as long as it says."""
    lengths = [Struct(order + _CODES[p.count]) if p.count else None for p in element.properties]
    sizes = [np.dtype(p.kind).itemsize for p in element.properties]
    begins: list[int] = []
    try:
        for length, size in islice(cycle(zip(lengths, sizes, strict=True)), element.n * len(sizes)):
            begins.append(at)
            if length:
                n = length.unpack_from(data, at)[0]
                if n < 0:
                    raise Fault.at_byte(at, f"a list of {n} values begins here", "export the mesh again")
                at += length.size + n * size
            else:
                at += size
            if at > len(data):
                raise _cut(element, data)
    except StructError:
        raise _cut(element, data) from None
    return np.array(begins, dtype=np.intp).reshape(-1, len(sizes)), at


def _gathered(data: bytes, begins: Indices, kind: str) -> NDArray[Any]:
    """(n,): the values that begin at these bytes, wherever that is."""
    flat, width = np.frombuffer(data, np.uint8), np.dtype(kind).itemsize
    values = np.empty((len(begins), width), dtype=np.uint8)
    for k in range(width):
        values[:, k] = flat[begins + k]
    return values.view(kind).reshape(-1)


def _cut(element: Element, data: bytes) -> Fault:
    what = f"the file ends before all rows of element {element.name} (line {element.line} declares {element.n})"
    return Fault.at_byte(len(data), what, _CUT)

"""The rows of a PLY file: those of one element after another, as text or as bytes."""

from collections.abc import Callable, Iterator
from itertools import islice
from struct import Struct
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from subdivision.arrays import Indices
from subdivision.files.content import Content, too_few_corners
from subdivision.files.faults import Fault
from subdivision.files.ply_header import Element, Header, Property
from subdivision.files.text import Faces, Row, Vertices, require_finite, rows, text_lines, whole
from subdivision.words import phrase

_CUT = "export the mesh again if it was cut short, or correct the number of rows in the header"
_CODES = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "i8": "q", "u8": "Q"}

_ALIKE, _FEW, _WALKED = 2**14, 64, 2**10
"""Rows compared at once; fewer of them alike are not worth it; then so many are walked one by one."""

_Keep: TypeAlias = Callable[[int, list[bytes]], None]
Wanted: TypeAlias = dict[str, tuple[Property, ...]]
"""The properties to read of the elements ``vertex`` (three) and ``face`` (a list)."""


def text_content(data: bytes, header: Header, wanted: Wanted) -> Content:
    """The rows of a text file, one to a line."""
    lines = text_lines(data, header.size)
    remaining = rows(lines, header.n_lines + 1)
    last = header.n_lines + len(lines)
    vertices, faces = Vertices(), Faces()
    keeps: dict[str, _Keep] = {"vertex": vertices.add, "face": faces.add}
    for element in header.elements:
        n = _kept(element, wanted.get(element.name, ()), remaining, keeps.get(element.name, _pass_over))
        if n < element.n and element.properties:
            raise Fault.at_line(
                last,
                phrase(
                    "the file ends after {n} of {rows} rows of element {element}",
                    n=n,
                    rows=element.n,
                    element=element.called,
                ),
                _CUT,
            )
    if extra := next(remaining, None):
        raise Fault.at_line(
            extra[0], "there are more rows than the header declares", "correct its numbers or remove them"
        )
    return Content(vertices.points(), np.array(faces.sizes), faces.corners(), np.array(faces.lines))


def _pass_over(line: int, words: list[bytes]) -> None:
    """Nobody asks for this row."""


def _kept(element: Element, chosen: tuple[Property, ...], remaining: Iterator[Row], keep: _Keep) -> int:
    """How many rows there are; the words of their chosen properties are kept."""
    columns = [element.properties.index(p) for p in chosen]
    walks = bool(chosen) and element.has_lists
    n = 0
    for line, row in islice(remaining, min(element.n, 2**62) if element.properties else 0):
        n += 1
        try:
            keep(line, _walked(element, chosen, row, line) if walks else [row[c] for c in columns])
        except IndexError:
            raise Fault.at_line(
                line,
                phrase("this row of element {element} has only {found} words", element=element.called, found=len(row)),
                "complete it or export the mesh again",
            ) from None
    return n


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
        return _Walk(element, columns, data, order).from_byte(at)
    n = element.n if chosen else 0
    offsets = (np.cumsum(widths, dtype=np.intp) - widths)[columns]
    return at + sum(widths) * np.arange(n)[:, None] + offsets, at + element.n * sum(widths)


class _Walk:
    """Where properties begin in rows with lists, which are as long as they say."""

    def __init__(self, element: Element, columns: list[int], data: bytes, order: str) -> None:
        self._element, self._columns, self._data = element, columns, data
        self._counts = [Struct(order + _CODES[p.count]) if p.count else None for p in element.properties]
        self._sizes = [np.dtype(p.kind).itemsize for p in element.properties]
        self._loop = columns[0] if element.name == "face" and columns else -1

    def from_byte(self, at: int) -> tuple[Indices, int]:
        """(n, n_columns) int, and the byte behind all rows: stretches of rows alike at once, others one by one."""
        found: list[Indices] = []
        done, n = 0, self._element.n
        while done < n:
            begins, end = self._alike(at, min(n - done, _ALIKE))
            if len(begins) < _FEW:
                begins, end = self._row_by_row(at, min(n - done, _WALKED))
            found.append(begins[:, self._columns])
            at, done = end, done + len(begins)
        return np.concatenate([np.empty((0, len(self._columns)), dtype=np.intp), *found]), at

    def _row(self, at: int) -> tuple[list[int], int]:
        """Where its properties begin, and the byte behind it."""
        begins = []
        for column, (count, size) in enumerate(zip(self._counts, self._sizes, strict=True)):
            begins.append(at)
            at += self._list(count, size, at, column) if count else size
        if at > len(self._data):
            raise _cut(self._element, self._data)
        return begins, at

    def _list(self, count: Struct, size: int, at: int, column: int) -> int:
        """How many bytes a list takes."""
        if at + count.size > len(self._data):
            raise _cut(self._element, self._data)
        n = count.unpack_from(self._data, at)[0]
        if n < 0:
            raise Fault.at_byte(at, phrase("a list of {n} values begins here", n=n), "export the mesh again")
        if column == self._loop and n < 3:  # at once, for millions of them fit into a small file
            raise too_few_corners(n, phrase("byte {at}", at=at))
        return int(count.size + n * size)

    def _row_by_row(self, at: int, n: int) -> tuple[Indices, int]:
        begins = []
        for _ in range(n):
            row, at = self._row(at)
            begins.append(row)
        return np.array(begins, dtype=np.intp), at

    def _alike(self, at: int, n: int) -> tuple[Indices, int]:
        """The rows from here on, ``n`` at most, whose lists are as long as those of the first."""
        begins, end = self._row(at)
        width = end - at
        n = min(n, (len(self._data) - at) // width)
        table = np.frombuffer(self._data, np.uint8, n * width, at).reshape(n, width)
        counts = [b - at + k for b, count in zip(begins, self._counts, strict=True) if count for k in range(count.size)]
        differs = (table[:, counts] != table[0, counts]).any(axis=1)
        n = int(differs.argmax()) if differs.any() else n
        return np.array(begins) + width * np.arange(n)[:, None], at + n * width


def _gathered(data: bytes, begins: Indices, kind: str) -> NDArray[Any]:
    """(n,): the values that begin at these bytes, wherever that is."""
    flat, width = np.frombuffer(data, np.uint8), np.dtype(kind).itemsize
    values = np.empty((len(begins), width), dtype=np.uint8)
    for k in range(width):
        values[:, k] = flat[begins + k]
    return values.view(kind).reshape(-1)


def _cut(element: Element, data: bytes) -> Fault:
    what = phrase(
        "the file ends before all rows of element {element} (line {line} declares {rows})",
        element=element.called,
        line=element.line,
        rows=element.n,
    )
    return Fault.at_byte(len(data), what, _CUT)

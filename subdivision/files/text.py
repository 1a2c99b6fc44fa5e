"""Lines, words and numbers of a text file.

Everything stays bytes: only names and comments have an encoding, and neither is read.
"""

import re
from array import array
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from subdivision.arrays import Floats, Indices
from subdivision.files.faults import Fault, quoted
from subdivision.words import phrase

Row: TypeAlias = tuple[int, list[bytes]]
"""A line's number, counted from 1, and its words."""

BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_LARGEST = 2**62
_LINE_END = re.compile(rb"\r\n|[\r\n]")
_PIECE = 2**19
"""Bytes that are split into lines at once."""
_AT_ONCE = 2**16
"""Words that become numbers at once."""
_Fault: TypeAlias = Callable[[int, bytes], Fault]
_Number = TypeVar("_Number", int, float)


class Lines:
    """The lines of a text, whichever way they end, split a piece at a time: all at once take ten times its memory."""

    def __init__(self, data: bytes, start: int = 0) -> None:
        self._data, self._start = data, start

    def __iter__(self) -> Iterator[bytes]:
        return chain.from_iterable(map(bytes.splitlines, self.pieces()))

    def __len__(self) -> int:
        data, start = self._data, self._start
        ends = data.count(b"\n", start) + data.count(b"\r", start) - data.count(b"\r\n", start)
        return ends + (len(data) > start and data[-1] not in b"\r\n")

    def pieces(self) -> Iterator[bytes]:
        """Whole lines, about as many bytes of them at a time as are split at once."""
        at = self._start
        while at < len(self._data):
            found = _LINE_END.search(self._data, at + _PIECE)
            end = found.end() if found else len(self._data)
            yield self._data[at:end]
            at = end


def text_lines(data: bytes, start: int = 0) -> Lines:
    """The lines of a text file from byte ``start`` on.

    Raises
    ------
    Fault
        If it is no text, or text in two-byte characters.
    """
    if start == 0 and data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise Fault("it is text in UTF-16", "save it as plain text or UTF-8", "byte 0")
    if (at := data.find(b"\0", start)) >= 0:
        raise Fault.at_byte(at, "a NUL byte stands where text should be", "export the mesh again, as text")
    return Lines(data, start + len(BYTE_ORDER_MARK) * data.startswith(BYTE_ORDER_MARK, start))


def rows(lines: Lines | Iterable[bytes], first: int = 1) -> Iterator[Row]:
    """The words of every line that has any, comments left out; ``first`` is the number of the first line."""
    if not isinstance(lines, Lines):
        yield from _rows(lines, first)
        return
    for piece in lines.pieces():
        if not piece.isspace():
            yield from _rows(piece.splitlines(), first)
        first += len(Lines(piece))


def _rows(lines: Iterable[bytes], first: int) -> Iterator[Row]:
    for number, line in enumerate(lines, first):
        if b"#" in line:
            line = line.partition(b"#")[0]
        if words := line.split():
            yield number, words


class Vertices:
    """Positions as their words come; they become numbers many at a time, for words take much memory."""

    def __init__(self) -> None:
        self.lines = array("q")
        self._numbers = _Numbers(float, np.dtype(np.float64))

    def __len__(self) -> int:
        return len(self.lines)

    def add(self, line: int, words: list[bytes]) -> None:
        """One more position: its three words."""
        self.lines.append(line)
        self._numbers.add(words, self._fault)

    def points(self) -> Floats:
        """(n, 3) float."""
        points = self._numbers.made(self._fault).reshape(-1, 3)
        require_finite(points, self.lines, "line")
        return points

    def _fault(self, position: int, word: bytes) -> Fault:
        line = self.lines[position // 3]
        return Fault.at_line(
            line, phrase("{word} is not a number", word=quoted(word)), "write every coordinate as a decimal number"
        )


class Faces:
    """Vertex numbers of faces as their words come, likewise."""

    def __init__(self) -> None:
        self.lines, self.sizes = array("q"), array("q")
        self._numbers = _Numbers(int, np.dtype(np.intp))

    def __len__(self) -> int:
        return len(self.lines)

    def add(self, line: int, words: list[bytes]) -> None:
        """One more face: a word for each corner."""
        self.lines.append(line)
        self.sizes.append(len(words))
        self._numbers.add(words, self._fault)

    def corners(self) -> Indices:
        """(n_corners,) int: as they are written."""
        return self._numbers.made(self._fault)

    def face(self, corner: int) -> int:
        """The face a corner belongs to."""
        return int(np.searchsorted(np.cumsum(self.sizes), corner, side="right"))

    def _fault(self, position: int, word: bytes) -> Fault:
        line = self.lines[self.face(position)]
        return Fault.at_line(line, phrase("{word} is not a vertex number", word=quoted(word)), "write a whole number")


class _Numbers:
    """What many words spell; a fault is told by the place of the word among all, and the word."""

    def __init__(self, kind: Callable[[bytes], float], dtype: np.dtype[Any]) -> None:
        self._kind, self._dtype = kind, dtype
        self._words: list[bytes] = []
        self._made: list[NDArray[Any]] = []
        self._n = 0

    def add(self, words: list[bytes], fault: _Fault) -> None:
        self._words += words
        if len(self._words) >= _AT_ONCE:
            self._settle(fault)

    def made(self, fault: _Fault) -> NDArray[Any]:
        self._settle(fault)
        return np.concatenate([np.empty(0, self._dtype), *self._made])

    def _settle(self, fault: _Fault) -> None:
        all_words, self._words = self._words, []
        for begin in range(0, len(all_words), _AT_ONCE):
            words = all_words[begin : begin + _AT_ONCE]
            values = self._values(words)
            if values is None:
                bad = next(k for k, word in enumerate(words) if self._values([word]) is None)
                raise fault(self._n + bad, words[bad])
            self._made.append(values)
            self._n += len(words)

    def _values(self, words: list[bytes]) -> NDArray[Any] | None:
        try:
            if b"_" in b"".join(words):  # Python reads 1_000, files do not
                return None
            values = np.fromiter(map(self._kind, words), self._dtype, len(words))
        except (ValueError, OverflowError):
            return None
        return None if self._kind is int and (abs(values) >= _LARGEST).any() else values


def require_finite(points: Floats, where: Indices | Sequence[int], unit: str) -> None:
    """No coordinate is infinite or NaN; ``where`` (n,) is the line or byte of every point."""
    if (bad := np.flatnonzero(~np.isfinite(points).all(axis=1))).size:
        v = int(bad[0])
        value = points[v][~np.isfinite(points[v])][0]
        raise Fault(
            phrase("a coordinate is {value}", value=value),
            "replace it with a finite number or export the mesh again",
            f"{unit} {where[v]}",
        )


def whole(word: bytes, what: str, line: int) -> int:
    """The count that ``word`` spells."""
    value = _one(int, word)
    if value is None or value < 0:
        raise Fault.at_line(
            line, phrase("{what} is {word}", what=what, word=quoted(word)), "write a whole number, 0 or more"
        )
    return value


def number(word: bytes, what: str, line: int) -> float:
    """The number that ``word`` spells."""
    value = _one(float, word)
    if value is None:
        raise Fault.at_line(line, phrase("{what} is {word}", what=what, word=quoted(word)), "write a decimal number")
    return value


def _one(kind: Callable[[bytes], _Number], word: bytes) -> _Number | None:
    try:
        return None if b"_" in word else kind(word)  # Python reads 1_000, files do not
    except ValueError:
        return None

"""Lines, words and numbers of a text file.

Everything stays bytes: only names and comments have an encoding, and neither is read.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeAlias, TypeVar

import numpy as np

from subdivision.arrays import Floats, Indices
from subdivision.files.faults import Fault, quoted

Row: TypeAlias = tuple[int, list[bytes]]
"""A line's number, counted from 1, and its words."""

BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_LARGEST = 2**62
_Number = TypeVar("_Number", int, float)


def text_lines(data: bytes, start: int = 0) -> list[bytes]:
    """The lines of a text file from byte ``start`` on, whichever way they end.

    Raises
    ------
    Fault
        If it is no text, or text in two-byte characters.
    """
    if start == 0 and data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise Fault("it is text in UTF-16", "save it as plain text or UTF-8", "byte 0")
    if (at := data.find(b"\0", start)) >= 0:
        raise Fault.at_byte(at, "a NUL byte stands where text should be", "export the mesh again, as text")
    return data[start:].removeprefix(BYTE_ORDER_MARK).splitlines()


def rows(lines: Iterable[bytes], first: int = 1) -> Iterator[Row]:
    """The words of every line that has any, comments left out; ``first`` is the number of the first line."""
    for number, line in enumerate(lines, first):
        if b"#" in line:
            line = line.partition(b"#")[0]
        if words := line.split():
            yield number, words


def coordinates(words: Sequence[bytes], lines: Indices) -> Floats:
    """(n, 3) float: the points that the words, from the ``lines`` (n,), spell."""
    values = _all(float, words)
    if values is None:
        bad = _first_bad(float, words)
        raise Fault.at_line(
            int(lines[bad // 3]), f"{quoted(words[bad])} is not a number", "write every coordinate as a decimal number"
        )
    points = np.array(values, dtype=np.float64).reshape(-1, 3)
    require_finite(points, lines, "line")
    return points


def require_finite(points: Floats, where: Indices, unit: str) -> None:
    """No coordinate is infinite or NaN; ``where`` (n,) is the line or byte of every point."""
    if (bad := np.flatnonzero(~np.isfinite(points).all(axis=1))).size:
        v = int(bad[0])
        value = points[v][~np.isfinite(points[v])][0]
        raise Fault(
            f"a coordinate is {value}",
            "replace it with a finite number or export the mesh again",
            f"{unit} {where[v]}",
        )


def vertex_numbers(words: Sequence[bytes], sizes: Sequence[int], lines: Sequence[int]) -> Indices:
    """(n_corners,) int: the numbers that the words of all faces spell; each has ``sizes`` words on its line."""
    values = _all(int, words)
    if values is None or (values and max(max(values), -min(values)) >= _LARGEST):
        bad = _first_bad(int, words)
        line = lines[int(np.searchsorted(np.cumsum(sizes), bad, side="right"))]
        raise Fault.at_line(line, f"{quoted(words[bad])} is not a vertex number", "write a whole number")
    return np.array(values, dtype=np.intp)


def whole(word: bytes, what: str, line: int) -> int:
    """The count that ``word`` spells."""
    value = _one(int, word)
    if value is None or value < 0:
        raise Fault.at_line(line, f"{what} is {quoted(word)}", "write a whole number, 0 or more")
    return value


def number(word: bytes, what: str, line: int) -> float:
    """The number that ``word`` spells."""
    value = _one(float, word)
    if value is None:
        raise Fault.at_line(line, f"{what} is {quoted(word)}", "write a decimal number")
    return value


def _one(kind: Callable[[bytes], _Number], word: bytes) -> _Number | None:
    try:
        return None if b"_" in word else kind(word)  # Python reads 1_000, files do not
    except ValueError:
        return None


def _all(kind: Callable[[bytes], _Number], words: Sequence[bytes]) -> list[_Number] | None:
    try:
        return None if b"_" in b"".join(words) else list(map(kind, words))
    except ValueError:
        return None


def _first_bad(kind: Callable[[bytes], _Number], words: Sequence[bytes]) -> int:
    values = (_one(kind, word) for word in words)
    return next(k for k, value in enumerate(values) if value is None or (kind is int and abs(value) >= _LARGEST))

"""The header of a PLY file: in which form it is, and which rows of which properties follow."""

import re
from dataclasses import dataclass, replace

from subdivision.files.faults import Fault, printable, quoted
from subdivision.files.text import whole
from subdivision.words import phrase

_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
    "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "int64": "i8", "uint64": "u8", "float32": "f4", "float64": "f8",
}  # fmt: skip
_ORDERS = {b"ascii": "", b"binary_little_endian": "<", b"binary_big_endian": ">"}
_LONGEST = 2**20
_BEGIN = re.compile(rb"(?:\xef\xbb\xbf)?ply[ \t]*(\r\n|\n|\r)")


@dataclass(frozen=True)
class Property:
    """One value in each row, or a list of them.  Types are numpy's, ``count`` is "" but for lists."""

    name: str
    kind: str
    count: str = ""


@dataclass(frozen=True)
class Element:
    """A table of ``n`` rows; ``line`` declares it."""

    name: str
    n: int
    line: int
    properties: tuple[Property, ...] = ()

    @property
    def called(self) -> str:
        """Its name as a sentence shows it."""
        return printable(self.name[:40])

    @property
    def has_lists(self) -> bool:
        """Whether rows differ in length."""
        return any(p.count for p in self.properties)

    def property(self, *names: str) -> Property | None:
        """The first property with one of the names."""
        return next((p for p in self.properties if p.name in names), None)


@dataclass(frozen=True)
class Header:
    """``order`` is that of the bytes, "" in a text; the rows begin at byte ``size`` and below ``n_lines`` lines."""

    order: str
    elements: tuple[Element, ...] = ()
    size: int = 0
    n_lines: int = 0

    def element(self, name: str) -> Element | None:
        """The element of that name."""
        return next((e for e in self.elements if e.name == name), None)


def header_of(data: bytes) -> Header:
    """The header that a file begins with.

    Raises
    ------
    Fault
    """
    begin = _BEGIN.match(data)
    if not begin:
        raise Fault("it does not begin with the line 'ply'", "choose a PLY file or its right suffix", "line 1")
    newline = begin[1]
    end = data.find(newline + b"end_header", begin.end() - len(newline))
    size = data.find(newline, end + len(newline)) if end >= 0 else -1
    if size < 0:
        n = data.count(newline) + 1
        raise Fault.at_line(n, "the file ends before 'end_header'", "export the mesh again, it was cut short")
    if size > _LONGEST:
        raise Fault.at_line(
            1,
            phrase("the header has {size:,} bytes", size=size),
            phrase("write one of {most:,} at most", most=_LONGEST),
        )
    lines = data[begin.end() : end].split(newline) if end >= begin.end() else []
    header = _declared(lines)
    return replace(header, size=size + len(newline), n_lines=len(lines) + 2)


def _declared(lines: list[bytes]) -> Header:
    order: str | None = None
    elements: dict[str, tuple[int, int]] = {}
    properties: list[list[Property]] = []
    for number, line in enumerate(lines, 2):
        match words := line.split():
            case [] | [b"comment" | b"obj_info", *_]:
                pass
            case [b"format", name, *_] if name in _ORDERS:
                order = _ORDERS[name]
            case [b"element", name, count, *_] if name.decode("latin-1") not in elements:
                elements[name.decode("latin-1")] = whole(count, "the number of rows", number), number
                properties.append([])
            case [b"property", *rest] if properties:
                properties[-1].append(_property(rest, number))
            case _:
                what = phrase("{words} is no line of a PLY header, or one too many", words=quoted(b" ".join(words)))
                raise Fault.at_line(number, what, "correct it or export the mesh again")
    if order is None:
        raise Fault.at_line(2, "no 'format' is declared", "add a line such as 'format ascii 1.0'")
    tables = zip(elements.items(), properties, strict=True)
    return Header(order, tuple(Element(name, n, line, tuple(rows)) for (name, (n, line)), rows in tables))


def _property(words: list[bytes], line: int) -> Property:
    match [word.decode("latin-1") for word in words]:
        case ["list", count, kind, name] if _TYPES.get(count, "f")[0] in "iu" and kind in _TYPES:
            return Property(name, _TYPES[kind], _TYPES[count])
        case [kind, name] if kind in _TYPES:
            return Property(name, _TYPES[kind])
    raise Fault.at_line(
        line,
        phrase("'property' is followed by {words}", words=quoted(b" ".join(words))),
        "write 'property float x' or 'property list uchar int vertex_indices', with the types of PLY",
    )

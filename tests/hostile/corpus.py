"""Broken and hostile mesh files, the same ones every time: sound meshes in every format, and all that can be done to
them."""

import struct
from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np

from subdivision import Mesh, files, shapes
from subdivision.files import gltf, obj, ply, stl

SOUND = {
    "cube": shapes.cube(),
    "tetrahedron": shapes.tetrahedron(),
    "sheet": shapes.quad_sheet(),
}
SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
MANY = 1_000_000


def corpus(worst: bool = True) -> Iterator[tuple[str, bytes]]:
    """Names, all different, and contents; without the ``worst`` none is larger than a few thousand bytes."""
    for family in (_cut, _counts, _values, _indices, _disguises, _surfaces, _statements, _tags, _headers, _bytes):
        for name, data in family():
            yield f"{family.__name__[1:]}-{name}", data
    if worst:
        yield from ((f"worst-{name}", make()) for name, make in WORST.items())


def sound() -> dict[str, bytes]:
    """The sound files, by name: every format, text and binary."""
    written = {
        f"{name}{suffix}": write(mesh) for name, mesh in SOUND.items() for suffix, write in _WRITERS.items()
    }  # fmt: skip
    return {name.replace("-text", ""): data for name, data in written.items()}


def _obj(mesh: Mesh) -> bytes:
    return b"".join(obj.written(mesh))


def _off(mesh: Mesh) -> bytes:
    return off_of(mesh.points.tolist(), mesh.topology.loops())


def off_of(points: list, loops: list) -> bytes:
    rows = [" ".join(map(repr, p)) for p in points] + [" ".join(map(str, (len(f), *f))) for f in loops]
    return "\n".join(["OFF", f"{len(points)} {len(loops)} 0", *rows, ""]).encode()


def obj_of(points: list, loops: list) -> bytes:
    rows = [f"v {x!r} {y!r} {z!r}" for x, y, z in points] + ["f " + " ".join(str(v + 1) for v in f) for f in loops]
    return "\n".join([*rows, ""]).encode()


def ply_of(points: list, loops: list, form: str = "ascii", count: str = "uchar", kind: str = "int") -> bytes:
    head = (
        f"ply\nformat {form} 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(loops)}\nproperty list {count} {kind} vertex_indices\nend_header\n"
    ).encode()
    if form == "ascii":
        rows = [" ".join(map(repr, p)) for p in points] + [" ".join(map(str, (len(f), *f))) for f in loops]
        return head + "\n".join([*rows, ""]).encode()
    order = "<" if "little" in form else ">"
    body = b"".join(struct.pack(f"{order}3f", *p) for p in points)
    return head + body + b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in loops)


def _stl_text(mesh: Mesh) -> bytes:
    return stl_of([[mesh.points[v].tolist() for v in (f[0], b, c)] for f in mesh.topology.loops()
                   for b, c in pairwise(f[1:])])  # fmt: skip


def stl_of(facets: list) -> bytes:
    rows = ["solid it"]
    for facet in facets:
        rows += ["facet normal 0 0 0", "outer loop", *("vertex " + " ".join(map(repr, p)) for p in facet)]
        rows += ["endloop", "endfacet"]
    return "\n".join([*rows, "endsolid it", ""]).encode()


def _ply_big(mesh: Mesh) -> bytes:
    return ply_of(mesh.points.tolist(), mesh.topology.loops(), "binary_big_endian")


_WRITERS: dict[str, Callable[[Mesh], bytes]] = {
    ".obj": _obj,
    ".off": _off,
    "-binary.ply": lambda mesh: b"".join(ply.written(mesh)),
    "-big.ply": _ply_big,
    "-text.ply": lambda mesh: ply_of(mesh.points.tolist(), mesh.topology.loops()),
    "-binary.stl": lambda mesh: b"".join(stl.written(mesh)),
    "-text.stl": _stl_text,
}
TEXTS = {".obj": obj_of, ".off": off_of, ".ply": ply_of}


def _cut() -> Iterator[tuple[str, bytes]]:
    """Ended too early, begun too late, or with a hole."""
    for name, data in sound().items():
        stem, suffix = name.rsplit(".", 1)
        for k in (1, 2, 5, 9):
            yield f"{stem}-{k}.{suffix}", data[: len(data) * k // 10]
        yield f"{stem}-last-byte.{suffix}", data[:-1]
        yield f"{stem}-beheaded.{suffix}", data[len(data) // 7 :]
        yield f"{stem}-holed.{suffix}", data[: len(data) // 3] + data[len(data) // 2 :]


def _counts() -> Iterator[tuple[str, bytes]]:
    """Numbers of rows, corners and triangles that are not so."""
    for wrong in (0, 3, 5, 99, 2**31, 2**32, 2**63, 2**64, 10**30, -1):
        yield f"off-vertices-{wrong}.off", f"OFF\n{wrong} 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n".encode()
        yield f"off-faces-{wrong}.off", f"OFF\n4 {wrong} 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n".encode()
        yield f"off-corners-{wrong}.off", f"OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n{wrong} 0 1 2 3\n".encode()
        text = ply_of(SQUARE, [(0, 1, 2, 3)])
        binary = ply_of(SQUARE, [(0, 1, 2, 3)], "binary_little_endian")
        for form, data in (("text", text), ("binary", binary)):
            for element, right in ((b"vertex", b"4"), (b"face", b"1")):
                changed = data.replace(b"element %s %s" % (element, right), b"element %s %d" % (element, wrong))
                yield f"ply-{form}-{element.decode()}-{wrong}.ply", changed
        yield f"ply-corners-{wrong}.ply", text.replace(b"\n4 0 1 2 3", b"\n%d 0 1 2 3" % wrong)
    for wrong in (0, 1, 2**31 - 1, 2**32 - 1):
        data = b"".join(stl.written(SOUND["cube"]))
        yield f"stl-{wrong}.stl", data[:80] + wrong.to_bytes(4, "little") + data[84:]


def _values() -> Iterator[tuple[str, bytes]]:
    """Coordinates that are no numbers, or no finite ones."""
    words = ("nan", "-inf", "1e999", "infinity", "0x10", "1_000", "1,5", "--1", "", "1e", "٣", "9" * 5000, "NULL")
    for k, word in enumerate(words):
        rows = f"0 0 0\n1 0 0\n1 {word} 0\n0 1 0\n"
        vertices = "".join(f"v {row}\n" for row in rows.splitlines())
        yield f"{k}.obj", f"{vertices}f 1 2 3 4\n".encode()
        yield f"{k}.off", f"OFF\n4 1 0\n{rows}4 0 1 2 3\n".encode()
        yield f"{k}.ply", ply_of(SQUARE, [(0, 1, 2, 3)]).replace(b"1 1 0", f"1 {word} 0".encode())
        facet = stl_of([[(0, 0, 0), (1, 0, 0), (1, 1, 0)]])
        yield f"{k}.stl", facet.replace(b"vertex 1 1 0", f"vertex 1 {word} 0".encode())
    for value in (float("nan"), float("inf"), float("-inf")):
        points = [*SQUARE[:2], (1.0, value, 0.0), SQUARE[3]]
        yield f"{value}.ply", ply_of(points, [(0, 1, 2, 3)], "binary_little_endian")
        row = np.zeros(1, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]))
        row["corners"][0] = [points[0], points[1], points[2]]
        yield f"{value}.stl", bytes(80) + (1).to_bytes(4, "little") + row.tobytes()
    for size in (1e308, 5e-324):
        points = [tuple(size * x for x in p) for p in SQUARE]
        for suffix, written in TEXTS.items():
            yield f"{size:g}{suffix}", written(points, [(0, 1, 2, 3)]).replace(b"float", b"double")


def _indices() -> Iterator[tuple[str, bytes]]:
    """Faces that name vertices which are not there, relative ones too."""
    for wrong in (-1, -5, 4, 5, 2**31, 2**62, 2**63, 2**64, 10**30, -(10**30)):
        for suffix, written in TEXTS.items():
            yield f"{wrong}{suffix}", written(SQUARE, [(0, 1, 2), (0, 2, wrong)])
    for wrong in (-1, 4, 2**31 - 1, -(2**31)):
        for form in ("binary_little_endian", "binary_big_endian"):
            yield f"{form}-{wrong}.ply", ply_of(SQUARE, [(0, 1, 2), (0, 2, wrong)], form)
    square = obj_of(SQUARE, [])
    for k, words in enumerate(("-1 -2 -3", "-4 -3 -2 -1", "-5 -4 -3", "0 1 2", "1.5 2 3", "1// 2// 3//", "/1 /2 /3",
                               "1/2/3/4 2 3", "a b c", "1 2", "1", "", "+1 +2 +3", "1e0 2 3", "0x1 2 3")):  # fmt: skip
        yield f"words-{k}.obj", square + f"f {words}\n".encode()
    yield "before.obj", b"f -1 -2 -3\n" + square
    yield "forward.obj", b"f 1 2 3 4\n" + square


def _disguises() -> Iterator[tuple[str, bytes]]:
    """One thing declared and another there: formats, bytes, characters and line ends."""
    made = sound()
    for name in ("cube.obj", "cube.off", "cube-binary.ply", "cube.ply", "cube-binary.stl", "cube.stl"):
        for suffix in files.READABLE:
            if not name.endswith(suffix):
                yield f"{name.replace('.', '-')}{suffix}", made[name]
    yield from ((f"glb{s}", b"".join(gltf.written(SOUND["cube"]))) for s in files.READABLE)
    for name in ("cube.obj", "cube.off", "cube.ply", "cube.stl"):
        stem, suffix = name.split(".")
        data = made[name]
        text = data.decode()
        for encoding in ("utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-8-sig", "utf-7", "cp037"):
            yield f"{stem}-{encoding}.{suffix}", text.encode(encoding)
        lines = text.split("\n")
        ends = [["\n", "\r\n", "\r"][k % 3] for k in range(len(lines))]
        yield f"{stem}-crlf.{suffix}", text.replace("\n", "\r\n").encode()
        yield f"{stem}-cr.{suffix}", text.replace("\n", "\r").encode()
        yield f"{stem}-crcrlf.{suffix}", text.replace("\n", "\r\r\n").encode()
        yield f"{stem}-mixed.{suffix}", "".join(a + b for a, b in zip(lines, ends, strict=True)).encode()
        yield f"{stem}-one-line.{suffix}", text.replace("\n", " ").encode()
        yield f"{stem}-form-feeds.{suffix}", text.replace("\n", "\f").encode()
        yield f"{stem}-latin.{suffix}", data.replace(b"\n", b" # \xe9\xff\n", 3)
        yield f"{stem}-two-codes.{suffix}", data[: len(data) // 2] + text[len(text) // 2 :].encode("utf-16-le")
        yield f"{stem}-wide-spaces.{suffix}", text.replace(" ", "\u00a0").encode()
        for at in (0, 7, len(data) // 2, len(data) - 1):
            yield f"{stem}-nul-{at}.{suffix}", data[:at] + b"\0" + data[at:]
        yield f"{stem}-end-of-file.{suffix}", data[: len(data) // 2] + b"\x1a" + data[len(data) // 2 :]
    swapped = (("cube-binary.ply", b"little", b"big"), ("cube-big.ply", b"big", b"little"),
               ("cube-binary.ply", b"binary_little_endian", b"ascii"), ("cube.ply", b"ascii", b"binary_big_endian"),
               ("cube.ply", b"ascii", b"binary_little_endian"))  # fmt: skip
    for k, (name, a, b) in enumerate(swapped):
        yield f"order-{k}.ply", made[name].replace(a, b, 1)
    big = np.frombuffer(made["cube-binary.stl"][84:], "u1").reshape(-1, 50)
    turned = np.concatenate([big[:, :48].reshape(-1, 12, 4)[:, :, ::-1].reshape(-1, 48), big[:, 48:]], axis=1)
    yield "order.stl", made["cube-binary.stl"][:84] + turned.tobytes()
    yield "count-turned.stl", made["cube-binary.stl"][:80] + made["cube-binary.stl"][83:79:-1] + big.tobytes()


def _surfaces() -> Iterator[tuple[str, bytes]]:
    """Faces that are not those of an oriented surface, and some that are but look odd."""
    grid = [(float(i), float(j), 0.0) for i in range(5) for j in range(5)]
    ring = [(np.cos(a) * r, np.sin(a) * r, float(r > 1)) for a in np.arange(6.0) for r in (1.0, 2.0)]
    odd: dict[str, tuple[list, list]] = {
        "twice": (SQUARE, [(0, 1, 2, 3), (0, 1, 2, 3)]),
        "twice-turned": (SQUARE, [(0, 1, 2, 3), (2, 3, 0, 1)]),
        "both-sides": (SQUARE, [(0, 1, 2, 3), (3, 2, 1, 0)]),
        "three-on-an-edge": (grid, [(0, 1, 2), (1, 0, 3), (0, 1, 4)]),
        "thousand-on-an-edge": (grid * 50, [(0, 1, k) for k in range(2, 1000)]),
        "moebius": (ring, [(2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2) for k in range(5)] + [(10, 11, 0, 1)]),
        "klein": (grid, [(0, 1, 2), (1, 0, 2)]),
        "flipped": (grid, [(0, 1, 6, 5), (1, 6, 7, 2)]),
        "bow-tie": (grid, [(0, 1, 2), (0, 3, 4)]),
        "bow-tie-of-fans": (grid, [(0, 1, 2), (0, 2, 3), (0, 4, 5), (0, 5, 6)]),
        "bow-ties-in-a-row": (grid, [(0, 1, 2), (2, 3, 4), (4, 5, 6), (6, 7, 0)]),
        "isolated": (grid, [(0, 1, 6, 5)]),
        "all-isolated": (grid, []),
        "no-points": ([], [(0, 1, 2)]),
        "nothing": ([], []),
        "all-at-one-place": ([(1.0, 1.0, 1.0)] * 4, [(0, 1, 2, 3)]),
        "on-a-line": ([(float(k), 0.0, 0.0) for k in range(4)], [(0, 1, 2, 3)]),
        "corner-twice": (SQUARE, [(0, 1, 2, 1)]),
        "corner-twice-running": (SQUARE, [(0, 1, 1, 2)]),
        "one-point-four-times": (SQUARE, [(0, 0, 0, 0)]),
        "two-corners": (SQUARE, [(0, 1)]),
        "one-corner": (SQUARE, [(0,)]),
        "no-corner": (SQUARE, [()]),
        "good-then-small": (SQUARE, [(0, 1, 2, 3), (0, 1)]),
        "thousand-gon": ([(float(k), float(k * k), 0.0) for k in range(1000)], [tuple(range(1000))]),
        "apart": (grid, [(0, 1, 6), (12, 13, 18), (22, 23, 24)]),
    }
    for name, (points, loops) in odd.items():
        for suffix, written in TEXTS.items():
            yield f"{name}{suffix}", written(points, loops)
        if all(len(f) < 256 for f in loops):
            yield f"{name}-binary.ply", ply_of(points, loops, "binary_big_endian")
        if points and all(len(f) == 3 for f in loops):
            yield f"{name}.stl", stl_of([[points[v] for v in f] for f in loops])


def _statements() -> Iterator[tuple[str, bytes]]:
    """Lines that do not belong where they are."""
    square = obj_of(SQUARE, [(0, 1, 2, 3)])
    for k, line in enumerate(("v", "v 1", "v 1 2", "v 1 2 3 4 5 6 7", "vertex 1 2 3", "f", "p 1", "l 1 2", "call x.obj",
                              "\\", "f 1 2 \\\n3 \\\n4", "# \\", "o \x7f\x1b[2J", "mtllib ../../../../etc/passwd",
                              "cstype bspline\ncurv 0 1 1 2 3\nend", "\\\n\\\n\\\nf 1 2 9")):  # fmt: skip
        yield f"{k}.obj", square + line.encode() + b"\n"
    for k, head in enumerate(("", "4 1 0", "OFF BINARY", "COFF", "NOFF", "4OFF", "nOFF\n3", "OFFOFF", "off", "OFF 4",
                              "OFF # 4 1 0", "STCN4nOFF", "OFF\n4", "OFF\n4 1", "OFF\n4.0 1.0 0")):  # fmt: skip
        yield f"{k}.off", f"{head}\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n".encode()
    facet = stl_of([[(0, 0, 0), (1, 0, 0), (1, 1, 0)]])
    words = (b"solid", b"facet", b"outer loop", b"vertex", b"endloop", b"endfacet", b"endsolid")
    for word in words:
        yield f"without-{word.decode().replace(' ', '-')}.stl", facet.replace(word, b"", 1)
        yield f"twice-{word.decode().replace(' ', '-')}.stl", facet.replace(word, word + b"\n" + word, 1)
        yield f"only-{word.decode().replace(' ', '-')}.stl", b"solid\n" + word + b"\n"


def _tags() -> Iterator[tuple[str, bytes]]:
    """Creases and corners of OpenSubdiv, wrong in every place."""
    square = obj_of(SQUARE, [(0, 1, 2, 3)])
    for k, tag in enumerate(("crease", "crease 2/1/0", "crease 2/1/0 0", "crease 2/1/0 0 1", "crease 2/1/0 0 1 nan",
                             "crease 2/1/0 0 1 -1", "crease 2/1/0 0 1 inf", "crease 2/1/0 0 2 5", "crease 2/1/0 0 0 5",
                             "crease 2/1/0 0 99 5", "crease 2/1/0 -1 0 5", "crease 3/1/0 0 1 2 5", "crease 2/1 0 1 5",
                             "crease 1e9/1/0 0 1 5", "crease 99999999999999999999/1/0 0 1 5", "crease //",
                             "crease a/b/c", "corner 1/1/0 4 5", "corner 1/1/0 -1 5", "corner 1/1/0 0 x",
                             "corner 0/0/0", "hole 1/0/0 9",
                             f"corner 1/1/0 {10**30} 5", f"crease 2/1/0 0 {10**30} 5")):  # fmt: skip
        yield f"{k}.obj", square + f"t {tag}\n".encode()


def _headers() -> Iterator[tuple[str, bytes]]:
    """Headers of PLY that declare too little, too much, or something strange."""
    square = ply_of(SQUARE, [(0, 1, 2, 3)])
    changes = {
        "no-format": (b"format ascii 1.0\n", b""), "odd-format": (b"ascii", b"binary_middle_endian"),
        "two-formats": (b"format ascii 1.0\n", b"format ascii 1.0\nformat binary_little_endian 1.0\n"),
        "no-end": (b"end_header\n", b""), "early-end": (b"format", b"end_header\nformat"),
        "no-x": (b"property float x\n", b""), "x-twice": (b"property float y", b"property float x"),
        "list-x": (b"property float x", b"property list uchar float x"), "half-x": (b"float x", b"half x"),
        "float-list": (b"list uchar int", b"list uchar float"), "float-count": (b"list uchar", b"list float"),
        "no-list": (b"list uchar int", b"int"), "list-of-lists": (b"list uchar int", b"list uchar list uchar int"),
        "two-vertices": (b"element face", b"element vertex 1\nelement face"), "no-vertices": (b"vertex 4", b"point 4"),
        "no-faces": (b"element face 1\n", b""), "no-count": (b"element face 1", b"element face"),
        "bare-element": (b"element face", b"element bare 99999999999999\nelement face"),
        "property-first": (b"element vertex", b"property float w\nelement vertex"), "shout": (b"ply", b"PLY"),
        "nul": (b"element face", b"element \0face"), "control": (b"property float z", b"property float \x1b[31mz"),
        "extra-list": (b"property list", b"property list uint64 double more\nproperty list"),
    }  # fmt: skip
    for name, (a, b) in changes.items():
        yield f"{name}.ply", square.replace(a, b, 1)
        yield f"{name}-binary.ply", ply_of(SQUARE, [(0, 1, 2, 3)], "binary_little_endian").replace(a, b, 1)
    odd_name = b"element \x1b[31m" + b"\xff" * 500 + b" 9\nproperty char a\nend_header"  # found by the fuzzer
    yield "odd-name.ply", square.replace(b"end_header", odd_name)
    yield "crlf-in-binary.ply", ply_of(SQUARE, [(0, 1, 2, 3)], "binary_little_endian").replace(b"\n", b"\r\n")


def _bytes() -> Iterator[tuple[str, bytes]]:
    """Noise, alone and over sound files."""
    noise = np.random.default_rng(6)
    for suffix in files.READABLE:
        for k, size in enumerate((1, 3, 84, 134, 2000)):
            yield f"noise-{k}{suffix}", noise.bytes(size)
            yield f"same-{k}{suffix}", bytes([int(noise.integers(256))]) * size
    for name, data in sound().items():
        stem, suffix = name.rsplit(".", 1)
        for k in range(3):
            spoilt = np.frombuffer(data, np.uint8).copy()
            spoilt[noise.integers(len(spoilt), size=1 + 3 * k)] = noise.integers(256, size=1 + 3 * k)
            yield f"{stem}-spoilt-{k}.{suffix}", spoilt.tobytes()


def _gon(n: int, form: str = "") -> tuple[np.ndarray, np.ndarray]:
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1).round(6), np.arange(n)


def _gon_obj() -> bytes:
    points, loop = _gon(MANY)
    return b"".join(b"v %a %a %a\n" % tuple(p) for p in points.tolist()) + b"f " + b" ".join(
        b"%d" % (v + 1) for v in loop.tolist()
    )  # fmt: skip


def _gon_off() -> bytes:
    points, loop = _gon(MANY)
    rows = b"".join(b"%a %a %a\n" % tuple(p) for p in points.tolist())
    return b"OFF\n%d 1 0\n%s%d %s\n" % (MANY, rows, MANY, b" ".join(b"%d" % v for v in loop.tolist()))


def _gon_ply() -> bytes:
    points, loop = _gon(MANY)
    head = ply_of([], [], "binary_little_endian", "uint").replace(b"vertex 0", b"vertex %d" % MANY)
    count = struct.pack("<I", MANY)
    return head.replace(b"face 0", b"face 1") + points.astype("<f4").tobytes() + count + loop.astype("<i4").tobytes()


def _zeros_ply() -> bytes:
    head = ply_of([], [], "binary_little_endian").replace(b"face 0", b"face 20000000")
    return head + bytes(20_000_000)


def _alternating_ply() -> bytes:
    head = ply_of([], [], "binary_little_endian", kind="uchar").replace(b"face 0", b"face 2000000")
    return head.replace(b"element face", b"element junk 2000000\nproperty list uchar uchar a\nelement face") + (
        b"\0\1\1" * 2_000_000
    )  # fmt: skip


def _wide_ply() -> bytes:
    many = b"".join(b"property float p%d\n" % k for k in range(30_000)) + b"property list uchar int more\n"
    head = ply_of(SQUARE, [(0, 1, 2, 3)])
    junk = b"element face", b"element junk 100000\n" + many + b"element face"
    return head.replace(*junk).replace(b"4 0 1 2 3", b"0\n" * 100_000 + b"4 0 1 2 3")


def _deep_obj() -> bytes:
    block = b"v 0 0 0\n" * 3 + b"f -1 -2 -3\n"
    return block * 100_000 + b"f -%d -2 -1\n" % (300_001)


WORST: dict[str, Callable[[], bytes]] = {
    "million-gon.obj": _gon_obj,
    "million-gon.off": _gon_off,
    "million-gon.ply": _gon_ply,
    "million-times-one-corner.obj": lambda: b"v 0 0 0\nf " + b"1 " * MANY,
    "million-on-an-edge.obj": lambda: b"v 0 0 0\n" * 4 + b"f 1 2 3\n" * 300_000,
    "relative.obj": _deep_obj,
    "newlines.obj": lambda: b"\n" * 20_000_000 + b"v 1\n",
    "newlines.off": lambda: b"OFF\n" + b"\n" * 20_000_000,
    "newlines.stl": lambda: b"solid\n" + b"\n" * 20_000_000 + b"vertex",
    "newlines.ply": lambda: b"ply\nformat ascii 1.0\n" + b"\n" * 20_000_000,
    "spaces.obj": lambda: b" " * 20_000_000 + b"v 1\n",
    "comments.off": lambda: b"#\n" * 5_000_000,
    "carriage-returns.obj": lambda: b"\r" * 10_000_000 + b"f 1",
    "one-word.obj": lambda: b"v 0 0 " + b"9" * 10_000_000,
    "one-number.off": lambda: b"OFF\n" + b"9" * 10_000_000 + b" 1 0\n",
    "one-index.obj": lambda: b"v 0 0 0\nf 1 1 " + b"1" * 10_000_000,
    "words.obj": lambda: b"v " + b"1 " * 3_000_000,
    "words.stl": lambda: b"solid\nfacet\nvertex " + b"1 " * 3_000_000,
    "continued.obj": lambda: b"f 1\\\n" * 1_000_000,
    "slashes.obj": lambda: b"v 0 0 0\nf " + b"/" * 10_000_000,
    "vertices.obj": lambda: b"v 1 2 3\n" * MANY,
    "vertices.stl": lambda: b"solid\nfacet\n" + b"vertex 1 2 3\n" * MANY,
    "facets.stl": lambda: b"solid\n" + b"facet\nendfacet\n" * 500_000,
    "creases.obj": lambda: obj_of(SQUARE, [(0, 1, 2, 3)]) + b"t crease 2/1/0 0 1 5\n" * 200_000,
    "many-creases.obj": lambda: b"v 0 0 0\n" + b"t crease 400000/1/0 " + b"0 1 " * 200_000 + b"5\n",
    "properties.ply": lambda: b"ply\nformat ascii 1.0\nelement vertex 1\n" + b"property char a\n" * 600_000,
    "elements.ply": lambda: b"ply\n" + b"".join(b"element e%d 1\n" % k for k in range(300_000)) + b"end_header\n",
    "zeros.ply": _zeros_ply,
    "alternating.ply": _alternating_ply,
    "wide.ply": _wide_ply,
    "zeros.stl": lambda: bytes(80) + (300_000).to_bytes(4, "little") + bytes(300_000 * 50),
    "solid-noise.stl": lambda: b"solid" + b"x" * 10_000_000,
}

"""Files: what is written reads back the same, and every fault is a sentence with its place and mend."""

import os
import re
import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_array_equal

from subdivision import Grid, Mesh, Polyline, Topology
from subdivision.files import READABLE, FileError, read, write

LOOPS = [[0, 1, 2, 3], [1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]]  # a pyramid whose base is a quad
POINTS = np.array([[0, 0, 0], [0, 1 / 3, 0], [1.0, 1e-300, 0], [-1.5, 0.1, 2], [5e-324, 1.7e308, -7], [9, 9, 9]])


def pyramid(**sharpness):
    """With a vertex, the last one, that no face uses."""
    return Mesh(Topology.from_faces(LOOPS, 6, **sharpness), POINTS)


def same(a, b):
    assert_array_equal(a.points.view(np.int64), b.points.view(np.int64))  # bit for bit
    assert_array_equal(a.topology.origin, b.topology.origin)
    assert_array_equal(a.topology.face_sizes, b.topology.face_sizes)
    assert_array_equal(a.topology.ends, b.topology.ends)
    assert_array_equal(a.topology.edge_sharpness, b.topology.edge_sharpness)
    assert_array_equal(a.topology.vertex_sharpness, b.topology.vertex_sharpness)
    return True


def obj_text(mesh=None):
    mesh = mesh or pyramid()
    faces = [" ".join(str(v + 1) for v in loop) for loop in mesh.topology.loops()]
    return "".join([*(f"v {x!r} {y!r} {z!r}\n" for x, y, z in mesh.points.tolist()), *(f"f {f}\n" for f in faces)])


def off_text(keyword="OFF", colour=""):
    rows = [
        *(f"{x!r} {y!r} {z!r}" for x, y, z in POINTS.tolist()),
        *(f"{len(f)} {' '.join(map(str, f))}" for f in LOOPS),
    ]
    return f"{keyword}\n6 5 0\n" + "".join(f"{row}{colour}\n" for row in rows)


def ply_data(form, *, faces_first=False, count="uchar", kind="int", name="vertex_indices", scalar="double"):
    """A PLY of the pyramid with properties and an element that nobody needs."""
    codes = {
        "char": "b", "uchar": "B", "uint8": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "int64": "q",
        "float": "f", "double": "d",
    }  # fmt: skip
    mark = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}[form]

    def row(*cells):
        if not mark:
            return (" ".join(repr(value) for _, value in cells) + "\n").encode()
        return b"".join(struct.pack(mark + codes[k], value) for k, value in cells)

    vertex = [row(("uchar", 7), *((scalar, c) for c in p), ("ushort", 5)) for p in POINTS.tolist()]
    face = [
        row(("float", 0.5), (count, len(f)), *((kind, v) for v in f), ("uchar", 2), ("uchar", 1), ("uchar", 2))
        for f in LOOPS
    ]
    heads = [
        f"element vertex 6\nproperty uchar red\nproperty {scalar} x\nproperty {scalar} y\nproperty {scalar} z\n"
        "property ushort s\n",
        f"element face 5\nproperty float q\nproperty list {count} {kind} {name}\nproperty list uchar uchar t\n",
    ]
    tables = [b"".join(vertex), b"".join(face)]
    if faces_first:
        heads, tables = heads[::-1], tables[::-1]
    other = row(("double", 1.5)) * 3
    head = f"ply\nformat {form} 1.0\ncomment x\n{heads[0]}element camera 3\nproperty double f\n{heads[1]}end_header\n"
    return head.encode() + tables[0] + other + tables[1]


TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.5]])
TRIANGLES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]


def stl_text(points=TETRAHEDRON, triangles=TRIANGLES):
    corners = [["  vertex " + " ".join(map(repr, points[v].tolist())) for v in t] for t in triangles]
    facets = ("\n".join([" facet normal 0 0 0", " outer loop", *c, " endloop", " endfacet"]) for c in corners)
    return "\n".join(["solid name", *facets, "endsolid name", ""])


def stl_data(header=b"solid but binary", triangles=TRIANGLES):
    rows = (struct.pack("<12fH", 0, 0, 0, *TETRAHEDRON[t].ravel(), 0) for t in triangles)
    return header.ljust(80) + struct.pack("<I", len(triangles)) + b"".join(rows)


def put(folder, name, data):
    path = Path(folder) / name
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    return path


def names(folder):
    return [path.name for path in folder.iterdir()]


def sentence(path, action=read, *more):
    """What is said about a broken file: one line, one sentence, the file first."""
    with pytest.raises(FileError) as caught:
        action(path, *more)
    text = str(caught.value)
    assert "\n" not in text
    assert ". " not in text
    assert not text.endswith(".")
    assert re.match(re.escape(Path(path).name) + "(, (line|byte) [0-9]+)?: ", text)
    what, mend = text.split("; ")
    assert what
    assert mend
    return text


# What is right


@pytest.mark.parametrize("suffix", ["obj", "ply", "OBJ", "Ply"])
def test_a_written_mesh_reads_back_bit_for_bit(tmp_path, suffix):
    path = tmp_path / f"mesh.{suffix}"
    write(path, pyramid())
    same(read(path), pyramid())
    write(str(path), read(str(path)))
    same(read(path), pyramid())


@st.composite
def meshes(draw):
    """A net with some faces missing (never so that two corners only touch) and some dissolved into one polygon."""
    n, m = draw(st.integers(2, 6)), draw(st.integers(2, 6))
    net = Grid(n, m).mesh().loops()
    sizes = draw(st.integers(1, len(net)))
    fan = [[0, k, k + 1] for k in range(1, draw(st.integers(2, 300)))]
    polygon = [list(range(draw(st.integers(3, 300))))]
    loops = draw(st.sampled_from([net, net[:sizes], fan, polygon]))
    loops = [draw(st.sampled_from([loop, loop[1:] + loop[:1]])) for loop in loops]
    used = 1 + max(v for loop in loops for v in loop)
    many = used + draw(st.integers(0, 3))
    finite = st.floats(allow_nan=False, allow_infinity=False)
    points = draw(arrays(float, (many, 3), elements=finite, fill=st.just(-0.0)))
    plain = Topology.from_faces(loops, many)
    inside = plain.ends[~plain.boundary].tolist()
    sharp = st.floats(0, 10)
    creases = draw(st.dictionaries(st.sampled_from(inside).map(tuple), sharp, max_size=9)) if inside else {}
    corners = draw(st.dictionaries(st.integers(0, many - 1), sharp, max_size=9))
    return Mesh(Topology.from_faces(loops, many, creases=creases, corners=corners), points)


@settings(deadline=None)  # a save waits for the disk
@given(mesh=meshes())
def test_any_mesh_written_and_read_is_the_same_mesh(tmp_path_factory, mesh):
    folder = tmp_path_factory.mktemp("files")
    write(folder / "mesh.obj", mesh)
    same(read(folder / "mesh.obj"), mesh)
    smooth = Topology.from_corners(mesh.topology.face_sizes, mesh.topology.origin, mesh.topology.n_vertices)
    write(folder / "mesh.ply", mesh)
    same(read(folder / "mesh.ply"), Mesh(smooth, mesh.points))


def test_a_net_is_written_as_its_mesh(tmp_path):
    net = Grid(3, 4, wrap_s=True, diagonal=True)
    points = np.arange(36.0).reshape(12, 3)
    write(tmp_path / "net.obj", Mesh(net, points))
    same(read(tmp_path / "net.obj"), Mesh(net.mesh(), points))


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian", "binary_big_endian"])
@pytest.mark.parametrize("faces_first", [False, True])
@pytest.mark.parametrize(
    ("count", "kind", "name"),
    [("uchar", "int", "vertex_indices"), ("int", "uint", "vertex_index"), ("uint8", "ushort", "vertex_index"),
     ("char", "int64", "vertex_indices"), ("short", "uchar", "vertex_indices"), ("uint", "char", "vertex_index")],
)  # fmt: skip
def test_every_form_of_ply_reads_the_same(tmp_path, form, faces_first, count, kind, name):
    data = ply_data(form, faces_first=faces_first, count=count, kind=kind, name=name)
    same(read(put(tmp_path, "a.ply", data)), pyramid())
    if form == "ascii":
        same(read(put(tmp_path, "b.ply", data.replace(b"\n", b"\r\n"))), pyramid())
        same(read(put(tmp_path, "c.ply", data.replace(b"\n", b"\r"))), pyramid())


def test_ply_with_crlf_header_keeps_binary_rows_that_begin_with_a_newline(tmp_path):
    mesh = pyramid()
    points = mesh.points.copy()
    points[0, 0] = np.frombuffer(b"\n\r\n\n\n\n\n\n", "<f8")[0]
    write(tmp_path / "a.ply", Mesh(mesh.topology, points))
    head, body = (tmp_path / "a.ply").read_bytes().split(b"end_header\n", 1)
    for newline in (b"\n", b"\r\n", b"\r"):
        data = (head + b"end_header\n").replace(b"\n", newline) + body
        same(read(put(tmp_path, "b.ply", data)), Mesh(mesh.topology, points))


@pytest.mark.parametrize(
    "text",
    [
        off_text(),
        "\n# first\n" + off_text().replace("\n", "  # and more\n\n"),
        off_text().replace("OFF\n", "OFF "),
        off_text().replace("OFF\n", "OFF"),
        off_text().replace("\n", "\r\n"),
        off_text("COFF", " 255 0 0 255"),
        off_text("NOFF", " 0 0 1"),
        off_text("STCNOFF", " 0 0 1 1 1 1 1 0 0"),
        "\N{BYTE ORDER MARK}" + off_text(),
    ],
)
def test_off_reads_with_headers_comments_and_colours_of_all_kinds(tmp_path, text):
    same(read(put(tmp_path, "a.off", text)), pyramid())


def test_stl_merges_corners_at_the_same_position_in_order_of_first_appearance(tmp_path):
    order = [0, 2, 1, 3]
    expected = Topology.from_faces([[order.index(v) for v in t] for t in TRIANGLES])
    for data in (
        stl_text(),
        stl_text().upper().encode(),
        stl_data(),
        stl_data(b"COLOR"),
        stl_data(b"solid\0\0\nfacet"),
    ):
        same(read(put(tmp_path, "a.stl", data)), Mesh(expected, TETRAHEDRON[order]))
    minus_zero = stl_text().replace(" 0.0 ", " -0.0 ", 3)
    assert read(put(tmp_path, "b.stl", minus_zero)).topology.n_vertices == 4


def test_obj_passes_over_what_is_no_mesh(tmp_path):
    text = (
        "\N{BYTE ORDER MARK}# made by hand\r\nmtllib none.mtl\r\no thing\r\nvt 0 0\r\nvn 0 0 1\r\n"
        "v 0 0 0 1.0\r\nv 1 0 0 255 0 0\r\n\tv  1 \\\r\n1 0 # a corner\r\n\r\ng some_group\r\nusemtl red\r\ns off\r\n"
        "f 1/1/1 2//1 \\\r\n 3/1\r\nv 0 1 0\r\nf -4/1 -2/1/1 -1\r\nl 1 2 3\r\np 1\r\ncstype bspline\r\nt hole 1/0/0 0"
    )
    mesh = read(put(tmp_path, "a.obj", text.encode() + b"\r\n# caf\xe9\x85 v 1\r\n# path\\\r\nv 9 9 9\r\nt\r\n"))
    assert mesh.topology.loops() == [[0, 1, 2], [0, 2, 3]]
    assert_array_equal(mesh.points, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [9, 9, 9]])


def test_obj_tags_are_those_of_opensubdiv(tmp_path):
    tags = (
        "t crease 2/1/0 0 1 2.5\nt crease 2/1/0   4 1   12\nt crease 4/2/0 2 4 3 4 1.5 0.25\n"
        "t interpolateboundary 1/0/0 2\n"
        "t corner 1/1/0 4 0.7 \nt corner 2/1/0 0 5 1\nt crease 2/1/0 1 0 3.5\nt vertexedit 16/4/3 none of it is read\n"
    )
    creases = {(0, 1): 3.5, (1, 4): 10, (2, 4): 1.5, (3, 4): 0.25}
    expected = pyramid(creases=creases, corners={4: 0.7, 0: 1, 5: 1})
    same(read(put(tmp_path, "a.obj", obj_text() + tags)), expected)
    write(tmp_path / "b.obj", expected)
    assert "t crease 2/1/0 0 1 3.5\n" in (tmp_path / "b.obj").read_text()
    assert "t corner 1/1/0 4 0.7\n" in (tmp_path / "b.obj").read_text()


# What is wrong

CUBE = obj_text(Mesh(Topology.from_faces([[0, 1, 2, 3]], 4), np.eye(4, 3)))  # four lines of vertices, one face
PLY = (
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
)
BINARY = PLY[: PLY.index("0 0 0")].replace("ascii", "binary_little_endian").encode()
ROWS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
SIGNALLING_NAN = b"\x01\x00\xa0\x7f"
FACE = struct.pack("<B3i", 3, 0, 1, 2)
OFF = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
STL = stl_text(triangles=TRIANGLES[:1])

BROKEN = [
    ("empty.obj", "", "", "the file is empty; export"),
    ("blank.stl", "\n \n", "", "the file is empty; export"),
    ("text.obj", "Dear Sir,\nvertices follow.\n", "", "it has neither vertices nor faces; export a polygon mesh"),
    ("page.obj", "<html>\n<p>v 1 2 3</p>", "", "it has neither vertices nor faces; export a polygon mesh"),
    ("points.obj", "v 0 0 0\nv 1 0 0\n", "", "it has 2 vertices but no faces; export"),
    ("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", "", "it has 2 vertices but no faces; export"),
    ("nul.obj", b"v 0 0 0\nv 0 \0", "byte 12", "a NUL byte stands where text should be; export"),
    ("utf16.obj", CUBE.encode("utf-16"), "byte 0", "it is text in UTF-16; save it as"),
    ("word.obj", CUBE + "v 1 abc 3\n", "line 6", "'abc' is not a number; write"),
    ("under.obj", CUBE + "v 1 1_0 3\n", "line 6", "'1_0' is not a number; write"),
    ("noise.obj", CUBE.encode() + b"v 1 \xff\x1b 3\n", "line 6", "'\N{REPLACEMENT CHARACTER}?' is not a number; write"),
    ("nan.obj", CUBE + "v 1 nan 3\n", "line 6", "a coordinate is nan; replace it"),
    ("huge.obj", CUBE + "\nv 1 1e999 3\n", "line 7", "a coordinate is inf; replace it"),
    ("flat.obj", CUBE + "v 1 2\n", "line 6", "this vertex has 2 of 3 coordinates; write"),
    ("split.obj", "v 1 \\\n 2 \\\n3\nv 1 2\n", "line 4", "this vertex has 2 of 3 coordinates; write"),
    ("far.obj", CUBE + "f 1 2 5\n", "line 6", "names vertex 5, but the vertices are numbered from 1 to 4; correct"),
    ("zero.obj", CUBE + "f 1 2 0\n", "line 6", "names vertex 0, but the vertices are numbered from 1 to 4; correct"),
    ("back.obj", CUBE + "v 9 9 9\nf 1 2 -6\n", "line 7", "names vertex -6, but only 5 come before it; correct"),
    ("none.obj", "f 1 2 3\n", "line 1", "names vertex 1, but there are no vertices; correct the number or add"),
    ("float.obj", CUBE + "f 1 2 3.0\n", "line 6", "'3.0' is not a vertex number; write a whole number"),
    ("lost.obj", CUBE + "f 1 2 /3\n", "line 6", "'' is not a vertex number; write a whole number"),
    ("long.obj", CUBE + f"f 1 2 {'9' * 30}\n", "line 6", f"'{'9' * 30}' is not a vertex number; write"),
    ("longer.obj", CUBE + f"f 1 2 -{'9' * 9999}\n", "line 6", f"'-{'9' * 39}...' is not a vertex number; write"),
    ("two.obj", CUBE + "f 1 2\n", "line 6", "this face has 2 corners; give it three or more"),
    ("bare.obj", CUBE + "f\n", "line 6", "this face has 0 corners; give it three or more"),
    ("twice.obj", CUBE + "f 1 3 3\n", "line 6", "this face visits vertex 3 twice; remove"),
    ("flip.obj", CUBE + "f 1 2 3\n", "line 6", "and the one at line 5 both run from vertex 1 to vertex 2; reverse"),
    ("fin.obj", CUBE + "f 2 1 4\n\nf 1 2 3\n", "line 8", "one of 3 faces at the edge between vertex 1 and vertex 2"),
    ("bow.obj", CUBE + "v 1 2 3\nv 4 5 6\nf 1 5 6\n", "line 8", "at vertex 1 the fan of this face touches another wi"),
    ("tag.obj", CUBE + "t crease 2/1/0 0 1\n", "line 6", "announces 3 arguments and has 2; write 't crease 2/1/0 a b"),
    ("count.obj", CUBE + "t corner 1 0 1\n", "line 6", "does not say how many arguments it has; write 't corner 1/1/0"),
    ("arity.obj", CUBE + "t crease 3/1/0 0 1 2 5.\n", "line 6", "this crease has too many or too few arguments; write"),
    ("vertex.obj", CUBE + "t corner 1/1/0 x 5\n", "line 6", "a tagged vertex is 'x'; write a whole number"),
    ("sharp.obj", CUBE + "t corner 1/1/0 0 -1\n", "line 6", "a sharpness is '-1'; write a number from 0"),
    ("blunt.obj", CUBE + "t corner 1/1/0 0 nan\n", "line 6", "a sharpness is 'nan'; write a number from 0"),
    ("soft.obj", CUBE + "t corner 1/1/0 0 hard\n", "line 6", "a sharpness is 'hard'; write a decimal number"),
    ("edge.obj", CUBE + "t crease 2/1/0 2 0 1\n", "line 6", "no face has an edge between 0 and 2 to crease; name"),
    ("corner.obj", CUBE + "t corner 1/1/0 4 1\n", "line 6", "there is no vertex 4 to sharpen; write"),
    ("other.off", CUBE, "line 1", "it begins with 'v', not 'OFF'; choose"),
    ("space.off", OFF.replace("OFF", "4OFF"), "line 1", "'4OFF' has points that are not in space; export"),
    ("binary.off", "OFF BINARY\n" + OFF[4:], "line 1", "it is binary OFF; export it as text"),
    ("bare.off", "OFF\n\n3\n", "line 3", "the counts of vertices and faces are missing; write both"),
    ("header.off", "OFF\n", "line 1", "the counts of vertices and faces are missing; write both"),
    ("word.off", OFF.replace("3 1 0", "3 one 0"), "line 2", "the number of faces is 'one'; write"),
    ("minus.off", OFF.replace("3 1 0", "-3 1 0"), "line 2", "the number of vertices is '-3'; write"),
    ("cut.off", OFF[:-9], "line 5", "ends after 3 of 3 vertices and 0 of 1 faces; correct the counts in line 2"),
    ("big.off", OFF.replace("3 1 0", "3 9999999999999999999 0"), "line 6", "1 of 9999999999999999999 faces; correct"),
    ("more.off", OFF.replace("1 0\n", "0 0\n", 1), "line 6", "there is more than the 3 vertices and 0 faces that lin"),
    ("none.off", "OFF\n1 0 0\n0 0 0\n", "", "it has 1 vertex but no faces; export"),
    ("far.off", OFF.replace("3 0 1 2", "3 0 1 3"), "line 6", "names vertex 3, but the vertices are numbered from 0"),
    ("back.off", OFF.replace("3 0 1 2", "3 0 1 -1"), "line 6", "names vertex -1, but the vertices are numbered fro"),
    ("few.off", OFF.replace("3 0 1 2", "3 0 1"), "line 6", "this face announces 3 corners and names 2; name them all"),
    ("flat.off", OFF.replace("1 0 0", "1 0"), "line 4", "this vertex has 2 of 3 coordinates; write all three"),
    ("other.ply", OFF, "line 1", "it does not begin with the line 'ply'; choose"),
    ("cut.ply", PLY[:90], "line 7", "the file ends before 'end_header'; export"),
    ("form.ply", PLY.replace("ascii", "utf8"), "line 2", "'format utf8 1.0' is no line of a PLY header"),
    ("unsaid.ply", PLY.replace("format ascii 1.0\n", ""), "line 2", "no 'format' is declared; add"),
    ("twice.ply", PLY.replace("element face", "element vertex"), "line 7", "'element vertex 1' is no line of a PLY h"),
    ("type.ply", PLY.replace("float y", "real y"), "line 5", "'property' is followed by 'real y'; write"),
    ("list.ply", PLY.replace("list uchar", "list float"), "line 8", "followed by 'list float int vertex_indices'; wr"),
    ("rows.ply", PLY.replace("vertex 3", "vertex 3.5"), "line 3", "the number of rows is '3.5'; write"),
    ("flat.ply", PLY.replace("float z", "float w"), "line 3", "vertices have no property 'z'; export them with"),
    ("cloud.ply", PLY.replace("element face", "element strip"), "line 9", "declares no element 'face'; export"),
    ("faces.ply", PLY.replace("element vertex", "element point"), "line 9", "declares no element 'vertex'; export"),
    ("loop.ply", PLY.replace("_indices", "_names"), "line 7", "no list of whole numbers 'vertex_indices'; export"),
    ("real.ply", PLY.replace("uchar int", "uchar float"), "line 7", "no list of whole numbers 'vertex_indices'; expo"),
    ("short.ply", PLY.replace("1 0 0\n", "1 0\n"), "line 11", "this row of element vertex has only 2 words; complete"),
    ("few.ply", PLY.replace("3 0 1 2", "4 0 1 2"), "line 13", "this row of element face has only 4 words; complete"),
    ("minus.ply", PLY.replace("3 0 1 2", "-3 0 1 2"), "line 13", "the length of a list is '-3'; write"),
    ("ends.ply", PLY.replace("face 1", "face 2"), "line 13", "ends after 1 of 2 rows of element face; export"),
    ("big.ply", PLY.replace("vertex 3", f"vertex {10**18}"), "line 13", f"ends after 4 of {10**18} rows of element v"),
    ("more.ply", PLY + "3 0 1 2\n", "line 14", "there are more rows than the header declares; correct"),
    ("bytes.ply", PLY.encode()[:-8] + FACE, f"byte {len(PLY) - 7}", "a NUL byte stands where text should be; export"),
    ("nan.ply", PLY.replace("1 0 0\n", "1 NaN 0\n"), "line 11", "a coordinate is nan; replace"),
    ("far.ply", PLY.replace("3 0 1 2", "3 0 1 7"), "line 13", "names vertex 7, but the vertices are numbered from 0"),
    ("cutb.ply", BINARY + ROWS + FACE[:-1], f"byte {len(BINARY) + 48}", "all rows of element face (line 7 declares"),
    ("bigb.ply", BINARY.replace(b"x 3", b"x 7000000000") + ROWS, "byte", "vertex (line 3 declares 7000000000);"),
    ("nanb.ply", BINARY + SIGNALLING_NAN * 9 + FACE, f"byte {len(BINARY)}", "a coordinate is nan; replace"),
    ("farb.ply", BINARY + ROWS + FACE[:-1] + b"\x80", f"byte {len(BINARY) + 36}", "names vertex -2147483646, but the"),
    ("moreb.ply", BINARY + ROWS + FACE * 2, f"byte {len(BINARY) + 49}", "more follows than the header declares;"),
    ("minusb.ply", BINARY.replace(b"uchar", b"char") + ROWS + b"\xff" + FACE, "byte", "a list of -1 values begins"),
    ("longb.ply", BINARY.replace(b"uchar", b"uint64") + ROWS + b"\xff" * 9, "byte", "all rows of element face"),
    ("other.stl", "v 0 0 0\n" * 20, "byte 0", "it begins neither with 'solid' nor as binary STL does; choose"),
    ("cut.stl", STL[:-32], "line 7", "the file ends before 'endfacet'; export"),
    ("open.stl", STL[: STL.index("endsolid")], "line 8", "the file ends before 'endsolid'; export"),
    ("none.stl", "solid\nendsolid\n", "", "it has neither vertices nor faces; export"),
    ("word.stl", STL.replace("0.0 1.0", "0.0 one"), "line 5", "'one' is not a number; write"),
    ("flat.stl", STL.replace("0.0 1.0 0.0", "0.0 1.0"), "line 5", "this vertex has 2 of 3 coordinates; write"),
    ("loose.stl", STL.replace(" facet normal 0 0 0\n", ""), "line 3", "'vertex' does not belong here; write each"),
    ("nested.stl", STL.replace(" endfacet\n", "") + STL, "line 8", "'endsolid' does not belong here; write each"),
    ("verb.stl", STL.replace("outer", "outre"), "line 3", "'outre' does not belong here; write each"),
    ("nul.stl", STL.replace("endloop", "end\0loop"), "byte 110", "a NUL byte stands where text should be; export"),
    ("two.stl", re.sub("  vertex 1.*\n", "", STL), "line 2", "this face has 2 corners; give"),
    ("thin.stl", STL.replace("0.0 1.0 0.0", "0.0 0.0 0.0"), "line 2", "visits the corner (0, 0, 0) twice; remove"),
    ("flip.stl", stl_text(triangles=[[0, 1, 2], [0, 1, 3]]), "line 9", "run from the corner (0, 0, 0) to the corner"),
    ("cutb.stl", stl_data()[:-1], "byte 80", "4 triangles are announced, which takes 284 bytes, but the file has 283"),
    ("bigb.stl", stl_data()[:80] + b"\xff\xff\xff\0", "byte 80", "16777215 triangles are announced, which takes 83886"),
    ("nanb.stl", stl_data()[:-6] + SIGNALLING_NAN + b"\0\0", "byte 234", "a coordinate is nan; replace"),
    ("noneb.stl", stl_data(triangles=[]), "", "it has neither vertices nor faces; export"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "data", "place", "said"), BROKEN, ids=[broken[0] for broken in BROKEN])
def test_a_broken_file_is_told_by_what_where_and_the_mend(tmp_path, name, data, place, said):
    text = sentence(put(tmp_path, name, data))
    assert text.startswith(f"{name}, {place}" if place else f"{name}: ")
    assert said in text


def test_faults_keep_their_line_in_a_long_file(tmp_path):
    mesh = Mesh(Grid(300, 300).mesh(), np.random.default_rng(3).normal(size=(90000, 3)))
    lines = obj_text(mesh).splitlines()
    lines[123456] = "f " + " ".join(reversed(lines[123456].split()[1:]))
    assert "line 123457" in sentence(put(tmp_path, "long.obj", "\n".join(lines)))


@pytest.mark.parametrize(
    ("name", "data", "every"),
    [
        ("a.obj", obj_text() + "t crease 2/1/0 0 1 2.5\n", 1),
        ("a.off", off_text(), 1),
        ("a.ply", ply_data("ascii", faces_first=True), 3),
        ("a.ply", ply_data("binary_little_endian"), 3),
        ("a.ply", ply_data("binary_big_endian", faces_first=True), 3),
        ("a.stl", stl_text(), 3),
        ("a.stl", stl_data(), 1),
    ],
)
def test_a_file_cut_anywhere_is_read_or_refused_but_never_crashes(tmp_path, name, data, every):
    data = data.encode() if isinstance(data, str) else data
    assert read(put(tmp_path, name, data)).topology.n_faces
    for length in range(0, len(data), every):
        path = put(tmp_path, name, data[:length])
        try:
            read(path)
        except FileError:
            sentence(path)


@settings(deadline=None)
@given(data=st.data())
def test_a_file_with_any_bytes_changed_is_read_or_refused_but_never_crashes(tmp_path_factory, data):
    folder = tmp_path_factory.mktemp("noise")
    good = {
        ".obj": obj_text() + "t crease 2/1/0 0 1 2.5\n", ".off": off_text(), ".stl": stl_text(),
        ".STL": stl_data(), ".ply": ply_data("ascii"), ".PLY": ply_data("binary_big_endian"),
    }  # fmt: skip
    suffix = data.draw(st.sampled_from(sorted(good)))
    content = bytearray(good[suffix].encode() if isinstance(good[suffix], str) else good[suffix])
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(content)))
        content[at : at + data.draw(st.integers(0, 3))] = data.draw(
            st.binary(max_size=4)
            | st.sampled_from([b"-", b"9" * 20, b"nan", b"1e999", b"\n", b"#", b"\\\n", b"/", b" "])
        )
    said = ""
    try:
        read(put(folder, f"noise{suffix}", bytes(content)))
    except FileError as error:
        said = str(error)
    assert said.isprintable()


def test_a_path_that_is_no_readable_file_is_told_too(tmp_path):
    (tmp_path / "folder.obj").mkdir()
    os.mkfifo(tmp_path / "pipe.obj")
    assert "there is no such file in" in sentence(tmp_path / "missing.obj")
    assert "it is a folder; choose a file in it" in sentence(tmp_path / "folder.obj")
    assert "it is a folder; choose a file in it" in sentence(tmp_path)
    assert "it is a pipe or a device" in sentence(tmp_path / "pipe.obj")
    assert "files ending in '.fbx' are not read; use one of .obj, .off, .ply, .stl" in sentence(tmp_path / "mesh.fbx")
    assert "the name has no suffix; use one of" in sentence(tmp_path / "mesh")
    assert "the system refused it" in sentence(tmp_path / f"{'long' * 99}.obj")
    assert sentence_of(str(tmp_path / "two\nlines.obj")).startswith("two?lines.obj: there is no such file")
    assert sentence_of("nul\0.obj").startswith("nul?.obj: a file's name has no NUL")
    assert READABLE == (".obj", ".off", ".ply", ".stl")


def sentence_of(path):
    with pytest.raises(FileError) as caught:
        read(path)
    return str(caught.value)


@pytest.mark.parametrize("trouble", [PermissionError(13, "Permission denied"), OSError(5, "I/O error"), MemoryError()])
def test_what_the_system_refuses_is_a_sentence(tmp_path, monkeypatch, trouble):
    path = put(tmp_path, "a.obj", CUBE)

    def refuse(self):
        raise trouble

    monkeypatch.setattr(Path, "read_bytes", refuse)
    sentence(path)


# Saving


@pytest.mark.parametrize("call", ["fsync", "replace", "write"])
@pytest.mark.parametrize("name", ["a.obj", "a.ply"])
def test_a_failed_save_leaves_the_old_file_whole_and_nothing_beside_it(tmp_path, monkeypatch, call, name):
    path = put(tmp_path, name, "old")

    def fail(*_):
        raise OSError(28, "No space left on device")

    def pieces(_):
        yield b"half of a new file"
        fail()

    if call == "write":
        monkeypatch.setattr("subdivision.files._WRITERS", {".obj": pieces, ".ply": pieces})
    else:
        monkeypatch.setattr(*((os, "fsync") if call == "fsync" else (Path, "replace")), fail)
    assert "no space is left for it" in sentence(path, write, pyramid())
    assert path.read_bytes() == b"old"
    assert names(tmp_path) == [name]


def test_an_interrupted_save_leaves_the_old_file_too(tmp_path, monkeypatch):
    path = put(tmp_path, "a.obj", "old")

    def interrupt(_):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write(path, pyramid())
    assert path.read_bytes() == b"old"
    assert names(tmp_path) == ["a.obj"]


def test_a_save_keeps_links_and_permissions(tmp_path):
    path = put(tmp_path, "a.obj", "old")
    path.chmod(0o640)
    (tmp_path / "link.obj").symlink_to(path)
    write(tmp_path / "link.obj", pyramid())
    assert (tmp_path / "link.obj").is_symlink()
    assert path.stat().st_mode & 0o777 == 0o640
    same(read(path), pyramid())


def test_what_cannot_be_saved_is_told(tmp_path):
    (tmp_path / "folder.obj").mkdir()
    wild = Mesh(pyramid().topology, np.where(POINTS == 9, np.nan, POINTS))
    for name, mesh, said in [
        ("a.off", pyramid(), "files ending in '.off' are not written; use one of .obj, .ply, .stl, .glb"),
        ("a", pyramid(), "the name has no suffix; use one of .obj, .ply, .stl, .glb"),
        ("folder.obj", pyramid(), "it is a folder"),
        ("missing/a.obj", pyramid(), "there is no folder"),
        ("a.obj", Mesh(Polyline(3), np.eye(3)), "the control object has no faces; save a mesh"),
        ("a.ply", Mesh(Grid(1, 3), np.eye(3)), "the control object has no faces; save a mesh"),
        ("a.ply", wild, "point 5 is not finite; move it"),
    ]:
        assert said in sentence(tmp_path / name, write, mesh)
    assert names(tmp_path) == ["folder.obj"]

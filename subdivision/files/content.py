"""What a reader found in a file, and the mesh it makes; faults are told in the numbers of the file."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from subdivision.arrays import Floats, Indices
from subdivision.files.faults import Fault
from subdivision.manifold import TopologyError
from subdivision.topology import Topology
from subdivision.trace import Mesh
from subdivision.words import phrase, plural


@dataclass(frozen=True, eq=False)
class Content:
    """Faces and points before the engine has judged them.

    Attributes
    ----------
    points : (n_vertices, 3) float
    sizes : (n_faces,) int
    corners : (n_corners,) int
        The faces' vertices laid end to end, numbered from 0.
    where : (n_faces,) int
        The line of every face, or its byte: which of them is the ``unit``.
    vertex : function
        What the file calls a vertex.
    creases, sharp_corners : mappings
        Sharpness of edges (smaller vertex first) and vertices.
    tag_lines : mapping
        The line of every crease.
    """

    points: Floats
    sizes: Indices
    corners: Indices
    where: Indices
    unit: str = "line"
    vertex: Callable[[int], str] = "vertex {}".format
    creases: Mapping[tuple[int, int], float] = field(default_factory=dict)
    sharp_corners: Mapping[int, float] = field(default_factory=dict)
    tag_lines: Mapping[tuple[int, int], int] = field(default_factory=dict)

    def place(self, face: int) -> str:
        """Where a face is in the file."""
        return f"{self.unit} {self.where[face]}"

    def loop(self, face: int) -> list[int]:
        """The vertices of one face."""
        end = int(self.sizes[: face + 1].sum())
        return list(map(int, self.corners[end - int(self.sizes[face]) : end]))


def mesh_of(content: Content) -> Mesh:
    """The mesh.

    Raises
    ------
    Fault
        If there are no faces, or they are not the faces of an oriented surface.
    """
    n = len(content.points)
    _require_faces(content, n)
    try:
        topology = Topology.from_corners(
            content.sizes, content.corners, n, creases=content.creases, corners=content.sharp_corners
        )
    except TopologyError as error:
        raise _in_the_files_words(error, content) from None
    return Mesh(topology, content.points)


def require_known(content: Content) -> Content:
    """``content``, if all its faces name vertices that are there; for files that count from 0."""
    n = len(content.points)
    if (bad := np.flatnonzero((content.corners < 0) | (content.corners >= n))).size:
        face = int(np.searchsorted(np.cumsum(content.sizes), bad[0], side="right"))
        known = phrase("the vertices are numbered from 0 to {last}", last=n - 1) if n else "there are no vertices"
        raise Fault(
            phrase("this face names vertex {vertex}, but {known}", vertex=content.corners[bad[0]], known=known),
            "correct the number or add the vertex",
            content.place(face),
        )
    return content


def _require_faces(content: Content, n: int) -> None:
    if len(content.sizes) == 0:
        held = plural("it has {n} vertex but no faces", "it has {n} vertices but no faces", n, n=n)
        raise Fault(held if n else "it has neither vertices nor faces", "export a polygon mesh with its faces")
    if (small := np.flatnonzero(content.sizes < 3)).size:
        f = int(small[0])
        raise too_few_corners(int(content.sizes[f]), content.place(f))


def too_few_corners(n: int, place: str) -> Fault:
    """The fault of a face that is none."""
    what = plural("this face has {n} corner", "this face has {n} corners", n, n=n)
    return Fault(what, "give it three or more, or remove it", place)


def _in_the_files_words(error: TopologyError, content: Content) -> Fault:
    """The same fault with the lines of its faces and the file's names of its vertices."""
    match len(error.faces), len(error.vertices):
        case 0, 2:
            return _no_such_edge(content, error.vertices)
        case 1, 0:
            return _repeated_corner(content, error.faces[0])
        case _, 1:
            return _bow_tie(content, error.faces, error.vertices[0])
        case 2, 2:
            return _flipped(content, error.faces, error.vertices)
        case _, 2:
            return _crowded_edge(content, error.faces, error.vertices)
        case _:
            return Fault("its faces are not those of an oriented surface", "repair the mesh where it was made")


def _no_such_edge(content: Content, ends: tuple[int, ...]) -> Fault:
    return Fault.at_line(
        content.tag_lines[min(ends), max(ends)],
        phrase("no face has an edge between {ends} to crease", ends=" and ".join(map(str, ends))),
        "name the two ends of an edge, counted from 0 in tags",
    )


def _repeated_corner(content: Content, face: int) -> Fault:
    twice = Counter(content.loop(face)).most_common(1)[0][0]
    return Fault(
        phrase("this face visits {vertex} twice", vertex=content.vertex(twice)),
        "remove the repeated corner",
        content.place(face),
    )


def _bow_tie(content: Content, faces: Iterable[int], vertex: int) -> Fault:
    *others, last = sorted(faces)
    return Fault(
        phrase(
            "at {vertex} the fan of this face touches another without sharing an edge, a bow tie "
            "(other faces there: {others})",
            vertex=content.vertex(vertex),
            others=_listed(content, others),
        ),
        "give each fan a vertex of its own",
        content.place(last),
    )


def _flipped(content: Content, faces: Iterable[int], ends: tuple[int, ...]) -> Fault:
    first, last = sorted(faces)
    a, b = map(content.vertex, ends)
    return Fault(
        phrase("this face and the one at {place} both run from {a} to {b}", place=content.place(first), a=a, b=b),
        "reverse the corner order of one of them, or remove one if they are the same",
        content.place(last),
    )


def _crowded_edge(content: Content, faces: Iterable[int], ends: tuple[int, ...]) -> Fault:
    *others, last = sorted(faces)
    a, b = map(content.vertex, ends)
    return Fault(
        phrase(
            "this is one of {n} faces at the edge between {a} and {b} (others: {others})",
            n=len(others) + 1,
            a=a,
            b=b,
            others=_listed(content, others),
        ),
        "a surface has at most two there, so remove the rest or split the edge",
        content.place(last),
    )


def _listed(content: Content, faces: list[int]) -> str:
    shown = ", ".join(content.place(f) for f in faces[:5])
    return phrase("{shown} and {n} more", shown=shown, n=len(faces) - 5) if len(faces) > 5 else shown

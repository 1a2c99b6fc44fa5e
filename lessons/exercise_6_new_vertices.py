"""Exercise 6. New vertices are ordinary: valence 4 among quads, 6 among triangles."""

from collections.abc import Iterator

import numpy as np

from lessons.measured import without_helpers
from lessons.script import Beat, Look, View, fragment, lesson, side_by_side
from subdivision import Trace, shapes, trace
from subdivision.rows import shown_faces
from subdivision.schemes import QUAD_CENTROID, TRIANGLE_CENTROID
from subdivision.words import phrase

LOOK = Look(azimuth=-80.0, elevation=62.0)
CENTRE = 0
ORDINARY = (4, 6)


@lesson("Exercise 6  New vertices", section="Exercises", knobs={"valence": range(3, 9)},
        ours="The lecture argues it in a sentence; that it is an exercise is inferred.")
def exercise_6_new_vertices(valence: int = 5) -> Iterator[Beat]:
    quads = without_helpers(trace(QUAD_CENTROID, fragment(shapes.quad_fan(valence, rings=2))))
    triangles = without_helpers(trace(TRIANGLE_CENTROID, fragment(shapes.triangle_fan(valence, rings=2))))
    pair = (quads, triangles)
    solids = {"a plus sign": trace(QUAD_CENTROID, shapes.plus_sign(), levels=2),
              "an icosahedron": trace(TRIANGLE_CENTROID, shapes.icosahedron(), levels=2)}  # fmt: skip

    def both(start: int, stop: int, born: bool = True) -> tuple[View, ...]:
        return tuple(View(told, start, stop, title=title, marks=valences(told, stop) if born else centre(told))
                     for told, title in zip(pair, ("quads", "triangles"), strict=True))

    yield side_by_side(phrase("One vertex of valence {valence} on either side.", valence=valence),
                       *both(0, 0, born=False), look=LOOK,
                       claim=all(told.control.surface.valence[CENTRE] == valence for told in pair))
    yield side_by_side("Topology. Count the edges at the new vertices.", *both(0, 1, born=False), look=LOOK,
                       claim=not any(told.stages[0].moves for told in pair))
    yield side_by_side("Among quads every one has 4, among triangles every one has 6; the centre keeps its own.",
                       *both(1, 1), look=LOOK, poster=True,
                       claim=all(new_valences(told) == {n} for told, n in zip(pair, ORDINARY, strict=True))
                       and all(told.whole.topology.valence[CENTRE] == valence for told in pair))
    yield side_by_side("Why? An {edge} edge point has two halves of its edge, and one or two edges into each face.",
                       *both(1, 1), look=LOOK, formula=r"$2 + 1 + 1 = 4 \qquad 2 + 2 + 2 = 6$",
                       notes="And a face point has one edge to each of the four edges of its quad. Triangles have no "
                       "face points, though the lecture's sentence speaks of them.",
                       claim=new_valences(quads) == {2 + 2 * 1} and new_valences(triangles) == {2 + 2 * 2})
    yield side_by_side("Geometry moves vertices, not edges: the valences stay.", *both(1, 2), look=LOOK,
                       claim=all(told.topology_at(1) is told.topology_at(2) for told in pair))
    yield side_by_side("So on a closed mesh only the vertices it began with can be extraordinary: here at level 2.",
                       *(View(told, 6, 6, title=title) for title, told in solids.items()),
                       claim=all(not told.mesh_at(6).surface.extraordinary[len(told.control.points):].any()
                                 and told.mesh_at(6).surface.extraordinary.any() for told in solids.values()))


def valences(told: Trace, at: int) -> tuple[tuple[int, str], ...]:
    """What to write at the centre and at the new vertices of the faces round it."""
    valence = told.topology_at(at).valence
    return tuple((v, f"{valence[v]}") for v in (CENTRE, *new_vertices(told)))


def centre(told: Trace) -> tuple[tuple[int, str], ...]:
    return ((CENTRE, f"n = {told.control.topology.valence[CENTRE]}"),)


def new_vertices(told: Trace) -> list[int]:
    """Vertices that the topology brings, on the faces of the fragment that are shown."""
    return list(map(int, np.intersect1d(told.stages[0].born, shown_faces(told.topology_at(1))[1])))


def new_valences(told: Trace) -> set[int]:
    return set(told.topology_at(1).valence[new_vertices(told)].tolist())

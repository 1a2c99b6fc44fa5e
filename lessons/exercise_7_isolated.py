"""Exercise 7. Extraordinary vertices stay as many as they were, ever farther apart."""

from collections.abc import Iterator

from lessons.measured import isolation, nearest, without_helpers
from lessons.script import Beat, View, lesson, side_by_side
from subdivision import Trace, shapes, trace
from subdivision.schemes import QUAD_CENTROID, TRIANGLE_CENTROID

LEVELS = 3


@lesson("Exercise 7  Isolated", section="Exercises",
        ours="The lecture says that extraordinary vertices become isolated; counting the edges between them is ours.")
def exercise_7_isolated() -> Iterator[Beat]:
    cube = without_helpers(trace(QUAD_CENTROID, shapes.cube(), levels=LEVELS))
    icosahedron = without_helpers(trace(TRIANGLE_CENTROID, shapes.icosahedron(), levels=LEVELS))
    pair = {"a cube": cube, "an icosahedron": icosahedron}

    def both(start: int, stop: int) -> tuple[View, ...]:
        return tuple(View(told, start, stop, title=title, reading=isolation) for title, told in pair.items())

    yield side_by_side("Every vertex is extraordinary: valence 3 among quads, 5 among triangles.", *both(0, 0),
                       notes="Two that share an edge are one edge apart.",
                       claim=[set(told.control.surface.valence) for told in pair.values()] == [{3}, {5}])
    yield side_by_side("One level. No new ones; and between each two of them there is now another vertex.", *both(0, 2),
                       formula=r"$d \rightarrow 2\,d$",
                       claim=[distances(told)[:2] for told in pair.values()] == [[1, 2]] * 2)
    yield side_by_side("Two levels: four edges apart. From the first level on no two share a face.", *both(2, 4),
                       claim=all(distances(told)[2] == 4 and not share_a_face(told, 1) for told in pair.values()))
    yield side_by_side("Three levels: eight edges apart, in a sea of ordinary vertices.", *both(4, 6), poster=True,
                       formula=r"$d_k = 2^k d_0$", notes="386 vertices left, 642 right; 8 and 12 of them are marked.",
                       claim=all(distances(told) == [1, 2, 4, 8] for told in pair.values())
                       and [extraordinary(told) for told in pair.values()] == [{8}, {12}]
                       and [told.topology_at(6).n_vertices for told in pair.values()] == [386, 642])


def distances(told: Trace) -> list[int]:
    """How many edges the nearest two are apart, level by level."""
    return [nearest(told.mesh_at(2 * k)) for k in range(LEVELS + 1)]


def extraordinary(told: Trace) -> set[int]:
    """How many there are, at all levels."""
    return {int(told.mesh_at(2 * k).surface.extraordinary.sum()) for k in range(LEVELS + 1)}


def share_a_face(told: Trace, level: int) -> bool:
    """Whether some face has two extraordinary corners."""
    t = told.mesh_at(2 * level).surface
    return max(int(t.extraordinary[loop].sum()) for loop in t.loops()) > 1

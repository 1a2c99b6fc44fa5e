"""Exercise 5. How many vertices, edges and faces there are after each level, and what never changes."""

from collections.abc import Callable, Iterator, Mapping

from lessons.measured import counted, without_helpers
from lessons.script import Beat, View, lesson, side_by_side
from subdivision import Mesh, Scheme, Trace, shapes, trace
from subdivision.measure import Counts, counts
from subdivision.schemes import QUAD_CENTROID, TRIANGLE_CENTROID

LEVELS = 3
QUADS = {"closed: a cube": shapes.cube, "with a hole: a torus": shapes.torus, "open: a sheet": shapes.quad_sheet}
TRIANGLES = {"closed: an octahedron": shapes.octahedron, "with a hole: a torus": shapes.triangle_torus,
             "open: a sheet": shapes.triangle_sheet}  # fmt: skip


@lesson("Exercise 5  Counting", section="Exercises",
        ours="The lecture describes the splits; the formulas for the counts, and χ, are ours.")
def exercise_5_counts() -> Iterator[Beat]:
    quads, triangles = told(QUAD_CENTROID, QUADS), told(TRIANGLE_CENTROID, TRIANGLES)

    yield side_by_side("Count vertices, edges and faces. What is V - E + F?", *panes(quads, 0, 0),
                       formula=r"$\chi = V - E + F$",
                       notes="2 for whatever can be blown up to a ball, 0 for a torus, 1 for a sheet. The outline of "
                       "the sheet follows a boundary rule that the lecture does not have; it changes no count.",
                       claim=[eulers(each) for each in quads.values()] == [{2}, {0}, {1}])
    yield side_by_side("One level. Every vertex, edge and face brings a vertex; every face brings four edges inside.",
                       *panes(quads, 0, 1), formula=split_into("V + E + F", "2E + 4F"),
                       claim=all(new == (old.vertices + old.edges + old.faces, 2 * old.edges + 4 * old.faces,
                                         4 * old.faces, old.euler) for old, new in pairs(quads)))
    yield side_by_side("χ has not changed. Geometry moves points; it makes none.", *panes(quads, 1, 2),
                       formula=r"$(V + E + F) - (2E + 4F) + 4F = V - E + F$",
                       claim=all(each.topology_at(1) is each.topology_at(2) for each in quads.values()))
    yield side_by_side("Level 2: four times as many faces again. χ stays.", *panes(quads, 2, 4),
                       claim=all(eulers(each) == {counts(each.control.topology).euler} for each in quads.values()))
    yield side_by_side("Level 3. In the end there is one vertex and there are two edges for every face.",
                       *panes(quads, 4, 6), poster=True,
                       notes="Exactly so on the torus, where χ is 0; elsewhere V and F differ by χ, or by the rim.",
                       claim=all(counts(each.topology_at(6)).edges == 2 * counts(each.topology_at(6)).faces
                                 for title, each in quads.items() if "open" not in title)
                       and last(quads, 1).vertices == last(quads, 1).faces)
    yield side_by_side("Triangles: what are the counts here?", *panes(triangles, 0, 0),
                       claim=[eulers(each) for each in triangles.values()] == [{2}, {0}, {1}])
    yield side_by_side("No face points: a vertex for every edge, and three edges inside every face.",
                       *panes(triangles, 0, 1), formula=split_into("V + E", "2E + 3F"),
                       claim=all(new == (old.vertices + old.edges, 2 * old.edges + 3 * old.faces,
                                         4 * old.faces, old.euler) for old, new in pairs(triangles)))
    yield side_by_side("χ stays once more: V + E less 2E + 3F, plus 4F.", *panes(triangles, 1, 4),
                       formula=r"$(V + E) - (2E + 3F) + 4F = V - E + F$",
                       claim=all(eulers(each) == {counts(each.control.topology).euler} for each in triangles.values()))


def split_into(vertices: str, edges: str) -> str:
    return rf"$V \rightarrow {vertices},\quad E \rightarrow {edges},\quad F \rightarrow 4F$"


def told(scheme: Scheme, shown: Mapping[str, Callable[[], Mesh]]) -> dict[str, Trace]:
    return {title: without_helpers(trace(scheme, shape(), levels=LEVELS)) for title, shape in shown.items()}


def panes(traces: dict[str, Trace], start: int, stop: int) -> tuple[View, ...]:
    """The meshes side by side, their counts below them."""
    return tuple(View(each, start, stop, title=title, reading=counted) for title, each in traces.items())


def eulers(told: Trace) -> set[int]:
    """Every Euler characteristic on the way."""
    return {counts(told.topology_at(k)).euler for k in range(len(told.stages) + 1)}


def pairs(traces: dict[str, Trace]) -> list[tuple[Counts, Counts]]:
    """The counts before and after every level."""
    return [(counts(each.topology_at(2 * k)), counts(each.topology_at(2 * k + 2)))
            for each in traces.values() for k in range(LEVELS)]


def last(traces: dict[str, Trace], which: int) -> Counts:
    """The counts of one of the meshes in the end."""
    return counts(list(traces.values())[which].topology_at(2 * LEVELS))

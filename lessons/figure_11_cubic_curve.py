"""Figure 11. The cubic curve in two stages: first topology, then geometry."""

from collections.abc import Iterator

from lessons.questions import weight, where
from lessons.script import Beat, lesson, play, show
from subdivision import shapes, trace
from subdivision.schemes import lane_riesenfeld


@lesson("Figure 11  The cubic curve", section="3.1 Quads: averaging",
        ours="The panels and their colours follow Figure 12; the figure itself is missing from the text.")
def figure_11_cubic_curve() -> Iterator[Beat]:
    told = trace(lane_riesenfeld(3), shapes.hook(), telling="topology and geometry", levels=3)
    topology, midpoints, geometry, *later = told.stages
    split_and_averaged = trace(lane_riesenfeld(3), shapes.hook())
    vertex = told.step(0).stencil(1)

    yield show(told, None, "(a) Original control points: a polygon.", claim=told.control.topology.n_vertices >= 4)
    yield play(told, topology, "(b) New topology: a new point in the middle of every edge. The shape stays.",
               claim=not topology.moves and len(topology.born) == told.control.topology.n_edges)
    yield play(told, midpoints, "Mark the midpoint of every new edge. These are helpers, not vertices.",
               claim=len(midpoints.born) == topology.topology.n_edges)
    yield play(told, geometry, "(c) New geometry: every vertex moves to the midpoint of the two midpoints beside it.",
               formula=r"$Q \rightarrow \dfrac{C_1 + C_2}{2}$",
               predict=where(9, "Every vertex goes amid the two midpoints beside it. Where will this one be?"),
               notes="The two ends have a midpoint on one side only; they are dropped, and the polygon shortens.",
               claim=abs(told.step(0).matrix - split_and_averaged.whole.matrix).max() < 1e-12)
    yield show(told, geometry, "Both stages in one formula: one eighth, six eighths, one eighth.",
               formula=r"$Q_{i+1} = \dfrac{P_i + 6 P_{i+1} + P_{i+2}}{8}$", stencil=vertex, span=3,
               predict=weight(vertex, 1, "Both stages at once: how much of itself does the vertex keep?"),
               claim=str(vertex) == "3/4 v1 + 1/8 v0 + 1/8 v2")
    yield play(told, later[0], "Again, from the points just made: topology, midpoints, geometry.", until=later[2],
               claim=not later[0].moves and later[2].moves)
    yield play(told, later[3], "Three levels, and the eye sees a curve: a cubic B-spline, twice differentiable.",
               until=later[5], claim=later[5].topology.n_vertices == 2 * later[2].topology.n_vertices - 3)

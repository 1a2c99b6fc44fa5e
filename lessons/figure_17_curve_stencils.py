"""Figure 17. Stencils for cubic curves: one for edge points, one for vertex points."""

from collections.abc import Iterator

import numpy as np

from lessons.measured import without_helpers
from lessons.questions import where
from lessons.script import Beat, beside, lesson, play, side_by_side, stencil_of
from subdivision import Mesh, Polyline, Stencil, Trace, shapes, trace
from subdivision.schemes import lane_riesenfeld

CUBIC = lane_riesenfeld(3)
EDGE, VERTEX = "(a) edge stencil", "(b) vertex stencil"


@lesson("Figure 17  Curve stencils", section="3.2 Quads: stencils")
def figure_17_curve_stencils() -> Iterator[Beat]:
    edge, vertex = stencil_of(_bent(0, 1.5, 1.5, 0), 2, EDGE), stencil_of(_bent(1.5, 0, 1.5, 0, 1.5), 3, VERTEX)
    told = without_helpers(trace(CUBIC, shapes.hook(), "topology and geometry", levels=2))
    topology, geometry, *again = told.stages
    rows = [told.step(0).stencil(k) for k in range(geometry.n_points)]

    yield side_by_side("A step makes two kinds of points. Each has its stencil: a list of weights.", edge, vertex,
                       formula=r"$\dfrac{P_i+P_{i+1}}{2}\qquad \dfrac{P_i+6P_{i+1}+P_{i+2}}{8}$", poster=True,
                       notes="Discs are the old points with their weights, the clear diamond is the new point. "
                             "Ask: what must the weights of a stencil add up to, and why?",
                       claim=_weights(edge.stencil) == ["1/2", "1/2"]
                       and _weights(vertex.stencil) == ["3/4", "1/8", "1/8"])
    yield beside(play(told, topology, "Edge points: one in the middle of every edge.",
                      formula=r"$Q_{i+\frac{1}{2}} = \dfrac{P_i+P_{i+1}}{2}$",
                      stencil=topology.stencil(5), claim=not topology.moves), edge)
    yield beside(play(told, geometry, "Vertex points: six eighths of the old place, one eighth of each neighbour.",
                      formula=r"$Q_{i+1} = \dfrac{P_i+6P_{i+1}+P_{i+2}}{8}$", stencil=rows[5], span=2,
                      predict=where(7, "Six eighths of the old place, one of each neighbour. Where to?"),
                      notes="The two ends have a neighbour on one side only; they are dropped, and the curve is that "
                            "of the inner points.",
                      claim=_weights(rows[5]) == ["3/4", "1/8", "1/8"]), vertex)
    yield beside(play(told, again[0], "Again, with the same two stencils. There are no others.", until=again[1],
                      claim={len(row.terms) for row in rows} == {2, 3}
                      and all(sum(w for _, w in row.terms) == 1 for row in rows)), edge, vertex)


def _bent(*heights: float) -> Trace:
    """One step on a polygon whose points stand side by side."""
    return trace(CUBIC, Mesh(Polyline(len(heights)), np.array([(x, y, 0.0) for x, y in enumerate(heights)])))


def _weights(row: Stencil | None) -> list[str]:
    return [str(weight) for _, weight in row.terms] if row else []

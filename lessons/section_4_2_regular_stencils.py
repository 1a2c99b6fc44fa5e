"""Section 4.2. Stencils of the quartic box spline: edge points and vertex points of triangles."""

from collections.abc import Iterator

import numpy as np

from lessons.script import Beat, Look, beside, fragment, lesson, play, show, side_by_side, stencil_of
from subdivision import Stencil, Trace, shapes, trace
from subdivision.schemes import LOOP, TRIANGLE_CENTROID

LOOK = Look(azimuth=-68.0, elevation=50.0)


@lesson("Quartic stencils", section="4.2 Triangles: stencils",
        ours="The lecture announces these stencils; the text of this section is missing.")
def section_4_2_regular_stencils() -> Iterator[Beat]:
    star = trace(TRIANGLE_CENTROID, shapes.triangle_star(6))
    told = trace(TRIANGLE_CENTROID, fragment(shapes.triangle_fan(6, rings=2)), "stencils")
    edges, vertices, connect = told.stages
    edge, vertex = (stencil_of(star, 7 + _spoke(star), "(a) edge stencil"), stencil_of(star, 0, "(b) vertex stencil"))
    edge_row = told.upto(1).stencil(told.control.topology.n_vertices + _spoke(told))
    vertex_row = told.upto(2).stencil(0)

    yield side_by_side("Triangles need two stencils: for edge points and for vertex points. There are no face points.",
                       edge, vertex, formula=r"$\dfrac{3\,(A+B)+C+D}{8}\qquad \dfrac{10\,V+\sum N_i}{16}$", poster=True,
                       notes="Where every vertex has valence 6 this is the three-direction quartic box spline: split "
                             "linearly, then average in three directions, read as one row.",
                       claim=_weights(star.whole.stencil(7 + _spoke(star)), 8) == [1, 1, 3, 3]
                       and _weights(star.whole.stencil(0), 16) == [1] * 6 + [10])
    yield beside(show(told, None, "Six triangles of a larger mesh, and the ring about them.", look=LOOK,
                      claim=int((~told.control.surface.hidden).sum()) == 6), edge, vertex)
    yield beside(play(told, edges, "Edge points: three eighths of each end, one eighth of each opposite corner.",
                      look=LOOK, stencil=edge_row, formula=r"$\dfrac{3\,(A+B)+C+D}{8}$",
                      claim=_weights(edge_row, 8) == [1, 1, 3, 3]), edge)
    yield beside(play(told, vertices, "Vertex points: ten sixteenths of the vertex, one of each of six neighbours.",
                      look=LOOK, stencil=vertex_row, span=2, formula=r"$\dfrac{10\,V+\sum N_i}{16}$",
                      claim=_weights(vertex_row, 16) == [1] * 6 + [10]), vertex)
    yield play(told, connect, "Connect: every triangle becomes four. It is centroid averaging in one go.", look=LOOK,
               claim=bool(abs(told.whole.matrix - trace(TRIANGLE_CENTROID, told.control).whole.matrix).max() < 1e-12)
               and star.whole.stencil(0) == trace(LOOP, star.control).whole.stencil(0))


def _spoke(told: Trace) -> int:
    """The number of an edge at vertex 0."""
    return int(np.flatnonzero((told.control.topology.ends == 0).any(axis=1))[0])


def _weights(row: Stencil, below: int) -> list[float]:
    return sorted(below * float(weight) for _, weight in row.terms)

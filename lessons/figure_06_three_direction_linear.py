"""Figure 6. The three-direction piecewise linear box spline, one level: quadruple, average along (1,1)."""

from collections.abc import Iterator

import numpy as np

from lessons.questions import which
from lessons.script import Beat, Look, at_rest, before_and_after, lesson, play, show, with_diagram
from subdivision import Mesh, Trace, shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import THREE_DIRECTION_LINEAR, TRIANGLE_CENTROID, box_spline, tensor_product

LOOK = Look(azimuth=-78.0, elevation=56.0, zoom=0.88)
PANELS = "(a) Quadruple", "(b) Average along (1,1)"


@lesson("Figure 6  Three-direction linear", section="2.2 Box spline surfaces",
        ours="The figure is missing from the text; its content follows from what section 4.1 says of it.")
def figure_06_three_direction_linear() -> Iterator[Beat]:
    told = trace(box_spline(THREE_DIRECTION_LINEAR), shapes.net(3, 3, diagonal=True))
    quadruple, along = told.stages
    bilinear = trace(tensor_product(1, 1), shapes.net(3, 3))
    old, new = as_grid(told.control.topology), as_grid(along.topology)
    on_edge, on_diagonal = (told.whole.stencil(int(new.numbers[at])) for at in ((1, 2), (1, 1)))

    yield with_diagram(show(told, None, "A net with its diagonals: every square is two triangles.", look=LOOK,
                            formula=r"$V = \{(1,0),\ (0,1),\ (1,1)\}$",
                            notes="Three vectors, three directions of edges. Two of the vectors are used up by "
                            "quadrupling; one is left for averaging.",
                            claim=old.shape == (3, 3) and old.n_faces == 8))
    yield with_diagram(play(told, quadruple, "Write every point four times. Nothing moves.", look=LOOK,
                            formula=r"$U_{2i+a,\,2j+b} = P_{ij},\quad a, b \in \{0, 1\}$",
                            claim=quadruple.n_points == 36 and not quadruple.moves,
                            notes="The same array as in Figure 5 (a). Ask: average along a diagonal instead, and what "
                            "do you get?"))
    yield before_and_after(play(told, along, "Average along (1,1), just once: originals and midpoints of all edges.",
                                look=LOOK, formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i+1,j+1}}{2}$",
                                predict=which("Average along a diagonal, once. Which net will it be?",
                                              *at_rest(told, (0, ""), (2, "")),
                                              *at_rest(bilinear, (len(bilinear.stages), ""))),
                                notes="One pass is enough, where the bilinear surface needs two. Hover a box on the "
                                "right: its two parents on the left lie on a diagonal.",
                                claim=new.shape == (5, 5) and set(along.roles) == {0, 1}), quadruple, *PANELS)
    yield before_and_after(show(told, along, "In the middle of every square: the midpoint of its diagonal, not a face "
                                "point.", look=LOOK, stencil=on_diagonal, span=2,
                                formula=r"$\dfrac{P_{00} + P_{11}}{2}$",
                                notes="The other diagonal does not count: the triangulation has a direction.",
                                claim=dict(on_diagonal.terms) == {0: 1 / 2, 4: 1 / 2}
                                and dict(on_edge.terms) == {1: 1 / 2, 4: 1 / 2}), quadruple, *PANELS)
    yield with_diagram(show(told, along, "This is linear subdivision of the triangles: the surface keeps its shape.",
                            look=LOOK, notes="The same points as the topological stage of triangle subdivision in "
                            "section 4, which takes them from the edges of a mesh instead of an array.",
                            claim=is_linear(told) and as_grid(along.topology).n_faces == 4 * old.n_faces))


def is_linear(told: Trace) -> bool:
    """Whether the rows are those of the topological stage of triangle subdivision: vertices, and midpoints of edges."""
    surface = as_grid(told.control.topology).mesh()
    topology, *_ = trace(TRIANGLE_CENTROID, Mesh(surface, told.control.points)).stages
    mine, theirs = (np.array(sorted(m.toarray().tolist())) for m in (told.whole.matrix, topology.matrix))
    return mine.shape == theirs.shape and bool(abs(mine - theirs).max() == 0)

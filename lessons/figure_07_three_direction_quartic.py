"""Figure 7. The three-direction quartic box spline, one level: Figure 6 averaged along three directions."""

from collections.abc import Iterator

from lessons.questions import weight
from lessons.script import Beat, Look, lesson, play, show, with_diagram
from subdivision import Stencil, shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import THREE_DIRECTION_LINEAR, box_spline

LOOK = Look(azimuth=-78.0, elevation=56.0, zoom=0.88)
PASSES = ((1, 1), (1, 0), (0, 1), (1, 1), (1, 0), (0, 1))
"""Each vector twice, in the order that passes Figure 6 on the way."""

VERTEX, EDGE = [10, 1, 1, 1, 1, 1, 1], [6, 6, 2, 2]


@lesson("Figure 7  Three-direction quartic", section="2.2 Box spline surfaces",
        ours="The figure is missing from the text; its content is inferred from its place and from section 4.1.")
def figure_07_three_direction_quartic() -> Iterator[Beat]:
    net = shapes.net(4, 4, diagonal=True)
    told = trace(box_spline(PASSES), net)
    _, linear, along_s, along_t, diagonally = told.stages
    figure_6 = trace(box_spline(THREE_DIRECTION_LINEAR), net).whole
    rows = [told.whole.stencil(i) for i in range(diagonally.n_points)]
    vertices, edges = ([r for r in rows if sixteenths(r) == kind] for kind in (VERTEX, EDGE))
    vertex, edge = vertices[0], edges[len(edges) // 2]

    yield with_diagram(show(told, linear, "The array of Figure 6: quadrupled, then averaged along (1,1).", look=LOOK,
                            formula=r"$V = \{(1,0),\ (0,1),\ (1,1)\} \times 2$",
                            notes="Every vector twice. Two are used up by quadrupling and one by Figure 6; three are "
                            "left. The order does not matter (Exercise 1b).",
                            claim=abs(told.upto(2).matrix - figure_6.matrix).max() == 0))
    yield with_diagram(play(told, along_s, "Average along (1,0).", look=LOOK,
                            formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i+1,j}}{2}$",
                            notes="Now points move: from here on it is geometry. The array loses a column.",
                            claim=along_s.moves and as_grid(along_s.topology).shape == (6, 7)))
    yield with_diagram(play(told, along_t, "Average along (0,1).", look=LOOK,
                            formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i,j+1}}{2}$",
                            notes="And a row.", claim=as_grid(along_t.topology).shape == (6, 6)))
    yield with_diagram(play(told, diagonally, "Average along (1,1) once more. Four averages in all: the quartic "
                            "surface.", look=LOOK, formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i+1,j+1}}{2}$",
                            predict=weight(vertex, vertex.terms[0][0], "One average is left. How much of itself will a "
                                           "vertex then have kept?", edge.terms[0][1]),
                            notes="A row and a column at once. As cheap as the biquadratic surface, and smoother: "
                            "Figure 10.",
                            claim=as_grid(diagonally.topology).shape == (5, 5) and len(told.stages) - 1 == 4))
    yield with_diagram(show(told, diagonally, "A vertex box: ten of its own point, one of each of its six neighbours.",
                            look=LOOK, stencil=vertex, span=5, formula=r"$\dfrac{10\,P_{11} + \sum_{k=1}^{6} N_k}{16}$",
                            notes="The neighbours lie along (1,0), (0,1), (1,1) and back: a hexagon in the net. The "
                            "dots in the box are the two corners that are not neighbours.",
                            claim=sixteenths(vertex) == VERTEX))
    yield with_diagram(show(told, diagonally, "An edge box: six of each end, two of each point across the edge.",
                            look=LOOK, stencil=edge, span=5, formula=r"$\dfrac{6\,(A + B) + 2\,(C + D)}{16}$",
                            notes="Horizontal, vertical and diagonal edges have the same four numbers. These two rows "
                            "become the stencils of section 4.2.",
                            claim=all(sixteenths(r) in (VERTEX, EDGE) for r in rows)))


def sixteenths(row: Stencil) -> list[int]:
    """The weights of a row over 16, the largest first."""
    return [int(16 * weight) for weight in row.weights]

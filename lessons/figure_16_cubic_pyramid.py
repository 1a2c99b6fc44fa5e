"""Figure 16. Lane-Riesenfeld for cubic curves: three averaging rows, and the stencils in the top one."""

from collections.abc import Iterator
from fractions import Fraction

from lessons.questions import weight
from lessons.script import Beat, lesson, play, show, with_diagram
from subdivision import shapes, trace
from subdivision.schemes import lane_riesenfeld


@lesson("Figure 16  Cubic curves, row by row", section="3.2 Quads: stencils")
def figure_16_cubic_pyramid() -> Iterator[Beat]:
    told = trace(lane_riesenfeld(3), shapes.polygon(4))
    split, first, second, third = told.stages
    edge, vertex = told.whole.stencil(2), told.whole.stencil(1)
    half, eighth = Fraction(1, 2), Fraction(1, 8)

    def rows(upto: int) -> set[tuple[object, ...]]:
        """The different rows after so many stages, each with its heaviest weight first."""
        step = told.upto(upto)
        return {tuple(w for _, w in step.stencil(i).terms) for i in range(told.stages[upto - 1].n_points)}

    yield with_diagram(show(told, split, "The cubic algorithm again: every point twice.",
                            formula=r"$U_{2i} = U_{2i+1} = P_i$",
                            notes="The question of this section: can all the rows be done in one go?",
                            claim=split.n_points == 8))
    yield with_diagram(play(told, first, "First average: the points, and the midpoints between them.",
                            formula=r"$\dfrac{P_i + P_{i+1}}{2}$", claim=rows(2) == {(1,), (half, half)},
                            notes="The boxes say what they hold times 1/2."))
    yield with_diagram(play(told, second, "Second average: three quarters and one quarter.",
                            formula=r"$\dfrac{3P_i + P_{i+1}}{4}$",
                            notes="Each box is the mean of the two it stands on; hover it to see them.",
                            claim=rows(3) == {(Fraction(3, 4), Fraction(1, 4))}))
    yield with_diagram(play(told, third, "Third average: only two kinds of boxes, in turn.",
                            formula=r"$\dfrac{4P_i + 4P_{i+1}}{8},\quad \dfrac{P_i + 6P_{i+1} + P_{i+2}}{8}$",
                            claim=rows(4) == {(half, half), (6 * eighth, eighth, eighth)},
                            predict=weight(vertex, 1, "The last average. How much of itself will a vertex keep?", half),
                            notes="Ask which of the two are the new points on edges, and which the old vertices."))
    yield with_diagram(show(told, third, "An edge point: half of each end.", stencil=edge, span=4,
                            formula=r"$Q_{i+1/2} = \dfrac{P_i + P_{i+1}}{2}$",
                            notes="Formula (3.1) of the lecture. The diagram shows which averages it went through.",
                            claim=[w for _, w in edge.terms] == [half, half]))
    yield with_diagram(show(told, third, "A vertex point: six eighths of its vertex, an eighth of each neighbour.",
                            stencil=vertex, span=4, formula=r"$Q_{i+1} = \dfrac{P_i + 6 P_{i+1} + P_{i+2}}{8}$",
                            notes="Formula (3.2) of the lecture. These two formulas give the new points at once, "
                            "without any row in between: they are the stencils of Figure 17.",
                            claim=dict(vertex.terms) == {0: eighth, 1: 6 * eighth, 2: eighth}))

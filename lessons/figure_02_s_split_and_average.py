"""Figure 2. Tensor products, first step: split and average a net in s."""

from collections.abc import Iterator

import numpy as np

from lessons.questions import which
from lessons.script import Beat, Look, at_rest, before_and_after, lesson, play, show, with_diagram
from subdivision import shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import lane_riesenfeld, tensor_product

LOOK = Look(azimuth=-78.0, elevation=56.0, zoom=0.88)


@lesson("Figure 2  Split and average in s", section="2.1 Split and average",
        ours="The figure is missing from the text; its content follows from what is said of Figures 3, 4 and 5.")
def figure_02_s_split_and_average() -> Iterator[Beat]:
    told = trace(tensor_product(1, 1), shapes.net(3, 3), telling="s, then t")
    split, average, *_ = told.stages
    grid, wider = as_grid(told.control.topology), as_grid(average.topology)
    curve = trace(lane_riesenfeld(1), shapes.polygon(3)).whole.matrix
    between = told.upto(2).stencil(int(wider.numbers[1, 1]))

    yield with_diagram(show(told, None, "A net of control points, three by three. Every row is a control polygon.",
                            look=LOOK, formula=r"$P_{ij}$",
                            notes="Say which way s and t run: i counts along s, to the right; j along t, upwards.",
                            claim=grid.shape == (3, 3)))
    yield with_diagram(play(told, split, "Split in s: every row writes its points twice. Nothing moves.", look=LOOK,
                            notes="This is the split of Figure 1, done to every row at once. Along t nothing happens.",
                            claim=not split.moves and as_grid(split.topology).shape == (6, 3)))
    yield before_and_after(play(told, average, "Average in s: neighbours along every row. Originals and midpoints.",
                                look=LOOK, formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i+1,j}}{2}$",
                                notes="Hover a box on the right: its two parents light up on the left.",
                                predict=which("Average neighbours in every row, once. Which net will it be?",
                                              *at_rest(told, (len(told.stages), ""), (0, ""), (2, ""))),
                                claim=wider.shape == (5, 3) and set(average.roles) == {0, 1}),
                           split, "(a) Split in s", "(b) Average in s")
    yield before_and_after(show(told, average, "One box: the midpoint of two neighbours in its row. Its two parents "
                                "are lit.", look=LOOK, formula=r"$\dfrac{P_{01} + P_{11}}{2}$", stencil=between, span=2,
                                notes="Every row of the array is a curve of degree 1, subdivided once: the rows do not "
                                "know of each other yet.",
                                claim=dict(between.terms) == {1: 1 / 2, 4: 1 / 2}
                                and (told.upto(2).matrix.toarray() == np.kron(curve.toarray(), np.eye(3))).all()),
                           split, "(a) Split in s", "(b) Average in s")

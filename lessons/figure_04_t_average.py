"""Figure 4. Tensor products, final step: average in t. Bilinear first; higher bidegree by more averages."""

from collections.abc import Iterator

import numpy as np

from lessons.questions import weight
from lessons.script import Beat, Look, before_and_after, lesson, play, show, with_diagram
from subdivision import Trace, shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import lane_riesenfeld, tensor_product
from subdivision.words import phrase

LOOK = Look(azimuth=-78.0, elevation=56.0, zoom=0.88)
TIMES = {1: "once", 2: "twice", 3: "three times"}
NAMES = {(1, 1): "bilinear", (2, 2): "biquadratic", (3, 3): "bicubic"}


@lesson("Figure 4  Average in t", section="2.1 Split and average", knobs={"m": range(1, 4), "n": range(1, 4)},
        ours="The lecture draws the bilinear case, m = n = 1, and says that more averages raise the bidegree.")
def figure_04_t_average(m: int = 1, n: int = 1) -> Iterator[Beat]:
    told = trace(tensor_product(m, n), shapes.net(max(3, m + 1), max(3, n + 1)), telling="s, then t")
    split_t, first, last = told.stages[m + 1], told.stages[m + 2], told.stages[-1]
    before, after = as_grid(split_t.topology), as_grid(last.topology)
    middle = told.whole.stencil(int(after.numbers[1, 1]))
    in_s = told.upto(m + 2).stencil(int(before.numbers[1, 1]))
    name = NAMES.get((m, n), phrase("bidegree ({m},{n})", m=m, n=n))
    panels = "averaged in s, split in t", "averaged in t"
    start = ("The array of Figure 3: split and averaged in s, then split in t." if m == 1 else
             phrase("Like Figure 3, but averaged {times} in s before the split in t.", times=TIMES[m]))

    yield with_diagram(show(told, split_t, start, look=LOOK,
                            notes="For Figure 3 itself both knobs stand at 1. Every average in s has made the array "
                            "one column narrower.",
                            claim=before.shape == (2 * old(told)[0] - m, 2 * old(told)[1])))
    yield before_and_after(play(told, first, phrase("Average {times} in the t-direction: now t is done as s was.",
                                                    times=TIMES[n]),
                                until=last, look=LOOK, formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i,j+1}}{2}$",
                                predict=weight(middle, middle.terms[0][0], "Average in t. How much of its nearest "
                                               "control point will a box in the middle hold?", in_s.terms[0][1]),
                                notes="Bilinear: originals, edge midpoints and face centroids; the surface keeps its "
                                "shape. The lecture's label is: average in the t-direction.",
                                claim=after.shape == (before.n_s, before.n_t - n)
                                and ((m, n) != (1, 1) or set(last.roles) == {0, 1, 2})),
                           split_t, *panels)
    yield before_and_after(show(told, last,
                                phrase("One box of the {name} surface, and where it comes from.", name=name), look=LOOK,
                                stencil=middle, span=len(told.stages), formula=FORMULAS.get((m, n), PRODUCT),
                                notes="Each weight is the product of a curve's weight in s and one in t. Hover other "
                                "boxes: for bilinear there are three kinds, for higher bidegree up to four.",
                                claim=is_product(told, m, n) and sum(middle.weights) == 1),
                           split_t, *panels)
    yield with_diagram(show(told, last, "More averages in s and in t make higher bidegree: turn m and n.", look=LOOK,
                            formula=r"$N \times M \rightarrow (2N-m) \times (2M-n)$", poster=True,
                            notes="The net here has just enough points for its bidegree; an array that is to grow "
                            "needs more points than the degree, each way.",
                            claim=after.shape == (2 * old(told)[0] - m, 2 * old(told)[1] - n)))


PRODUCT = r"$Q = \sum_{i,j} \, a_i \, b_j \, P_{ij}$"
FORMULAS = {(1, 1): r"$\dfrac{P_{00} + P_{10} + P_{01} + P_{11}}{4}$"}


def old(told: Trace) -> tuple[int, int]:
    """Rows and columns of the control net."""
    return as_grid(told.control.topology).shape


def is_product(told: Trace, m: int, n: int) -> bool:
    """Whether the matrix is the product of a curve's of degree ``m`` and one of degree ``n``."""
    in_s, in_t = (trace(lane_riesenfeld(degree), shapes.polygon(size)).whole.matrix.toarray()
                  for degree, size in zip((m, n), old(told), strict=True))
    return bool(abs(told.whole.matrix.toarray() - np.kron(in_s, in_t)).max() < 1e-12)

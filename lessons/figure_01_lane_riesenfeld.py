"""Figure 1. The Lane-Riesenfeld algorithm: a pyramid of averages over a row of doubled points."""

from collections.abc import Iterator
from math import comb

from lessons.script import Beat, beside, diagram_of, lesson, play, show
from subdivision import shapes, trace
from subdivision.schemes import lane_riesenfeld

DEGREE = 3


@lesson("Figure 1  Lane-Riesenfeld curves", section="2.1 Split and average")
def figure_01_lane_riesenfeld() -> Iterator[Beat]:
    told = trace(lane_riesenfeld(DEGREE), shapes.polygon(4))
    split, once, twice, thrice = told.stages
    vertex = told.whole.stencil(1)
    symbol = [comb(DEGREE + 1, k) / 2**DEGREE for k in range(DEGREE + 2)]

    def with_pyramid(beat: Beat) -> Beat:
        return beside(beat, diagram_of(beat))

    yield with_pyramid(show(told, None, "A control polygon: four points in a row.",
                            claim=told.control.topology.n_vertices == 4))
    yield with_pyramid(play(told, split, "Split: write every point twice. Nothing moves.",
                            formula=r"$U_{2i} = U_{2i+1} = P_i$", claim=not split.moves and split.n_points == 8))
    yield with_pyramid(play(told, once, "Average neighbours once: the originals and the midpoints. Same shape.",
                            formula=r"$U_k \leftarrow \dfrac{U_k + U_{k+1}}{2}$",
                            notes="One averaging row is degree 1, the case the lecture draws.",
                            claim=sorted(set(once.roles)) == [0, 1]))
    yield with_pyramid(play(told, twice, "Average again: corners are cut. This is the quadratic curve.",
                            formula=r"$U_k \leftarrow \dfrac{U_k + U_{k+1}}{2}$",
                            claim=sorted(map(float, told.upto(3).stencil(0).weights)) == [1 / 4, 3 / 4]))
    yield with_pyramid(play(told, thrice, "And again: the cubic curve. Every average makes the row one shorter.",
                            formula=r"$N \rightarrow 2N - n$",
                            claim=thrice.n_points == 2 * 4 - DEGREE))
    yield with_pyramid(show(told, thrice, "Read one box: a vertex keeps 6/8 of itself and takes 1/8 of each neighbour.",
                            formula=r"$\dfrac{P_0 + 6 P_1 + P_2}{8}$", stencil=vertex, span=4,
                            claim=list(vertex.weights) == [symbol[2], symbol[0], symbol[4]]))

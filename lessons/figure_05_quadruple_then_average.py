"""Figure 5. Tensor products the other way: write every point four times, then average."""

from collections.abc import Iterator

from lessons.script import Beat, Look, beside, diagram_of, lesson, play, show
from subdivision import shapes, trace
from subdivision.schemes import tensor_product

LOOK = Look(azimuth=-40.0, elevation=45.0)


@lesson("Figure 5  Quadruple, average", section="2.1 Split and average")
def figure_05_quadruple_then_average() -> Iterator[Beat]:
    net = shapes.net(3, 3)
    told = trace(tensor_product(1, 1), net, telling="quadruple, then average")
    quadruple, along_s, along_t = told.stages
    other_way = trace(tensor_product(1, 1), net, telling="s, then t")
    same_as_figure_3 = abs(told.upto(2).matrix - other_way.upto(3).matrix).max() == 0
    centre = told.whole.stencil(6)

    def with_array(beat: Beat) -> Beat:
        return beside(beat, diagram_of(beat))

    yield with_array(show(told, None, "A net of control points, three by three.", look=LOOK,
                          claim=told.control.topology.n_vertices == 9))
    yield with_array(play(told, quadruple, "(a) Split: write every point four times. Nothing moves.", look=LOOK,
                          formula=r"$U_{2i+a,\,2j+b} = P_{ij},\quad a, b \in \{0, 1\}$",
                          claim=quadruple.n_points == 4 * 9 and not quadruple.moves))
    yield with_array(play(told, along_s, "(b) Average along s: the array of Figure 3, by another way.", look=LOOK,
                          formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i+1,j}}{2}$",
                          notes="Figure 3 splits in s, averages in s, splits in t; that split and this "
                          "average may be swapped.",
                          claim=same_as_figure_3))
    yield with_array(play(told, along_t, "Average along t: originals, edge midpoints and face centroids. "
                          "The bilinear surface.", look=LOOK,
                          formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i,j+1}}{2}$",
                          claim=sorted(set(along_t.roles)) == [0, 1, 2]))
    yield with_array(show(told, along_t, "A face point is the mean of its four corners.", look=LOOK,
                          stencil=centre, span=3, formula=r"$\dfrac{P_{00} + P_{10} + P_{01} + P_{11}}{4}$",
                          claim=set(centre.weights) == {1 / 4} and len(centre.terms) == 4))

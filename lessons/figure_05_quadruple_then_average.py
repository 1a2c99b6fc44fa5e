"""Figure 5. Tensor products the other way: write every point four times, then average."""

from collections.abc import Iterator

from lessons.script import Beat, Kind, Look, View, before_and_after, lesson, play, show, side_by_side, with_diagram
from subdivision import shapes, trace
from subdivision.schemes import tensor_product

LOOK = Look(azimuth=-78.0, elevation=56.0, zoom=0.88)
PANELS = "(a) Split", "(b) Average"


@lesson("Figure 5  Quadruple, average", section="2.1 Split and average")
def figure_05_quadruple_then_average() -> Iterator[Beat]:
    net = shapes.net(3, 3)
    told = trace(tensor_product(1, 1), net, telling="quadruple, then average")
    quadruple, along_s, along_t = told.stages
    other_way = trace(tensor_product(1, 1), net, telling="s, then t")
    centre = told.whole.stencil(6)

    yield with_diagram(show(told, None, "A net of control points, three by three.", look=LOOK,
                            notes="The same net as in Figures 2 to 4; this is the other way to get there.",
                            claim=told.control.topology.n_vertices == 9))
    yield with_diagram(play(told, quadruple, "(a) Split: write every point four times. Nothing moves.", look=LOOK,
                            formula=r"$U_{2i+a,\,2j+b} = P_{ij},\quad a, b \in \{0, 1\}$",
                            notes="Both splits at once. Box splines begin with this step whatever their vectors are.",
                            claim=quadruple.n_points == 4 * 9 and not quadruple.moves))
    yield before_and_after(play(told, along_s, "(b) Average along s: the array of Figure 3, by another way.",
                                look=LOOK, formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i+1,j}}{2}$",
                                notes="Figure 3 splits in s, averages in s, splits in t; that split and this "
                                "average may be swapped.",
                                claim=abs(told.upto(2).matrix - other_way.upto(3).matrix).max() == 0),
                           quadruple, *PANELS)
    yield side_by_side("Box for box the same: averages in s and splits in t do not disturb each other.",
                       View(told, 2, 2, Kind.DIAGRAM, "Figure 5 (b)"), View(other_way, 3, 3, Kind.DIAGRAM, "Figure 3"),
                       notes="Ask for the reason: the split copies rows, the average works inside a row.",
                       claim=all(told.upto(2).stencil(i) == other_way.upto(3).stencil(i) for i in range(30)))
    yield with_diagram(play(told, along_t, "Average along t: originals, edge midpoints and face centroids. "
                            "The bilinear surface.", look=LOOK,
                            formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i,j+1}}{2}$",
                            notes="Not in the figure: with this average Figure 4 is reached, too.",
                            claim=sorted(set(along_t.roles)) == [0, 1, 2]
                            and abs(told.whole.matrix - other_way.whole.matrix).max() == 0))
    yield with_diagram(show(told, along_t, "A face point is the mean of its four corners.", look=LOOK,
                            stencil=centre, span=3, formula=r"$\dfrac{P_{00} + P_{10} + P_{01} + P_{11}}{4}$",
                            notes="Hover other boxes: the originals have one control point, edge points two.",
                            claim=set(centre.weights) == {1 / 4} and len(centre.terms) == 4))

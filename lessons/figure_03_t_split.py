"""Figure 3. Tensor products, second step: split the array of Figure 2 in t."""

from collections.abc import Iterator

from lessons.script import Beat, Kind, Look, View, beside, lesson, play, show, side_by_side, with_diagram
from subdivision import shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import tensor_product

LOOK = Look(azimuth=-78.0, elevation=56.0, zoom=0.88)


@lesson("Figure 3  Split in t", section="2.1 Split and average",
        ours="The figure is missing from the text; the lecture says that Figure 5 (b) equals it.")
def figure_03_t_split() -> Iterator[Beat]:
    net = shapes.net(3, 3)
    told = trace(tensor_product(1, 1), net, telling="s, then t")
    other = trace(tensor_product(1, 1), net, telling="quadruple, then average")
    _, average_s, split_t, _ = told.stages
    array = as_grid(split_t.topology)
    source = split_t.carries.reshape(array.shape)

    yield with_diagram(show(told, average_s, "The array of Figure 2: a net, split and averaged in s.", look=LOOK,
                            notes="Five columns now, and still three rows: s is done, t is as it was.",
                            claim=as_grid(average_s.topology).shape == (5, 3)))
    yield with_diagram(play(told, split_t, "Split in t: every row is written twice. Nothing moves.", look=LOOK,
                            notes="In space there is nothing to see: pairs of points lie on top of each other. The "
                            "diagram shows them apart. Ask what the next average will do to such a pair.",
                            claim=not split_t.moves and (source[:, ::2] == source[:, 1::2]).all()))
    yield beside(show(told, split_t, "Row by row: each one of Figure 2, twice. Three rows become six.", look=LOOK,
                      notes="A point and its copy are made of the same control points with the same weights.",
                      claim=array.shape == (5, 6)),
                 View(told, 2, 2, Kind.DIAGRAM, "Figure 2"),
                 View(told, 3, 3, Kind.DIAGRAM, "Figure 3", told.upto(3).stencil(int(array.numbers[1, 2])), 3))
    yield side_by_side("Figure 5 gets the same array another way: quadruple, then average in s.",
                       View(told, 3, 3, Kind.DIAGRAM, "split, average, split"),
                       View(other, 2, 2, Kind.DIAGRAM, "quadruple, average"),
                       notes="The split in t copies rows, the average in s works inside a row: they may be swapped.",
                       claim=abs(told.upto(3).matrix - other.upto(2).matrix).max() == 0)

"""Figure 9. The three-direction quartic box spline surface: the control net and five levels."""

from collections.abc import Iterator

from lessons.script import Beat, Look, lesson, levels, play, show, side_by_side
from subdivision import continuity, shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import box_spline

LOOK = Look(azimuth=-55.0, elevation=38.0)
PASSES = ((1, 1), (1, 0), (0, 1), (1, 1), (1, 0), (0, 1))
"""Each vector twice, in the order that passes Figure 8 on the way."""


@lesson("Figure 9  Quartic box spline", section="2.2 Box spline surfaces",
        ours="The control net: the lecture does not give its points.")
def figure_09_quartic_surface() -> Iterator[Beat]:
    net = shapes.landscape(diagonal=True)
    told = trace(box_spline(PASSES), net)
    quadruple, diagonally, along_s, along_t, last = told.stages
    deep = trace(box_spline(PASSES), net, "stencils", levels=5)
    _, second, third, fourth, fifth = deep.stages
    sizes = [as_grid(deep.topology_at(level)).n_s for level in range(6)]

    yield show(told, None, "The net of Figure 8, and every vector twice: four averages instead of one.", look=LOOK,
               formula=r"$V = \{(1,0),\ (0,1),\ (1,1)\} \times 2$",
               claim=len(told.stages) - 1 == 4 and all(PASSES.count(v) == 2 for v in PASSES))
    yield play(told, quadruple, "Split: write every point four times.", look=LOOK, claim=not quadruple.moves)
    yield play(told, diagonally, "Average along (1,1). So far this is the linear surface.", look=LOOK,
               claim=diagonally.n_points == net.topology.n_vertices + net.topology.n_edges)
    yield play(told, along_s, "Now average along (1,0), (0,1) and (1,1): points move and creases go.", until=last,
               look=LOOK, notes="Watch the rim: each average shortens the array. Six by six points become nine by "
               "nine.",
               claim=along_s.moves and along_t.moves and as_grid(last.topology).shape == (9, 9))
    yield play(deep, second, "Level 2, all five stages at once: nine by nine points become fifteen by fifteen.",
               look=LOOK, formula=r"$N \rightarrow 2N - 3$", claim=sizes[1:3] == [9, 15])
    yield play(deep, third, "Levels 3, 4 and 5: soon the eye sees no net, only a surface.", until=fifth, look=LOOK,
               notes="From here on the picture thins its net out; at level 5 it draws the surface alone.",
               claim=fourth.moves and sizes == [6, 9, 15, 27, 51, 99])
    yield side_by_side("The net and levels 1 to 5. The limit is piecewise quartic and C².", *levels(deep, *range(6)),
                       look=LOOK,
                       notes="Six vectors: degree 4. One must leave out four until the rest are parallel, so alpha is "
                       "4 and the continuity alpha - 2 is 2. Ask from which level on the pictures look the same.",
                       claim=(continuity.degree(PASSES), continuity.smoothness(PASSES)) == (4, 2))

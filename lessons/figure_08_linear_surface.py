"""Figure 8. The three-direction piecewise linear box spline surface: the control net, level 1, level 2."""

from collections.abc import Iterator

import numpy as np

from lessons.script import Beat, Look, lesson, levels, play, show, side_by_side
from subdivision import continuity, shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import THREE_DIRECTION_LINEAR, box_spline

LOOK = Look(azimuth=-55.0, elevation=38.0)


@lesson("Figure 8  Linear box spline", section="2.2 Box spline surfaces",
        ours="The control net: the lecture does not give its points.")
def figure_08_linear_surface() -> Iterator[Beat]:
    net = shapes.landscape(diagonal=True)
    told = trace(box_spline(THREE_DIRECTION_LINEAR), net, levels=2)
    quadruple, along, again, along_again = told.stages
    kept = told.points[4].reshape(21, 21, 3)[::4, ::4].reshape(-1, 3)

    yield show(told, None, "A net of control points, six by six. The vector (1,1) cuts its squares into triangles.",
               look=LOOK, notes="Ask for a guess: three vectors, one average. How smooth can this get?",
               claim=as_grid(net.topology).shape == (6, 6) and net.topology.n_faces == 50)
    yield play(told, quadruple, "Split: write every point four times. Nothing moves.", look=LOOK,
               formula=r"$U_{2i+a,\,2j+b} = P_{ij}$", notes="This uses up (1,0) and (0,1).",
               claim=quadruple.n_points == 4 * 36 and not quadruple.moves)
    yield play(told, along, "Average along (1,1): the {original} points stay, an {edge} one appears on every edge.",
               look=LOOK, formula=r"$U_{ij} \leftarrow \dfrac{U_{ij} + U_{i+1,j+1}}{2}$",
               notes="Originals, and midpoints of horizontal, vertical and diagonal edges: Figure 6 in space.",
               claim=along.n_points == net.topology.n_vertices + net.topology.n_edges and set(along.roles) == {0, 1})
    yield play(told, again, "Level 2, the same again: every triangle becomes four. The surface stays where it is.",
               until=along_again, look=LOOK,
               claim=along_again.topology.n_faces == 16 * 50 and np.allclose(kept, net.points))
    yield side_by_side("Net, level 1, level 2: more triangles, the same creases. Piecewise linear, and no more than "
                       "continuous.", *levels(told, 0, 1, 2), look=LOOK,
                       formula=r"$V = \{(1,0),\ (0,1),\ (1,1)\}$",
                       notes="Three vectors: degree 1. Leave any two out and the rest is one vector, so alpha is 2 and "
                       "the continuity alpha - 2 is 0.",
                       claim=(continuity.degree(THREE_DIRECTION_LINEAR), continuity.alpha(THREE_DIRECTION_LINEAR))
                       == (1, 2))

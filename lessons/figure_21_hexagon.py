"""Figure 21. The stencil that moves the points of the linear box spline to those of the quartic: a hexagon."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from lessons.measured import without_helpers
from lessons.questions import weight
from lessons.script import FLAT, Beat, Kind, Look, View, beside, fragment, lesson, play, show, side_by_side
from subdivision import Grid, Mesh, Stencil, Step, shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import THREE_DIRECTION_LINEAR, TRIANGLE_CENTROID, box_spline

LOOK = Look(azimuth=-68.0, elevation=50.0)
QUARTIC = ((1, 1), (1, 0), (0, 1), *THREE_DIRECTION_LINEAR)
WEIGHTS = ["1/4"] + ["1/8"] * 6


@lesson("Figure 21  The hexagon stencil", section="4.1 Triangles: averaging",
        ours="The figure is missing; the sentence that introduces it breaks off. The weights follow from the text.")
def figure_21_hexagon() -> Iterator[Beat]:
    star = without_helpers(trace(TRIANGLE_CENTROID, shapes.triangle_star(6)))
    told = without_helpers(trace(TRIANGLE_CENTROID, fragment(shapes.triangle_fan(6, rings=2))))
    topology, geometry = told.stages
    inner = [v for v in range(topology.topology.n_vertices) if len(geometry.stencil(v).terms) == 7]
    midpoint = next(v for v in inner if v in topology.born)
    hexagon = View(star, 2, 2, Kind.STENCIL, stencil=star.stages[1].stencil(0))
    net = trace(box_spline(QUARTIC), _flat_net(5))
    averages = Step(net.stages[2:])
    grid = as_grid(averages.topology)
    middle = averages.stencil(int(grid.numbers[grid.n_s // 2, grid.n_t // 2]))

    yield beside(show(star, star.stages[0], "A hexagon on the refined mesh: two eighths of the point, one of each "
                      "neighbour.", formula=r"$\dfrac{2}{8} Q + \dfrac{1}{8} \sum N_i$", title="refined mesh",
                      predict=weight(star.stages[1].stencil(0), 0, "How much of itself does a point keep?"),
                      look=FLAT, poster=True,
                      notes="The six neighbours in this picture are points of the refined mesh: midpoints, not "
                            "original vertices.",
                      claim=_spelled(star.stages[1].stencil(0)) == WEIGHTS), replace(hexagon, title="stencil"))
    yield beside(show(told, None, "In use: six triangles of a larger mesh, and the ring about them.", look=LOOK,
                      claim=int((~told.control.surface.hidden).sum()) == 6), hexagon)
    yield beside(play(told, topology, "Topology: a midpoint on every edge. These are points of the linear box spline.",
                      look=LOOK, claim=not topology.moves), hexagon)
    yield beside(play(told, geometry, "Geometry: every point, old or new, moves by the same stencil.", look=LOOK,
                      stencil=geometry.stencil(0), formula=r"$Q \rightarrow \dfrac{2}{8} Q + \dfrac{1}{8} \sum N_i$",
                      claim=all(_spelled(geometry.stencil(v)) == WEIGHTS for v in inner)), hexagon)
    yield beside(show(told, geometry, "A midpoint too: it had six neighbours on the refined mesh.", look=LOOK,
                      stencil=geometry.stencil(midpoint),
                      claim=bool(topology.topology.valence[midpoint] == 6)), hexagon)
    yield side_by_side("On an array it is three averages: along s, along t, along (1,1). The same seven weights.",
                       replace(hexagon, title="on a mesh"),
                       View(net, 5, 5, Kind.STENCIL, "on an array", stencil=middle, span=3),
                       formula=r"$\dfrac{1+x}{2} \cdot \dfrac{1+y}{2} \cdot \dfrac{1+xy}{2}$",
                       claim=_spelled(middle) == WEIGHTS)


def _flat_net(n: int) -> Mesh:
    """A square array of n by n points in the plane, cut along (1,1)."""
    s, t = np.meshgrid(np.arange(float(n)), np.arange(float(n)), indexing="ij")
    return Mesh(Grid(n, n, diagonal=True), np.stack([s, t, 0 * s], axis=-1).reshape(-1, 3))


def _spelled(row: Stencil) -> list[str]:
    return [str(weight) for _, weight in row.terms]

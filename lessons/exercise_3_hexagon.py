"""Exercise 3. Three averages, one hexagon, weighted centroids: the same geometry of the quartic."""

from collections import Counter
from collections.abc import Iterator
from fractions import Fraction

from lessons.measured import gap
from lessons.questions import weight
from lessons.script import Beat, Kind, Look, View, beside, fragment, lesson, play, show, side_by_side
from subdivision import Mesh, Step, shapes, trace
from subdivision.measure import largest_gap
from subdivision.passes import as_grid
from subdivision.schemes import THREE_DIRECTION_LINEAR, TRIANGLE_CENTROID, box_spline

LOOK = Look(azimuth=-62.0, elevation=56.0)
QUARTIC = ((1, 1), (1, 0), (0, 1), *THREE_DIRECTION_LINEAR)
HEXAGON = Counter({"1/8": 6, "1/4": 1})


@lesson("Exercise 3  The hexagon", section="Exercises",
        ours="The lecture asks to lay the stencil over Figure 6; that this is an exercise is inferred.")
def exercise_3_hexagon() -> Iterator[Beat]:
    net = shapes.net(5, 5, diagonal=True)
    told = trace(box_spline(QUARTIC), net)
    quadruple, linear, along_s, along_t, diagonal = told.stages
    averages = Step((along_s, along_t, diagonal))
    grid = as_grid(averages.topology)
    row = averages.stencil(int(grid.numbers[grid.n_s // 2, grid.n_t // 2]))
    mesh = trace(TRIANGLE_CENTROID, fragment(Mesh(as_grid(net.topology).mesh(), net.points)))
    topology, centroids, geometry = mesh.stages
    vertex = int(as_grid(net.topology).numbers[2, 2])
    weighted = int(geometry.stencil(vertex).parents[0])
    around = Step((centroids, geometry)).stencil(vertex)

    yield show(told, None, "A net for the three directions s, t and (1,1).", look=LOOK,
               claim=as_grid(net.topology).diagonal and (1, 1) in THREE_DIRECTION_LINEAR)
    yield play(told, quadruple, "Quadruple, then average along (1,1): the midpoints of all edges. Linear so far.",
               until=linear, look=LOOK, claim=not linear.moves or sorted(set(linear.roles)) == [0, 1])
    yield play(told, along_s, "Then three averages: along s, along t, along (1,1). The quartic.", until=diagonal,
               look=LOOK, formula=r"$\dfrac{1+x}{2} \cdot \dfrac{1+y}{2} \cdot \dfrac{1+xy}{2}$",
               claim=[stage.name for stage in told.stages[2:]] == ["average s", "average t", "average (1,1)"])
    hexagon = show(told, diagonal, "All three at once: two eighths of the point itself, one of each neighbour.",
                   look=LOOK, stencil=row, span=3, poster=True,
                   predict=weight(row, row.terms[0][0], "All three at once: how much of itself does a point keep?"),
                   formula=r"$\dfrac{1 + x + y + 2xy + x^2y + xy^2 + x^2y^2}{8}$",
                   notes="Multiply the three factors out: eight terms, two of them equal. It is Figure 21.",
                   claim=Counter(str(weight) for _, weight in row.terms) == HEXAGON)
    yield beside(hexagon, View(told, 5, 5, Kind.STENCIL, "three averages", stencil=row, span=3))
    yield play(mesh, topology, "Now the same net as a mesh of triangles. Topology: the same midpoints.", look=LOOK,
               claim=not topology.moves
               and largest_gap(told.points[2], mesh.points[1]) < 1e-12)
    yield play(mesh, centroids, "Mark the weighted centroids, three in every triangle.", look=LOOK,
               stencil=centroids.stencil(weighted), formula=r"$C = \dfrac{2}{8} Q + \dfrac{3}{8} R + \dfrac{3}{8} S$",
               claim=sorted(map(str, dict(centroids.stencil(weighted).terms).values())) == ["1/4", "3/8", "3/8"])
    yield play(mesh, geometry, "Every neighbour lies in two of the six triangles: 2 times 3/8, a sixth of it, is 1/8.",
               look=LOOK, stencil=around, span=2,
               formula=r"$\dfrac{1}{6}\left(6 \cdot \dfrac{2}{8} Q + 2 \cdot \dfrac{3}{8} \sum N_i\right)$",
               claim=Counter(str(weight) for _, weight in around.terms) == HEXAGON
               and 2 * Fraction(3, 8) / 6 == Fraction(1, 8))
    yield side_by_side("Two stories, one hexagon.",
                       View(told, 5, 5, Kind.STENCIL, "three averages", stencil=row, span=3),
                       View(mesh, 3, 3, Kind.STENCIL, "weighted centroids", stencil=around, span=2),
                       claim=sorted(row.weights) == sorted(around.weights))
    yield show(mesh, geometry, "Lay the net of the averages over the mesh, in dashes. No point differs.", look=LOOK,
               over=View(told, 5, 5), reading=gap,
               claim=largest_gap(told.points[5], mesh.points[3]) < 1e-12)

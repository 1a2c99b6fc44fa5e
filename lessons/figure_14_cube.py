"""Figure 14. The cube as a quad mesh: eight extraordinary vertices, level by level."""

from collections.abc import Iterator

from lessons.measured import without_helpers
from lessons.questions import weight, where, which
from lessons.script import Beat, at_rest, lesson, levels, play, show, side_by_side
from subdivision import Topology, shapes, trace
from subdivision.schemes import CATMULL_CLARK, QUAD_CENTROID


@lesson("Figure 14  The cube", section="3.1 Quads: averaging",
        ours="The lecture shows the cube as a mesh; that it is then subdivided, and how far, is inferred.")
def figure_14_cube() -> Iterator[Beat]:
    cube = shapes.cube()
    told = trace(QUAD_CENTROID, cube, levels=2)
    topology, centroids, geometry, *later = told.stages
    deep = without_helpers(trace(QUAD_CENTROID, cube, levels=3))
    counts = [(t.n_vertices, t.n_edges, t.n_faces)
              for t in (deep.topology_at(2 * level) for level in range(4))]
    row, clark = (trace(rule, cube).whole.stencil(5) for rule in (QUAD_CENTROID, CATMULL_CLARK))  # the corner in front

    yield show(told, None, "A cube: six quads, and three of them at every vertex. Valence 3, not 4.",
               notes="The lecture's first mesh that no rectangular array can be. Here every vertex is extraordinary.",
               claim=set(cube.topology.valence) == {3})
    yield play(told, topology, "Topology: a point on every edge and every face. Six faces become 24; nothing moves.",
               predict=which("Each face becomes four. Which picture is it, before anything moves?",
                             *at_rest(told, (3, ""), (1, ""), (0, ""))),
               claim=not topology.moves and topology.topology.n_faces == 24)
    yield play(told, centroids, "Mark the centroid of every new face.",
               claim=len(centroids.born) == 24)
    yield play(told, geometry, "Geometry: every vertex moves to the centroid of the centroids around it.",
               formula=r"$Q \rightarrow \dfrac{1}{n} \sum_k C_k$", claim=geometry.moves,
               predict=where(5, "Three centroids lie around the corner in front. Where will it go?"))
    yield show(told, geometry, "Why is the corner here? It keeps 27/48 of itself, takes 6/48 of each neighbour "
               "and 1/48 across each face.", stencil=row, span=3,
               predict=weight(row, 5, "How much of itself does the corner keep?", clark.weight(5),
                              1 - 3 * row.weight(4)),
               formula=r"$\dfrac{9}{16} V + \dfrac{6}{16n} \sum E_i + \dfrac{1}{16n} \sum F_i$",
               notes="So the corner of a cube from -1 to 1 moves from 1 to 2/3.",
               claim=sorted(48 * row.weights) == [1, 1, 1, 6, 6, 6, 27])
    yield play(told, later[0], "Again: topology, centroids, geometry. New vertices always have valence 4.",
               until=later[2], claim=set(later[0].topology.valence[8:]) == {4})
    yield play(deep, deep.stages[4], "Level 3. The eight marked vertices are isolated, with ordinary ones all round.",
               until=deep.stages[5],
               notes="Between two of them there are now eight edges, and twice as many with every level.",
               claim=int(deep.mesh_at(6).surface.extraordinary.sum()) == 8
               and is_isolated(deep.mesh_at(6).surface))
    yield side_by_side("From 6 faces to 384. The limit is C², but at the eight marked vertices only C¹.",
                       *levels(deep, 0, 1, 2, 3),
                       notes="V, E, F: 8 12 6, then 26 48 24, 98 192 96, 386 768 384. Always V - E + F = 2.",
                       claim=counts == [(8, 12, 6), (26, 48, 24), (98, 192, 96), (386, 768, 384)])


def is_isolated(t: Topology) -> bool:
    """Whether no face has two extraordinary vertices."""
    return all(t.extraordinary[loop].sum() <= 1 for loop in t.loops())

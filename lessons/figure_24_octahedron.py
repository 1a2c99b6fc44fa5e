"""Figure 24. The octahedron as a triangle mesh: valence 4 at every vertex, level by level."""

from collections.abc import Iterator

from lessons.figure_14_cube import is_isolated
from lessons.measured import without_helpers
from lessons.questions import weight, where, which
from lessons.script import Beat, Look, lesson, levels, play, show, side_by_side
from subdivision import shapes, trace
from subdivision.schemes import LOOP, TRIANGLE_CENTROID

LOOK = Look(azimuth=-62.0, elevation=22.0)


@lesson("Figure 24  The octahedron", section="4.1 Triangles: averaging",
        ours="The lecture shows the octahedron as a mesh; that it is then subdivided, and how far, is inferred.")
def figure_24_octahedron() -> Iterator[Beat]:
    octahedron = shapes.octahedron()
    told = trace(TRIANGLE_CENTROID, octahedron)
    topology, centroids, geometry = told.stages
    deep = without_helpers(trace(TRIANGLE_CENTROID, octahedron, levels=3))
    counts = [(t.n_vertices, t.n_edges, t.n_faces)
              for t in (deep.topology_at(2 * level) for level in range(4))]
    row = told.whole.stencil(4)  # the pole above

    yield show(told, None, "An octahedron: four triangles at every vertex, not six.", look=LOOK,
               notes="All its vertices are extraordinary: no mesh of triangles with valence six closes up like a ball.",
               claim=set(octahedron.topology.valence) == {4})
    yield play(told, topology, "Topology: a point in the middle of every edge, and eight triangles become 32.",
               look=LOOK, formula=r"$E = \dfrac{A+B}{2}$",
               claim=topology.topology.n_faces == 32 and set(topology.topology.valence[6:]) == {6})
    yield play(told, centroids, "Mark the weighted centroids: one for every corner of every triangle.", look=LOOK,
               formula=r"$C = \dfrac{2}{8} Q + \dfrac{3}{8} R + \dfrac{3}{8} S$", claim=len(centroids.born) == 3 * 32)
    yield play(told, geometry, "Geometry: every vertex moves to the centroid of its own.", look=LOOK,
               formula=r"$Q \rightarrow \dfrac{1}{n} \sum_{k=1}^{n} C_k$", claim=geometry.moves,
               predict=where(4, "Where will the pole above go?"))
    yield show(told, geometry, "The pole keeps five eighths of itself; its four neighbours share three eighths.",
               look=LOOK, stencil=row, span=3, formula=r"$\dfrac{5}{8} V + \dfrac{3}{8n} \sum N_i$",
               predict=weight(row, 4, "How much of itself does the pole keep?", 1 - row.weight(4),
                              trace(LOOP, octahedron).whole.stencil(4).weight(4)),
               notes="So the pole at height 1 comes down to 5/8: the neighbours lie on the equator.",
               claim=str(row).startswith("5/8 v4 + 3/32") and abs(told.points[3][4][2] - 5 / 8) < 1e-12)
    yield play(deep, deep.stages[2], "Two more levels. New vertices have valence six, the six old ones keep four.",
               until=deep.stages[5], look=LOOK,
               predict=which("Two more levels. Which picture will it be?", *levels(deep, 2, 3, 1)),
               claim=set(deep.topology_at(6).valence[6:]) == {6} and set(deep.topology_at(6).valence[:6]) == {4}
               and is_isolated(deep.mesh_at(6).surface))
    yield side_by_side("From 8 triangles to 512. The limit is C², but at the six marked vertices only C¹.",
                       *levels(deep, 0, 1, 2, 3), look=LOOK,
                       notes="V, E, F: 6 12 8, then 18 48 32, 66 192 128, 258 768 512. The pole looks pointed: C¹, but "
                       "its curvature grows without bound.",
                       claim=counts == [(6, 12, 8), (18, 48, 32), (66, 192, 128), (258, 768, 512)])

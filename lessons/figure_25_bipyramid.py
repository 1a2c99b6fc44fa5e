"""Figure 25. A second triangle mesh that is not regular: a bipyramid, valence n at its poles and 4 on its ring."""

from collections.abc import Iterator

from lessons.figure_14_cube import is_isolated
from lessons.measured import without_helpers
from lessons.script import Beat, Look, lesson, levels, play, show, side_by_side
from subdivision import shapes, trace
from subdivision.schemes import TRIANGLE_CENTROID
from subdivision.words import phrase

LOOK = Look(azimuth=-70.0, elevation=26.0)


@lesson("Figure 25  A bipyramid", section="4.1 Triangles: averaging",
        ours="The mesh: the figure is missing from the text. The lecture promises a second mesh that is not regular.",
        knobs={"sides": range(5, 13)})
def figure_25_bipyramid(sides: int = 8) -> Iterator[Beat]:
    n = sides
    bipyramid = shapes.bipyramid(n)
    told = trace(TRIANGLE_CENTROID, bipyramid)
    topology, centroids, geometry = told.stages
    deep = without_helpers(trace(TRIANGLE_CENTROID, bipyramid, levels=3))
    counts = [(t.n_vertices, t.n_edges, t.n_faces)
              for t in (deep.topology_at(2 * level) for level in range(4))]
    special = (n + 2) - 2 * (n == 6)
    in_front = max(range(n), key=lambda v: bipyramid.points[v] @ (0.34, -0.94, 0.0))
    marks = ((n, f"n = {n}"), (in_front, "n = 4"))

    yield show(told, None, phrase("Two pyramids on {n} sides: valence {n} at the poles, valence four round the ring.",
                                  n=n),
               look=LOOK, marks=marks, notes="Six would be ordinary. Ask what a pole with many sides will look like.",
               claim=list(bipyramid.topology.valence) == [4] * n + [n, n])
    yield play(told, topology, "Topology: old valences stay; every new vertex has valence six.", look=LOOK, marks=marks,
               claim=list(topology.topology.valence) == [4] * n + [n, n] + [6] * (3 * n))
    yield play(told, centroids, "Mark the weighted centroids, one for every corner.", look=LOOK,
               claim=len(centroids.born) == 3 * topology.topology.n_faces)
    yield play(told, geometry, "Geometry: every vertex moves to the centroid of its own.", look=LOOK, marks=marks,
               formula=r"$Q \rightarrow \dfrac{1}{n} \sum_{k=1}^{n} C_k$", claim=geometry.moves)
    yield play(deep, deep.stages[2], phrase("Two more levels. {special} extraordinary vertices, each among ordinary "
                                            "ones.", special=special),
               until=deep.stages[5], look=LOOK,
               claim=int(deep.mesh_at(6).surface.extraordinary.sum()) == special
               and is_isolated(deep.mesh_at(6).surface))
    yield side_by_side(phrase("From {few} triangles to {many}. C² but at the marked vertices, and C¹ there.",
                              few=2 * n, many=128 * n),
                       *levels(deep, 0, 1, 2, 3), look=LOOK,
                       notes="The ring is pointed at valence four, the poles are flat where many triangles meet. At "
                       "valence three it would be worse: only C0 is guaranteed. See the tetrahedron.",
                       claim=all(v - e + f == 2 for v, e, f in counts)
                       and [f for _, _, f in counts] == [2 * n * 4**k for k in range(4)]
                       and (n != 8 or counts[:2] == [(10, 24, 16), (34, 96, 64)]))

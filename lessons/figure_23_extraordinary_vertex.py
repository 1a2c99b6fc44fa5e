"""Figure 23. One level of centroid averaging round an extraordinary vertex of a triangle mesh."""

from collections.abc import Iterator

from lessons.script import EXTRAORDINARY, Beat, Look, at_rest, fragment, lesson, play, show, side_by_side
from subdivision import Role, shapes, trace
from subdivision.schemes import TRIANGLE_CENTROID
from subdivision.words import phrase

LOOK = Look(azimuth=-70.0, elevation=58.0)
PANES = Look(azimuth=-70.0, elevation=58.0, zoom=0.88)


@lesson("Figure 23  Extraordinary vertex", section="4.1 Triangles: averaging",
        ours="The faint ring: the lecture draws the triangles round the vertex; their outer points need more faces.",
        colours={EXTRAORDINARY: "blue", Role.EDGE: "yellow", Role.CENTROID: "green", Role.MOVED: "black"},
        knobs={"valence": range(3, 13)})
def figure_23_extraordinary_vertex(valence: int = 8) -> Iterator[Beat]:
    n = valence
    told = trace(TRIANGLE_CENTROID, fragment(shapes.triangle_fan(n, rings=2)))
    topology, centroids, geometry = told.stages
    alone = trace(TRIANGLE_CENTROID, shapes.triangle_fan(n))
    before, after = ((t.n_vertices, t.n_edges, t.n_faces) for t in (alone.control.topology, alone.topology_at(3)))
    inside = ~told.mesh_at(1).surface.on_boundary
    row = told.whole.stencil(0)
    smooth = {3: phrase("at valence three only continuous"), 6: phrase("and C² here too")}.get(
        n, phrase("but only C¹ here"))
    marks = ((0, f"n = {n}"),)

    yield show(told, None, phrase("(a) An ordinary vertex: {n} triangles meet at it." if n == 6 else
                                  "(a) An extraordinary vertex: {n} triangles meet at it, not six.", n=n),
               look=LOOK, marks=marks,
               notes="The lecture draws the extraordinary vertex itself in blue; the switch for the "
               "caption's colours does too. The valence is a knob.",
               claim=told.control.topology.valence[0] == n and before == (n + 1, 2 * n, n))
    yield play(told, topology, "(b) New topology: a point on every edge, no face points. Each new one has valence six.",
               look=LOOK, marks=marks,
               notes="Each triangle becomes four. The lecture's text speaks of new face vertices here; triangles make "
               "none.",
               claim=after == (3 * n + 1, 7 * n, 4 * n) and not topology.moves and topology.topology.valence[0] == n
               and set(topology.topology.valence[topology.born][inside[topology.born]]) == {6})
    yield play(told, centroids, "Mark the {centroid} weighted centroids: three in every small triangle, one for each "
               "corner.", look=LOOK, formula=r"$C = \dfrac{2}{8} Q + \dfrac{3}{8} R + \dfrac{3}{8} S$",
               notes="Each leans away from its own corner. It cannot be used again for another vertex.",
               claim=len(centroids.born) == 3 * topology.topology.n_faces)
    yield play(told, geometry, phrase("(c) New geometry: the middle moves to the centroid of its own {n}, all others "
                                      "of six.", n=n),
               look=LOOK, formula=r"$Q \rightarrow \dfrac{1}{n} \sum_{k=1}^{n} C_k$",
               notes="The pale helpers show what every vertex is now amid.",
               claim=geometry.matrix[[0]].nnz == n and all(geometry.matrix[[v]].nnz == 6 for v in range(1, n + 1)))
    yield show(told, geometry, "In one formula: the vertex keeps five eighths, its neighbours share three.",
               look=LOOK, span=3, stencil=row, formula=r"$\dfrac{5}{8} V + \dfrac{3}{8n} \sum N_i$",
               claim=sorted(8 * n * row.weights) == [3.0] * n + [5.0 * n])
    yield side_by_side(phrase("One level. The limit is C² at ordinary points, {smooth}.", smooth=smooth),
                       *at_rest(told, (0, "(a) Ordinary vertex" if n == 6 else "(a) Extraordinary vertex"),
                                (1, "(b) New topology"), (3, "(c) New geometry")),
                       look=PANES, notes="Only continuity is guaranteed at valence three: try the tetrahedron.",
                       claim=geometry.topology.valence[0] == n)

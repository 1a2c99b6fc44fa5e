"""Figure 13. One level of centroid averaging round an extraordinary vertex of a quad mesh."""

from collections.abc import Iterator

from lessons.questions import weight, where
from lessons.script import Beat, Look, at_rest, fragment, lesson, play, show, side_by_side
from subdivision import Role, shapes, trace
from subdivision.schemes import CATMULL_CLARK, QUAD_CENTROID
from subdivision.words import phrase

LOOK = Look(azimuth=-70.0, elevation=58.0)
PANES = Look(azimuth=-70.0, elevation=58.0, zoom=0.88)


@lesson("Figure 13  Extraordinary vertex", section="3.1 Quads: averaging",
        ours="The faint ring: the lecture draws the quads round the vertex, but their outer points need more faces.",
        colours={Role.EDGE: "yellow", Role.FACE: "green", Role.CENTROID: "blue", Role.MOVED: "black"},
        knobs={"valence": range(3, 13)})
def figure_13_extraordinary_vertex(valence: int = 6) -> Iterator[Beat]:
    n = valence
    told = trace(QUAD_CENTROID, fragment(shapes.quad_fan(n, rings=2)))
    topology, centroids, geometry = told.stages
    alone = trace(QUAD_CENTROID, shapes.quad_fan(n))
    before, after = ((t.n_vertices, t.n_edges, t.n_faces) for t in (alone.control.topology, alone.topology_at(3)))
    inside = ~told.mesh_at(1).surface.on_boundary
    row = told.whole.stencil(0)
    marks = ((0, f"n = {n}"),)

    yield show(told, None, phrase("(a) An ordinary vertex: {n} quads meet at it." if n == 4 else
                                  "(a) An extraordinary vertex: {n} quads meet at it, not four.", n=n),
               look=LOOK, marks=marks,
               notes="The valence is a knob: turn it to 4 and everything below is the bicubic case.",
               claim=told.control.topology.valence[0] == n and before == (2 * n + 1, 3 * n, n))
    yield play(told, topology, "(b) New topology: a point on every edge and every face. Each new one has valence four.",
               look=LOOK, marks=marks,
               notes="An edge point lies between two faces, a face point joins the midpoints of its four edges. Old "
               "valences do not change, so no new extraordinary vertex can appear.",
               claim=after == (6 * n + 1, 10 * n, 4 * n) and not topology.moves and topology.topology.valence[0] == n
               and set(topology.topology.valence[topology.born][inside[topology.born]]) == {4})
    yield play(told, centroids, "Mark the centroid of every small face: the {centroid} helpers, not vertices.",
               look=LOOK, claim=len(centroids.born) == topology.topology.n_faces)
    yield play(told, geometry, phrase("(c) New geometry: the middle moves to the centroid of {n} helpers, all others "
                                      "of four.", n=n), look=LOOK,
               formula=r"$Q \rightarrow \dfrac{1}{n} \sum_{k=1}^{n} C_k$",
               predict=where(0, "Where will the vertex in the middle go?"),
               notes="The pale helpers show what every vertex is now amid. The lecture does not colour the last "
               "position.",
               claim=geometry.matrix[[0]].nnz == n and all(geometry.matrix[[v]].nnz == 4 for v in topology.born[:n]))
    yield show(told, geometry, "In one formula: the vertex keeps 9/16, its neighbours share 6/16, the corners across "
               "1/16.", look=LOOK, span=3, stencil=row,
               formula=r"$\dfrac{9}{16} V + \dfrac{6}{16n} \sum E_i + \dfrac{1}{16n} \sum F_i$",
               predict=weight(row, 0, "How much of itself does the vertex in the middle keep?",
                              trace(CATMULL_CLARK, told.control).whole.stencil(0).weight(0)),
               notes="This is the simple vertex stencil of Figure 20.",
               claim=sorted(16 * n * row.weights) == [1.0] * n + [6.0] * n + [9.0 * n])
    yield side_by_side("One level: the vertex is extraordinary as before, and farther from any other." if n != 4 else
                       "One level: valence four everywhere, so this is the bicubic case.",
                       *at_rest(told, (0, "(a) Ordinary vertex" if n == 4 else "(a) Extraordinary vertex"),
                                (1, "(b) New topology"), (3, "(c) New geometry")),
                       look=PANES, claim=geometry.topology.valence[0] == n)

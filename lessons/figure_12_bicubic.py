"""Figure 12. One level for bicubic B-spline surfaces, seen on one face and its surroundings."""

from collections.abc import Iterator

import numpy as np

from lessons.questions import weight, where
from lessons.script import Beat, Look, at_rest, fragment, lesson, play, show, side_by_side
from subdivision import Role, shapes, trace
from subdivision.schemes import QUAD_CENTROID, lane_riesenfeld, tensor_product

LOOK = Look(azimuth=-65.0, elevation=60.0)
PANES = Look(azimuth=-65.0, elevation=60.0, zoom=0.88)
"""Far enough to see all that a stencil reads."""


@lesson("Figure 12  Bicubic surfaces", section="3.1 Quads: averaging",
        ours="The faint ring: the lecture draws one face, but all its nine points need the faces around it.",
        colours={Role.EDGE: "yellow", Role.FACE: "yellow", Role.CENTROID: "green", Role.MOVED: "blue"})
def figure_12_bicubic() -> Iterator[Beat]:
    told = trace(QUAD_CENTROID, fragment(shapes.face_and_ring()))
    topology, centroids, geometry = told.stages
    array = trace(tensor_product(3, 3), shapes.net(4, 4)).whole
    inside = array.topology.n_vertices
    by_array = [array.stencil(i).weights.tolist() for i in range(inside)]
    by_faces = [told.whole.stencil(int(i)).weights.tolist()
                for i in np.flatnonzero(~told.mesh_at(3).surface.on_boundary)]
    edge_point = topology.topology.origin[1]  # the first face's first edge
    vertex, curve = 0, trace(lane_riesenfeld(3), shapes.polygon(4)).whole.stencil(1)

    yield show(told, None, "(a) Original control points: one face of a larger net.", look=LOOK,
               claim=told.control.topology.n_vertices == 16)
    yield play(told, topology, "(b) New topology: a point on every edge and one on the face. The shape stays.",
               look=LOOK, formula=r"$E = \dfrac{A+B}{2},\quad F = \dfrac{A+B+C+D}{4}$",
               claim=not topology.moves and len(topology.born) == 24 + 9)
    yield play(told, centroids, "Mark the centroid of every small face: the {centroid} helpers, not vertices.",
               look=LOOK, claim=len(centroids.born) == topology.topology.n_faces)
    yield play(told, geometry, "(c) New geometry: every vertex moves to the centroid of the centroids around it.",
               look=LOOK, formula=r"$Q \rightarrow \dfrac{1}{n} \sum_k C_k$",
               predict=where(2, "Every vertex goes amid the four centroids around it. Where will this one be?"),
               notes="All centroids come from the mesh before it moves, and all vertices move together.",
               claim=geometry.moves and inside == 25)
    yield show(told, geometry, "A vertex reads nine points: 36, 6 and 1 sixty-fourths.", look=LOOK, span=3,
               stencil=told.whole.stencil(vertex), formula=r"$\dfrac{36\,V + 6 \sum E_i + \sum F_i}{64}$",
               predict=weight(told.whole.stencil(vertex), vertex, "How much of itself does the vertex keep?",
                              told.whole.stencil(edge_point).terms[0][1], curve.weight(1)),
               claim=sorted(64 * told.whole.stencil(vertex).weights) == [1, 1, 1, 1, 6, 6, 6, 6, 36])
    yield show(told, geometry, "An edge point reads six: 6 and 1 sixteenths.", look=LOOK, span=3,
               stencil=told.whole.stencil(edge_point), formula=r"$\dfrac{6\,(A+B) + C + D + E + F}{16}$",
               claim=sorted(16 * told.whole.stencil(edge_point).weights) == [1, 1, 1, 1, 6, 6])
    yield side_by_side("Topology keeps the shape, geometry smooths it: together they are one level of the bicubic "
                       "surface.", *at_rest(told, (0, "(a) Original control points"), (1, "(b) New topology"),
                                            (3, "(c) New geometry")), look=PANES,
                       notes="Two rounds of centroids are the two averages a cubic needs beyond the bilinear surface: "
                       "Figure 18.",
                       claim=sorted(sorted(row) for row in by_array) == sorted(sorted(row) for row in by_faces))

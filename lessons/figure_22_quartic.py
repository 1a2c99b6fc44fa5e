"""Figure 22. One level for the three-direction quartic, seen on two triangles and their surroundings."""

from collections.abc import Iterator

import numpy as np

from lessons.questions import weight, where
from lessons.script import Beat, Look, at_rest, fragment, lesson, play, show, side_by_side
from subdivision import Role, shapes, trace
from subdivision.schemes import TRIANGLE_CENTROID

LOOK = Look(azimuth=-62.0, elevation=58.0)
PANES = Look(azimuth=-62.0, elevation=58.0, zoom=0.88)
"""Far enough to see all that a stencil reads."""


@lesson("Figure 22  Quartic surfaces", section="4.1 Triangles: averaging",
        ours="The faint ring: the lecture draws two faces, but all their nine points need the faces around them.",
        colours={Role.EDGE: "yellow", Role.CENTROID: "green", Role.MOVED: "blue"})
def figure_22_quartic() -> Iterator[Beat]:
    told = trace(TRIANGLE_CENTROID, fragment(shapes.two_triangles_and_ring()))
    topology, centroids, geometry = told.stages
    control = told.control.surface
    vertex = next(v for v in range(control.n_vertices) if not control.on_boundary[v])
    edge_point = next(int(v) for v in topology.born if len(told.whole.stencil(int(v)).terms) == 4)

    yield show(told, None, "(a) Original control points: two triangles that share an edge.", look=LOOK,
               claim=int((~control.hidden).sum()) == 2)
    yield play(told, topology, "(b) New topology: a point in the middle of every edge. No face points; each triangle "
               "becomes four.", look=LOOK, formula=r"$E = \dfrac{A+B}{2}$",
               claim=not topology.moves and topology.topology.n_faces == 4 * control.n_faces)
    yield play(told, centroids, "Mark the weighted centroids: three in every small triangle, one for each corner.",
               look=LOOK, formula=r"$C = \dfrac{2}{8} Q + \dfrac{3}{8} R + \dfrac{3}{8} S$",
               notes="A weighted centroid belongs to one triangle and one of its corners; no other vertex may use it.",
               claim=len(centroids.born) == 3 * topology.topology.n_faces)
    yield play(told, geometry, "(c) New geometry: every vertex moves to the centroid of its own weighted centroids.",
               look=LOOK, formula=r"$Q \rightarrow \dfrac{1}{n} \sum_k C_k$", claim=geometry.moves,
               predict=where(vertex, "Every vertex moves to the centroid of its own six. Where will this one go?"))
    yield show(told, geometry, "A new edge point takes three eighths of each end, one eighth of each opposite corner.",
               look=LOOK, span=3, stencil=told.whole.stencil(edge_point), formula=r"$\dfrac{3\,(A+B) + C + D}{8}$",
               claim=sorted(8 * told.whole.stencil(edge_point).weights) == [1, 1, 3, 3])
    yield show(told, geometry, "A vertex keeps ten sixteenths and takes one of each neighbour.", look=LOOK, span=3,
               stencil=told.whole.stencil(vertex), formula=r"$\dfrac{10\,V + \sum N_i}{16}$",
               predict=weight(told.whole.stencil(vertex), vertex, "How much of itself does the vertex keep?",
                              told.whole.stencil(edge_point).terms[0][1]),
               claim=sorted(16 * told.whole.stencil(vertex).weights) == [1, 1, 1, 1, 1, 1, 10])
    yield side_by_side("Topology keeps the shape, geometry smooths it: together they are one level of the quartic "
                       "surface.", *at_rest(told, (0, "(a) Original control points"), (1, "(b) New topology"),
                                            (3, "(c) New geometry")), look=PANES,
                       notes="The lecture asks the reader to lay Figure 21's stencil over Figure 6's points; the "
                       "result is Figure 7.",
                       claim=all(sorted(16 * told.whole.stencil(int(v)).weights) in ([1] * 6 + [10], [2, 2, 6, 6])
                                 for v in np.flatnonzero(~told.mesh_at(3).surface.on_boundary)))

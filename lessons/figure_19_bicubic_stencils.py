"""Figure 19. Stencils for bicubic surfaces: face points, edge points, vertex points."""

from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from lessons.questions import weight
from lessons.script import Beat, Look, beside, fragment, lesson, play, show, side_by_side, stencil_of
from subdivision import Stencil, shapes, trace
from subdivision.schemes import QUAD_CENTROID, lane_riesenfeld, tensor_product
from subdivision.words import phrase

LOOK = Look(azimuth=-68.0, elevation=50.0)


@lesson("Figure 19  Bicubic stencils", section="3.2 Quads: stencils",
        ours="The figure is missing from the text; it says only that (c) is the vertex stencil.")
def figure_19_bicubic_stencils() -> Iterator[Beat]:
    star = trace(QUAD_CENTROID, shapes.quad_star(4))
    spoke = np.flatnonzero((star.control.topology.ends == 0).any(axis=1))[0]
    points = {"face": 9, "edge": 13 + int(spoke), "vertex": 0}
    face, edge, vertex = (stencil_of(star, p, phrase("({x}) {name} stencil", x=x, name=name))
                          for x, (name, p) in zip("abc", points.items(), strict=True))
    edge_row, vertex_row = (star.whole.stencil(points[name]) for name in ("edge", "vertex"))
    curve = trace(lane_riesenfeld(3), shapes.polygon(4)).whole.stencil(1)
    told = trace(QUAD_CENTROID, fragment(shapes.quad_fan(4, rings=2)), "stencils")
    faces, edges, vertices, connect = told.stages
    V, F = told.control.surface.n_vertices, told.control.surface.n_faces
    spoke = np.flatnonzero((told.control.topology.ends == 0).any(axis=1))[0]
    array = trace(tensor_product(3, 3), shapes.net(4, 4)).whole

    yield side_by_side("Bicubic surfaces need three stencils: for face points, edge points and vertex points.",
                       face, edge, vertex, poster=True,
                       predict=weight(vertex_row, 0, "Face, edge and vertex. How much of itself does a vertex keep?",
                                      *(row.terms[0][1] for row in (edge_row, curve))),
                       notes="They are the curve's two stencils multiplied: edge by edge, edge by vertex, vertex by "
                             "vertex. Ask for the 6 and the 36.",
                       claim=_weights(face.stencil) == {Fraction(1, 4): 4}
                       and _weights(edge.stencil) == {Fraction(6, 16): 2, Fraction(1, 16): 4}
                       and _weights(vertex.stencil) == {Fraction(36, 64): 1, Fraction(6, 64): 4, Fraction(1, 64): 4})
    yield beside(show(told, None, "Four faces of a larger mesh, and the ring about them.", look=LOOK,
                      claim=int((~told.control.surface.hidden).sum()) == 4), face)
    yield beside(play(told, faces, "Face points: the mean of four corners.", look=LOOK, stencil=faces.stencil(V),
                      formula=r"$\dfrac{A+B+C+D}{4}$", claim=len(faces.born) == F), face)
    yield beside(play(told, edges, "Edge points: six sixteenths of each end, one of each other corner beside it.",
                      look=LOOK, stencil=told.upto(2).stencil(V + F + int(spoke)), span=2,
                      formula=r"$\dfrac{6\,(A+B)+C+D+E+F}{16}$",
                      claim=_weights(told.upto(2).stencil(V + F + int(spoke))) == _weights(edge.stencil)), edge)
    yield beside(play(told, vertices, "Vertex points: 36, 6 and 1 sixty-fourths. Old vertices move only now.",
                      look=LOOK, stencil=told.upto(3).stencil(0), span=3,
                      formula=r"$\dfrac{36\,V+6\sum E_i+\sum F_i}{64}$",
                      claim=_weights(told.upto(3).stencil(0)) == _weights(vertex.stencil) and vertices.moves), vertex)
    yield play(told, connect, "Connect: every face becomes four. The same step as centroid averaging, in one go.",
               look=LOOK, claim={len(array.stencil(k).terms) for k in range(25)} == {4, 6, 9}
               and bool(abs(told.whole.matrix - trace(QUAD_CENTROID, told.control).whole.matrix).max() < 1e-12))


def _weights(row: Stencil | None) -> dict[object, int]:
    """How many points have which weight."""
    found = [weight for _, weight in row.terms] if row else []
    return {weight: found.count(weight) for weight in found}

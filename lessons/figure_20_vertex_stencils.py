"""Figure 20. Two vertex stencils for valence n, and what "more rounded" comes to in numbers."""

from collections.abc import Iterator
from fractions import Fraction
from math import log

import numpy as np

from lessons.questions import weight, where
from lessons.script import Beat, Look, Reading, View, lesson, side_by_side, stencil_of
from subdivision import Mesh, Stencil, Trace, shapes, subdivide, trace
from subdivision.limit import to_limit
from subdivision.roundness import ball_at, radius_ratio
from subdivision.schemes import CATMULL_CLARK, QUAD_CENTROID
from subdivision.words import phrase

ABOVE, CORNER = Look(azimuth=-70.0, elevation=32.0), Look(azimuth=38.0, elevation=28.0)
RULES = (QUAD_CENTROID, CATMULL_CLARK)
NAMES = ("(a) simple", "(b) Catmull-Clark")


@lesson("Figure 20  Two vertex stencils", section="3.2 Quads: stencils", knobs={"valence": range(3, 13)},
        ours="The lecture says that Catmull-Clark tends to be more rounded; how that is measured here is ours.")
def figure_20_vertex_stencils(valence: int = 6) -> Iterator[Beat]:
    n = valence
    stars, squares = _both(shapes.quad_star(n)), _both(shapes.quad_star(4))
    simple, clark = (told.whole.stencil(0) for told in stars)
    dome = shapes.dome(shapes.quad_star(n))
    once, often = _both(dome), _both(dome, levels=4)
    cubes = _both(shapes.cube())
    limits = [to_limit(trace(rule, subdivide(shapes.cube(), rule, 2), "stencils")) for rule in RULES]
    ring = np.arange(1, dome.topology.n_vertices)

    yield side_by_side(phrase("A vertex of valence {n}: two ways to weigh its {n} neighbours and {n} opposite corners.",
                              n=n),
                       stencil_of(stars[0], 0, "(a) simple vertex stencil"),
                       stencil_of(stars[1], 0, "(b) Catmull-Clark stencil"), poster=True,
                       predict=weight(clark, 0, "Catmull-Clark: how much of itself does the vertex in the middle keep?",
                                      simple.weight(0)),
                       formula=r"$\frac{9}{16},\ \frac{6}{16n},\ \frac{1}{16n}\qquad\quad"
                               r"1-\frac{7}{4n},\ \frac{3}{2n^2},\ \frac{1}{4n^2}$",
                       notes="Four things are asked of such a stencil: its weights sum to 1, like points weigh alike, "
                             "at valence 4 it is the bicubic one, and the surface is at least C1. Turn n and ask "
                             "which of the two keeps more of the vertex.",
                       claim=_weights(simple, n) == (Fraction(9, 16), Fraction(6, 16 * n), Fraction(1, 16 * n))
                       and _weights(clark, n) == (1 - Fraction(7, 4 * n), Fraction(3, 2 * n**2), Fraction(1, 4 * n**2))
                       and all(sum(weight for _, weight in row.terms) == 1 for row in (simple, clark)))
    yield side_by_side("At valence 4 both are the bicubic stencil: 36, 6 and 1 sixty-fourths.",
                       *(stencil_of(told, 0, phrase("{name}, n = 4", name=name))
                         for told, name in zip(squares, NAMES, strict=True)),
                       claim=all(_weights(told.whole.stencil(0), 4) == tuple(Fraction(w, 64) for w in (36, 6, 1))
                                 for told in squares))
    yield side_by_side("The same star, raised onto a ball. Face points and edge points: no difference between the two.",
                       *_panes(once, 0, 2), look=ABOVE, claim=np.array_equal(once[0].points[2], once[1].points[2])
                       and np.allclose(np.linalg.norm(dome.points, axis=1), 1))
    yield side_by_side("Only the vertex in the middle goes to two different places. Then connect.",
                       *_panes(once, 2, 4), look=ABOVE,
                       predict=where(0, "Where will Catmull-Clark, on the right, take the middle vertex?", pane=1),
                       notes="The simple rule keeps 9/16 of the vertex at every valence. Catmull-Clark keeps more of "
                             "it the larger n is, and less at valence 3. At valence 4 they do not differ.",
                       claim=np.allclose(once[0].points[4][ring], once[1].points[4][ring], atol=1e-14)
                       and (n == 4) == np.allclose(once[0].points[4][0], once[1].points[4][0], atol=1e-14))
    yield side_by_side("After four levels, measure the ball that fits the tip. It began with radius 1.",
                       *_panes(often, 16, 16, _ball), look=ABOVE,
                       notes="A radius that grows from level to level is a flat spot, a radius that shrinks is a peak. "
                             "Catmull-Clark changes it less from one level to the next at every valence but 4, "
                             "where both rules are one.",
                       claim=n == 4 or _drift(often[1]) < _drift(often[0]))
    yield side_by_side("The cube, valence 3. A corner at 1 goes to 2/3 by the simple rule, to 5/9 by Catmull-Clark.",
                       *_panes(cubes, 2, 4, _corner), look=CORNER,
                       claim=np.allclose([told.points[3][7] for told in cubes], [[2 / 3] * 3, [5 / 9] * 3], atol=1e-12))
    yield side_by_side("In the limit the points of Catmull-Clark are more nearly on a ball: more rounded.",
                       *_panes(limits, 5, 5, _ratio), look=CORNER,
                       notes="The lecture says: tends to be more rounded. Farthest over nearest limit point, from the "
                             "centre: 1.130 against 1.032.",
                       claim=[round(radius_ratio(told.points[-1]), 3) for told in limits] == [1.130, 1.032])


def _both(mesh: Mesh, levels: int = 1) -> list[Trace]:
    return [trace(rule, mesh, "stencils", levels) for rule in RULES]


def _panes(told: list[Trace], start: int, stop: int, reading: Reading | None = None) -> list[View]:
    return [View(t, start, stop, title=name, reading=reading) for t, name in zip(told, NAMES, strict=True)]


def _weights(row: Stencil, n: int) -> tuple[object, ...]:
    """Of the vertex, of every neighbour, of every opposite corner: one weight each, as like points weigh alike."""
    like = ([0], range(1, 2 * n, 2), range(2, 2 * n + 1, 2))
    (vertex,), (edge,), (face,) = ({row.weight(point) for point in points} for points in like)
    return vertex, edge, face


def _drift(told: Trace) -> float:
    """How much the ball at the tip changes in the last level."""
    return abs(log(ball_at(told.mesh_at(16), 0) / ball_at(told.mesh_at(12), 0)))


def _ball(mesh: Mesh) -> str:
    return phrase("ball at the tip: radius {radius:.2g}", radius=ball_at(mesh, 0))


def _corner(mesh: Mesh) -> str:
    return phrase("corner at {x:.3f}", x=mesh.points[7, 0])


def _ratio(mesh: Mesh) -> str:
    return phrase("farthest / nearest: {ratio:.3f}", ratio=radius_ratio(mesh.points))

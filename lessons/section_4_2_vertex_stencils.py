"""Section 4.2. Vertex stencils for valence n among triangles: centroid averaging, Loop, and Warren at valence 3."""

from collections.abc import Iterator
from fractions import Fraction
from math import log

import numpy as np

from lessons.script import Beat, Look, Reading, View, lesson, side_by_side, stencil_of
from subdivision import Mesh, Stencil, Trace, shapes, subdivide, trace
from subdivision.limit import to_limit
from subdivision.roundness import ball_at, radius_ratio
from subdivision.schemes import LOOP, LOOP_WARREN, TRIANGLE_CENTROID
from subdivision.schemes.loop import loop_beta
from subdivision.words import phrase

ABOVE, FRONT = Look(azimuth=-70.0, elevation=32.0), Look(azimuth=25.0, elevation=22.0)
RULES = (TRIANGLE_CENTROID, LOOP)
NAMES = ("(a) simple", "(b) Loop")


@lesson("Vertex stencils of valence n", section="4.2 Triangles: stencils", knobs={"valence": range(3, 13)},
        ours="The text of this section is missing: the two stencils are named by analogy with Figure 20, and all "
             "measurements are ours.")
def section_4_2_vertex_stencils(valence: int = 5) -> Iterator[Beat]:
    n = valence
    stars, regular = _both(shapes.triangle_star(n)), _both(shapes.triangle_star(6))
    simple, loop = (told.whole.stencil(0) for told in stars)
    dome = shapes.dome(shapes.triangle_star(n))
    once, often = _both(dome), _both(dome, levels=4)
    ring = np.arange(1, dome.topology.n_vertices)
    three = [trace(rule, shapes.triangle_star(3), "stencils") for rule in (TRIANGLE_CENTROID, LOOP_WARREN, LOOP)]
    limits = [to_limit(trace(rule, subdivide(shapes.octahedron(), rule, 3), "stencils")) for rule in RULES]

    yield side_by_side(phrase("A vertex of valence {n}: two ways to weigh its {n} neighbours. Edge points stay as they "
                              "were.", n=n),
                       stencil_of(stars[0], 0, "(a) simple vertex stencil"),
                       stencil_of(stars[1], 0, "(b) Loop’s stencil"),
                       formula=r"$\beta=\frac{3}{8n}\qquad"
                               r"\beta=\frac{1}{n}\left(\frac{5}{8}-\left(\frac{3}{8}+\frac{1}{4}\cos\frac{2\pi}{n}"
                               r"\right)^2\right)$", poster=True,
                       notes="Each neighbour weighs beta, the vertex 1 - n beta. Loop's weights are fractions at "
                             "valence 3, 4 and 6 only; elsewhere four decimals of the exact cosine are shown.",
                       claim=_weights(simple, n) == (Fraction(5, 8), Fraction(3, 8 * n))
                       and _weights(loop, n) == (1 - n * loop_beta(n), loop_beta(n))
                       and all(abs(row.weights.sum() - 1) < 1e-15 for row in (simple, loop)))
    yield side_by_side("At valence 6 both are the quartic box spline: ten sixteenths, and one of each neighbour.",
                       *(stencil_of(told, 0, phrase("{name}, n = 6", name=name))
                         for told, name in zip(regular, NAMES, strict=True)),
                       claim=all(_weights(told.whole.stencil(0), 6) == (Fraction(10, 16), Fraction(1, 16))
                                 for told in regular))
    yield side_by_side("Valence 3 is special. Loop and Warren weigh a neighbour 3/16, the simple rule only 1/8.",
                       *(stencil_of(told, 0, name) for told, name in
                         zip(three, ("simple, n = 3", "Warren, n = 3", "Loop, n = 3"), strict=True)),
                       notes="With 1/8 the surface has a tip at such a vertex: it is only continuous there. Warren "
                             "keeps 3/(8n) at every other valence.",
                       claim=[_weights(told.whole.stencil(0), 3)[1] for told in three]
                       == [Fraction(1, 8), Fraction(3, 16), Fraction(3, 16)])
    yield side_by_side("The same star, raised onto a ball. Edge points: no difference between the two.",
                       *_panes(once, 0, 1), look=ABOVE, claim=np.array_equal(once[0].points[1], once[1].points[1])
                       and np.allclose(np.linalg.norm(dome.points, axis=1), 1))
    yield side_by_side("Only the vertex in the middle goes to two different places. Then connect.",
                       *_panes(once, 1, 3), look=ABOVE,
                       claim=np.allclose(once[0].points[3][ring], once[1].points[3][ring], atol=1e-14)
                       and (n == 6) == np.allclose(once[0].points[3][0], once[1].points[3][0], atol=1e-14))
    yield side_by_side("After four levels, measure the ball that fits the tip. It began with radius 1.",
                       *_panes(often, 12, 12, _ball), look=ABOVE,
                       notes="Loop chose his weights so that this radius settles at every valence. By the simple rule "
                             "it shrinks to a peak below valence 6 and grows to a flat spot above.",
                       claim=_drift(often[1]) < 0.01 and (n == 6 or _drift(often[0]) > 0.1))
    yield side_by_side("The octahedron in the limit, valence 4: Loop’s points are more nearly on a ball.",
                       *_panes(limits, 4, 4, _ratio), look=FRONT,
                       claim=[round(radius_ratio(told.points[-1]), 2) for told in limits] == [1.20, 1.07])


def _both(mesh: Mesh, levels: int = 1) -> list[Trace]:
    return [trace(rule, mesh, "stencils", levels) for rule in RULES]


def _panes(told: list[Trace], start: int, stop: int, reading: Reading | None = None) -> list[View]:
    return [View(t, start, stop, title=name, reading=reading) for t, name in zip(told, NAMES, strict=True)]


def _weights(row: Stencil, n: int) -> tuple[object, ...]:
    """Of the vertex and of every neighbour: one weight each, as like points weigh alike."""
    (neighbour,) = {row.weight(p) for p in range(1, n + 1)}
    return row.weight(0), neighbour


def _drift(told: Trace) -> float:
    """How much the ball at the tip changes in the last level."""
    return abs(log(ball_at(told.mesh_at(12), 0) / ball_at(told.mesh_at(9), 0)))


def _ball(mesh: Mesh) -> str:
    return phrase("ball at the tip: radius {radius:.2g}", radius=ball_at(mesh, 0))


def _ratio(mesh: Mesh) -> str:
    return phrase("farthest / nearest: {ratio:.3f}", ratio=radius_ratio(mesh.points))

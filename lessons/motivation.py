"""Fractals and subdivision: two iterations that begin with the same triangle."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from lessons.measured import without_helpers
from lessons.questions import where, which
from lessons.script import FLAT, Beat, Look, View, lesson, levels, side_by_side
from subdivision import Mesh, Polyline, shapes, trace
from subdivision.fractal import SIERPINSKI, separate_triangles
from subdivision.measure import counts
from subdivision.schemes import CATMULL_CLARK, QUAD_CENTROID, lane_riesenfeld

LEVELS = 5
CORNERS = np.array([(-1.0, -0.7, 0.0), (1.0, -0.7, 0.0), (-0.35, 1.0, 0.0)])


@lesson("Fractals and subdivision", section="1 Motivation",
        ours="The lecture names the four reasons; the triangle, the curve and the fractal beside it are ours.")
def motivation() -> Iterator[Beat]:
    fractal = trace(SIERPINSKI, Mesh(separate_triangles(1), CORNERS), levels=LEVELS)
    curve = without_helpers(trace(lane_riesenfeld(3), Mesh(Polyline(3, closed=True), CORNERS),
                                  "topology and geometry", LEVELS))
    linear, quadratic = (trace(lane_riesenfeld(degree), curve.control, levels=LEVELS) for degree in (1, 2))
    outline = View(curve, 0, 0)
    triangles, corners = ([told.topology_at(2 * k) for k in range(LEVELS + 1)] for told in (fractal, curve))

    def both(start: int, stop: int) -> tuple[View, View]:
        return (View(fractal, start, stop, title="fractal"),
                View(curve, start, stop, title="subdivision", over=outline))

    yield side_by_side("One triangle, and two rules to repeat. Where does each of them lead?", *both(0, 0), look=FLAT,
                       formula=r"$C_{n+1} = W(C_n) \qquad P_{n+1} = S(P_n)$",
                       claim=np.array_equal(fractal.control.points, curve.control.points))
    yield side_by_side("Left: three copies, each shrunk by half towards its corner. Right: split, then average.",
                       *both(0, 2), look=FLAT,
                       formula=r"$w_i(p) = \dfrac{p + v_i}{2} \qquad Q = \dfrac{P_{i-1} + 6P_i + P_{i+1}}{8}$",
                       predict=where(3, "Right: an eighth, six eighths, an eighth. Where will this corner go?", pane=1),
                       notes="Both are a matrix times the points; no other rule is needed.",
                       claim=str(fractal.step(0).stencil(1)) == "1/2 v0 + 1/2 v1"
                       and str(curve.step(0).stencil(1)) == "3/4 v1 + 1/8 v0 + 1/8 v2")
    yield side_by_side("The same two rules again, on what they have made.", *both(2, 4), look=FLAT,
                       claim=triangles[2].n_faces == 9 and corners[2].n_vertices == 12)
    yield side_by_side("And again. Left ever more corners and holes; right the corners become blunt.", *both(4, 6),
                       look=FLAT, claim=sharpest(curve.mesh_at(6)) < sharpest(curve.mesh_at(4)) / 1.8)
    yield side_by_side("Left a set that is rough at every size, right a curve that is smooth.", *both(6, 10), look=FLAT,
                       poster=True, formula=r"$C_n \rightarrow C_\infty = W(C_\infty) \qquad P_n \rightarrow P_\infty$",
                       predict=which("Repeat the right rule for ever, from the dashed triangle. Where to?",
                                     *(View(told, len(told.stages), len(told.stages), over=outline)
                                       for told in (quadratic, curve, linear))),
                       notes="The fractal is the one closed and bounded set, but for the empty one, that its rule "
                       "leaves as it is; see Barnsley, Fractals Everywhere. The curve is a cubic B-spline.",
                       claim=triangles[5].n_faces == 3**5
                       and sharpest(curve.mesh_at(10)) < sharpest(curve.mesh_at(8)) / 1.9)
    yield from four_reasons()


def four_reasons() -> Iterator[Beat]:
    """Why to care, each with something to look at."""
    hook = without_helpers(trace(lane_riesenfeld(3), shapes.hook(), "topology and geometry", 4))
    cube = without_helpers(trace(QUAD_CENTROID, shapes.cube()))
    plus = without_helpers(trace(QUAD_CENTROID, shapes.plus_sign(), levels=3))
    mug = trace(CATMULL_CLARK, shapes.mug(), levels=3)
    vertex = hook.step(0).stencil(1)
    polygon, fine = levels(hook, 0, 4)

    yield side_by_side("One: a short procedure takes the place of a long formula.", polygon,
                       replace(fine, over=polygon), look=FLAT,
                       notes="No knots, no basis functions: split, average, repeat.",
                       claim=set(map(str, dict(vertex.terms).values())) == {"3/4", "1/8"})
    yield side_by_side("Two: it is easy to understand and to program: topology, then geometry.",
                       View(cube, 0, 0, title="mesh"), View(cube, 1, 1, title="topology"),
                       View(cube, 2, 2, title="geometry"),
                       claim=[stage.moves for stage in cube.stages[:2]] == [False, True])
    yield side_by_side("Three: it reaches smooth surfaces that no finite list of polynomial pieces describes.",
                       *levels(plus, 0, 1, 3),
                       notes="Ordinary faces are polynomial pieces; round an extraordinary vertex ever smaller ones "
                       "follow each other for ever.",
                       claim=all(plus.mesh_at(2 * k).surface.extraordinary.sum() == 32 for k in range(4)))
    yield side_by_side("Four: any topology will do. A rectangle of control points makes no mug with a handle.",
                       *levels(mug, 0, 1, 3), look=Look(azimuth=-60.0, elevation=22.0),
                       notes="With its sides joined a rectangle is a cylinder or a torus, and nothing else.",
                       claim=counts(mug.control.topology).euler == 0)


def sharpest(mesh: Mesh) -> float:
    """The largest angle by which a closed polygon turns at a point, in degrees."""
    way = np.roll(mesh.points, -1, axis=0) - mesh.points
    after = np.roll(way, -1, axis=0)
    cross = np.linalg.norm(np.cross(way, after), axis=1)
    return float(np.degrees(np.arctan2(cross, (way * after).sum(axis=1))).max())

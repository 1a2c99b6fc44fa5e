"""Exercise 4. Valence 3: under centroid averaging of triangles the tip stays a tip."""

from collections.abc import Iterator

import numpy as np

from lessons.measured import angles_at, without_helpers
from lessons.questions import where
from lessons.script import Beat, Look, View, lesson, side_by_side
from subdivision import Mesh, Scheme, Topology, Trace, shapes, trace
from subdivision.measure import angle_sum
from subdivision.schemes import LOOP, TRIANGLE_CENTROID
from subdivision.spectrum import ring, stencil_by_valence
from subdivision.words import phrase

LOOK = Look(azimuth=-78.0, elevation=12.0)
TIP, LEVELS = 3, 5


@lesson("Exercise 4  Valence 3", section="Exercises",
        ours="The lecture promises only continuity at valence 3; that the tip stays one, and the exercise, are ours.")
def exercise_4_valence_three() -> Iterator[Beat]:
    far = tuple(told_in_two(scheme, shapes.tetrahedron(), 1) for scheme in (TRIANGLE_CENTROID, LOOP))
    near = tuple(told_in_two(told.scheme, told.mesh_at(2), LEVELS - 1) for told in far)
    meshes = [[told.control, *(by.mesh_at(2 * k) for k in range(LEVELS))] for told, by in zip(far, near, strict=True)]
    centroids, loop = meshes
    by_centroids, by_loop = ([angle_sum(mesh, TIP) for mesh in each] for each in meshes)

    def both(pair: tuple[Trace, ...], start: int, stop: int, mark: str = "") -> tuple[View, ...]:
        marks = ((TIP, mark),) if mark else ()
        return tuple(View(told, start, stop, title=title, marks=marks, reading=angles_at(TIP))
                     for told, title in zip(pair, ("centroid averaging", "Loop"), strict=True))

    yield side_by_side("A tetrahedron. Three corners of 60 degrees meet at its tip: 180 together.",
                       *both(far, 0, 0, "n = 3"), look=LOOK,
                       notes="On a smooth surface the angles round a vertex come to 360 degrees. Ask what will happen.",
                       claim=round(by_centroids[0], 9) == 180)
    yield side_by_side("One level of each. Left the angles are still 180; right they open.", *both(far, 0, 2),
                       look=LOOK, formula=r"$\beta = \dfrac{1}{8} \qquad \beta = \dfrac{3}{16}$",
                       predict=where(TIP, "One level of each. Where will the tip on the left go?"),
                       claim=abs(by_centroids[1] - 180) < 1e-9 and by_loop[1] > 300
                       and [str(stencil_by_valence(told.scheme, 3, "vertex").weight("E1")) for told in far]
                       == ["1/8", "3/16"])
    yield side_by_side("Come closer, each as near as it fits.", *both(near, 0, 0, "n = 3"), look=LOOK,
                       claim=all(mesh.surface.valence[TIP] == 3 for mesh in (centroids[1], loop[1])))
    yield side_by_side("Level 2. Loop is at 358 degrees.", *both(near, 0, 2), look=LOOK, claim=round(by_loop[2]) == 358)
    yield side_by_side("Level 3. Loop is almost at 360; the left tip has not changed.", *both(near, 2, 4), look=LOOK,
                       claim=by_loop[3] > 359.8 and abs(by_centroids[3] - 180) < 1e-9)
    yield side_by_side("Level 4. Away from the four tips all vertices are ordinary: there the left is smooth, too.",
                       *both(near, 4, 6), look=LOOK, claim=set(centroids[4].surface.valence[4:]) == {6})
    yield side_by_side("Level 5: 180 for ever, against 360 in the limit.", *both(near, 6, 8), look=LOOK, poster=True,
                       claim=abs(by_centroids[5] - 180) < 1e-9 and 360 - by_loop[5] < 0.01)
    yield side_by_side("Magnify the tip by four for each level: it is the same tip, copied.",
                       *magnifications(centroids, 0, 2, 4), look=LOOK,
                       formula=r"$Q - L = \dfrac{V - L}{4},\quad Q_i - L = \dfrac{N_i - L}{4}$",
                       notes="L is half way between the vertex and the mean of its neighbours. Both eigenvalues are "
                       "1/4; for a smooth limit that of the vertex would have to be the smaller one.",
                       claim=all(np.allclose(sides(magnified(mesh, k)), sides(magnified(centroids[0], 0)), atol=1e-9)
                                 for k, mesh in enumerate(centroids)) and not ring(TRIANGLE_CENTROID, 3).is_smooth)
    yield side_by_side("Loop's tip, magnified as much, gets flatter and flatter: a plane in the limit.",
                       *magnifications(loop, 0, 1, 2), look=LOOK,
                       claim=ring(LOOP, 3).is_smooth and by_loop == sorted(by_loop))


def told_in_two(scheme: Scheme, control: Mesh, levels: int) -> Trace:
    """Every level as topology and geometry."""
    return without_helpers(trace(scheme, control, "centroid averaging", levels))


def magnifications(meshes: list[Mesh], *which: int) -> tuple[View, ...]:
    """The tip at some levels, side by side."""
    names = [phrase("level {k}, ×{zoom}", k=k, zoom=4**k) if k else "level 0" for k in which]
    return tuple(View(still(magnified(meshes[k], k)), 0, 0, title=name, reading=angles_at(0))
                 for k, name in zip(which, names, strict=True))


def magnified(mesh: Mesh, level: int) -> Mesh:
    """The tip and its three neighbours, four times as large for each level, centred."""
    at = mesh.surface.origin == TIP
    ahead, behind = (mesh.surface.origin[turn[at]].tolist() for turn in (mesh.surface.next, mesh.surface.prev))
    following = dict(zip(ahead, behind, strict=True))
    around = [ahead[0], following[ahead[0]], following[following[ahead[0]]]]
    points = 4**level * mesh.points[[TIP, *around]]
    fan = Topology.from_faces([[0, 1, 2], [0, 2, 3], [0, 3, 1]])
    return Mesh(fan, points - points.mean(axis=0))


def still(mesh: Mesh) -> Trace:
    """A control object to which nothing is done."""
    return Trace(mesh, TRIANGLE_CENTROID, "", (), ())


def sides(mesh: Mesh) -> list[float]:
    """The lengths of the edges, sorted."""
    a, b = mesh.points[mesh.topology.ends].transpose(1, 0, 2)
    return sorted(np.linalg.norm(a - b, axis=1).tolist())

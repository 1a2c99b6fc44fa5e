"""Figure 15. A second quad mesh that no array can be: a plus sign in three directions, valences 3 and 6."""

from collections import Counter
from collections.abc import Iterator

from lessons.figure_14_cube import is_isolated
from lessons.measured import without_helpers
from lessons.questions import where
from lessons.script import Beat, Look, lesson, levels, play, show, side_by_side
from subdivision import Trace, shapes, trace
from subdivision.schemes import QUAD_CENTROID

LOOK = Look(azimuth=-58.0, elevation=27.0)


@lesson("Figure 15  A plus sign", section="3.1 Quads: averaging",
        ours="The mesh: the figure is missing from the text. The lecture promises a second quad mesh that is no array.")
def figure_15_plus_sign() -> Iterator[Beat]:
    plus = shapes.plus_sign()
    told = trace(QUAD_CENTROID, plus)
    topology, centroids, geometry = told.stages
    deep = without_helpers(trace(QUAD_CENTROID, plus, levels=3))
    counts = [(t.n_vertices, t.n_edges, t.n_faces)
              for t in (deep.topology_at(2 * level) for level in range(4))]
    valence = plus.surface.valence
    tip = max(range(32), key=lambda v: (valence[v] == 3, plus.points[v] @ (2, -2, 1)))
    notch = max(range(32), key=lambda v: (valence[v] == 6, plus.points[v] @ (2, -2, 1)))
    marks = ((tip, "n = 3"), (notch, "n = 6"))

    yield show(told, None, "Seven cubes, a plus sign. 24 corners have valence three, the 8 in the notches six.",
               look=LOOK, marks=marks,
               notes="Ask for the valence in a notch before naming it: three arms meet there, with two faces each.",
               claim=Counter(valence.tolist()) == {3: 24, 6: 8})
    yield play(told, topology, "Topology: four small quads in every quad. Old valences stay, new ones are four.",
               look=LOOK, marks=marks,
               claim=(topology.topology.valence[:32] == valence).all() and set(topology.topology.valence[32:]) == {4})
    yield play(told, centroids, "Mark the centroids.", look=LOOK, claim=len(centroids.born) == 120)
    yield play(told, geometry, "Geometry: the tips go in, and the notches happen to stay. One rule for three and "
               "for six.", look=LOOK, marks=marks, formula=r"$Q \rightarrow \dfrac{1}{n} \sum_{k=1}^{n} C_k$",
               predict=where(notch, "One rule for three and for six. Where will the corner in the notch go?"),
               notes="A notch stays because its neighbours lie evenly about it: three reach out as far as three "
               "reach in.",
               claim=moves(told, tip) and not moves(told, notch))
    yield play(deep, deep.stages[2], "Two more levels. The marked vertices stay extraordinary, and are isolated.",
               until=deep.stages[5], look=LOOK,
               notes="From level one on no face has two of them.",
               claim=all(is_isolated(deep.mesh_at(k).surface) for k in (2, 4, 6))
               and all(deep.mesh_at(k).surface.extraordinary.sum() == 32 for k in (0, 2, 4, 6)))
    yield side_by_side("The plus sign and three levels. C² but at 32 marked points, and C¹ there.",
                       *levels(deep, 0, 1, 2, 3), look=LOOK,
                       notes="V, E, F: 32 60 30, then 122 240 120, 482 960 480, 1922 3840 1920.",
                       claim=counts == [(32, 60, 30), (122, 240, 120), (482, 960, 480), (1922, 3840, 1920)])


def moves(told: Trace, vertex: int) -> bool:
    """Whether the first level takes a vertex elsewhere."""
    return bool(abs(told.points[3][vertex] - told.points[0][vertex]).max() > 1e-12)

"""Exercise 2. Centroid averaging is the simple vertex stencil, at every valence."""

from collections.abc import Iterator
from fractions import Fraction

from lessons.measured import difference, same_rows
from lessons.script import Beat, Look, View, fragment, lesson, play, show, side_by_side
from subdivision import Stencil, Trace, shapes, trace
from subdivision.exact import Row, add_rows
from subdivision.schemes import QUAD_CENTROID
from subdivision.words import phrase

LOOK = Look(azimuth=-70.0, elevation=58.0)
VERTEX = 0


@lesson("Exercise 2  Centroids, stencil", section="Exercises", knobs={"valence": range(3, 13)},
        ours="The lecture states that both are the same; that its reader is asked to add it up is inferred.")
def exercise_2_centroids_and_stencil(valence: int = 5) -> Iterator[Beat]:
    told = trace(QUAD_CENTROID, fragment(shapes.quad_fan(valence, rings=2)))
    topology, centroids, geometry = told.stages
    around = [int(c) for c in geometry.stencil(VERTEX).parents]
    one, two, all_of_them = (partial_sum(told, around[:k]) for k in (1, 2, valence))
    whole = told.whole.stencil(VERTEX)
    solid = shapes.quad_bipyramid(valence)
    averaged, by_stencils = trace(QUAD_CENTROID, solid), trace(QUAD_CENTROID, solid, "stencils")

    def both(left: tuple[int, int], right: tuple[int, int]) -> tuple[View, View]:
        return View(averaged, *left, title="centroid averaging"), View(by_stencils, *right, title="simple stencil")

    yield show(told, None, phrase("A vertex with {valence} quads around it.", valence=valence), look=LOOK,
               claim=told.control.topology.valence[VERTEX] == valence)
    yield play(told, topology, "Topology: a point on every edge and one on every face.", look=LOOK,
               formula=r"$\dfrac{V + E_i}{2},\quad \dfrac{V + E_i + F_i + E_{i+1}}{4}$",
               claim=not topology.moves)
    yield play(told, centroids, "Mark the centroid of every small quad.", look=LOOK,
               claim=len(centroids.born) == topology.topology.n_faces)
    yield show(told, centroids, "Each {centroid} centroid beside the vertex holds 9, 3, 3 and 1 sixteenths.", look=LOOK,
               stencil=told.upto(2).stencil(around[0]), span=2,
               formula=r"$C_i = \dfrac{9V + 3E_i + 3E_{i+1} + F_i}{16}$",
               notes="Add up the quarter of its four corners: V, two midpoints of edges, and the face point.",
               claim=sixteenths(told.upto(2).stencil(around[0]), 1) == [1, 3, 3, 9])
    yield play(told, geometry, "Geometry: the vertex goes to the mean of these centroids. Let us add them up.",
               look=LOOK, formula=r"$Q = \dfrac{1}{n} \sum_i C_i$", claim=len(around) == valence)
    yield show(told, geometry, "The first face brings 9, 3, 3 and 1.", look=LOOK, stencil=one, span=3,
               formula=rf"$9 + 3 + 3 + 1 = 16 \quad (16n = {16 * valence})$",
               claim=sixteenths(one, valence) == [1, 3, 3, 9])
    yield show(told, geometry, "The second brings the same: the vertex has 18 now, the neighbour they share has 6.",
               look=LOOK, stencil=two, span=3,
               formula=r"$2 \times (9 + 3 + 3 + 1)$",
               claim=sixteenths(two, valence) == [1, 1, 3, 3, 6, 18])
    yield show(told, geometry,
               phrase("All {valence}: every neighbour was counted twice. This is the simple stencil.", valence=valence),
               look=LOOK, stencil=all_of_them, span=3, poster=True,
               formula=r"$\dfrac{9n\,V + 6 \sum E_i + \sum F_i}{16\,n}$",
               notes="9n + 6n + n = 16n, so the weights sum to one, whatever the valence.",
               claim=all_of_them == whole
               and sixteenths(whole, valence) == [1] * valence + [6] * valence + [9 * valence])
    yield side_by_side("A whole mesh: centroids on the left; face and edge points by stencils on the right.",
                       *both((0, 2), (0, 2)), claim=by_stencils.stages[1].name == "edge points")
    yield side_by_side("Left, all points move to their centroids. Right, only the vertices are left to move.",
                       *both((2, 3), (2, 4)),
                       claim=averaged.stages[2].moves and by_stencils.stages[2].moves)
    yield show(averaged, averaged.stages[-1], "One over the other, in dashes. No point differs.",
               over=View(by_stencils, 4, 4), reading=difference, claim=same_rows(averaged, by_stencils))


def partial_sum(told: Trace, centroids: list[int]) -> Stencil:
    """What some of the centroids bring to the vertex, each with its share of one ``n``-th."""
    row: Row = {}
    for c in centroids:
        share = told.stages[-1].stencil(VERTEX).weight(c)
        add_rows(dict(told.upto(2).stencil(c).terms), row, share)
    return Stencil.of(VERTEX, row)


def sixteenths(stencil: Stencil, n: int) -> list[Fraction]:
    """The weights in parts of ``1/(16 n)``, the least first."""
    return sorted(weight * 16 * n for _, weight in stencil.terms if isinstance(weight, Fraction))

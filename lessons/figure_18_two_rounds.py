"""Figure 18. Bicubic surfaces as two rounds of centroid averaging on the array of Figure 4."""

from collections.abc import Iterator
from fractions import Fraction

from lessons.script import Beat, Look, before_and_after, lesson, play, show, with_diagram
from subdivision import Stencil, Trace, shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import tensor_product

LOOK = Look(azimuth=-78.0, elevation=56.0, zoom=0.77)
PANELS = "(a) First round", "(b) Second round"
FACE, EDGE, VERTEX = [16] * 4, [24, 24, 4, 4, 4, 4], [36, 6, 6, 6, 6, 1, 1, 1, 1]


@lesson("Figure 18  Two rounds of centroids", section="3.2 Quads: stencils",
        ours="Panel (b) is missing from the text; it is derived from panel (a) by the second round.")
def figure_18_two_rounds() -> Iterator[Beat]:
    net = shapes.net(4, 4)
    told = trace(tensor_product(3, 3), net, telling="two rounds")
    bilinear, first, second = told.stages
    figure_4 = trace(tensor_product(1, 1), net).whole
    rows = [told.whole.stencil(i) for i in range(second.n_points)]
    face, edge, vertex = (central([r for r in rows if over_64(r) == kind]) for kind in (FACE, EDGE, VERTEX))
    corner = told.upto(2).stencil(int(as_grid(first.topology).numbers[2, 2]))

    yield with_diagram(show(told, bilinear, "The array of Figure 4: originals, edge midpoints, face centroids.",
                            look=LOOK, notes="Bilinear subdivision: the topology of Figure 12. What follows is its "
                            "geometry, one formula a box.",
                            claim=abs(told.upto(1).matrix - figure_4.matrix).max() == 0))
    yield with_diagram(play(told, first, "(a) First round: the centroid of every four neighbours in the array.",
                            look=LOOK, formula=r"$\dfrac{9A + 3B + 3D + C}{16}$",
                            notes="A is the nearest corner of the old face, C the one across. Nine of these formulas "
                            "are written out in the lecture. This alone is the biquadratic surface.",
                            claim=all(is_nearest(told, i) for i in range(first.n_points))
                            and abs(told.upto(2).matrix - trace(tensor_product(2, 2), net).whole.matrix).max() < 1e-12))
    yield with_diagram(show(told, first, "Nine sixteenths of the nearest corner, one of the farthest.", look=LOOK,
                            stencil=corner, span=2, formula=r"$\dfrac{9A + 3B + 3D + C}{16}$",
                            notes="For the board: draw one face with its four small ones, and write 9, 3, 3, 1.",
                            claim=[int(16 * w) for w in corner.weights] == [9, 3, 3, 1]))
    yield before_and_after(play(told, second, "(b) Second round: centroids of the centroids. The bicubic surface.",
                                look=LOOK, notes="Hover a box on the right: its four parents light up on the left. "
                                "Each box shows its coefficients as its control points stand in the net.",
                                claim=abs(told.whole.matrix - trace(tensor_product(3, 3), net).whole.matrix).max()
                                < 1e-12), first, *PANELS)
    yield before_and_after(show(told, second, "A face point: a quarter of each corner.", look=LOOK, stencil=face,
                                span=3, formula=r"$\dfrac{A + B + C + D}{4}$",
                                notes="Add the four lit boxes on the left: 9 + 3 + 3 + 1 of sixteen, for each corner.",
                                claim=over_64(face) == FACE), first, *PANELS)
    yield before_and_after(show(told, second, "An edge point: six sixteenths of its ends, one of the four beside it.",
                                look=LOOK, stencil=edge, span=3, formula=r"$\dfrac{6\,(A+B) + C + D + E + F}{16}$",
                                notes="The boxes are all over 64, so that they can be compared: 24 is 6 sixteenths.",
                                claim=over_64(edge) == EDGE), first, *PANELS)
    yield before_and_after(show(told, second, "A vertex point: 36, 6 and 1 sixty-fourths. Three stencils are all there "
                                "are.", look=LOOK, stencil=vertex, span=3,
                                formula=r"$\dfrac{36\,V + 6 \sum E_i + \sum F_i}{64}$",
                                notes="Figure 19 draws the three. Two rounds of centroids, or one stencil: the same "
                                "matrix.",
                                claim=all(over_64(r) in (FACE, EDGE, VERTEX) for r in rows)), first, *PANELS)


def central(rows: list[Stencil]) -> Stencil:
    """The row that is least at the rim: in the middle of the list."""
    return rows[len(rows) // 2]


def over_64(row: Stencil) -> list[int]:
    """The weights of a row over 64, the largest first."""
    return [int(64 * weight) for weight in row.weights]


def is_nearest(told: Trace, point: int) -> bool:
    """Whether a box of the first round takes 3/4 and 1/4 in s, times 3/4 and 1/4 in t, the most of the nearest."""
    (i, j), n_t = divmod(point, as_grid(told.stages[1].topology).n_t), as_grid(told.control.topology).n_t
    wanted = {a * n_t + b: in_s * in_t for a, in_s in quarters(i).items() for b, in_t in quarters(j).items()}
    return dict(told.upto(2).stencil(point).terms) == wanted


def quarters(k: int) -> dict[int, Fraction]:
    """The control points that place ``k`` of the first round lies between, the nearer one first."""
    near = (k + 1) // 2
    return {near: Fraction(3, 4), near + (-1) ** k: Fraction(1, 4)}

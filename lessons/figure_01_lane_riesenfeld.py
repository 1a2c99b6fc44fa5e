"""Figure 1. The Lane-Riesenfeld algorithm: a pyramid of averages over a row of doubled points."""

from collections.abc import Iterator
from math import comb

from lessons.questions import where
from lessons.script import Beat, lesson, play, show, with_diagram
from subdivision import Stencil, Trace, shapes
from subdivision.schemes import lane_riesenfeld
from subdivision.words import phrase

TELLING = "split and average"
AVERAGE = r"$U_k \leftarrow \dfrac{U_k + U_{k+1}}{2}$"
COUNTS = {4: "four", 5: "five"}


@lesson("Figure 1  Lane-Riesenfeld curves", section="2.1 Split and average", knobs={"degree": range(1, 8)})
def figure_01_lane_riesenfeld(degree: int = 3) -> Iterator[Beat]:
    told = one_step(degree, 4 if degree < 5 else 5)
    split, once, *more = told.stages
    n, last = told.control.topology.n_vertices, told.stages[-1]
    middle = told.whole.stencil((last.n_points - 1) // 2 | 1)

    yield with_diagram(show(told, None, phrase("A control polygon: {count} points in a row.", count=COUNTS[n]),
                            notes="A subdivision procedure takes a control object and gives a finer one of the same "
                            "kind. Here it is the simplest one: a list of points.",
                            claim=n == len(told.control.points)))
    yield with_diagram(play(told, split, "Split: write every point twice. Nothing moves.",
                            formula=r"$U_{2i} = U_{2i+1} = P_i$",
                            notes="The base row of the diagram; what stands above it is averages. Ask how many boxes "
                            "the next row will have.",
                            claim=not split.moves and split.n_points == 2 * n))
    yield with_diagram(play(told, once, "Average neighbours once: the originals and the midpoints. Same shape.",
                            formula=AVERAGE,
                            notes="One averaging row is degree 1, the case the lecture draws. The polygon looks as "
                            "before: this row is topology, the ones above it are geometry.",
                            claim=sorted(set(once.roles)) == [0, 1]))
    if degree > 1:
        yield with_diagram(play(told, more[0], "Average again: corners are cut. This is the quadratic curve.",
                                formula=AVERAGE, notes="This is Chaikin's corner cutting: 3/4 and 1/4.",
                                predict=where(4, "Average neighbours again. Where will this point go?"),
                                claim=sorted(map(float, told.upto(3).stencil(0).weights)) == [1 / 4, 3 / 4]))
    if degree > 2:
        yield with_diagram(play(told, more[1], "And again: the cubic curve. Every average makes the row one shorter.",
                                formula=AVERAGE, notes="Read a box as its row says: times 1/8. Hover it to see its "
                                "parents; follow the strokes down to the base.",
                                claim=more[1].n_points == more[0].n_points - 1))
    if degree > 3:
        yield with_diagram(play(told, more[2],
                                phrase("And so on: {degree} averages make a curve of degree {degree}.", degree=degree),
                                until=last, formula=AVERAGE,
                                notes=phrase("{n} points become {points}. A polygon grows from step to step only if it "
                                             "has more points than the degree; this one has too few to be subdivided "
                                             "for ever.", n=n, points=last.n_points),
                                claim=len(told.stages) == degree + 1))
    yield with_diagram(show(told, last, phrase("Doubled, less one for every average: {n} points become {points}.",
                                               n=n, points=last.n_points),
                            formula=r"$N \rightarrow 2N - n$",
                            notes="The number of polynomial pieces, N - n, doubles exactly.",
                            claim=last.n_points == 2 * n - degree and last.n_points - degree == 2 * (n - degree)))
    yield with_diagram(show(told, last, phrase("Read one box: every second number in row {row} of Pascal’s triangle, "
                                               "over {denominator}.", row=degree + 1, denominator=2**degree),
                            stencil=middle, span=degree + 1,
                            formula=spelled(middle, degree),
                            notes="The two kinds of boxes take the even and the odd entries; each of them sums to "
                            "one. For degree 3 these two rows are the stencils of Figure 17.",
                            claim=all(is_of_pascal(told.whole.stencil(i), degree) for i in range(last.n_points))))


def one_step(degree: int, n: int) -> Trace:
    """One step pass by pass, also of a polygon too short to be subdivided for ever."""
    scheme, polygon = lane_riesenfeld(degree), shapes.polygon(n)
    stages = scheme.tellings[TELLING](polygon.topology).stages
    return Trace(polygon, scheme, TELLING, stages, (0,) * len(stages))


def counts(row: Stencil, degree: int) -> dict[int, int]:
    """How often each control point counts in a box of the top row."""
    return {point: int(weight * 2**degree) for point, weight in sorted(row.terms, key=lambda term: term[0])}


def is_of_pascal(row: Stencil, degree: int) -> bool:
    """Whether a row holds every second binomial coefficient."""
    pascal = [comb(degree + 1, k) for k in range(degree + 2)]
    return list(counts(row, degree).values()) in (pascal[::2], pascal[1::2])


def spelled(row: Stencil, degree: int) -> str:
    """A box as a formula."""
    terms = [f"{c if c > 1 else ''} P_{p}" for p, c in counts(row, degree).items()]
    return rf"$\dfrac{{{' + '.join(terms)}}}{{{2**degree}}}$"

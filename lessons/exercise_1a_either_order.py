"""Exercise 1a. Split and average along s before t, or along t before s: the same net."""

from collections.abc import Iterator

from lessons.measured import difference, same_rows
from lessons.script import Beat, Look, View, lesson, show, side_by_side
from subdivision import Grid, Trace, shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import tensor_product
from subdivision.words import phrase

LOOK = Look(azimuth=-62.0, elevation=56.0)
S_FIRST, T_FIRST = "s, then t", "t, then s"


@lesson("Exercise 1a  Either order", section="Exercises", knobs={"degree": range(1, 4)})
def exercise_1a_either_order(degree: int = 1) -> Iterator[Beat]:
    net, shuffled = shapes.net(4, 4), "ts" * degree
    scheme = tensor_product(degree, degree, shuffled)
    s_first, t_first = trace(scheme, net, S_FIRST), trace(scheme, net, T_FIRST)
    four_times = trace(scheme, net, "quadruple, then average")
    in_turns = trace(scheme, net, phrase("quadruple, then {shuffled}", shuffled=shuffled))
    half, end, other_end = degree + 1, 2 * degree + 2, 2 * degree + 1
    weights = s_first.whole.stencil(middle(s_first))
    times = {1: "once", 2: "twice", 3: "three times"}[degree]

    def both(start: int, stop: int) -> tuple[View, View]:
        return View(s_first, start, stop, title=S_FIRST), View(t_first, start, stop, title=T_FIRST)

    def pointed(told: Trace, title: str) -> View:
        return View(told, end, end, title=title, stencil=told.whole.stencil(middle(told)), span=end)

    yield side_by_side("One net, told twice: along s before t on the left, along t before s on the right.", *both(0, 0),
                       look=LOOK, claim=s_first.control is t_first.control)
    yield side_by_side(phrase("Split, and average {times}: the left net has grown along s, the right one along t.",
                              times=times),
                       *both(0, half), look=LOOK,
                       notes="Half way the two arrays have different shapes. Ask whether they can still agree.",
                       claim=s_first.topology_at(half) == Grid(8 - degree, 4)
                       and t_first.topology_at(half) == Grid(4, 8 - degree))
    yield side_by_side("Now the other direction. Both nets end with the same number of points.", *both(half, end),
                       look=LOOK, claim=s_first.topology_at(end) == t_first.topology_at(end))
    yield show(s_first, s_first.stages[-1], "Lay the right net over the left one, in dashes. No point differs.",
               look=LOOK, over=View(t_first, end, end), reading=difference, formula=r"$A_s A_t = A_t A_s$", poster=True,
               notes="The number below the picture is measured on the two nets as they are drawn; drag a control point "
               "and it stays 0.", claim=same_rows(s_first, t_first))
    yield side_by_side("Why? One pass works on rows, the other on columns. A point has the same weights either way.",
                       pointed(s_first, S_FIRST), pointed(t_first, T_FIRST), look=LOOK,
                       formula=r"$\dfrac{1}{2}\left(\dfrac{a+b}{2}+\dfrac{c+d}{2}\right) = "
                       r"\dfrac{1}{2}\left(\dfrac{a+c}{2}+\dfrac{b+d}{2}\right)$",
                       claim=weights == t_first.whole.stencil(middle(t_first)))
    yield side_by_side("A third way: write every point four times at once, then average along s and along t.",
                       View(four_times, 0, other_end, title="quadruple, then average"),
                       View(s_first, end, end, title=S_FIRST), look=LOOK,
                       notes="This is the variant of Figure 5. A split along t and an average along s may change "
                       "places, because one copies columns and the other only looks along rows.",
                       claim=four_times.stages[0].n_points == 4 * 16)
    yield show(four_times, four_times.stages[-1], "The same net again, to the last point.", look=LOOK,
               over=View(s_first, end, end), reading=difference, claim=same_rows(s_first, four_times))
    yield show(in_turns, in_turns.stages[-1],
               phrase("Shuffle the averages, {order}: still the same.", order=" ".join(shuffled)), look=LOOK,
               over=View(s_first, end, end), reading=difference,
               notes="Any order will do, as long as each point is split before it is averaged.",
               claim=same_rows(s_first, in_turns))


def middle(told: Trace) -> int:
    """The number of the point in the middle of the last net."""
    n_s, n_t = as_grid(told.whole.topology).shape
    return n_s // 2 * n_t + n_t // 2

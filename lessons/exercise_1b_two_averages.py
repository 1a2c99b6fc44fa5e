"""Exercise 1b. Average along v and then along w, or along w and then along v: the same net."""

from collections.abc import Iterator

from lessons.measured import difference, same_rows
from lessons.script import Beat, Look, View, lesson, show, side_by_side
from subdivision import Scheme, Trace, shapes, trace
from subdivision.passes import Vector, as_grid, average, told
from subdivision.schemes import THREE_DIRECTION_QUARTIC, box_spline
from subdivision.words import phrase

LOOK = Look(azimuth=-62.0, elevation=56.0)
V: Vector = (1, 0)
V_FIRST, W_FIRST = "v, then w", "w, then v"


@lesson("Exercise 1b  Two averages", section="Exercises", knobs={"w_s": range(-1, 3), "w_t": range(1, 3)},
        ours="The formula is the hint; the vectors to choose, and the whole box spline at the end, are ours.")
def exercise_1b_two_averages(w_s: int = 1, w_t: int = 1) -> Iterator[Beat]:
    w = (w_s, w_t)
    net = shapes.net(6, 6, diagonal=True)
    scheme = two_averages(V, w)
    v_first, w_first = trace(scheme, net, V_FIRST), trace(scheme, net, W_FIRST)
    last = v_first.stages[-1]
    number = as_grid(net.topology).numbers
    four = [int(number[2 + i, 2 + j]) for i, j in ((0, 0), V, w, (V[0] + w_s, V[1] + w_t))]
    names = tuple(zip(four, ("k", "k+v", "k+w", "k+v+w"), strict=True))
    new = as_grid(v_first.whole.topology).numbers[2 - max(-w_s, 0), 2]  # passes drop what has no partner in front
    row = v_first.whole.stencil(int(new))
    box = box_spline(THREE_DIRECTION_QUARTIC)
    forwards, backwards = trace(box, net, "in order"), trace(box, net, "in reverse")
    end = len(forwards.stages)

    def both(start: int, stop: int) -> tuple[View, View]:
        return View(v_first, start, stop, title=V_FIRST), View(w_first, start, stop, title=W_FIRST)

    yield show(v_first, None, phrase("A net, and two vectors: v = ({v_s},{v_t}) and w = ({w_s},{w_t}).",
                                     v_s=V[0], v_t=V[1], w_s=w_s, w_t=w_t), look=LOOK,
               marks=names, notes="Turn the knobs for another w; what follows holds for all of them.",
               claim=len(set(four)) == 4)
    yield side_by_side("Left: average each point with its neighbour along v. Right: along w.", *both(0, 1), look=LOOK,
                       formula=r"$\dfrac{U_k + U_{k+v}}{2} \qquad \dfrac{U_k + U_{k+w}}{2}$",
                       notes="The two nets differ: each has lost the rim that has no neighbour along its own vector.",
                       claim=v_first.topology_at(1) != w_first.topology_at(1))
    yield side_by_side("Now left along w, right along v.", *both(1, 2), look=LOOK,
                       claim=v_first.whole.topology == w_first.whole.topology)
    yield show(v_first, last, "Lay one over the other, in dashes. No point differs.", look=LOOK,
               over=View(w_first, 2, 2), reading=difference, formula=r"$A_w A_v = A_v A_w$",
               claim=same_rows(v_first, w_first), poster=True)
    yield side_by_side("Why? Either way a point is the mean of four: k, k+v, k+w and k+v+w.",
                       View(v_first, 2, 2, title="after both averages", stencil=row, span=2),
                       View(v_first, 0, 0, title="before", marks=names), look=LOOK,
                       formula=r"$\dfrac{U_k + U_{k+v} + U_{k+w} + U_{k+v+w}}{4}$",
                       notes="The formula stays the same when v and w change places; that is the proof.",
                       claim={p: str(weight) for p, weight in row.terms} == dict.fromkeys(four, "1/4"))
    yield side_by_side("So the averages of a box spline may come in any order: these four, or these four in reverse.",
                       View(forwards, 0, end, title=order(forwards)), View(backwards, 0, end, title=order(backwards)),
                       look=LOOK, claim=order(forwards).split(", ") == order(backwards).split(", ")[::-1])
    yield show(forwards, forwards.stages[-1], "The three-direction quartic, by both orders. The difference is 0.",
               look=LOOK, over=View(backwards, end, end), reading=difference, claim=same_rows(forwards, backwards))


def two_averages(v: Vector, w: Vector) -> Scheme:
    """Two averages and no split: not subdivision yet, but what a box spline is made of."""
    return Scheme(
        name="two-averages",
        title="Two averages",
        paper="WW02",
        refuses=lambda t: "",
        tellings={
            V_FIRST: lambda t: told(t, [average(v), average(w)]),
            W_FIRST: lambda t: told(t, [average(w), average(v)]),
        },
    )


def order(trace: Trace) -> str:
    """The directions of the averages, as they come."""
    return ", ".join(stage.name.removeprefix("average ") for stage in trace.stages[1:])

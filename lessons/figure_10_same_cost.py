"""Figure 10. Biquadratic and three-direction quartic from the same net, four averages a level each."""

from collections.abc import Iterator

from lessons.script import Beat, Look, View, lesson, show, side_by_side
from subdivision import Trace, continuity, shapes, trace
from subdivision.passes import as_grid
from subdivision.schemes import box_spline, tensor_product

LOOK = Look(azimuth=-55.0, elevation=38.0)
QUADRATIC = ((1, 0),) * 3 + ((0, 1),) * 3
QUARTIC = ((1, 1), (1, 0), (0, 1), (1, 1), (1, 0), (0, 1))
DEEP = 4
NAMES = "Biquadratic, C¹", "Quartic, C²"


@lesson("Figure 10  Same cost, smoother", section="2.2 Box spline surfaces",
        ours="The control net, and the number of levels: the lecture gives neither.")
def figure_10_same_cost() -> Iterator[Beat]:
    net = shapes.landscape()
    left, right = trace(tensor_product(2, 2), net, "quadruple, then average"), trace(box_spline(QUARTIC), net)
    deep_left, deep_right = (trace(each.scheme, net, "stencils", levels=DEEP) for each in (left, right))

    def both(start: float, stop: float, *traces: Trace, isophotes: bool = False) -> tuple[View, ...]:
        named = zip(traces or (left, right), NAMES, strict=True)
        return tuple(View(told, start, stop, title=name, isophotes=isophotes) for told, name in named)

    yield show(left, None, "One net, two surfaces. Both will average four times a level.", look=LOOK,
               formula=r"$4 = 6 - 2$",
               notes="Six vectors each; quadrupling uses up two of them.",
               claim=len(QUADRATIC) == len(QUARTIC) == 6 and len(left.stages) == len(right.stages) == 1 + 4)
    yield side_by_side("Split: every point four times, in both.", *both(0, 1), look=LOOK,
                       claim=left.stages[0].n_points == right.stages[0].n_points == 4 * 36)
    yield side_by_side("Four averages: left along (1,0) and (0,1), twice each; right the diagonal (1,1) takes a part.",
                       *both(1, 5), look=LOOK,
                       notes="Left ten by ten points come out, right nine by nine: the diagonal costs a row and a "
                       "column at once.",
                       claim=[as_grid(told.topology_at(5)).shape for told in (left, right)] == [(10, 10), (9, 9)])
    yield side_by_side("More levels, in step.", *both(1, DEEP, deep_left, deep_right), look=LOOK,
                       claim=[as_grid(told.topology_at(DEEP)).n_s for told in (deep_left, deep_right)] == [66, 51])
    yield side_by_side("Same net, same work, same degree 4. Left C¹, right C².",
                       View(left, 0, 0, title="Control net"), *both(DEEP, DEEP, deep_left, deep_right), look=LOOK,
                       formula=r"$\alpha = 3 \quad \alpha = 4$",
                       notes="Continuity is alpha - 2. Left, three vectors are parallel, so leaving out the other "
                       "three is enough; right no more than two are parallel.",
                       claim=all(continuity.degree(v) == 4 for v in (QUADRATIC, QUARTIC))
                       and [continuity.alpha(v) for v in (QUADRATIC, QUARTIC)] == [3, 4]
                       and [continuity.smoothness(v) for v in (QUADRATIC, QUARTIC)] == [1, 2])
    yield side_by_side("Lines of equal light. On the left they bend sharply where pieces meet, on the right nowhere.",
                       *both(DEEP, DEEP, deep_left, deep_right, isophotes=True), look=LOOK,
                       notes="A line of equal light joins points that lean equally far from the light. It depends on "
                       "first derivatives, so it is one degree less smooth than the surface.",
                       claim=continuity.smoothness(QUADRATIC) - 1 == 0 and continuity.smoothness(QUARTIC) - 1 == 1)

"""Uniform tensor product B-splines of any bidegree, by splitting and averaging in s and t [LR80]_.

Split and average along s, then along t; or the other way round; or quadruple every point and
average in any order: the passes commute, so all of them make the same net.
"""

from functools import partial
from itertools import chain, zip_longest

from subdivision.limit_nets import net_limit, tensor_weights
from subdivision.manifold import TopologyError
from subdivision.passes import (
    Pass,
    as_grid,
    at_once,
    average,
    cell_averages,
    merged,
    quadruple,
    room,
    split,
    told,
    topology_and_geometry,
)
from subdivision.rows import Connectivity, Grid
from subdivision.scheme import Scheme
from subdivision.words import phrase

S, T = (1, 0), (0, 1)


def tensor_product(m: int, n: int, order: str = "") -> Scheme:
    """The scheme of bidegree ``(m, n)``, both at least 1.

    ``order``, such as ``"sttsst"``, adds the telling that quadruples and then averages in that order.

    Raises
    ------
    TopologyError
        For a degree below 1, or an order that has not ``m`` times s and ``n`` times t.
    """
    if min(m, n) < 1:
        raise TopologyError(phrase("bidegree ({m}, {n}) needs both degrees to be 1 or more", m=m, n=n))
    in_order = [quadruple, *[average(S)] * m, *[average(T)] * n]
    tellings = {
        "s, then t": lambda t: told(t, [split(0), *[average(S)] * m, split(1), *[average(T)] * n]),
        "t, then s": lambda t: told(t, [split(1), *[average(T)] * n, split(0), *[average(S)] * m]),
        "quadruple, then average": lambda t: told(t, in_order),
        "quadruple, then alternate": lambda t: told(t, [quadruple, *alternating(m, n)]),
        "stencils": lambda t: at_once("stencils", told(t, in_order)),
    }
    if (m, n) == (3, 3):
        bilinear = merged("topology", [quadruple, average(S), average(T)])
        tellings["topology and geometry"] = lambda t: topology_and_geometry(as_grid(t), bilinear)
        rounds = [bilinear, cell_averages("first round"), cell_averages("second round")]
        tellings["two rounds"] = lambda t: told(t, rounds)
    if order:
        in_this_order = [quadruple, *_ordered(order, m, n)]
        tellings[phrase("quadruple, then {order}", order=order)] = lambda t: told(t, in_this_order)
    return Scheme(
        name=f"tensor-product-{m}-{n}",
        title=phrase("Tensor product B-spline of bidegree ({m}, {n})", m=m, n=n),
        paper="LR80",
        refuses=partial(_refuses, lost=(m, n)),
        tellings=tellings,
        limit=lambda t: net_limit(t, tensor_weights(m, n)),
    )


def alternating(m: int, n: int) -> list[Pass]:
    """``m`` passes along s and ``n`` along t, in turns."""
    turns = zip_longest([average(S)] * m, [average(T)] * n)
    return [one for one in chain.from_iterable(turns) if one is not None]


def _ordered(order: str, m: int, n: int) -> list[Pass]:
    if sorted(order) != ["s"] * m + ["t"] * n:
        raise TopologyError(
            phrase("the order '{order}' must have {m} times s and {n} times t, and nothing else", order=order, m=m, n=n)
        )
    return [average(S if direction == "s" else T) for direction in order]


def _refuses(t: Connectivity, lost: tuple[int, int]) -> str:
    return room(t, lost) if isinstance(t, Grid) else "it is not a rectangular net"

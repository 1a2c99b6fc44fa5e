"""Box splines of any vector set, by quadrupling and averaging [WW02]_.

``V`` is a list of integer vectors with (1, 0) and (0, 1) in it.  Quadruple every point, which
uses up one of each; then average once along every other vector, in any order.
"""

from collections import Counter
from collections.abc import Sequence
from functools import partial

from subdivision.continuity import checked_vectors
from subdivision.limit_nets import box_weights, net_limit
from subdivision.passes import Pass, Vector, at_once, average, quadruple, room, told
from subdivision.rows import Connectivity, Grid
from subdivision.scheme import Scheme
from subdivision.words import phrase

THREE_DIRECTION_LINEAR = ((1, 0), (0, 1), (1, 1))
THREE_DIRECTION_QUARTIC = THREE_DIRECTION_LINEAR * 2
ZWART_POWELL = ((1, 0), (0, 1), (1, 1), (1, -1))


def box_spline(vectors: Sequence[Vector]) -> Scheme:
    """The scheme of a vector set; the passes run in the order given.

    Raises
    ------
    TopologyError
        For vectors that are not pairs of integers, a zero vector, or a missing (1, 0) or (0, 1).
    """
    chosen = checked_vectors(vectors)
    rest = averaged(chosen)
    passes: list[Pass] = [quadruple, *map(average, rest)]
    return Scheme(
        name="box-spline " + " ".join(f"{a},{b}" for a, b in chosen),
        title=phrase("Box spline of {vectors}", vectors=" ".join(f"({a},{b})" for a, b in chosen)),
        paper="WW02",
        refuses=partial(_refuses, lost=shortened(chosen)),
        tellings={
            "in order": lambda t: told(t, passes),
            "in reverse": lambda t: told(t, [quadruple, *map(average, reversed(rest))]),
            "stencils": lambda t: at_once("all passes", told(t, passes)),
        },
        limit=lambda t: net_limit(t, box_weights(chosen)),
    )


def averaged(vectors: Sequence[Vector]) -> list[Vector]:
    """The vectors left for averaging: all but one (1, 0) and one (0, 1)."""
    left = Counter(vectors) - Counter([(1, 0), (0, 1)])
    rest = []
    for v in vectors:
        if left[v]:
            left[v] -= 1
            rest.append(v)
    return rest


def in_order(passes: Sequence[Vector]) -> tuple[Vector, ...]:
    """The vector set whose averaging passes are these, in this order: ``averaged`` gives them back."""
    return (*passes, (1, 0), (0, 1))


def other_orders(passes: Sequence[Vector]) -> tuple[tuple[Vector, ...], ...]:
    """Other orders of some passes: in reverse, then that turned round and round; none where all are alike."""
    behind = tuple(reversed(passes))
    turned = (behind[k:] + behind[:k] for k in range(len(behind)))
    return tuple(dict.fromkeys(order for order in turned if order != tuple(passes)))


def shortened(vectors: Sequence[Vector]) -> Vector:
    """By how many rows and columns a step shortens an open net, before it doubles what is left."""
    rest = averaged(vectors)
    return sum(abs(a) for a, _ in rest), sum(abs(b) for _, b in rest)


def _refuses(t: Connectivity, lost: tuple[int, int]) -> str:
    return room(t, lost) if isinstance(t, Grid) else "it is not a rectangular net"

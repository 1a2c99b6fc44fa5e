"""Changes of the leading box spline of the laboratory: its vectors, the order of its passes, what lies over it.

Vectors are told by number: the averaging passes first, in order, then the (1, 0) and the (0, 1) that quadrupling
uses up.  Each change raises ``TopologyError`` with a sentence where it is refused; the state is then as it was.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from types import MappingProxyType

import numpy as np

from app.laboratory.bench import lab_in, put, same_place
from app.laboratory.lab import Lab, Rule, affordable
from app.state import State, at_stop, settle, stops
from subdivision import Grid, Mesh, TopologyError
from subdivision.catalogue import Vectors
from subdivision.continuity import checked_vectors
from subdivision.passes import Vector
from subdivision.schemes import THREE_DIRECTION_LINEAR, THREE_DIRECTION_QUARTIC, ZWART_POWELL
from subdivision.schemes.box_spline import in_order, other_orders, shortened
from subdivision.words import phrase

MOST_VECTORS, LONGEST = 24, 9
"""How many vectors a set has, and how far they go along s and t, at most."""

BASIS, BASIS_LEVELS = "Basis net", 4

QUICK = 20_000
"""Up to so many faces after the last level a change keeps up with the hand; a basis net has no more."""

SMALLEST = 5
"""Points a side of a basis net at least, so that other schemes take it too."""

HALF = 1.1
"""Half the side of a basis net; the point that is lifted is 1 high."""

PRESETS: Mapping[str, Vectors] = MappingProxyType({
    "Constant": ((1, 0), (0, 1)),
    "Bilinear": ((1, 0), (0, 1)) * 2,
    "Biquadratic": ((1, 0), (0, 1)) * 3,
    "Bicubic": ((1, 0), (0, 1)) * 4,
    "3-direction linear": THREE_DIRECTION_LINEAR,
    "3-direction quartic": THREE_DIRECTION_QUARTIC,
    "Zwart-Powell": ZWART_POWELL,
})  # fmt: skip


def numbered(rule: Rule) -> Vectors:
    """The vectors of a rule by their numbers; () where it is no box spline."""
    return in_order(rule.passes) if rule.vectors else ()


def preset_of(vectors: Vectors) -> str:
    """The name of a vector set; empty where it has none."""
    return next((name for name, known in PRESETS.items() if Counter(known) == Counter(vectors)), "")


def is_quick(state: State) -> bool:
    """Whether a change of the vectors keeps up with the hand."""
    lab = lab_in(state)
    return lab.levels <= affordable(lab, QUICK)


def add_vector(state: State, vector: Vector) -> State:
    """One pass more, along a vector; the last one."""
    *passes, s, t = _vectors(state)
    return _become(state, (*passes, vector, s, t))


def remove_vector(state: State, number: int) -> State:
    """One vector less."""
    vectors = _vectors(state)
    return _become(state, vectors[:number] + vectors[number + 1 :])


def move_vector(state: State, number: int, to: Vector) -> State:
    """Another vector in the place of one; (0, 0) takes it away."""
    if to == (0, 0):
        return remove_vector(state, number)
    vectors = _vectors(state)
    return _become(state, (*vectors[:number], to, *vectors[number + 1 :]))


def move_pass(state: State, number: int, to: int) -> State:
    """A pass at another place of the order, in which the story then tells them; quadrupling stays the first."""
    *passes, s, t = _vectors(state)
    if not (0 <= number < len(passes) and 0 <= to < len(passes)):
        return state
    passes.insert(to, passes.pop(number))
    return _become(state, (*passes, s, t), telling="in order")


def preset(state: State, name: str) -> State:
    """A vector set by its name."""
    return _become(state, PRESETS[name])


def overlay(state: State, number: int) -> State:
    """Another order of the passes beside this one, and laid over it: number 1, 2, ...; 0: none."""
    lab = lab_in(state)
    if number and not other_orders(lab.rules[0].passes):
        raise TopologyError("all passes are along one vector, so there is no other order; add another vector")
    return put(state, replace(lab, overlay=number))


def basis(state: State) -> State:
    """The basis function on the table: a flat net, one point of it lifted, as large as the vectors need."""
    lab = replace(lab_in(state), levels=BASIS_LEVELS)
    return put(state, _resized(lab, _vectors(state)))


def basis_net(vectors: Vectors) -> Mesh:
    """A flat net, 0 but for its middle point, which is 1: what it tends to is the box spline.

    Every point is at its own parameter, as ``continuity.placement`` has it, counted from the middle one's and scaled
    to a side of 2.2.  All of the box spline's support lies within what the steps leave of it.
    """
    directions = set(vectors)
    return _lifted(shortened(vectors), (1, 1) in directions and not directions & {(1, -1), (-1, 1)})


@lru_cache(maxsize=64)
def _lifted(lost: Vector, diagonal: bool) -> Mesh:
    n_s, n_t = (max(2 * each + 3, SMALLEST) for each in lost)
    i, j = np.meshgrid(np.arange(n_s) - n_s // 2, np.arange(n_t) - n_t // 2, indexing="ij")
    height = (i == 0) & (j == 0)
    points = np.stack([i, j, height], axis=-1).reshape(-1, 3) * (*(HALF / (max(n_s, n_t) // 2),) * 2, 1.0)
    return Mesh(Grid(n_s, n_t, diagonal=diagonal), points)


def _vectors(state: State) -> Vectors:
    return numbered(_lead(state))


def _lead(state: State) -> Rule:
    rule = lab_in(state).rules[0]
    if not rule.vectors:
        raise TopologyError("the rule that leads is no box spline; choose it as the scheme of the first pane")
    return rule


def _become(state: State, vectors: Vectors, telling: str | None = None) -> State:
    """The leading rule with other vectors, told as it was; a basis net is then as large as they need."""
    _require(vectors)
    lab, lead = lab_in(state), _lead(state)
    told = telling or ("stencils" if lead.told == "stencils" else "in order")
    rule = replace(lead, parameters=(vectors,), telling=told)
    other = replace(lab, rules=(rule, *lab.rules[1:]))
    if not other_orders(rule.passes):
        other = replace(other, overlay=0)
    if lab.name == BASIS:
        held = affordable(lab, QUICK) <= lab.levels < BASIS_LEVELS  # by vectors that were longer
        other = replace(other, levels=BASIS_LEVELS) if held else other
        return _at_same_place(state, put(state, _resized(other, vectors)))
    try:
        return put(state, other)
    except TopologyError as refusal:
        raise TopologyError(
            phrase("{refusal}; or take the basis function, whose net grows with them", refusal=refusal)
        ) from None


def _require(vectors: Vectors) -> None:
    checked_vectors(vectors)
    if len(vectors) > MOST_VECTORS:
        raise TopologyError(phrase("{most} vectors are as many as can be; remove one first", most=MOST_VECTORS))
    if (longest := max(abs(x) for v in vectors for x in v)) > LONGEST:
        raise TopologyError(
            phrase("a vector goes {most} steps along s or t at most, not {longest}", most=LONGEST, longest=longest)
        )


def _resized(lab: Lab, vectors: Vectors) -> Lab:
    """The basis net of the vectors on the table, for as many levels as it can be played; other rules that fit it."""
    control = basis_net(vectors)
    rules = tuple(rule for rule in lab.rules if rule.scheme.accepts(rule.bounded(control).topology))
    found = replace(lab, name=BASIS, control=control, rules=rules)
    if (most := affordable(found, QUICK)) < 1:
        raise TopologyError("the basis function of these vectors needs a net too large to play; take shorter ones")
    return replace(found, levels=min(found.levels, most))


def _at_same_place(before: State, after: State) -> State:
    """The new story where the old one stood, on another control object; the end stays the end."""
    before = settle(before)
    old, new = stops(before.lesson), stops(after.lesson)
    is_end = (before.beat, before.at) == (old[-1].beat, old[-1].at)
    return at_stop(after, new[-1] if is_end else new[same_place(before, after.lesson)])

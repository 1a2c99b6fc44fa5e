"""Changes of the laboratory, as functions from a state to the next one.

Each of them raises ``TopologyError`` with a sentence where a scheme refuses what it is given; the
state is then as it was.
"""

from contextlib import suppress
from dataclasses import replace
from fractions import Fraction

from app.laboratory.lab import (
    COMFORT,
    LABORATORY,
    MOST_PANES,
    Lab,
    Rule,
    affordable,
    lab_of,
    lesson_of,
    natural_family,
    require_playable,
)
from app.state import State, at_stop, choose, settle, stop_level, stops, valence_of
from lessons.script import Lesson
from subdivision import Boundary, Mesh, TopologyError, shapes
from subdivision.catalogue import FAMILIES, Value, suiting
from subdivision.extraordinary import PULL_RULES, pull_rule
from subdivision.words import phrase

FIRST = "cube"


def is_open(state: State) -> bool:
    """Whether the laboratory is what is shown."""
    return state.lesson.id == LABORATORY


def enter(state: State) -> State:
    """Show the laboratory as it was left."""
    return put(state, lab_in(state))


def take(state: State, name: str) -> State:
    """A shape of the house, under the rule in use if it takes it, else the one that suits it."""
    return replace_control(state, shapes.SHAPES[name](), name)


def replace_control(state: State, control: Mesh, name: str) -> State:
    """Another control object, under those of the rules that take it."""
    lab = lab_in(state)
    kept = tuple(rule for rule in lab.rules if rule.scheme.accepts(control.topology))
    found = Lab(name, control, kept or (Rule(natural_family(control)),), max(lab.levels, 1))
    return put(state, replace(found, levels=min(found.levels, max(affordable(found, COMFORT), 1))))


def choose_family(state: State, pane: int, family: str) -> State:
    """Another scheme in a pane, at its usual parameters."""
    return _with_rule(state, pane, replace(lab_in(state).rules[pane], family=family, parameters=(), telling=""))


def choose_parameter(state: State, pane: int, number: int, value: Value) -> State:
    """Another value of a scheme's parameter in a pane."""
    rule = lab_in(state).rules[pane]
    values = (*rule.values[:number], value, *rule.values[number + 1 :])
    return _with_rule(state, pane, replace(rule, parameters=values))


def turn_parameter(state: State, pane: int, number: int, by: int) -> State:
    """A parameter some steps up or down, held within its limits."""
    rule = lab_in(state).rules[pane]
    parameter = FAMILIES[rule.family].parameters[number]
    return choose_parameter(state, pane, number, parameter.next(rule.values[number], by))


def pull(state: State, way: Fraction) -> State:
    """The leading rule goes so far of the way at extraordinary vertices; the same valence stays looked at."""
    rule = lab_in(state).rules[0]
    if rule.family not in PULL_RULES:
        raise TopologyError(
            phrase("{scheme} has no pull; let the vertex rule be varied first", scheme=rule.scheme.title)
        )
    return choose_parameter(choose(state, valence=valence_of(state)), 0, 0, way)


def vary_vertex_rule(state: State) -> State:
    """The leading rule as one of the family with a pull, which does the same at the valence that is looked at.

    A pull that is no fraction is taken to the nearest step.
    """
    rule, n = lab_in(state).rules[0], valence_of(state)
    found = pull_rule(rule.scheme)
    if found is None:
        raise TopologyError(phrase("{scheme} is not told by how far a vertex is pulled", scheme=rule.scheme.title))
    there = found.pull_of(rule.scheme, n)
    step = FAMILIES[found.family].parameters[0].step
    way = there if isinstance(there, Fraction) else round(float(there) / step) * step
    return _with_rule(choose(state, valence=n), 0, replace(rule, family=found.family, parameters=(way,)))


def choose_telling(state: State, pane: int, telling: str) -> State:
    """The same matrix in other stages."""
    return _with_rule(state, pane, replace(lab_in(state).rules[pane], telling=telling))


def choose_boundary(state: State, pane: int, boundary: Boundary) -> State:
    """What happens where the control object ends."""
    return _with_rule(state, pane, replace(lab_in(state).rules[pane], boundary=boundary))


def turn_until(state: State, pane: int, by: int) -> State:
    """A pane beside the leading one rests a level earlier or later; at the last level it goes along."""
    lab = lab_in(state)
    rule = lab.rules[pane]
    until = min(max((rule.until or lab.levels) + by, 1), lab.levels)
    return _with_rule(state, pane, replace(rule, until=0 if until == lab.levels else until))


def compare(state: State) -> State:
    """One pane more: the next scheme that takes the control object."""
    lab = lab_in(state)
    if len(lab.rules) == MOST_PANES:
        raise TopologyError(phrase("{most} panes are as many as can be compared", most=MOST_PANES))
    families = [family.name for family in suiting(lab.control.topology)]
    free = [name for name in families if name not in {rule.family for rule in lab.rules}] or families
    rule = replace(lab.rules[0], family=free[0], parameters=(), telling="")
    with suppress(TopologyError):  # told alike, if it can be
        return put(state, replace(lab, rules=(*lab.rules, replace(rule, telling=lab.rules[0].told))))
    return put(state, replace(lab, rules=(*lab.rules, rule)))


def drop(state: State, pane: int) -> State:
    """One pane less; the last one stays."""
    lab = lab_in(state)
    rules = lab.rules[:pane] + lab.rules[pane + 1 :]
    return put(state, replace(lab, rules=rules)) if rules else state


def set_levels(state: State, levels: int) -> State:
    """As many levels.

    Raises
    ------
    TooLarge
        If a picture has no room for them.
    """
    lab = replace(lab_in(state), levels=max(levels, 1))
    require_playable(lab)
    return put(state, lab)


def put(state: State, lab: Lab, *, stays: bool = False) -> State:
    """Show a laboratory: another control object from its first stop, the same one where the story stands.

    One that is the same but for an edit also ``stays`` there, seen as it was.
    """
    for rule in lab.rules:
        rule.scheme.require(rule.bounded(lab.control).topology)
    levels = min(lab.levels, affordable(lab))
    lab = lab if levels == lab.levels else replace(lab, levels=levels)
    state = settle(state)
    is_same = is_open(state) and state.lab is not None and state.lab.control is lab.control
    lesson = lesson_of(lab)
    there = stops(lesson)[same_place(state, lesson) if is_same or stays else 0]
    edits, picked = (state.edits, state.picked) if is_same else ((), None)
    after = at_stop(state, there, lab=lab, lesson=lesson, edits=edits, picked=picked)
    return replace(after, turn=state.turn) if stays else after


def same_place(state: State, there: Lesson) -> int:
    """The stop of the new story that is as far as the state was: the first, the same stage, else the same level."""
    old, new = stops(state.lesson), stops(there)
    here = next(k for k, s in enumerate(old) if (s.beat, s.at) >= (state.beat, state.at))
    if here == 0 or len(old) == len(new):
        return here
    level = stop_level(state.lesson, old[here])
    return max(k for k, s in enumerate(new) if stop_level(there, s) <= level)


def lab_in(state: State) -> Lab:
    """The laboratory as it stands or was left; the first time with a cube on the table."""
    return state.lab or lab_of(shapes.SHAPES[FIRST](), FIRST)


def _with_rule(state: State, pane: int, rule: Rule) -> State:
    lab = lab_in(state)
    return put(state, replace(lab, rules=(*lab.rules[:pane], rule, *lab.rules[pane + 1 :])))

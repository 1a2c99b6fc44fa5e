"""Editing the control object of the laboratory, as functions from a state to the next one.

Each of them raises ``TopologyError`` with a sentence where an edit would break the object, or no scheme would take
what is left; the state is then as it was.  What was dragged belongs to the object from then on.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np

from app.laboratory import bench
from app.laboratory.lab import Lab, Rule, natural_family
from app.state import Picked, State
from subdivision import Grid, Mesh, Polyline, Topology, TopologyError, editing
from subdivision.arrays import Floats
from subdivision.catalogue import suiting
from subdivision.topology import INFINITELY_SHARP
from subdivision.words import phrase

Change: TypeAlias = Callable[[Mesh], Mesh]

EDITED = "edited "
"""What the name of an object that is no longer as it was taken begins with."""

STEP = 0.5
"""From one sharpness to the next."""


def control(state: State) -> Mesh:
    """The control object as it stands, with what was dragged."""
    lab = bench.lab_in(state)
    return (
        Mesh(lab.control.topology, state.trace(state.now.lead).control.points) if bench.is_open(state) else lab.control
    )


def edit(state: State, change: Change, picked: Picked | None = None) -> State:
    """The laboratory with its control object changed, at its place in the story; ``picked`` is then chosen.

    Rules that take the object stay; where none does, the one that suits it is used.
    """
    lab = bench.lab_in(state)
    after = change(control(state))
    name = lab.name if lab.name.startswith(EDITED) else f"{EDITED}{lab.name}"
    edited = Lab(name, after, fitting_rules(lab.rules, after), max(lab.levels, 1), lab.overlay)
    return replace(bench.put(state, edited, stays=True), picked=picked)


def fitting_rules(rules: Sequence[Rule], mesh: Mesh) -> tuple[Rule, ...]:
    """Those of the rules that take a control object, told as they can be; else the one that suits it best.

    Raises
    ------
    TopologyError
        Of the first rule, if no scheme at all takes the object.
    """
    if kept := tuple(_told(rule, mesh) for rule in rules if rule.scheme.accepts(rule.bounded(mesh).topology)):
        return kept
    suits = [family.name for family in suiting(mesh.topology)]
    if not suits:
        rules[0].scheme.require(mesh.topology)
    natural = natural_family(mesh)
    return (_told(Rule(natural if natural in suits else suits[0]), mesh),)


def _told(rule: Rule, mesh: Mesh) -> Rule:
    """The rule with another telling where its own does not suit a control object that its scheme takes."""
    try:
        rule.scheme.step(rule.bounded(mesh).topology, rule.told)
    except TopologyError:
        others = [telling for telling in rule.scheme.tellings if telling != rule.told]
        return replace(rule, telling=others[0]) if others else rule
    return rule


def replaced_rule(before: State, after: State) -> str:
    """The sentence about a scheme that an edit has put in the place of the old ones; empty where one stayed."""
    if before.lab is None or after.lab is None:
        return ""
    old, new = before.lab.rules, after.lab.rules
    if {rule.family for rule in old} & {rule.family for rule in new}:
        return ""
    reason = old[0].scheme.refuses(old[0].bounded(after.lab.control).topology)
    return phrase(
        "{old} cannot subdivide this: {reason}. {new} takes over.",
        old=old[0].scheme.title,
        reason=reason,
        new=new[0].scheme.title,
    )


# -- what is picked ---------------------------------------------------------------------------


def extended(picked: Picked | None, more: Picked) -> Picked | None:
    """What is picked with one part more, or one less if it is there; parts of another kind take its place."""
    if picked is None or picked.kind != more.kind:
        return more
    kept = tuple(k for k in picked.numbers if k not in more.numbers)
    numbers = kept if len(kept) < len(picked.numbers) else (*kept, *more.numbers)
    return replace(more, numbers=numbers) if numbers else None


def insertion(state: State) -> tuple[int, Floats] | None:
    """After which point of the polygon, and where, another one would be inserted: on the picked edge, or at an end."""
    lab, picked = state.lab, state.picked
    if lab is None or picked is None or not isinstance(t := lab.control.topology, Polyline):
        return None
    points, last = control(state).points, picked.numbers[-1]
    if picked.kind == "edge":
        a, b = t.ends[last]
        return int(a), (1 - picked.along) * points[a] + picked.along * points[b]
    if t.closed or t.n_vertices < 2 or last not in (0, t.n_vertices - 1):
        return None
    beside = 1 if last == 0 else last - 1
    return last - (last == 0), 2 * points[last] - points[beside]


def insert(state: State) -> State:
    """One point more on the picked edge of a polygon, or beyond its picked end; it is picked then."""
    if (found := insertion(state)) is None:
        raise TopologyError("no edge or end of a polygon is picked; click the edge where the point shall be")
    after, at = found
    return edit(state, partial(editing.insert_point, after=after, at=at), Picked("vertex", (after + 1,)))


def delete(state: State) -> State:
    """The object without the picked points of a polygon, or the picked faces of a mesh."""
    picked = state.picked
    if picked is None:
        raise TopologyError("nothing is picked; click a face, or a point of a polygon, to delete it")
    if picked.kind == "face":
        return edit(state, partial(editing.delete_faces, faces=picked.numbers))
    if picked.kind == "edge":
        raise TopologyError("an edge goes with its faces; click one of them, or a point of a polygon, to delete it")
    if isinstance(control(state).topology, Polyline):
        return edit(state, partial(editing.remove_points, points=picked.numbers))
    t = control(state).topology
    if isinstance(t, Topology):
        faces = np.unique(t.face[np.isin(t.origin, picked.numbers)]).tolist()
        return edit(state, partial(editing.delete_faces, faces=faces))
    raise TopologyError("points of a net are not deleted one by one; change its number of points in s or t instead")


def fill(state: State) -> State:
    """The hole along the picked edge filled; the new face is picked."""
    edge = _edge_of(state, "click an edge of the hole to fill")
    n_faces = control(state).topology.n_faces
    return edit(state, partial(editing.fill_hole, edge=edge), Picked("face", (n_faces,)))


def flip(state: State) -> State:
    """The picked edge flipped; the new one is picked."""
    edge = _edge_of(state, "click an edge between two triangles to flip it")
    before = {tuple(sorted(pair)) for pair in control(state).topology.ends.tolist()}
    after = edit(state, partial(editing.flip_edge, edge=edge))
    pairs = [tuple(sorted(pair)) for pair in control(after).topology.ends.tolist()]
    new = [k for k, pair in enumerate(pairs) if pair not in before]
    return replace(after, picked=Picked("edge", tuple(new)))


def triangulate(state: State) -> State:
    """All faces cut into triangles."""
    return edit(state, editing.triangulate)


def turn_over(state: State) -> State:
    """All faces seen from the other side."""
    return edit(state, editing.turn_over)


# -- sharpness --------------------------------------------------------------------------------


def sharpness(state: State) -> float | None:
    """That of the picked edges or vertices, the largest; None: nothing picked has one."""
    t, picked = control(state).topology, state.picked
    if picked is None or picked.kind == "face" or not isinstance(t, Topology):
        return None
    values = t.edge_sharpness if picked.kind == "edge" else t.vertex_sharpness
    return float(values[list(picked.numbers)].max())


def sharpen(state: State, value: float) -> State:
    """The picked edges or vertices as sharp as ``value``; they stay picked."""
    picked = state.picked
    if picked is None or picked.kind == "face":
        raise TopologyError("no edge or vertex is picked; click one to make it sharp")
    if picked.kind == "edge":
        change: Change = partial(editing.sharpen_edges, edges=picked.numbers, sharpness=value)
    else:
        change = partial(editing.sharpen_vertices, vertices=picked.numbers, sharpness=value)
    return edit(state, change, picked)


def turn_sharpness(state: State, by: int) -> State:
    """What is picked sharper or smoother by some steps, held from 0 to 10."""
    value = (sharpness(state) or 0.0) + by * STEP
    return sharpen(state, min(max(value, 0.0), INFINITELY_SHARP))


# -- the whole object -------------------------------------------------------------------------


def close(state: State, closed: bool) -> State:
    """The polygon closed or opened."""
    return edit(state, partial(editing.set_closed, closed=closed))


def turn_size(state: State, by_s: int, by_t: int) -> State:
    """The net with more or fewer points each way."""
    t = _grid(state)
    return edit(state, partial(editing.resize, n_s=t.n_s + by_s, n_t=t.n_t + by_t))


def wrap(state: State, wrap_s: bool, wrap_t: bool) -> State:
    """The net with opposite sides joined or parted."""
    return edit(state, partial(editing.set_wrap, wrap_s=wrap_s, wrap_t=wrap_t))


def turn_fan(state: State, by_valence: int, by_rings: int) -> State:
    """The fan with another valence or number of rings."""
    fan = editing.fan_of(control(state)) or (0, 0)
    return edit(state, partial(editing.refan, valence=fan[0] + by_valence, rings=fan[1] + by_rings))


def _edge_of(state: State, mend: str) -> int:
    picked = state.picked
    if picked is None or picked.kind != "edge":
        raise TopologyError(phrase("no edge is picked; {mend}", mend=mend))
    return picked.numbers[-1]


def _grid(state: State) -> Grid:
    t = control(state).topology
    if not isinstance(t, Grid):
        raise TopologyError("this is no net, so it has no rows and columns; take one")
    return t

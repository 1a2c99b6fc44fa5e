"""Box splines in the laboratory: vectors come and go, passes change places, and no order changes a point."""

from collections import Counter
from fractions import Fraction
from itertools import permutations

import numpy as np
import pytest

import lessons
from app import state as st
from app.draw import lattice
from app.draw.compose import compose
from app.draw.layout import overlay
from app.draw.picture import Diagram
from app.draw.primitives import Stroke
from app.draw.theme import THEMES
from app.laboratory import bench, boxlab
from app.sessions import keeping
from subdivision import TopologyError
from subdivision.continuity import mask, placement
from subdivision.schemes import ZWART_POWELL, box_spline
from subdivision.schemes.box_spline import averaged, in_order, other_orders

AWAY = st.start(lessons.find("14"))
NET = bench.choose_family(bench.take(bench.enter(AWAY), "net"), 0, "box-spline")
BASIS = boxlab.basis(NET)


def vectors(state):
    return boxlab.numbered(state.lab.rules[0])


def ends(state, pane=0):
    view = st.last(state).now.views[pane]
    return state.trace(view).points[-1]


def coefficients(table):
    """The mask's coefficients that are not 0, sorted."""
    return sorted(c for row in table.rows for c in row if c)


def test_vectors_are_added_moved_and_removed_and_the_others_stay_where_they_are():
    one = boxlab.preset(NET, "3-direction linear")
    assert vectors(one) == ((1, 1), (1, 0), (0, 1))
    two = boxlab.add_vector(one, (1, -1))
    assert vectors(two) == ((1, 1), (1, -1), (1, 0), (0, 1))
    assert vectors(boxlab.move_vector(two, 0, (0, 1))) == ((0, 1), (1, -1), (1, 0), (0, 1))
    assert vectors(boxlab.remove_vector(two, 0)) == ((1, -1), (1, 0), (0, 1))
    assert vectors(boxlab.move_vector(two, 1, (0, 0))) == vectors(one)


@pytest.mark.parametrize(("change", "sentence"), [
    (lambda s: boxlab.remove_vector(boxlab.preset(s, "Zwart-Powell"), 2), r"needs \(1,0\) at least once"),
    (lambda s: boxlab.move_vector(boxlab.preset(s, "Zwart-Powell"), 3, (2, 1)), r"needs \(0,1\) at least once"),
    (lambda s: boxlab.add_vector(s, (0, 0)), "average every point with itself"),
    (lambda s: boxlab.add_vector(s, (10, 0)), "9 steps along s or t at most, not 10"),
    (lambda s: boxlab.add_vector(s, (4, 4)), "shortens it by 7.*basis function"),
    (lambda s: boxlab.overlay(boxlab.preset(s, "3-direction linear"), 1), "no other order"),
    (lambda s: boxlab.preset(bench.choose_family(s, 0, "tensor-product"), "Bilinear"), "no box spline"),
])  # fmt: skip
def test_what_cannot_be_is_refused_in_a_sentence_and_nothing_changes(change, sentence):
    before = NET.lab
    with pytest.raises(TopologyError, match=sentence):
        change(NET)
    assert NET.lab is before


def test_a_set_has_at_most_as_many_vectors_as_a_session_keeps():
    wide = bench.take(NET, "torus-net")
    for _ in range(boxlab.MOST_VECTORS - len(vectors(wide))):
        wide = boxlab.add_vector(wide, (1, 1))
    with pytest.raises(TopologyError, match="24 vectors are as many"):
        boxlab.add_vector(wide, (1, 1))


@pytest.mark.parametrize("name", boxlab.PRESETS)
def test_presets_are_known_again_in_any_order(name):
    state = boxlab.preset(NET, name)
    assert boxlab.preset_of(state.vectors) == name
    assert Counter(vectors(state)) == Counter(boxlab.PRESETS[name])
    if len(vectors(state)) > 3:
        assert boxlab.preset_of(vectors(boxlab.move_pass(state, 0, 1))) == name


def test_the_order_of_the_passes_changes_the_story_and_no_final_point():
    state = boxlab.preset(NET, "Zwart-Powell")
    state = boxlab.add_vector(state, (0, 1))
    first = ends(state)
    for number, to in ((0, 2), (2, 1), (1, 0)):
        moved = boxlab.move_pass(state, number, to)
        names = [stage.name for stage in moved.now.lead.trace.step(0).stages]
        assert names != [stage.name for stage in state.now.lead.trace.step(0).stages]
        assert names[0] == "quadruple"
        assert [f"average {spelled}" for spelled in map(spell, moved.lab.rules[0].passes)] == names[1:]
        assert np.abs(ends(moved) - first).max() < 1e-12
        state = moved


def spell(v):
    return {(1, 0): "s", (0, 1): "t"}.get(v, f"({v[0]},{v[1]})")


def test_a_story_in_reverse_is_reordered_as_it_is_seen_and_stencils_become_stages():
    state = boxlab.preset(NET, "Zwart-Powell")
    behind = bench.choose_telling(state, 0, "in reverse")
    assert behind.lab.rules[0].passes == ((1, -1), (1, 1))
    assert boxlab.add_vector(behind, (1, 0)).lab.rules[0].passes == ((1, -1), (1, 1), (1, 0))
    at_once = bench.choose_telling(state, 0, "stencils")
    assert len(boxlab.add_vector(at_once, (1, 0)).now.lead.trace.step(0).stages) == 1
    assert len(boxlab.move_pass(at_once, 0, 1).now.lead.trace.step(0).stages) == 3


def test_a_pass_beyond_the_list_stays():
    assert boxlab.move_pass(NET, 0, 9) is NET
    assert boxlab.move_pass(NET, -1, 0) is NET


def test_an_order_is_found_again_from_its_vector_set():
    for order in permutations([(1, 0), (1, 1), (1, 0), (0, 1)]):
        assert tuple(averaged(in_order(order))) == order
    assert other_orders([(1, 1)] * 3) == ()
    orders = other_orders([(1, 0), (0, 1), (1, 1)])
    assert orders[0] == ((1, 1), (0, 1), (1, 0))
    assert all(Counter(order) == Counter(orders[0]) for order in orders)


@pytest.mark.parametrize("number", [1, 2, 3])
@pytest.mark.parametrize("name", ["Bicubic", "3-direction quartic", "Zwart-Powell"])
def test_two_orders_overlay_to_zero(name, number):
    state = st.last(boxlab.overlay(boxlab.preset(NET, name), number))
    mine, other, both = state.now.views
    assert (both.trace, both.over.trace) == (mine.trace, other.trace)
    assert [s.name for s in mine.trace.stages] != [s.name for s in other.trace.stages]
    assert np.abs(ends(state) - ends(state, 1)).max() < 1e-12
    assert compose(state).panes[2].reading == "largest difference 0"
    dragged = st.drag(state, 12, (0.3, 0.4, 2.0))
    assert compose(dragged).panes[2].reading == "largest difference 0"
    assert np.abs(ends(dragged) - ends(state)).max() > 0.1


def test_on_the_way_the_two_nets_have_other_shapes_and_that_is_said():
    state = st.start(boxlab.overlay(boxlab.preset(NET, "Zwart-Powell"), 1).lesson)
    bicubic = boxlab.overlay(boxlab.preset(NET, "Bicubic"), 1)
    there = st.at_stop(bicubic, st.stops(bicubic.lesson)[2])
    assert compose(there).panes[2].reading == "on the way: 9 × 10 and 10 × 9 points"
    assert compose(state).panes[2].reading == "largest difference 0"
    apart = compose(st.at_stop(state, st.stops(state.lesson)[2])).panes[2].reading
    assert apart.startswith("on the way: largest difference 0.")


def test_an_overlay_follows_the_vectors_and_goes_where_there_is_no_other_order():
    state = boxlab.overlay(boxlab.preset(NET, "Zwart-Powell"), 1)
    more = boxlab.add_vector(state, (1, 0))
    assert more.lab.other.passes == more.lab.rules[0].passes[::-1]
    less = boxlab.preset(state, "3-direction linear")
    assert (less.lab.overlay, len(less.now.views)) == (0, 1)
    assert len(boxlab.overlay(state, 0).now.views) == 1
    assert len(bench.compare(bench.compare(bench.compare(state))).now.views) == 6


def test_the_basis_net_tells_the_mask_after_one_level():
    """One point lifted by 1 and subdivided once leaves the mask's coefficients, whatever the vectors."""
    state = BASIS
    for change in [*boxlab.PRESETS, (2, -1), (-1, 1), (1, 1)]:
        state = boxlab.preset(state, change) if isinstance(change, str) else boxlab.add_vector(state, change)
        told = state.now.lead.trace
        assert state.lab.name == boxlab.BASIS
        heights = told.points[told.begins(1)][:, 2]
        found = sorted(Fraction(h).limit_denominator(2**20) for h in heights if abs(h) > 1e-12)
        assert found == coefficients(mask(state.vectors))
        rim = told.mesh_at(len(told.stages)).topology.ends[told.mesh_at(len(told.stages)).topology.boundary]
        assert np.abs(ends(state)[rim.ravel(), 2]).max() == 0  # all of the support is there


@pytest.mark.parametrize("name", ["Bilinear", "Bicubic", "3-direction quartic", "Zwart-Powell"])
def test_the_points_of_a_basis_net_stay_at_their_parameters(name):
    chosen = boxlab.PRESETS[name]
    mesh, levels = boxlab.basis_net(chosen), 3
    told = bench.set_levels(boxlab.basis(boxlab.preset(NET, name)), levels).now.lead.trace
    points, tau = told.points[-1], placement(chosen)
    n_s, n_t = mesh.topology.shape
    scale = boxlab.HALF / (max(n_s, n_t) // 2)
    middle = np.array([n_s // 2, n_t // 2]) + tau
    behind = np.array([sum(max(0, -v[k]) for v in averaged(chosen)) * (2**levels - 1) for k in (0, 1)])
    shape = told.topology_at(len(told.stages)).shape
    number = np.stack(np.divmod(np.arange(len(points)), shape[1]), axis=1) + behind
    assert np.abs(points[:, :2] / scale + middle - (number + tau) / 2**levels).max() < 1e-12


def test_the_basis_keeps_its_place_in_the_story_while_its_vectors_change():
    state = st.last(BASIS)
    for name in ("Bilinear", "Zwart-Powell", "Bicubic"):
        state = boxlab.preset(state, name)
        assert st.level_of(state) == state.lab.levels == boxlab.BASIS_LEVELS
    at_two = st.turn_level(st.turn_level(state, -1), -1)
    assert st.level_of(boxlab.preset(at_two, "Bilinear")) == 2


def test_long_vectors_cost_levels_only_while_they_are_there():
    long = boxlab.add_vector(st.last(BASIS), (5, 3))
    assert st.level_of(long) == long.lab.levels < boxlab.BASIS_LEVELS
    short = boxlab.move_vector(long, 4, (0, 0))
    assert st.level_of(short) == short.lab.levels == boxlab.BASIS_LEVELS
    chosen = bench.set_levels(BASIS, 1)
    assert boxlab.add_vector(chosen, (1, 0)).lab.levels == 1


def test_a_net_too_large_to_play_is_refused():
    state = BASIS
    for _ in range(3):
        state = boxlab.add_vector(state, (9, 9))
    with pytest.raises(TopologyError, match="too large to play"):
        boxlab.add_vector(state, (9, 9))
    assert affordable_faces(state) <= boxlab.QUICK


def affordable_faces(state):
    return st.last(state).now.lead.trace.stages[-1].topology.n_faces


def test_faces_are_counted_as_the_steps_leave_them():
    for name in boxlab.PRESETS:
        state = boxlab.preset(BASIS, name)
        assert affordable_faces(state) <= boxlab.QUICK
        more = box_spline(state.vectors).step(state.now.lead.trace.stages[-1].topology).topology.n_faces
        assert state.lab.levels == boxlab.BASIS_LEVELS or more > boxlab.QUICK


def test_sessions_and_links_keep_vectors_order_and_overlay():
    state = boxlab.overlay(boxlab.move_pass(boxlab.add_vector(BASIS, (1, -1)), 0, 3), 2)
    state = st.choose(st.last(state), lattice=True)
    there = keeping.restored(keeping.kept(state))
    assert (there.lab.rules, there.lab.levels, there.lab.overlay) == (state.lab.rules, state.lab.levels, 2)
    assert (there.vectors, there.options.lattice) == (state.vectors, True)
    assert np.array_equal(ends(there), ends(state))
    assert len(there.now.views) == 3


# -- the picture ------------------------------------------------------------------------------


@pytest.mark.parametrize("theme", THEMES)
def test_the_picture_shows_an_arrow_for_every_vector_and_a_box_for_every_coefficient(theme):
    state = st.choose(boxlab.add_vector(boxlab.preset(NET, "Zwart-Powell"), (1, 1)), lattice=True, theme=theme)
    content = compose(state).panes[-1].content
    assert isinstance(content, Diagram)
    arrows = {(k.x1, -k.y1) for k in content.links if k.is_arrow}
    assert arrows == set(state.vectors)
    words = [note.text for note in content.notes]
    assert words.count("×2") == 1
    assert "degree 3    alpha 3    $C^{1}$" in words
    assert "mask, every box ×\u00a01/8" in words
    table = mask(state.vectors)
    shown = sorted(Fraction(int(b.texts[0]), 8) for b in content.boxes if b.texts[0])
    assert shown == coefficients(table)
    least = 1000 / 45
    flat = overlay(compose(state), 1920, 1080)
    assert all(text.size >= least * 1.08 - 1e-9 for text in flat if hasattr(text, "text"))
    assert sum(isinstance(each, Stroke) for each in flat) >= 3 * len(arrows)


def test_the_mask_is_drawn_as_the_lattice_is_s_to_the_right_and_t_upwards():
    rows, below = lattice.over_one(mask([(1, 0), (0, 1), (1, 1)]))
    assert (rows, below) == ([[0, 1, 1], [1, 2, 1], [1, 1, 0]], 2)


def test_the_picture_is_beside_the_matrices_and_nowhere_else_than_with_a_box_spline():
    both = compose(st.choose(NET, lattice=True, matrix=True)).panes
    assert [pane.rect[3] for pane in both] == [1.0, 0.5, 0.5]
    cube = st.choose(bench.take(NET, "cube"), lattice=True)
    assert len(compose(cube).panes) == 1
    assert len(compose(st.choose(AWAY, lattice=True)).panes) == len(compose(AWAY).panes)


def test_a_limit_that_jumps_is_said_not_drawn_as_smooth():
    state = st.choose(boxlab.preset(NET, "Constant"), lattice=True)
    assert "the limit jumps" in compose(state).panes[-1].content.notes[-2].text
    assert lattice.facts(ZWART_POWELL).endswith("$C^{1}$")

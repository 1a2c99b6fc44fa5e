"""The laboratory as values: any object, any rule, any telling; refusals leave everything as it was."""

from dataclasses import replace

import numpy as np
import pytest

import lessons
from app import state as st
from app.draw.compose import compose
from app.draw.surface import SHOWS
from app.laboratory import bench
from app.laboratory.lab import BUDGET, MOST_PANES, Lab, Rule, affordable, lab_of, lesson_of
from subdivision import Boundary, Mesh, TopologyError, catalogue, shapes, subdivide

START = st.start(lessons.find("14"))


def shown(state, pane=0):
    view = state.now.views[pane]
    return state.trace(view).mesh_at(int(view.at(state.progress)))


@pytest.mark.parametrize("name", shapes.SHAPES)
def test_every_shape_is_told_to_its_last_stage_and_ends_where_the_engine_ends(name):
    state = st.last(bench.take(bench.enter(START), name))
    rule = state.lab.rules[0]
    direct = subdivide(rule.bounded(state.lab.control), rule.scheme, state.lab.levels)
    assert np.abs(shown(state).points - direct.points).max() < 1e-12
    assert all(beat.text for beat in state.lesson.beats)


@pytest.mark.parametrize("name", ["cube", "octahedron", "net", "hook", "duck"])
def test_every_suiting_scheme_and_every_telling_of_it_end_in_the_same_points(name):
    state = bench.take(bench.enter(START), name)
    for family in catalogue.suiting(state.lab.control.topology):
        chosen = bench.choose_family(state, 0, family.name)
        ends = []
        for telling in chosen.lab.rules[0].scheme.tellings:
            try:
                ends.append(shown(st.last(bench.choose_telling(chosen, 0, telling))).points)
            except TopologyError:
                continue  # a telling may refuse what the scheme takes, with a sentence
        assert ends
        assert max(np.abs(points - ends[0]).max() for points in ends) < 1e-12


def test_the_laboratory_is_left_and_found_again_as_it_was():
    state = bench.set_levels(bench.take(bench.enter(START), "octahedron"), 3)
    away = st.open_lesson(state, lessons.find("12"))
    again = bench.enter(away)
    assert bench.is_open(again)
    assert again.lab.control is state.lab.control
    assert again.lab.levels == 3


def test_changing_a_number_keeps_the_place_of_the_story_and_what_was_dragged():
    state = st.drag(st.last(bench.take(bench.enter(START), "net")), 3, (0.0, 0.0, 2.0))
    other = bench.turn_parameter(state, 0, 0, -1)
    assert other.lab.rules[0].values == (2, 3)
    assert other.edits == state.edits
    assert st.level_of(other) == st.level_of(state)


def test_panes_play_in_step_and_end_each_level_together():
    state = bench.compare(bench.compare(bench.enter(START)))
    assert len(state.now.views) == 3
    for stop in st.stops(state.lesson):
        there = st.at_stop(state, stop)
        ends = [view.at(there.progress) for view in there.now.views]
        assert all(at == int(at) for at in ends)
        if all(at in (0, len(v.trace.stages)) for at, v in zip(ends[:1], there.now.views[:1], strict=True)):
            assert all(at in (0, len(v.trace.stages)) for at, v in zip(ends, there.now.views, strict=True))
    full = bench.compare(state)
    with pytest.raises(TopologyError, match=f"{MOST_PANES} panes"):
        bench.compare(full)
    assert len(bench.drop(full, 0).lab.rules) == 3


def test_a_pane_beside_is_told_alike_where_it_can_be_and_in_its_own_way_where_not():
    cube, octahedron = (bench.compare(bench.take(bench.enter(START), name)) for name in ("cube", "octahedron"))
    assert [rule.told for rule in cube.lab.rules] == ["centroid averaging"] * 2
    assert len(octahedron.now.views) == 2


def test_a_pane_may_rest_at_an_earlier_level_beside_the_one_that_goes_on():
    state = bench.turn_until(bench.set_levels(bench.compare(bench.enter(START)), 3), 1, -1)
    assert [len(set(view.trace.levels)) for view in state.now.views] == [3, 2]
    state = st.last(state)
    full, early = (subdivide(rule.bounded(state.lab.control), rule.scheme, n)
                   for rule, n in zip(state.lab.rules, (3, 2), strict=True))
    assert np.abs(shown(state, 0).points - full.points).max() < 1e-12
    assert np.abs(shown(state, 1).points - early.points).max() < 1e-12
    assert "to level 2" in state.now.views[1].title
    assert bench.turn_until(state, 1, 1).lab.rules[1].until == 0


def test_what_a_scheme_refuses_is_said_and_nothing_changes():
    state = bench.enter(START)
    before = state.lab
    with pytest.raises(TopologyError, match="triangle"):
        bench.choose_family(state, 0, "loop")
    assert state.lab is before


def test_more_levels_than_a_picture_has_room_for_are_refused_with_the_numbers_and_the_most_that_fit():
    state = bench.enter(START)
    most = affordable(state.lab)
    deepest = bench.set_levels(state, most)
    assert deepest.lab.levels == most
    faces = deepest.lab.rules[0].scheme.faces_after(state.lab.control.surface, most)
    assert faces <= BUDGET < 4 * faces
    said = f"{most + 1} levels would make {4 * faces:,} faces, and a picture has room for 130,000; .* at most {most}"
    with pytest.raises(TopologyError, match=said):
        bench.set_levels(state, most + 1)
    with pytest.raises(TopologyError, match=f"99 levels .* choose at most {most}"):
        bench.set_levels(state, 99)


def test_boundary_rules_change_the_rim_only():
    state = st.last(bench.take(bench.enter(START), "quad-sheet"))
    kept, rounded = (
        shown(st.last(bench.choose_boundary(state, 0, rule)))
        for rule in (Boundary.EDGE_AND_CORNER, Boundary.EDGE)
    )
    apart = np.abs(kept.points - rounded.points).max(axis=1) > 1e-12
    assert apart.any()
    assert kept.surface.on_boundary[apart].all() or apart.sum() < len(apart) / 2


def test_equal_laboratories_tell_equal_stories():
    mesh = shapes.cube()
    first, second = (lesson_of(bench.put(START, st_lab(mesh)).lab) for _ in range(2))
    assert [b.text for b in first.beats] == [b.text for b in second.beats]
    assert first.beats[0].lead.trace is second.beats[0].lead.trace  # told once


def st_lab(mesh: Mesh):
    return Lab("mine", mesh, (Rule("catmull-clark"),), 1)


@pytest.mark.parametrize("fan", [shapes.quad_fan, shapes.triangle_fan])
def test_where_the_rule_hides_every_face_the_picture_says_so(fan):
    lab = lab_of(fan(6), "fan")
    lab = replace(lab, rules=(replace(lab.rules[0], boundary=Boundary.HIDE),))
    assert lab.rules[0].bounded(lab.control).topology.hidden.all()
    state = st.start(lesson_of(lab))
    for kind in ("", *SHOWS):
        shown = st.choose(st.last(state), surface_shows=kind)
        for at in np.arange(0.0, shown.at + 0.5, 0.5):
            (pane,) = compose(replace(shown, at=float(at))).panes
            assert not pane.content.faces
            assert "All faces touch the boundary" in pane.content.remark
            assert np.isfinite(pane.content.camera.position).all()
            assert pane.content.lines or kind

"""Edits of the laboratory's object: its rules and its place in the story stay where they can; what is picked shows."""

import numpy as np
import pytest

import lessons
from app import state as st
from app.draw.compose import compose
from app.draw.theme import LIGHT
from app.laboratory import bench, editing
from app.sessions.keeping import kept, restored
from app.state import Picked
from subdivision import TopologyError, shapes

CUBE = bench.enter(st.start(lessons.find("14")))


def picked(state, kind, *numbers):
    return st.pick(state, Picked(kind, numbers))


def scene(state):
    return compose(state).scenes[0]


def test_what_was_dragged_belongs_to_the_object_once_it_is_edited():
    state = editing.triangulate(st.drag(CUBE, 7, (3.0, 3.0, 3.0)))
    assert state.edits == ()
    assert state.lab.control.points[7].tolist() == [3, 3, 3]
    assert state.lab.name == "edited cube"
    assert editing.turn_over(state).lab.name == "edited cube"


def test_all_rules_that_take_the_object_stay_in_their_panes():
    state = bench.choose_family(bench.compare(CUBE), 1, "catmull-clark")
    after = editing.triangulate(state)
    assert [rule.family for rule in after.lab.rules] == ["catmull-clark"]
    assert editing.replaced_rule(state, after) == ""
    other = editing.triangulate(CUBE)
    assert other.lab.rules[0].family == "triangle-centroid"
    said = editing.replaced_rule(CUBE, other)
    assert said.startswith("Centroid averaging of quads cannot subdivide this: face 0 has 3 corners")


def test_a_rule_is_told_otherwise_where_its_telling_does_not_suit_the_object():
    state = bench.choose_telling(bench.choose_family(CUBE, 0, "catmull-clark"), 0, "centroid averaging")
    after = editing.triangulate(state)
    assert after.lab.rules[0].family == "catmull-clark"
    assert after.lab.rules[0].told != "centroid averaging"


def test_an_edit_that_no_scheme_would_take_is_refused_and_nothing_changes():
    small = editing.turn_size(bench.take(CUBE, "net"), -1, -1)
    before = small.lab
    with pytest.raises(TopologyError, match="cannot subdivide this"):
        editing.turn_size(small, -1, -1)
    assert small.lab is before
    assert before.control.topology.shape == (4, 4)


def test_an_edit_of_a_finer_level_stays_there_seen_from_where_it_was():
    state = st.turn_view(st.last(CUBE), st.first(CUBE).turn.rotated(0.3, 0.1))
    after = editing.sharpen(picked(state, "edge", 0), 4)
    assert (after.beat, after.at, after.turn) == (state.beat, state.at, state.turn)
    assert after.picked == Picked("edge", (0,))


def test_an_edited_object_is_kept_in_a_session():
    state = editing.delete(picked(editing.sharpen(picked(CUBE, "edge", 0, 5), 2.5), "face", 3))
    again = restored(kept(state))
    assert again.lab.control.surface.loops() == state.lab.control.surface.loops()
    assert np.array_equal(again.lab.control.surface.edge_sharpness, state.lab.control.surface.edge_sharpness)


def test_another_object_or_lesson_has_nothing_picked():
    state = picked(CUBE, "face", 1)
    assert bench.take(state, "torus").picked is None
    assert st.open_lesson(state, lessons.find("12")).picked is None
    assert bench.choose_family(state, 0, "catmull-clark").picked == state.picked


def test_picked_faces_are_tinted_and_over_a_finer_level_outlined():
    tinted = scene(picked(CUBE, "face", 1, 5)).faces
    assert [len(f.sizes) for f in tinted] == [4, 2]
    state = picked(st.choose(st.last(CUBE), control=True), "face", 1, 5)
    outline = scene(state).lines[-1]
    assert outline.colour == LIGHT.selection
    assert len(outline.pairs) == 8
    ends = outline.points[outline.pairs]
    assert np.abs(ends).max() == pytest.approx(1)  # in the planes of the faces
    hidden = scene(picked(st.last(CUBE), "face", 1, 5))
    assert all(lines.colour != LIGHT.selection for lines in hidden.lines)


def test_the_sharper_an_edge_the_heavier_it_is_until_it_wears_off():
    widths = []
    for value in (0.5, 1, 3, 10):
        state = editing.sharpen(picked(CUBE, "edge", 2), value)
        inked = [each for each in scene(st.pick(state, None)).lines if each.colour == LIGHT.ink]
        assert [each.pairs.tolist() for each in inked] == [[shapes.cube().topology.ends[2].tolist()]]
        widths.append(inked[0].width)
    assert widths == sorted(set(widths))


def test_parts_of_one_kind_are_picked_together():
    one = Picked("edge", (3,))
    two = editing.extended(one, Picked("edge", (5,), 0.2))
    assert two == Picked("edge", (3, 5), 0.2)
    assert editing.extended(two, Picked("edge", (3,))).numbers == (5,)
    assert editing.extended(one, one) is None
    assert editing.extended(two, Picked("face", (1,))) == Picked("face", (1,))

"""Walking through a lesson: transitions are functions, so a test is an equality."""

import pytest

import lessons
from app import state as st
from app.laboratory.lab import lab_of, lesson_of
from app.state import Stop
from lessons.turn import REST
from subdivision import shapes

CUBE = lessons.find("14")


def where(state):
    return state.beat, state.at, state.goal


def run(state):
    """Play to the end of what is playing, in frames of a twentieth of a stage."""
    for _ in range(10_000):
        if not state.is_playing:
            return state
        state = st.tick(state, 0.05)
    raise AssertionError("playing never rests")


def test_going_on_plays_each_stage_and_rests_at_its_end():
    state, visited = st.start(CUBE), [st.stops(CUBE)[0]]
    while where(after := run(st.forward(state))) != where(state):
        state = after
        visited.append(Stop(state.beat, state.at))
    assert tuple(visited) == st.stops(CUBE)


def test_going_back_visits_the_same_stops_in_reverse():
    state, visited = st.last(st.start(CUBE)), [st.stops(CUBE)[-1]]
    while where(after := run(st.back(state))) != where(state):
        state = after
        visited.append(Stop(state.beat, state.at))
    assert tuple(reversed(visited)) == st.stops(CUBE)


def test_going_on_while_playing_is_there_at_once():
    playing = st.tick(st.forward(st.start(CUBE)), 0.3)
    twice = st.forward(playing)
    assert twice.goal == st.stops(CUBE)[2]
    assert run(twice).at == st.stops(CUBE)[2].at


def test_playing_through_goes_on_to_the_end():
    state = run(st.forward(st.choose(st.start(CUBE), through=True)))
    assert Stop(state.beat, state.at) == st.stops(CUBE)[-1]


def test_the_timeline_and_the_state_agree():
    state = st.start(CUBE)
    for segment in st.segments(CUBE):
        for part in (0.25, 0.5, 1.0):
            axis = segment.begin + part * (segment.end - segment.begin)
            there = st.seek(state, axis)
            assert there.beat == segment.beat
            if segment.start < segment.stop:
                assert st.axis_of(there) == pytest.approx(axis)
    assert [s.ends_level for s in st.segments(CUBE)].count(True) == 3


def test_levels_are_walked_up_and_down():
    state = st.start(CUBE)
    up = [st.level_of(state := st.turn_level(state, 1)) for _ in range(3)]
    down = [st.level_of(state := st.turn_level(state, -1)) for _ in range(3)]
    assert (up, down) == ([1, 2, 3], [2, 1, 0])


def test_dragging_a_corner_moves_everything_downstream_and_rebuilds_no_stage():
    state = st.last(st.start(CUBE))
    dragged = st.drag(state, 7, (3.0, 3.0, 3.0))
    before, after = state.trace(state.now.lead), dragged.trace(dragged.now.lead)
    assert after.stages is before.stages
    influence = before.whole.influence(7)
    moved = after.points[-1] - before.points[-1]
    assert abs(moved - influence[:, None] * 2.0).max() < 1e-12


def test_the_ends_of_a_lesson_hold():
    state = st.start(CUBE)
    assert where(st.back(state)) == where(state)
    assert where(st.forward(st.last(state))) == where(st.last(state))
    assert where(st.first(st.last(state))) == where(state)


def test_a_clicker_goes_through_the_whole_lecture_and_all_the_way_back():
    every = lessons.all_lessons()
    places = [(lesson.id, stop) for lesson in every for stop in st.stops(lesson)]
    state = st.start(every[0])
    for way, rest in ((st.onward, places[1:]), (st.homeward, places[-2::-1])):
        for place in rest:
            state = st.settle(way(state))
            assert (state.lesson.id, Stop(state.beat, state.at)) == place
        assert where(way(state)) == where(state)
    alone = st.last(st.start(lesson_of(lab_of(shapes.cube(), "cube"))))
    assert where(st.onward(alone)) == where(alone)


def test_another_camera_and_another_lesson_are_seen_as_they_are_meant_to_be():
    turned = st.turn_view(st.start(CUBE), REST.rotated(0.2, 0.1).zoomed(2.0))
    for stop in st.stops(CUBE):
        there = st.at_stop(turned, stop)
        assert there.turn == (turned.turn if there.now.look == turned.now.look else REST)
    assert st.open_lesson(turned, lessons.find("12")).turn == REST
    assert st.open_lesson(turned, CUBE).turn == turned.turn
    assert st.seek(turned, st.segments(CUBE)[0].end).turn == turned.turn

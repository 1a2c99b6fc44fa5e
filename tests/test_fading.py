"""Reduced motion: between two stages nothing moves, and both pictures are there as much as they should."""

from dataclasses import replace

import numpy as np
import pytest

import lessons
from app import state as st
from app.draw.compose import compose
from app.draw.fading import faded
from app.draw.film import stage_shots
from app.draw.picture import Diagram, Scene
from app.draw.seen import seen
from app.sessions.keeping import kept, restored

CUBE = st.choose(st.start(lessons.find("14")), reduced_motion=True)
MOVING = next(s for s in st.segments(CUBE.lesson) if s.name == "geometry")


def within(part):
    """The cube ``part`` of the way through the stage that moves its points."""
    return replace(st.at_stop(CUBE, st.Stop(MOVING.beat, MOVING.stop)), at=MOVING.stop - 1 + part)


def same_points(one, other):
    return all(np.array_equal(a.points, b.points) for a, b in zip(one, other, strict=True))


@pytest.mark.parametrize("part", [0.01, 0.3, 0.5, 0.7, 0.99])
def test_nothing_moves(part):
    before, now, after = compose(within(0)), faded(within(part)), compose(within(1))
    for kind in ("faces", "lines", "markers"):
        ends = [each for picture in (before, after) for each in getattr(picture.panes[0].content, kind)]
        assert same_points(getattr(now.panes[0].content, kind), ends)
    cameras = [picture.panes[0].content.camera for picture in (before, now, after)]
    assert len({(*camera.position, *camera.focal, camera.scale) for camera in cameras}) == 1


@pytest.mark.parametrize(("part", "left", "come"), [(0.25, 1, 0.3125), (0.5, 1, 1), (0.75, 0.3125, 1)])
def test_one_of_both_is_always_whole(part, left, come):
    now = faded(within(part)).panes[0].content
    assert [faces.opacity for faces in now.faces] == pytest.approx([left, come])


def test_a_stop_is_the_picture_itself():
    for stop in st.stops(CUBE.lesson):
        there = st.at_stop(CUBE, stop)
        moved = compose(st.choose(there, reduced_motion=False))
        assert [type(pane.content) for pane in faded(there).panes] == [type(pane.content) for pane in moved.panes]
        assert faded(there).legend == moved.legend
        assert len(faded(there).panes[0].content.markers) == len(moved.panes[0].content.markers)


def test_without_the_option_everything_moves():
    moving = st.choose(within(0.5), reduced_motion=False)
    assert same_points(faded(moving).panes[0].content.markers, compose(moving).panes[0].content.markers)
    assert not same_points(faded(moving).panes[0].content.faces, compose(within(0)).panes[0].content.faces)


@pytest.mark.parametrize("lesson", lessons.all_lessons(), ids=lambda each: each.id)
def test_every_lesson_fades(lesson):
    for segment in [s for s in st.segments(lesson) if s.stop > s.start][:3]:
        there = st.at_stop(st.choose(st.start(lesson), reduced_motion=True), st.Stop(segment.beat, segment.stop))
        for pane in faded(replace(there, at=segment.stop - 0.4)).panes:
            assert isinstance(pane.content, Scene | Diagram)


def test_films_fade_too():
    there = st.at_stop(CUBE, st.Stop(MOVING.beat, MOVING.stop))
    shown = [seen(shot.state).panes[0].content.faces for shot in stage_shots(there, rate=4)]
    assert max(map(len, shown)) == 2
    assert {faces.points.tobytes() for each in shown for faces in each} == {
        faces.points.tobytes() for each in (shown[0], shown[-1]) for faces in each
    }


def test_it_belongs_to_who_looks_and_not_to_the_picture():
    assert not restored(kept(CUBE)).options.reduced_motion
    assert restored(kept(CUBE), CUBE.options).options.reduced_motion

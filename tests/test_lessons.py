"""Every claim a lesson makes is true, every beat can be drawn, and the words fit the picture."""

import re
import string
from dataclasses import replace
from itertools import product

import numpy as np
import pytest

import lessons
from app.draw.compose import compose
from app.draw.layout import overlay
from app.draw.picture import Diagram, Scene
from app.draw.primitives import Text
from app.draw.theme import NAMES, THEMES
from app.state import at_stop, choose, drag, seek, segments, start, stops
from lessons.script import EXTRAORDINARY, Lesson
from subdivision import Role

LESSONS = lessons.all_lessons()
COLOURS = re.compile(r"\b(red|orange|yellow|green|blue|purple|black|white|vermilion)\b")
MEANINGS = {role.name.lower(): name for role, name in NAMES.items()} | {EXTRAORDINARY: "original"}

each_lesson = pytest.mark.parametrize("lesson", LESSONS, ids=lambda each: each.id)


def test_the_whole_lecture_is_there():
    assert [each.id[:9] for each in LESSONS if each.id.startswith("figure")] == [f"figure_{n:02}" for n in range(1, 26)]
    assert {each.section for each in LESSONS} >= {"1 Motivation", "4.2 Triangles: stencils", "Exercises"}
    assert sum(each.id.startswith("exercise") for each in LESSONS) >= 8


@each_lesson
def test_every_claim_is_true_whatever_the_knobs_stand_at(lesson: Lesson):
    names = [knob.name for knob in lesson.knobs]
    for values in product(*(range(knob.least, knob.most + 1) for knob in lesson.knobs)):
        turned = lesson.turned(**dict(zip(names, values, strict=True)))
        assert [beat.text for beat in turned.beats if not beat.claim] == [], values


@each_lesson
def test_captions_are_short_and_say_only_colours_that_are_there(lesson: Lesson):
    for beat in lesson.beats:
        assert 0 < len(beat.text) <= 130, beat.text
        assert beat.text[-1] in ".?"
        assert beat.formula.count("$") in (0, 2)
        shown = {entry.text for entry in compose(_ends(lesson, beat)).legend}
        assert COLOURS.findall(beat.text) == [], "a colour is named by what it means: {centroid}"
        for meaning in re.findall(r"{(.*?)}", beat.text):
            assert MEANINGS[meaning] in shown, beat.text


@each_lesson
def test_every_beat_composes_at_every_stop_and_between_in_every_theme(lesson: Lesson):
    state = start(lesson)
    for theme in THEMES:
        state = choose(state, theme=theme)
        for stop in stops(lesson):
            _is_whole(compose(at_stop(state, stop)))
    for segment in segments(lesson):
        for part in (0.01, 0.3, 0.5, 0.99):
            _is_whole(compose(seek(state, segment.begin + part * (segment.end - segment.begin))))


@each_lesson
def test_a_pointed_out_stencil_shows_one_weight_for_each_contributor(lesson: Lesson):
    for beat in lesson.beats:
        panes = compose(_ends(lesson, beat)).panes
        for view, pane in zip(beat.views, panes, strict=True):
            if view.stencil is not None and isinstance(pane.content, Scene):
                assert len(pane.content.labels) == len(view.stencil.terms) + len(view.marks)


@each_lesson
def test_every_weight_of_a_lessons_stencil_is_on_the_picture(lesson: Lesson):
    for beat in lesson.beats:
        picture = compose(_ends(lesson, beat))
        for view, pane in zip(beat.views, picture.panes, strict=True):
            if view.stencil is not None and isinstance(pane.content, Scene):
                only = replace(picture, panes=(pane,), title="", caption="", formula="", corner="", legend=())
                words = [each.text for each in overlay(only, 1920, 1080) if isinstance(each, Text)]
                wanted = [label.text for label in pane.content.labels]
                assert sorted(w for w in words if w in wanted) == sorted(wanted)


@each_lesson
def test_stages_continue_where_the_beat_before_ended(lesson: Lesson):
    """Nothing jumps: a beat starts where its trace stood, unless it shows another trace or looks back on this one."""
    for before, after in zip(lesson.beats, lesson.beats[1:], strict=False):
        looks_back = len({view.stop for view in after.views if view.trace is after.lead.trace}) > 1
        if before.lead.trace is after.lead.trace and not looks_back:
            assert after.start == before.stop


@each_lesson
def test_what_a_formula_and_a_caption_say_needs_no_missing_glyph(lesson: Lesson):
    allowed = set(string.printable) | set("χ×→←∑·−≤’¹²")
    for beat in lesson.beats:
        assert set(beat.text + beat.formula) <= allowed


def test_a_lesson_is_found_by_its_number_and_a_wrong_one_is_told():
    assert lessons.find("14").id == "figure_14_cube"
    assert lessons.find("figure_05").id.startswith("figure_05")
    with pytest.raises(KeyError, match="there is no lesson '99'"):
        lessons.find("99")


def _ends(lesson: Lesson, beat):
    b = lesson.beats.index(beat)
    return at_stop(start(lesson), [s for s in stops(lesson) if s.beat == b][-1])


def _is_whole(picture):
    assert picture.panes
    for pane in picture.panes:
        content = pane.content
        assert isinstance(content, Scene | Diagram)
        if isinstance(content, Scene):
            assert content.markers or content.lines
            for markers in content.markers:
                assert len(markers.points) == len(markers.radius) == len(markers.opacity) == len(markers.ids)
                assert (markers.radius > 0).all()
        else:
            assert content.boxes or content.dots


@pytest.mark.parametrize(("number", "centroids"), [("12", 4), ("22", 24)])
def test_a_fragment_marks_helpers_only_on_its_own_faces_while_they_come_and_while_they_go(number: str, centroids: int):
    lesson = lessons.find(number)
    coming, going = (s for s in segments(lesson) if s.name in ("centroids", "geometry"))
    for segment in (coming, going):
        picture = compose(seek(start(lesson), (segment.begin + segment.end) / 2))
        assert [len(m.points) for m in picture.scenes[0].markers if m.name == "centroid"] == [centroids]
        assert "centroid" in [entry.text for entry in picture.legend]


def test_strokes_spread_from_four_corners_to_each_centroid_and_from_three_centroids_to_each_cube_corner():
    lesson = lessons.find("14")
    coming, going = (next(s for s in segments(lesson) if s.name == name) for name in ("centroids", "geometry"))
    green = THEMES["light"].roles[Role.CENTROID]

    def strokes(segment, part):
        scene = compose(seek(start(lesson), segment.begin + part)).scenes[0]
        (found,) = (lines for lines in scene.lines if lines.colour == green)
        return found

    assert len(strokes(coming, 0.3).pairs) == 24 * 4
    assert len(strokes(going, 0.3).pairs) == 8 * 3 + 12 * 4  # face points stay where they are
    spread = [strokes(coming, part) for part in (0.1, 0.5)]
    early, late = (np.linalg.norm(np.diff(s.points[s.pairs], axis=1)) for s in spread)
    assert early < late


def test_dragging_a_point_moves_no_camera():
    state = at_stop(start(lessons.find("14")), stops(lessons.find("14"))[3])
    before, after = (compose(s).scenes[0].camera for s in (state, drag(state, 0, (-9.0, -9.0, -9.0))))
    assert np.array_equal(before.position, after.position)
    assert np.array_equal(before.focal, after.focal)

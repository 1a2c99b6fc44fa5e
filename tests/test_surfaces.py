"""Surfaces on pictures: what is drawn thins out as meshes get dense, and panels show what a figure's caption names."""

from dataclasses import fields, replace
from random import Random

import numpy as np
import pytest
from scipy import ndimage

import lessons
from app.draw.compose import compose, is_heavy
from app.draw.geometry import facets, normals
from app.draw.isophotes import LIGHT, STEP, isophotes
from app.draw.picture import Faces, Picture
from app.draw.pointed import ACROSS
from app.draw.raster import image
from app.draw.solid import CUBE
from app.draw.surface import BRISK, SHOWS
from app.draw.theme import THEMES
from app.laboratory import bench
from app.state import Options, Spot, at_stop, choose, forward, settle, start, stops, tick
from lessons.script import Lesson
from subdivision import Role, Trace, continuity

LEVELS = {"8": [0, 1, 2], "9": [0, 1, 2, 3, 4, 5], "14": [0, 1, 2, 3], "15": [0, 1, 2, 3], "24": [0, 1, 2, 3],
          "25": [0, 1, 2, 3]}  # fmt: skip
STAGES = ["12", "13", "22", "23"]


def last(number: str, **options: bool) -> Picture:
    lesson = lessons.find(number)
    return compose(at_stop(start(lesson, Options(**options)), stops(lesson)[-1]))


def parts(picture: Picture) -> list[int]:
    """How many elements each part of each scene has."""
    groups = (group for scene in picture.scenes for group in (scene.faces, scene.lines, scene.markers, scene.labels))
    return [size for group in groups for size in (len(group), *(len(getattr(each, "points", "")) for each in group))]


def level_of(told: Trace, at: float) -> int:
    return next(level for level in range(told.levels[-1] + 2) if told.begins(level) == at)


@pytest.mark.parametrize("number", LEVELS)
def test_the_last_picture_shows_every_level_from_the_control_object_on_with_one_camera(number: str):
    views = lessons.find(number).beats[-1].views
    assert [level_of(view.trace, view.stop) for view in views] == LEVELS[number]
    cameras = [scene.camera for scene in last(number).scenes]
    assert all(np.array_equal(each.position, cameras[0].position) for each in cameras)


@pytest.mark.parametrize("number", STAGES)
def test_the_last_picture_shows_the_three_panels_of_the_caption(number: str):
    views = lessons.find(number).beats[-1].views
    assert [view.stop for view in views] == [0, 1, 3]
    assert [view.title[:3] for view in views] == ["(a)", "(b)", "(c)"]


@pytest.mark.parametrize("number", ["13", "23"])
@pytest.mark.parametrize("valence", range(3, 13))
def test_a_fan_is_well_told_at_every_valence(number: str, valence: int):
    lesson: Lesson = lessons.find(number).turned(valence=valence)
    assert [beat.text for beat in lesson.beats if not beat.claim or len(beat.text) > 130] == []


def test_in_haste_a_coarser_level_stands_for_a_dense_one_with_the_strokes_and_markers_of_that():
    lesson = lessons.find("9")
    states = [at_stop(start(lesson, Options(control=True)), stop) for stop in stops(lesson)]
    state = next(each for each in states if is_heavy(each))
    fine, coarse = compose(state).scenes[-1], compose(state, is_hasty=True).scenes[-1]
    assert len(coarse.faces[0].sizes) <= BRISK < len(fine.faces[0].sizes)
    assert coarse.camera == fine.camera
    assert [lines.width for lines in coarse.lines] == pytest.approx([lines.width for lines in fine.lines])
    assert [m.name for m in coarse.markers] == [m.name for m in fine.markers]
    for ours, theirs in zip(coarse.markers, fine.markers, strict=True):
        assert ours.radius == pytest.approx(theirs.radius, rel=0.1)
    rested = next(each for each in states if not is_heavy(each))
    assert len(compose(rested, is_hasty=True).scenes[0].lines[0].pairs) == len(compose(rested).scenes[0].lines[0].pairs)


def test_a_dense_level_draws_its_outline_and_no_net():
    edges = [sum(len(lines.pairs) for lines in scene.lines) for scene in last("9").scenes]
    assert edges[1] == 208  # level 1: all
    assert edges[5] == 4 * 98  # level 5: four sides of 99 points


def test_dense_levels_mark_extraordinary_vertices_alone():
    marked = [sum(len(m.points) for m in scene.markers) for scene in last("15").scenes]
    assert marked == [32, 32, 32, 32]


def test_a_marked_vertex_is_a_blob_of_its_colour_and_no_blob_is_anything_else():
    lesson = lessons.find("13")
    topology = at_stop(start(lesson), stops(lesson)[1])
    picture = compose(topology)
    for role in (Role.EDGE, Role.FACE):
        colour = THEMES["light"].roles[role]
        (markers,) = (m for m in picture.scenes[0].markers if m.colour == colour)
        assert blobs(image(picture, 1280, 720, words=False), colour) == len(markers.points) + 1  # and the legend's


def blobs(pixels, colour) -> int:
    """How many spots of a picture have a colour's hue, in whatever light."""
    seen = pixels[..., :3] / 255.0
    hue = seen / np.maximum(np.linalg.norm(seen, axis=2, keepdims=True), 1e-9)
    alike = (hue @ (np.array(colour) / np.linalg.norm(colour)) > 0.985) & (np.ptp(seen, axis=2) > 0.45)
    labels, found = ndimage.label(alike)
    sizes = ndimage.sum_labels(alike, labels, range(1, found + 1))
    return int((np.asarray(sizes) >= 25).sum())


def test_a_cube_keeps_flat_sides_and_a_fine_tube_is_shaded_as_if_it_were_round():
    assert np.allclose(facets(CUBE).normals[:24], np.repeat(normals(CUBE), 4, axis=0))
    angles = 2 * np.pi * np.arange(72) / 72
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.vstack([np.column_stack([ring, np.full(72, z)]) for z in (0.0, 1.0)])
    sides = np.array([[k, (k + 1) % 72, 72 + (k + 1) % 72, 72 + k] for k in range(72)]).ravel()
    tube = Faces(points, np.full(72, 4), sides, (0, 0, 0))
    assert np.allclose(facets(tube).normals[: 4 * 72, :2], points[sides, :2])


def test_isophotes_lie_where_the_surface_leans_by_whole_steps():
    angles = np.linspace(0, np.pi, 200)
    points = np.array([(np.cos(a), y, np.sin(a)) for a in angles for y in (0.0, 1.0)])
    k = 2 * np.arange(199)
    arch = Faces(points, np.full(199, 4), np.stack([k, k + 2, k + 3, k + 1], axis=1).ravel(), (0, 0, 0))
    lines = isophotes(arch, (0, 0, 0), 1.0)
    towards = lines.points * [1, 0, 1] @ LIGHT
    lean = np.degrees(np.arccos(np.abs(towards)))
    off = np.abs(lean / STEP - np.round(lean / STEP)) * STEP
    assert len(lines.pairs) > 0
    assert off.max() < 0.5


def test_the_two_surfaces_of_figure_10_cost_the_same_and_differ_by_one_in_continuity():
    module = lessons.find("10").script.__globals__
    quadratic, quartic = module["QUADRATIC"], module["QUARTIC"]
    assert len(quadratic) == len(quartic)
    assert continuity.smoothness(quartic) - continuity.smoothness(quadratic) == 1


@pytest.mark.parametrize("seed", range(4))
def test_whatever_is_switched_on_together_anywhere_in_a_lesson_makes_a_picture_alike_in_every_theme(seed):
    rng = Random(seed)
    switches = [each.name for each in fields(Options) if isinstance(each.default, bool)]
    for _ in range(100):
        options = Options(**{name: rng.random() < 0.5 for name in switches}, surface_shows=rng.choice([*SHOWS]))
        state = start(rng.choice(lessons.all_lessons()), replace(options, across=rng.choice([*ACROSS])))
        for _ in range(rng.randrange(12)):
            state = settle(forward(state))
        moving = tick(forward(state), rng.random())
        for each in (state, moving):
            light, dark = (compose(choose(each, theme=theme)) for theme in ("light", "dark"))
            assert light.panes, (state.lesson.id, state.beat, state.at, state.options)
            assert parts(light) == parts(dark), (state.lesson.id, state.beat, state.at, state.options)


def test_a_picture_with_balls_beside_the_eye_is_drawn_without_opengl():
    normal = Options(control=True, surface_shows="normals")
    state = bench.set_levels(bench.take(bench.enter(start(lessons.find("14"), normal)), "quad-fan"), 1)
    far = replace(state, edits=((24, (999999.0, 0.34, -0.12)),), focus=Spot(0, 0, 24))
    pixels = image(compose(at_stop(far, stops(far.lesson)[3])), 480, 270, words=False, flat=True)
    assert pixels.shape == (270, 480, 4)
    assert len(np.unique(pixels.reshape(-1, 4), axis=0)) > 9

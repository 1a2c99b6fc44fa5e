"""Stencils as they are drawn: every weight beside its disc and over nothing else, at every valence."""

from fractions import Fraction

import numpy as np
import pytest

import lessons
from app.draw.compose import compose
from app.draw.dotted import spread
from app.draw.layout import overlay, pane_areas, part_at
from app.draw.picture import Diagram, Shape
from app.draw.primitives import LEAST, Text
from app.state import at_stop, choose, start, stops
from lessons.script import Kind
from subdivision import Mesh, shapes, subdivide, trace
from subdivision.limit import limit_points, to_limit
from subdivision.roundness import ball_at, radius_ratio
from subdivision.schemes import CATMULL_CLARK, LOOP, QUAD_CENTROID

ABOUT_STENCILS = [x for x in lessons.all_lessons() if any(v.kind is Kind.STENCIL for b in x.beats for v in b.views)]
TURNED = [each.turned(valence=n) for each in ABOUT_STENCILS if each.knobs and each.knobs[0].name == "valence"
          for n in range(3, 13)]
DRAWN = [each for each in ABOUT_STENCILS if each not in TURNED] + TURNED

each_valence = pytest.mark.parametrize("n", range(3, 13))
each_drawn = pytest.mark.parametrize("lesson", DRAWN, ids=lambda each: f"{each.id}-{each.values}")


def pictures(lesson, theme="light"):
    for stop in stops(lesson):
        if any(view.kind is Kind.STENCIL for view in lesson.beats[stop.beat].views):
            yield compose(at_stop(choose(start(lesson), theme=theme), stop))


@each_drawn
@pytest.mark.parametrize("theme", ["light", "projector"])
def test_weights_are_large_enough_and_over_no_point_and_no_other_weight(lesson, theme):
    for picture in pictures(lesson, theme):
        areas = pane_areas(picture, 1280, 720)
        for pane, area in zip(picture.panes, areas, strict=True):
            if not isinstance(pane.content, Diagram) or not pane.content.dots:
                continue
            fit = spread(pane.content, area, 0.72 * picture.scale)
            words = fit.words[[bool(d.text) for d in pane.content.dots]]
            assert fit.size >= LEAST - 1e-9
            assert (words[:, :2] >= np.array(area[:2]) - 1).all()
            assert (words[:, 2:] <= np.array(area[:2]) + np.array(area[2:]) + 1).all()
            near = np.clip(fit.at[None], words[:, None, :2], words[:, None, 2:])
            assert (np.linalg.norm(near - fit.at[None], axis=2) > fit.reach).all()
            low, high = words[:, None, :2], words[:, None, 2:]
            assert ((low < high.swapaxes(0, 1)) & (low.swapaxes(0, 1) < high)).all(axis=2).sum() == len(words)


@each_drawn
def test_a_stencil_shows_one_weight_for_each_contributor_and_one_clear_diamond(lesson):
    for picture in pictures(lesson):
        for pane in picture.panes:
            if isinstance(pane.content, Diagram) and pane.content.dots:
                *discs, diamond = pane.content.dots
                assert diamond.shape is Shape.CLEAR
                assert not diamond.text
                assert all(d.shape is Shape.SPHERE and d.text for d in discs)
                exact = [Fraction(d.text) for d in discs if "≈" not in d.text]
                assert sum(exact) == 1 if len(exact) == len(discs) else not exact
                near = sum(float(Fraction(d.text.removeprefix("≈"))) for d in discs)
                assert near == pytest.approx(1, abs=1e-3)


@each_valence
def test_discs_and_diamond_are_found_under_the_mouse_with_their_stage_and_point(n):
    lesson = lessons.find("figure_20").turned(valence=n)
    picture = next(pictures(lesson))
    words = [p for p in overlay(picture, 1280, 720) if isinstance(p, Text) and "/" in p.text and "$" not in p.text]
    assert len(words) == 2 * (2 * n + 1)
    for k, area in enumerate(pane_areas(picture, 1280, 720)):
        fit = spread(picture.panes[k].content, area, 0.72)
        x, y = fit.at[-1]
        pane, diamond = part_at(picture, 1280, 720, float(x), float(y))
        assert (pane, diamond.shape, diamond.point) == (k, Shape.CLEAR, 0)
        assert diamond.stage == lesson.beats[0].views[k].stop
    found = {d.point: d.stage for d in picture.panes[0].content.dots[:-1]}
    assert found == dict.fromkeys(range(2 * n + 1), 0)


@each_valence
@pytest.mark.parametrize("star", [shapes.quad_star, shapes.triangle_star])
def test_a_star_is_flat_and_every_turn_by_one_face_maps_it_to_itself(n, star):
    mesh = star(n, 2)
    angle = 2 * np.pi / n
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    turned = mesh.points @ turn.T
    apart = np.linalg.norm(turned[:, None] - mesh.points[None], axis=2)
    assert apart.min(axis=1).max() < 1e-12
    assert np.abs(mesh.points[:, 2]).max() == 0
    assert mesh.topology.valence[0] == n
    ends = mesh.topology.ends
    lengths = np.linalg.norm(mesh.points[ends[:, 0]] - mesh.points[ends[:, 1]], axis=1)
    assert np.allclose(lengths[(ends == 0).any(axis=1)], 1)
    assert star is shapes.triangle_star or np.allclose(lengths, 1)


@each_valence
def test_the_ball_at_the_top_of_a_dome_is_the_ball_it_lies_on(n):
    for star in (shapes.quad_star(n), shapes.triangle_star(n)):
        dome = shapes.dome(star)
        assert np.allclose(np.linalg.norm(dome.points, axis=1), 1, atol=1e-12)
        assert ball_at(dome, 0) == pytest.approx(1, abs=1e-12)
        assert ball_at(Mesh(star.topology, 3 * dome.points), 0) == pytest.approx(3, abs=1e-12)


def test_a_flat_tip_has_no_ball_and_a_solid_on_a_ball_has_ratio_one():
    assert ball_at(shapes.triangle_star(6), 0) > 1e9
    assert radius_ratio(shapes.icosahedron().points) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize(("scheme", "ratio"), [(QUAD_CENTROID, 1.1296), (CATMULL_CLARK, 1.0316)])
def test_the_limit_of_the_cube_is_rounder_by_catmull_clark(scheme, ratio):
    told = to_limit(trace(scheme, shapes.cube(), levels=2))
    assert np.allclose(told.points[-1], limit_points(subdivide(shapes.cube(), scheme, 2), scheme), atol=1e-12)
    assert radius_ratio(told.points[-1]) == pytest.approx(ratio, abs=1e-4)


def test_loop_keeps_the_ball_at_a_tip_at_every_valence():
    for n in range(3, 13):
        radii = [ball_at(subdivide(shapes.dome(shapes.triangle_star(n)), LOOP, k), 0) for k in (3, 4)]
        assert abs(np.log(radii[1] / radii[0])) < 0.01

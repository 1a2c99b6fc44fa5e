"""From the back row: on every picture of every lesson type is large, whole, apart, and covers no point."""

from dataclasses import replace

import numpy as np
import pytest

import lessons
from app.draw import places
from app.draw.compose import compose
from app.draw.layout import fitted, overlay, pane_areas
from app.draw.picture import Scene
from app.draw.primitives import Text
from app.draw.type import extent
from app.state import Options, at_stop, start, stops

SLACK = 1.0
"""Pixels by which two texts may touch: their extents are those of whole lines, not of ink."""


@pytest.mark.parametrize(("theme", "language"), [("light", "en"), ("projector", "en"), ("light", "de")])
@pytest.mark.parametrize("lesson", lessons.all_lessons(), ids=lambda each: each.id)
def test_type_is_large_enough_whole_and_apart(lesson, theme, language):
    height = 1080
    size = 1920, height
    for number, stop in enumerate(stops(lesson), 1):
        picture = compose(at_stop(start(lesson, Options(theme=theme, language=language)), stop))
        texts = [each for each in overlay(picture, *size) if isinstance(each, Text) and each.text.strip()]
        boxes = np.array([extent(each) for each in texts])
        assert min(each.size for each in texts) >= height / 45 - 0.01, number
        assert (boxes[:, :2] >= -SLACK).all(), number
        assert (boxes[:, :2] + boxes[:, 2:] <= np.array(size) + SLACK).all(), number
        low, high = boxes[:, None, :2], boxes[:, None, :2] + boxes[:, None, 2:]
        over = np.minimum(high, high.transpose(1, 0, 2)) - np.maximum(low, low.transpose(1, 0, 2))
        clash = np.argwhere(np.triu((over > SLACK + 0.25 * _least_height(boxes)).all(axis=2), 1))
        assert [(texts[a].text, texts[b].text) for a, b in clash] == [], number


@pytest.mark.parametrize("lesson", lessons.all_lessons(), ids=lambda each: each.id)
def test_no_label_hides_a_point(lesson):
    width, height = 1920, 1080
    for number, stop in enumerate(stops(lesson), 1):
        picture = compose(at_stop(start(lesson), stop))
        labels = [each for each in overlay(picture, width, height) if isinstance(each, Text) and each.halo is not None]
        boxes = np.array([extent(each) for each in labels]).reshape(-1, 4)
        for pane, area in zip(picture.panes, pane_areas(picture, width, height), strict=True):
            if isinstance(pane.content, Scene):
                camera = fitted(pane.content.camera, area)
                points = [m.points for m in pane.content.markers if m.name]
                flat = camera.project(np.vstack([np.zeros((0, 3)), *points]), area[2], area[3])[:, :2] + area[:2]
                inside = (flat[None] > boxes[:, None, :2]) & (flat[None] < boxes[:, None, :2] + boxes[:, None, 2:])
                assert [labels[k].text for k in np.flatnonzero(inside.all(axis=2).any(axis=1))] == [], number


def _least_height(boxes):
    return np.minimum(boxes[:, None, 3], boxes[None, :, 3])[..., None]


@pytest.mark.parametrize("crowd", [0, 3, 40, 120])
def test_no_place_for_a_label_is_better_than_its_own(crowd):
    rng, area = np.random.default_rng(crowd), (10.0, 20.0, 600.0, 400.0)
    discs, dots = rng.uniform(0, 600, (crowd, 3)) * (1, 1, 0.02), rng.uniform(0, 600, (10 * crowd, 2))
    discs[:1, 2] = 80
    wishes = [
        places.Wish(tuple(at), wide, 24.0, clear, tuple(away))
        for at, wide, clear, away in zip(
            rng.uniform((10, 20), (610, 420), (150, 2)), rng.uniform(20, 120, 150), rng.choice((0.0, 5.0), 150),
            rng.choice((0.0, 14.0, -14.0), (150, 2)), strict=True,
        )
    ]  # fmt: skip
    left, top = rng.uniform(20, 380, (2, crowd // 3))
    taken = np.stack([left, top, left + 90, top + 20], axis=1)  # of something else
    for wish, own in zip(wishes, places.nearest(wishes, places.Ground(area, discs, dots, taken.T)), strict=True):
        left, top, off, cost, over = _weighed(wish, area, discs, dots, taken)
        best = int(cost.argmin())
        assert own == places.Place(left[best], top[best], off[best], over[best] == 0)
        taken = np.vstack([taken, (own.left - 6, own.top, own.left + wish.wide + 6, own.top + 24)])


def _weighed(wish, area, discs, dots, taken):
    """Left, top and how far off are all places of a label; what each costs, and over how many others it is."""
    round_it = places._places(wish.away, tuple(places.RINGS.tolist()))
    left, top, *_ = (m[0] for m in round_it.corners([wish]))
    low = np.stack([left, top], axis=1)[:, None]
    high = low + np.array([wish.wide, wish.tall])
    outside = ((low < area[:2]) | (high > np.add(area[:2], area[2:]))).any(axis=(1, 2))
    over = ((low < taken[:, 2:]) & (high > taken[:, :2])).all(axis=2).sum(axis=1)
    covered = (np.linalg.norm(np.clip(discs[:, :2], low, high) - discs[:, :2], axis=2) < discs[:, 2]).sum(axis=1)
    crossed = ((low <= dots) & (dots <= high)).all(axis=2).sum(axis=1)
    soft = round_it.price + places.OVER * np.minimum(crossed, places.MOST_OVER)
    return left, top, round_it.ring, soft + 1e3 * (50 * outside + 4 * over + covered), over


@pytest.mark.parametrize("size", [(1280, 720), (1920, 1080)])
@pytest.mark.parametrize(
    ("lesson", "at"), [("figure_07_three_direction_quartic", 2.0), ("exercise_1a_either_order", 3.0)]
)
def test_labels_and_what_is_said_of_a_limit_keep_off_the_bar_of_colours(lesson, at, size):
    options = Options(valences=True, limit=True, surface_shows="mean curvature")
    picture = compose(replace(start(lessons.find(lesson), options), at=at))
    (bar,) = (p.content.bar for p in picture.panes if isinstance(p.content, Scene) and p.content.bar is not None)
    on_it = {bar.title, *(text for _, text in bar.ticks)}
    texts = [each for each in overlay(picture, *size) if isinstance(each, Text) and each.halo is not None]
    boxes = {own: np.array([extent(each) for each in texts if (each.text in on_it) == own]) for own in (True, False)}
    low, high = boxes[True][:, :2].min(axis=0), (boxes[True][:, :2] + boxes[True][:, 2:]).max(axis=0)
    others = boxes[False]
    is_over = ((others[:, :2] < high - SLACK) & (others[:, :2] + others[:, 2:] > low + SLACK)).all(axis=1)
    assert len(others) > 30
    assert not is_over.any()

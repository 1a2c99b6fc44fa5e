"""From the back row: on every picture of every lesson type is large, whole, apart, and covers no point."""

import numpy as np
import pytest

import lessons
from app.draw import labels
from app.draw.compose import compose
from app.draw.layout import extent, fitted, overlay, pane_areas
from app.draw.picture import Label, Scene
from app.draw.primitives import Text
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


@pytest.mark.parametrize("crowd", [0, 3, 40])
def test_no_place_for_a_label_is_better_than_its_own(crowd):
    rng, area = np.random.default_rng(crowd), (10.0, 20.0, 600.0, 400.0)
    for _ in range(50):
        at = tuple(rng.uniform((10, 20), (610, 420)))
        discs, strokes = rng.uniform(0, 600, (3 * crowd, 3)) * (1, 1, 0.05), rng.uniform(0, 600, (30 * crowd, 2))
        taken = np.hstack([rng.uniform(0, 600, (crowd, 2)), rng.uniform(10, 200, (crowd, 2))])
        label = Label(np.zeros(3), "12/64", (0.0, 0.0, 0.0), away=tuple(rng.choice((0.0, 14.0, -14.0), 2)))
        box, off = labels._best(label, at, 20.0, 5.0, area, discs, strokes, taken)
        costs = []
        for places in labels._rounds(label.away):
            each, _ = places.boxes(at, box[2], box[3], 5.0)
            over = np.minimum(labels._inside(each, strokes), labels.MOST_OVER)
            hard = labels._outside(each, area) + 4 * labels._overlaps(each, taken) + labels._covered(each, discs)
            cost = places.price + labels.OVER * over + 1e3 * hard
            costs += zip(cost, each[:, 0], each[:, 1], places.ring, strict=True)
        assert min(costs)[1:] == (box[0], box[1], off)

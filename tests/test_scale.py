"""A picture at another scale: type grows as far as there is room, and is never smaller than it can be read."""

import ast
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import pytest

import app
import lessons
from app.draw.compose import compose
from app.draw.layout import ROOM, overlay, pane_areas
from app.draw.picture import Scene
from app.draw.primitives import LEAST, Text
from app.draw.theme import THEMES
from app.draw.type import extent
from app.sessions import keeping, link
from app.state import Options, choose, last, start

SIZES = [(1920, 1080), (1080, 1080)]
EVERY = lessons.all_lessons()


def at(lesson, scale):
    return last(start(lesson, Options(scale=scale)))


def type_sizes(state, size):
    picture = compose(state)
    return [each.size for each in overlay(picture, *size) if isinstance(each, Text)]


def markers(state):
    return [(m.name, float(m.radius.max())) for pane in compose(state).panes if isinstance(pane.content, Scene)
            for m in pane.content.markers if len(m.radius)]


@pytest.mark.parametrize("lesson", EVERY[::4], ids=lambda each: each.id)
@pytest.mark.parametrize("size", SIZES)
def test_type_grows_and_leaves_room(lesson, size):
    usual, larger, largest = (type_sizes(at(lesson, scale), size) for scale in (1.0, 1.25, 2.5))
    assert max(usual) < max(larger) <= 1.05 * max(largest)
    assert sum(larger) > sum(usual)
    assert min(usual + larger + largest) >= LEAST * size[1] / 1000 * 0.999
    for scale in (1.0, 2.5):
        areas = pane_areas(compose(at(lesson, scale)), *size)
        top, bottom = min(y for _, y, _, _ in areas), max(y + h for _, y, _, h in areas)
        assert bottom - top >= ROOM * size[1] - 2


@pytest.mark.parametrize("lesson", EVERY[::6], ids=lambda each: each.id)
def test_a_smaller_window_has_the_same_picture(lesson):
    assert type_sizes(at(lesson, 0.75), SIZES[0]) == type_sizes(at(lesson, 1.0), SIZES[0])
    assert compose(at(lesson, 0.75)).stroke == THEMES["light"].stroke
    assert markers(at(lesson, 0.75)) == markers(at(lesson, 1.0))


def test_points_and_strokes_grow():
    usual, larger = (compose(at(lessons.find("14"), scale)) for scale in (1.0, 2.0))
    assert larger.stroke > usual.stroke
    before, after = (dict(markers(at(lessons.find("14"), scale))) for scale in (1.0, 2.0))
    assert after["original"] > before["original"]


def test_the_scale_is_the_readers_own():
    state = at(lessons.find("14"), 2.0)
    here = Options(scale=1.5)
    assert keeping.restored(keeping.kept(state), here).options.scale == 1.5
    assert keeping.taken_up(replace(state, options=here), state).options.scale == 1.5
    assert link.link(state) == link.link(choose(state, scale=1.0))


MEASURED = {"setFixedHeight", "setFixedWidth", "setFixedSize", "setMinimumWidth", "setMinimumHeight", "setSpacing",
            "setContentsMargins", "addSpacing", "setHorizontalSpacing", "setVerticalSpacing", "setIconSize", "gap",
            "drawRoundedRect", "setPixelSize", "setHandleWidth"}
"""Calls that take pixels."""

TO_SCALE = {"px", "fine", "type_face", "range"}


def bare(node):
    """Whether a measure has pixels in it that are not those of the scale: a number, or a distance of the grid."""
    if isinstance(node, ast.Call) and getattr(node.func, "id", "") in TO_SCALE:
        return False
    if isinstance(node, ast.Constant):
        return isinstance(node.value, int | float) and node.value > 1
    return getattr(node, "id", "") == "GRID" or any(bare(child) for child in ast.iter_child_nodes(node))


def test_every_measure_of_the_window_is_to_scale():
    found = [
        f"{path.name}:{node.lineno}"
        for path in sorted((Path(app.__file__).parent / "gui").glob("*.py"))
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Call) and (getattr(node.func, "attr", "") or getattr(node.func, "id", "")) in MEASURED
        and any(isinstance(arg, ast.Constant | ast.BinOp | ast.Name | ast.Call) and bare(arg) for arg in node.args)
        and path.name != "brush.py"  # it paints at the size that the layout says
    ]
    assert not found


def test_enlarged_labels_cover_no_others():
    state = choose(at(lessons.find("14"), 2.5), labels=True, valences=True)
    boxes = [extent(each) for each in overlay(compose(state), *SIZES[0]) if isinstance(each, Text)]
    for (x, y, w, h), (x1, y1, w1, h1) in combinations(boxes, 2):
        assert x >= x1 + w1 or x1 >= x + w or y >= y1 + h1 or y1 >= y + h

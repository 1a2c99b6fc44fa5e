"""The matrices beside the picture: a mark for every weight, and lit the rows that the point in focus needs."""

import numpy as np
import pytest
from PySide6.QtGui import QImage, QPainter

import lessons
from app import state as st
from app.draw.compose import compose
from app.draw.layout import overlay, part_at
from app.draw.picture import Diagram
from app.draw.primitives import Tiles, one_by_one
from app.draw.raster import painted
from app.gui.brush import paint, type_
from app.laboratory import bench

CUBE = st.choose(bench.enter(st.start(lessons.find("14"))), matrix=True)


def shown(state):
    content = compose(state).panes[-1].content
    assert isinstance(content, Diagram)
    return content


def marks(diagram):
    return [squares.box(k) for squares in diagram.squares for k in range(len(squares.points))]


@pytest.mark.parametrize("stop", [3, 6])
def test_every_factor_and_the_product_have_a_mark_for_each_weight(stop):
    state = st.at_stop(CUBE, st.stops(CUBE.lesson)[stop])
    step = state.now.lead.trace.step(st.level_of(state) - 1)
    assert len(marks(shown(state))) == step.matrix.nnz + sum(stage.matrix.nnz for stage in step.stages)
    assert len(shown(state).notes) == 1 + len(step.stages)


def test_the_lit_rows_lead_from_the_product_through_every_factor_to_the_control_points():
    state = st.at_stop(CUBE, st.stops(CUBE.lesson)[3])
    plain, lit = shown(state), shown(st.look(state, st.Spot(0, 3, 5)))
    strips = len(lit.boxes) - len(plain.boxes)
    topology, centroids, geometry = state.now.lead.trace.step(0).stages
    reached = np.unique(geometry.matrix[[5]].indices)
    before = np.unique(centroids.matrix[reached].indices)
    assert strips == 1 + 1 + len(reached) + len(before)
    assert topology.matrix.shape[0] >= len(before)


def test_too_many_weights_are_told_not_drawn():
    state = st.last(bench.set_levels(bench.take(CUBE, "duck"), 2))
    assert not marks(shown(state))
    assert "too many" in shown(state).notes[0].text


def test_before_the_first_stage_the_step_to_come_is_shown():
    assert marks(shown(CUBE))


def test_the_mark_under_the_mouse_is_the_point_of_its_row():
    state = st.at_stop(CUBE, st.stops(CUBE.lesson)[3])
    picture, diagram = compose(state), shown(state)
    tiles = [plate for each in overlay(picture, 1280, 720) if isinstance(each, Tiles) for plate in each.plates()]
    assert len(tiles) == len(marks(diagram))
    for mark, tile in zip(marks(diagram), tiles, strict=True):
        assert part_at(picture, 1280, 720, tile.x + 0.4 * tile.width, tile.y + 0.6 * tile.height) == (1, mark)
    x, y, last = tiles[-1].x, tiles[-1].y, len(marks(diagram)) - 1
    assert part_at(picture, 1280, 720, x - 0.05 * tiles[last].width, y)[1] != marks(diagram)[last]


def test_every_painter_paints_the_same_marks():
    state = st.at_stop(CUBE, st.stops(CUBE.lesson)[3])
    flat = [each for each in overlay(compose(state), 1280, 720) if isinstance(each, Tiles)]
    (x, y, w, h) = 0.0, 0.0, 1280.0, 720.0
    np.testing.assert_array_equal(painted(flat, (x, y, w, h), 1), painted(list(one_by_one(flat)), (x, y, w, h), 1))
    image = QImage(1280, 720, QImage.Format.Format_RGBA8888)
    image.fill(0)
    with QPainter(image) as painter:
        paint(painter, flat, type_)
    by_qt = np.frombuffer(image.constBits(), np.uint8).reshape(720, 1280, 4).astype(int)
    by_agg = painted(flat, (x, y, w, h), 1).astype(int)
    there = by_agg[..., 3] == 255
    assert there.sum() > 5000
    assert np.abs(by_qt - by_agg)[there].max() <= 2
    assert np.abs(by_qt - by_agg)[..., 3].mean() < 0.5

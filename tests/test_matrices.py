"""The matrices beside the picture: a mark for every weight, and lit the rows that the point in focus needs."""

import numpy as np
import pytest

import lessons
from app import state as st
from app.draw.compose import compose
from app.draw.picture import Diagram
from app.laboratory import bench

CUBE = st.choose(bench.enter(st.start(lessons.find("14"))), matrix=True)


def shown(state):
    content = compose(state).panes[-1].content
    assert isinstance(content, Diagram)
    return content


def marks(diagram):
    return [box for box in diagram.boxes if box.point >= 0]


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
    assert not shown(state).boxes
    assert "too many" in shown(state).notes[0].text


def test_before_the_first_stage_the_step_to_come_is_shown():
    assert marks(shown(CUBE))

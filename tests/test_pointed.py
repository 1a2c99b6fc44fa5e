"""Why is this point here: the row that is pointed out makes the point that is seen, however far back it is read."""

import numpy as np
import pytest

import lessons
from app import state as st
from app.draw.compose import compose, pointed
from app.draw.pointed import ACROSS, row_of
from app.draw.scenes import CONTRIBUTOR, POINTED_OUT
from app.laboratory import bench
from subdivision import TopologyError
from subdivision.limit import limit_points

CUBE = st.last(bench.enter(st.start(lessons.find("14"))))
NET = st.last(bench.take(CUBE, "net"))


def spots(state, every):
    k = int(state.at)
    return [st.Spot(0, k, point) for point in range(0, state.now.lead.trace.stages[k - 1].n_points, every)]


@pytest.mark.parametrize("across", ["stage", "step", "all"])
@pytest.mark.parametrize("state", [CUBE, NET], ids=["cube", "net"])
def test_a_row_times_its_parents_is_the_point_across_any_stretch(state, across):
    state = st.drag(state, 3, (0.3, -0.2, 1.7))
    trace = state.trace(state.now.lead)
    for spot in spots(state, 7):
        row = row_of(trace, spot, across)
        parents = trace.points[row.stage - row.span][row.stencil.parents]
        assert np.abs(row.stencil.weights @ parents - trace.points[row.stage][spot.point]).max() < 1e-12
        assert abs(row.stencil.weights.sum() - 1) < 1e-12


def test_the_row_to_the_limit_is_the_limit_the_engine_tells_and_the_same_from_every_level():
    trace = CUBE.now.lead.trace
    known = limit_points(trace.control, trace.scheme)
    for k in (0, 3, 6):
        for corner in range(8):
            row = row_of(trace, st.Spot(0, k, corner), "limit")
            assert np.abs(row.place - known[corner]).max() < 1e-12
            if corner == 5:
                assert np.abs(np.abs(row.place) - 5 / 9).max() < 1e-12


def test_no_limit_is_read_in_the_middle_of_a_level_and_the_reason_is_said():
    trace = CUBE.now.lead.trace
    with pytest.raises(TopologyError, match="where this level ends"):
        row_of(trace, st.Spot(0, 4, 3), "limit")
    rim = st.Spot(0, 0, 0)
    with pytest.raises(TopologyError, match="not all points around it exist"):
        row_of(NET.now.lead.trace, rim, "limit")
    middle = st.at_stop(CUBE, st.stops(CUBE.lesson)[4])
    assert pointed(st.look(st.choose(middle, across="limit"), st.Spot(0, 4, 3)), middle.now.lead) is None


@pytest.mark.parametrize("across", ACROSS)
def test_what_is_pointed_out_is_drawn_with_one_weight_for_each_contributor(across):
    state = st.look(st.choose(CUBE, across=across), st.Spot(0, 6, 50))
    row = pointed(state, state.now.lead)
    (scene,) = compose(state).scenes
    named = {m.name: m for m in scene.markers}
    assert len(named[CONTRIBUTOR].points) == len(row.stencil.terms) == len(scene.labels)
    there = row.place if row.place is not None else state.now.lead.trace.points[6][50]
    assert np.array_equal(named[POINTED_OUT].points[0], there)


def test_the_corner_of_the_cube_under_catmull_clark_moves_to_five_ninths():
    state = st.last(bench.set_levels(bench.choose_family(CUBE, 0, "catmull-clark"), 1))
    row = row_of(state.now.lead.trace, st.Spot(0, int(state.at), 5), "all")
    assert np.abs(np.abs(row.stencil.weights @ state.lab.control.points[row.stencil.parents]) - 5 / 9).max() < 1e-12

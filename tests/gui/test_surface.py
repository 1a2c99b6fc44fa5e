"""The panel of what a surface shows: by mouse and by keys; a control point picked for its basis function stays."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from app import state as st
from app.draw import basis
from app.draw.surface import SHOWS
from app.gui.surface import SWITCHES
from app.laboratory import bench

pytestmark = pytest.mark.window


def press(window, key):
    QTest.keyClick(window.windowHandle(), getattr(Qt.Key, f"Key_{key}"))


def options(window):
    return window.session.state.options


def picture(window):
    return window.viewport._picture.scenes[0]


@pytest.fixture
def net(window):
    """The laboratory with a net after two levels, its control points shown."""
    window.session.do(bench.enter)
    window.session.do(bench.take, "net")
    window.session.do(st.choose, control=True)
    window.session.do(st.last)
    return window


def seen(window, points):
    x, y, w, h = window.viewport.areas()[0]
    flat = window.viewport.cameras()[0].project(points, w, h)
    return [QPoint(round(x + a), round(y + b)) for a, b, _ in flat]


def test_a_key_goes_through_all_that_a_surface_shows_and_the_list_says_which(net):
    for kind in [*list(SHOWS)[1:], ""]:
        press(net, "O")
        assert options(net).surface_shows == kind
        assert net.surface.shows.box.currentText() == SHOWS[kind]


def test_choosing_in_the_list_colours_the_surface_and_undo_takes_it_off(net):
    box = net.surface.shows.box
    box.setFocus()
    box.setCurrentIndex(list(SHOWS).index("gauss curvature"))
    box.activated.emit(box.currentIndex())
    assert picture(net).faces[0].colours is not None
    net.session.undo()
    assert picture(net).faces[0].colours is None
    assert box.currentText() == "Plain"


@pytest.mark.parametrize(("option", "key"), [(option, key) for option, _, key in SWITCHES])
def test_every_switch_has_a_key_and_a_tooltip(net, option, key):
    switch = net.surface.switches[option]
    press(net, key)
    assert getattr(options(net), option)
    assert switch.isChecked()
    QTest.mouseClick(switch, Qt.MouseButton.LeftButton)
    assert not getattr(options(net), option)
    assert f"({key})" in switch.toolTip()


def test_pointing_at_a_control_point_spreads_its_influence(net, qtbot):
    trace = net.session.state.trace(net.session.state.now.lead)
    QTest.mouseMove(net.viewport.canvas, seen(net, trace.control.points)[12])
    qtbot.waitUntil(lambda: picture(net).bar is not None, timeout=2000)
    assert picture(net).bar.title == "Influence of v12"
    assert net.session.state.focus == st.Spot(0, 0, 12)


def test_a_click_picks_whose_basis_function_it_is_and_hovering_changes_nothing(net, qtbot):
    press(net, "H")
    middle = picture(net)
    assert "v12" in middle.bar.title
    trace = net.session.state.trace(net.session.state.now.lead)
    places = seen(net, basis.graph(trace, 12).control.points)
    QTest.mouseMove(net.viewport.canvas, places[7])
    qtbot.wait(20)
    assert "v12" in picture(net).bar.title
    QTest.mouseClick(net.viewport.canvas, Qt.MouseButton.LeftButton, pos=places[7])
    assert "v7" in picture(net).bar.title
    heights = basis.heights(trace, picture(net).faces[0].points)
    assert np.abs(heights - trace.whole.matrix.toarray()[:, 7]).max() < 1e-12
    press(net, "PageUp")
    qtbot.waitUntil(lambda: not net.session.state.is_playing, timeout=5000)
    assert "v7" in picture(net).bar.title


def test_a_dragged_point_moves_limits_and_plots_with_it(window):
    window.session.do(bench.enter)
    window.session.do(st.choose, limit=True, distances=True)
    window.session.do(st.last)
    before = window.viewport._picture
    window.session.do(st.drag, 5, (2.5, 1.0, 1.0))
    after = window.viewport._picture
    assert np.abs(after.scenes[0].faces[0].points - before.scenes[0].faces[0].points).max() > 0.1
    assert [n.text for n in after.panes[-1].content.notes] != [n.text for n in before.panes[-1].content.notes]


def test_the_panel_is_no_wider_than_its_column(window):
    window.resize(1280, 720)
    assert window.surface.minimumSizeHint().width() <= 160
    assert window.surface.shows.box.accessibleName() == "Surface shows"


def test_a_heavy_surface_follows_the_hand_coarsely_and_is_whole_at_rest(net, qtbot):
    net.session.do(bench.set_levels, 6)
    net.session.do(st.last)
    before = picture(net).faces[0]
    net.session.do(st.drag, 5, (2.5, 1.0, 1.0))
    assert len(picture(net).faces[0].sizes) < len(before.sizes)
    assert net.viewport.spot_at(net.viewport.rect().center()) is None
    qtbot.waitUntil(lambda: len(picture(net).faces[0].sizes) == len(before.sizes), timeout=5000)
    assert np.array_equal(picture(net).faces[0].corners, before.corners)
    assert not np.array_equal(picture(net).faces[0].points, before.points)

"""Making an object of one's own: parts picked with the mouse, edited by buttons and keys, refused with a sentence."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from app.laboratory import bench
from app.sessions.keeping import kept, restored
from app.state import Picked, choose, drag, last
from subdivision import Polyline, editing, schemes, shapes, subdivide

pytestmark = pytest.mark.window
Key, SHIFT = Qt.Key, Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def table(window):
    """The window with a cube on the laboratory's table."""
    window.session.do(bench.enter)
    return window


def control(window):
    return window.session.state.trace(window.session.state.now.lead).control


def screen(window, place):
    """Where a place in space is on the viewport."""
    x, y, w, h = window.viewport.areas()[0]
    flat = window.viewport.cameras()[0].project(np.asarray(place), w, h)[0]
    return QPoint(round(x + flat[0]), round(y + flat[1]))


def on_face(window, f):
    mesh = control(window)
    return mesh.points[mesh.topology.loops()[f]].mean(axis=0)


def on_edge(window, e, along=0.5):
    a, b = control(window).points[control(window).topology.ends[e]]
    return (1 - along) * a + along * b


def click(window, place, modifiers=Qt.KeyboardModifier.NoModifier):
    QTest.mouseClick(window.viewport.canvas, Qt.MouseButton.LeftButton, modifiers, pos=screen(window, place))


def press(window, key, modifiers=Qt.KeyboardModifier.NoModifier):
    QTest.keyClick(window.windowHandle(), key, modifiers)


def picked(window):
    return window.session.state.picked


def edge(mesh, a, b):
    return int(np.flatnonzero((np.sort(mesh.topology.ends, axis=1) == sorted((a, b))).all(axis=1))[0])


def front(window):
    """The face of the cube that looks at the eye most, and its corners."""
    eye = window.viewport.cameras()[0].position
    f = min(range(6), key=lambda f: np.linalg.norm(on_face(window, f) - eye))
    return f, control(window).topology.loops()[f]


def rim(window):
    """The edges round that face."""
    _, loop = front(window)
    return [edge(control(window), a, b) for a, b in zip(loop, loop[1:] + loop[:1], strict=True)]


# -- picking ----------------------------------------------------------------------------------


def test_points_edges_and_faces_are_picked_where_they_are_seen(table):
    f, loop = front(table)
    click(table, on_face(table, f))
    assert picked(table) == Picked("face", (f,))
    for e in rim(table):
        click(table, on_edge(table, e))
        assert (picked(table).kind, picked(table).numbers) == ("edge", (e,))
        assert picked(table).along == pytest.approx(0.5, abs=0.02)
    click(table, control(table).points[loop[0]])
    assert picked(table) == Picked("vertex", (loop[0],))


def test_what_is_behind_a_face_is_not_picked_through_it_but_through_a_net(table):
    eye = table.viewport.cameras()[0].position
    hidden = max(range(12), key=lambda e: np.linalg.norm(on_edge(table, e) - eye))
    click(table, on_edge(table, hidden))
    assert picked(table).kind == "face"
    press(table, Key.Key_U)
    click(table, on_edge(table, hidden))
    assert (picked(table).kind, picked(table).numbers) == ("edge", (hidden,))


def test_shift_picks_more_and_the_same_again_less_and_escape_nothing(table):
    one, two, *_ = rim(table)
    click(table, on_edge(table, one))
    click(table, on_edge(table, two), SHIFT)
    assert picked(table).numbers == (one, two)
    assert table.editing.hint.text() == "Picked: 2 edges."
    strokes = table.viewport._picture.scenes[0].lines[-1]
    assert np.array_equal(strokes.pairs, control(table).topology.ends[sorted((one, two))])
    click(table, on_edge(table, one), SHIFT)
    assert picked(table).numbers == (two,)
    press(table, Key.Key_Escape)
    assert picked(table) is None


def test_picking_is_nothing_to_undo(table):
    before = len(table.session._past)
    click(table, on_face(table, 3))
    assert len(table.session._past) == before


def test_in_a_lesson_nothing_is_picked(window, lesson):
    click(window, on_face(window, 3))
    assert picked(window) is None
    assert window.editing.isHidden()


# -- meshes -----------------------------------------------------------------------------------


def test_a_crease_round_a_face_of_the_cube_keeps_its_plane_in_the_limit(table):
    e, *others = rim(table)
    _, loop = front(table)
    click(table, on_edge(table, e))
    for other in others:
        click(table, on_edge(table, other), SHIFT)
    slider = table.editing.sharpness.slider
    slider.setFocus()
    QTest.keyClick(slider, Key.Key_End)
    sharp = control(table).surface.edge_sharpness
    assert np.flatnonzero(sharp == 10).tolist() == sorted([e, *others])
    assert picked(table).numbers[-1] == others[-1]
    table.session.do(last)
    told = table.session.state.now.lead.trace
    shown = table.viewport._picture.scenes[0].faces[0].points
    direct = subdivide(control(table), told.scheme, table.session.state.lab.levels)
    assert np.abs(shown - direct.points).max() < 1e-12
    corners = control(table).points[loop]
    axis = int(np.argmin(np.ptp(corners, axis=0)))
    creased = direct.surface.ends[(direct.surface.edge_sharpness > 0)]
    assert np.abs(direct.points[creased.ravel()][:, axis] - corners[0, axis]).max() < 1e-12


def test_the_keys_make_an_edge_sharper_by_halves_and_its_line_wider(table):
    click(table, on_edge(table, rim(table)[0]))
    widths = []
    for _ in range(3):
        press(table, Key.Key_S)
        lines = table.viewport._picture.scenes[0].lines
        widths.append(next(each.width for each in lines if len(each.pairs) == 1))
    assert control(table).surface.edge_sharpness.max() == 1.5
    assert widths == sorted(set(widths))
    press(table, Key.Key_S, SHIFT)
    assert control(table).surface.edge_sharpness.max() == 1.0
    table.session.undo()
    assert control(table).surface.edge_sharpness.max() == 1.5


def test_a_deleted_face_leaves_a_boundary_and_filling_it_brings_it_back(table, qtbot):
    f, loop = front(table)
    click(table, on_face(table, f))
    press(table, Key.Key_Delete)
    holed = control(table)
    assert holed.topology.n_faces == 5
    assert holed.surface.boundary.sum() == 4
    assert table.session.state.lab.name == "edited cube"
    assert picked(table) is None
    click(table, on_edge(table, edge(holed, loop[0], loop[1])))
    press(table, Key.Key_F)
    assert {frozenset(each) for each in control(table).surface.loops()} == {
        frozenset(each) for each in shapes.cube().surface.loops()
    }
    assert not control(table).surface.boundary.any()
    table.session.undo()
    table.session.undo()
    assert control(table).topology.n_faces == 6


def test_what_would_break_the_mesh_is_refused_with_a_sentence_and_stays_as_it_was(table):
    click(table, on_edge(table, rim(table)[0]))
    before = table.session.state
    press(table, Key.Key_E)
    assert "triangulate the mesh first." in table.banner.words.text()
    assert table.banner.words.text()[0] == "F"
    press(table, Key.Key_Delete)
    assert "An edge goes with its faces" in table.banner.words.text()
    assert table.session.state.lab is before.lab
    press(table, Key.Key_Escape)
    assert table.banner.isHidden()
    press(table, Key.Key_Escape)
    press(table, Key.Key_S)
    assert "No edge or vertex is picked" in table.banner.words.text()


def test_a_triangulated_cube_needs_another_scheme_and_the_banner_says_so(table):
    assert table.session.state.lab.rules[0].family == "quad-centroid"
    QTest.mouseClick(table.editing.buttons["triangulate"], Qt.MouseButton.LeftButton)
    assert control(table).surface.is_triangular
    assert table.session.state.lab.rules[0].family == "triangle-centroid"
    assert "cannot subdivide this: face 0 has 3 corners" in table.banner.words.text()
    assert table.banner.words.text().endswith("takes over.")
    e = edge(control(table), *control(table).surface.loops()[0][:2])
    table.session.do(choose, surface=False)
    click(table, on_edge(table, e))
    press(table, Key.Key_E)
    assert (picked(table).kind, len(picked(table).numbers)) == ("edge", 1)
    assert control(table).topology.n_edges == 18


def test_an_edit_stays_at_its_place_of_the_story_with_what_was_dragged(table):
    table.session.do(choose, control=True)
    table.session.do(last)
    table.session.do(drag, 7, (2.0, 2.0, 2.0))
    here = table.session.state.beat, table.session.state.at
    click(table, on_edge(table, edge(control(table), 5, 7)))
    press(table, Key.Key_S)
    state = table.session.state
    assert (state.beat, state.at) == here
    assert state.edits == ()
    assert state.lab.control.points[7].tolist() == [2, 2, 2]
    again = restored(kept(state))
    assert np.array_equal(again.lab.control.points, state.lab.control.points)
    assert np.array_equal(again.lab.control.surface.edge_sharpness, state.lab.control.surface.edge_sharpness)
    table.session.undo()
    assert table.session.state.edits == ((7, (2.0, 2.0, 2.0)),)


# -- polygons, nets, fans ---------------------------------------------------------------------


def test_a_polygon_of_one_s_own(table):
    table.session.do(bench.take, "polygon")
    start = control(table).points
    click(table, on_edge(table, 1, 0.25))
    assert picked(table).along == pytest.approx(0.25, abs=0.02)
    QTest.mouseClick(table.editing.buttons["insert"], Qt.MouseButton.LeftButton)
    assert control(table).topology == Polyline(6)
    assert np.abs(control(table).points[2] - (0.75 * start[1] + 0.25 * start[2])).max() < 0.05
    assert picked(table) == Picked("vertex", (2,))
    press(table, Key.Key_Delete)
    assert np.array_equal(control(table).points, start)
    click(table, start[-1])
    press(table, Key.Key_Insert)
    assert control(table).topology == Polyline(6)
    assert np.abs(control(table).points[-1] - (2 * start[-1] - start[-2])).max() < 1e-12
    QTest.mouseClick(table.editing.closed, Qt.MouseButton.LeftButton)
    assert control(table).topology == Polyline(6, closed=True)
    table.session.do(last)
    assert np.abs(
        table.session.state.now.lead.trace.points[-1]
        - subdivide(control(table), schemes.lane_riesenfeld(3), table.session.state.lab.levels).points
    ).max() < 1e-12


def test_a_polygon_goes_from_scheme_to_scheme_as_it_loses_points_and_keeps_the_last_two(table, qtbot):
    table.session.do(bench.take, "polygon")
    families = []
    for _ in range(4):
        click(table, control(table).points[0])
        press(table, Key.Key_Delete)
        families.append(table.session.state.lab.rules[0].family)
        qtbot.wait(50)  # a message moves the picture
    assert families == ["lane-riesenfeld", "chaikin", "four-point", "four-point"]
    assert table.banner.words.text() == "Without point 0 only 1 would be left, and an open polygon needs 2; keep one."
    assert control(table).topology.n_vertices == 2


def test_a_net_is_made_larger_and_wrapped(table):
    table.session.do(bench.take, "net")
    before = control(table)
    QTest.mouseClick(table.editing.n_s.more, Qt.MouseButton.LeftButton)
    QTest.mouseClick(table.editing.n_t.less, Qt.MouseButton.LeftButton)
    assert control(table).topology.shape == (6, 4)
    assert np.abs(np.ptp(control(table).points, axis=0) - np.ptp(before.points, axis=0))[:2].max() < 1e-12
    QTest.mouseClick(table.editing.wrap_s, Qt.MouseButton.LeftButton)
    assert control(table).topology.wrap_s
    assert not control(table).topology.wrap_t


@pytest.mark.parametrize("fan", ["quad-fan", "triangle-fan"])
def test_a_fan_takes_another_valence(table, fan):
    table.session.do(bench.take, fan)
    assert table.editing.valence.isVisible()
    n, rings = editing.fan_of(control(table))
    QTest.mouseClick(table.editing.valence.less, Qt.MouseButton.LeftButton)
    assert editing.fan_of(control(table)) == (n - 1, rings)
    QTest.mouseClick(table.editing.rings.more, Qt.MouseButton.LeftButton)
    assert editing.fan_of(control(table)) == (n - 1, rings + 1)
    table.session.do(bench.take, "cube")
    assert not table.editing.valence.isVisible()


def test_a_sharp_vertex_has_heavy_strokes_along_its_edges(table):
    loop = front(table)[1]
    click(table, control(table).points[loop[0]])
    press(table, Key.Key_S)
    lines = table.viewport._picture.scenes[0].lines
    (strokes,) = [each for each in lines if len(each.pairs) == 3]
    assert set(strokes.pairs[:, 0]) == {loop[0]}

"""The box spline panel in the real window: arrows and passes in the hand and by keys, and what is read beside them."""

import time

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QFontMetricsF, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.gui.look import type_face
from app.gui.vectors import Vectors
from app.laboratory import bench, boxlab
from app.state import at_stop, last, stops
from subdivision import TopologyError
from subdivision.continuity import mask

pytestmark = pytest.mark.window
Key, Left = Qt.Key, Qt.MouseButton.LeftButton
Alt = Qt.KeyboardModifier.AltModifier


@pytest.fixture
def lab(window):
    """Zwart-Powell in the laboratory on a torus, where there is room for any vector."""
    window.session.do(bench.enter)
    window.session.do(bench.take, "torus-net")
    window.session.do(bench.choose_family, 0, "box-spline")
    window.session.do(boxlab.preset, "Zwart-Powell")
    window.session.do(last)
    return window


def panel(window) -> Vectors:
    return window.laboratory.vectors


def vectors(window):
    return boxlab.numbered(window.session.state.lab.rules[0])


def send(widget, kind, at, buttons=Left):
    button = Qt.MouseButton.NoButton if kind == QEvent.Type.MouseMove else Left
    where = QPointF(at)
    event = QMouseEvent(kind, where, widget.mapToGlobal(where), button, buttons, Qt.KeyboardModifier.NoModifier)
    QApplication.sendEvent(widget, event)


def drag(widget, *places):
    """Press at the first place, move over the others, let go at the last."""
    send(widget, QEvent.Type.MouseButtonPress, places[0])
    for place in places[1:]:
        send(widget, QEvent.Type.MouseMove, place)
    send(widget, QEvent.Type.MouseButtonRelease, places[-1], Qt.MouseButton.NoButton)


def drag_arrow(window, *way):
    lattice = panel(window).lattice
    drag(lattice, *map(lattice.place, way))


def click(window, vector, button=Left):
    lattice = panel(window).lattice
    QTest.mouseClick(lattice, button, pos=lattice.place(vector).toPoint())


def read(window):
    """What the panel says is what the engine says of the vectors on the lattice."""
    state, shown = window.session.state, panel(window)
    upwards = np.array(shown.table.cells.rows)[::-1]
    theirs = np.array([[float(c) for c in row] for row in mask(state.vectors).rows]).T
    assert np.array_equal(upwards * 4 / upwards.sum(), theirs)  # coefficients of a mask sum to 4
    return shown.facts.text().replace("&nbsp;", "")


def says(window):
    return window.banner.words.text() if window.banner.isVisible() else ""


def test_the_panel_is_there_while_a_box_spline_leads(lab):
    assert panel(lab).isVisible()
    lab.session.do(bench.choose_family, 0, "tensor-product")
    assert not panel(lab).isVisible()
    lab.session.undo()
    assert panel(lab).isVisible()
    assert read(lab) == "degree 2 alpha 3 C<sup>1</sup>"


def test_an_arrow_is_dragged_and_everything_follows_while_it_is_held(lab):
    lattice = panel(lab).lattice
    before = lab.session.state
    send(lattice, QEvent.Type.MouseButtonPress, lattice.place((1, -1)))
    send(lattice, QEvent.Type.MouseMove, lattice.place((1, 0)))
    assert vectors(lab) == ((1, 1), (1, 0), (1, 0), (0, 1))
    assert read(lab) == "degree 2 alpha 2 C<sup>0</sup>"
    send(lattice, QEvent.Type.MouseMove, lattice.place((1, 1)))
    assert vectors(lab) == ((1, 1), (1, 1), (1, 0), (0, 1))
    send(lattice, QEvent.Type.MouseButtonRelease, lattice.place((1, 1)), Qt.MouseButton.NoButton)
    direct = bench.put(before, lab.session.state.lab).now.lead.trace.points[-1]
    assert np.array_equal(lab.session.state.trace(lab.session.state.now.lead).points[-1], direct)
    lab.session.undo()  # one drag is one change
    assert vectors(lab) == boxlab.numbered(before.lab.rules[0])


def test_an_arrow_dragged_onto_the_middle_goes(lab):
    drag_arrow(lab, (1, 1), (1, 0), (0, 0))
    assert vectors(lab) == ((1, -1), (1, 0), (0, 1))
    lab.session.undo()
    assert vectors(lab) == ((1, 1), (1, -1), (1, 0), (0, 1))


def test_a_vector_that_quadrupling_needs_stays_and_why_is_said(lab):
    before = lab.session.state
    drag_arrow(lab, (1, 0), (2, 0))
    assert "needs (1,0) at least once" in says(lab)
    click(lab, (0, 1), Qt.MouseButton.RightButton)
    assert "needs (0,1) at least once" in says(lab)
    assert lab.session.state.lab is before.lab
    with pytest.raises(TopologyError):
        boxlab.move_vector(before, 2, (2, 0))


def test_a_click_on_a_free_point_adds_a_vector_and_one_on_a_tip_only_rings_it(lab):
    click(lab, (-1, 1))
    assert vectors(lab) == ((1, 1), (1, -1), (-1, 1), (1, 0), (0, 1))
    assert read(lab) == "degree 3 alpha 3 C<sup>1</sup>"  # (1,-1) and (-1,1) are parallel
    click(lab, (1, 1))
    assert len(vectors(lab)) == 5
    assert panel(lab).lattice.ring == (1, 1)
    panel(lab).repeat.click()
    assert vectors(lab).count((1, 1)) == 2
    panel(lab).remove.click()
    panel(lab).remove.click()
    assert (1, 1) not in vectors(lab)
    click(lab, (0, 0))
    assert len(vectors(lab)) == 4


def test_the_lattice_grows_with_the_longest_vector(lab):
    lattice = panel(lab).lattice
    drag_arrow(lab, (1, 1), (2, 2))
    drag_arrow(lab, (2, 2), (3, 1))
    assert (3, 1) in vectors(lab)
    assert lattice.rect().contains(lattice.place((4, 4)).toPoint())


def test_the_lattice_by_keys_alone(lab):
    lattice, before = panel(lab).lattice, lab.session.state
    lattice.setFocus()
    at = (before.beat, before.at)
    QTest.keyClick(lab.windowHandle(), Key.Key_Up)
    QTest.keyClick(lab.windowHandle(), Key.Key_Left)
    assert lattice.ring == (0, 2)
    assert "no vector" in lattice.accessibleDescription()
    QTest.keyClick(lab.windowHandle(), Key.Key_Return)
    QTest.keyClick(lab.windowHandle(), Key.Key_Return)
    assert vectors(lab).count((0, 2)) == 2
    assert "2 times" in lattice.accessibleDescription()
    QTest.keyClick(lab.windowHandle(), Key.Key_Delete)
    QTest.keyClick(lab.windowHandle(), Key.Key_Down, Alt)
    assert vectors(lab) == ((1, 1), (1, -1), (0, 1), (1, 0), (0, 1))
    QTest.keyClick(lab.windowHandle(), Key.Key_Right, Alt)
    assert vectors(lab) == ((1, 1), (1, -1), (1, 1), (1, 0), (0, 1))
    assert lattice.ring == (1, 1)
    assert lab.session.state.at >= at[1]  # the arrows of the keyboard were the lattice's
    QTest.keyClick(lab.windowHandle(), Key.Key_PageUp)
    assert lab.session.state.is_playing  # the clicker's are still the lesson's


def rows(window):
    passes = panel(window).passes
    return [passes.item(k).text().split("  ")[1] for k in range(passes.count())]


def story(window):
    return [stage.name for stage in window.session.state.now.lead.trace.step(0).stages]


def middle(window, row):
    passes = panel(window).passes
    return passes.visualItemRect(passes.item(row)).center()


def test_passes_are_dragged_to_another_place_and_the_story_follows(lab):
    click(lab, (2, 1))
    end = lab.session.state.trace(lab.session.state.now.lead).points[-1]
    assert rows(lab) == story(lab) == ["quadruple", "average (1,1)", "average (1,-1)", "average (2,1)"]
    viewport = panel(lab).passes.viewport()
    drag(viewport, middle(lab, 3), middle(lab, 2), middle(lab, 1))
    assert rows(lab) == story(lab) == ["quadruple", "average (2,1)", "average (1,1)", "average (1,-1)"]
    lab.session.do(last)
    there = lab.session.state.trace(lab.session.state.now.lead).points[-1]
    assert np.abs(there - end).max() < 1e-12 or shifted(there, end)
    lab.session.undo()
    lab.session.undo()
    assert rows(lab)[1] == "average (1,1)"
    drag(viewport, middle(lab, 0), middle(lab, 2))  # quadrupling stays the first
    assert rows(lab)[0] == "quadruple"


def shifted(a, b):
    return np.abs(np.sort(a, axis=0) - np.sort(b, axis=0)).max() < 1e-12


def test_passes_by_keys_alone(lab):
    passes = panel(lab).passes
    passes.setFocus()
    QTest.keyClick(lab.windowHandle(), Key.Key_Down)
    assert passes.currentRow() == 1
    QTest.keyClick(lab.windowHandle(), Key.Key_Down, Alt)
    assert rows(lab) == story(lab) == ["quadruple", "average (1,-1)", "average (1,1)"]
    assert passes.currentRow() == 2
    QTest.keyClick(lab.windowHandle(), Key.Key_Down, Alt)
    assert rows(lab) == ["quadruple", "average (1,-1)", "average (1,1)"]
    QTest.keyClick(lab.windowHandle(), Key.Key_Up, Alt)
    assert rows(lab) == ["quadruple", "average (1,1)", "average (1,-1)"]
    QTest.keyClick(lab.windowHandle(), Key.Key_Delete)
    assert rows(lab) == ["quadruple", "average (1,-1)"]


def test_the_pass_that_plays_is_bold(lab):
    passes, parts = panel(lab).passes, stops(lab.session.state.lesson)
    for k, row in ((1, 0), (2, 1), (3, 2), (4, 0)):
        lab.session.do(at_stop, parts[k])
        assert [passes.item(r).font().weight() > 400 for r in range(3)] == [r == row for r in range(3)]


def test_another_order_lies_over_this_one_and_the_difference_is_zero(lab):
    panel(lab).overlay.click()
    lab.session.do(last)
    assert len(lab.session.state.now.views) == 3
    assert [pane.reading for pane in lab.viewport._picture.panes] == ["", "", "largest difference 0"]
    panel(lab).lattice.setFocus()
    QTest.keyClick(lab.windowHandle(), Key.Key_Return)
    lab.session.do(last)
    assert lab.viewport._picture.panes[2].reading == "largest difference 0"
    order = lab.session.state.lab.other.passes
    panel(lab).next.click()
    assert lab.session.state.lab.other.passes != order
    panel(lab).overlay.click()
    assert len(lab.session.state.now.views) == 1
    lab.session.do(boxlab.preset, "3-direction linear")
    panel(lab).overlay.click()
    assert "no other order" in says(lab)
    assert not panel(lab).overlay.isChecked()


def test_the_basis_function_stays_on_the_table_while_its_vectors_change(lab):
    panel(lab).basis.click()
    lab.session.do(last)
    assert lab.session.state.lab.name == boxlab.BASIS
    heights = lab.session.state.now.lead.trace.points[-1][:, 2]
    assert 0.45 < heights.max() <= 0.51
    panel(lab).preset.box.setCurrentIndex(panel(lab).preset.box.findData("Bicubic"))
    panel(lab).preset.box.activated.emit(panel(lab).preset.box.currentIndex())
    assert lab.session.state.lab.control.topology.shape == (9, 9)
    assert read(lab) == "degree 6 alpha 4 C<sup>2</sup>"
    lab.session.do(boxlab.preset, "Constant")
    assert "The limit jumps (alpha = 1)" in panel(lab).promise.text()


def test_the_picture_of_the_vectors_is_switched_on_by_its_key_and_its_box(lab):
    QTest.keyClick(lab.windowHandle(), Key.Key_D)
    assert lab.session.state.options.lattice
    assert len(lab.viewport._picture.panes) == 2
    assert panel(lab).picture.isChecked()
    panel(lab).picture.click()
    assert not lab.session.state.options.lattice


@pytest.mark.parametrize("width", [1280, 1920])
def test_every_part_fits_the_panel_and_can_be_reached_by_tab(lab, width):
    lab.resize(width, 720)
    lab._sides["details"].show()
    QApplication.processEvents()
    shown = panel(lab)
    parts = [shown.lattice, shown.repeat, shown.remove, shown.passes, shown.basis, shown.overlay, shown.picture]
    room = lab._sides["details"].viewport().width()
    for part in parts:
        right = part.mapTo(lab._sides["details"].viewport(), QPoint(part.width(), 0)).x()
        assert right <= room
        assert part.focusPolicy() & Qt.FocusPolicy.TabFocus
        assert part.toolTip()
    for button in (shown.repeat, shown.remove, shown.basis, shown.overlay):
        assert QFontMetricsF(type_face(14)).horizontalAdvance(button.text()) + 8 <= button.width()


def test_live_changes_are_quick(lab, qtbot):
    """A step of a drag on a basis net after four levels is answered within a few frames."""
    lab.session.do(boxlab.preset, "3-direction quartic")
    panel(lab).basis.click()
    lab.session.do(last)
    began = time.perf_counter()
    lab.session.do(boxlab.move_vector, 3, (1, -1))
    assert time.perf_counter() - began < 1.0

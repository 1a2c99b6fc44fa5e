"""Extraordinary points in the window: the slider under the mouse and the keys, and its numbers beside the engine's."""

from fractions import Fraction

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from app.draw.theme import THEMES
from app.gui.keys import BY_ID
from app.gui.look import colour
from app.gui.spectrum import decimals
from app.laboratory import bench
from app.state import Spot, last, look, open_lesson, valence_of
from subdivision import subdivide
from subdivision.catalogue import scheme
from subdivision.extraordinary import QUAD_PULLS, analysis
from subdivision.isolation import counts

pytestmark = pytest.mark.window


@pytest.fixture
def lab(window, qtbot):
    """The laboratory after two levels of a cube, its panel unfolded and scrolled to the slider."""
    window.session.do(bench.enter)
    window.session.do(last)
    qtbot.wait(50)
    return window


@pytest.fixture
def varied(lab, qtbot):
    QTest.mouseClick(lab.spectrum.vary, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lab.spectrum.slider.isVisible)
    return lab


def way(window):
    (found,) = window.session.state.lab.rules[0].values
    return found


def send(slider, kind, x, buttons):
    is_move = kind == QEvent.Type.MouseMove
    button, at = Qt.MouseButton.NoButton if is_move else Qt.MouseButton.LeftButton, QPointF(x, 14)
    none = Qt.KeyboardModifier.NoModifier
    QApplication.sendEvent(slider, QMouseEvent(kind, at, slider.mapToGlobal(at), button, buttons, none))


def drag(window, qtbot, *pulls):
    """Take the handle where it is and lead it along; then let go."""
    slider, held = window.spectrum.slider, Qt.MouseButton.LeftButton
    xs = [slider.x_of(float(pull)) for pull in (way(window), *pulls)]
    send(slider, QEvent.Type.MouseButtonPress, xs[0], held)
    for x in xs[1:]:
        send(slider, QEvent.Type.MouseMove, x, held)
        qtbot.wait(5)
        yield way(window)
    send(slider, QEvent.Type.MouseButtonRelease, xs[-1], Qt.MouseButton.NoButton)


def shown_points(window):
    return window.viewport._picture.scenes[0].faces[0].points


def told(window):
    """Every number of the panel is the engine's."""
    state = window.session.state
    found = analysis(state.lab.rules[0].scheme, valence_of(state))
    words = window.spectrum.words.text()
    return all(decimals(e.value) in words for e in found.eigenvalues) and all(
        f"<b>{c.name}</b>" in words and c.word in words and decimals(found.subdominant) in words
        for c in found.conditions
    )


def test_the_surface_follows_the_slider_live_and_a_drag_is_one_undo(varied, qtbot):
    before = varied.session.state
    steps = list(drag(varied, qtbot, 0.75, 0.5, 0.25))
    assert steps == [Fraction(3, 4), Fraction(1, 2), Fraction(1, 4)]
    lab = varied.session.state.lab
    direct = subdivide(lab.control, scheme("quad-pull", (Fraction(1, 4),)), lab.levels).points
    assert np.abs(shown_points(varied) - direct).max() < 1e-12
    assert told(varied)
    assert "fails: a tip" in varied.spectrum.words.text()
    varied.session.undo()
    assert varied.session.state.lab.rules == before.lab.rules
    assert "holds: a tangent plane" in varied.spectrum.words.text()
    assert varied.spectrum.slider.places[varied.spectrum.slider.value()] == way(varied) == 1


def test_the_hand_takes_a_pull_with_a_name_exactly(varied, qtbot):
    assert list(drag(varied, qtbot, 4 / 3 + 0.02)) == [Fraction(4, 3)]
    cube = varied.session.state.lab
    direct = subdivide(cube.control, scheme("catmull-clark"), cube.levels).points
    assert np.abs(shown_points(varied) - direct).max() < 1e-12


def test_the_arrows_move_the_handle_that_has_the_focus_and_not_the_lesson(varied, qtbot):
    slider, stop = varied.spectrum.slider, (varied.session.state.beat, varied.session.state.at)
    slider.setFocus(Qt.FocusReason.TabFocusReason)
    for key, there in (
        (Qt.Key.Key_Right, Fraction(17, 16)), (Qt.Key.Key_Left, 1), (Qt.Key.Key_Left, Fraction(15, 16)),
        (Qt.Key.Key_End, 2), (Qt.Key.Key_Home, 0), (Qt.Key.Key_Up, Fraction(1, 16)),
    ):  # fmt: skip
        QTest.keyClick(varied.windowHandle(), key)
        assert way(varied) == there
    assert (varied.session.state.beat, varied.session.state.at) == stop
    assert told(varied)
    varied.session.undo()
    assert way(varied) == 0


def test_the_allowed_interval_and_the_named_pulls_stand_on_the_track(varied):
    track = varied.spectrum.slider._track
    assert track.smooth == QUAD_PULLS.smooth(3)
    assert all(decimals(float(end)) in varied.spectrum.way.text() for end in (track.smooth.least, track.smooth.most))
    assert [name for _, name in track.names] == ["simple", "bounded", "Catmull-Clark"]
    x, image = varied.spectrum.slider.x_of, varied.spectrum.slider.grab().toImage()
    accent = colour(THEMES[varied.session.state.options.theme].accent)
    for pull in (0.1, 0.5, 0.7, 1.5, 1.9):
        assert (image.pixelColor(round(x(pull)), 14) == accent) == (pull in track.smooth), pull


def test_the_stepper_turns_the_valence_and_a_vertex_in_focus_has_its_own(varied, qtbot):
    QTest.mouseClick(varied.spectrum.valence.more, Qt.MouseButton.LeftButton)
    assert valence_of(varied.session.state) == 4
    assert "Regular" in varied.spectrum.way.text()
    QTest.mouseClick(varied.spectrum.valence.more, Qt.MouseButton.LeftButton)
    assert told(varied)
    at = len(varied.session.state.now.lead.trace.stages)
    varied.session.do(look, Spot(0, at, 0))
    assert valence_of(varied.session.state) == 3
    assert told(varied)
    assert list(drag(varied, qtbot, 0.5)) == [Fraction(1, 2)]
    assert valence_of(varied.session.state) == 3


def test_the_key_shows_eigenvalues_and_counts_beside_the_surface(lab, qtbot):
    assert BY_ID["spectrum"].keys == ("K",)
    QTest.keyClick(lab.windowHandle(), Qt.Key.Key_K)
    diagrams = [p.content for p in lab.viewport._picture.panes if hasattr(p.content, "notes")]
    assert len(diagrams) == 4
    c = counts(lab.session.state.now.lead.trace.stages[-1].topology)
    texts = [note.text for note in diagrams[-1].notes]
    numbers = (c.vertices, c.edges, c.faces, c.euler, c.extraordinary)
    assert texts[-6:] == [*map(str, numbers), f"{c.apart} edges"]


def test_schemes_without_a_ring_say_so_and_lessons_have_no_such_panel(lab, lesson):
    lab.session.do(bench.choose_family, 0, "doo-sabin")
    assert "Doo-Sabin" in lab.spectrum.words.text()
    assert not lab.spectrum.vary.isVisible()
    assert not lab.spectrum.slider.isVisible()
    lab.session.do(open_lesson, lesson)
    assert not lab.spectrum.isVisible()


def test_every_control_has_a_name_and_a_tip_and_is_reached_by_tab(varied):
    panel = varied.spectrum
    for control in (panel.slider, panel.vary, panel.valence.less, panel.valence.more):
        assert control.accessibleName()
        assert control.toolTip()
        assert control.focusPolicy() & Qt.FocusPolicy.TabFocus
    assert panel.slider.accessibleDescription() == "1 of the way"
    assert panel.slider.mapTo(varied, QPoint(0, 0)).x() + panel.slider.width() <= varied.width()

"""What comes next is got ready while nothing happens."""

from dataclasses import replace

import pytest

import lessons
from app.draw import formulas
from app.draw import type as type_
from app.draw.compose import compose
from app.draw.layout import overlay
from app.gui import ahead
from app.gui.ahead import Ahead
from app.gui.parts import Late
from app.state import at_stop, open_lesson, stops

pytestmark = pytest.mark.window
FORMULAS = "figure_16_cubic_pyramid", "figure_05_quadruple_then_average"


def afresh(name):
    """A lesson that nobody has told yet."""
    return replace(lessons.find(name), _turned={})


def test_what_was_got_ready_needs_no_formula_set_when_it_is_shown(window, monkeypatch):
    told = tuple(map(afresh, FORMULAS))
    monkeypatch.setattr(ahead, "built_in", lambda: told)
    monkeypatch.setattr(formulas, "prepared", dict)
    for known in (type_._set, type_._outlined, formulas.formula):
        known.cache_clear()
    for piece in ahead.pieces(lambda: window.session.state, window.viewport):
        piece()
    monkeypatch.setattr(formulas, "boxed", lambda text: pytest.fail(f"{text} had not been set"))
    for lesson in told:
        state = open_lesson(window.session.state, lesson)
        for stop in stops(lesson):
            there = at_stop(state, stop)
            for before in (0.0, *ahead.WAY):
                then = replace(there, at=max(there.at - before, there.now.start))
                overlay(compose(then), *window.viewport.room(), words=False)


def test_lessons_are_told_and_panels_made_while_the_window_rests(qtbot, window, monkeypatch):
    told = tuple(map(afresh, FORMULAS))
    monkeypatch.setattr(ahead, "built_in", lambda: told)
    getting_ready = Ahead(window.session, window.viewport)
    getting_ready.begin()
    panels = window.findChildren(Late)
    assert not any("beats" in vars(lesson) for lesson in told)
    assert not all(panel.is_made for panel in panels)
    qtbot.waitUntil(lambda: all("beats" in vars(lesson) for lesson in told), timeout=20_000)
    assert all(panel.is_made for panel in panels)
    getting_ready.stop()

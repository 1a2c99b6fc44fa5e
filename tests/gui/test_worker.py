"""Work beside the window leaves nothing behind."""

import weakref

import pytest

from app.gui.worker import Worker

pytestmark = pytest.mark.window


class Heavy:
    """What a piece of work is done on."""

    def weighed(self) -> int:
        return 7


def test_what_was_worked_on_is_given_back(qtbot, window):
    worker, told = Worker(window, window.banner), []
    objects = [Heavy(), Heavy()]
    known = [weakref.ref(each) for each in objects]
    for each in objects:  # the second one is wanted in the place of the first
        worker.start(each.weighed, told.append, told.append, waiting="", too_large="", broken="")
    del each, objects
    qtbot.waitUntil(lambda: told == [7])
    qtbot.waitUntil(lambda: not any(ref() for ref in known))
    assert not worker.is_busy

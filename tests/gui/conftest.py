"""A real window on a screen, virtual or not, and a hand-made lesson to play in it."""

import os
from collections.abc import Iterator

import pytest

pytest.importorskip("PySide6.QtWidgets")
os.environ.setdefault("QT_API", "pyside6")

from app.gui.application import NO_SCREEN, application, has_screen
from lessons.script import Beat, Lesson, play, show
from subdivision import shapes, trace
from subdivision.schemes import QUAD_CENTROID


def pytest_collection_modifyitems(items):
    if not has_screen() or os.environ.get("QT_QPA_PLATFORM", "").startswith(("offscreen", "minimal")):
        for item in items:
            if item.get_closest_marker("window"):
                item.add_marker(pytest.mark.skip(reason=f"needs a screen: {NO_SCREEN}"))


def told_cube() -> Iterator[Beat]:
    told = trace(QUAD_CENTROID, shapes.cube(), levels=2)
    yield show(told, None, "A cube.")
    yield play(told, told.stages[0], "Topology.", until=told.stages[2], formula=r"$Q \rightarrow \frac{1}{n} \sum C_k$")
    yield show(told, told.stages[2], "Look at a corner.", stencil=told.step(0).stencil(7), span=3)
    yield play(told, told.stages[3], "Again.", until=told.stages[5])


@pytest.fixture
def lesson():
    return Lesson("cube_by_hand", "A cube, by hand", "Test", told_cube)


@pytest.fixture(scope="session")
def qapp():
    """The application as the program makes it, with the OpenGL it needs."""
    app = application()
    yield app
    app.processEvents()


@pytest.fixture
def settings(tmp_path, qapp):
    from PySide6.QtCore import QSettings

    return QSettings(str(tmp_path / "window.ini"), QSettings.Format.IniFormat)


@pytest.fixture
def window(qtbot, lesson, settings):
    """The window at the lesson's first stop, painted and with its viewport up."""
    from app.gui.session import Session
    from app.gui.window import Window
    from app.state import start

    found = Window(Session(start(lesson)), settings)
    found.resize(1280, 720)
    with qtbot.capture_exceptions() as faults:
        found.show()
        qtbot.waitExposed(found)
        found.viewport.start()
        found.activateWindow()
        qtbot.waitUntil(lambda: found.isActiveWindow(), timeout=5000)
        yield found
        found.close()
        qtbot.wait(10)
    assert not faults
    for each in (found.presenter, found.manual, found):
        each.deleteLater()

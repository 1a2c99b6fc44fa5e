"""A picture is saved and copied beside the window: what takes long keeps nobody waiting, and what is there is whole."""

import os
import signal
from contextlib import contextmanager

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication, QImage

from app.draw import raster
from app.draw.vector import svg
from app.gui.saving import ordered
from app.laboratory import bench
from app.state import last, turn_view
from lessons.turn import Turn
from subdivision.files.saving import PART

pytestmark = pytest.mark.window

WAIT = 60_000


@pytest.fixture
def heavy(window):
    """The window at a surface of many faces, turned by the hand."""
    window.session.do(bench.enter)
    window.session.do(bench.set_levels, 5)
    window.session.do(last)
    window.session.do(turn_view, Turn(around=0.4, zoom=1.3))
    yield window
    raster.close()


def expected(window, kind):
    return ordered(window.viewport.picture(), kind, window.viewport.size())


def begun(qtbot, window):
    """The process that draws."""
    qtbot.waitUntil(lambda: len(window.darkroom._at) > 0, timeout=WAIT)
    (process,) = window.darkroom._at.values()
    return process


@contextmanager
def held(process):
    """However long a picture takes: this one is not drawn yet."""
    os.kill(process.pid, signal.SIGSTOP)
    try:
        yield
    finally:
        process.send_signal(signal.SIGCONT)


def saved(qtbot, window):
    qtbot.waitUntil(lambda: not window.saver.is_busy, timeout=WAIT)
    return window.banner.words.text()


def pixels_of(path):
    return np.asarray(Image.open(path).convert("RGB"))


def left_in(folder):
    return sorted(path.name for path in folder.iterdir() if path.suffix != ".ini")


def test_while_a_heavy_picture_is_saved_the_window_answers_and_the_file_is_the_picture_it_was(heavy, qtbot, tmp_path):
    order, path = expected(heavy, "png"), tmp_path / "a.png"
    heavy.save_picture_to(str(path))
    with held(begun(qtbot, heavy)):
        heavy.session.do(turn_view, Turn(around=2.0))
        qtbot.waitUntil(lambda: "Drawing the picture" in heavy.banner.words.text(), timeout=WAIT)
        now = expected(heavy, "pixels")
        heavy.copy_picture()
        qtbot.waitUntil(lambda: not heavy.copier.is_busy, timeout=WAIT)
        assert heavy.saver.is_busy
        assert not path.exists()
    copied = raster.image(now.picture, now.width, now.height)
    clipboard = QGuiApplication.clipboard().image().convertToFormat(QImage.Format.Format_RGBA8888)
    assert clipboard == QImage(copied.data, now.width, now.height, QImage.Format.Format_RGBA8888)
    assert saved(qtbot, heavy) == f"Saved {path}"
    assert np.array_equal(pixels_of(path), raster.image(order.picture, order.width, order.height)[..., :3])
    assert not np.array_equal(pixels_of(path), copied[..., :3])
    assert left_in(tmp_path) == ["a.png"]


def test_one_process_draws_picture_after_picture(heavy, qtbot, tmp_path):
    order = expected(heavy, "svg")
    heavy.save_picture_to(str(tmp_path / "a.svg"))
    drawing = begun(qtbot, heavy)
    saved(qtbot, heavy)
    heavy.save_picture_to(str(tmp_path / "b.png"))
    assert begun(qtbot, heavy) is drawing
    assert saved(qtbot, heavy) == f"Saved {tmp_path / 'b.png'}"
    assert (tmp_path / "a.svg").read_text() == svg(order.picture, order.width, order.height)


def test_a_picture_that_is_cancelled_leaves_what_was_there(heavy, qtbot, tmp_path):
    path = tmp_path / "a.svg"
    path.write_text("as it was")
    heavy.save_picture_to(str(path))
    with held(drawing := begun(qtbot, heavy)):
        qtbot.waitUntil(heavy.banner._cancel.isVisible, timeout=WAIT)
        qtbot.mouseClick(heavy.banner._cancel, Qt.MouseButton.LeftButton)
        qtbot.waitUntil(lambda: not heavy.darkroom._at, timeout=WAIT)
    assert drawing.poll() is not None
    assert not heavy.saver.is_busy
    assert heavy.banner.isHidden()
    assert path.read_text() == "as it was"
    assert left_in(tmp_path) == ["a.svg"]


def test_where_memory_runs_out_a_sentence_says_so_and_the_next_picture_is_drawn(heavy, qtbot, tmp_path):
    heavy.save_picture_to(str(tmp_path / "a.png"))
    begun(qtbot, heavy).kill()
    assert "not enough memory" in saved(qtbot, heavy)
    assert left_in(tmp_path) == []
    heavy.save_picture_to(str(tmp_path / "a.png"))
    assert saved(qtbot, heavy) == f"Saved {tmp_path / 'a.png'}"


def test_who_closes_the_window_while_a_picture_is_saved_finds_it_whole(heavy, qtbot, tmp_path):
    order, path = expected(heavy, "svg"), tmp_path / "a.svg"
    heavy.save_picture_to(str(path))
    drawing = begun(qtbot, heavy)
    heavy.close()
    assert path.read_text() == svg(order.picture, order.width, order.height)
    assert drawing.poll() is not None
    assert not any(PART.fullmatch(name) for name in left_in(tmp_path))

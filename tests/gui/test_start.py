"""Starting without a window: no screen, no such lesson; and what needs no screen at all."""

import os
import subprocess
import sys

import numpy as np
import pytest

from app.draw.picture import Camera
from app.draw.turned import turned
from app.laboratory.lab import COMFORT, Lab, Rule, affordable, lab_of, lesson_of
from lessons.turn import REST
from subdivision import Grid, Mesh, shapes
from subdivision.schemes import QUAD_CENTROID, TRIANGLE_CENTROID

SPACE = Camera(np.array([3.0, -4.0, 2.0]), np.zeros(3), np.array([0.0, 0.0, 1.0]))
PLANE = Camera(np.array([0.0, 0.0, 10.0]), np.zeros(3), np.array([0.0, 1.0, 0.0]), scale=2.0)


@pytest.mark.parametrize("display", ["", ":987"])
def test_without_a_screen_there_is_one_plain_sentence(display):
    hidden = {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}
    env = {k: v for k, v in os.environ.items() if k not in hidden} | {"DISPLAY": display}
    done = subprocess.run([sys.executable, "-m", "app"], env=env, capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "no screen" in done.stderr
    assert "Traceback" not in done.stderr


PROGRAM = """
import gc, os, sys
from PySide6.QtCore import QTimer
from app import cli
from app.gui.window import Window

def look():
    print(gc.isenabled(), gc.get_freeze_count() > 100_000, "matplotlib.figure" in sys.modules, flush=True)
    os._exit(0)

shown = Window.showEvent
def show(self, event):
    print(gc.isenabled(), self.viewport.canvas.isHidden(), flush=True)
    shown(self, event)
    QTimer.singleShot(200, look)

Window.showEvent = show
cli.main(["14", "--language", "en"])
"""


@pytest.mark.window
def test_the_window_is_shown_with_its_picture_and_garbage_is_looked_for_from_then_on(tmp_path):
    env = {**os.environ, "HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", PROGRAM], env=env, capture_output=True, text=True, timeout=60)
    assert (done.stderr, done.stdout.splitlines()) == ("", ["False False", "True True False"])


def test_qt_comes_after_all_that_it_would_look_into():
    told = "import sys, app.gui; print('PySide6' in sys.modules, 'pyvista.plotting' in sys.modules)"
    assert subprocess.check_output([sys.executable, "-c", told], text=True, timeout=60) == "False True\n"


@pytest.mark.parametrize(
    ("mesh", "scheme"),
    [(shapes.cube(), QUAD_CENTROID), (shapes.octahedron(), TRIANGLE_CENTROID)],
)
def test_a_mesh_gets_the_scheme_that_suits_its_faces(mesh, scheme):
    lesson = lesson_of(lab_of(mesh, "mine"))
    assert [b.lead.trace.scheme for b in lesson.beats[:1]] == [scheme]
    assert lesson.beats[-1].stop == len(lesson.beats[0].lead.trace.stages) == 6
    assert all(beat.text for beat in lesson.beats)


def test_a_mesh_beyond_the_budget_is_played_for_fewer_levels_and_says_so():
    for levels, (n, m) in {2: (25, 50), 1: (50, 100), 0: (100, 200)}.items():
        assert n * m == COMFORT // 4**levels
        sheet = Grid(n + 1, m + 1).mesh()
        lab = Lab("sheet", Mesh(sheet, np.zeros((sheet.n_vertices, 3))), (Rule("quad-centroid"),))
        assert affordable(lab, COMFORT) == levels
        if not levels:
            assert "too many faces" in lesson_of(lab_of(lab.control, "sheet")).beats[0].text


def test_no_turn_leaves_the_camera_where_the_lesson_put_it():
    for camera in (SPACE, PLANE):
        seen = turned(camera, REST)
        points = np.array([[0.3, 0.2, 0.1], [-1.0, 0.5, 0.4]])
        assert np.allclose(seen.project(points, 800, 600), camera.project(points, 800, 600))


def test_rotating_keeps_the_distance_and_the_vertical_and_never_the_plane():
    there = turned(SPACE, REST.rotated(0.2, 0.1))
    assert np.linalg.norm(there.position) == pytest.approx(np.linalg.norm(SPACE.position))
    assert there.up[2] > 0
    assert np.allclose(turned(PLANE, REST.rotated(0.2, 0.1)).position, PLANE.position)
    steep = turned(SPACE, REST.rotated(0, 5.0))
    assert np.arcsin(steep.position[2] / np.linalg.norm(SPACE.position)) < np.pi / 2


@pytest.mark.parametrize("camera", [SPACE, PLANE])
def test_panning_and_zooming_keep_what_is_under_the_mouse_under_it(camera):
    height = 600.0
    moved = turned(camera, REST.panned(30 / height, 40 / height)).project(np.zeros((1, 3)), 800, height)[0]
    assert moved[:2] == pytest.approx([430, 340])
    at = camera.focal + 0.2 * np.cross(camera.focal - camera.position, camera.up) / 10
    x, y, _ = camera.project(at[None], 800, height)[0]
    zoomed = turned(camera, REST.zoomed(1.7, (x - 400) / height, (y - 300) / height))
    assert zoomed.project(at[None], 800, height)[0][:2] == pytest.approx([x, y])

"""The screen goes while the window is open: one sentence, and what was open is offered at the next start."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from app.gui.autosave import Autosave
from app.gui.lost import LOST
from app.sessions.keeping import read

pytestmark = [
    pytest.mark.window,
    pytest.mark.skipif(shutil.which("Xvfb") is None, reason="needs a virtual screen that can be taken away"),
]

PROGRAM = """
import sys
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
from app.gui import application
from app.gui.window import Window
from app.state import drag, last, seek, toggle_play
import lessons

def change():
    (window,) = [each for each in QApplication.topLevelWidgets() if isinstance(each, Window)]
    window.session.do(drag, 3, (1.0, -0.25, 0.5))
    if sys.argv[1] == "playing":
        window.session.do(toggle_play)
    print("changed", flush=True)

start = Window.showEvent
Window.showEvent = lambda self, event: (start(self, event), QTimer.singleShot(1500, change))
sys.exit(application.run(lessons.find("14")))
"""


@pytest.fixture
def screen():
    """A virtual screen of our own, and its number."""
    hears, says = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(says), "-screen", "0", "1280x720x24"], pass_fds=[says],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    os.close(says)
    with os.fdopen(hears) as heard:
        number = heard.readline().strip()
    yield server, number
    server.kill()
    server.wait()


@pytest.mark.parametrize("how", ["still", "playing"])
def test_a_lost_screen_ends_the_program_in_one_sentence_and_nothing_is_lost(screen, tmp_path, window, how):
    server, number = screen
    env = {name: value for name, value in os.environ.items() if not name.startswith(("WAYLAND", "XDG", "XAUTH", "QT_"))}
    child = subprocess.Popen(
        [sys.executable, "-c", PROGRAM, how], env={**env, "DISPLAY": f":{number}", "HOME": str(tmp_path)},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=Path(__file__).parents[2],
    )  # fmt: skip
    assert child.stdout.readline() == "changed\n"
    server.kill()
    _, said = child.communicate(timeout=30)
    assert child.returncode == 1
    assert said == f"{LOST}\n"
    (log,) = tmp_path.rglob("studio.log")
    assert "the screen was lost" in log.read_text()
    (kept,) = tmp_path.rglob("*.subdivision")
    assert read(kept).edits == ((3, (1.0, -0.25, 0.5)),)
    autosave = Autosave(window.session, kept.parent)
    assert autosave.left == kept
    autosave.end()

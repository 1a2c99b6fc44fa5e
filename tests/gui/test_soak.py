"""Some hundred random actions on the window, twice; ``python -m tests.soak`` does twenty thousand."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.window


def test_whatever_a_user_does_nothing_is_raised_warned_of_or_told_differently(tmp_path):
    run = subprocess.run(
        [sys.executable, "-m", "tests.soak", "--actions", "90", "--seed", "5", "--minutes", "1",
         "--folder", str(tmp_path)],
        cwd=Path(__file__).parents[2], capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stdout + run.stderr

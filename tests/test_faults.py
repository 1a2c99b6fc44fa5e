"""What befalls a program while it writes, a few times each; ``python -m tests.faults --times 100`` is the whole."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from app.draw import film
from subdivision.files.saving import PART, part_of, save
from tests.faults.kinds import state

ROOT = Path(__file__).parent.parent
FEW = ("autosave", "session", "mesh", "picture", "export svg", "export pptx", "export many")


@pytest.mark.skipif(sys.platform == "win32", reason="children are forked")
def test_killed_full_forbidden_or_removed_the_last_good_file_stays_whole():
    done = subprocess.run(
        [sys.executable, "-m", "tests.faults", "--times", "3", "--only", *FEW],
        cwd=ROOT, capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("\nok ") + 1 == 1 + 4 * (len(FEW) - 1)
    assert done.stdout.endswith("nothing was lost\n")


def test_only_what_killed_programs_left_long_ago_is_cleared_away(tmp_path):
    old, new, other = (part_of(tmp_path / "a") for _ in range(3))
    old.mkdir()
    (old / "half").write_text("")
    new.write_text("")
    kept = [new, tmp_path / ".mine.part", tmp_path / "a.part", other.with_suffix(".other")]
    for each in kept[1:]:
        each.write_text("")
    for each in (old, *kept[1:]):
        os.utime(each, (0, 0))
    save(tmp_path / "a", [b"whole"])
    assert sorted(tmp_path.iterdir()) == sorted([*kept, tmp_path / "a"])
    assert all(PART.fullmatch(each.name) for each in (old, new, other))


def test_an_encoder_that_ends_well_but_has_complained_has_made_no_film(tmp_path, monkeypatch):
    coder = tmp_path / "ffmpeg"
    coder.write_text("#!/bin/sh\ncat >/dev/null\necho 'Error writing trailer: File too large' >&2\n")
    coder.chmod(0o755)
    monkeypatch.setattr(film, "ffmpeg", lambda: str(coder))
    shots = [film.Shot(state(0), 0.1)]
    with pytest.raises(film.FilmError, match="Error writing trailer: File too large; try another folder"):
        film.film(shots, 160, 90, tmp_path / "a.mp4")


def test_a_film_too_fast_to_rest_is_one_all_the_same():
    shots = [film.Shot(state(0), 0.1), film.Shot(state(1), 0.1)]
    assert film.gif(shots, 160, 90).startswith(b"GIF8")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a disk that is always full")
@pytest.mark.parametrize("command", [["lessons"], ["mask", "--vectors", "1,0 0,1"]])
def test_output_that_finds_no_room_is_a_sentence(command):
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "app", *command], cwd=ROOT, stdout=full, stderr=subprocess.PIPE, text=True,
            check=False,
        )  # fmt: skip
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1
    assert "could not be written" in done.stderr

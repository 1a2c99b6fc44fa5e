"""Lessons as files."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from PIL import Image

import lessons
from app.draw import film, raster
from app.figures import FigureError, render
from app.state import start, stops

CUBE = lessons.find("figure_14_cube")
SHORT = lessons.find("figure_01_lane_riesenfeld")


@pytest.fixture(autouse=True, scope="module")
def studio():
    """The off-screen window goes before the display does."""
    yield
    raster.close()


def test_a_figure_is_the_last_stop_at_its_size(tmp_path):
    written = render(SHORT, tmp_path / "new", ["png", "svg"], (640, 360))
    assert [p.name for p in written] == ["figure_01_lane_riesenfeld.png", "figure_01_lane_riesenfeld.svg"]
    with Image.open(written[0]) as figure:
        assert figure.size == (640, 360)
        assert figure.getpixel((2, 2)) == (255, 255, 255)


def test_with_steps_there_is_one_image_for_each_stop(tmp_path):
    written = render(SHORT, tmp_path, ["svg"], (640, 360), steps=True)
    assert len(written) == len(stops(SHORT))
    assert written[0].name == "figure_01_lane_riesenfeld-01.svg"
    assert len({p.read_bytes() for p in written}) == len(written)


@pytest.mark.parametrize("display", ["", ":4321"])
def test_without_a_screen_a_figure_is_drawn_and_nothing_is_complained_about(tmp_path, display):
    command = [sys.executable, "-m", "app", "figures", "14", "--out", str(tmp_path), "--size", "320x180"]
    done = subprocess.run(command, env={**os.environ, "DISPLAY": display}, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")
    with Image.open(tmp_path / "figure_14_cube.png") as figure:
        assert len(set(figure.convert("RGB").get_flattened_data())) > 100


@pytest.mark.parametrize(("background", "corner"), [("black", (0, 0, 0)), ("transparent", (0, 0, 0, 0))])
def test_the_background_is_what_was_asked_for(tmp_path, background, corner):
    (path,) = render(CUBE, tmp_path, size=(320, 180), background=background)
    with Image.open(path) as figure:
        assert figure.getpixel((1, 90)) == corner


def test_svg_is_the_same_twice(tmp_path):
    (first,) = render(CUBE, tmp_path / "a", ["svg"])
    (second,) = render(CUBE, tmp_path / "b", ["svg"])
    assert first.read_bytes() == second.read_bytes()


def test_a_film_rests_at_every_stop_and_plays_between(tmp_path):
    played = list(film.shots(start(SHORT)))
    rests = [s for s in played if s.seconds > 0.5]
    assert [(s.state.beat, s.state.at) for s in rests] == [(s.beat, s.at) for s in stops(SHORT)]
    assert len(played) > len(rests) + 10
    seen = []
    (path,) = render(SHORT, tmp_path, ["gif"], (320, 180), progress=lambda done, name: seen.append((done, name)))
    with Image.open(path) as gif:
        assert gif.size == (320, 180)
        assert len(rests) <= gif.n_frames <= len(played)  # equal frames in a row are one
        total = 0
        for k in range(gif.n_frames):
            gif.seek(k)
            total += gif.info["duration"]
    assert total == pytest.approx(1000 * sum(s.seconds for s in played), rel=0.1)
    assert [done for done, _ in seen] == sorted(done for done, _ in seen)
    assert seen[-1] == (1.0, path.name)


@pytest.mark.parametrize(
    ("choice", "says"),
    [
        ({"formats": ["pdf"]}, "png, svg or gif"),
        ({"background": "pink"}, "white, black, transparent"),
        ({"size": (10, 10)}, "64 to 16384"),
    ],
)
def test_an_unknown_choice_is_refused_in_a_sentence(tmp_path, choice, says):
    with pytest.raises(FigureError, match=says):
        render(SHORT, tmp_path / "none", **choice)
    assert not (tmp_path / "none").exists()


def test_a_folder_that_cannot_be_made_is_told(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(FigureError, match="choose another folder"):
        render(SHORT, tmp_path / "file" / "below", size=(320, 180))


def test_no_half_written_file_is_left(tmp_path, monkeypatch):
    def fail(self: Path, target: Path) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", fail)
    with pytest.raises(FigureError, match="No space left"):
        render(SHORT, tmp_path, ["svg"], (320, 180))
    assert not list(tmp_path.iterdir())

"""Lessons as files."""

import os
import re
import subprocess
import sys
from io import BytesIO
from pathlib import Path

import pytest
from PIL import Image
from vtkmodules.vtkCommonCore import vtkLogger

import lessons
from app.draw import film, raster
from app.figures import FigureError, png, render
from app.state import at_stop, start, stops

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
    assert done.returncode == 0
    assert re.fullmatch(r"3 files in \d+\.\d s\n", done.stderr)
    paths = [tmp_path / name for name in ("figure_14_cube.png", "figure_14_cube.svg", "index.html")]
    assert done.stdout.split() == [str(path) for path in paths]
    with Image.open(paths[0]) as figure:
        assert len(set(figure.convert("RGB").get_flattened_data())) > 100


@pytest.mark.parametrize(("background", "corner"), [("black", (0, 0, 0)), ("transparent", (0, 0, 0, 0))])
def test_the_background_is_what_was_asked_for(tmp_path, background, corner):
    (path,) = render(CUBE, tmp_path, size=(320, 180), background=background)
    with Image.open(path) as figure:
        assert figure.getpixel((1, 90)) == corner


def test_every_beat_of_every_lesson_is_drawn_and_nothing_is_complained_about(capfd):
    """And has more than words on it: some colours in its panes."""
    png(start(CUBE), (320, 180))
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_WARNING)  # the off-screen window is there: now it may speak up
    for lesson in lessons.all_lessons():
        for stop in {stop.beat: stop for stop in stops(lesson)}.values():  # the last of each beat
            with Image.open(BytesIO(png(at_stop(start(lesson), stop), (320, 180)))) as figure:
                assert figure.size == (320, 180)
                assert len(figure.getcolors(1 << 16)) > 20, f"{lesson.id}, beat {stop.beat}"
    assert capfd.readouterr() == ("", "")


def test_vector_figures_are_the_same_in_two_processes(tmp_path):
    """Of every lesson; whatever order hashing gives to sets."""
    command = [sys.executable, "-m", "app", "figures", "--format", "svg", "--size", "320x180", "--out"]
    both = [
        subprocess.Popen(
            [*command, str(tmp_path / seed)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            env={**os.environ, "PYTHONHASHSEED": seed, "DISPLAY": ""},
        )
        for seed in "12"
    ]  # fmt: skip
    assert [each.wait(timeout=300) for each in both] == [0, 0]
    first, second = (sorted((tmp_path / seed).iterdir()) for seed in "12")
    assert [p.name for p in first] == sorted([*(f"{each.id}.svg" for each in lessons.all_lessons()), "index.html"])
    assert [p.read_bytes() for p in first] == [p.read_bytes() for p in second]


def test_a_vector_figure_does_not_remember_what_was_drawn_before(tmp_path):
    (first,) = render(CUBE, tmp_path / "a", ["svg"])
    (second,) = render(CUBE, tmp_path / "b", ["svg"])
    assert first.read_bytes() == second.read_bytes()


@pytest.mark.parametrize(("theme", "background", "corner"), [
    ("projector", "", "#ffffff"), ("light", "", "#faf8f5"), ("dark", "", "#17191d"), ("light", "white", "#ffffff"),
    ("", "", "#ffffff"), ("", "black", "#000000"), ("dark", "black", "#000000"),
])  # fmt: skip
def test_a_figure_wears_the_theme_it_was_given_and_stands_on_its_background(tmp_path, theme, background, corner):
    (path,) = render(SHORT, tmp_path, ["svg"], background=background, theme=theme)
    assert f'height="1080" fill="{corner}"' in path.read_text(encoding="utf-8")


def test_a_figure_has_the_lectures_own_colours_when_asked(tmp_path):
    named = next(each for each in lessons.all_lessons() if each.colours)
    plain, own = (
        [path.read_bytes() for path in render(named, tmp_path / name, ["svg"], steps=True, as_caption=is_own)]
        for name, is_own in (("plain", False), ("own", True))
    )
    assert plain != own


def test_a_lesson_with_a_knob_turned_is_another_file(tmp_path):
    lesson = next(each for each in lessons.all_lessons() if each.knobs)
    knob = lesson.knobs[0]
    other = lesson.turned(**{knob.name: knob.least if knob.start != knob.least else knob.most})
    names = {render(each, tmp_path, ["svg"])[0].name for each in (lesson, other)}
    assert names == {f"{lesson.id}.svg", f"{lesson.id}-{knob.name}-{other.settings[knob.name]}.svg"}


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
        ({"theme": "sepia"}, "light, dark, projector"),
        ({"theme": "dark", "background": "white"}, "choose background theme"),
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

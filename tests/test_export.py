"""What is taken away: each format opened by another program, and nothing half-written left."""

import json
import re
import shutil
import signal
import subprocess
import sys
import time
import zipfile
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from pptx import Presentation

import lessons
from app.cli import main
from app.draw import film, raster
from app.draw.compose import compose, said
from app.draw.pdf import pdf
from app.draw.seen import seen
from app.export import FORMATS, ExportError, Wish, export
from app.export.making import mesh_of
from app.export.worker import told
from app.figures import png
from app.sessions.keeping import write
from app.state import at_stop, choose, drag, last, start, stops, turn_view
from lessons.script import Lesson, play, show
from lessons.turn import Turn
from subdivision import files, shapes, subdivide, trace
from subdivision.files.saving import BEGIN, clear, part_of
from subdivision.limit import limit_mesh
from subdivision.schemes import QUAD_CENTROID

SMALL = (320, 180)
CUBE = lessons.find("figure_14_cube")


def story():
    told = trace(QUAD_CENTROID, shapes.cube())
    yield show(told, None, "A cube.", notes="Ask for the valence.")
    yield play(told, told.stages[0], "Topology.", until=told.stages[2], formula=r"$Q \rightarrow \frac{1}{n} \sum C_k$")


SHORT = Lesson("short", "A cube, by hand", "Test", story)
STEPS = len(stops(SHORT))


@pytest.fixture(autouse=True, scope="module")
def studio():
    """The off-screen window goes before the display does."""
    yield
    raster.close()


def needs(program):
    return pytest.mark.skipif(shutil.which(program) is None, reason=f"needs {program}")


def said_by(*command):
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True).stdout


def left_in(folder):
    return sorted(path.name for path in folder.rglob("*"))


# -- PDF --------------------------------------------------------------------------------------


@needs("pdftotext")
def test_a_pdf_has_a_page_a_step_with_its_words_as_words_in_the_shipped_typeface(tmp_path):
    (path,) = export(start(SHORT), Wish("pdf"), tmp_path / "a.pdf")
    assert f"Pages:           {STEPS}" in said_by("pdfinfo", path)
    text = said_by("pdftotext", path, "-")
    assert text.count("A cube, by hand") == STEPS
    assert "A cube." in text
    fonts = said_by("pdffonts", path).splitlines()[2:]
    assert any("Inter-Regular" in line for line in fonts)
    assert any("Inter-SemiBold" in line for line in fonts)
    assert all(re.search(r"yes\s+yes\s+yes", line) for line in fonts)  # embedded, a subset, with their characters
    assert said_by("pdfimages", "-list", path).count("\n") == 2  # a heading and no image


@needs("pdftoppm")
@pytest.mark.parametrize("name", ["14", "20", "1a", "5"])
def test_a_pdf_shows_what_the_png_shows(tmp_path, name):
    state = last(start(lessons.find(name)))
    (tmp_path / "a.pdf").write_bytes(pdf(compose(state), 960, 540))
    (tmp_path / "a.png").write_bytes(png(state, (960, 540)))
    said_by("pdftoppm", "-r", "72", "-png", "-singlefile", tmp_path / "a.pdf", tmp_path / "b")
    a, b = (np.asarray(Image.open(tmp_path / f"{k}.png").convert("L"), dtype=float) for k in "ab")
    assert a.shape == b.shape
    assert np.abs(a - b).mean() < 5
    assert (np.abs(a - b) > 64).mean() < 0.03


@needs("pdftoppm")
def test_a_transparent_pdf_has_nothing_behind_it(tmp_path):
    paths = [tmp_path / f"{ground}.pdf" for ground in ("theme", "transparent")]
    for path in paths:
        export(start(SHORT), Wish("pdf", "view", background=path.stem), path)
    corners = []
    for path in paths:
        said_by("pdftocairo", "-r", "36", "-png", "-transp", "-singlefile", path, path.with_suffix(""))
        corners.append(Image.open(path.with_suffix(".png")).convert("RGBA").getpixel((2, 2))[3])
    assert corners == [255, 0]


def test_the_same_pdf_is_the_same_bytes():
    picture = compose(last(start(SHORT)))
    assert pdf(picture, 640, 360) == pdf(picture, 640, 360)


@needs("pdftotext")
def test_a_handout_has_several_steps_a_sheet_of_a4_with_captions_and_notes(tmp_path):
    (path,) = export(start(SHORT), Wish("handout"), tmp_path / "handout")
    assert path.name == "handout.pdf"
    info = said_by("pdfinfo", path)
    assert f"Pages:           {-(-STEPS // 4)}" in info
    assert "A4" in info
    text = said_by("pdftotext", path, "-")
    assert "A cube." in text
    assert "Ask for the valence." in text


def test_every_lesson_fits_on_a_handout():
    from app.draw.type import measure
    from app.export import handout

    for lesson in lessons.all_lessons():
        for stop in {stop.beat: stop for stop in stops(lesson)}.values():
            row = handout._Row(at_stop(start(lesson), stop), stop.beat + 1, is_last=True)
            words = list(row._words(seen(row.step), 100.0))
            assert max(w.y for w in words) <= 100 + handout.TALL - 2, f"{lesson.id}, beat {stop.beat}"
            assert max(w.x + measure(w.text, w.size, w.bold)[0] for w in words) <= handout.A4[0] - handout.MARGIN + 1


# -- PowerPoint -------------------------------------------------------------------------------


def test_a_deck_has_a_slide_a_step_with_picture_caption_formula_and_notes(tmp_path):
    (path,) = export(start(SHORT), Wish("pptx", size=SMALL), tmp_path / "deck.pptx")
    deck = Presentation(path)
    assert len(deck.slides) == STEPS
    assert deck.slide_width / deck.slide_height == pytest.approx(16 / 9, rel=1e-3)
    for slide, stop in zip(deck.slides, stops(SHORT), strict=True):
        state = at_stop(start(SHORT), stop)
        words = [shape.text_frame.text.replace("\v", " ") for shape in slide.shapes if shape.has_text_frame]
        assert slide.shapes.title.text == SHORT.title
        assert said(state, state.now) in words
        assert compose(state).corner in words
        pictures = [shape for shape in slide.shapes if not shape.has_text_frame]
        assert len(pictures) == 1 + bool(state.now.formula)
        assert pictures[0].width == deck.slide_width
        for shape in slide.shapes:
            assert 0 <= shape.top <= shape.top + shape.height <= deck.slide_height * 1.001
    assert [slide.notes_slide.notes_text_frame.text for slide in deck.slides if slide.has_notes_slide] == [
        "Ask for the valence."
    ]


def test_the_picture_of_a_slide_is_the_part_of_the_figure_between_its_words(tmp_path):
    state = last(start(SHORT))
    (path,) = export(state, Wish("pptx", "view", size=(640, 360)), tmp_path / "deck.pptx")
    with zipfile.ZipFile(path) as deck:
        media = [name for name in deck.namelist() if name.endswith(".png")]
        images = [np.asarray(Image.open(deck.open(name)).convert("RGB")) for name in media]
    (tmp_path / "whole.png").write_bytes(png(state, (640, 360)))
    whole = np.asarray(Image.open(tmp_path / "whole.png").convert("RGB"))
    part = next(image for image in images if image.shape[1] == 640)
    assert any(np.array_equal(part, whole[k : k + len(part)]) for k in range(len(whole) - len(part) + 1))


# -- films ------------------------------------------------------------------------------------


@needs("ffmpeg")
def test_a_film_is_h264_of_its_size_and_as_long_as_its_shots(tmp_path):
    (path,) = export(last(start(SHORT)), Wish("mp4", "view", (321, 181), pace=2.0), tmp_path / "f.mp4")
    shots = list(film.stage_shots(last(start(SHORT)), film.FINE, 2.0))
    found = json.loads(said_by("ffprobe", "-v", "error", "-show_streams", "-of", "json", path))["streams"]
    assert [(s["codec_name"], s["pix_fmt"], s["width"], s["height"]) for s in found] == [("h264", "yuv420p", 322, 182)]
    assert float(found[0]["duration"]) == pytest.approx(sum(s.seconds for s in shots), abs=0.1)


def test_a_film_of_the_view_plays_the_stage_that_led_there():
    places = stops(SHORT)
    for k, stop in enumerate(places):
        shots = list(film.stage_shots(at_stop(start(SHORT), stop)))
        begin, end = (shots[0].state.at, shots[-1].state.at)
        assert (begin, end) == ((places[k - 1].at, stop.at) if k > 1 else (0, 1))
        assert all(a.state.at < b.state.at for a, b in pairwise(shots))


def test_at_twice_the_pace_a_film_takes_half_the_time():
    once, twice = (sum(s.seconds for s in film.shots(start(SHORT), pace=pace)) for pace in (1.0, 2.0))
    assert twice == pytest.approx(once / 2, rel=0.01)


def test_a_gif_of_the_view_is_that_stage(tmp_path):
    (path,) = export(last(start(SHORT)), Wish("gif", "view", SMALL), tmp_path / "f.gif")
    with Image.open(path) as gif:
        assert gif.size == SMALL
        assert gif.n_frames > 10


def test_without_ffmpeg_a_sentence_says_how_to_get_it(tmp_path, monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(ExportError, match="or choose GIF"):
        export(start(SHORT), Wish("mp4", "view", SMALL), tmp_path / "f.mp4")
    assert left_in(tmp_path) == []


def test_an_ffmpeg_that_fails_is_told_in_its_own_words(tmp_path, monkeypatch):
    program = tmp_path / "ffmpeg"
    program.write_text("#!/bin/sh\necho 'Unknown encoder libx264' >&2\nexit 1\n")
    program.chmod(0o755)
    monkeypatch.setattr(film, "ffmpeg", lambda: str(program))
    with pytest.raises(ExportError, match="Unknown encoder libx264"):
        export(start(SHORT), Wish("mp4", "view", SMALL), tmp_path / "f.mp4")
    assert left_in(tmp_path) == ["ffmpeg"]


# -- meshes -----------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl"])
def test_a_lesson_gives_its_mesh_level_by_level(tmp_path, suffix):
    paths = export(start(CUBE), Wish(suffix), tmp_path / "meshes")
    assert [p.name for p in paths] == [f"figure_14_cube-level-{k}.{suffix}" for k in range(4)]
    for k, path in enumerate(paths):
        mesh = subdivide(shapes.cube(), QUAD_CENTROID, k)
        assert files.read(path).topology.n_vertices == mesh.topology.n_vertices


def test_the_mesh_of_the_view_is_its_finest_at_any_level_and_at_its_limit():
    state = last(start(CUBE))
    assert mesh_of(state).topology.n_faces == 384
    assert mesh_of(state, 1).topology.n_faces == 24
    assert mesh_of(state, 5).topology.n_faces == 6 * 4**5
    fine = subdivide(shapes.cube(), QUAD_CENTROID, 3)
    assert np.abs(mesh_of(state, limit=True).points - limit_mesh(fine, QUAD_CENTROID).points).max() < 1e-12


def test_a_dragged_point_is_dragged_in_the_mesh():
    state = drag(last(start(SHORT)), 0, (-3.0, -3.0, -3.0))
    assert np.array_equal(mesh_of(state, 0).points[0], [-3.0, -3.0, -3.0])
    assert not np.array_equal(mesh_of(state).points, mesh_of(last(start(SHORT))).points)


def test_a_polygon_has_no_mesh_to_take_away(tmp_path):
    with pytest.raises(ExportError, match="choose a picture"):
        export(start(lessons.find("1")), Wish("obj"), tmp_path / "none")
    assert left_in(tmp_path) == []


# -- what is exported -------------------------------------------------------------------------


def test_pictures_of_a_lesson_are_its_steps_and_of_a_view_just_that(tmp_path):
    paths = export(start(SHORT), Wish("svg", size=SMALL), tmp_path / "steps")
    assert [p.name for p in paths] == [f"short-{k + 1:02}.svg" for k in range(STEPS)]
    (path,) = export(last(start(SHORT)), Wish("svg", "view", SMALL), tmp_path / "view")
    assert path == tmp_path / "view.svg"
    assert path.read_bytes() == paths[-1].read_bytes()
    assert left_in(tmp_path) == sorted(["steps", "view.svg", *(p.name for p in paths)])


def test_the_view_is_exported_as_the_hand_has_turned_it(tmp_path):
    straight = last(start(SHORT))
    turned = turn_view(straight, Turn(around=0.5, zoom=1.5))
    a, b = (export(s, Wish("svg", "view", SMALL), tmp_path / f"{k}.svg")[0] for k, s in enumerate((straight, turned)))
    assert a.read_bytes() != b.read_bytes()
    assert seen(straight) is not None
    camera = seen(turned).scenes[0].camera
    assert not np.allclose(camera.position, seen(straight).scenes[0].camera.position)


def test_everything_is_every_lesson_in_the_looks_of_the_state(tmp_path, monkeypatch):
    monkeypatch.setattr(lessons, "all_lessons", lambda: (SHORT, replace(SHORT, id="other")))
    paths = export(choose(start(SHORT), theme="dark"), Wish("svg", "everything", SMALL), tmp_path / "all")
    assert [p.name for p in paths] == [f"{name}-{k + 1:02}.svg" for name in ("short", "other") for k in range(STEPS)]
    assert all("#17191d" in p.read_text(encoding="utf-8") for p in paths)


@pytest.mark.parametrize(("wish", "says"), [
    (Wish("doc"), "choose one of png"), (Wish("png", "half"), "view, lesson, everything"),
    (Wish("png", size=(10, 10)), "64 to 16384"), (Wish("pptx", background="transparent"), "cannot be transparent"),
    (Wish("png", background="black"), "which black hides"), (Wish("mp4", pace=100), "0.1 to 10"),
    (Wish("obj", "view", level=20), "levels go from 0"),
])  # fmt: skip
def test_a_wish_that_cannot_be_fulfilled_is_refused_in_a_sentence(tmp_path, wish, says):
    with pytest.raises(ExportError, match=says):
        export(start(SHORT), wish, tmp_path / "none")
    assert left_in(tmp_path) == []


# -- whole or not at all ----------------------------------------------------------------------

CHEAP = [name for name in FORMATS if name != "mp4"]


@pytest.mark.parametrize("name", CHEAP)
def test_on_a_full_disk_nothing_is_left_and_what_was_there_stays(tmp_path, monkeypatch, name):
    state = last(start(SHORT))
    target = tmp_path / f"old{FORMATS[name].suffix}"
    target.write_bytes(b"old")

    def full(self, data):
        with self.open("wb") as file:
            file.write(bytes(data)[:10])
        raise OSError(28, "No space left on device")

    def full_too(path, pieces):
        full(Path(path), b"".join(pieces))

    monkeypatch.setattr(Path, "write_bytes", full)
    monkeypatch.setattr(files, "save", full_too)
    with pytest.raises(ExportError, match=r"[Nn]o space"):
        export(state, Wish(name, "view", SMALL), target)
    monkeypatch.undo()
    assert target.read_bytes() == b"old"
    assert left_in(tmp_path) == [target.name]


@pytest.mark.parametrize("name", FORMATS)
def test_cancelled_in_the_middle_nothing_is_left(tmp_path, name):
    if name == "mp4" and shutil.which("ffmpeg") is None:
        pytest.skip("needs ffmpeg")
    seen_parts = []

    def stop(done, called):
        seen_parts.append(done)
        if done > 0.2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        export(start(SHORT), Wish(name, "lesson", SMALL), tmp_path / "out", stop)
    assert 0.2 < seen_parts[-1] < 1.0 or len(seen_parts) > 1
    assert left_in(tmp_path) == []


def test_a_folder_that_is_not_there_is_told(tmp_path):
    with pytest.raises(ExportError, match="there is no folder"):
        export(start(SHORT), Wish("svg", "view", SMALL), tmp_path / "no" / "a.svg")


def test_progress_never_goes_back_and_ends_at_one(tmp_path):
    heard = []
    export(start(SHORT), Wish("pdf", size=SMALL), tmp_path / "a.pdf", lambda done, name: heard.append(done))
    assert heard == sorted(heard)
    assert heard[-1] == 1.0


# -- the command ------------------------------------------------------------------------------


def run(capsys, *arguments):
    status = main([str(each) for each in arguments])
    out = capsys.readouterr()
    return status, out.out, out.err


def test_the_command_exports_what_the_suffix_says(tmp_path, capsys):
    status, out, err = run(capsys, "export", 14, "--step", 2, "-o", tmp_path / "cube.glb")
    assert (status, err) == (0, "")
    assert out.strip() == str(tmp_path / "cube.glb")
    status, out, _ = run(capsys, "export", 14, "--format", "stl", "-o", tmp_path / "meshes", "--limit")
    assert (status, len(out.split())) == (0, 4)


def test_the_command_exports_a_session_as_it_was(tmp_path, capsys):
    state = turn_view(last(start(CUBE)), Turn(around=1.0))
    session = write(tmp_path / "seminar", state)
    status, _, err = run(
        capsys, "export", session, "--of", "view", "-o", tmp_path / "a.svg", "--size", "320x180"
    )  # fmt: skip
    assert (status, err) == (0, "")
    export(state, Wish("svg", "view", SMALL), tmp_path / "b.svg")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


@pytest.mark.parametrize(("arguments", "says"), [
    (["14", "-o", "a.xyz"], "add --format"), (["99", "-o", "a.pdf"], "99"),
    (["14", "-o", "/no/such/place/a.obj", "--step", "1"], "there is no folder"),
])  # fmt: skip
def test_the_command_says_what_is_wrong(capsys, arguments, says):
    status, out, err = run(capsys, "export", *arguments)
    assert (status, out) == (1, "")
    assert says in err
    assert len(err.splitlines()) == 1


@pytest.fixture
def interruptible():
    """Who runs in the background ignores Ctrl+C, and so does who is started by it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("end", [signal.SIGTERM, signal.SIGINT])
def test_a_command_that_is_ended_leaves_nothing_half_written_and_says_nothing(tmp_path, end):
    command = [sys.executable, "-m", "app", "export", "14", "-o", str(tmp_path / "pictures"), "--format", "png"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        while not left_in(tmp_path) and process.poll() is None:
            time.sleep(0.05)
        process.send_signal(end)
        out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (128 + end, "", "")
    assert left_in(tmp_path) == []


@pytest.mark.parametrize("when", ["cancelled", "left alone"])
def test_a_process_tells_its_progress_and_stops_when_nobody_listens(tmp_path, when):
    path = tmp_path / ("a.gif" if when == "cancelled" else "a.pdf")
    command = [sys.executable, "-m", "app", "export", "14", "-o", str(path), "--size", "640x360", "--progress"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        first = process.stdout.readline()
        assert told(first) == (0.0, told(first)[1])
        if when == "cancelled":
            process.stdin.close()
            process.stdin = None
        rest = process.stdout.read()
        assert process.wait(timeout=60) == 0
    if when == "cancelled":
        assert left_in(tmp_path) == []
    else:
        *heard, last_line = rest.splitlines()
        assert [told(line)[0] for line in heard] == sorted(told(line)[0] for line in heard)
        assert left_in(tmp_path) == ["a.pdf"]
        assert last_line == str(path)


def test_what_a_killed_export_has_left_is_found_by_its_name_and_nothing_else_goes(tmp_path, monkeypatch):
    monkeypatch.setenv(BEGIN, "0a1b2c3d")
    mine, folder = part_of(tmp_path / "a.gif"), part_of(tmp_path / "all")
    monkeypatch.delenv(BEGIN)
    other = part_of(tmp_path / "b.gif")
    for file in (mine, other, tmp_path / ".0a1b2c3d.txt"):
        file.write_bytes(b"half")
    folder.mkdir()
    clear(tmp_path, "0a1b2c3d")
    assert sorted(tmp_path.iterdir()) == sorted([other, tmp_path / ".0a1b2c3d.txt"])

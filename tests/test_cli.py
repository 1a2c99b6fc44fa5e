"""The command line as a user types it: what it prints, and its one sentence when something is wrong."""

import json
import logging
import re
import subprocess
import sys
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

import lessons
from app.cli import main
from app.log import BUG
from subdivision import Mesh, files, shapes, subdivide
from subdivision.schemes import SCHEMES


def run(capsys, *arguments):
    """Exit status, output and errors of one command."""
    try:
        status = main([str(a) for a in arguments])
    except SystemExit as stop:  # argparse leaves this way
        status = stop.code
    out, err = capsys.readouterr()
    return status, out, err


def test_lessons_lists_every_lesson_with_its_steps_under_its_section(capsys):
    _, plain, _ = run(capsys, "lessons")
    _, listed, _ = run(capsys, "lessons", "--json")
    rows = json.loads(listed)
    assert {"figure_01_lane_riesenfeld", "figure_14_cube"} <= {row["id"] for row in rows}
    assert all(row["steps"] and row["title"] for row in rows)
    headings = [line for line in plain.splitlines() if line[0] != " "]
    assert headings == list(dict.fromkeys(row["section"] for row in rows)) == sorted(headings)
    assert [line.split()[0] for line in plain.splitlines() if line[0] == " "] == [row["id"] for row in rows]
    for row, lesson in zip(rows, lessons.all_lessons(), strict=True):
        assert row["ours"] == lesson.ours
        told = [(knob["name"], knob["least"], knob["most"], knob["start"]) for knob in row["knobs"]]
        assert told == [(knob.name, knob.least, knob.most, knob.start) for knob in lesson.knobs]


@pytest.mark.parametrize(
    ("name", "starts"),
    [
        ("14", "figure_14"), ("1", "figure_01"), ("Figure 5", "figure_05"), ("figure_22_quartic", "figure_22"),
        ("1a", "exercise_1a"), ("exercise 1b", "exercise_1b"), ("cube", "figure_14"), ("exercise", "exercise_1a"),
    ],
)  # fmt: skip
def test_a_lesson_is_found_by_what_it_is_called(name, starts):
    assert lessons.find(name).id.startswith(starts)


def test_a_section_is_found_by_its_number_and_means_its_first_lesson():
    for section in {each.section for each in lessons.all_lessons() if "." in each.section}:
        first = next(each for each in lessons.all_lessons() if each.section == section)
        assert lessons.find(section.split()[0]) is first


@pytest.mark.parametrize("name", ["", " ", "figure_1x", "5.2", "_", "99", "²", "ube", "a.b(*"])
def test_what_is_no_lesson_is_told_with_what_there_is(name):
    with pytest.raises(KeyError, match=f"there is no lesson '{re.escape(name)}'; there are .*figure_01"):
        lessons.find(name)


def test_figures_are_drawn_once_each_in_the_lectures_order_with_the_knobs_turned(capsys, tmp_path):
    lesson = next(each for each in lessons.all_lessons() if each.knobs)
    knob = lesson.knobs[0]
    value = knob.most if knob.most != knob.start else knob.least
    args = ["figures", lesson.id, "14", lesson.id, "--set", f"{knob.name}={value}", "--out", tmp_path / "new"]
    status, out, err = run(capsys, *args, "--format", "svg", "--theme", "projector", "--as-caption")
    assert status == 0, err
    drawn = [f"{lesson.id}-{knob.name}-{value}.svg", "figure_14_cube.svg"]
    order = [each.id for each in lessons.all_lessons()]
    drawn.sort(key=lambda name: order.index(re.split(r"[-.]", name)[0]))
    assert out.split() == [str(tmp_path / "new" / name) for name in [*drawn, "index.html"]]
    assert re.fullmatch(r"3 files in \d+\.\d s\n", err)


def test_the_window_opens_at_the_lesson_with_its_knobs_turned(capsys, monkeypatch):
    opened = []
    window = SimpleNamespace(run=lambda *given, **_: opened.append(given))
    monkeypatch.setitem(sys.modules, "app.gui.application", window)
    lesson = next(each for each in lessons.all_lessons() if each.knobs)
    knob = lesson.knobs[0]
    setting = f"{knob.name}={knob.least}"
    assert run(capsys, lesson.id, "--step", 2, "--set", setting, "--theme", "dark", "--as-caption")[0] == 0
    assert run(capsys)[0] == 0
    assert opened == [(lesson.turned(**{knob.name: knob.least}), 2, "dark", True), (None, None, "", False)]


@pytest.mark.parametrize("command", [[], ["figures", "--out", "none"]])
def test_a_knob_that_is_not_there_or_turned_too_far_is_told_with_what_there_is(capsys, tmp_path, monkeypatch, command):
    monkeypatch.chdir(tmp_path)
    lesson = next(each for each in lessons.all_lessons() if each.knobs)
    knob = lesson.knobs[0]
    span = f"{knob.least} to {knob.most}"
    for setting, words in [
        (f"{knob.name}={knob.most + 1}", f"from {span}, not to {knob.most + 1}"), ("self=3", f"{knob.name} ({span})"),
    ]:  # fmt: skip
        status, out, err = run(capsys, *command, lesson.id, "--set", setting)
        assert (status, out) == (1, "")
        assert words in err
        assert len(err.splitlines()) == 1
    status, _, err = run(capsys, *command, lesson.id, "--set", "5")
    assert status == 2
    assert "degree=5" in err
    assert "there is none" in run(capsys, *command, "14", "--set", "tallness=3")[2]
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda s: s.name)
def test_subdivide_writes_what_the_engine_computes_in_full_precision(capsys, tmp_path, scheme):
    mesh = shapes.torus() if scheme.accepts(shapes.torus().topology) else shapes.icosahedron()
    source, target = tmp_path / "in.obj", tmp_path / "out.ply"
    files.write(source, mesh)
    status, _, err = run(capsys, "subdivide", source, "-o", target, "--scheme", scheme.name, "--levels", 2)
    assert (status, err) == (0, "")
    written, expected = files.read(target), subdivide(mesh, scheme, 2)
    assert np.array_equal(written.points, expected.points)
    assert written.surface.loops() == expected.surface.loops()


def test_boundaries_and_limits_reach_the_file(capsys, tmp_path):
    source = tmp_path / "sheet.obj"
    files.write(source, shapes.quad_sheet())
    points = {}
    for rule in ("edge", "edge-and-corner", "hide", "literal"):
        target = tmp_path / f"{rule}.obj"
        status, _, err = run(
            capsys, "subdivide", source, "-o", target, "--scheme", "quad-centroid", "--levels", 1, "--boundary", rule
        )
        assert (status, err) == (0, "")
        points[rule] = files.read(target)
    corner = shapes.quad_sheet().points[0]
    assert np.array_equal(points["edge-and-corner"].points[0], corner)
    assert not np.allclose(points["edge"].points[0], corner)
    assert points["hide"].surface.n_faces == 4 * 4  # the 2 by 2 faces inside, each split in four
    target = tmp_path / "limit.obj"
    args = ["subdivide", source, "-o", target, "--scheme", "catmull-clark", "--levels", 1]
    assert run(capsys, *args, "--limit")[0] == 0
    status, _, err = run(capsys, *args, "--limit", "--boundary", "literal")
    assert status == 1
    assert "literal" in err


def test_stencil_prints_exact_weights_that_sum_to_one(capsys):
    _, out, _ = run(capsys, "stencil", "--scheme", "catmull-clark", "--valence", 5, "--json")
    weights = json.loads(out)["weights"]
    assert weights["V"]["weight"] == "13/20"  # 1 - 7/(4 n)
    assert sum(Fraction(w["weight"]) for w in weights.values()) == 1
    _, out, _ = run(capsys, "stencil", "--scheme", "loop", "--valence", 5)
    assert "cos(2π/5)" in out
    assert "0.0840932" in out


def test_mask_prints_the_quartic_and_explains_a_jump(capsys):
    _, out, _ = run(capsys, "mask", "--vectors", "1,0 0,1 1,1 1,0 0,1 1,1")
    assert "1  6 10  6  1" in out
    assert "C^2" in out
    _, out, _ = run(capsys, "mask", "--vectors", "1,0 0,1", "--json")
    assert json.loads(out)["continuity"] == -1
    assert "jumps" in json.loads(out)["promise"]


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (["figure_99"], 1, "there is no lesson"),
        (["subdivide", "nowhere.obj", "-o", "x.obj", "--scheme", "loop", "--levels", "1"], 1, "nowhere.obj"),
        (["subdivide", "CUBE", "-o", "x.obj", "--scheme", "loop", "--levels", "1"], 1, "triangle"),
        (["subdivide", "CUBE", "-o", "x.ply", "--scheme", "loop", "--levels", "x"], 2, "--levels"),
        (["subdivide", "CUBE", "-o", "x.xyz", "--scheme", "catmull-clark", "--levels", "1"], 1, "xyz"),
        (["subdivide", "CUBE", "-o", "x.obj", "--scheme", "catmull-clark", "--levels", "15"], 1, "fewer levels"),
        (["stencil", "--scheme", "loop", "--valence", "2"], 1, "valence"),
        (["stencil", "--scheme", "loop", "--valence", "5", "--point", "face"], 1, "face"),
        (["mask", "--vectors", "1,0 2,0"], 1, "(0,1)"),
        (["mask", "--vectors", "1,x"], 2, "integer pairs"),
        (["figures"], 2, "--out"),
        (["figures", "--out", "x", "--size", "big"], 2, "1920x1080"),
        (["figures", "--out", "x", "--format", "pdf"], 2, "png, svg, gif"),
        (["figures", "--out", "x", "--theme", "sepia"], 2, "projector"),
        (["figures", "14", "--out", "x", "--theme", "dark", "--background", "white"], 1, "choose background theme"),
        (["--set", "degree=3"], 1, "name the lesson"),
        (["subdivide", "a.obj", "-o", "b.obj", "--scheme", "loop", "--levels", "-1"], 2, "negative"),
    ],
)
def test_a_fault_is_one_sentence_and_leaves_no_file(capsys, tmp_path, monkeypatch, arguments, status, words):
    monkeypatch.chdir(tmp_path)
    files.write(tmp_path / "cube.obj", Mesh(shapes.cube().topology, shapes.cube().points))
    code, out, err = run(capsys, *["cube.obj" if a == "CUBE" else a for a in arguments])
    assert code == status
    assert words in err
    assert out == ""
    assert "Traceback" not in err
    if status == 1:
        assert len(err.strip().splitlines()) == 1
    assert sorted(p.name for p in tmp_path.iterdir()) == ["cube.obj"]


@pytest.mark.parametrize("suffix", ["obj", "ply"])
def test_a_sheet_that_is_all_boundary_leaves_nothing_to_save_and_says_so(capsys, tmp_path, suffix):
    source, target = tmp_path / "one.obj", tmp_path / f"out.{suffix}"
    source.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    args = ["subdivide", source, "-o", target, "--scheme", "quad-centroid", "--levels", 1, "--boundary", "hide"]
    status, _, err = run(capsys, *args)
    assert status == 1
    assert "no face is left" in err
    assert not target.exists()


def test_a_fault_of_our_own_is_a_sentence_for_the_user_and_a_traceback_for_the_log(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr("app.log.user_log_path", lambda *_, **__: tmp_path / "logs")
    monkeypatch.setattr("app.cli.degree", lambda vectors: 1 / 0)
    root = logging.getLogger()
    before = list(root.handlers)
    try:
        status, _, err = run(capsys, "mask", "--vectors", "1,0 0,1")
    finally:
        for handler in [h for h in root.handlers if h not in before]:
            root.removeHandler(handler)
            handler.close()
    assert status == BUG
    assert len(err.strip().splitlines()) == 1
    assert "ZeroDivisionError" in (tmp_path / "logs" / "studio.log").read_text(encoding="utf-8")
    assert "Traceback" not in err


def test_many_equal_weights_are_listed_by_the_first_and_the_last(capsys):
    _, out, _ = run(capsys, "stencil", "--scheme", "catmull-clark", "--valence", 40)
    assert "E1 E2 ... E40" in out
    assert max(map(len, out.splitlines())) < 80


def test_help_and_lessons_load_neither_qt_nor_vtk():
    code = (
        "import sys; from app.cli import main; main(['lessons']); "
        "print(sorted({'PySide6', 'pyvista', 'vtkmodules', 'matplotlib'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"

"""The command line as a user types it: what it prints, and its one sentence when something is wrong."""

import json
import logging
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest

from app.cli import main
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


def test_lessons_lists_every_lesson_with_its_steps(capsys):
    _, plain, _ = run(capsys, "lessons")
    _, listed, _ = run(capsys, "lessons", "--json")
    rows = json.loads(listed)
    assert {"figure_01_lane_riesenfeld", "figure_14_cube"} <= {row["id"] for row in rows}
    assert len(plain.splitlines()) == len(rows)
    assert all(row["steps"] > 1 and row["title"] for row in rows)


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda s: s.name)
def test_subdivide_writes_what_the_engine_computes_in_full_precision(capsys, tmp_path, scheme):
    mesh = shapes.torus() if "quad" in scheme.name or "catmull" in scheme.name else shapes.icosahedron()
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
    assert status == 1
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

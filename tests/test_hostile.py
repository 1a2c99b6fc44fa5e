"""Hostile files: read or refused in a sentence, soon, in little memory, and what is open stays as it was."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import lessons
from app.cli import main
from app.laboratory.bench import enter
from app.sessions import keeping
from app.sessions.opening import opening
from app.state import start
from subdivision import Mesh, TopologyError, files, shapes
from subdivision.files.text import Lines
from tests.hostile.corpus import WORST, corpus, sound
from tests.hostile.reading import failures
from tests.hostile.sentence import is_sentence

ROOT = Path(__file__).parent.parent
SMALL = dict(corpus(worst=False))


def test_there_are_many_hostile_files_of_every_format_and_most_are_refused(tmp_path):
    assert len(SMALL) + len(WORST) >= 400
    assert len(SMALL) == sum(1 for _ in corpus(worst=False))
    refused = 0
    for name, data in SMALL.items():
        (tmp_path / name).write_bytes(data)
        try:
            files.read(tmp_path / name)
        except files.FileError:
            refused += 1
    assert refused > len(SMALL) / 2


@pytest.mark.parametrize("suffix", files.READABLE)
def test_a_hostile_file_is_read_or_refused_in_a_sentence_with_its_place_soon_and_in_little_memory(tmp_path, suffix):
    chosen = {name: data for name, data in SMALL.items() if name.endswith(suffix)}
    assert [each for name, data in chosen.items() for each in failures(name, data, tmp_path)] == []


def test_the_worst_files_are_too_in_a_process_of_their_own_which_may_be_held_up_by_others():
    code = """
import pathlib, sys, tempfile
from tests.hostile.corpus import WORST
from tests.hostile.reading import SECONDS, failures
with tempfile.TemporaryDirectory() as folder:
    found = [each for name in sys.argv[1:] for each in failures(name, WORST[name](), pathlib.Path(folder), 2 * SECONDS)]
sys.exit("\\n".join(found) or 0)
"""
    run = subprocess.run([sys.executable, "-c", code, *WORST], cwd=ROOT, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr


def test_what_is_open_stays_as_it_was_when_a_file_is_refused(tmp_path):
    before = enter(start(lessons.all_lessons()[0]))
    kept = keeping.kept(before)
    state, refused = before, 0
    for name, data in SMALL.items():
        (tmp_path / name).write_bytes(data)
        try:
            opening(tmp_path / name)(state)
        except (files.FileError, TopologyError):
            refused += 1
    assert refused > len(SMALL) / 2
    assert state is before
    assert keeping.kept(before) == kept


def test_what_is_too_far_away_to_be_drawn_is_not_opened(tmp_path):
    cube = shapes.cube()
    files.write(tmp_path / "far.obj", Mesh(cube.topology, 1e30 * cube.points))
    with pytest.raises(files.FileError, match=r"far.obj: a coordinate is 1e\+30, too far away to be drawn; scale"):
        opening(tmp_path / "far.obj")


def test_a_sentence_names_the_file_the_place_and_the_mend():
    assert is_sentence("a.obj, line 3: 'x' is not a number; write one", "a.obj")
    assert not is_sentence("a.obj: 'x' is not a number; write one", "a.obj")
    assert not is_sentence("a.obj, line 3: 'x' is not a number", "a.obj")


@pytest.mark.parametrize("data", [b"", b"a", b"a\n", b"a\r\nb\rc\n\nd", b"\n\r\n\r", *sound().values()])
@pytest.mark.parametrize("piece", [1, 2, 3, 7, 2**19])
def test_lines_split_a_piece_at_a_time_are_those_split_at_once(monkeypatch, data, piece):
    monkeypatch.setattr("subdivision.files.text._PIECE", piece)
    assert list(Lines(data)) == data.splitlines()
    assert len(Lines(data)) == len(data.splitlines())


@pytest.mark.parametrize("alike", [1, 2, 100])
@pytest.mark.parametrize("few", [1, 3, 1000])
def test_rows_of_different_lengths_are_found_whether_alike_or_one_by_one(tmp_path, monkeypatch, alike, few):
    monkeypatch.setattr("subdivision.files.ply_body._ALIKE", alike)
    monkeypatch.setattr("subdivision.files.ply_body._FEW", few)
    monkeypatch.setattr("subdivision.files.ply_body._WALKED", 2)
    sizes = [4] * 7 + [5] + [3] * 9
    loops = [list(range(end - n, end)) for n, end in zip(sizes, np.cumsum(sizes).tolist(), strict=True)]
    points = np.random.default_rng(1).normal(size=(sum(sizes), 3))
    rows = [x for f in loops for x in (len(f), *f)]
    head = ["ply", "format ascii 1.0", f"element vertex {len(points)}", *(f"property double {x}" for x in "xyz")]
    head += [f"element face {len(loops)}", "property list uchar uchar vertex_indices", "end_header", ""]
    data = "\n".join(head).replace("ascii", "binary_little_endian").encode() + points.astype("<f8").tobytes()
    (tmp_path / "a.ply").write_bytes(data + bytes(rows))
    found = files.read(tmp_path / "a.ply").topology.loops()
    assert [list(f) for f in found] == [list(f) for f in loops]


@pytest.mark.parametrize("levels", [11, 12, 10**9])
def test_too_many_levels_are_refused_with_the_numbers_and_the_deepest_that_fits(tmp_path, capsys, levels):
    files.write(tmp_path / "cube.obj", shapes.cube())
    arguments = ["subdivide", str(tmp_path / "cube.obj"), "-o", str(tmp_path / "x.obj"), "--scheme", "catmull-clark"]
    assert main([*arguments, "--levels", str(levels), "--most-faces", "20000000"]) == 1
    said = capsys.readouterr().err
    assert f"{levels} levels would make {6 * 4**11:,} faces" in said
    assert "at most 10, for there is room for 20,000,000 faces" in said

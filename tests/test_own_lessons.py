"""Lessons from elsewhere: tried in a process of their own, named where they fail, run only where it was agreed to."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import lessons
from app.authoring import shelf
from app.authoring.beginning import begin, file_in
from app.authoring.retold import retold
from app.authoring.shelf import Shelf, digest, ids, loaded, opened, remember, remembered
from app.authoring.trial import MOST_POINTS, Outcome, command, judged
from app.cli import main
from app.draw.compose import compose
from app.sessions.keeping import kept, restored
from app.sessions.strict import KeepingError
from app.state import at_stop, drag, open_lesson, set_knob, start, stops
from lessons.own import Fault, LessonError

HEAD = """\
from lessons.script import lesson, play, show
from subdivision import shapes, trace
from subdivision.schemes import CATMULL_CLARK

@lesson("A corner")
def corner():
    told = trace(CATMULL_CLARK, shapes.cube(), levels={levels})
"""
GOOD = HEAD.format(levels=1) + """\
    yield show(told, None, 'A cube.')
    yield play(told, told.stages[0], 'Topology.')
"""
SAYS_NOTHING = [].append


@pytest.fixture(autouse=True)
def none_brought():
    yield
    lessons.bring(())


def written(folder: Path, text: str, name: str = "corner.py") -> Path:
    (path := folder / name).write_text(text)
    return path


def tried(path: Path, seconds: int = 10) -> Outcome:
    done = subprocess.run(command(path, ids({}), seconds), capture_output=True, timeout=60)
    return judged(path, done.stdout, done.stderr)


@pytest.mark.parametrize(("text", "line", "words"), [
    (HEAD.format(levels=1) + "    yield show(told, None,\n               1 / 0)\n", 9, "division by zero"),
    (HEAD.format(levels=1) + "    while True:\n        told = None\n    yield told\n", None, "takes longer than"),
    (HEAD.format(levels=8) + "    yield show(told, None, 'Many.')\n", 8, "1,835,052 points"),
    (HEAD.format(levels=1) + "    told = [0] * 10**11\n    yield told\n", 8, "memory"),
    (HEAD.format(levels=1) + "    yield show(told, None\n", 8, "never closed"),
    (HEAD.format(levels=1) + "    yield show(told, None, 'A {smell} cube.')\n", 8, "cannot be drawn"),
    (HEAD.format(levels=1) + "    yield 'A cube.'\n", 8, "yields str"),
    (HEAD.format(levels=1).replace("corner()", "figure_14_cube()") + "    yield show(told, None, 'A cube.')\n", 5,
     "another lesson called figure_14_cube"),
    ("import os\nos._exit(0)\n", 0, "ends the program"),
    ("import ctypes\nctypes.string_at(0)\n", 2, "ends the program"),
    ("import sys\nsys.exit()\n", 2, "ends the program"),
    ("import marvellous\n", 1, "no module marvellous"),
    ("print('hello')\n", 0, "no lesson in it"),
], ids=lambda value: value if isinstance(value, str) and len(value) < 40 else "")  # fmt: skip
def test_what_fails_is_named_with_its_line_and_stopped(tmp_path, text, line, words):
    path = written(tmp_path, text)
    fault = tried(path, 4 if "while" in text else 10).fault
    assert fault.file == "corner.py"
    assert words in fault.sentence
    assert fault.line in ((8, 9) if line is None else (line,))
    assert not fault.line or fault.text == " ".join(text.splitlines()[fault.line - 1].split())
    assert fault.mend in fault.sentence


def test_a_claim_that_is_not_so_is_a_remark_and_no_fault(tmp_path):
    found = tried(written(tmp_path, GOOD + "    yield show(told, None, 'A cube.', claim=1 > 2)\n"))
    assert found.fault is None
    assert found.remark.line == 10


def test_a_shelf_is_remembered_and_agreement_is_for_just_this_folder(tmp_path):
    (inner := tmp_path / "inner").mkdir()
    (link := tmp_path / "link").symlink_to(inner)
    kept = Shelf().agree(link).chosen(inner).has_stood("x")
    assert kept.is_agreed(inner)
    assert not kept.is_agreed(tmp_path)
    assert not kept.agree(tmp_path).is_agreed(inner / "deeper")
    remember(tmp_path / "made" / "shelf.json", kept)
    assert remembered(tmp_path / "made" / "shelf.json") == kept
    for odd in (b"", b"[]", b'{"folder": 3}', b"\xff", b'{"agreed": ["/"]}'):
        (tmp_path / "odd.json").write_bytes(odd)
        assert remembered(tmp_path / "odd.json") == Shelf()


def test_a_link_out_of_the_folder_is_refused_and_the_others_are_loaded(tmp_path):
    (folder := tmp_path / "mine").mkdir()
    outside = written(tmp_path, "raise SystemError('it ran')\n", "outside.py")
    (folder / "also.py").symlink_to(outside)
    written(folder, GOOD)
    found = opened(folder, Shelf(), SAYS_NOTHING, lambda path, taken: Outcome())
    assert [each.id for those in found.found.values() for each in those] == ["corner"]
    assert [fault.file for fault in found.faults] == ["also.py"]
    assert "leads out of the folder" in found.faults[0].sentence


def test_a_file_is_tried_again_only_when_it_or_what_it_may_read_has_changed(tmp_path):
    path = written(tmp_path, GOOD)
    asked = []
    first = opened(tmp_path, Shelf(), SAYS_NOTHING, lambda path, taken: (asked.append(path), Outcome())[1])
    again = opened(tmp_path, first.shelf, SAYS_NOTHING, lambda path, taken: (asked.append(path), Outcome())[1])
    assert len(asked) == 1
    assert len(again.found) == 1
    marks = [digest(path)]
    for change in (
        lambda: path.write_text(GOOD + "\n"),
        lambda: written(tmp_path, "", "_help.py"),
        lambda: written(tmp_path, "v 0 0 0", "mesh.obj"),
    ):
        change()
        marks.append(digest(path))
    assert len(set(marks)) == 4
    written(tmp_path, GOOD, "another.py")
    assert digest(path) == marks[-1]


def test_two_files_cannot_tell_lessons_of_one_id(tmp_path):
    for name in ("one.py", "two.py"):
        written(tmp_path, GOOD, name)
    found = opened(tmp_path, Shelf(), SAYS_NOTHING, lambda path, taken: Outcome())
    assert [path.name for path in found.found] == ["one.py"]
    assert "another lesson called corner" in found.faults[0].sentence


def test_lessons_can_share_a_module_beside_them_that_is_read_anew(tmp_path):
    path = written(tmp_path, "from _words import TEXT\n" + GOOD.replace("'A cube.'", "TEXT"))
    for text in ("One.", "Another one."):
        written(tmp_path, f"TEXT = {text!r}\n", "_words.py")
        (found,) = loaded(path, ids({}), SAYS_NOTHING)
        assert found.beats[0].text == text
    assert "_words" not in sys.modules


def test_a_reading_that_fails_while_a_picture_is_made_is_told_and_the_picture_is_made(tmp_path):
    path = written(tmp_path, GOOD + "    yield show(told, None, 'Measured.', reading=lambda mesh: 1 / 0)\n")
    heard: list[Fault] = []
    (found,) = loaded(path, ids({}), heard.append)
    picture = compose(at_stop(start(found), stops(found)[-1]))
    assert "corner.py, line 10" in picture.panes[0].reading
    assert (heard[0].line, heard[0].what) == (10, "ZeroDivisionError: division by zero")


def test_another_version_of_a_lesson_is_shown_at_the_same_place_with_all_else_as_it_was(tmp_path):
    path = written(tmp_path, GOOD)
    (old,) = loaded(path, ids({}), SAYS_NOTHING)
    state = drag(at_stop(start(old), stops(old)[-1]), 0, (1.0, 2.0, 3.0))
    written(tmp_path, GOOD.replace("levels=1", "levels=2").replace("'Topology.'", "'Other words.'"))
    (new,) = loaded(path, ids({}), SAYS_NOTHING)
    there = retold(state, new)
    assert there.now.text == "Other words."
    assert (there.at, there.edits, there.options) == (state.at, state.edits, state.options)
    written(tmp_path, GOOD[: GOOD.index("    yield play")])
    (short,) = loaded(path, ids({}), SAYS_NOTHING)
    assert retold(state, short).beat == 0
    other = open_lesson(state, lessons.find("14"))
    assert retold(other, new) is other


def test_a_knob_stays_where_it_stood(tmp_path):
    turning = GOOD.replace('"A corner"', '"A corner", knobs={"n": range(1, 4)}').replace("corner()", "corner(n=1)")
    path = written(tmp_path, turning)
    (old,), (new,) = (loaded(path, ids({}), SAYS_NOTHING) for _ in range(2))
    assert retold(set_knob(start(old), "n", 3), new).lesson.settings == {"n": 3}


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.setattr(shelf, "usual_place", lambda: tmp_path / "config" / "shelf.json")
    return shelf.usual_place()


def test_commands_run_a_folders_lessons_only_once_trusted(tmp_path, place, capsys):
    (folder := tmp_path / "mine").mkdir()
    written(folder, GOOD + f"\nopen({str(tmp_path / 'it ran')!r}, 'w').close()\n")
    written(folder, "1 / 0\n", "broken.py")
    asked = ["lessons", "--lessons", str(folder)]
    assert main(asked) == 1
    assert "--trust" in capsys.readouterr().err
    assert not (tmp_path / "it ran").exists()
    assert main([*asked, "--trust"]) == 0
    said = capsys.readouterr()
    assert "Own lessons\n  corner" in said.out
    assert "broken.py, line 1, '1 / 0': ZeroDivisionError" in said.err
    assert not remembered(place).is_agreed(folder)
    assert main(["figures", "corner", "--out", str(tmp_path / "out"), "--format", "svg", *asked[1:], "--trust"]) == 0
    assert (tmp_path / "out" / "corner.svg").exists()
    assert main(["lessons", "--lessons", str(tmp_path / "nowhere"), "--trust"]) == 1
    assert "there is no folder" in capsys.readouterr().err


def test_a_fault_is_raised_as_a_sentence(tmp_path):
    with pytest.raises(LessonError, match=r"corner\.py, line 1, 'def': this is not Python: .*; mend that line"):
        loaded(written(tmp_path, "def"), ids({}), SAYS_NOTHING)


MANUAL = (Path(__file__).parent.parent / "assets" / "manual" / "authoring.md").read_text(encoding="utf-8")


def test_the_lesson_in_the_manual_runs_as_it_is_printed(tmp_path):
    (text,) = re.findall(r"```python\n(.*?)```", MANUAL, re.DOTALL)
    assert tried(written(tmp_path, text)) == Outcome()
    (found,) = loaded(tmp_path / "corner.py", ids({}), SAYS_NOTHING)
    assert found.id == "corner"
    assert all(beat.claim for beat in found.beats)
    assert max(map(len, text.splitlines())) <= 120
    assert f"{MOST_POINTS:,} points" in MANUAL


def test_a_lesson_to_begin_with_is_a_lesson(tmp_path):
    path = file_in(tmp_path, "2 Schöne Ecken.txt")
    begin(path)
    assert path.name == "lesson_2_schone_ecken.py"
    assert tried(path) == Outcome()
    with pytest.raises(FileExistsError):
        begin(path)


def test_a_session_of_a_lesson_that_is_not_here_says_where_it_may_be(tmp_path):
    (found,) = loaded(written(tmp_path, GOOD), ids({}), SAYS_NOTHING)
    text = kept(start(found))
    with pytest.raises(KeepingError, match=r"no lesson 'corner'; if it is one of your own, open its folder first"):
        restored(text)
    lessons.bring((found,))
    assert restored(text).lesson is found

"""A view recorded as lines of a lesson: told again, they show the very same picture."""

from pathlib import Path

import pytest

import lessons
from app.authoring.pieces import RecordingError
from app.authoring.recording import difference, picture, recorded, shown
from app.authoring.shelf import ids, loaded
from app.authoring.trial import tried
from app.draw.seen import from_there
from app.laboratory import bench, boxlab
from app.state import Spot, at_stop, choose, drag, last, look, open_lesson, seek, skip, start, stops, turn_view
from lessons.turn import REST
from subdivision import Boundary, files, shapes

TURN = REST.rotated(0.2, -0.05).zoomed(1.4, 0.1, 0.2)
CUBE = start(lessons.find("14"))


def again(state, path: Path):
    """The state of the lesson that a view is recorded as, from its file as it is written."""
    found = recorded(state, path, "Mine", "mine")
    assert found.differs == ""
    found.write()
    assert max(map(len, found.text.splitlines())) <= 120
    (told,) = loaded(path, ids({}), lambda fault: None)
    return shown(told, state)


def same(state, path: Path) -> bool:
    return difference(picture(state), picture(again(state, path))) == ""


@pytest.mark.parametrize("lesson", lessons.built_in(), ids=lambda each: each.id)
def test_every_lesson_is_recorded_as_it_is_shown(lesson, tmp_path):
    for knob in lesson.knobs[:1]:
        lesson = lesson.turned(**{knob.name: knob.most})
    places = stops(lesson)
    for k in sorted({0, len(places) // 2, len(places) - 1}):
        assert same(turn_view(at_stop(start(lesson), places[k]), TURN), tmp_path / f"step_{k}.py")


def in_lab(*changes):
    state = bench.enter(CUBE)
    for change, *arguments in changes:
        state = change(state, *arguments)
    return state


LAB = {
    "as it begins": in_lab((skip, 2)),
    "the last level": in_lab((last,)),
    "two schemes": in_lab((bench.compare,), (last,)),
    "three, one at rest": in_lab((bench.compare,), (bench.compare,), (bench.turn_until, 1, -1), (skip, 3)),
    "a net": in_lab((bench.take, "landscape"), (last,)),
    "a parameter": in_lab((bench.take, "polygon"), (bench.choose_family, 0, "four-point"),
                          (bench.turn_parameter, 0, 0, 2), (last,)),
    "a box spline": in_lab((bench.take, "net"), (bench.choose_family, 0, "box-spline"),
                           (boxlab.add_vector, (1, -1)), (last,)),
    "a telling": in_lab((bench.choose_telling, 0, "stencils"), (skip, 1)),
    "a boundary": in_lab((bench.take, "quad-sheet"), (bench.choose_boundary, 0, Boundary.EDGE_AND_CORNER), (last,)),
    "hidden": in_lab((bench.take, "triangle-sheet"), (bench.choose_boundary, 0, Boundary.HIDE), (skip, 2)),
    "a large mesh": in_lab((bench.take, "duck"), (skip, 1)),
    "one of one's own": in_lab((bench.replace_control, shapes.duck().moved(3, shapes.duck().points[4]), "mine"),
                               (skip, 1)),
    "within a stage": in_lab((seek, 1.37)),
}  # fmt: skip


@pytest.mark.parametrize("name", LAB)
def test_the_laboratory_is_recorded_as_it_is_shown(name, tmp_path):
    state = LAB[name]
    assert same(state, tmp_path / "plain.py")
    assert same(turn_view(drag(state, 1, (0.3, -1 / 3, 0.9)), TURN), tmp_path / "dragged_and_turned.py")
    assert not tried(tmp_path / "dragged_and_turned.py").fault


@pytest.mark.parametrize("across", ["stage", "step", "all"])
def test_the_row_of_a_point_that_is_pointed_at_is_recorded_with_its_span(across, tmp_path):
    state = look(choose(at_stop(CUBE, stops(CUBE.lesson)[3]), across=across), Spot(0, 3, 5))
    assert same(state, tmp_path / "pointed.py")
    assert "stencil=told." in (tmp_path / "pointed.py").read_text()


def test_what_cannot_be_recorded_exactly_is_said_and_nothing_is_written(tmp_path):
    to_the_limit = look(choose(last(bench.enter(CUBE)), across="limit"), Spot(0, 6, 5))
    found = recorded(to_the_limit, tmp_path / "limit.py", "Mine", "mine")
    assert found.differs
    assert list(tmp_path.iterdir()) == []


def test_a_step_is_added_to_a_lesson_and_all_that_was_there_stays(tmp_path):
    path = tmp_path / "mine.py"
    for state in (skip(CUBE, 1), skip(CUBE, 2), last(start(lessons.find("1")))):
        before = path.read_text().splitlines() if path.exists() else []
        recorded(state, path, "My talk", "my_talk").write()
        after = path.read_text().splitlines()
        kept = [line for line in before if not line.startswith("from ")]
        assert [line for line in after if line in kept][: len(kept)] == kept
    (told,) = loaded(path, ids({}), lambda fault: None)
    assert [beat.text for beat in told.beats[:2]] == [beat.text for beat in CUBE.lesson.beats[1:3]]
    assert told.beats[0].lead.trace is told.beats[1].lead.trace  # one object, so nothing jumps
    assert path.read_text().count("shapes.cube()") == 1


def test_recording_goes_on_from_a_recorded_lesson(tmp_path):
    first = again(turn_view(drag(last(bench.enter(CUBE)), 0, (1.5, 1.5, 1.5)), TURN), tmp_path / "first.py")
    assert same(turn_view(first, TURN), tmp_path / "second.py")
    measured = again(last(start(lessons.find("exercise_7"))), tmp_path / "measured.py")
    assert same(measured, tmp_path / "measured_again.py")
    quoted = again(at_stop(start(lessons.find("13")), stops(lessons.find("13"))[2]), tmp_path / "third.py")
    assert same(quoted, tmp_path / "fourth.py")


def test_a_mesh_is_put_beside_the_lesson_that_shows_it(tmp_path):
    mesh = files.read(_written(tmp_path / "elsewhere.obj"))
    again(skip(bench.replace_control(bench.enter(CUBE), mesh, "elsewhere"), 1), tmp_path / "mine.py")
    (tmp_path / "elsewhere.obj").unlink()
    assert 'mesh_beside(__file__, "mine.obj")' in (tmp_path / "mine.py").read_text()
    assert loaded(tmp_path / "mine.py", ids({}), lambda fault: None)
    again_there = open_lesson(CUBE, loaded(tmp_path / "mine.py", ids({}), lambda fault: None)[0])
    assert from_there(picture(again_there), REST).panes


def test_a_lesson_that_is_not_python_is_not_added_to(tmp_path):
    (path := tmp_path / "mine.py").write_text("def mine(:\n")
    with pytest.raises(RecordingError, match="line 1 is not Python"):
        recorded(CUBE, path, "Mine", "mine")
    path.write_text("x = 1\n")
    with pytest.raises(RecordingError, match=r"mine\.py has no lesson"):
        recorded(CUBE, path, "Mine", "mine")
    assert path.read_text() == "x = 1\n"


def _written(path: Path) -> Path:
    files.write(path, shapes.duck().moved(3, shapes.duck().points[4] * 1.01))
    return path

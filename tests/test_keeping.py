"""Sessions and links: what was kept is restored exactly, and whatever else is read is one sentence and nothing more."""

import base64
import json
import zlib
from dataclasses import fields, replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

import lessons
from app import state as st
from app.laboratory import bench, boxlab
from app.laboratory.lab import Lab, Rule, lab_of
from app.sessions import keeping
from app.sessions.keeping import CHOICES, OF_THE_ROOM, kept, restored
from app.sessions.link import HEAD, followed, is_link, link
from app.sessions.strict import Entry, KeepingError
from app.state import Options, Spot
from lessons.turn import REST
from subdivision import Boundary, Grid, Mesh, Polyline, Topology, TopologyError, catalogue, shapes

CUBE = st.start(lessons.find("14"))
TURN = REST.rotated(0.123, -0.07).zoomed(1.7, 0.1, 0.3)


def same_mesh(one: Mesh, other: Mesh) -> bool:
    a, b = one.topology, other.topology
    if isinstance(a, Topology):
        return np.array_equal(one.points, other.points) and all(
            np.array_equal(getattr(a, f.name), getattr(b, f.name)) for f in fields(a)
        )
    return a == b and np.array_equal(one.points, other.points)


def same(one: st.State, other: st.State) -> bool:
    """Every field is the same; a laboratory and its lesson are new objects and are compared by what they hold."""
    plain = [
        (s.beat, s.at, s.goal, s.wait, s.focus, s.edits, s.turn, s.options, s.lesson.id, s.lesson.values)
        for s in (one, other)
    ]
    return plain[0] == plain[1] and same_lab(one.lab, other.lab)


def same_lab(a: Lab | None, b: Lab | None) -> bool:
    if a is None or b is None:
        return a is b
    plain = [[getattr(lab, each.name) for each in fields(Lab) if each.name != "control"] for lab in (a, b)]
    return plain[0] == plain[1] and same_mesh(a.control, b.control)


@pytest.mark.parametrize("lesson", lessons.all_lessons(), ids=lambda each: each.id)
def test_every_lesson_is_restored_where_it_stood(lesson):
    for knob in lesson.knobs[-1:]:
        lesson = lesson.turned(**{knob.name: knob.most})
    places = st.stops(lesson)
    for stop in {places[0], places[len(places) // 2], places[-1]}:
        state = st.turn_view(st.drag(st.at_stop(st.start(lesson), stop), 0, (0.1, -1 / 3, 1e-17)), TURN)
        state = st.choose(state, ghost=False, labels=True, theme="projector", speed=0.5, across="all")
        assert same(restored(kept(state)), state)
        assert restored(kept(state)).lesson is lesson
        assert same(followed(link(state)), state)


def test_what_is_pointed_at_and_a_place_within_a_stage_are_kept():
    state = st.look(st.seek(CUBE, 1.2345678901234567), Spot(0, 1, 3))
    assert same(restored(kept(state)), state)


def test_what_plays_is_kept_where_it_will_rest_and_the_room_stays_as_it_is():
    playing = st.tick(st.forward(CUBE), 0.3)
    assert same(restored(kept(playing)), st.settle(playing))
    there = restored(kept(st.choose(CUBE, presenting=True, blank=True)))
    assert (there.options.presenting, there.options.blank) == (False, False)
    assert restored(kept(CUBE), Options(presenting=True)).options.presenting


@pytest.mark.parametrize("name", shapes.SHAPES)
def test_every_shape_under_every_scheme_that_takes_it_is_restored(name):
    state = bench.take(bench.enter(CUBE), name)
    for family in catalogue.suiting(state.lab.control.topology):
        chosen = bench.choose_family(state, 0, family.name)
        for number in range(len(family.parameters)):
            chosen = bench.turn_parameter(chosen, 0, number, 1)
        chosen = bench.choose_boundary(chosen, 0, Boundary.EDGE_AND_CORNER)
        chosen = st.drag(st.last(chosen), 2, (0.1, 0.2, 0.3))
        assert f'"shape": "{name}"' in kept(chosen)
        assert same(restored(kept(chosen)), chosen)


def test_every_telling_and_several_panes_are_restored():
    state = bench.compare(bench.compare(bench.enter(CUBE)))
    for telling in state.lab.rules[0].scheme.tellings:
        try:
            told = bench.choose_telling(state, 0, telling)
        except TopologyError:
            continue
        assert same(restored(kept(told)), told)


@pytest.mark.parametrize("name", shapes.SHAPES)
@pytest.mark.parametrize("boundary", Boundary)
def test_an_object_that_is_no_shape_of_the_house_is_kept_number_by_number(name, boundary):
    shape = shapes.SHAPES[name]()
    moved = Rule("catmull-clark", boundary=boundary).bounded(shape).moved(0, np.array([0.1, 1 / 3, 1e-9]))
    state = bench.put(CUBE, lab_of(moved, "mine"))
    assert '"shape"' not in kept(state)
    assert same(restored(kept(state)), state)


def test_vectors_another_order_over_them_and_the_panes_are_kept():
    net = bench.take(bench.enter(CUBE), "net")
    state = bench.choose_parameter(bench.choose_family(net, 0, "box-spline"), 0, 0, ((1, 0), (0, 1), (1, 1), (-1, 1)))
    state = st.choose(boxlab.overlay(bench.compare(state), 1), lattice=True)
    assert '"overlay": 1' in kept(state)
    assert same(restored(kept(state)), state)
    assert same(followed(link(state)), state)


def test_creases_corners_hidden_faces_and_lone_vertices_are_kept():
    faces = [*shapes.cube().surface.loops()]
    topology = Topology.from_faces(faces, 10, creases={(0, 1): 2.5}, corners={7: 10.0, 9: 0.25})
    hidden = replace(topology, hidden=np.arange(6) == 4)
    mesh = Mesh(hidden, np.random.default_rng(1).normal(size=(10, 3)))
    state = bench.put(CUBE, Lab("mine", mesh, (Rule("catmull-clark"),), 1))
    assert same(restored(kept(state)), state)
    assert same(restored(kept(st.open_lesson(state, CUBE.lesson))), st.open_lesson(state, CUBE.lesson))


@pytest.mark.parametrize("topology", [Polyline(3, True), Polyline(4), Grid(4, 5), Grid(4, 4, True, False, True)])
def test_polygons_and_nets_of_any_numbers_are_kept(topology):
    points = np.random.default_rng(2).normal(size=(topology.n_vertices, 3)) * 10.0 ** np.arange(-3, 3, 2)
    state = bench.put(CUBE, lab_of(Mesh(topology, points), "odd \u00fc\ud800\n name"))
    assert same(restored(kept(state)), state)
    assert same(followed(link(state)), state)


def test_every_field_of_the_state_is_kept_or_passes():
    told = {"lesson", "beat", "at", "focus", "edits", "lab", "turn", "predicted", "options"}
    assert {each.name for each in fields(st.State)} <= told | {"goal", "wait", "picked"}
    assert {each.name for each in fields(Lab)} == {"name", "control", "rules", "levels", "overlay"}
    assert {each.name for each in fields(Rule)} == {"family", "parameters", "telling", "boundary", "until"}


def test_every_option_in_words_has_its_choices():
    words = {each.name for each in fields(Options) if isinstance(getattr(Options(), each.name), str)}
    assert words - set(OF_THE_ROOM) == set(CHOICES)


def test_the_form_can_be_read():
    text = kept(CUBE)
    assert text.splitlines()[:4] == [
        "{", '  "format": "subdivision-studio session",', '  "version": 1,', '  "lesson": "figure_14_cube",'
    ]
    assert max(map(len, kept(bench.enter(CUBE)).splitlines())) < 100


def test_options_and_knobs_that_are_not_named_stand_where_they_begin():
    told = json.loads(kept(st.choose(st.start(lessons.find("1")), net=False)))
    told["options"], told["knobs"] = {}, {}
    assert restored(json.dumps(told)).options == Options()
    assert restored(json.dumps(told)).lesson is lessons.find("1")


LAB = json.loads(kept(bench.put(CUBE, lab_of(shapes.cube().moved(0, np.ones(3)), "mine"))))
PLAIN = json.loads(kept(st.drag(CUBE, 3, (1.0, 2.0, 3.0))))


def changed(document, way, value):
    """The document with another value at a place."""
    found = json.loads(json.dumps(document))
    inside = found
    for step in way[:-1]:
        inside = inside[step]
    inside[way[-1]] = value
    return json.dumps(found)


def refusal(text):
    """Why a text is not restored, in one sentence; nothing where it is, and can be kept again."""
    try:
        state = restored(text)
    except KeepingError as fault:
        sentence = str(fault)
    else:
        assert same(restored(kept(state)), state)
        sentence = ""
    assert "\n" not in sentence
    return sentence


MESH = ("laboratory", "object", "mesh")


@pytest.mark.parametrize(("document", "way", "value", "said"), [
    (PLAIN, ("version",), 2, "newer program"),
    (PLAIN, ("version",), 0, "version: there is no such"),
    (PLAIN, ("version",), True, "version: there is no such"),
    (PLAIN, ("format",), "png", "this is no session"),
    (PLAIN, ("lesson",), "figure_99", "lesson: there is no lesson 'figure_99'"),
    (PLAIN, ("lesson",), "laboratory", "'laboratory' is missing"),
    (PLAIN, ("lesson",), ["x"], "lesson: there is no lesson"),
    (PLAIN, ("knobs",), {"degree": 3}, "knobs: 'degree' is not known"),
    (PLAIN, ("place", "beat"), 99, "place.beat: 99 is not a whole number from 0 to"),
    (PLAIN, ("place", "beat"), 1.0, "place.beat: 1.0 is not a whole number"),
    (PLAIN, ("place", "beat"), True, "place.beat: true is not a whole number"),
    (PLAIN, ("place", "at"), 99, "place.at: 99 is not a number from"),
    (PLAIN, ("place", "at"), float("nan"), "NaN is not a number"),
    (PLAIN, ("place", "at"), float("-inf"), "-Infinity is not a number"),
    (PLAIN, ("dragged", 0, 0), 8, "dragged[0][0]: 8 is not a whole number from 0 to 7"),
    (PLAIN, ("dragged", 0, 0), -1, "dragged[0][0]: -1 is not"),
    (PLAIN, ("dragged", 0, 1, 2), "3", "dragged[0][1][2]: 3 is not a number"),
    (PLAIN, ("dragged", 0, 1, 2), 1e300, "dragged[0][1][2]: 1e+300 is not a number"),
    (PLAIN, ("dragged", 0, 1), [1, 2], "dragged[0][1]: a list of 2 is not a list of 3 values"),
    (PLAIN, ("turn", "zoom"), 0, "turn.zoom: 0 is not a number from 0.15"),
    (PLAIN, ("turn",), {}, "turn: 'around' is missing"),
    (PLAIN, ("options", "theme"), "pink", "options.theme: pink is not one of light"),
    (PLAIN, ("options", "net"), 1, "options.net: 1 is not true or false"),
    (PLAIN, ("options", "blank"), True, "options: 'blank' is not known"),
    (PLAIN, ("options", "future"), 1, "options: 'future' is not known"),
    (PLAIN, ("options", "speed"), 0, "options.speed: 0 is not a number"),
    (PLAIN, ("pointed at",), {"pane": 9, "stage": 0, "point": 0}, "pointed at.pane: 9 is not"),
    (PLAIN, ("script",), "import os", "'script' is not known here"),
    (LAB, ("laboratory", "rules", 0, "family"), "../x", "laboratory.rules[0].family: ../x is not one of"),
    (LAB, ("laboratory", "rules", 0, "family"), "loop", "laboratory.rules[0]: "),
    (LAB, ("laboratory", "rules", 0, "parameters"), [1], "parameters: a list of 1 is not a list of 0"),
    (LAB, ("laboratory", "rules", 0, "telling"), "no", "laboratory.rules[0].telling: no is not one of"),
    (LAB, ("laboratory", "rules", 0, "boundary"), None, "laboratory.rules[0].boundary: null is not one of"),
    (LAB, ("laboratory", "rules"), [], "laboratory.rules: a list of 0 is not a list of 1 to 4"),
    (LAB, ("laboratory", "levels"), 50, "laboratory.levels: 50 is not a whole number from 0 to"),
    (LAB, ("laboratory", "name"), "x" * 301, "laboratory.name: xxx"),
    (LAB, ("laboratory", "object"), {}, "laboratory.object: there must be one thing"),
    (LAB, ("laboratory", "object"), {"shape": "/etc/passwd"}, "laboratory.object.shape: /etc/passwd is not one of"),
    (LAB, (*MESH, "faces", 0, 0), 99, "laboratory.object.mesh.faces[0][0]: 99 is not"),
    (LAB, (*MESH, "faces", 0), [0, 1], "laboratory.object.mesh.faces[0]: a list of 2"),
    (LAB, (*MESH, "faces", 0), [0, 0, 1], "laboratory.object.mesh: "),
    (LAB, (*MESH, "faces", 1), [0, 1, 2, 3], "laboratory.object.mesh: "),
    (LAB, (*MESH, "sharp edges"), [[0, 0, 1.0]], "laboratory.object.mesh.sharp edges[0]: there is no edge"),
    (LAB, (*MESH, "sharp edges"), [[0, 1, 11]], "sharp edges[0][2]: 11 is not a number from 0 to 10"),
    (LAB, (*MESH, "hidden faces"), [6], "hidden faces[0]: 6 is not"),
    (LAB, ("laboratory", "object"), {"net": {
        "size": [4, 4], "wrapped": [False, False], "diagonal": False, "points": [[0, 0, 0]],
    }}, "laboratory.object.net.points: a net of 4 by 4 has 16 points, not 1"),
    (LAB, ("laboratory", "object"), {"polygon": {"closed": True, "points": [[0, 0, 0]]}}, "at least 3 points"),
])  # fmt: skip
def test_what_is_wrong_is_said_with_its_place(document, way, value, said):
    sentence = refusal(changed(document, way, value))
    assert said in sentence
    assert len(sentence) < 700


@pytest.mark.parametrize(("text", "said"), [
    ("", "line 1, column 1: this is not JSON"),
    ('{\n  "format": 3,,\n}', "line 2, column 15: this is not JSON"),
    ("[" * 100_000, "too deep"),
    ('{"a":' * 100_000, "too deep"),
    ("null", "this is no session"),
    ("[1]", "this is no session"),
    ('{"format": 1, "format": 2}', "'format' stands twice"),
    ('{"at": 1' + "0" * 5000 + "}", "is too long"),
    (b"\xff\xfe{", "byte 0: this is not text in UTF-8"),
    (b" " * (33 << 20), "larger than 32 MB"),
])  # fmt: skip
def test_what_is_no_session_is_one_sentence(text, said):
    assert said in refusal(text)


VALUES = some.recursive(
    some.none() | some.booleans() | some.integers(-(10**20), 10**20) | some.floats() | some.text(max_size=5)
    | some.sampled_from(["cube", "loop", "laboratory", "figure_14_cube", "3/16", "box-spline", -1, 0, 1, 2, 1e308]),
    lambda inner: some.lists(inner, max_size=4) | some.dictionaries(some.text(max_size=5), inner, max_size=3),
    max_leaves=6,
)


def ways(value, way=()):
    yield way
    inside = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for name, each in inside:
        yield from ways(each, (*way, name))


NET = json.loads(kept(bench.choose_family(bench.take(bench.enter(CUBE), "three-direction-net"), 0, "box-spline")))
NET["laboratory"]["rules"][0]["parameters"] = [[[1, 0], [0, 1], [1, 1], [1, 0]]]
DOCUMENTS = [PLAIN, LAB, NET]


@given(some.sampled_from([(d, w) for d in DOCUMENTS for w in ways(d) if w]), VALUES)
def test_any_value_at_any_place_is_restored_or_refused_in_a_sentence(place, value):
    document, way = place
    refusal(changed(document, way, value))


@given(some.integers(0, 10**6), some.binary(max_size=3))
def test_any_bytes_at_any_place_are_restored_or_refused_in_a_sentence(at, bytes_):
    text = kept(st.drag(CUBE, 3, (1.0, 2.0, 3.0))).encode()
    at %= len(text)
    refusal(text[:at] + bytes_ + text[at + len(bytes_) :])


# -- files --------------------------------------------------------------------------------------


def test_a_file_is_written_whole_or_not_at_all_and_its_faults_begin_with_its_name(tmp_path, monkeypatch):
    path = keeping.write(tmp_path / "seminar", CUBE)
    assert path.name == "seminar.subdivision"
    assert keeping.named(tmp_path / "4.2 quads").name == "4.2 quads.subdivision"
    assert same(keeping.read(path), CUBE)
    monkeypatch.setattr("os.fsync", lambda _: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(KeepingError, match=r"seminar\.subdivision: no space is left"):
        keeping.write(path, st.last(CUBE))
    assert [p.name for p in tmp_path.iterdir()] == ["seminar.subdivision"]
    assert same(keeping.read(path), CUBE)


def test_fractions_stay_fractions():
    weight = catalogue.Parameter("weight", Fraction(1, 16), Fraction(0), Fraction(1), Fraction(1, 32))
    for value in (Fraction(3, 32), Fraction(1)):
        assert keeping._value(Entry(keeping._parameter(value)), weight) == value
    for wrong in ("1/0", "3.5", "--1", "2", "-1/2", "9" * 20, "1/" + "9" * 20, "", 1):
        with pytest.raises(KeepingError):
            keeping._value(Entry(wrong), weight)


def test_what_cannot_be_read_is_said_with_the_file_s_name(tmp_path):
    (tmp_path / "folder.subdivision").mkdir()
    (tmp_path / "broken.subdivision").write_text('{\n"format"')
    for name, said in {
        "none": "there is no such file",
        "folder": "not an ordinary file",
        "broken": "line 2, column 9: this is not JSON",
    }.items():  # fmt: skip
        with pytest.raises(KeepingError, match=said) as fault:
            keeping.read(tmp_path / f"{name}.subdivision")
        assert str(fault.value).startswith(f"{name}.subdivision")


def test_an_object_too_large_for_a_session_is_refused_with_the_way_out():
    n = keeping.MOST_POINTS + 1
    with pytest.raises(KeepingError, match="open it from its own file"):
        kept(replace(CUBE, lab=Lab("large", Mesh(Polyline(n), np.zeros((n, 3))), (Rule("lane-riesenfeld"),), 0)))


# -- links --------------------------------------------------------------------------------------


def test_a_link_is_one_word_short_enough_to_send_and_survives_a_mail_s_line_ends():
    word = link(st.turn_view(st.drag(CUBE, 3, (1.0, 2.0, 3.0)), TURN))
    assert is_link(word)
    assert len(word) < 600
    assert word.isascii()
    assert not set(word) & set(" \n\"'<>&")
    broken = "  " + "\r\n".join(word[k : k + 60] for k in range(0, len(word), 60)) + "\n"
    assert kept(followed(broken)) == kept(followed(word))


def test_a_link_that_has_not_come_whole_is_said_to_be_so():
    word = link(CUBE)
    mistyped = word[:90] + ("A" if word[90] != "A" else "B") + word[91:]
    small = HEAD + word[len(HEAD) :].lower()
    for other in (word[:-1], word[:-30], HEAD, HEAD + "AAAA", HEAD + "?", word[:80] + word[81:], mistyped, small):
        with pytest.raises(KeepingError, match="not come whole"):
            followed(other)
    with pytest.raises(KeepingError, match="begins with"):
        followed("subdivision-studio:other")


def packed(plain: bytes) -> str:
    inside = zlib.compress(plain, 9)
    return HEAD + base64.urlsafe_b64encode(zlib.crc32(inside).to_bytes(4, "big") + inside).decode().rstrip("=")


def test_a_link_that_would_fill_the_memory_is_refused_before_it_does():
    bomb = packed(b" " * (20 << 20))
    assert len(bomb) < 30_000
    with pytest.raises(KeepingError, match="more than a session"):
        followed(bomb)
    with pytest.raises(KeepingError, match="at most"):
        followed(HEAD + "A" * 1_000_000)
    with pytest.raises(KeepingError, match="not JSON"):
        followed(packed(b"import os"))


def test_an_object_too_large_for_a_link_is_refused_with_the_way_out():
    points = np.random.default_rng(3).normal(size=(4000, 3))
    state = bench.put(CUBE, lab_of(Mesh(Polyline(4000), points), "long"))
    with pytest.raises(KeepingError, match="save a session"):
        link(state)


@given(some.text(max_size=60))
def test_any_text_is_no_link_or_refused_in_a_sentence(text):
    with pytest.raises(KeepingError):
        followed(HEAD + text)

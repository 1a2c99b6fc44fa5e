"""A lesson as a page of HTML: what it carries, what it may do, and what a browser makes of it."""

import base64
import html
import json
import re
import shutil
import struct
import subprocess
import zlib
from dataclasses import replace
from functools import cache
from hashlib import sha256
from itertools import pairwise

import numpy as np
import pytest

import lessons
from app.cli import main
from app.draw.compose import compose, said
from app.draw.picture import Scene
from app.draw.theme import THEMES
from app.page import page_of
from app.page.html import _mathematics, page
from app.page.record import _knots, record
from app.state import Options, at_stop, choose, start, stops
from lessons.questions import Weight, Where
from subdivision import Role

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome", "chrome"))), None)
browser = pytest.mark.skipif(BROWSER is None, reason="no Chromium here: apt-get install chromium")
MOST = 1_500_000

ALL = lessons.all_lessons()
each = pytest.mark.parametrize("lesson", ALL, ids=lambda one: one.id)


@cache
def recorded_of(lesson, **options):
    return record(start(lesson, Options(**options)))


def written(lesson, **options):
    return page_of(start(lesson, Options(**options))).decode()


def carried(text):
    """The record of a page: its table, and its arrays."""
    (packed,) = re.findall(r'id="lesson">([^<]*)</script>', text)
    whole = zlib.decompress(base64.b64decode(packed))
    (size,) = struct.unpack("<I", whole[:4])
    told, at, arrays = json.loads(whole[4 : 4 + size]), 4 + size, []
    for kind, count in told["arrays"]:
        arrays.append(np.frombuffer(whole, np.dtype(f"<{kind}"), count, at))
        at += arrays[-1].nbytes
    assert at == len(whole)
    return told, arrays


def track(written, e, arrays):
    """A track at a time, as the player reads it."""
    if isinstance(written, int):
        return arrays[written].astype(float)
    times, numbers = written
    rows = np.array([arrays[n].astype(float) for n in numbers])
    return np.array([np.interp(e, times, column) for column in rows.T])


def within(told, places):
    return np.array(told["low"]) + places.reshape(-1, 3) / 65535 * np.array(told["wide"])


# -- what it carries --------------------------------------------------------------------------


@each
def test_every_lesson_becomes_a_page_below_a_megabyte_and_a_half(lesson):
    recorded = recorded_of(lesson)
    data = page(recorded)
    assert len(data) < MOST
    assert len(recorded.told["stops"]) == len(recorded.told["legs"]) == len(stops(lesson)) == len(recorded.captions)
    told, _ = carried(data.decode())
    assert [s["corner"] for s in told["stops"]] == [
        compose(at_stop(start(lesson), stop)).corner for stop in stops(lesson)
    ]


@pytest.mark.parametrize("name", ["1", "14", "15", "21"])
def test_between_its_instants_a_page_shows_what_the_program_shows(name):
    lesson = lessons.find(name)
    told, arrays = carried(written(lesson))
    begin, places = start(lesson), stops(lesson)
    for k, leg in enumerate(told["legs"]):
        if leg is None:
            continue
        pane, stop = leg["panes"][0], places[k]
        for x in (0.11, 0.37, 0.45, 0.69, 0.93):  # none of the instants written down
            scene = compose(replace(at_stop(begin, stop), at=stop.at - leg["stages"] * (1 - x))).panes[0].content
            at = pane["from"] + x * (pane["to"] - pane["from"])
            t = at - np.floor(at)
            e = float(np.floor(at) + t * t * (3 - 2 * t))
            piece = next(p for p in pane["pieces"] if e <= p["ends"])
            largest = max((m.radius.max() for m in scene.markers), default=0.0)
            groups = {"faces": scene.faces, "lines": scene.lines, "markers": scene.markers}
            for kind, wanted in groups.items():
                found = [part for part in piece["parts"] if part[0] == kind]
                assert len(found) == len(wanted)
                for part, own in zip(found, wanted, strict=True):
                    points = within(told, track(part[-1]["points"], e, arrays))
                    off = np.abs(points[:, None] - own.points[None]).max(axis=2).min(axis=1)
                    assert off.max(initial=0) < 2e-2 * max(told["wide"])
                    if kind == "markers":
                        radius = track(part[-1]["radius"], e, arrays)
                        assert np.abs(radius - own.radius).max() < 0.02 * largest


def test_the_same_lesson_gives_the_same_bytes():
    lesson = lessons.find("20")
    assert page_of(start(lesson)) == page_of(start(lesson))


def test_a_page_has_the_knobs_and_the_options_of_its_state():
    low, high = (written(lessons.find("1").turned(degree=degree)) for degree in (2, 4))
    assert carried(low)[0]["stops"][0]["corner"].startswith("degree 2")
    assert carried(high)[0]["stops"][0]["corner"].startswith("degree 4")
    with_net, without = (carried(written(lessons.find("14"), net=shown))[0] for shown in (True, False))
    kinds = [[part[0] for part in told["stops"][0]["panes"][0]["pieces"][0]["parts"]] for told in (with_net, without)]
    assert "lines" in kinds[0]
    assert "lines" not in kinds[1]


@each
def test_light_and_dark_differ_by_a_palette_only(lesson):
    recorded = recorded_of(lesson)
    for stop in stops(lesson):
        light = at_stop(start(lesson), stop)
        shown, partner = compose(light), compose(choose(light, theme="dark"))
        for pane, other in zip(shown.panes, partner.panes, strict=True):
            if isinstance(pane.content, Scene):
                for m, n in zip(pane.content.markers, other.content.markers, strict=True):
                    assert recorded.tables.dark[m.colour] == n.colour
                for m, n in zip(pane.content.lines, other.content.lines, strict=True):
                    assert recorded.tables.dark[m.colour] == n.colour


def test_a_track_keeps_no_instant_that_the_others_tell():
    times = np.array([0.0, 0.2, 0.5, 0.7, 1.0])
    straight, bent = times[:, None] * [[2.0, -1.0]], np.abs(times - 0.5)[:, None]
    assert _knots(times, straight, 1e-9) == [0, 4]
    assert _knots(times, bent, 1e-9) == [0, 2, 4]


# -- what it may do ---------------------------------------------------------------------------


def test_the_policy_allows_one_style_and_one_script_by_their_hashes_and_nothing_else():
    text = written(lessons.find("14"))
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', text)
    allowed = dict(part.strip().split(" ", 1) for part in policy.split(";"))
    assert allowed["default-src"] == "'none'"
    assert "unsafe" not in policy
    (style,) = re.findall(r"<style>(.*?)</style>", text, re.DOTALL)
    (script,) = re.findall(r"<script>(.*?)</script>", text, re.DOTALL)
    for kind, content in (("style-src", style), ("script-src", script)):
        digest = base64.b64encode(sha256(content.encode()).digest()).decode()
        assert allowed[kind] == f"'sha256-{digest}'"
    assert len(re.findall("<script", text)) == 2
    assert not re.search(r"\s(on\w+|style)=", text)
    assert not re.search(r"(src|href)=\"(?!#)", text)
    assert "http" not in re.sub(r'http-equiv|xmlns="http://www.w3.org/2000/svg"', "", text)


def test_whatever_a_lesson_says_is_text():
    nasty = '</script><script>alert("1 < 2")</script>&amp;<!-- '
    lesson = lessons.find("14")
    told = tuple(replace(b, text=nasty, notes=nasty) for b in lesson.beats)
    text = written(replace(lesson, title=nasty, ours=nasty, script=lambda: iter(told)))
    assert len(re.findall("<script", text)) == 2
    assert nasty not in text
    assert html.escape(nasty) in text
    assert carried(text)[0]["captions"][0] == nasty


def test_a_formula_is_an_outline_with_its_source_for_those_who_listen():
    drawn = _mathematics(r"\frac{a}{b} < 1")
    assert drawn.startswith('<svg class="math" role="img" aria-label="\\frac{a}{b} &lt; 1"')
    assert "style" not in drawn


# -- the command ------------------------------------------------------------------------------


def test_the_command_writes_a_page(tmp_path, capsys):
    out = tmp_path / "cube.html"
    assert main(["page", "14", "-o", str(out)]) == 0
    assert out.read_bytes() == page_of(start(lessons.find("14")))
    assert str(out) in capsys.readouterr().out
    assert list(tmp_path.iterdir()) == [out]


def test_a_page_that_cannot_be_written_is_told_in_a_sentence(tmp_path, capsys):
    assert main(["page", "14", "-o", str(tmp_path / "nowhere" / "cube.html")]) == 1
    assert "cannot be written" in capsys.readouterr().err
    assert main(["page", "1", "--set", "degree=99"]) == 1
    assert "degree" in capsys.readouterr().err


# -- in a browser -----------------------------------------------------------------------------


def browsed(tmp_path, lesson, fragment, *switches, **options):
    path = tmp_path / f"{lesson.id}.html"
    path.write_bytes(page(recorded_of(lesson, **options)))
    command = [
        BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr", "--v=0",
        f"--user-data-dir={tmp_path / 'profile'}", "--window-size=1280,800", "--virtual-time-budget=20000",
        *switches, f"{path.as_uri()}#{fragment}",
    ]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    assert "CONSOLE" not in done.stderr, done.stderr
    return done.stdout


@browser
@each
def test_every_page_plays_in_a_browser_without_a_fault_or_a_request(lesson, tmp_path):
    shown = browsed(tmp_path, lesson, "test", "--dump-dom")
    (found,) = re.findall(r'<pre id="report">(.*?)</pre>', shown, re.DOTALL)
    report = json.loads(html.unescape(found))
    assert report["faults"] == []
    assert report["requests"] == []
    assert report["backAtTheFirst"]
    end, home, *_ = report["keys"]
    assert end[1] == len(report["stops"]) - 1
    assert home[1:] == [0, 0, False]
    state = start(lesson)
    captions = [said(there, there.now) for there in (at_stop(state, stop) for stop in stops(lesson))]
    assert len(report["stops"]) == len(captions)
    for words, caption in zip(report["stops"], captions, strict=True):
        assert words.startswith(re.split(r"\$", caption)[0].strip())


@browser
@pytest.mark.parametrize("number", ["14", "19"])
def test_a_page_asks_and_tells_how_near_the_prediction_was(number, tmp_path):
    lesson = lessons.find(number)
    shown = browsed(tmp_path, lesson, "test", "--dump-dom", asking=True)
    (found,) = re.findall(r'<pre id="report">(.*?)</pre>', shown, re.DOTALL)
    report, beats = json.loads(html.unescape(found)), lesson.asking(True).beats
    assert (report["faults"], report["requests"]) == ([], [])
    asked = [(beat.asks, answer) for beat, answer in pairwise(beats) if beat.asks]
    for words, (question, beat) in zip(report["asked"], asked, strict=True):
        if isinstance(question, Where):
            assert re.fullmatch(r"Your prediction is 0\.0[1-9] of an edge away\.", words)
        elif isinstance(question, Weight):
            assert words == f"You said {question.answers[0]}; {question.answers[question.truth(beat)]} is true."
        else:
            assert words == f"You said 1; {question.truth(beat) + 1} is true."


@browser
@pytest.mark.parametrize("is_still", [False, True])
def test_a_page_moves_nothing_if_motion_was_not_wanted_where_it_was_made(is_still, tmp_path):
    shown = browsed(tmp_path, lessons.find("14"), "test", "--dump-dom", reduced_motion=is_still)
    (found,) = re.findall(r'<pre id="report">(.*?)</pre>', shown, re.DOTALL)
    (after,) = [each[1:3] for each in json.loads(html.unescape(found))["keys"] if each[0] == "PageDown"]
    assert after == ([1, 0] if is_still else [0, 1])


@browser
def test_a_page_opens_at_the_step_that_its_address_names(tmp_path):
    lesson = lessons.find("14")
    shown = browsed(tmp_path, lesson, "step=4", "--dump-dom")
    (words,) = re.findall(r'<div id="words"[^>]*>(.*?)</div>', shown, re.DOTALL)
    there = at_stop(start(lesson), stops(lesson)[3])
    assert html.escape(said(there, there.now), quote=False) in html.unescape(words)
    assert re.search(r'id="count">4 / \d+<', shown)


@browser
@pytest.mark.parametrize(("name", "preferred"), [("light", 1), ("dark", 0)])
def test_a_page_wears_the_readers_theme(tmp_path, name, preferred):
    from PIL import Image

    out = tmp_path / "seen.png"
    browsed(tmp_path, lessons.find("14"), "step=5", f"--screenshot={out}",
            f"--blink-settings=preferredColorScheme={preferred}")  # fmt: skip
    pixels = np.asarray(Image.open(out).convert("RGB")).astype(float)
    background, moved = (255 * np.array(c) for c in (THEMES[name].background, THEMES[name].roles[Role.MOVED]))
    assert np.abs(pixels[2, 2] - background).max() <= 1
    assert (np.abs(pixels - moved).max(axis=2) < 12).sum() > 200

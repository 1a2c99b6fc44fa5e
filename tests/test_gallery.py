"""The page and the picture that show the whole lecture."""

from collections import Counter
from dataclasses import replace
from html.parser import HTMLParser
from io import BytesIO
from urllib.parse import unquote

import pytest
from PIL import Image, ImageChops

import lessons
from app import gallery
from app.draw import raster
from app.draw.theme import THEMES
from app.figures import poster
from app.gallery import Drawn, page, sheet
from app.state import Options, stops
from lessons.script import Lesson, show
from subdivision import shapes, trace
from subdivision.schemes import CATMULL_CLARK

LESSONS = lessons.all_lessons()
BOTH = Drawn(("png", "svg"), (320, 180))
SCRIPTS = ("<script", "javascript:", "http:", "https:", "@import", "onload", "onerror")
VOID = {"meta", "img"}


@pytest.fixture(autouse=True, scope="module")
def studio():
    """The off-screen window goes before the display does."""
    yield
    raster.close()


class Read(HTMLParser):
    """What is in a page, as a browser would find it; an element that is not closed where it should be is told."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.tags, self.open, self.words = [], [], []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attributes):
        assert len({name for name, _ in attributes}) == len(attributes)
        self.tags.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open[-1:] != ["style"]:
            self.words.append(data)

    def all(self, tag, attribute):
        return [attributes[attribute] for name, attributes in self.tags if name == tag and attribute in attributes]

    @property
    def text(self):
        return " ".join(" ".join(self.words).split())


def told(title="A & B", ours="", text="Is 1 < 2?", **said):
    """A lesson of one still."""
    cube = trace(CATMULL_CLARK, shapes.cube())
    return Lesson("figure_98_told", title, "9 <Made up>", lambda: iter([show(cube, None, text, **said)]), ours)


@pytest.mark.parametrize("steps", [False, True])
def test_the_page_shows_every_lesson_in_the_lectures_order_under_its_heading(steps):
    text = page(LESSONS, replace(BOTH, steps=steps))
    read = Read(text)
    assert text.startswith("<!DOCTYPE html>")
    assert read.all("article", "id") == [each.id for each in LESSONS]
    sections = list(dict.fromkeys(each.section for each in LESSONS))
    assert [link for link in read.all("a", "href") if link[0] == "#"] == [f"#{i}" for i in read.all("section", "id")]
    assert len(read.all("section", "id")) == len(sections)
    for each in LESSONS:
        assert " ".join(each.title.split()) in read.text
        assert " ".join(each.ours.split()) in read.text
    assert [found for found in SCRIPTS if found in text.replace("http://www.w3.org", "").lower()] == []
    assert set(Counter(read.all("article", "id") + read.all("section", "id")).values()) == {1}


@pytest.mark.parametrize("drawn", [
    BOTH, replace(BOTH, steps=True), replace(BOTH, formats=("svg",)), replace(BOTH, formats=("png",), steps=True),
])  # fmt: skip
def test_the_page_shows_and_leads_to_the_files_that_were_drawn(tmp_path, monkeypatch, drawn):
    for painter in ("png", "svg"):
        monkeypatch.setattr(f"app.figures.{painter}", lambda state, size, background: b"drawn")
    turned = lessons.find("14"), lessons.find("exercise_1a").turned(degree=3)
    *written, index = gallery.draw(turned, tmp_path, drawn)
    assert index == tmp_path / "index.html"
    read = Read(index.read_text(encoding="utf-8"))
    named = [*read.all("img", "src"), *(link for link in read.all("a", "href") if link[0] != "#")]
    assert {tmp_path / unquote(name) for name in named} == set(written)
    assert set(read.all("img", "loading")) == {"lazy"}
    assert all(read.all("img", "alt"))
    assert len(read.all("img", "src")) == sum(1 + (len(stops(each)) if drawn.steps else 0) for each in turned)


def test_a_film_alone_is_shown_once():
    read = Read(page([LESSONS[0]], Drawn(("gif",), (320, 180), steps=True)))
    assert read.all("img", "src") == [f"{LESSONS[0].id}.gif"] == [n for n in read.all("a", "href") if n[0] != "#"]


def test_what_a_lesson_says_is_text_and_never_markup():
    evil = '<script>"\'&amp;</b>'
    text = page([told(f"Figure 98  {evil}", evil, evil, notes=evil, formula=r"$a < b \quad A & B$")], BOTH)
    read = Read(text)
    assert "<script" not in text
    assert read.text.count(evil) == 4  # title, caption, notes, ours
    assert read.all("img", "alt") == [evil]
    assert read.all("svg", "aria-label") == [r"a < b \quad A & B"]


def test_the_picture_that_stands_for_a_lesson_is_the_posters_last_stop():
    cube = trace(CATMULL_CLARK, shapes.cube())
    beats = [show(cube, None, "First."), show(cube, None, "Second.", poster=True), show(cube, None, "Third.")]
    lesson = Lesson("figure_97_three", "Three", "9 Three", lambda: iter(beats))
    assert poster(lesson).beat == 1
    assert "Second." in Read(page([lesson], BOTH)).text
    assert poster(told()) == stops(told())[-1]


def test_a_lessons_notes_are_told_once_each_with_steps_and_without():
    cube = lessons.find("14")
    notes = [beat.notes for beat in cube.beats if beat.notes]
    for steps in (False, True):
        text = Read(page([cube], replace(BOTH, steps=steps))).text
        assert notes
        assert [text.count(" ".join(note.split())) for note in notes] == [1] * len(notes)


def test_the_page_is_the_same_twice_and_wears_the_lectures_own_colours_when_asked():
    twelve = lessons.find("12")
    assert page([twelve], BOTH) == page([twelve], BOTH)
    if twelve.colours:
        assert page([twelve], BOTH) != page([twelve], replace(BOTH, as_caption=True, steps=True))


@pytest.mark.parametrize("theme", THEMES)
def test_one_picture_shows_all_lessons_given(theme):
    some = [lessons.find(name) for name in ("1", "5", "11", "12", "14", "22", "exercise")]
    with Image.open(BytesIO(sheet(some, Options(theme=theme)))) as picture:
        pixels = picture.convert("RGB")
    gap, line, (width, height) = gallery.GAP, gallery.LINE, gallery.TILE
    assert pixels.size == (6 * (width + gap) + gap, 2 * (height + line + gap) + gap)
    tiles = [(k % 6 * (width + gap) + gap, k // 6 * (height + line + gap) + gap) for k in range(12)]
    drawn = [_has_something(pixels.crop((x, y, x + width, y + height))) for x, y in tiles]
    named = [_has_something(pixels.crop((x, y + height, x + width, y + height + line))) for x, y in tiles]
    assert drawn == named == [True] * 7 + [False] * 5


def test_a_title_too_long_for_its_tile_ends_in_dots():
    with Image.open(BytesIO(sheet([told("Figure 98  " + "very " * 30)], Options()))) as picture:
        assert not _has_something(picture.convert("RGB").crop((gallery.GAP + gallery.TILE[0] + 1, 0, *picture.size)))


def _has_something(part):
    return ImageChops.difference(part, Image.new("RGB", part.size, part.getpixel((0, 0)))).getbbox() is not None

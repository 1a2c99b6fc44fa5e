"""The manual tells of everything there is, and everything it names is there."""

import re
import shlex
from html import escape

import pytest

import lessons
from app import cli
from app.manual.chapters import FOLDER, chapters, written
from app.manual.page import page
from app.manual.references import references
from app.words import tr
from subdivision.catalogue import FAMILIES

KEYS = {"Lesson": [("Next stage", ("Page Down", "→"))]}


@pytest.fixture(scope="module")
def manual():
    return chapters(KEYS)


def test_every_lesson_every_scheme_every_key_and_every_source_is_told(manual):
    whole = "".join(each.html for each in manual)
    for lesson in lessons.all_lessons():
        assert f'<h2 id="{lesson.id}">' in whole
    for family in FAMILIES.values():
        assert f"<h2>{escape(tr(family.title))}</h2>\n<p>" in whole
    for key in references():
        assert f'id="{key}"' in whole
    assert "<td>Page Down, →</td><td>Next stage</td>" in whole


def test_every_link_leads_somewhere_and_every_name_is_one(manual):
    whole = page(manual)
    names = re.findall(r'\bid="([^"]+)"', whole)
    assert len(names) == len(set(names))
    assert set(re.findall(r'href="#([^"]+)"', whole)) <= set(names)


def test_all_pictures_are_there_and_none_is_left_over(manual):
    shown = {name for each in manual for name in re.findall(r'src="pictures/([^"]+)"', each.html)}
    assert shown == {path.name for path in (FOLDER / "pictures").iterdir()}


def test_the_page_needs_nothing_but_itself(manual):
    whole = page(manual)
    assert "default-src 'none'" in whole
    assert not re.search(r'src="(?!data:image/png;base64,)|<script|<link|@import|url\(', whole)


def test_every_command_in_it_is_one():
    window, parsers = cli._parsers()
    for chapter in written():
        for line in re.findall(r"^subdivision-studio (.+)$", chapter.html.replace("&quot;", '"'), re.MULTILINE):
            words = shlex.split(line)
            parsers.get(words[0], window).parse_args(words[words[0] in parsers :])


def test_the_command_writes_it_whole_or_says_why_not(tmp_path, capsys):
    path = tmp_path / "manual.html"
    assert cli.main(["manual", "-o", str(path)]) == 0
    assert path.read_text(encoding="utf-8").endswith("</html>\n")
    assert cli.main(["manual", "-o", str(tmp_path / "nowhere" / "manual.html")]) != 0
    assert "nowhere" in capsys.readouterr().err

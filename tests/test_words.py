"""Words in another language: every text has a translation, with all its gaps, in letters there are; English stays."""

import argparse
import re
import threading

import polib
import pytest
from matplotlib.ft2font import FT2Font

import lessons
from app import words
from app.draw.compose import compose, said
from app.draw.letters import REGULAR
from app.export.wish import FORMATS
from app.sessions.link import followed, link
from app.state import Options, Stop, at_stop, start
from app.words import LANGUAGES, catalogue_file, speaking, tr
from subdivision.words import joined, phrase, plural
from tests.words.__main__ import gathered
from tests.words.pseudo import PSEUDO, Pseudo, bare
from tests.words.source import texts
from tests.words.told import every_way

OTHERS = [code for code in LANGUAGES if catalogue_file(code).is_file()]
GAP = re.compile(r"\{(\w*)")
FORMULA = re.compile(r"\$[^$]*\$")


@pytest.fixture(scope="module")
def said_now():
    return gathered()


@pytest.fixture(params=OTHERS)
def catalogue(request):
    return polib.pofile(str(catalogue_file(request.param)))


def strings(entry):
    return [*entry.msgstr_plural.values()] if entry.msgid_plural else [entry.msgstr]


# -- catalogues ---------------------------------------------------------------------------------


def test_every_text_is_in_the_catalogue_and_nothing_else(catalogue, said_now):
    """``make words`` mends it."""
    assert {(entry.msgid, entry.msgid_plural) for entry in catalogue} == set(said_now)


def test_every_text_is_translated(catalogue):
    assert [entry.msgid for entry in catalogue if not all(strings(entry)) or entry.fuzzy] == []


def test_gaps_formulas_and_edges_are_those_of_the_text(catalogue):
    for entry in catalogue:
        originals = [entry.msgid, entry.msgid_plural or entry.msgid]
        for text, original in zip(strings(entry), originals, strict=False):
            assert set(GAP.findall(text)) == set(GAP.findall(original)), entry.msgid
            assert sorted(FORMULA.findall(text)) == sorted(FORMULA.findall(original)), entry.msgid
            assert (text[:1] == " ", text[-1:] == " ") == (original[:1] == " ", original[-1:] == " "), entry.msgid


def test_the_typeface_has_every_letter(catalogue):
    there = FT2Font(str(REGULAR)).get_charmap()
    for entry in catalogue:
        assert [c for text in strings(entry) for c in text if c != "\n" and ord(c) not in there] == [], entry.msgid


@pytest.mark.parametrize("code", OTHERS)
@pytest.mark.parametrize("lesson", lessons.built_in(), ids=lambda each: each.id)
def test_captions_can_be_read_from_the_back_row(lesson, code):
    for told in every_way(lesson):
        state = start(told, Options(language=code))
        for beat in told.beats:
            assert 0 < len(said(state, beat)) <= 130, said(state, beat)
            assert "{" not in said(state, beat)


def test_what_reads_like_words_is_found_in_the_source():
    found = {each.text for each in texts("app", "subdivision")}
    assert {"Next stage", "Play through stages", "face {f} has {n} corners; a face needs three or more"} <= found
    assert not any("def " in text or "<span" in text for text in found)


# -- saying -------------------------------------------------------------------------------------


def test_english_is_what_was_written():
    told = phrase("level {level} of {levels}", level=2, levels=5)
    with speaking("en"):
        assert tr(told) is told
        assert tr("Next stage") == "Next stage"


def test_phrases_are_refilled_with_words_that_are_translated_too():
    with speaking("de"):
        assert tr(phrase("level {level}", level=2)) == "Stufe 2"
        assert tr(phrase("{kind} {k}", kind=phrase("vertex"), k=3)) == "Ecke 3"
        assert tr(joined("   ", [phrase("level {level}", level=2), "V 8"])) == "Stufe 2   V 8"
        counted = [tr(plural("{n:,} face", "{n:,} faces", n, n=n)) for n in (1, 12345)]
        assert counted == ["1 Fläche", "12\u202f345 Flächen"]
        assert tr("no such text") == "no such text"
        assert tr(phrase("{reason:sentence}", reason="the mesh has no {edge}")) == "The mesh has no {edge}."


def test_a_sentence_of_a_fault_keeps_its_parts():
    from subdivision import TopologyError, shapes
    from subdivision.editing import flip_edge

    with pytest.raises(TopologyError) as refused:
        flip_edge(shapes.cube(), 0)
    with speaking("de"):
        assert "Ecken" in tr(str(refused.value))
        assert "corners" not in tr(str(refused.value))


def test_each_thread_speaks_for_itself():
    heard = []
    with speaking("de"):
        thread = threading.Thread(target=lambda: heard.append(tr("black")))
        thread.start()
        thread.join()
        assert tr("black") == "schwarz"
    assert heard == ["black"]


def test_no_word_of_the_commands_is_forgotten(monkeypatch, said_now):
    from app.cli import _parsers

    known = Pseudo({one for one, _ in said_now})
    monkeypatch.setattr(words, "catalogue", lambda code: known)
    with speaking(PSEUDO):
        parser, commands = _parsers()
        for each in (parser, *commands.values()):
            helps = [action.help for action in each._actions if action.help not in (None, argparse.SUPPRESS)]
            helps = [re.sub(r"\b(" + "|".join(FORMATS) + "): ", "", text) for text in helps]
            assert [text for text in (each.description, *helps) if bare(text)] == [], each.prog


def test_the_language_of_a_command_is_asked_for_or_the_systems(capsys, monkeypatch):
    from app.cli import main

    monkeypatch.setattr(words, "_spoken", "en")
    mask = ["mask", "--vectors", "1,0 0,1 1,1"]
    for locale, asked, first in (
        ("C", [], "1/2 times"), ("C", ["--language", "de"], "1/2 mal"),
        ("de_AT.UTF-8", [], "1/2 mal"), ("de_AT", ["--language=en"], "1/2 times"),
    ):
        monkeypatch.setenv("LC_ALL", locale)
        assert main([*mask, *asked]) == 0
        assert capsys.readouterr().out.splitlines()[0] == first


# -- pictures -----------------------------------------------------------------------------------


def test_the_language_stays_the_readers():
    mine = start(lessons.find("14"), Options(language="de"))
    assert followed(link(mine)).options.language == Options().language


def test_colours_in_captions_are_translated():
    lesson = lessons.find("13")
    beat = next(each for each in lesson.beats if "{centroid}" in each.text)
    assert "(grün)" in said(start(lesson, Options(language="de")), beat)


@pytest.mark.parametrize("lesson", lessons.built_in(), ids=lambda each: each.id)
def test_no_word_of_a_picture_is_forgotten(lesson, monkeypatch, said_now):
    known = Pseudo({one for one, _ in said_now})
    monkeypatch.setattr(words, "catalogue", lambda code: known)
    for beat in range(len(lesson.beats)):
        state = start(lesson, Options(language=PSEUDO, valences=True))
        picture = compose(_at_end(state, beat))
        found = [picture.title, picture.caption, picture.corner, *(e.text for e in picture.legend)]
        for pane in picture.panes:
            found += [pane.title, pane.reading, *(each.text for each in getattr(pane.content, "labels", ()))]
            found += [each.text for each in getattr(pane.content, "notes", ())]
        assert [text for text in found if bare(text)] == []


def _at_end(state, beat):
    return at_stop(state, Stop(beat, state.lesson.beats[beat].stop))

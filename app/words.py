"""The reader's language: sentences are English everywhere else, and are translated where they are shown.

``tr`` says a text in the language that is spoken.  A window speaks one (``speak``); a picture says its words in the
language of its own state (``speaking``), wherever it is drawn.  ``assets/languages`` has a catalogue in gettext's
format for each language; what it does not have stays English.
"""

import locale
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache
from gettext import GNUTranslations, NullTranslations
from io import BytesIO
from pathlib import Path
from typing import Any

from app import ASSETS
from subdivision.words import Phrase, filled

LANGUAGES: Mapping[str, str] = {"en": "English", "de": "Deutsch"}
"""Code -> what the language calls itself."""

ENGLISH = "en"

SYSTEM = "system"
"""Chosen instead of a language: that of the system, whichever it is."""

_spoken: str = ENGLISH
_here: ContextVar[str | None] = ContextVar("language", default=None)


def tr(text: str) -> str:
    """The text in the language that is spoken; as it is where the language has no word for it."""
    return said_by(catalogue(language()), text)


def language() -> str:
    """The code of the language that is spoken here."""
    return _here.get() or _spoken


def speak(code: str) -> None:
    """Say everything in this language from now on."""
    global _spoken
    _spoken = code


@contextmanager
def speaking(code: str) -> Iterator[None]:
    """Say in this language what is said within."""
    before = _here.set(code)
    try:
        yield
    finally:
        _here.reset(before)


def said_by(words: NullTranslations, text: str) -> str:
    """The text by a catalogue: a phrase by its template, refilled with its values, which are said too."""
    if not text or type(words) is NullTranslations:
        return text
    if not isinstance(text, Phrase):
        return words.gettext(text)
    template = words.ngettext(text.template, text.many, text.number) if text.many else words.gettext(text.template)
    return filled(template, {name: _said(words, value) for name, value in text.values.items()})


def _said(words: NullTranslations, value: Any) -> Any:
    return said_by(words, value) if isinstance(value, str) else value


@lru_cache(maxsize=8)
def catalogue(code: str) -> NullTranslations:
    """The translations into a language, read when it is first spoken; English needs none."""
    path = catalogue_file(code)
    if code == ENGLISH or not path.is_file():
        return NullTranslations()
    import polib

    return GNUTranslations(BytesIO(polib.pofile(str(path)).to_binary()))


def catalogue_file(code: str) -> Path:
    """Where the catalogue of a language is."""
    return ASSETS / "languages" / f"{code}.po"


def system_language() -> str:
    """The language of the system, if it is one of ours; else English."""
    wishes = [os.environ.get(name, "") for name in ("LC_ALL", "LC_MESSAGES", "LANG")]
    wished = next((each for each in wishes if each), locale.getlocale()[0] or "")
    code = wished.split("_")[0].split(".")[0].lower()
    return code if code in LANGUAGES else ENGLISH


def headed(text: str) -> str:
    """The text with a capital, as it begins a line."""
    return f"{text[:1].upper()}{text[1:]}"

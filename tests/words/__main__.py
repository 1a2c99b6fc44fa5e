"""Every text there is into the catalogues: ``python -m tests.words``, or with the code of a new language.

What is translated stays so; what is new is empty, what is said no more leaves.  The order is that of the files, so
that translators can share the work: the window and the engine first, then a lesson after the other.
"""

import sys
from collections.abc import Iterable

import polib

from app.words import LANGUAGES, catalogue_file
from tests.words.source import texts
from tests.words.told import is_word, of_lessons, of_tables


def gathered() -> dict[tuple[str, str], list[str]]:
    """What is said, and what for other numbers than one -> the files that say it, in the order of a catalogue."""
    found: dict[tuple[str, str], list[str]] = {}
    for each in (*texts("app", "subdivision"), *of_tables(), *texts("lessons"), *of_lessons()):
        if is_word(each.text):
            places = found.setdefault((each.text, each.many), [])
            places.extend([each.file] if each.file not in places else [])
    manys = {many for _, many in found if many}
    plurals = {one for one, many in found if many}
    return {(one, many): f for (one, many), f in found.items() if many or one not in manys | plurals}


def updated(catalogue: polib.POFile) -> polib.POFile:
    """The catalogue with just the texts that are said now, and what it knew of them."""
    known = {entry.msgid: entry for entry in catalogue}
    fresh = polib.POFile(wrapwidth=100)
    fresh.header, fresh.metadata = catalogue.header, catalogue.metadata
    for (one, many), files in sorted(gathered().items(), key=lambda item: _order(item[1])):
        fresh.append(_entry(one, many, files, known.get(one)))
    return fresh


def _order(files: Iterable[str]) -> tuple[int, str]:
    first = next(iter(files))
    return ["app", "subdivision", "lessons"].index(first.split("/")[0]), first


def _entry(one: str, many: str, files: Iterable[str], before: polib.POEntry | None) -> polib.POEntry:
    entry = polib.POEntry(msgid=one, occurrences=[(file, "") for file in files])
    if before is not None:
        entry.tcomment, entry.flags = before.tcomment, before.flags
    if many:
        entry.msgid_plural = many
        entry.msgstr_plural = before.msgstr_plural if before is not None and before.msgid_plural else {0: "", 1: ""}
    elif before is not None:
        entry.msgstr = before.msgstr
    return entry


def _begun(code: str) -> polib.POFile:
    fresh = polib.POFile(wrapwidth=100)
    fresh.metadata = {
        "Project-Id-Version": "Subdivision Studio",
        "Language": code,
        "MIME-Version": "1.0",
        "Content-Type": "text/plain; charset=UTF-8",
        "Content-Transfer-Encoding": "8bit",
        "Plural-Forms": "nplurals=2; plural=(n != 1);",
    }
    return fresh


def main() -> None:
    for code in sys.argv[1:] or [code for code in LANGUAGES if catalogue_file(code).is_file()]:
        path = catalogue_file(code)
        path.parent.mkdir(exist_ok=True)
        catalogue = updated(polib.pofile(str(path)) if path.is_file() else _begun(code))
        catalogue.save(str(path))
        print(f"{path}: {len(catalogue)} texts, {len(catalogue.untranslated_entries())} to be translated")


if __name__ == "__main__":
    main()

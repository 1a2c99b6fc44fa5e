"""A language in which every text there is a catalogue for is between brackets: what has none is not translated."""

import re
from gettext import NullTranslations

PSEUDO = "xx"

LETTERS = re.compile(r"[A-Za-zäöüÄÖÜß]{2}")
TAG = re.compile(r"<[^>]*>|&\w+;")
BRACKETED = re.compile(r"⟦[^⟦⟧]*⟧")

ALIKE = {
    "Subdivision Studio", "English", "Deutsch", "PNG", "SVG", "PDF", "HH", "mm", "cos", "kB", "Ctrl", "Shift", "Alt",
    "Esc", "Space", "Home", "End", "Backspace", "Ins", "Del", "PgUp", "PgDown", "Tab", "Enter",
}
"""Names, and words that every language of ours has."""


class Pseudo(NullTranslations):
    """``known`` are the texts that a catalogue has."""

    def __init__(self, known: set[str]) -> None:
        super().__init__()
        self._known = known

    def gettext(self, message: str) -> str:
        return f"⟦{message}⟧" if message in self._known else message

    def ngettext(self, msgid1: str, msgid2: str, n: int) -> str:
        return self.gettext(msgid1) if n == 1 else f"⟦{msgid2}⟧" if msgid1 in self._known else msgid2


def bare(text: str) -> str:
    """What of a text is in no bracket: letters that nobody has translated; "" where all is."""
    text = TAG.sub(" ", text)
    while (inner := BRACKETED.sub(" ", text)) != text:
        text = inner
    for name in sorted(ALIKE, key=len, reverse=True):
        text = re.sub(rf"\b{re.escape(name)}\b", " ", text)
    return text.strip() if LETTERS.search(re.sub(r"\$[^$]*\$", " ", text)) else ""

"""What can be wrong with a file, and how it is said: what, where, and the mend, in one sentence."""

import errno
from pathlib import Path

from subdivision.words import phrase


class FileError(ValueError):
    """A file that cannot be read or written; ``str`` of it is a sentence for whoever chose the file."""


class Fault(Exception):
    """What is wrong, the mend, and the place in the file: a line, or a byte where there are no lines."""

    def __init__(self, what: str, mend: str, place: str = "") -> None:
        super().__init__(what)
        self.what, self.mend, self.place = what, mend, place

    @classmethod
    def at_line(cls, line: int, what: str, mend: str) -> "Fault":
        """The fault of a line, counted from 1."""
        return cls(what, mend, phrase("line {line}", line=line))

    @classmethod
    def at_byte(cls, byte: int, what: str, mend: str) -> "Fault":
        """The fault of a byte, counted from 0."""
        return cls(what, mend, phrase("byte {byte}", byte=byte))

    def in_file(self, path: Path) -> FileError:
        """The sentence, beginning with the name of the file."""
        sentence = "{file}, {place}: {what}; {mend}" if self.place else "{file}: {what}; {mend}"
        name = printable(path.name or str(path))
        return FileError(phrase(sentence, file=name, place=self.place, what=self.what, mend=self.mend))


def fault_of_system(error: OSError | MemoryError, path: Path) -> Fault:
    """The fault for what the operating system refused."""
    folder = printable(str(path.absolute().parent))
    if isinstance(error, MemoryError):
        return Fault("it needs more memory than there is", "close other programs or choose a smaller mesh")
    if isinstance(error, FileNotFoundError):
        return Fault(phrase("there is no such file in {folder}", folder=folder), "check the name and the folder")
    if isinstance(error, PermissionError):
        return Fault("you are not permitted to open it there", "change its permissions or choose another folder")
    if error.errno == errno.ENOSPC:
        return Fault(phrase("no space is left for it in {folder}", folder=folder), "free some or choose another folder")
    reason = printable(error.strerror or type(error).__name__)
    return Fault(phrase("the system refused it ({reason})", reason=reason), "check the name, or choose another folder")


def printable(text: str) -> str:
    """``text`` on one line: what cannot be printed becomes a question mark."""
    return "".join(c if c.isprintable() else "?" for c in text)


def quoted(word: bytes) -> str:
    """A word of a file as a sentence shows it, shortened if need be."""
    text = printable(word[:40].decode("utf-8", "replace"))
    return f"'{text}{'...' if len(word) > 40 else ''}'"

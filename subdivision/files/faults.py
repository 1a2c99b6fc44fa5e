"""What can be wrong with a file, and how it is said: what, where, and the mend, in one sentence."""

import errno
from pathlib import Path


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
        return cls(what, mend, f"line {line}")

    @classmethod
    def at_byte(cls, byte: int, what: str, mend: str) -> "Fault":
        """The fault of a byte, counted from 0."""
        return cls(what, mend, f"byte {byte}")

    def in_file(self, path: Path) -> FileError:
        """The sentence, beginning with the name of the file."""
        place = f", {self.place}" if self.place else ""
        return FileError(f"{printable(path.name or str(path))}{place}: {self.what}; {self.mend}")


def fault_of_system(error: OSError | MemoryError, path: Path) -> Fault:
    """The fault for what the operating system refused."""
    folder = printable(str(path.absolute().parent))
    if isinstance(error, MemoryError):
        return Fault("it needs more memory than there is", "close other programs or choose a smaller mesh")
    if isinstance(error, FileNotFoundError):
        return Fault(f"there is no such file in {folder}", "check the name and the folder")
    if isinstance(error, PermissionError):
        return Fault("you are not permitted to open it there", "change its permissions or choose another folder")
    if error.errno == errno.ENOSPC:
        return Fault(f"no space is left for it in {folder}", "free some or choose another folder")
    reason = printable(error.strerror or type(error).__name__)
    return Fault(f"the system refused it ({reason})", "check the name, or choose another folder")


def printable(text: str) -> str:
    """``text`` on one line: what cannot be printed becomes a question mark."""
    return "".join(c if c.isprintable() else "?" for c in text)


def quoted(word: bytes) -> str:
    """A word of a file as a sentence shows it, shortened if need be."""
    text = printable(word[:40].decode("utf-8", "replace"))
    return f"'{text}{'...' if len(word) > 40 else ''}'"

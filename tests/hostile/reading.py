"""What a hostile file must not do: crash, hang, take memory, or be refused without a sentence."""

from collections.abc import Iterator
from pathlib import Path
from time import process_time

from subdivision import files
from tests.hostile.sentence import is_sentence

SECONDS = 2.0
MEGABYTES, TIMES = 100, 4


def failures(name: str, data: bytes, folder: Path, longest: float = SECONDS) -> Iterator[str]:
    """What is wrong with the reading of a file, in sentences; none where it is read, or refused as it should be."""
    path = folder / name
    path.write_bytes(data)
    size = len(data) / 2**20
    del data
    before = _start_of_peak()
    begin = process_time()
    said = ""
    try:
        files.read(path)
    except files.FileError as error:
        said = str(error)
    except Exception as error:
        yield f"{name}: {error!r}"
    seconds, megabytes = process_time() - begin, _peak() - before
    path.unlink()
    if seconds > longest:
        yield f"{name}: {seconds:.1f} s"
    if megabytes > TIMES * size + MEGABYTES:
        yield f"{name}: {megabytes:.0f} MB of memory for {size:.0f} MB"
    if said and not is_sentence(said, name):
        yield f"{name}: refused by {said!r}"


def _start_of_peak() -> float:
    """Resident megabytes; the peak is counted anew from here.  0 where the system does not tell."""
    try:
        Path("/proc/self/clear_refs").write_text("5")
    except OSError:
        return 0.0
    return _status("VmRSS")


def _peak() -> float:
    return _status("VmHWM")


def _status(key: str) -> float:
    try:
        rows = Path("/proc/self/status").read_text().splitlines()
    except OSError:
        return 0.0
    return next((int(row.split()[1]) / 1024 for row in rows if row.startswith(key)), 0.0)

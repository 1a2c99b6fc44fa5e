"""Writing a file whole or not at all."""

import os
import re
import secrets
import shutil
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from time import time

PART = re.compile(r"\.[0-9a-f]{16}\.part")
"""What is half written is called so, and nothing else is."""

BEGIN = "SUBDIVISION_STUDIO_PARTS"
"""In the environment: the eight digits with which the names of all half files of this program begin, if any."""

OLD = 3600.0
"""Seconds after which it is nobody's any more: its program was killed."""


def save(path: Path, pieces: Iterable[bytes]) -> None:
    """Write beside ``path``, then take its place; if anything fails, what was there stays as it was.

    Raises
    ------
    OSError
    """
    target = Path(os.path.realpath(path))  # a link stays a link
    part = part_of(target)
    try:
        with part.open("xb") as file:
            file.writelines(pieces)
            file.flush()
            os.fsync(file.fileno())
        with suppress(OSError):  # a new file, or a file system without permissions
            shutil.copymode(target, part)
        part.replace(target)
    except BaseException:
        with suppress(OSError):
            part.unlink()
        raise


def part_of(target: Path) -> Path:
    """Where to write what will be ``target``; what killed programs have left there long ago is cleared away."""
    with suppress(OSError):
        for each in os.scandir(target.parent):
            if PART.fullmatch(each.name) and time() - each.stat(follow_symlinks=False).st_mtime > OLD:
                _remove(Path(each.path))
    return target.with_name(f".{os.environ.get(BEGIN) or secrets.token_hex(4)}{secrets.token_hex(4)}.part")


def clear(folder: Path, begin: str) -> None:
    """Remove the half files of a program that was killed, whose names begin with eight digits."""
    with suppress(OSError):
        for each in os.scandir(folder):
            if PART.fullmatch(each.name) and each.name.startswith(f".{begin}"):
                _remove(Path(each.path))


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)

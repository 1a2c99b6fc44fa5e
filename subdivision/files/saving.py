"""Writing a file whole or not at all."""

import os
import secrets
import shutil
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path


def save(path: Path, pieces: Iterable[bytes]) -> None:
    """Write beside ``path``, then take its place; if anything fails, what was there stays as it was.

    Raises
    ------
    OSError
    """
    target = Path(os.path.realpath(path))  # a link stays a link
    part = target.with_name(f".{secrets.token_hex(8)}.part")
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

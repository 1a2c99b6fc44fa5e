"""An export in a process of its own, which tells its progress and stops when nobody listens any more.

Off-screen pictures must be made by the thread that opened their window, and take long: the window of the program
therefore has them made by ``python -m app export --progress``.
"""

import _thread
import json
import os
import sys
import threading
from pathlib import Path

from app.export.making import export
from app.export.wish import Wish
from app.state import State

HEAD = "progress "
"""How a line begins that tells of progress: the rest is JSON, how much is done and of what."""


_unheard = threading.Event()


def reported(state: State, wish: Wish, out: Path) -> list[Path]:
    """Export, and tell of progress in lines of output; the end of the input stops it and leaves nothing behind."""
    threading.Thread(target=_listen, daemon=True).start()
    try:
        return export(state, wish, out, _tell)
    except KeyboardInterrupt:
        return []


def _listen() -> None:
    """Wait until whoever started this closes the pipe, or is gone."""
    while os.read(sys.stdin.fileno(), 4096):
        pass
    _unheard.set()
    _thread.interrupt_main()


def _tell(done: float, name: str) -> None:
    if _unheard.is_set():  # the interrupt itself may have come where it was lost: in a call from VTK
        raise KeyboardInterrupt
    print(f"{HEAD}{json.dumps([round(done, 4), name])}", flush=True)


def told(line: str) -> tuple[float, str] | None:
    """What a line of output tells of progress, if it does."""
    if not line.startswith(HEAD):
        return None
    done, name = json.loads(line.removeprefix(HEAD))
    return float(done), str(name)

"""The screen is lost while the window is open: what is open is kept, one sentence said, and the process ends.

Qt and Xlib each end the process themselves when their connection breaks, whichever notices first, and neither comes
back from telling so.  Both are heard here.
"""

import ctypes
import os
import sys
from collections.abc import Callable
from contextlib import suppress

from app.log import LOG

LOST = (
    "subdivision-studio: the screen was lost, so the window is gone. What was open has been kept, and the next start "
    "offers it."
)
SAID_BY_QT = ("The X11 connection broke", "The Wayland connection broke")

_held: list[object] = []
"""What Xlib calls must not be cleared away."""


def watch(last: Callable[[], None]) -> None:
    """Do ``last`` and end when Xlib finds that its display has gone."""
    if not sys.platform.startswith("linux"):
        return
    with suppress(OSError):
        xlib = ctypes.CDLL("libX11.so.6")
        handler = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)(lambda _: end(last))
        xlib.XSetIOErrorHandler(handler)
        _held.append(handler)


def is_lost(message: str) -> bool:
    """Whether Qt says that its display has gone."""
    return message.startswith(SAID_BY_QT)


def end(last: Callable[[], None]) -> int:
    """The end of the process; without what usually comes then, for that would ask for the screen."""
    try:
        last()
        LOG.critical("the screen was lost")
        print(LOST, file=sys.stderr, flush=True)
    finally:
        os._exit(1)

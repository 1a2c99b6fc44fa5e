"""The log: where tracebacks go, so that none reaches a user."""

import logging
from logging.handlers import RotatingFileHandler
from pathlib import Path

from platformdirs import user_log_path

LOG = logging.getLogger("studio")

BUG = 70
"""What a command ends with when something is wrong inside the program, as ``sysexits.h`` has it."""


def keep_log() -> Path:
    """Start the log, where the system keeps such things; it never grows beyond three megabytes."""
    path = user_log_path("subdivision-studio", appauthor=False) / "studio.log"
    root = logging.getLogger()
    root.setLevel(logging.INFO)
    logging.raiseExceptions = False  # a disk that is full would print a traceback for every line
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handler: logging.Handler = RotatingFileHandler(path, maxBytes=1_000_000, backupCount=2, encoding="utf-8")
    except OSError:  # a home that cannot be written to is no reason not to teach
        handler = logging.NullHandler()
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(name)s: %(message)s"))
    root.addHandler(handler)
    return path

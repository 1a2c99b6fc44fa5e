"""Runs in processes of their own, and the fewest actions that still fail."""

import json
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import astuple, dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tests.soak.hand import Action

LONGEST = 10_800
"""Seconds a run may take."""

STEPS = 40
"""The last ones are told, where a run has failed."""


@dataclass(frozen=True)
class Report:
    """What came of a run: ``done`` actions are over, a link leads to where the next one began, the last steps.

    ``labours`` counts how often the window's thread itself computed longer than it may.
    """

    faults: list[dict[str, str]]
    done: int = 0
    memory: list[tuple[int, float, int]] = field(default_factory=list)
    gaps: list[tuple[int, float, str, str]] = field(default_factory=list)
    kinds: dict[str, tuple[int, float, float]] = field(default_factory=dict)
    digests: dict[str, str] = field(default_factory=dict)
    link: str = ""
    labours: int = 0
    steps: list[str] = field(default_factory=list)


def ran(actions: list[Action], folder: Path, begin: str = "", *, loud: bool = False) -> Report:
    """What comes of some actions in a fresh window, from a link on; a process that dies is a fault too."""
    with TemporaryDirectory(prefix="soak-run-", dir=folder) as inside:
        report, journal = Path(inside) / "report.json", Path(inside) / "journal.txt"
        run = subprocess.run(
            [sys.executable, "-X", "faulthandler", "-m", "tests.soak.run", str(report), str(journal),
             *([begin] if begin else [])],
            input=json.dumps([astuple(each) for each in actions]), text=True, errors="replace", check=False,
            stdout=None if loud else subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=LONGEST,
        )  # fmt: skip
        written = journal.read_text(errors="replace").splitlines() if journal.exists() else []
        found = Report(**json.loads(report.read_text())) if report.exists() else _dead(run, actions, written)
    found.steps.extend(written[-STEPS:])
    if run.stderr.strip() and not found.faults:
        found.faults.append({"at": "some time", "said": f"on the error output: {run.stderr.strip()}"})
    return found


def _dead(run: subprocess.CompletedProcess[str], actions: list[Action], journal: list[str]) -> Report:
    """A process that wrote no report."""
    name = signal.Signals(-run.returncode).name if run.returncode < 0 else f"status {run.returncode}"
    last = next((line for line in reversed(journal) if line[:1].isdigit()), "")
    numbers = [each.number for each in actions]
    done = numbers.index(int(last.split()[0])) if last else 0
    lines = [line for line in run.stderr.splitlines() if line and not line.startswith("Extension modules")]
    said = "\n".join([*lines[-60:], f"the process died ({name})"])
    return Report([{"at": journal[-1] if journal else "the start", "said": said}], done)


def shrunk(actions: list[Action], report: Report, folder: Path, begin: str, minutes: float) -> list[Action]:
    """The fewest actions found in some minutes that fail as these did: ever longer tails, then with parts left out."""
    end = time.monotonic() + 60 * minutes
    wanted = kind(report)
    few = next((tail for tail in _tails(actions, end) if kind(ran(tail, folder, begin)) == wanted), actions)
    size = max(len(few) // 2, 1)
    while time.monotonic() < end:
        for k in range(0, len(few), size):
            fewer = few[:k] + few[k + size :]
            if time.monotonic() > end or not fewer:
                break
            if kind(ran(fewer, folder, begin)) == wanted:
                few = fewer
                break
        else:
            if size == 1:
                break
            size = max(size // 2, 1)
    return few


def _tails(actions: list[Action], end: float) -> Iterator[list[Action]]:
    count = 1
    while count < len(actions) and time.monotonic() < end:
        yield actions[-count:]
        count *= 2


def kind(report: Report) -> Any:
    """What a fault is, whatever led there: the last line of what was said."""
    return report.faults[0]["said"].strip().splitlines()[-1][:120] if report.faults else None

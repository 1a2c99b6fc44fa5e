"""``python -m app.authoring.trial FILE``: a lesson from elsewhere, told and drawn once in a process of its own.

What raises, does not end, or takes too much memory or too many points is found here, where it harms nobody: the
report names the line, and the file is not loaded by the program that asked.  This guards against mistakes, not
against malice: what a file may do is agreed to before.
"""

import faulthandler
import json
import os
import re
import sys
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from itertools import islice, product
from pathlib import Path
from time import perf_counter

from app.draw.compose import compose
from app.draw.layout import overlay
from app.state import State, at_stop, stops
from lessons.own import MEND, Fault, LessonError, fault_of, faults_named, first_line, load, text_at
from lessons.questions import checked
from lessons.script import Beat, Lesson
from subdivision import Trace
from subdivision.words import phrase

SECONDS = 10
"""How long a file may take in all."""

GRACE = 5
"""... and so many more until its process is ended from outside."""

DRAWING = 5.0
"""After so many seconds of drawing no more pictures are tried."""

MEMORY = 3 << 30
"""Bytes of address space."""

MOST_POINTS = 750_000
"""Over all stages of all views of a lesson."""

MOST_SETTINGS = 200
"""So many values of knobs are tried."""

MOST_BYTES = 1 << 20
"""A report is far shorter."""


@dataclass(frozen=True)
class Outcome:
    """What a trial found: the ``fault`` for which a file cannot be loaded, and a ``remark`` on what is odd about it."""

    fault: Fault | None = None
    remark: Fault | None = None


def command(path: Path, taken: frozenset[str], seconds: int = SECONDS) -> list[str]:
    """The command that tries a file; ``taken`` are the ids it may not use."""
    return [sys.executable, "-m", "app.authoring.trial", str(seconds), str(path), *sorted(taken)]


def judged(path: Path, report: bytes, traces: bytes, is_late: bool = False) -> Outcome:
    """What a trial found, from its output and what is told of a process that did not end well."""
    with suppress(ValueError, TypeError, AttributeError):
        told = json.loads(report[:MOST_BYTES])
        return Outcome(**{name: Fault(**each) for name, each in told.items() if each})
    left = traces.decode(errors="replace")
    found = re.search(rf'File "{re.escape(str(path))}", line (\d+)', left)
    line = int(found.group(1)) if found else 0
    if "Timeout" in left or is_late:
        what: str = phrase("it takes longer than {seconds} seconds", seconds=SECONDS)
        mend = "end the loop there, or take fewer levels"
    else:
        what, mend = "it ends the program that runs it", MEND
    return Outcome(Fault(path.name, line, text_at(path, line), what, mend))


def main(arguments: list[str]) -> None:
    """Try a file, and report on the standard output in one line of JSON."""
    report, traces, nowhere = os.dup(1), os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)  # what a lesson prints is nobody's
    os.dup2(nowhere, 2)
    faulthandler.enable(traces)
    seconds, path, *taken = arguments
    _limit_memory()
    faulthandler.dump_traceback_later(int(seconds), exit=True, file=traces)
    outcome = tried(Path(path), frozenset(taken))
    os.write(report, json.dumps(asdict(outcome)).encode())
    os._exit(0)  # threads that the lesson has started end with it


def _limit_memory() -> None:
    with suppress(ImportError, OSError, ValueError):  # Windows has none, macOS does not keep to it
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def tried(path: Path, taken: frozenset[str] = frozenset()) -> Outcome:
    """Load a file, tell its lessons with every value of their knobs, and draw their steps."""
    began = perf_counter()
    try:
        remarks = [remark for each in load(path, taken) for remark in _turned(each, path, began)]
    except LessonError as error:
        return Outcome(error.fault)
    return Outcome(remark=remarks[0] if remarks else None)


def _turned(lesson: Lesson, path: Path, began: float) -> Iterator[Fault]:
    """What is odd about a lesson, whatever its knobs stand at."""
    names = [knob.name for knob in lesson.knobs]
    values = product(*(range(knob.least, knob.most + 1) for knob in lesson.knobs))
    for chosen in islice(values, MOST_SETTINGS):
        turned = lesson.turned(**dict(zip(names, chosen, strict=True)))
        lines = _told(turned, path)
        yield from _drawn(turned, lines, path, began)


def _told(lesson: Lesson, path: Path) -> list[int]:
    """The lines that tell the beats of a lesson, which are then its beats.

    Raises
    ------
    LessonError
        If one cannot be told, is none, or there are too many points.
    """
    beats: list[Beat] = []
    lines: list[int] = []
    sizes: dict[Trace, int] = {}
    with faults_named(path, first_line(lesson)):
        telling = lesson.script(**lesson.settings)
        for beat in telling:
            lines.append(_line_of(telling) or first_line(lesson))
            if fault := _of_beat(beat, sizes):
                raise LessonError(Fault(path.name, lines[-1], text_at(path, lines[-1]), *fault))
            beats.append(beat)
    if not beats:
        what, mend = "it tells no beat", "yield show(…), play(…) or side_by_side(…)"
        raise LessonError(Fault(path.name, line := first_line(lesson), text_at(path, line), what, mend))
    lesson.__dict__["beats"] = tuple(beats)  # where a cached property keeps its value
    return lines


def _line_of(telling: object) -> int:
    """The line at which a generator stands."""
    frame = getattr(telling, "gi_frame", None)
    return int(frame.f_lineno) if frame is not None else 0


def _of_beat(beat: object, sizes: dict[Trace, int]) -> tuple[str, str] | None:
    """What is wrong with a beat before it is drawn, and the mend; ``sizes`` are the points of each trace so far."""
    if not isinstance(beat, Beat):
        what = phrase("it yields {kind}, which is no beat", kind=type(beat).__name__)
        return what, "yield show(…), play(…) or side_by_side(…)"
    for view in beat.views:
        if not 0 <= view.start <= view.stop <= len(view.trace.stages):
            what = phrase("it plays from stage {start:g} to {stop:g}", start=view.start, stop=view.stop)
            return what, phrase("stay between 0 and {last}, and play forwards", last=len(view.trace.stages))
        for each in filter(None, (view, view.over)):
            sizes[each.trace] = sum(s.n_points for s in each.trace.stages) + each.trace.control.topology.n_vertices
    if beat.predict is not None:
        try:
            checked(beat)
        except ValueError as fault:
            wrong, _, mend = str(fault).partition("; ")
            return wrong, mend
    if (total := sum(sizes.values())) > MOST_POINTS:
        what = phrase("the lesson has {total:,} points so far, and {most:,} at most can be shown well",
                      total=total, most=MOST_POINTS)  # fmt: skip
        return what, "take fewer levels, or a smaller object"
    return None


def _drawn(lesson: Lesson, lines: list[int], path: Path, began: float) -> Iterator[Fault]:
    """What is odd about beats that can be drawn: a claim that is not true.

    Raises
    ------
    LessonError
        If one cannot be drawn.
    """
    for told in dict.fromkeys((lesson, lesson.asking(True))):
        places = lines if told is lesson else [first_line(lesson)] * len(told.beats)
        _draw(told, places, path, began)
    for beat, line in zip(lesson.beats, lines, strict=True):
        if not beat.claim:
            yield Fault(
                path.name, line, text_at(path, line), "what it claims is not so", "see whether the text is true"
            )


def _draw(lesson: Lesson, lines: list[int], path: Path, began: float) -> None:
    """Draw the steps of a lesson whose beats are told at these lines, as long as there is time."""
    for stop in stops(lesson):
        if perf_counter() - began > DRAWING:
            return
        try:
            overlay(compose(at_stop(State(lesson), stop)), 1280, 720)
        except Exception as error:
            raise LessonError(_undrawn(fault_of(error, path, lines[stop.beat]))) from error


def _undrawn(fault: Fault) -> Fault:
    """A fault that came up while a beat was drawn."""
    what = phrase("its picture cannot be drawn ({reason})", reason=fault.what)
    return replace(fault, what=what, mend="look at its words between braces, its formula, marks and stencil")


if __name__ == "__main__":
    main(sys.argv[1:])

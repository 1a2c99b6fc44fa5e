"""Thousands of random actions on the real window: ``python -m tests.soak --actions 20000 --seed 1``.

Nothing may be raised, warned of or grow; told again without a window, what was done must lead to the same state; all of
it can be undone; and the same actions in a second window must lead to the same states.  What fails is shrunk to the
few actions that lead there.  It needs a screen; where there is none: ``xvfb-run -a -s "-screen 0 1920x1080x24"
python -m tests.soak``.
"""

import argparse
import os
import random
import sys
from pathlib import Path
from tempfile import gettempdir

os.environ.setdefault("QT_API", "pyside6")

from app.gui.application import NO_SCREEN, has_screen
from tests.gui.watchdog import LIMIT
from tests.soak import memory
from tests.soak.hand import Action, actions
from tests.soak.runs import Report, kind, ran, shrunk

AGAIN = 0.05
"""So much of a run is done again in a second window."""


def main() -> int:
    options = _options()
    if not has_screen():
        print(f'{NO_SCREEN}\nWithout a screen: xvfb-run -a -s "-screen 0 1920x1080x24" {sys.executable} -m tests.soak')
        return 2
    print(f"seed {options.seed}, {options.actions} actions", flush=True)
    wanted = _wanted(options)
    report = ran(wanted, options.folder, options.begin, loud=True)
    if options.table:
        print(table(report))
    sentences = [*_faults(report), *_grown(report)]
    if report.faults:
        print("\n".join([*sentences, "the last steps:", *report.steps]), flush=True)  # finding the fewest takes long
        sentences.append(_shrunk(wanted, report, options))
    elif not options.begin:
        sentences += _others(wanted[: round(max(AGAIN * len(wanted), 40))], report, options.folder)
    for sentence in sentences:
        print(sentence)
    print(f"{report.done} actions: {'failed' if sentences else 'held'}")
    return int(bool(sentences))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.soak", description=__doc__)
    parser.add_argument("--actions", type=int, default=20_000, help="how many (20000)")
    parser.add_argument("--seed", type=int, default=random.randrange(10**6), help="where the random numbers begin")
    parser.add_argument("--only", help="only the actions of these numbers: 3,7,20-30")
    parser.add_argument("--from", dest="begin", default="", help="a link to where they begin, else at the cube")
    parser.add_argument("--minutes", type=float, default=10.0, help="for shrinking what fails (10)")
    parser.add_argument("--folder", type=Path, default=Path(gettempdir()), help="for journals and reports")
    parser.add_argument("--no-table", dest="table", action="store_false", help="do not print times and memory")
    return parser.parse_args()


def _wanted(options: argparse.Namespace) -> list[Action]:
    every = actions(options.seed, options.actions)
    if not options.only:
        return every
    ranges = [part.partition("-") for part in options.only.split(",")]
    numbers = {k for first, _, last in ranges for k in range(int(first), int(last or first) + 1)}
    return [each for each in every if each.number in numbers]


def _shrunk(wanted: list[Action], report: Report, options: argparse.Namespace) -> str:
    """What leads to the fault: the last action from where it began, else the fewest from the beginning."""
    said = f"it takes: --actions {options.actions} --seed {options.seed} --only "
    last = wanted[report.done : report.done + 1]
    if report.link and kind(ran(last, options.folder, report.link)) == kind(report):
        return f"{said}{last[0].number} --from '{report.link}'"
    few = shrunk(wanted[: report.done + 1], report, options.folder, options.begin, options.minutes)
    return f"{said}{_ranges([each.number for each in few])}"


def _ranges(numbers: list[int]) -> str:
    """1,5-9: rising numbers as one word."""
    begins = [k for k in numbers if k - 1 not in numbers]
    ends = [k for k in numbers if k + 1 not in numbers]
    return ",".join(f"{a}-{b}" if a < b else str(a) for a, b in zip(begins, ends, strict=True))


def _faults(report: Report) -> list[str]:
    return [f"at {each['at']}:\n{each['said']}" for each in report.faults]


def _grown(report: Report) -> list[str]:
    grown = memory.growth(report.memory)
    is_judged = report.done >= memory.FEWEST and grown > memory.MOST
    return [f"the memory grew by {grown:.0f} MB in the second half, more than {memory.MOST:.0f}"] if is_judged else []


def _others(some: list[Action], report: Report, folder: Path) -> list[str]:
    """In a second window all states must be the same."""
    second = ran(some, folder)
    if second.faults:
        return ["in a second window:", *_faults(second)]
    other = [each for each in some if second.digests[str(each.number)] != report.digests[str(each.number)]]
    return [f"in a second window the state is another one after {other[0].number} {other[0].kind}"] if other else []


def table(report: Report) -> str:
    """Times of the kinds of action, where the window was held up longest, and the memory."""
    rows = ["action         times   ms each   ms at most"]
    for name, (count, total, most) in sorted(report.kinds.items(), key=lambda each: -each[1][1]):
        rows.append(f"{name:<12} {count:7d}  {1e3 * total / count:8.0f}  {1e3 * most:11.0f}")
    rows += ["", "times  excess  whole   busy  empty  while, and at"]
    rows += [f"{count:5d}  {said}" for count, _, _, said in report.gaps[:20]]
    rows.append(f"in all {report.labours} times its own work held the window up for more than {1e3 * LIMIT:.0f} ms")
    rows += ["", f"megabytes   {memory.curve(report.memory)}"]
    rows.append(f"grown in the second half: {memory.growth(report.memory):.1f} MB")
    return "\n".join(rows)


if __name__ == "__main__":
    raise SystemExit(main())

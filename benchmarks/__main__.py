"""``python -m benchmarks [WORD ...]``: one table of ratios, each with its bound and whether it holds.

Words choose sections: opensubdiv, shapes, beyond, growth, peers, window; all of them without words.  Every
engine has one thread and double precision.  The engines take turns, so that a slow moment of
the machine falls on both; figures are seconds of the processor, the best of the turns, for
other work only ever adds.
"""

import math
import os
import platform
import subprocess
import sys
from collections.abc import Callable
from itertools import product
from pathlib import Path

import numpy as np
import scipy
from scipy.spatial import KDTree

from benchmarks import window
from benchmarks.engines import BUILD, OpenSubdiv, Ours, build
from benchmarks.files import Control, write
from benchmarks.meshes import along, ball, creased, opened, quadrangulated, solid
from benchmarks.peers import PEERS
from subdivision import Scheme
from subdivision.schemes import CATMULL_CLARK, DOO_SABIN, KOBBELT, LOOP, MID_EDGE, MODIFIED_BUTTERFLY, SQRT3

SCHEMES = {scheme.name: scheme for scheme in (CATMULL_CLARK, LOOP)}
ROUNDS, BLINK = 11, 5e-3
"""How many turns each engine has at least; what is over in a blink has ten times as many."""

broken: list[str] = []


def main(words: list[str]) -> None:
    sections = {
        "opensubdiv": beside_opensubdiv, "shapes": creased_and_open, "beyond": beyond,
        "growth": growth, "peers": beside_peers,
        "window": beside_an_empty_window,
    }  # fmt: skip
    print(f"{processor()}, {os.cpu_count()} processors; Python {platform.python_version()}, numpy {np.__version__}, "
          f"scipy {scipy.__version__}; load {os.getloadavg()[0]:.1f}")  # fmt: skip
    for name in words or sections:
        sections[name]()
    print(f"\n{len(broken)} bounds do not hold" + "".join(f"\n  {line}" for line in broken))


def beside_opensubdiv() -> None:
    if why := build():
        print(f"\nOpenSubdiv: left out, {why}")
        return
    title("beside OpenSubdiv", "ours", "theirs")
    for control, scheme, levels in cases():
        compare(control, scheme, levels)


def cases() -> list[tuple[Control, Scheme, int]]:
    small, middle, large = ball(2903), ball(6000), ball(20_000)
    both = [(ball(300), 2), (small, 2), (middle, 3), (large, 2), (large, 3), (small, 4), (middle, 4)]
    of_cube = [(solid("cube"), CATMULL_CLARK, levels) for levels in (4, 5, 6, 7, 8, 9)]
    of_icosahedron = [(solid("icosahedron"), LOOP, levels) for levels in (5, 6, 7, 8)]
    return of_cube + of_icosahedron + [(c, scheme, n) for c, n in both for scheme in SCHEMES.values()]


def compare(control: Control, scheme: Scheme, levels: int) -> None:
    """Cold, warm and memory on one mesh, and that the points are the same."""
    theirs = OpenSubdiv(control, scheme, levels)
    ours = Ours(control, scheme, levels)
    needed = theirs.memory()
    fine = ours.refined()
    n_points = len(fine.points)
    n_faces = len(fine.topology.origin) // scheme.refinement.size
    case = f"{control.name}, {scheme.name}, {levels} levels, {n_faces:,} faces"
    apart, nearest = KDTree(fine.points).query(theirs.points())
    assert apart.max() < 1e-12 * levels, f"{case}: not the same points, {apart.max()} apart"
    assert len(np.unique(nearest)) == len(fine.points)
    del fine, apart, nearest

    deep = levels >= 4
    cold = in_turns(ours.cold, theirs.cold)
    if n_faces < 20_000:
        line(f"{case}: cold", *cold, bound=None, late=2e-3)
    else:
        line(f"{case}: cold", *cold, 0.9 if n_faces <= 100_000 else 0.2 if deep and n_faces >= 250_000 else 0.6)
    warm = in_turns(ours.warm, theirs.warm)
    if len(control.points) <= 16 and n_points >= 1000:
        line(f"{case}: warm", *warm, 0.6 if deep and n_faces >= 250_000 else 1.0)
    elif n_faces >= 250_000:
        line(f"{case}: warm", *warm, 0.6 if deep else 1.5)
    else:
        line(f"{case}: warm", *warm)
    if n_faces >= 250_000:
        line(f"{case}: memory", ours.memory() / 1e6, needed / 1e6, 0.6, unit="MB")
    theirs.close()


def creased_and_open() -> None:
    title("creased and open meshes, beside the closed smooth one, a face", "this", "smooth")
    for scheme in SCHEMES.values():
        plain = ball(6000)
        smooth = Ours(plain, scheme, 4)
        for control in (opened(plain), creased(plain, 10.0), creased(plain, 2.5)):
            other = Ours(control, scheme, 4)
            share = len(control.sizes) / len(plain.sizes)
            for what in ("first", "warm"):
                a, b = in_turns(getattr(other, what), getattr(smooth, what))
                line(
                    f"{control.name}, {scheme.name}, 4 levels: {what.replace('first', 'cold, for the first time')}",
                    a / share,
                    b,
                    1.5,
                )


def beyond() -> None:
    """Each beside Catmull-Clark on the same mesh; mid-edge takes two steps for one, Kobbelt needs quads."""
    title("the schemes beyond, a face, beside Catmull-Clark", "this", "CC")
    for n, levels, rounds in ((20_000, 2, ROUNDS), (3000, 4, 3)):
        control, quads = ball(n), quadrangulated(ball(n))
        plain, plain_quads = Ours(control, CATMULL_CLARK, levels), Ours(quads, CATMULL_CLARK, levels - 1)
        others = [Ours(control, DOO_SABIN, levels), Ours(control, MID_EDGE, 2 * levels)]
        others += [Ours(quads, KOBBELT, levels - 1)]
        others += [Ours(control, MODIFIED_BUTTERFLY, levels), Ours(control, SQRT3, levels + levels // 2)]
        for other in others:
            beside = plain_quads if other.control is quads else plain
            n_faces, made = (each.scheme.faces_after(each.topology(), each.levels) for each in (beside, other))
            case = f"{other.control.name}, {other.scheme.name}, {other.levels} levels, {made:,} faces"
            for what in ("cold", "warm"):
                a, b = in_turns(getattr(other, what), getattr(beside, what), rounds=rounds)
                line(f"{case}: {what}", a * n_faces / made, b, 2.0)


def growth() -> None:
    """On meshes numbered along their surface; numbered by chance, caches serve the less the more there is to read."""
    title("growth with the number of faces", "", "")
    for scheme, order in product(SCHEMES.values(), (along, None)):
        for levels, sizes in ((2, (8000, 16_000, 32_000)), (4, (2000, 4000, 8000))):
            engines = [Ours(order(ball(n)) if order else ball(n), scheme, levels) for n in sizes]
            for what in ("cold", "warm"):
                times = in_turns(*(getattr(engine, what) for engine in engines))
                exponent = float(np.polyfit(np.log(sizes), np.log(times), 1)[0])
                told = f"{scheme.name}, {levels} levels{'' if order else ', numbered by chance'}: {what} takes faces to"
                told = f"{told} the power of {exponent:.2f}"
                judged = f"{1.2:>8}  {verdict(exponent <= 1.2, told)}" if order else ""
                print(f"{told:<100}{'':>29}{judged}")


def beside_peers() -> None:
    title("beside other engines for Python, cold", "ours", "theirs")
    python = os.environ.get("BENCHMARK_PEERS", sys.executable)
    for name, (_, scheme) in PEERS.items():
        control, levels = ball(1500), 4
        write(control, BUILD / "peer.mesh")
        command = [python, "-m", "benchmarks.peers", name, str(BUILD / "peer.mesh"), str(levels), "3"]
        ours = min(in_turns(Ours(control, SCHEMES[scheme], levels).cold))
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            print(f"{name}: left out, {done.stderr.strip().splitlines()[-1]}")
            continue
        n_faces, theirs = done.stdout.split()[-2:]
        line(f"{name}, {scheme}, {int(n_faces):,} faces", ours, float(theirs), 0.25)


def beside_an_empty_window() -> None:
    title("the window, 1280 x 720, software OpenGL, beside an empty viewport of its size", "ours", "empty")
    for case, ours, theirs, bound, unit in window.rows():
        if theirs is not None:
            line(case, ours, theirs, bound)
        else:
            factor, told = (1e3, f"{1e3 * bound:g}") if unit else (1, f"{bound:g}")
            holds = verdict(ours <= bound, case) if bound < math.inf else ""
            print(f"{case:<100}{factor * ours:>7.0f} {unit:<2}{'':>19}{told if holds else '':>8}  {holds}", flush=True)


def in_turns(*runs: Callable[[], float], rounds: int = ROUNDS) -> list[float]:
    """The least seconds of each, one after the other, several times, after one turn not counted."""
    first = [run() for run in runs]
    rounds *= 10 if max(first) < BLINK else 1
    return [min(times) for times in zip(*([run() for run in runs] for _ in range(rounds)), strict=True)]


def title(what: str, ours: str, theirs: str) -> None:
    print(f"\n{what:<100}{ours:>10}{theirs:>10}{'ratio':>9}{'bound':>8}  holds")


def line(
    case: str, ours: float, theirs: float, bound: float | None = None, *, late: float = math.inf, unit: str = "ms"
) -> None:
    """One row: the ratio against its bound, or, where it is short, how much later we are."""
    factor = 1e3 if unit == "ms" else 1
    told, holds = "", ""
    if bound is not None:
        told, holds = f"{bound:g}", verdict(ours <= bound * theirs, case)
    elif late < math.inf:
        told, holds = f"+{late * 1e3:g} ms", verdict(ours - theirs <= late, case)
    print(
        f"{case:<100}{factor * ours:>7.2f} {unit}{factor * theirs:>7.2f} {unit}{ours / theirs:>9.2f}{told:>8}  {holds}"
    )


def verdict(holds: bool, case: str) -> str:
    if not holds:
        broken.append(case)
    return "yes" if holds else "NO"


def processor() -> str:
    told = Path("/proc/cpuinfo")
    lines = told.read_text().splitlines() if told.exists() else []
    return next((x.partition(":")[2].strip() for x in lines if x.startswith("model name")), platform.machine())


if __name__ == "__main__":
    main(sys.argv[1:])

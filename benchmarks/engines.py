"""Ours and theirs behind the same three questions: seconds cold, seconds warm, bytes."""

import subprocess
import sys
import time
from functools import cached_property
from pathlib import Path

import numpy as np

from benchmarks.files import Control, write
from subdivision import Mesh, Plan, Scheme, Topology, plan, subdivide
from subdivision.plans.tables import forget

FOLDER = Path(__file__).parent
BUILD = FOLDER.parent / "build" / "benchmarks"
COMMAND = ["g++", "-O3", "-march=native", "-o", str(BUILD / "opensubdiv"), str(FOLDER / "opensubdiv.cpp"), "-losdCPU"]


class Ours:
    """This engine: cold from arrays to arrays; warm by a plan made before, into memory it had before."""

    def __init__(self, control: Control, scheme: Scheme, levels: int) -> None:
        self.control, self.scheme, self.levels = control, scheme, levels
        self.creases = {(int(a), int(b)): control.sharpness for a, b in control.creases}

    def topology(self) -> Topology:
        c = self.control
        return Topology.from_corners(c.sizes, c.corners, len(c.points), creases=self.creases)

    @cached_property
    def plan(self) -> Plan:
        return plan(self.topology(), self.scheme, self.levels)

    @cached_property
    def _out(self) -> np.ndarray:
        return np.empty((self.plan.topology.n_vertices, 3))

    def refined(self) -> Mesh:
        fine = subdivide(Mesh(self.topology(), self.control.points), self.scheme, self.levels)
        assert fine.topology.origin.size  # the faces are part of the answer
        return fine

    def cold(self) -> float:
        start = time.process_time()
        self.refined()
        return time.process_time() - start

    def first(self) -> float:
        """The same, knowing no table of another mesh."""
        forget()
        return self.cold()

    def warm(self) -> float:
        plan, out = self.plan, self._out
        start = time.process_time()
        plan.apply(self.control.points, out)
        return time.process_time() - start

    def memory(self) -> int:
        """What one cold run adds to the peak of a fresh process."""
        return int(_fresh(self.control, self.scheme.name, self.levels))


class OpenSubdiv:
    """The C++ library, in a process of its own that answers line by line."""

    def __init__(self, control: Control, scheme: Scheme, levels: int) -> None:
        self.path = BUILD / "control.mesh"
        write(control, self.path)
        command = [str(BUILD / "opensubdiv"), str(self.path), scheme.name, str(levels)]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, what: str) -> str:
        assert self.process.stdin
        assert self.process.stdout
        print(what, file=self.process.stdin, flush=True)
        return self.process.stdout.readline()

    def cold(self) -> float:
        return float(self.ask("cold"))

    def warm(self) -> float:
        return float(self.ask("warm"))

    def memory(self) -> int:
        """To be asked after one cold run and nothing else."""
        self.cold()
        return int(self.ask("memory"))

    def points(self) -> np.ndarray:
        self.ask("save")
        return np.fromfile(f"{self.path}.points").reshape(-1, 3)

    def close(self) -> None:
        self.process.communicate()


def build() -> str:
    """Compile the peer; why it could not be done, or nothing."""
    BUILD.mkdir(parents=True, exist_ok=True)
    try:
        done = subprocess.run(COMMAND, capture_output=True, text=True)
    except FileNotFoundError:
        return "there is no g++"
    return "" if done.returncode == 0 else f"{' '.join(COMMAND)} failed (apt-get install libosd-dev?)"


def peak() -> int:
    """The most memory this process ever had, in bytes; Linux only, as getrusage begins with the peak of the parent."""
    status = Path("/proc/self/status").read_text()
    return int(status.partition("VmHWM:")[2].split()[0]) * 1024


def _fresh(control: Control, *words: object) -> str:
    BUILD.mkdir(parents=True, exist_ok=True)
    write(control, BUILD / "memory.mesh")
    command = [sys.executable, "-m", "benchmarks.memory", str(BUILD / "memory.mesh"), *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=True, cwd=FOLDER.parent).stdout

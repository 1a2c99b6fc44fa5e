"""All hostile files, then every reader fuzzed: ``python -m tests.hostile --minutes 10``, so many for each reader.

The fuzzer is atheris (``pip install .[strength]``); without it only the files are read.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path

from subdivision import files
from tests.hostile.corpus import corpus, sound
from tests.hostile.fuzz import WORDS
from tests.hostile.reading import failures


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.hostile", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0, help="of fuzzing, for each reader (10)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found = read_all(Path(folder))
    if find_spec("atheris") is None:
        print("readers not fuzzed: pip install .[strength]")
        return 1
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found += sum(pool.map(lambda suffix: fuzzed(suffix, round(60 * options.minutes)), files.READABLE))
    print("every file is read or refused in a sentence" if not found else f"{found} failures")
    return int(found > 0)


def read_all(folder: Path) -> int:
    n = found = 0
    for name, data in corpus():
        n += 1
        for failure in failures(name, data, folder):
            found += 1
            print(failure)
    print(f"{n} hostile files: {found} failures", flush=True)
    return found


def fuzzed(suffix: str, seconds: int) -> int:
    """1 if the reader has failed; the last lines of the log then say why, and where the file is that made it."""
    with tempfile.TemporaryDirectory() as folder:
        for name, data in [*corpus(worst=False), *sound().items()]:
            if name.endswith(suffix):
                (Path(folder) / name).write_bytes(data)
        run = _fuzz(suffix, seconds, Path(folder))
    log = run.stderr.splitlines()
    keys = ("stat::number_of_executed_units:", " cov:", "stat::peak_rss_mb:")
    files_read, branches, megabytes = (_last(log, key) for key in keys)
    held = "FAILED" if run.returncode else "held"
    print(f"{suffix}: {files_read} files in {seconds} s, {branches} branches, {megabytes} MB: {held}", flush=True)
    if run.returncode:
        print("\n".join(log[-40:]))
    return int(run.returncode != 0)


def _fuzz(suffix: str, seconds: int, folder: Path) -> subprocess.CompletedProcess[str]:
    with tempfile.NamedTemporaryFile("w", suffix=".words") as words:
        words.write("".join('"' + "".join(f"\\x{byte:02x}" for byte in word) + '"\n' for word in WORDS))
        words.flush()
        return subprocess.run(
            [sys.executable, "-m", "tests.hostile.fuzz", suffix, f"-max_total_time={seconds}", f"-dict={words.name}",
             f"-artifact_prefix={tempfile.gettempdir()}/hostile{suffix}-", "-print_final_stats=1", "-max_len=20000",
             str(folder)],
            capture_output=True, text=True, errors="replace", check=False,
        )  # fmt: skip


def _last(log: list[str], key: str) -> str:
    """The word behind the last ``key`` of a log."""
    return next((line.split(key)[1].split()[0] for line in reversed(log) if key in line), "no")


if __name__ == "__main__":
    raise SystemExit(main())

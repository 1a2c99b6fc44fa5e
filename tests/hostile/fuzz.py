"""One reader under coverage-guided fuzzing by atheris, in a process of its own: ``python -m tests.hostile.fuzz``.

Whatever the bytes are, the reader makes a mesh or raises a ``Fault``, soon and in little memory; libFuzzer mutates
them towards lines that have not run yet, and stops at the first failure.
"""

import resource
import sys

from tests.hostile.sentence import is_sentence

SECONDS = 2
MEGABYTES = 100
"""What one file may take beside four times its own size."""
ALL_MEGABYTES = 2000
"""Of the process: the fuzzer's own tables grow with every file."""
WORDS = (
    b"v 0 0 1\n", b"f 1 2 3\n", b"f -1 -2 -3\n", b"t crease 2/1/0 0 1 5\n", b"t corner 1/1/0 0 5\n", b"\\\n", b"OFF\n",
    b"4 1 0\n", b"element vertex ", b"element face ", b"property list uchar int vertex_indices\n",
    b"property float x\n", b"format binary_big_endian 1.0\n", b"format ascii 1.0\n", b"end_header\n", b"facet\n",
    b"outer loop\n", b"vertex 0 0 0\n", b"endfacet\n", b"nan", b"1e999", b"\0\0\0\3", b"\3\0\0\0", b"\r\n",
    b"\xef\xbb\xbf",
)  # fmt: skip


def peak() -> float:
    """The most memory the process has had, in megabytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main(suffix: str, arguments: list[str]) -> None:
    import atheris  # not among the packages the tests need

    with atheris.instrument_imports(include=["subdivision.files", "subdivision.manifold"]):
        from subdivision import files
        from subdivision.files.content import mesh_of
        from subdivision.files.faults import Fault
    reader = files._READERS[suffix]

    def one(data: bytes) -> None:
        before = peak()
        try:
            mesh_of(reader(data))
        except Fault as fault:
            said = f"mesh{suffix}, {fault.place}: {fault.what}; {fault.mend}".replace(", :", ":")
            if not is_sentence(said, f"mesh{suffix}"):
                raise AssertionError(said) from fault
        if peak() - before > MEGABYTES + 4 * len(data) / 2**20:
            raise AssertionError(f"{len(data)} bytes took {peak() - before:.0f} MB")

    atheris.Setup([sys.argv[0], f"-timeout={SECONDS}", f"-rss_limit_mb={ALL_MEGABYTES}", *arguments], one)
    atheris.Fuzz()


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])

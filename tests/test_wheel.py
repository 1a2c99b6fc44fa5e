"""The built wheel, unpacked elsewhere, runs and brings its assets."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory):
    out = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(out), str(ROOT)]
    subprocess.run(build, check=True, capture_output=True)
    (wheel,) = out.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(out / "site")
    return out / "site"


def run(unpacked, code):
    """Run Python with the unpacked wheel first on its path, far from the checkout."""
    environment = {**os.environ, "PYTHONPATH": str(unpacked)}
    command = [sys.executable, "-P", "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, cwd=unpacked, env=environment, check=True)
    return done.stdout.splitlines()


def test_the_wheel_lists_its_lessons_and_finds_its_fonts_and_references(unpacked):
    code = (
        "import app, lessons, subdivision; from app.cli import main; main(['lessons']); print(app.__file__); "
        "print(*sorted(str(p.relative_to(app.ASSETS)) for p in app.ASSETS.rglob('*')))"
    )
    *listed, where, assets = run(unpacked, code)
    assert any("figure_14_cube" in line for line in listed)
    assert Path(where).is_relative_to(unpacked)
    assert {"references.bib", "fonts/OFL.txt"} <= set(assets.split())


def test_the_wheel_writes_a_page_with_its_style_and_its_scripts(unpacked, tmp_path):
    out = str(tmp_path / "cube.html")
    code = (
        f"from pathlib import Path; import app; from app.cli import main; main(['page', '14', '-o', {out!r}]); "
        f"page = Path({out!r}).read_text(); "
        "print(all(p.read_text() in page for p in (Path(app.__file__).parent / 'page').glob('*.[cj]s*')))"
    )
    assert run(unpacked, code)[-1] == "True"


def test_the_wheel_holds_the_three_packages_and_nothing_else(unpacked):
    folders = {p.name for p in unpacked.iterdir() if not p.name.endswith(".dist-info")}
    assert folders == {"app", "lessons", "subdivision"}

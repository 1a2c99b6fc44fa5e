"""Imports point one way: app.gui -> app.figures -> app.draw -> app.state -> lessons -> subdivision."""

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
FILES = sorted(path for folder in ("subdivision", "lessons", "app") for path in (ROOT / folder).rglob("*.py"))
WINDOWS = {"PySide6", "PyQt5", "PyQt6", "shiboken6", "qtpy", "pyvistaqt"}
GRAPHICS = WINDOWS | {"pyvista", "vtk", "vtkmodules", "matplotlib", "PIL"}
IMPORTERS = {"__import__", "import_module", "importlib.import_module"}

# what a layer may import of this project; the longest name that fits a module decides
LAYERS = {
    "subdivision": ("subdivision",),
    "lessons": ("subdivision", "lessons"),
    "app.lately": ("app.lately",),
    "app.laboratory.lab": ("subdivision", "lessons", "app.lately", "app.laboratory.lab"),
    "app.words": ("subdivision", "app.words"),
    "app.state": ("subdivision", "lessons", "app.laboratory.lab", "app.words", "app.state"),
    "app.asking": ("subdivision", "lessons", "app.state", "app.asking"),
    "app.draw": ("subdivision", "lessons", "app.words", "app.state", "app.asking", "app.draw"),
    "app.figures": ("subdivision", "lessons", "app.words", "app.state", "app.asking", "app.draw", "app.figures"),
    "app.gui": ("subdivision", "lessons", "app"),
    "app": ("subdivision", "lessons", "app"),
}
PACKAGES = {"subdivision": {"numpy", "scipy"}, "lessons": {"numpy"}}


def module(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports(path: Path, *, at_import: bool = False) -> Iterator[str]:
    """Every module a file names, in functions too; or only those that importing the file itself imports."""
    pending: list[ast.AST] = [ast.parse(path.read_text(encoding="utf-8"))]
    while pending:
        node = pending.pop()
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path} imports relatively"
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Call) and ast.unparse(node.func) in IMPORTERS:
            yield from (a.value for a in node.args if isinstance(a, ast.Constant) and isinstance(a.value, str))
        if at_import and (isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda) or type_checking(node)):
            continue
        pending.extend(ast.iter_child_nodes(node))


def type_checking(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)


def within(name: str, package: str) -> bool:
    return name == package or name.startswith(package + ".")


def layer(name: str) -> str:
    return max((of for of in LAYERS if within(name, of)), key=len)


def owner(name: str) -> str:
    """The module that a dotted name is of: the name itself, or what is before its last dot."""
    path = ROOT.joinpath(*name.split("."))
    return name if path.is_dir() or path.with_suffix(".py").exists() else name.rpartition(".")[0]


each = pytest.mark.parametrize("path", FILES, ids=lambda path: module(path))


@each
def test_no_file_imports_a_layer_above_its_own(path: Path) -> None:
    allowed, of = LAYERS[layer(module(path))], module(path)
    for name in map(owner, imports(path)):
        ours = name.split(".")[0] in ("subdivision", "lessons", "app")
        constants = name == "app" and within(of, "app")  # the package itself: where the assets are
        assert not ours or constants or any(within(name, package) for package in allowed), f"{of} imports {name}"


def test_imports_are_found_wherever_they_hide(tmp_path: Path) -> None:
    file = tmp_path / "hidden.py"
    file.write_text("def f():\n    if 1:\n        from app.gui import window\n        return __import__('PySide6')\n")
    assert set(imports(file)) == {"app.gui.window", "PySide6"}
    assert set(imports(file, at_import=True)) == set()
    assert layer("app.gui.window") == "app.gui"
    assert not any(within("app.gui.window", package) for package in LAYERS["app.draw"])


def test_the_package_app_itself_imports_nothing_of_this_project() -> None:
    assert {name.split(".")[0] for name in imports(ROOT / "app" / "__init__.py")} <= set(sys.stdlib_module_names)


@each
def test_the_engine_and_the_lessons_know_numbers_only(path: Path) -> None:
    of = module(path).split(".")[0]
    if of not in PACKAGES:
        return
    known = {*sys.stdlib_module_names, *PACKAGES[of], "subdivision", "lessons"}
    assert {name.split(".")[0] for name in imports(path)} <= known


@each
def test_only_the_gui_names_qt(path: Path) -> None:
    if not within(module(path), "app.gui"):
        assert {name.split(".")[0] for name in imports(path)} & WINDOWS == set()


@each
def test_scheme_files_never_import_each_other(path: Path) -> None:
    if path.parent.name == "schemes" and path.name != "__init__.py":
        assert [name for name in imports(path) if within(name, "subdivision.schemes")] == []


@pytest.mark.parametrize("name", ["app.state", "app.draw", "app.figures", "app.cli"])
def test_drawing_starts_without_the_gui(name: str) -> None:
    files = [path for path in FILES if within(module(path), name)]
    assert not any(within(found, "app.gui") for path in files for found in imports(path, at_import=True))


@pytest.mark.parametrize(("packages", "foreign"), [
    (("subdivision", "lessons"), GRAPHICS), (("app.state", "app.cli"), WINDOWS), (("app.draw", "app.figures"), WINDOWS),
])  # fmt: skip
def test_importing_them_in_a_fresh_python_loads_no_graphics(packages: tuple[str, ...], foreign: set[str]) -> None:
    names = [module(path) for path in FILES if any(within(module(path), package) for package in packages)]
    listed = f"import sys, {', '.join(names)}; print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", listed], capture_output=True, text=True, check=True, cwd=ROOT)
    assert {name.split(".")[0] for name in run.stdout.split()} & foreign == set()

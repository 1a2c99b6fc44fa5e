"""A module that is put off costs nothing until it is used, and is then what it always was."""

import sys
from importlib import import_module

import pytest

from app.lean import put_off


@pytest.fixture
def package(tmp_path, monkeypatch):
    (tmp_path / "packed" / "slow").mkdir(parents=True)
    (tmp_path / "packed" / "__init__.py").write_text("runs = []\n")
    (tmp_path / "packed" / "slow" / "__init__.py").write_text("import packed\npacked.runs.append(1)\nvalue = 7\n")
    (tmp_path / "packed" / "slow" / "inside.py").write_text("value = 8\n")
    monkeypatch.syspath_prepend(tmp_path)
    yield import_module("packed")
    for name in [each for each in sys.modules if each.split(".")[0] == "packed"]:
        del sys.modules[name]


def test_an_import_does_not_load_what_was_put_off_but_its_first_use_does(package):
    put_off("packed.slow")
    import packed.slow as slow

    assert package.slow is slow
    assert slow.__spec__.name == "packed.slow"
    assert package.runs == []
    assert slow.value == slow.value == 7
    assert package.runs == [1]
    assert import_module("packed.slow") is package.slow is not slow


def test_a_part_of_what_was_put_off_can_be_imported_at_once(package):
    put_off("packed.slow")
    from packed.slow import value
    from packed.slow.inside import value as inner

    assert (value, inner, package.runs) == (7, 8, [1])


def test_what_is_loaded_already_and_what_does_not_exist_stay_as_they_are(package):
    slow = import_module("packed.slow")
    put_off("packed.slow")
    put_off("packed.missing")
    assert sys.modules["packed.slow"] is slow
    with pytest.raises(ModuleNotFoundError):
        import_module("packed.missing")

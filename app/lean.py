"""What libraries bring along and this program does not use waits until somebody uses it."""

import sys
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Any


def put_off(name: str) -> None:
    """Whoever imports this module of a package from now on gets a stand-in, which loads the module at its first use."""
    package, _, last = name.rpartition(".")
    if name not in sys.modules and (spec := find_spec(name)) is not None:
        stand_in = ModuleType(name)
        stand_in.__spec__, stand_in.__file__ = spec, spec.origin

        def used(attribute: str) -> Any:
            if sys.modules.get(name) is stand_in:
                del sys.modules[name]
            return getattr(import_module(name), attribute)

        stand_in.__getattr__ = used  # type: ignore[method-assign]
        sys.modules[name] = stand_in
        setattr(sys.modules[package], last, stand_in)

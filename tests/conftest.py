"""Engine tests need no screen; those of the window have their own conftest in tests/gui."""

import os

from hypothesis import settings

os.environ["LC_ALL"] = "C.UTF-8"  # English, wherever the tests run

settings.register_profile("studio", deadline=None, max_examples=25, derandomize=True)
settings.load_profile("studio")

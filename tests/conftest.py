"""Engine tests need no screen; those of the window have their own conftest in tests/gui."""

from hypothesis import settings

settings.register_profile("studio", deadline=None, max_examples=25, derandomize=True)
settings.load_profile("studio")

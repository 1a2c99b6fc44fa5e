# make run   opens the app; where there is no screen, draws every lecture figure into figures/
# make test  checks style and types, then runs all the tests, on a virtual screen where there is none
# Both first install what is missing (.ci/setup); once that is done they need no network.

export SCREEN := $(or $(DISPLAY),$(WAYLAND_DISPLAY),$(filter Darwin,$(shell uname -s)))

.PHONY: run test clean

run:
	@.ci/setup run
ifneq ($(SCREEN),)
	@.venv/bin/python -m app
else
	@echo "No screen here (DISPLAY and WAYLAND_DISPLAY are unset): drawing every lecture figure into figures/ instead."
	@.venv/bin/python -m app figures --out figures
endif

test:
	@.ci/setup test
	@.ci/check

clean:
	rm -rf .venv build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache

# make run   opens the app; where there is no screen, draws every lecture figure into figures/, with an index.html
# make test  checks style and types, then runs all the tests, on a virtual screen where there is none
# Both first install what is missing (.ci/setup); once that is done they need no network.

export SCREEN := $(or $(DISPLAY),$(WAYLAND_DISPLAY),$(filter Darwin,$(shell uname -s)))

.PHONY: run test pictures words type benchmarks clean

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

pictures: # the README's and the manual's, drawn again by the program
	@.ci/setup run
	@mkdir -p assets/pictures
	@.venv/bin/python -m app figures --out build/pictures/lecture --format png --size 960x540 --sheet assets/pictures/gallery.png
	@.venv/bin/python -m app figures 5 14 --steps --out build/pictures --format png --size 1440x810
	@.venv/bin/python -m app.manual.pictures assets/manual/pictures
	@$(if $(SCREEN),,xvfb-run -a -s "-screen 0 1920x1080x24") .venv/bin/python -m app.gui.shots assets/manual/pictures
	@cp build/pictures/figure_05_quadruple_then_average-03.png build/pictures/figure_14_cube-05.png assets/pictures

words: # every text into the catalogues of assets/languages, where what is new waits for its translation
	@.ci/setup test
	@.venv/bin/python -m tests.words

type: # the letters and formulas of the lessons into the tables of what is set beforehand
	@.ci/setup test
	@.venv/bin/python -m tests.type

strength: # every hostile file, every fault and 20,000 actions, in full: takes over an hour
	@.ci/setup test
	@.ci/strength

benchmarks: # how fast the engine is, beside others
	@.ci/setup run
	@.venv/bin/python -m benchmarks

clean:
	rm -rf .venv build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache

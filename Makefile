# `make demo` and `make test` each work alone, on a machine with Python 3.11 or later and make.
PYTHON ?= python3
VENV   ?= .venv
BIN    := $(VENV)/bin
READY  := $(VENV)/.ready
CORE   := $(wildcard src/plyfold/core/*.py src/plyfold/core/*.pxd tools/build_core.py tools/headers/*)
DEMO   ?= examples/ramp.svg

.PHONY: demo test test-busy test-slow nightly browser lint pictures benchmark benchmark-docs clean

demo: $(READY)  ## Lift an example: out/ gets a GLB, a 3D page and a picture of every stage
	@mkdir -p out
	@$(BIN)/plyfold check $(DEMO)
	@echo
	@$(BIN)/plyfold lift $(DEMO) --force -o out/demo.glb -o out/demo.html
	@$(BIN)/plyfold draw $(DEMO) --force -o out/demo.png
	@echo
	@echo "Open out/demo.html in a browser to turn the surface; out/demo.png shows every stage."
	@echo "Draw a loop of your own and see at once how it lies: $(BIN)/plyfold sketch"

test: $(READY) lint  ## Style, types, and every test but the slow ones
	@$(MAKE) --no-print-directory browser 2>/dev/null || echo "The tests of the pages are skipped."
	$(BIN)/python -m pytest -n 2
	PLYFOLD_PURE=1 $(BIN)/python -m pytest -n 2 tests/core tests/arrangement/test_crossings.py tests/arrangement/test_several.py

test-busy: $(READY)  ## The same beside eight busy processes: no test depends on how fast the machine is
	$(BIN)/python tools/busy.py 8 make --no-print-directory test

test-slow: $(READY)  ## The tests that take minutes: every curve with six crossings, and the slowest rounds of the page
	@$(MAKE) --no-print-directory browser 2>/dev/null || echo "The tests of the pages are skipped."
	$(BIN)/python -m pytest -n 2 -m slow

nightly: $(READY)  ## 100,000 random curves, lists of curves and outlines that touch themselves, 10,000 fronts of bodies and 1,000 solids, against the slow references: three hours; OPTIONS="--seconds 60" for a taste
	PYTHONPATH=tests $(BIN)/python -m nightly $(OPTIONS)
	PYTHONPATH=tests $(BIN)/python -m nightly.disturbed
	PYTHONPATH=tests $(BIN)/python -m nightly.scales
	PYTHONPATH=tests $(BIN)/python -m nightly.outlines
	PYTHONPATH=tests $(BIN)/python -m nightly.fills
	PYTHONPATH=tests $(BIN)/python -m nightly.repairs
	PYTHONPATH=tests $(BIN)/python -m nightly.homotopies
	PYTHONPATH=tests $(BIN)/python -m nightly.contacts
	PYTHONPATH=tests $(BIN)/python -m nightly.solids
	PYTHONPATH=tests $(BIN)/python -m nightly.heaps_of_outlines

browser:  ## A browser for the tests of the pages, where there is none: Debian's Chromium, if this is root on Debian
	@for program in chromium chromium-browser google-chrome; do \
	    if command -v $$program >/dev/null 2>&1; then exit 0; fi; \
	done; \
	if ! command -v apt-get >/dev/null 2>&1 || [ "$$(id -u)" != 0 ]; then \
	    echo "There is no Chromium, and it cannot be installed from here."; exit 1; \
	fi; \
	apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends chromium >/dev/null

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/python tools/house.py --check
	$(BIN)/mypy

pictures: $(READY)  ## Rebuild the pictures of the README and of docs
	@for script in docs/*pictures.py; do $(BIN)/python $$script || exit 1; done

benchmark: $(READY)  ## Times, memory and ratios against GEOS, from one run of at most ten minutes; see --help for OPTIONS
	$(BIN)/python benchmarks/run.py $(OPTIONS)

benchmark-docs: $(READY)  ## The same, written into docs/benchmarks.md, and surfaces into docs/surfaces.md
	$(BIN)/python benchmarks/run.py --docs $(OPTIONS)
	$(BIN)/python benchmarks/surfaces.py --docs

$(READY): pyproject.toml $(CORE)
	@if command -v uv >/dev/null 2>&1; then \
	    uv venv --quiet --allow-existing --python "$(PYTHON)" $(VENV) && uv pip install --quiet --python $(BIN)/python -e ".[test]"; \
	else \
	    "$(PYTHON)" -m venv $(VENV) && $(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[test]"; \
	fi
	@touch $(READY)

clean:
	rm -rf $(VENV) out .pytest_cache .mypy_cache .ruff_cache .hypothesis

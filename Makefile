# Two commands: `make demo` builds and checks every template, `make test` runs lint, types and all tests.
# `make quick` is for the time between two edits: what is fast and needs no other program. `make full`, before a release, runs
# every case where CI takes a part: an hour.
PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin

# Compiled modules are kept: without them each process that collects tests compiles 400 files anew, six seconds of it.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: demo test all-tests full quick quick-tests lint types reference pictures bench clean

$(VENV)/.ready: pyproject.toml requirements.lock
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade pip
	$(BIN)/python -m pip install --quiet --constraint requirements.lock --editable '.[test]'
	touch $@

demo: $(VENV)/.ready
	$(BIN)/python tools/demo.py templates generated

test: $(VENV)/.ready
	$(MAKE) -j3 lint types all-tests

all-tests: $(VENV)/.ready
	$(BIN)/python -m pytest -n auto --dist worksteal

full: $(VENV)/.ready
	MECHSHEET_ALL=1 $(MAKE) test

quick: $(VENV)/.ready
	$(MAKE) -j3 lint types quick-tests

quick-tests: $(VENV)/.ready
	$(BIN)/python -m pytest -n auto --dist worksteal --quick

lint: $(VENV)/.ready
	$(BIN)/ruff check --no-cache .
	$(BIN)/ruff format --no-cache --check .

types: $(VENV)/.ready
	$(BIN)/mypy

bench: $(VENV)/.ready
	for script in benchmarks/bench_*.py; do echo "== $$script"; $(BIN)/python $$script || exit 1; done

reference: $(VENV)/.ready
	$(BIN)/python tools/reference.py

pictures: $(VENV)/.ready
	$(BIN)/python tools/pictures.py

clean:
	rm -rf $(VENV) .mypy_cache .ruff_cache .hypothesis dist build

# Everything runs in .venv, which the targets make as they need it. A stamp file in .venv stands for each set of
# dependencies, and is made anew when pyproject.toml changes. The sets form a chain (lab, test, docs, bench), so that two
# targets made at once (make -j) never install at the same time. Only what binder/ lists gets an environment of its own.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
NOTEBOOK ?= notebooks/01_restore_a_section.ipynb
NOTEBOOKS = $(wildcard notebooks/*.ipynb)
BINDER := $(VENV)/binder
BINDER_PYTHON ?= $(shell python3.11 -c 'import sys; print(sys.executable)' 2>/dev/null || command -v $(PYTHON))
SOURCES = $(shell find seiswidgets -name '*.py' -o -name '*.js' -o -name '*.css')
AS_ROOT = $(if $(filter 0,$(shell id -u)),--allow-root)
# The JavaScript's tools run on the Node that comes with the tests. What npm itself writes last is their stamp.
NPM = PATH="$(abspath $(BIN)):$$PATH" $(BIN)/npm --loglevel=error
NODE_MODULES := node_modules/.package-lock.json
INSTALL = $(BIN)/python -m pip install --quiet --disable-pip-version-check --root-user-action=ignore

.DEFAULT_GOAL := help
.PHONY: help lab test check format js bench docs binder binder-check

help:  ## say what can be made
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-13s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))

lab: $(VENV)/.lab  ## open the notebook in JupyterLab (LAB_ARGS="--no-browser" and the like are passed on)
	$(BIN)/jupyter lab $(AS_ROOT) $(LAB_ARGS) $(NOTEBOOK)

# One thread a worker: pytest already runs as many workers as there are cores.
test: $(VENV)/.test $(NODE_MODULES)  ## run the tests (TEST_ARGS="-k picks" and the like are passed on to pytest)
	$(NPM) run --silent test
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/pytest -n auto $(TEST_ARGS)

check: $(VENV)/.test $(NODE_MODULES)  ## check style, the direction of imports, JavaScript, and that notebooks hold no output
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/lint-imports --no-logo
	$(NPM) run --silent check
	$(if $(NOTEBOOKS),$(BIN)/nbstripout --verify $(NOTEBOOKS))

format: $(VENV)/.test $(NODE_MODULES)  ## put code and notebooks into the form that check wants
	$(BIN)/ruff check --fix
	$(BIN)/ruff format
	$(NPM) run --silent format
	$(if $(NOTEBOOKS),$(BIN)/nbstripout $(NOTEBOOKS))

js: $(NODE_MODULES)  ## bundle the widgets' JavaScript and style sheets
	$(NPM) run --silent build

bench: $(VENV)/.bench  ## measure, beside other libraries
	$(BIN)/python benchmarks/run.py $(BENCH_ARGS)

docs: $(VENV)/.docs  ## make the pages of the documentation in docs/_build, notebooks and their pictures among them
	$(BIN)/sphinx-build -W --keep-going -q -c docs $(DOCS_ARGS) . docs/_build/html
	@echo "open docs/_build/html/docs/index.html"

binder: $(VENV)/.test  ## pin what Binder installs (BINDER_ARGS=--upgrade takes the newest)
	$(BIN)/uv pip compile --quiet --extra binder --python-version 3.11 --python-platform linux \
		--no-emit-index-url --no-emit-find-links --no-header --no-annotate $(BINDER_ARGS) \
		--output-file binder/requirements.txt pyproject.toml

binder-check: $(VENV)/.test $(BINDER)/.ready  ## install what binder/ lists, alone, and open notebooks in it
	SEISWIDGETS_BINDER=$(abspath $(BINDER)) $(BIN)/pytest -s tests/widgets/binder_check.py

$(VENV)/.lab: pyproject.toml | $(BIN)/pip
	@echo "installing what the lab needs"
	@$(INSTALL) --editable '.[lab,fast]'
	@touch $@

$(VENV)/.test: pyproject.toml $(VENV)/.lab
	@echo "installing what the tests need"
	@$(INSTALL) --editable '.[lab,fast,test]'
	@touch $@

$(NODE_MODULES): package.json package-lock.json .npmrc | $(VENV)/.test
	@echo "installing what the JavaScript's checks and tests need"
	@$(NPM) ci
	@touch $@

$(VENV)/.docs: pyproject.toml $(VENV)/.test
	@echo "installing what the documentation needs"
	@$(INSTALL) --editable '.[lab,fast,test,docs]'
	@touch $@

$(BINDER)/.ready: binder/requirements.txt binder/postBuild pyproject.toml $(SOURCES) | $(BIN)/pip
	@echo "installing what binder/ lists"
	@$(BINDER_PYTHON) -m venv $(BINDER)
	@$(BINDER)/bin/python -m pip install --quiet --disable-pip-version-check -r binder/requirements.txt
	@PATH="$(abspath $(BINDER))/bin:$$PATH" binder/postBuild
	@$(BINDER)/bin/python -m pip check
	@touch $@

$(VENV)/.bench: pyproject.toml $(VENV)/.docs
	@echo "installing what the benchmarks need"
	@$(INSTALL) --editable '.[lab,fast,test,docs,bench]'
	@touch $@

$(BIN)/pip:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "seiswidgets needs Python 3.11 or newer; name one with make PYTHON=python3.12" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
		{ echo "this Python cannot make a virtual environment; on Debian or Ubuntu: apt install python3-venv" >&2; exit 1; }
	@echo "making $(VENV)"
	@$(PYTHON) -m venv $(VENV)

# Everything runs in .venv, which the targets create as needed. Each set of dependencies has a stamp file in .venv and is
# installed again when pyproject.toml changes. The sets form a chain (lab, test, docs, bench), so that targets that run in
# parallel (make -j) never install at the same time. The wheel and the packages of binder/ are installed into
# environments of their own.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
NOTEBOOK ?= notebooks/01_restore_a_section.ipynb
NOTEBOOKS = $(wildcard notebooks/*.ipynb)
PACKAGE := $(VENV)/package
BINDER := $(VENV)/binder
BINDER_PYTHON ?= $(shell python3.11 -c 'import sys; print(sys.executable)' 2>/dev/null || command -v $(PYTHON))
SOURCES = $(shell find seiswidgets -name '*.py' -o -name '*.js' -o -name '*.css')
AS_ROOT = $(if $(filter 0,$(shell id -u)),--allow-root)
# The JavaScript tools run on the Node.js among the test dependencies; npm writes their stamp file last.
NPM = PATH="$(abspath $(BIN)):$$PATH" $(BIN)/npm --loglevel=error
NODE_MODULES := node_modules/.package-lock.json
INSTALL = $(BIN)/python -m pip install --quiet --disable-pip-version-check --root-user-action=ignore

.DEFAULT_GOAL := help
.PHONY: help lab dashboard test test-firefox check format js bench docs package binder binder-check

help:  ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-13s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))

lab: $(VENV)/.lab  ## open the first notebook in JupyterLab (LAB_ARGS="--no-browser" passes options on)
	$(BIN)/jupyter lab $(AS_ROOT) $(LAB_ARGS) $(NOTEBOOK)

dashboard: $(VENV)/.test  ## serve the app without a notebook at http://127.0.0.1:8866 (DASHBOARD_ARGS="--port=8000")
	cd notebooks && ../$(BIN)/voila dashboard.ipynb --no-browser $(DASHBOARD_ARGS)

# One thread per worker, since pytest runs as many workers as there are cores.
test: $(VENV)/.test $(NODE_MODULES)  ## run the tests (TEST_ARGS="-k picks" passes options on to pytest)
	$(NPM) run --silent test
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/pytest -n auto $(TEST_ARGS)

test-firefox: $(VENV)/.test  ## take a short walk through the app in Firefox, where there is one
	$(BIN)/pytest tests/widgets/firefox_check.py

check: $(VENV)/.test $(NODE_MODULES)  ## check style, types, import contracts, and that the notebooks contain no output
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/lint-imports --no-logo
	$(BIN)/mypy
	$(NPM) run --silent check
	$(if $(NOTEBOOKS),$(BIN)/nbstripout --verify $(NOTEBOOKS))

format: $(VENV)/.test $(NODE_MODULES)  ## format the code and strip the notebooks, as check requires
	$(BIN)/ruff check --fix
	$(BIN)/ruff format
	$(NPM) run --silent format
	$(if $(NOTEBOOKS),$(BIN)/nbstripout $(NOTEBOOKS))

js: $(NODE_MODULES)  ## bundle the JavaScript and the style sheets of the widgets
	$(NPM) run --silent build

bench: $(VENV)/.bench  ## run the benchmarks against other libraries
	$(BIN)/python benchmarks/run.py $(BENCH_ARGS)

docs: $(VENV)/.docs  ## build the documentation in docs/_build, running the notebooks
	$(BIN)/sphinx-build -W --keep-going -q -c docs $(DOCS_ARGS) . docs/_build/html
	@echo "open docs/_build/html/docs/index.html"

package: $(VENV)/.test  ## build the sdist and the wheel in dist/, and test the wheel in an empty environment
	rm -rf dist $(PACKAGE)
	$(BIN)/python -m build --quiet --installer uv
	$(BIN)/uv venv --quiet --python $(BIN)/python $(PACKAGE)
	$(BIN)/uv pip install --quiet --python $(PACKAGE) dist/*.whl
	SEISWIDGETS_DIST=$(abspath dist) SEISWIDGETS_PACKAGE=$(abspath $(PACKAGE)) $(BIN)/pytest tests/package_check.py

binder: $(VENV)/.test  ## pin the packages that Binder installs (BINDER_ARGS=--upgrade takes the newest)
	$(BIN)/uv pip compile --quiet --extra binder --python-version 3.11 --python-platform linux \
		--no-emit-index-url --no-emit-find-links --no-header --no-annotate $(BINDER_ARGS) \
		--output-file binder/requirements.txt pyproject.toml

binder-check: $(VENV)/.test $(BINDER)/.ready  ## install the pinned packages into an empty environment and open notebooks
	SEISWIDGETS_BINDER=$(abspath $(BINDER)) $(BIN)/pytest -s tests/widgets/binder_check.py

$(VENV)/.lab: pyproject.toml | $(BIN)/pip
	@echo "installing JupyterLab and seiswidgets"
	@$(INSTALL) --editable '.[lab,fast]'
	@touch $@

$(VENV)/.test: pyproject.toml $(VENV)/.lab
	@echo "installing the packages for the tests"
	@$(INSTALL) --editable '.[lab,fast,test]'
	@touch $@

$(NODE_MODULES): package.json package-lock.json .npmrc | $(VENV)/.test
	@echo "installing the packages that check and test the JavaScript"
	@$(NPM) ci
	@touch $@

$(VENV)/.docs: pyproject.toml $(VENV)/.test
	@echo "installing the packages for the documentation"
	@$(INSTALL) --editable '.[lab,fast,test,docs]'
	@touch $@

$(BINDER)/.ready: binder/requirements.txt binder/postBuild pyproject.toml $(SOURCES) | $(BIN)/pip
	@echo "installing the packages pinned in binder/"
	@$(BINDER_PYTHON) -m venv $(BINDER)
	@$(BINDER)/bin/python -m pip install --quiet --disable-pip-version-check -r binder/requirements.txt
	@PATH="$(abspath $(BINDER))/bin:$$PATH" binder/postBuild
	@$(BINDER)/bin/python -m pip check
	@touch $@

$(VENV)/.bench: pyproject.toml $(VENV)/.docs
	@echo "installing the packages for the benchmarks"
	@$(INSTALL) --editable '.[lab,fast,test,docs,bench]'
	@touch $@

$(BIN)/pip:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "seiswidgets needs Python 3.11 or newer; choose one, as in make PYTHON=python3.12" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
		{ echo "this Python cannot create virtual environments; on Debian or Ubuntu: apt install python3-venv" >&2; exit 1; }
	@echo "creating $(VENV)"
	@$(PYTHON) -m venv $(VENV)

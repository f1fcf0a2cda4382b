# Development tasks: `make` lists them. Everything is installed in .venv and nowhere else, so a plain machine with
# make and python3 (3.11 or newer, with its venv module) is enough. To use another interpreter, which is then kept:
#
#   make PYTHON=python3.12 test

VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.stamp
UNFINISHED := $(VENV)/.unfinished
OUT := out/reproduce
SITE := out/site
EXTRA := dev
WEB := mjcont/explorer/web

# Tests start many processes: compiled once, the package starts faster in each.
unexport PYTHONDONTWRITEBYTECODE

# Without PYTHON=, an environment that is there keeps the interpreter it was made with.
ifeq ($(origin PYTHON),undefined)
PYTHON := $(or $(shell sed -n 2p $(STAMP) 2>/dev/null),python3)
endif

# The stamp, written last, holds the folder (an environment does not survive a move) and the interpreter. When they
# differ, or the interpreter has gone or changed its version, the environment is made anew.
STAMP_TEXT = printf '%s\n' "$(CURDIR)" "$(PYTHON)"
FRESH := $(shell $(BIN)/python -c 'import pip' 2>/dev/null && $(STAMP_TEXT) | cmp -s - $(STAMP) && echo yes)

.DEFAULT_GOAL := help
.PHONY: help env reproduce reproduce-fast test test-slow test-long test-fuzz test-shaken test-shaken-fast test-kernels \
	test-faults thirdparty test-thirdparty test-explorer explorer-bundle explorer-check docs try-release \
	bench clean FORCE

help: ## list these targets
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1 # \2/p' $(MAKEFILE_LIST) | awk -F' # ' '{ printf "%-23s %s\n", $$1, $$2 }'

env: $(STAMP) ## make .venv, with mjcont (editable) and the tools, at the versions in constraints.txt

reproduce: env ## draw the paper's figures and check its findings, in out/reproduce
	$(BIN)/mjcont reproduce -o $(OUT)

reproduce-fast: env ## the figures that take seconds only
	$(BIN)/mjcont reproduce 3 5 -o $(OUT)

test: env ## lint, rooms, types and tests
	$(BIN)/ruff check
	$(BIN)/lint-imports
	$(BIN)/mypy
	$(BIN)/pytest -q -n auto --dist loadfile --no-loadscope-reorder

test-slow: env ## tests of a quarter of a second or more
	$(BIN)/pytest -q -n auto --dist loadfile --no-loadscope-reorder -m "slow and not long and not shaken and not thirdparty and not browser"

test-long: env ## the tests that take minutes
	$(BIN)/pytest -q -n auto -m "long and not thirdparty"

test-fuzz: env ## many random problems whose special points and stability are known, seeds printed
	$(BIN)/pytest -q -n auto -m fuzz

test-shaken: env ## special points and stability under noise as large as rounding, ten seeds (one: SEED=3)
	$(BIN)/pytest -q -n auto --dist loadgroup -m shaken $(if $(SEED),-k seed$(SEED))

test-shaken-fast: env ## of these, curves that take seconds, two seeds
	$(BIN)/pytest -q -n auto --dist loadgroup -m "shaken and fast"

test-kernels: env ## the tests under every BLAS kernel that this processor can run (minutes each)
	$(BIN)/python tests/kernels.py

test-faults: env ## damaged files, full disks, kills: whole campaigns (a tenth is in make test); SEED=0
	cd tests && ../$(BIN)/python -m faults --seed $(or $(SEED),0)

thirdparty: env ## download models from other packages, in .thirdparty
	@$(BIN)/python tests/problems/thirdparty.py

test-thirdparty: thirdparty ## the tests on models that none of us wrote
	$(BIN)/pytest -q -n auto -m thirdparty

explorer-bundle: ## build the explorer's script and style sheet from its sources (needs Node 20 and npm; users do not)
	cd $(WEB) && npm ci --silent && npm run --silent build

test-explorer: env ## the explorer in a headless browser (Debian's package chromium), and its processes
	$(BIN)/pytest -q -m browser tests/explorer

explorer-check: ## whether the script and the style sheet in the package are what their sources build to
	cd $(WEB) && npm ci --silent && npm run --silent check

docs: ## build the pages in out/site, in an environment of its own (.venv-docs), and check what leads where
	@$(MAKE) --no-print-directory VENV=.venv-docs EXTRA=docs env
	.venv-docs/bin/python -m sphinx -W --keep-going -q -j 2 -b html docs $(SITE)
	.venv-docs/bin/python docs/check_site.py $(SITE)

try-release: env ## build sdist and wheel twice, install in fresh environments, follow what pages show; PYTHONS="python3.12 ..."
	$(BIN)/python tests/release.py $(PYTHONS)

bench: env ## measure speed beside a floor and peers, in out/benchmarks.json (half an hour; QUICK=1: minutes)
	$(BIN)/python -m benchmarks -o out/benchmarks.json $(if $(QUICK),--quick)

clean: ## remove .venv, .venv-docs, builds and caches; results in out/ stay
	@for venv in $(VENV) .venv-docs; do \
	  if test -e $$venv/.stamp || test -e $$venv/.unfinished; then rm -f $$venv/.stamp && rm -rf $$venv; fi; done
	rm -rf build dist docs/api docs/examples *.egg-info .import_linter_cache .mypy_cache .pytest_cache .ruff_cache
	find mjcont scripts tests -name __pycache__ -prune -exec rm -rf {} + 2>/dev/null || true

$(STAMP): pyproject.toml constraints.txt $(if $(FRESH),,FORCE)
	@fail() { echo "mjcont: $$*" >&2; exit 1; }; \
	command -v "$(PYTHON)" >/dev/null || \
	  fail "no command '$(PYTHON)': install Python 3.11 or newer (on Debian: python3 and python3-venv), or name one with 'make PYTHON=...'"; \
	version=$$("$(PYTHON)" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null) || \
	  fail "'$(PYTHON)' does not run: name a working Python 3.11 or newer with 'make PYTHON=...'"; \
	"$(PYTHON)" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  fail "Python 3.11 or newer is needed, and '$(PYTHON)' is $$version: name a newer one with 'make PYTHON=...'"; \
	test ! -e $(VENV) || test -e $(STAMP) || test -e $(UNFINISHED) || \
	  fail "$(VENV) was not made by this Makefile: move it away, or use another folder with 'make VENV=.venv-make ...'"; \
	"$(PYTHON)" -c 'import ensurepip, venv' 2>/dev/null || \
	  fail "'$(PYTHON)' has no venv module: on Debian and Ubuntu, install the package python$$version-venv"; \
	trap 'test -e $(STAMP) || rm -rf $(VENV)' EXIT; trap 'exit 130' HUP INT TERM; \
	rm -f $(STAMP) && rm -rf $(VENV) && mkdir $(VENV) && touch $(UNFINISHED) || exit 1; \
	said=$$("$(PYTHON)" -m venv $(VENV) 2>&1) || \
	  fail "'$(PYTHON) -m venv' failed; on Debian and Ubuntu, the package python$$version-venv brings what it needs ($$(echo "$$said" | tail -n 1))"; \
	echo "installing mjcont and its tools in $(VENV), with Python $$version"; \
	$(BIN)/python -m pip install --quiet --no-compile --no-input --disable-pip-version-check -c constraints.txt -e '.[$(EXTRA)]' || \
	  fail "installing did not finish, and $(VENV) is removed: see pip's message above, then run make again"; \
	$(STAMP_TEXT) >$(STAMP) && rm $(UNFINISHED)

FORCE:

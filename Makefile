# Everything a user does, one target each; `make help` lists them.
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := help

PYTHON ?= python3
VENV ?= .venv
JOBS ?= 2
UI_PORT ?= 5057
VERIFY ?=
# On a terminal, one display of the progress; Snakemake's log is below .snakemake/log. The display is on
# standard error: standard output is a pipe in `$(...)`.
SNAKEMAKE = snakemake $$(test -t 2 && echo --logger rich) -j$(JOBS)
# `value`, since a path may hold a dollar sign.
export SETUP_PYTHON := $(value PYTHON)
export SETUP_VENV := $(if $(filter /%,$(value VENV)),,$(CURDIR)/)$(value VENV)
export PATH := $(SETUP_VENV)/bin:$(value PATH)
export DVC_NO_ANALYTICS := 1
export MLFLOW_DISABLE_TELEMETRY := true

.PHONY: help setup table1 demo test test-slurm test-workflow bad-input verify coverage mutation bench lint format \
    publish ui report results docs release clean lock

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z0-9-]+:.*## / {printf "  make %-12s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

setup: ## virtual environment from the lock file, and the off-screen GL library
	@workflow/envs/set_up.sh

table1: setup ## the main job: from parameters to Table I
	$(SNAKEMAKE) reports/table1.csv
	@echo "Table I: reports/table1.md"

demo: setup ## the whole pipeline on 2 objects, in build/demo
	python -m grasptypes.versions.checkout . build/demo tests/small.yaml
	cd build/demo && $(SNAKEMAKE) reports/table1.csv && cat reports/table1.md

# The folder has its own parameters, data, models, reports and dvc.lock; DVC's cache and MLflow's store are shared.
# It starts with the results at hand, so that only what depends on the hand is computed.
HAND ?=
HAND_FOLDER = hands/$(notdir $(HAND))
.PHONY: hand
hand: setup ## the main job with another hand, on a branch in hands/HAND: make hand HAND=robotiq_3f
	@test -n "$(HAND)" || { echo "error: name the hand: make hand HAND=robotiq_3f" >&2; exit 1; }
	test -e $(HAND_FOLDER) || git worktree add $(HAND_FOLDER) -b hand-$(notdir $(HAND))
	test -e $(HAND_FOLDER)/data -o ! -e data || cp -r --reflink=auto .snakemake data $(HAND_FOLDER)
	cd $(HAND_FOLDER) && sed -i 's|^hand: .*|hand: $(HAND)|; s|database: mlflow.db|database: ../../mlflow.db|' params.yaml
	cd $(HAND_FOLDER) && dvc cache dir --local ../../.dvc/cache && dvc repro

.PHONY: generalisation scaling test-own lowest
generalisation: setup ## what more shapes of every object buy on unseen objects: reports/generalisation.csv
	$(SNAKEMAKE) reports/generalisation.csv

test-own: setup ## three tasks, four objects, one of them a mesh with a measured contact map: to Table I
	pytest -m slow tests/workflow/test_own_things.py

.PHONY: kinds
kinds: setup ## contact sheets of all kinds of objects: reports/kinds/<group>.png
	$(SNAKEMAKE) kind_sheets

scaling: setup ## time and memory against the number of objects: reports/scaling.csv
	python benchmarks/scaling.py

test: setup ## the default tests
	pytest -n $(JOBS)

lowest: setup ## test the library with the lowest versions that its ranges allow, in build/lowest
	$(PYTHON) -m venv --clear build/lowest
	python tests/lowest.py > build/lowest.txt
	build/lowest/bin/pip install -q --disable-pip-version-check -r build/lowest.txt
	PYTHONPATH=src build/lowest/bin/python -m pytest tests/unit/hands tests/unit/objects tests/unit/commands/test_label.py \
	    tests/unit/labels/test_contacts.py tests/unit/labels/test_grasp_type.py --ignore tests/unit/hands/test_visuals.py

test-workflow: setup ## all that docs/versions.md and docs/reliability.md say, on 2 objects; about half an hour
	pytest tests/workflow -m "slow or not slow"

test-slurm: setup ## the small configuration on a Slurm cluster of this machine (slurm-wlm and munge)
	pytest tests/slurm

bad-input: setup ## try every mistake a user can make and write docs/bad_input.md
	python -W ignore tests/bad_input/table.py

verify: setup ## compute everything twice from nothing, -j1 and -j2, and compare every file; VERIFY=tests/small.yaml
	rm -rf build/verify
	python tests/workflow/verify.py build/verify $(VERIFY)

coverage: setup ## line coverage of src/ by the default tests, what Snakemake's jobs run included
	pytest -n $(JOBS) --cov --cov-report term

mutation: setup ## which changes of labelling, folds and metrics the tests do not notice
	mutmut run && mutmut results && mutmut export-cicd-stats && cat mutants/mutmut-cicd-stats.json

bench: setup ## each figure of speed beside its reference; most parts need results to be there
	python -m benchmarks

lint: setup ## style, types and workflow checks
	ruff check . && ruff format --check . && mypy && snakefmt --check Snakefile workflow

format: setup ## rewrite files in the project's style
	ruff check --fix . && ruff format . && snakefmt Snakefile workflow

publish: setup ## show the trained models in MLflow again; adds nothing that is there already
	$(SNAKEMAKE) publish_runs --force

ui: setup ## publish, then the MLflow UI on 127.0.0.1, few processes
	-$(SNAKEMAKE) publish_runs --force
	@python -m grasptypes.runs.ui $(UI_PORT)

report: setup ## the results with captions as one HTML page that opens offline: build/report.html
	@mkdir -p build
	$(SNAKEMAKE) results
	python -m grasptypes.reports.timing
	snakemake shown --report build/report.html --report-stylesheet workflow/report/page.css
	@echo "open build/report.html in a browser"

results: setup ## copy what README and docs quote from reports/ to docs/results/
	@for file in docs/results/*; do new="reports/$${file##*/}"; \
	    if [ -e "$$new" ]; then cp "$$new" "$$file"; else echo "$$file stays: there is no $$new"; fi; done

# Material announces its own successor unless the variable is set.
docs: setup ## check the spelling, and build the documentation as a site: build/site
	pip install -q --disable-pip-version-check --no-build-isolation -c requirements.lock -e '.[docs]'
	git ls-files -z | xargs -0 codespell
	NO_MKDOCS_2_WARNING=1 mkdocs build --strict

release: setup ## the dataset as one folder for other programs: build/release
	$(SNAKEMAKE) objects grasps screenshots renders data/grasps.csv data/samples.csv data/folds.csv
	rm -rf build/release
	python -m grasptypes.release.writing build/release

clean: ## remove what can be rebuilt outside the data: logs, demo, caches
	rm -rf build logs mutants .coverage* .pytest_cache .ruff_cache .mypy_cache

lock: setup ## write requirements.lock anew from the ranges of pyproject.toml
	pip-compile --quiet --extra workflow --extra dev --extra cluster --strip-extras --no-header --annotation-style line \
	    --no-emit-index-url --no-emit-find-links --no-emit-trusted-host -o build/all.lock pyproject.toml
	{ echo "# Written by make lock. The CUDA libraries are left out: torch itself pins the ones its build needs,"; \
	  echo "# and its CPU build needs none."; \
	  grep -vE '^(nvidia|cuda|triton|grasptypes)|^$$|^#' build/all.lock; } > requirements.lock

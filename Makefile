# Every target sets up what it needs; the environment is .venv/ in this folder.
#   make sweep CONFIG=configs/smoke.toml      another sweep than the default

CONFIG ?= configs/armor.toml
NAME = $(shell basename "$(CONFIG)" .toml)
RESULTS ?= results/$(NAME).h5
TABLES ?= results/$(NAME)

PYTHON = .venv/bin/python
STAMP = .venv/.ready

# An environment whose interpreter has gone is made anew.
$(shell $(PYTHON) -c '' 2>/dev/null || rm -f $(STAMP))

# Python keeps compiled modules, whatever the environment says: tests and their processes start sooner.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: help setup sweep rank lint style types types_of_windows test slow stock mutants verify validate elements continuum accuracy mesh steps pictures rammed gyroid \
        bars spread effort search sides wide memory stability torture scale plates plates_solid surfaces gyroid_mesh bench published experiment along figures site clean
.DELETE_ON_ERROR:

help:  ## print this list
	@awk -F ':.*## ' '/^[a-z_]+:.*## / {printf "make %-12s  %s\n", $$1, $$2}' $(firstword $(MAKEFILE_LIST))

setup: $(STAMP)  ## make the environment: Python 3.11 to 3.13, packages from requirements.lock

$(STAMP): requirements.lock pyproject.toml .ci/setup
	@sh .ci/setup
	@touch $@

sweep: setup  ## simulate what CONFIG asks for (finished cases are kept) and rank it
	@$(PYTHON) -m sweep run "$(CONFIG)" --out "$(RESULTS)"; status=$$?; test $$status -le 1 || exit $$status; \
	$(PYTHON) -m sweep rank "$(RESULTS)" --out "$(TABLES)" && exit $$status

rank: setup  ## rank the results of CONFIG again, running the sweep first if there are none
	@if test -f "$(RESULTS)"; then $(PYTHON) -m sweep rank "$(RESULTS)"; \
	else $(PYTHON) -m sweep run "$(CONFIG)" --out "$(RESULTS)" || test $$? -eq 1; fi
	@$(PYTHON) -m sweep rank "$(RESULTS)" --out "$(TABLES)"

site: setup  ## build the documentation as a site that can be searched, into build/site/
	@$(PYTHON) -c "import mkdocs, mkdocstrings" 2>/dev/null || uv pip install --quiet --python $(PYTHON) -e ".[docs]" 2>/dev/null || $(PYTHON) -m pip install --quiet -e ".[docs]"
	@rm -rf build/pages && mkdir -p build/pages
	@find CHANGELOG.md CONTRIBUTING.md GLOSSARY.md README.md configs docs kernels -name '*.md' -o -name '*.png' -o -name '*.ipynb' | tar cf - -T - | tar xf - -C build/pages
	@$(PYTHON) -m mkdocs build --strict

lint: setup  ## check style and types, those of Windows too, in two processes
	@$(MAKE) --no-print-directory --jobs 2 style types types_of_windows

style types types_of_windows: setup

style:
	$(PYTHON) -m ruff check

types:
	$(PYTHON) -m mypy

types_of_windows:
	$(PYTHON) -m mypy --platform win32 --cache-dir .mypy_cache/win32

# Kernels are compiled by the tests of these, once (tests/conftest.py).
test: setup lint  ## check style and types, then run the tests, in two processes
	$(PYTHON) -m pytest -m "not slow" -n 2 --dist loadgroup --no-loadscope-reorder

slow: setup  ## run the slow tests that make test leaves out (3 min)
	$(PYTHON) -m pytest -m slow -n 2 --dist loadgroup --no-loadscope-reorder

stock: setup  ## run the tests with the stock compiler (kernels/compile/README.md)
	CRUMPLE_COMPILER=stock $(PYTHON) -m pytest -n 2 --dist loadgroup --no-loadscope-reorder

mutants: setup  ## flip signs in the kernels and see which test turns red; goes to results/mutants/
	@$(PYTHON) -m tests.studies.mutants results/mutants

verify: setup  ## compute the numbers of README.md again, from results/armor.h5, with references
	@test -f results/armor.h5 || $(PYTHON) -m sweep run configs/armor.toml
	@$(PYTHON) -m tests.studies.verify results/armor.h5

validate: setup  ## solve reference problems at three meshes; the table goes to results/validation/
	@$(PYTHON) -m tests.studies.validation results/validation

elements: setup  ## compare cubic and classical elements on coarse meshes; goes to results/elements/
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.validation.elements results/elements

continuum: setup  ## compare with stored crushes of solids; goes to results/continuum/
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.continuum results/continuum

accuracy: setup  ## tell error against run time; tables and figures go to results/accuracy/
	@failed=0; for study in configs/accuracy/*.toml; do $(PYTHON) -m sweep accuracy $$study || failed=$$?; \
	test $$failed -le 1 || break; done; exit $$failed

mesh: setup  ## measure how many elements a wall needs; kept in results/mesh/ (10 min)
	@$(PYTHON) -m tests.studies.mesh results/mesh

steps: setup  ## measure how long load steps may be; kept in results/steps/ (10 min)
	@$(PYTHON) -m tests.studies.mesh.steps results/steps

rammed: setup  ## ram a panel with three fronts; the rankings and the picture of docs/rammed.md (40 min)
	@$(PYTHON) -m sweep run configs/rammed.toml > results/rammed.txt
	@$(PYTHON) -m sweep rank results/rammed.h5 --top 5
	@$(PYTHON) -m sweep rank results/rammed.h5 --out results/rammed
	@cp results/rammed/winners.png docs/pictures/rammed.png

gyroid: setup  ## press sheets and prisms both ways; the table and the picture of README.md (25 min)
	@$(PYTHON) -m sweep run configs/gyroid.toml > results/gyroid.txt
	@COLUMNS=104 $(PYTHON) -m sweep rank results/gyroid.h5 --top 18
	@$(PYTHON) -m sweep show results/gyroid.h5 4df76c33
	@cp results/gyroid/*/shapes.png docs/pictures/gyroid.png

bars: setup  ## measure whether error bars cover the error; kept in results/bars/ (10 min)
	@$(PYTHON) -m tests.studies.rankings.bars results/bars

spread: setup  ## measure how much columns move with mesh, imperfection, steps; kept in results/spread/
	@$(PYTHON) -m tests.studies.rankings.spread results/spread

effort: setup  ## check that stopped cases never change the first design without a notice; in results/effort/
	@$(PYTHON) -m tests.studies.rankings.effort results/effort

search: setup  ## compare what optimize finds with a scan and with a grid; kept in results/search/ (2 min)
	@$(PYTHON) -m tests.studies.rankings.search results/search

sides: setup  ## compare narrow strips, with free and with tied sides, with a wide panel; kept in results/sides/ (6 min)
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.sides results/sides

wide: setup  ## press panels of 24 and 48 cells, of all infills, and tell the cost; kept in results/wide/ (6 min)
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.sides.wide results/wide

memory: setup  ## measure what loss and softening change; goes to results/memory/ (10 min)
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.memory results/memory

plates: setup  ## compare shells with the theory of plates, at five meshes
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.plates

plates_solid: setup  ## compare a square tube of shells with one of bricks, through buckling (15 min)
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.plates.gate

surfaces: setup  ## compare a gyroid of shells with one of bricks, at three densities and five meshes (5 min)
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.surfaces

gyroid_mesh: setup  ## crush a gyroid with 8 to 16 quads a period; kept in results/surfaces/ (10 min)
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.surfaces.mesh results/surfaces

stability: setup  ## crush 1,000 stiff and extreme scenes; goes to results/stability/ (90 min)
	@$(PYTHON) -m tests.studies.stability results/stability

torture: setup  ## damage files and inputs, poison cases, kill commands and workers; goes to results/torture/ (25 min)
	@$(PYTHON) -m tests.studies.torture results/torture

scale: setup  ## time every verb on 20,000 and 100,000 invented cases; goes to results/scale/ (20 min, 6 GB)
	@$(PYTHON) -m tests.studies.scale results/scale

bench: setup  ## measure how fast it is; the tables go to results/bench/
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.bench results/bench

pictures: setup  ## draw the pictures of README.md again, from results/infills.h5
	@$(PYTHON) -m sweep run configs/infills.toml > results/infills.txt
	@$(PYTHON) -m sweep rank results/infills.h5 --out results/infills
	@cp results/infills/winners.png docs/pictures/collapse.png
	@cp results/infills/patterns.png docs/pictures/patterns.png

published: setup  ## predict published crushes again, beside the measured values; goes to results/published/ (20 min)
	@OMP_NUM_THREADS=1 $(PYTHON) -m sweep published --run --out results/published

experiment: setup  ## predict a measured crush and its sensitivities; goes to results/experiment/
	@$(PYTHON) -m tests.studies.khatri_egan.across results/experiment

along: setup  ## predict measured crushes along the cells; goes to results/experiment/ (half an hour)
	@OMP_NUM_THREADS=1 $(PYTHON) -m tests.studies.khatri_egan.along results/experiment

figures: setup  ## draw the figures of the course report beside ours, with captions, into results/figures/
	@$(PYTHON) -m tests.studies.course_report results/figures

clean:  ## remove the environment and all caches, but no results
	rm -rf .venv build *.egg-info .pytest_cache .mypy_cache .ruff_cache
	find kernels sweep tests -type d -name __pycache__ -prune -exec rm -rf {} +

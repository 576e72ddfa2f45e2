"""Shared by all tests."""

import os
from importlib import import_module
from pathlib import Path

import pytest

KERNELS = {
    "kernels/plates": "plates",
    "kernels/geometry/space": "plates",
    "studies/surfaces": "plates",
    "kernels/compile": None,
    "kernels": "marches",
}
"""Folders, the first that fits, and the runs of whose kernels their tests compile parts.

One process has all tests of these kernels, and compiles the runs first: each part is compiled once.
"""
SLOW = {
    "kernels/compile/test_choice.py",
    "physics/test_folds.py",
    "project/test_notebook.py",
    "project/test_wheel.py",
    "studies/bench/test_bench_starts.py",
    "studies/continuum/test_continuum.py",
    "studies/rankings/test_search.py",
    "studies/scale/test_scale.py",
    "studies/validation/test_elements.py",
    "sweep/report/page/test_selection.py",
    "sweep/running/searching/test_search.py",
    "sweep/running/test_dask_graph.py",
    "sweep/running/test_renew.py",
    "sweep/running/test_slurm.py",
}
"""Files that `make test` leaves to `make slow`."""

# Pictures are drawn into files: no test needs a screen, whatever the user's settings say.
os.environ["MPLBACKEND"] = "Agg"

# Matrices are small: threads of BLAS would only wait for each other. It reads this when it loads.
os.environ["OMP_NUM_THREADS"] = "1"

CONFIG = """
name = "trial"
[grid]
"lattice.imperfection" = {values}
[rank]
budgets = ["5 g", "20 g"]
"""


@pytest.fixture
def config(tmp_path, monkeypatch):
    """A sweep of three cases, one of which fails, on tests/support/results/standin.py."""
    from tests.support.results.standin import simulate

    monkeypatch.setattr(import_module("sweep.simulation.retries"), "simulate", simulate)
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "trial.toml"
    path.write_text(CONFIG.format(values=[0.006, 0.007, 0.008]))
    return str(path)


def runs_of(path):
    """The runs whose kernels the tests of a file compile parts of, a key of `SMALLEST`, or None."""
    return next((runs for folder, runs in KERNELS.items() if path.startswith(f"{folder}/")), None)


@pytest.hookimpl(tryfirst=True)  # before pytest-xdist reads the groups
def pytest_collection_modifyitems(items):
    """Assign tests to groups that one process runs together, by default one group per file; mark
    the tests of the files in `SLOW`.
    """
    for item in items:
        path = item.path.relative_to(Path(__file__).parent).as_posix()
        item.add_marker(pytest.mark.xdist_group(runs_of(path) or path))
        if path in SLOW:
            item.add_marker(pytest.mark.slow)


@pytest.fixture(scope="module", autouse=True)
def kernels_of_runs(request):
    """If several processes run the tests, compile the kernels that the tests of a file need."""
    path = request.path.relative_to(Path(__file__).parent).as_posix()
    if (runs := runs_of(path)) and "PYTEST_XDIST_WORKER" in os.environ:
        from sweep.running.warming import load

        load([runs, "arcs"] if runs == "marches" else [runs])

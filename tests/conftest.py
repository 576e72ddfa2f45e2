"""Shared by all tests."""

import os
from importlib import import_module
from pathlib import Path

import pytest

SLOW = {
    "kernels/compile/test_choice.py",
    "physics/test_folds.py",
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
    """A sweep of three cases, of which one fails, on tests/support/results/standin.py."""
    from tests.support.results.standin import simulate

    monkeypatch.setattr(import_module("sweep.simulation.retries"), "simulate", simulate)
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "trial.toml"
    path.write_text(CONFIG.format(values=[0.006, 0.007, 0.008]))
    return str(path)


def pytest_collection_modifyitems(items):
    """Mark the tests of the files in `SLOW`."""
    for item in items:
        if item.path.relative_to(Path(__file__).parent).as_posix() in SLOW:
            item.add_marker(pytest.mark.slow)

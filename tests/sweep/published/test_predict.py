"""Predictions: ranges over cases, ratios over a key; and stored predictions."""

from dataclasses import replace

import pandas as pd
import pytest

from sweep.config.load import load_config
from sweep.published.predict import NotConvergedError, cases_of, digest, is_repeated, predicted
from sweep.published.table import OURS, PublishedError, Row, read_table
from sweep.result import MODEL_VERSION
from sweep.running.sweep import run_sweep
from sweep.simulation.simulate import simulate
from sweep.store.read import read_summary

STORED = {row.name: row for row in read_table(OURS)}
QUICK = [
    *("square one row", "square four rows", "triangle buckling", "kagome buckling"),
    *("hexagon buckling", "kagome stiffness", "hexagon limit", "haid rate"),
]
CONFIG = """
[loading]
strain = 0.1

[grid]
"contact.friction" = [0.1, 0.2]
"lattice.cells" = [1, 2]
"""


@pytest.fixture
def row(tmp_path):
    """A row whose config has two axes of two values."""
    (tmp_path / "mine.toml").write_text(CONFIG)
    return Row("mine", "me", "energy, J", "friction", "mine.toml")


def results(cases, values, status="converged"):
    """A summary of cases with these energies (J)."""
    ids = [case.case_id for case in cases]
    about = {"status": status, "message": "smaller steps", "mass_g": 2.0}
    return pd.DataFrame({"case_id": ids, "absorbed_energy_J": values} | about)


def predicted_of(row, table):
    """The prediction of a row whose cases all absorb 1 J."""
    cases = cases_of(row, table)
    return predicted(row, cases, results(cases, 1.0))


@pytest.mark.parametrize(
    ("changes", "low", "high"),
    [
        ({}, "1", "8"),
        ({"per": "0.001"}, "1000", "8000"),
        ({"where": "lattice.cells=2"}, "3", "8"),
        ({"over": "contact.friction"}, "2", "2.667"),
        ({"measure": "absorbed_energy_J / mass_g"}, "0.5", "4"),
        ({"measure": "mass_g; absorbed_energy_J", "where": "lattice.cells=2"}, "2", "8"),
    ],
)
def test_range_of_a_measure(row, tmp_path, changes, low, high):
    """Energies 1, 3, 2, 8: friction varies slowest."""
    every = cases_of(row, tmp_path / "t.csv")
    summary = results(every, [1.0, 3.0, 2.0, 8.0])
    changed = replace(row, **changes)
    cases = cases_of(changed, tmp_path / "t.csv")
    found = predicted(changed, cases, summary)
    assert (found.low, found.high) == (low, high)
    assert (found.cases, found.model) == (str(len(cases)), str(MODEL_VERSION))
    assert (found.ids == digest(every)) == (len(cases) == 4)


def test_a_case_that_has_not_converged_has_no_prediction(row, tmp_path):
    cases = cases_of(row, tmp_path / "t.csv")
    with pytest.raises(NotConvergedError, match=f"{cases[0].case_id}: smaller steps") as failure:
        predicted(row, cases, results(cases, 1.0, "stopped"))
    assert failure.value.exit_status == 1


@pytest.mark.parametrize(
    ("changes", "wrong"),
    [
        ({"where": "lattice.cells=3"}, "allowed: contact.friction=0.1, contact.friction=0.2, "),
        ({"over": "lattice.width"}, "over = lattice.width is no axis; allowed: contact.friction, "),
        ({"measure": "absorbed_energi_J"}, "the nearest (is|are) absorbed_energy_J"),
        ({"measure": "message"}, "measure = message; allowed: a column"),
    ],
)
def test_what_a_config_does_not_have_is_refused(row, tmp_path, changes, wrong):
    changed = replace(row, **changes)
    with pytest.raises(PublishedError, match=wrong):
        predicted_of(changed, tmp_path / "t.csv")


@pytest.mark.parametrize(("high", "alike"), [("8.05", True), ("8.2", False), ("", False)])
def test_predictions_within_a_percent_are_alike(row, high, alike):
    old = replace(row, low="1", high="8")
    assert is_repeated(old, replace(old, low=high and "1", high=high)) == alike


@pytest.mark.parametrize("name", STORED)
def test_stored_predictions_are_of_the_cases_of_today(name):
    cases = cases_of(STORED[name], OURS)
    assert STORED[name].ids == digest(cases)
    assert STORED[name].cases == str(len(cases))


@pytest.mark.parametrize("name", QUICK)
def test_stored_predictions_come_out_again(name, tmp_path):
    row, out = STORED[name], tmp_path / "again.h5"
    cases = cases_of(row, OURS)
    assert run_sweep(cases, out) == 0
    assert is_repeated(row, predicted(row, cases, read_summary(out)))


@pytest.mark.parametrize(
    ("name", "column", "value"),
    [
        ("ding_reentrant", "plateau_stress_Pa", 76374.0),
        ("tpu_cycles", "second_cycle_share", 0.8263),
    ],
)
def test_slow_configs_hold_a_number(name, column, value):
    """The number belongs to their first case, pressed half as far in half as many steps."""
    case = load_config(f"published/{name}").cases[0]
    half = {"loading": {"strain": 0.5 * case.loading.strain}, "solver": {"load_steps": 200}}
    summary = simulate(case.changed(**half)).summary
    assert summary["status"] == "converged"
    assert summary[column] == pytest.approx(value, rel=2e-3)

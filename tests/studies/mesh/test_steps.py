"""The study of load steps: its cases, and a small piece of it."""

import numpy as np
import pandas as pd
import pytest

from sweep.simulation.simulate import simulate
from tests.studies.mesh import steps
from tests.studies.mesh.crushes import DESIGNS


def test_every_design_in_every_setting():
    cases = steps.cases_of()
    ids = {case.case_id for case in cases.values()}
    assert len(ids) == len(cases) == 2 * 48 * (len(steps.SETTINGS) + 2)
    solvers = {name: case.solver for (_, _, name), case in cases.items()}
    assert (solvers["1.0%"].accuracy, solvers["1.0%"].load_steps) == (0.01, 400)
    assert (solvers["25"].accuracy, solvers["25"].load_steps) == (None, 25)


def test_errors_beside_the_finest(monkeypatch):
    monkeypatch.setitem(steps.EQUAL, 0.0, ("80", "160"))
    few = {name: steps.SETTINGS[name] for name in ("0.3%", "25")}
    cases = steps.cases_of(DESIGNS[:1], few, (0.0,))
    results = {case.case_id: simulate(case) for case in cases.values()}
    rows = pd.DataFrame({key: result.summary for key, result in results.items()}).T
    curves = {k: (r.history["strain"], r.history["work_in_J"]) for k, r in results.items()}
    errors = steps.compare(cases, rows.infer_objects(), curves, 0.0)
    energy = {name: error["absorbed_energy_J"][0] for name, error in errors.items()}
    assert energy["160"] == 0.0 < energy["0.3%"] < 3e-3
    assert energy["80"] < energy["25"]
    shown = steps.sheet(errors, 0.0)
    assert shown.heads == ["steps", "0.3%", "25"]
    failed = rows.assign(
        status=np.where(
            rows.index == cases[0.0, DESIGNS[0], "25"].case_id, "stopped", rows["status"]
        )
    )
    again = steps.compare(cases, failed.infer_objects(), curves, 0.0)
    assert np.isnan(again["25"]["absorbed_energy_J"][0])
    assert again["0.3%"]["absorbed_energy_J"][0] == pytest.approx(energy["0.3%"])


def history(buckled, touched, each):
    """A crush to 30 % in 100 steps, with so many iterations for ``each`` strain."""
    strain = np.arange(0.0, 0.3001, 3e-3)
    return pd.DataFrame(
        {
            "strain": strain,
            "reaction_top_N": np.where(strain < buckled - 1e-9, 1e3 * strain, 1e-9),
            "work_in_J": 1.0,
            "contact_J": np.where(strain < touched - 1e-9, 0.0, 0.1),
            "newton_iterations": np.where(strain > 0.0, each(strain - 1e-9), 0.0),
        }
    )


def test_iterations_belong_to_their_phase():
    """One to four of them a step of 0.3 %; phases that do not begin, or too late, have none."""
    crush = history(0.03, 0.09, lambda e: 1.0 + np.searchsorted([0.03, 0.09, 0.15], e))
    begins = steps.begun(crush, 0.15)
    np.testing.assert_allclose(begins, [0.0, 0.03, 0.09, 0.15])
    np.testing.assert_allclose(steps.by_phase(crush, begins), [1.0, 2.0, 3.0, 4.0])
    nan = np.nan
    for buckled, densified, expected in (
        (0.03, nan, [1.0, 2.0, 3.0 + 5 / 7, nan]),
        (9.0, 0.15, [5 / 3, nan, 3.0, 4.0]),
        (0.12, 0.15, [5 / 3, nan, 3.0, 4.0]),
    ):
        begins = steps.begun(
            crush.assign(reaction_top_N=history(buckled, 0.09, np.ones_like)["reaction_top_N"]),
            densified,
        )
        np.testing.assert_allclose(steps.by_phase(crush, begins), expected)
    table = steps.phase_sheet({"25": [[1.0, 2.0, 3.0, nan], [3.0, 4.0, 5.0, 6.0]]})
    assert [row[1:] for row in table.rows] == [["2", "2"], ["2", "3"], ["2", "4"], ["1", "6"]]

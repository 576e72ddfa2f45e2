"""The study of how much columns move: its designs, its arithmetic, and a small piece of it."""

import numpy as np
import pandas as pd
import pytest

from sweep.simulation.simulate import simulate
from tests.studies.rankings.spread import DESIGNS, SETTINGS, crush, families, sheet, spreads

FEW = {"elements": (2, 3), "steps": (20, 40)}
USUAL = {"elements": 2, "imperfection": 0.01, "steps": 40}
SOUGHT = ("absorbed_energy_J", "absorbed_energy_until_packed_J", "packing_strain")


def test_twenty_four_designs_with_one_setting_varied_at_a_time():
    cases = families()
    assert len(DESIGNS) == 24
    assert len(cases) == 24 * 3
    assert [len(cases[DESIGNS[0], name]) for name in SETTINGS] == [6, 5, 6]
    assert len({case.case_id for alike in cases.values() for case in alike}) == 24 * (6 + 4 + 5)


def test_the_spread_is_the_range_of_the_converged_over_their_median():
    alike = [crush(DESIGNS[0], 2, 0.01, steps) for steps in (10, 20, 40, 80)]
    rows = pd.DataFrame(
        {
            "status": ["converged"] * 3 + ["stopped"],
            "absorbed_energy_J": [1.0, 1.1, 1.2, 9.0],
            "densification_strain": [0.3, np.nan, 0.4, 0.1],
            "efficiency": [0.3, np.nan, 0.4, 0.1],
            "peak_strain": 0.6,
        },
        index=[case.case_id for case in alike],
    )
    (row,) = spreads({(DESIGNS[0], "steps"): alike}, rows).to_dict("records")
    assert row["absorbed_energy_J"] == pytest.approx(0.2 / 1.1)
    assert row["densification_strain"] == pytest.approx(0.3 / 0.4)  # not packed: 60 %
    assert np.isnan(row["efficiency"])
    assert row["failed"] == 1
    table = sheet(pd.DataFrame([row]))
    assert table.rows[0] == ["absorbed_energy_J", "18", "18", "18"]
    assert table.notes == ("1 cases did not converge and are left out.",)


def test_a_piece_of_the_study():
    """Energies move by a tenth or so between two and three elements, hardly with the steps."""
    cases = families(DESIGNS[:1], FEW, USUAL)
    every = {case.case_id: case for alike in cases.values() for case in alike}
    rows = pd.DataFrame({case_id: simulate(case).summary for case_id, case in every.items()}).T
    found = spreads(cases, rows.infer_objects()).set_index("setting")
    assert (found["failed"] == 0).all()
    assert found.loc["elements", list(SOUGHT)].between(1e-4, 0.5).all()
    assert found.loc["steps", list(SOUGHT)].lt(0.1).all()

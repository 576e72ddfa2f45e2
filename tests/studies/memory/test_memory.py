"""The study of the effects of a memory: its cases, its arithmetic, and rows of the README."""

import numpy as np
import pandas as pd
import pytest

from sweep.config.case import Case
from sweep.simulation.simulate import simulate
from tests.studies.memory import costs, cycles, orders
from tests.studies.memory.__main__ import CONFIGS
from tests.studies.memory.variants import PARTS, changed
from tests.support import readme

PRESSED = Case.of(loading=dict(mode="displacement", strain=0.2))


def test_parts_change_the_material_alone():
    for part in PARTS.values():
        case = changed(PRESSED, part)
        assert (case.lattice, case.contact) == (PRESSED.lattice, PRESSED.contact)
        assert {key: getattr(case.material, key) for key in part} == part
    assert changed(PRESSED, {}).case_id == PRESSED.case_id
    struck = changed(Case.of(loading=dict(mode="impact")), {"loss": 0.2})
    assert struck.damping.model == "none"


def test_all_cases_are_there():
    assert len({case.case_id for case in cycles.cycles().values()}) == 5 * 4 * 3 * 2
    assert len({case.case_id for case in cycles.rated().values()}) == 2 * len(cycles.RATES)
    found = orders.variants(CONFIGS, {"loss 20 %": {"loss": 0.2}})
    assert {name for name, _ in found} == {"armor", "infills", "impact"}
    assert len(found["armor", "loss 20 %"]) == len(found["armor", "elastic"]) == 140


def row(case):
    return pd.Series(simulate(case).summary)


def test_rates_are_those_of_the_readme():
    told = {cells[0]: cells[1:] for cells in readme.table("rate, 1/s")}
    cases = cycles.rated()
    for rate in (1e-2, 100.0):
        found = row(cases[rate, False])
        energy, _, lost, *_ = told[f"{rate:g}"]
        assert 1e3 * found["absorbed_energy_J"] == pytest.approx(float(energy), rel=2e-3)
        share = 1.0 - found["returned_energy_J"] / found["absorbed_energy_J"]
        assert 100.0 * share == pytest.approx(float(lost), abs=0.6)


def test_losses_are_those_of_the_readme():
    """One row: the hexagon, glued."""
    told = next(cells for cells in readme.table("pattern, friction 0.3") if cells[0] == "hex")
    shares = []
    for loss in cycles.LOSSES[::2]:
        found = row(cycles.cycle("hex", "glued", 0.3, loss))
        shares.append(100.0 * (1.0 - found["returned_energy_J"] / found["absorbed_energy_J"]))
    np.testing.assert_allclose([float(cell) for cell in told[1:4:2]], shares, atol=0.6)


def test_costs_are_told_for_each_part(monkeypatch):
    monkeypatch.setattr(costs, "REPEATS", 2)
    monkeypatch.setattr(costs, "USUAL", 40)
    sheet = costs.costs({"loss 40 %": {"loss": 0.4}}, steps=(20, 40), finest=80)
    assert [cells[0] for cells in sheet.rows] == ["elastic", "loss 40 %"]
    assert sheet.rows[0][-1] == "1.00"
    assert float(sheet.rows[1][-1]) > 0.0

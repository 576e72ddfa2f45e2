"""Energy absorbed and lost, and force transmitted, in each cycle of a crush."""

import numpy as np
import pytest

from sweep.columns import cycle_columns
from sweep.config.case import Case
from sweep.scene.loading import CycleRows
from sweep.simulation.cycles import columns_of_cycles
from tests.support.converged import converged

WORK = np.array([0.0, 1.0, 4.0, 3.0, 2.0, 2.5, 4.0, 3.5, 3.0])
FORCE = np.array([0.0, 5.0, 9.0, 3.0, 1.0, 4.0, 8.0, 2.0, 0.0])
TWICE = [CycleRows(0, 2, 2, 4), CycleRows(4, 6, 6, 8)]


def twice(steps=2, **others):
    """A case of two cycles."""
    loading = dict(mode="displacement", strain=0.3, cycles=2)
    return Case.of(loading=loading, solver=dict(load_steps=steps), **others)


def test_each_cycle_begins_where_the_last_one_ends():
    found = columns_of_cycles(TWICE, WORK, FORCE)
    assert [found[name] for name in cycle_columns(1)] == [4.0, 2.0, 9.0]
    assert [found[name] for name in cycle_columns(2)] == [2.0, 1.0, 8.0]
    assert found["second_cycle_share"] == 0.5


def test_a_single_cycle_has_no_columns_but_the_share():
    found = columns_of_cycles(TWICE[:1], WORK, FORCE)
    assert list(found) == ["second_cycle_share"]
    assert np.isnan(found["second_cycle_share"])


@pytest.mark.parametrize(("rows", "known"), [(4, 1), (6, 3), (8, 4)])
def test_what_a_run_that_stops_has_not_done_is_unknown(rows, known):
    """It ends while unloading, while loading again, or while unloading again."""
    found = columns_of_cycles(TWICE, WORK[:rows], FORCE[:rows])
    values = [found[name] for number in (1, 2) for name in cycle_columns(number)]
    assert np.isfinite(values).sum() == known
    assert np.isfinite(found["second_cycle_share"]) == (rows == 8)


def crushed(**material):
    """The summary of a small lattice that is pressed twice, and its history."""
    given = {"modulus": 12e6, "density": 1190.0, "plane": "stress"} | material
    lattice = dict(cells_x=1, cells_y=1, nodes_per_wall=0)
    result = converged(twice(10, lattice=lattice, material=given, contact=dict(model="none")))
    return result.summary, result.history


def test_springs_absorb_the_same_again():
    summary, history = crushed()
    assert len(history["time_s"]) == 41
    assert summary["second_cycle_share"] == pytest.approx(1.0, rel=1e-6)
    assert summary["lost_energy_J"] == pytest.approx(0.0, abs=1e-6 * summary["absorbed_energy_J"])
    assert summary["material_memory"] == "none"


def test_walls_that_relax_lose_energy_and_absorb_less_the_second_time():
    summary, history = crushed(loss=0.4)
    lost = sum(summary[cycle_columns(number)[1]] for number in (1, 2))
    assert lost == pytest.approx(history["work_in_J"][-1], rel=1e-12)
    assert summary["lost_energy_J"] == summary["lost_energy_in_cycle_1_J"]
    assert summary["lost_share"] == pytest.approx(
        summary["lost_energy_J"] / summary["absorbed_energy_J"]
    )
    assert 0.3 < summary["lost_share"] < 0.6
    assert 0.5 < summary["second_cycle_share"] < 0.95
    assert summary["material_memory"] == "relaxes"
    kept = sum(history[name][-1] for name in ("stretch_J", "bend_J"))
    assert kept > 0.0
    dissipated = summary["dissipated_material_J"] + summary["dissipated_integrator_J"]
    assert lost == pytest.approx(kept + dissipated, rel=1e-6)

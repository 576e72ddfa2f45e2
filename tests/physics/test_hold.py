"""A pause at full stroke: the force falls as the material relaxes, and energies are of the ways."""

import numpy as np
import pandas
import pytest

from sweep.columns import cycle_columns
from sweep.config.case import Case
from sweep.report.figures.storyboard import crushes
from sweep.scene.lattice import build_scene
from sweep.scene.loading import cycle_rows, stages
from tests.physics.test_memories import mean_modulus, slender
from tests.support.designs.scenes import is_sound, run, trapezoid

SLOW = {"mode": "displacement", "strain": 0.3, "strain_rate": 0.1}
FAST = {"mode": "displacement", "strain": 0.3, "speed": 0.5}
ALONG = SLOW | {"strain": 0.02, "direction": "out_of_plane"}
HELD = {
    "relaxing": (SLOW | {"hold_time": 30.0}, {"load_steps": 40}),
    "twice": (SLOW | {"hold_time": 30.0, "cycles": 2}, {"load_steps": 40}),
    "moving": (FAST | {"hold_time": 2e-3}, {"load_steps": 100}),
    "along": (ALONG | {"hold_time": 30.0}, {"load_steps": 10}),
}


def held(kind, **others):
    """A cell that is pressed, rests, and is let up."""
    loading, solver = HELD[kind]
    along = {"nodes_per_wall": 1, "layers": 2} if kind == "along" else {}
    return Case.of(
        lattice=dict(cells_x=1, cells_y=1, **along),
        material={} if kind == "moving" else dict(loss=0.4),
        loading=loading | others,
        solver=solver,
    )


@pytest.mark.parametrize("kind", HELD)
def test_energies_are_those_of_the_way_down_and_of_the_way_back(kind):
    """Work is force times travel, and the pause does none."""
    result = run(held(kind))
    history, summary = result.history, result.summary
    assert is_sound(result)
    turned, released, ended = crushes(pandas.DataFrame(history))[0]
    time, work = history["time_s"], history["work_in_J"]
    assert time[released] - time[turned] == pytest.approx(held(kind).loading.hold_time)
    down, pause, back = (
        trapezoid({name: column[first : last + 1] for name, column in history.items()})
        for first, last in ((0, turned), (turned, released), (released, ended))
    )
    assert summary["absorbed_energy_J"] == work[turned]
    assert summary["returned_energy_J"] == work[released] - work[ended]
    assert down == pytest.approx(work[turned], rel=1e-2)
    assert back == pytest.approx(work[ended] - work[released], rel=5e-2)
    assert pause == pytest.approx(0.0, abs=1e-9 * work[turned])
    assert summary["returned_energy_J"] < summary["absorbed_energy_J"]


def test_pictures_find_the_rows_that_the_stages_have():
    for kind in ("relaxing", "twice", "moving"):
        planned = cycle_rows(stages(held(kind), build_scene(held(kind))))
        found = crushes(pandas.DataFrame(run(held(kind)).history))
        assert found == [tuple(rows[1:]) for rows in planned]


def test_a_pause_changes_nothing_of_the_way_down_and_costs_what_relaxes():
    one, other = run(held("relaxing", hold_time=None)), run(held("relaxing"))
    for name, column in one.history.items():
        np.testing.assert_array_equal(other.history[name][:41], column[:41])
    assert other.summary["absorbed_energy_J"] == one.summary["absorbed_energy_J"]
    assert other.summary["returned_energy_J"] < 0.9 * one.summary["returned_energy_J"]
    assert other.summary["peak_force_N"] == one.summary["peak_force_N"]


def test_every_cycle_has_its_pause():
    summary, once = run(held("twice")).summary, run(held("relaxing")).summary
    work = run(held("twice")).history["work_in_J"]
    assert len(work) == 241
    first, second = (cycle_columns(number)[0] for number in (1, 2))
    assert summary[first] == summary["absorbed_energy_J"] == once["absorbed_energy_J"]
    assert summary[second] == work[160] - work[120]
    assert summary["returned_energy_J"] == once["returned_energy_J"] == work[80] - work[120]


@pytest.mark.parametrize("unload", [True, False])
def test_the_force_falls_as_the_relaxation_modulus(unload):
    """Pressed in 10 ms, held for a minute; linear all over."""
    pressed = slender(0.01)
    loading = pressed.loading.model_copy(update={"hold_time": 60.0, "unload": unload})
    solver = dict(load_steps=30, joints="points")
    case = Case.of(**dict(pressed) | {"loading": loading, "solver": solver})
    history = run(case).history
    assert len(history["time_s"]) == 31 + 30 + 30 * unload
    rows = slice(30, 61)
    force, time = history["reaction_top_N"][rows], history["time_s"][rows] - 0.01
    moduli = [mean_modulus(case.material, start, start + 0.01) for start in np.maximum(time, 0.0)]
    np.testing.assert_allclose(force / moduli, force[0] / moduli[0], rtol=2e-3)
    assert force[-1] < 0.7 * force[0]
    assert np.isnan(run(case).summary["returned_energy_J"]) == (not unload)

"""Lattices of a material that relaxes: the energy book, holds, rates."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.scene.relaxation import relaxation_of
from sweep.simulation.simulate import simulate
from tests.support.designs.scenes import is_sound, run
from tests.support.designs.structures import APART
from tests.support.designs.tables import material_with

LOSS = 0.4
CRUSH = {"mode": "displacement", "strain": 0.3}
RATES = (1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0)


def crushed(bend, loss):
    """3 x 3 cells with solid joints, in contact."""
    result = run(
        Case.of(material=dict(bend=bend, loss=loss), loading=CRUSH, solver=dict(load_steps=60))
    )
    assert is_sound(result)
    return result


@pytest.mark.parametrize("bend", ["section", "linear"])
def test_what_is_absorbed_is_lost_returned_or_left_in_the_branches(bend):
    """No step returns lost energy."""
    result = crushed(bend, LOSS)
    history, summary = result.history, result.summary
    assert np.diff(history["dissipated_material_J"], prepend=0.0).min() >= 0.0
    left = sum(history[f"{part}_J"][-1] for part in ("stretch", "bend", "contact"))
    lost, absorbed = summary["dissipated_energy_J"], summary["absorbed_energy_J"]
    assert lost + summary["returned_energy_J"] + left == pytest.approx(absorbed, rel=1e-6)
    assert left > 0.01 * absorbed
    elastic = crushed(bend, None).summary
    assert elastic["returned_energy_J"] == pytest.approx(elastic["absorbed_energy_J"], rel=1e-4)


def slender(rate, loss=0.3, strain=1e-4):
    """A cell of slender walls pressed a little at a rate (1/s), linear all over."""
    material = material_with(modulus=20e6, density=1190.0, loss=loss, plane="stress")
    return Case.of(
        lattice=dict(cells_x=1, cells_y=1, wall_thickness=4e-4, imperfection=0.0),
        material=material,
        loading=dict(mode="displacement", strain=strain, strain_rate=rate, unload=False),
        contact=APART,
        solver=dict(load_steps=4, joints="points"),
    )


def mean_modulus(material, start, end):
    """Mean of the modulus from one time to another over the modulus at 1 s: it determines the
    stress at ``end`` after an even ramp of strain that began then and stopped at ``end - start``.
    """
    shares, times, instant = relaxation_of(material)
    left = times * (np.exp(-start / times) - np.exp(-end / times)) / (end - start)
    return instant * (1.0 + shares @ (left - 1.0))


def test_a_lattice_stiffens_with_the_rate_as_its_material():
    forces = []
    for rate in RATES:
        pressed = slender(rate)
        result = run(pressed)
        assert is_sound(result)
        forces.append(
            result.history["reaction_top_N"][-1] / mean_modulus(pressed.material, 0.0, 1e-4 / rate)
        )
    np.testing.assert_allclose(forces, forces[0], rtol=2e-3)
    assert forces[0] > 0.0


@pytest.mark.parametrize("nodes", [2, 3])
def test_stars_that_snap_are_unloaded_to_the_end(nodes):
    """A robot's foot, 24 x 15 mm: 26 J a panel of twelve, which lead its ranking."""
    feet = dict(kind="kagome", width=24e-3, height=15e-3, depth=15e-3, cells_x=4)
    lattice = feet | {"wall_thickness": 0.8e-3, "nodes_per_wall": nodes}
    result = simulate(
        Case.of(
            lattice=lattice,
            material={"name": "cheetah", "loss": LOSS},
            loading={"mode": "displacement", "strain": 0.6, "platen": "contact"},
        )
    )
    assert (result.status, result.message) == ("converged", "")
    assert result.summary["absorbed_energy_until_packed_J"] == pytest.approx(2.15, rel=0.01)
    work = result.history["work_in_J"].max()
    assert result.summary["returned_energy_J"] == pytest.approx(0.5 * work, rel=0.05)

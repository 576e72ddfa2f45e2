"""Crushing with contact: against solid finite elements, and laws that any crush must obey."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.simulation.simulate import simulate
from tests.studies.verify import FRAME, SOLID
from tests.support.designs.scenes import TIGHT, at, is_sound, pressed, run

SCENES = [(platen, friction) for platen in ("glued", "contact") for friction in (0.0, 0.3)]
STEPS = (100, 200, 800)


def there_and_back(platen, friction, steps=200):
    return run(pressed(3, 0.6, steps, platen, friction, unload=True))


def forces(platen, friction, elements, unload):
    """Force at 50 rows that 100, 200 and 800 load steps have in common, (3, rows) N."""
    cases = [pressed(elements, 0.6, n, platen, friction, unload=unload) for n in STEPS]
    histories = [run(case).history for case in cases]
    return np.array(
        [past["reaction_top_N"][:: n // 50] for past, n in zip(histories, STEPS, strict=True)]
    )


@pytest.mark.parametrize(("strain", "energy"), SOLID.items())
@pytest.mark.parametrize("elements", [6, 12])
def test_absorbed_energy_against_solid_elements(elements, strain, energy):
    result = run(pressed(elements, 0.6, 120))
    assert is_sound(result)
    assert result.summary["touched"] == 1
    absorbed = 1e3 * at(result, strain, "work_in_J")
    assert absorbed == pytest.approx(energy, rel=0.07 if strain <= 0.4 else 0.10)


@pytest.mark.parametrize(("platen", "unload"), [("glued", True), ("contact", False)])
def test_number_of_load_steps_changes_nothing(platen, unload):
    """On loose platens the way back passes through snaps, whose moment the steps decide."""
    force = forces(platen, 0.0, 6, unload)
    assert np.ptp(force, axis=0).max() < 1e-5 * force.max()


@pytest.mark.parametrize("platen", ["glued", "contact"])
def test_number_of_load_steps_hardly_matters_with_friction(platen):
    force = forces(platen, 0.3, 3, unload=True)
    assert np.ptp(force, axis=0).max() < 0.015 * force.max()


@pytest.mark.parametrize(("platen", "friction"), SCENES)
def test_every_crush_is_sound(platen, friction):
    result = there_and_back(platen, friction)
    assert is_sound(result)
    assert result.summary["min_gap_m"] > 0.0
    off = np.abs(result.history["reaction_top_N"] - result.history["reaction_bottom_N"])
    assert off.max() < 1e-6 * result.history["reaction_top_N"].max()


def test_unloading_returns_all_energy_without_friction():
    """Glued walls do not snap, so that unloading follows the loading curve. (With three elements
    per wall, one snaps at 58 %.)
    """
    result = run(pressed(6, 0.6, 200, unload=True, solver=TIGHT))
    summary, force = result.summary, result.history["reaction_top_N"]
    assert summary["returned_energy_J"] == pytest.approx(summary["absorbed_energy_J"], rel=1e-6)
    assert summary["residual_strain"] == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_allclose(force, force[::-1], atol=1e-6 * force.max())


@pytest.mark.parametrize("platen", ["glued", "contact"])
def test_friction_never_gives_energy_back(platen):
    """Backward Euler books the work of the forces at the end of a step, none of which drives the
    motion.
    """
    case = pressed(6, 0.6, 200, platen, 1.0, unload=True, speed=1.0)
    result = simulate(case)
    rubbed = result.history["dissipated_friction_J"]
    assert result.summary["touched"] == 1
    assert rubbed[-1] > 0.01 * result.summary["absorbed_energy_J"]
    assert np.diff(rubbed).min() >= -1e-12 * rubbed[-1]


def test_loose_platens_without_friction():
    """Free to spread, the grid bears less than a glued one; it stays between the platens."""
    loose = [run(pressed(elements, 0.6, 60, "contact")) for elements in (6, 12)]
    assert all(map(is_sound, loose))
    coarse, fine = (at(result, 0.05) for result in loose)
    assert coarse == pytest.approx(fine, rel=0.01)
    assert 0.5 * FRAME[0.05] < fine < 0.8 * FRAME[0.05]
    low, high = loose[1].frames["plate_y_m"].T[:, :, None]
    y = loose[1].frames["position_m"][:, :, 1]
    assert np.all((low < y) & (y < high))


@pytest.mark.parametrize(("platen", "contact"), [("glued", "none"), ("contact", "barrier")])
def test_perfect_grid_buckles(platen, contact):
    """Nothing but a negative pivot tells a perfect grid to leave the straight branch."""
    perfect, flawed = (
        run(pressed(6, 0.3, 30, platen, contact=contact, imperfection=size)) for size in (0.0, 0.01)
    )
    assert perfect.status == "converged"
    straight = at(perfect, 0.01) * 5
    assert at(perfect, 0.05) < 0.6 * straight
    for strain in (0.05, 0.1, 0.3):
        assert at(perfect, strain) == pytest.approx(at(flawed, strain), rel=0.01)


def test_steps_too_few_to_balance_are_taken_in_shares():
    """In 4 steps the trapezoidal rule alone would make a tenth of the work; without friction, whose
    normal forces so long a step cannot foresee.
    """
    tables = dict(
        lattice=dict(nodes_per_wall=2),
        loading=dict(mode="displacement", strain=0.6, platen="contact"),
        contact=dict(friction=0.0),
    )
    few, more = (simulate(Case.of(**tables, solver=dict(load_steps=n))) for n in (4, 200))
    assert (few.status, more.status) == ("converged", "converged")
    assert few.summary["steps"] > 8  # there and back
    energies = [result.summary["absorbed_energy_J"] for result in (few, more)]
    assert energies[0] == pytest.approx(energies[1], rel=0.05)


def crushed(bend, **material):
    material |= {"bend": bend}
    return run(Case.of(material=material, loading=dict(strain=0.6), solver=dict(load_steps=200)))


def test_a_crush_with_sections_bent_by_the_curve():
    """Stiffer while strains are small, less so once walls have folded: ninjaflex softens."""
    linear, by_curve = crushed("linear"), crushed("section")
    for result in (linear, by_curve):
        assert is_sound(result)
    early, late = (at(by_curve, strain) / at(linear, strain) for strain in (0.051, 0.501))
    assert early == pytest.approx(1.076, abs=0.005)
    assert late == pytest.approx(1.055, abs=0.005)
    stretched = crushed("section", stretch="linear")
    assert is_sound(stretched)
    assert stretched.summary["absorbed_energy_J"] != by_curve.summary["absorbed_energy_J"]

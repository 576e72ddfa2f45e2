"""Walls that yield: a cantilever, breaks of closed form, and what remains of a crushed lattice.

Closed form of the cantilever: W. Prager and P. G. Hodge, Theory of Perfectly Plastic Solids, 1951.
"""

import numpy as np
import pytest

from sweep.config.case import Case
from tests.support.converged import converged
from tests.support.designs.structures import CLAMPED, DEPTH, LENGTH, MM, ROD, THICKNESS, case_of
from tests.support.designs.tables import material_with

MODULUS, LIMIT = 2e9, 2e5  # a limit so low that deflections stay small
YIELD_FORCE = LIMIT * DEPTH * THICKNESS**2 / (6.0 * LENGTH) * MM**2  # at the tip, N
YIELD_TIP = 2.0 / 3.0 * LIMIT / MODULUS * LENGTH**2 / THICKNESS  # mm
ROOT = [{"node": 0, "fix": CLAMPED}]


def plastic(limit=LIMIT, hardening=0.0, **keys):
    numbers = {"modulus": MODULUS, "density": 1200.0, "poisson": 0.0, "plane": "stress"}
    return material_with(**numbers, yield_stress=limit, hardening=hardening, **keys)


def loaded(material, steps=40, **parts):
    """Result of a rod that is loaded in equal increments."""
    solver = dict(integrator="static", load_steps=steps)
    return converged(case_of(ROD | parts, material, solver=solver))


def tip(elements, fibres, share):
    """Deflection of the tip under a share of the yield force / deflection at the yield force."""
    force = {"node": 1, "force_N": [0.0, -share * YIELD_FORCE]}
    material = plastic(fibres=fibres)
    result = loaded(material, 10, supports=ROOT, loads=[force], subdivide=elements)
    return -result.history["probe_1_y_m"][-1] / (MM * YIELD_TIP)


@pytest.mark.parametrize(("elements", "most"), [(4, 3e-3), (8, 1e-3), (32, 5e-4)])
def test_a_cantilever_bends_beyond_yield(elements, most):
    share = 1.2
    exact = (5.0 - (3.0 + share) * np.sqrt(3.0 - 2.0 * share)) / share**2
    assert tip(elements, 15, share) == pytest.approx(exact, rel=most)
    assert tip(8, 7, 0.5) == pytest.approx(0.5, rel=2e-4)


def test_a_stretched_wall_breaks_at_its_strain():
    """The work until then has a closed form; the rest of the loading is beyond the model."""
    strain, limit, hardening = 0.02, 20e6, 0.1 * MODULUS
    pull = [{"node": 1, "direction": "x", "displacement_mm": 2.0 * strain * LENGTH}]
    material = plastic(limit, hardening, fracture_strain=strain)
    result = loaded(material, supports=ROOT, prescribed=pull, subdivide=4)
    tangent, volume = MODULUS * hardening / (MODULUS + hardening), LENGTH * THICKNESS * DEPTH
    beyond = strain - limit / MODULUS
    density = limit**2 / (2.0 * MODULUS) + beyond * (limit + 0.5 * tangent * beyond)
    work = result.summary["absorbed_energy_within_model_J"]
    assert work == pytest.approx(density * volume * MM**3, rel=1e-3)
    assert work < 0.6 * result.summary["absorbed_energy_J"]
    assert result.message.startswith("a wall broke: the greatest strain of a fibre is 0.04,")


def test_a_bent_wall_breaks_at_the_strain_of_its_surface():
    """Turned at both ends, its curvature is even: broken where kappa t / 2 is the strain."""
    strain = 0.02
    turned = [
        {"node": 0, "direction": "rotation", "angle_rad": -2.0 * strain * LENGTH / THICKNESS},
        {"node": 1, "direction": "rotation", "angle_rad": 2.0 * strain * LENGTH / THICKNESS},
    ]
    held = [{"node": 0, "fix": ["x", "y"]}, {"node": 1, "fix": ["y"]}]
    material = plastic(20e6, 0.5 * MODULUS, fracture_strain=strain, fibres=15)
    result = loaded(material, 80, supports=held, prescribed=turned, subdivide=16)
    history, work = result.history, result.summary["absorbed_energy_within_model_J"]
    assert np.interp(work, history["work_in_J"], history["load_factor"]) == pytest.approx(
        0.5, rel=5e-3
    )


def test_a_crushed_lattice_stays_short_and_says_at_which_strain_it_broke():
    """A loose grid of PLA, crushed and let go."""
    case = Case.of(
        lattice=dict(cells_x=2, cells_y=2, wall_thickness=1e-3),
        material=dict(name="pla"),
        loading=dict(mode="displacement", strain=0.2, platen="contact"),
        contact=dict(friction=0.0),
    )
    crushed = converged(case)
    summary, history = crushed.summary, crushed.history
    assert 0.02 < summary["residual_strain"] < 0.2
    assert 0.0 < summary["returned_energy_J"] < 0.5 * summary["absorbed_energy_J"]
    assert summary["dissipated_energy_J"] > 0.5 * summary["absorbed_energy_J"]
    assert np.abs(history["energy_residual_J"]).max() < 1e-6 * history["work_in_J"].max()
    assert np.all(np.diff(history["dissipated_material_J"]) >= 0.0)
    assert 0.0 < summary["broke_at_strain"] < 0.2
    assert summary["greatest_fibre_strain"] > 0.025
    assert crushed.message.startswith(f"broke at a strain of {summary['broke_at_strain']:.3g}")
    assert summary["absorbed_energy_within_model_J"] < summary["absorbed_energy_J"]


def test_a_glued_platen_pulls_a_crushed_lattice_back():
    """More work than the lattice returns before; none of it is a loss of the crush."""
    case = Case.of(
        lattice=dict(cells_x=2, cells_y=2, wall_thickness=1e-3),
        material=dict(name="pla"),
        loading=dict(mode="displacement", strain=0.2, platen="glued"),
    )
    pulled = converged(case)
    summary, history = pulled.summary, pulled.history
    back = history["strain"][1:] < history["strain"][:-1]
    assert history["reaction_top_N"][1:][back].min() < -0.3 * summary["peak_force_N"]
    assert -summary["absorbed_energy_J"] < summary["returned_energy_J"] < 0.0
    assert summary["lost_energy_J"] == summary["absorbed_energy_J"]
    assert np.abs(history["energy_residual_J"]).max() < 1e-6 * history["work_in_J"].max()

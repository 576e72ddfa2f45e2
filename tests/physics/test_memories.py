"""Lattices of materials with all kinds of memory: books, limits in time and in the step, rates."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.result import Status
from sweep.scene.relaxation import relaxation_of
from sweep.simulation.simulate import simulate
from tests.support.designs.scenes import LOST, STORED, is_sound, run, summed
from tests.support.designs.structures import APART
from tests.support.designs.tables import material_with

BRANCH = {"relaxation_times": (5.0,), "relaxation_shares": (0.6,), "reference_time": 1.0}
SOFT = {"softening_r": 2.0, "softening_m": 2e5}
PLASTIC = {"modulus": 2e9, "density": 1240.0, "poisson": 0.35}
PLASTIC |= {"yield_stress": 50e6, "hardening": 4e7}


def cushion(material, lattice=None, contact=None, solver=None, **loading):
    """A crush of a small lattice, to 30 % unless the loading says otherwise."""
    press = {"mode": "displacement", "strain": 0.3} if "mode" not in loading else {}
    return Case.of(
        lattice={"cells_x": 2, "cells_y": 2, "nodes_per_wall": 2} | (lattice or {}),
        material=material,
        loading=press | loading,
        contact=contact or {},
        solver={"load_steps": 60} if solver is None else solver,
    )


LINEAR = {"modulus": 12e6, "density": 1190.0, "poisson": 0.48}
CASES = {
    "sections": cushion({"loss": 0.4}),
    "linear": cushion(LINEAR | {"loss": 0.4}),
    "points": cushion({"loss": 0.4}, solver={"joints": "points", "load_steps": 60}),
    "classical": cushion(LINEAR | {"loss": 0.3}, solver={"element": "classical", "load_steps": 60}),
    "loose": cushion({"loss": 0.4}, strain=0.6, platen="contact"),
    "branch": cushion(BRANCH, strain=0.5),
    "soft": cushion(SOFT),
    "both": cushion({"loss": 0.3, **SOFT}),
    "fibres": cushion({"loss": 0.4, "bend": "fibres"}),
    "yields": cushion(PLASTIC, strain=0.2, platen="contact"),
    "in time": cushion({"loss": 0.4}, speed=5.0, solver={"load_steps": 100}),
    "bdf2": cushion({"loss": 0.4}, speed=5.0, solver={"load_steps": 100, "integrator": "bdf2"}),
    "newmark": cushion({"loss": 0.4}, speed=5.0, solver={"integrator": "newmark"}),
    "impact": cushion({"loss": 0.4}, mode="impact", energy=0.05, solver={}),
    "plastic impact": cushion(PLASTIC, mode="impact", energy=0.5, solver={}),
    "dead load": cushion(
        {"loss": 0.4}, mode="force", force=2.0, release_time=0.01, duration=0.02, platen="contact",
        solver={},
    ),
    "periodic": cushion({"loss": 0.4}, lattice={"boundary": "periodic"}),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_the_book_closes_and_dissipation_never_falls(name):
    result = simulate(CASES[name])
    assert (result.status, result.message) == (Status.CONVERGED, "")
    book = result.history
    paid = book["work_in_J"] + book["injected_by_projection_J"]
    most = np.abs(paid).max()
    assert np.abs(paid - summed(book, STORED + LOST)).max() < 1e-6 * most
    assert np.abs(book["energy_residual_J"]).max() < 1e-6 * most
    assert np.diff(book["dissipated_material_J"]).min() >= -1e-7 * most
    assert book["dissipated_material_J"][-1] > 0.02 * most


def lost(steps, **material):
    """Losses of the material and of the steps over the work of a crush."""
    history = simulate(cushion(material, solver={"load_steps": steps})).history
    return [history[name][-1] / history["work_in_J"].max() for name in
            ("dissipated_material_J", "dissipated_integrator_J")]  # fmt: skip


@pytest.mark.parametrize("material", [{"loss": 0.4}, LINEAR | {"loss": 0.4}], ids=["curve", "line"])
def test_steps_lose_nothing_in_the_limit(material):
    """Independent of the book: the trapezoidal work against stored and dissipated energy."""
    rough, fine = lost(50, **material), lost(200, **material)
    assert abs(fine[1]) < 0.15 * abs(rough[1])
    assert abs(fine[1]) < 1e-3
    assert fine[0] == pytest.approx(rough[0], rel=0.03)


@pytest.mark.parametrize("material", [{}, LINEAR], ids=["curve", "line"])
def test_slow_and_fast_limits_are_elastic(material):
    """A branch that has relaxed, and one that has not begun to."""
    shares = {"relaxation_shares": (0.5,), "reference_time": 1e-12}
    fast, slow = (
        simulate(cushion(material | shares | {"relaxation_times": (t,)})).history["work_in_J"]
        for t in (1e9, 1e-9)
    )
    elastic = simulate(cushion(material)).history["work_in_J"]
    np.testing.assert_allclose(fast, elastic, atol=1e-5 * elastic.max())
    np.testing.assert_allclose(slow, 0.5 * elastic, atol=1e-3 * elastic.max())


def test_halved_steps_take_their_share_of_the_time():
    """Few iterations allowed: load steps are halved; the relaxed forces are the same."""
    whole = simulate(cushion(BRANCH, strain=0.4, unload=False, solver={"load_steps": 160}))
    few = {"load_steps": 20, "max_iterations": 4}
    halved = simulate(cushion(BRANCH, strain=0.4, unload=False, solver=few))
    assert halved.summary["steps"] > 20
    force = [result.history["reaction_top_N"][-1] for result in (whole, halved)]
    assert force[1] == pytest.approx(force[0], rel=5e-3)


def test_a_strip_bends_alike_through_its_section_and_linearly():
    """One material with a straight curve: sections relax like moments."""
    strain = (0.01, 0.05, 0.5, 2.0)
    curve = {"curve_strain": (-0.5, *strain), "curve_stress": (-6e6, *(12e6 * e for e in strain))}
    through = LINEAR | curve | {"plane": "stress", "loss": 0.4, "reference_time": 1.0}
    flat = LINEAR | {"loss": 0.4, "plane": "stress"}
    shape = {"wall_thickness": 0.2e-3, "imperfection": 0.5}
    one, two = (
        simulate(cushion(material, shape, {"model": "none"}, strain=0.02)).summary
        for material in (through | {"name": "straight"}, flat)
    )
    assert one["absorbed_energy_J"] == pytest.approx(two["absorbed_energy_J"], rel=5e-3)
    lost_shares = [1.0 - row["returned_energy_J"] / row["absorbed_energy_J"] for row in (one, two)]
    assert lost_shares[0] == pytest.approx(lost_shares[1], rel=1e-3)


def slender(rate):
    """A cell of slender walls pressed a little at a rate (1/s), linear all over."""
    material = material_with(modulus=20e6, density=1190.0, loss=0.3, plane="stress")
    return Case.of(
        lattice=dict(cells_x=1, cells_y=1, wall_thickness=4e-4, imperfection=0.0),
        material=material,
        loading=dict(mode="displacement", strain=1e-4, strain_rate=rate, unload=False),
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
    for rate in (1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0):
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
            material={"name": "cheetah", "loss": 0.4},
            loading={"mode": "displacement", "strain": 0.6, "platen": "contact"},
        )
    )
    assert (result.status, result.message) == ("converged", "")
    assert result.summary["absorbed_energy_until_packed_J"] == pytest.approx(2.15, rel=0.01)
    work = result.history["work_in_J"].max()
    assert result.summary["returned_energy_J"] == pytest.approx(0.5 * work, rel=0.05)

"""A tube of a material that relaxes, pressed along its cell: loss, rate, book, and rest."""

import numpy as np
import pytest

from sweep.config.case import Case
from sweep.scene.relaxation import lost_share
from sweep.simulation.simulate import simulate
from tests.physics.test_memories import mean_modulus
from tests.support.designs.tables import material_with
from tests.support.kernels.pressed_plates import tube

LOSS = 0.4
SMALL = 0.004  # strain before any wall buckles


def pressed(strain, steps, strain_rate=1e-2, loss=LOSS):
    """A glued tube pressed and let go again."""
    material = material_with(name="ultimaker_tpu95a", **({"loss": loss} if loss else {}))
    rate = {"strain_rate": strain_rate} if loss else {}
    return Case.of(
        lattice=tube({"mode": "displacement", "platen": "glued"}).lattice,
        material=material,
        loading=dict(
            direction="out_of_plane", mode="displacement", strain=strain, platen="glued", **rate,
        ),
        contact=dict(friction=0.0),
        solver=dict(load_steps=steps),
    )  # fmt: skip


def history(case):
    result = simulate(case)
    assert result.status == "converged"
    return result.history


def test_the_book_is_closed_and_the_material_takes_its_share():
    """A tube pressed by 40 % and let go; dissipation never falls."""
    folded = simulate(pressed(0.4, 60))
    book = folded.history["dissipated_material_J"]
    assert np.diff(book).min() >= -1e-9 * book.max()
    assert folded.status == "converged"
    summary = folded.summary
    assert abs(summary["energy_residual_J"]) < 1e-7 * summary["absorbed_energy_J"]
    spent = summary["dissipated_material_J"] / summary["absorbed_energy_J"]
    assert LOSS < summary["lost_share"] < 0.62
    assert LOSS < spent < 0.6


def test_before_it_buckles_a_tube_loses_what_a_strip_loses():
    """The loss until its force is zero."""
    rows = history(pressed(SMALL, 100))
    strain, force = rows["strain"], rows["reaction_top_N"]
    peak = np.argmax(strain)
    zero = peak + np.argmax(np.append(force[peak:], -1.0) <= 0.0)
    work = np.append(0.0, np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(strain)))
    back = np.append(force[:zero], 0.0)
    assert back.min() >= 0.0
    lost = work[zero - 1] / work[peak]
    assert lost == pytest.approx(LOSS, abs=0.02)
    assert lost_share(0.1) < LOSS


@pytest.mark.parametrize("strain_rate", [1e-3, 1.0, 1e3])
def test_a_faster_crush_is_stiffer_as_the_modulus_of_a_ramp(strain_rate):
    """Its force over the force of an elastic tube is the mean of the relaxation modulus over the
    ramp.
    """
    case = pressed(SMALL, 20, strain_rate)
    elastic, found = (
        history(each)["reaction_top_N"].max() for each in (pressed(SMALL, 20, loss=0.0), case)
    )
    mean = mean_modulus(case.material, 0.0, SMALL / strain_rate)
    assert found / elastic == pytest.approx(mean, rel=2e-3)

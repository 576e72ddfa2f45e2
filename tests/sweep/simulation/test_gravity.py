"""A striker that falls has its weight: closed form, books, rest on the lattice, cushion curve."""

import numpy as np
import pandas as pd
import pytest

from sweep.config.case import Case
from sweep.constants import STANDARD_GRAVITY
from sweep.ranking.cushion import crush_of, cushion_curve
from sweep.simulation.simulate import simulate
from sweep.simulation.striker import rests, second_stop
from tests.studies.verify import MATERIAL
from tests.support.designs.scenes import is_sound, run, unbalanced
from tests.support.designs.tables import lattice_with

WALL, MASS = 2e-3, 0.05
COLUMN = lattice_with(cells_x=1, cells_y=1, wall_thickness=WALL, imperfection=0.0)
STIFFNESS = 2 * MATERIAL.modulus * COLUMN.depth * WALL / COLUMN.height
SAG = MASS * STANDARD_GRAVITY / STIFFNESS
FALL = 1.5 * SAG
HEAVY_BOX = dict(kind="hex", width=0.05, height=0.05, depth=0.012, cells_x=4, cells_y=4)
PAD = dict(lattice=HEAVY_BOX | {"wall_thickness": 8e-4}, material=dict(name="ninjaflex", loss=0.4))


def column(steps=2000, integrator="newmark", damping=None, **loading):
    """Two straight walls without mass under a striker that falls on them; steps in half a swing."""
    swing = np.pi * np.sqrt(MASS / STIFFNESS)
    fall = dict(mode="drop", striker_mass=MASS, drop_height=FALL, duration=3 * swing)
    return Case.of(
        lattice=COLUMN,
        material=MATERIAL.model_copy(update={"density": 1e-3}),
        loading=fall | loading,
        contact=dict(model="none"),
        damping=damping or dict(model="none"),
        solver=dict(joints="points", time_step=swing / steps, integrator=integrator),
    )


def test_a_drop_on_a_spring():
    """With the sag d: x = d (1 - cos w t) + v / w sin w t; G = 1 + (1 + 2 H / d)^0.5 = 3 at H = 1.5
    d.
    """
    result = run(column())
    history, swing = result.history, np.sqrt(STIFFNESS / MASS)
    time, speed = history["time_s"], np.sqrt(2 * STANDARD_GRAVITY * FALL)
    exact = SAG * (1 - np.cos(swing * time)) + speed / swing * np.sin(swing * time)
    assert is_sound(result)
    np.testing.assert_allclose(history["top_displacement_m"], exact, atol=1e-5 * SAG)
    assert history["top_displacement_m"].max() == pytest.approx(3 * SAG, rel=1e-6)
    for name in ("peak_deceleration_m_per_s2", "peak_deceleration_filtered_m_per_s2"):
        assert result.summary[name] == pytest.approx(3 * STANDARD_GRAVITY, rel=2e-3)
    assert result.summary["absorbed_energy_J"] == pytest.approx(4.5 * SAG**2 * STIFFNESS, rel=1e-5)
    assert result.summary["rebound_share"] == pytest.approx(1.0, abs=2e-3)
    assert result.summary["lost_share"] == pytest.approx(0.0, abs=2e-3)


def test_without_gravity_only_the_fall_counts():
    peak = run(column(gravity=False)).history["top_displacement_m"].max()
    assert peak == pytest.approx(np.sqrt(3.0) * SAG, rel=1e-6)


@pytest.mark.parametrize("direction", ["in_plane", "out_of_plane"])
def test_books_of_a_drop(direction):
    """Work includes m g s; the support bears the momentum of the fall and of the weight."""
    cells = dict(cells_x=2, cells_y=2, nodes_per_wall=2)
    fall = dict(mode="drop", striker_mass=0.1, drop_height=0.05, direction=direction)
    if direction == "in_plane":
        case = column(500, "backward_euler")
    else:
        upright = cells | {"layers": 4, "depth": 5e-3}
        case = Case.of(lattice=upright, loading=fall | {"duration": 0.02})
    loading, history = case.loading, run(case).history
    assert unbalanced(history) < 1e-6
    brought = history["work_in_J"] - history["work_in_J"][0]
    assert brought.max() > 0.0
    np.testing.assert_allclose(
        brought, loading.weight * history["top_displacement_m"], atol=1e-6 * brought.max()
    )
    if direction == "in_plane":
        borne = np.cumsum(history["reaction_bottom_N"][1:] * np.diff(history["time_s"]))
        lost = loading.striker_mass * (loading.striker_speed - history["striker_speed_m_per_s"])
        given = (lost + loading.weight * history["time_s"])[1:]
        np.testing.assert_allclose(borne, given, atol=1e-6 * given.max())


@pytest.mark.parametrize(("beta", "still"), [(8e-4, False), (3e-3, True)], ids=["swings", "creeps"])
def test_a_striker_may_stay_on_the_lattice(beta, still):
    """It ends at its second stop, or at rest where its weight is borne, and is no failed case."""
    damping = dict(model="rayleigh", mass=0.0, stiffness=beta)
    case = column(100, "backward_euler", damping, duration=0.1)
    result = run(case)
    history = result.history
    assert is_sound(result)
    assert history["top_displacement_m"][-1] == pytest.approx(SAG, rel=0.2)
    assert rests(history) == still == (history["time_s"][-1] > 0.09)
    assert result.summary["rebound_share"] == 0.0
    assert 0.0 <= result.summary["lost_share"] <= 1.0


def test_a_second_stop_is_one_after_a_way_down():
    down, up = np.linspace(1.0, 0.0, 11), np.linspace(0.0, 0.5, 6)[1:]
    assert second_stop(np.concatenate([down, up, [0.4, 0.3, 0.35]])) == 17
    assert second_stop(np.concatenate([down, up, [0.48, 0.5]])) is None
    assert second_stop(np.concatenate([down, up, [0.4, 0.3]])) is None
    assert second_stop(np.concatenate([down, up, down[5:] - 0.1])) is None


@pytest.mark.parametrize(
    ("loading", "gravity"),
    [
        ({"mode": "drop"}, True),
        ({"drop_height": 0.1}, True),
        ({"preset": "ista-1a 5 kg"}, True),
        ({"mode": "drop", "gravity": False}, False),
        ({"mode": "impact"}, False),
        ({"mode": "impact", "energy": 0.1}, False),
        ({"striker_speed": 2.0, "gravity": True}, True),
    ],
)
def test_drops_have_gravity(loading, gravity):
    case = Case.of(loading=loading)
    assert case.loading.gravity is gravity
    assert case.changed(lattice={"cells_x": 2}).loading.gravity is gravity
    assert case.changed(loading={"drop_height": 0.3}).loading.gravity is True
    assert case.changed(loading={"drop_height": 0.3, "gravity": False}).loading.gravity is False


def test_a_heavy_box_set_down_hard():
    """544 g from 100 mm: 17 to 20 g0, by the curve of a crush at the speed of the touch.

    Impact and curve differ as the striker slows down, and the walls have mass.
    """
    fall = dict(mode="drop", striker_mass=0.544, drop_height=0.1, platen="contact")
    case = Case.of(loading=fall, **PAD)
    pressed = dict(mode="displacement", strain=0.9, speed=1.4, quasi_static=True)
    crush = simulate(Case.of(loading=pressed | {"unload": False, "platen": "contact"}, **PAD))
    summary = simulate(case).summary
    peak = summary["peak_deceleration_filtered_m_per_s2"] / STANDARD_GRAVITY
    static, curve = cushion_curve(crush_of(pd.DataFrame(crush.history), crush.summary), 0.1)
    width, depth = case.footprint
    estimate = np.interp(case.loading.weight / (width * depth), static, curve)
    assert 17.0 < peak < 20.0
    assert peak == pytest.approx(estimate, rel=0.15)

"""A striker that falls has its weight: closed form, books, rest on the lattice, cushion curve."""

import numpy as np
import pandas as pd
import pytest

from sweep.config.case import Case
from sweep.constants import STANDARD_GRAVITY
from sweep.ranking.cushion import crush_of, cushion_curve
from sweep.simulation.simulate import simulate
from sweep.simulation.striker import rests, second_stop
from tests.support.designs.scenes import is_sound, run, unbalanced
from tests.support.designs.springs import STIFFNESS, STRIKER, half_swing, spring

SAG = STRIKER * STANDARD_GRAVITY / STIFFNESS
FALL = 1.5 * SAG
HEAVY_BOX = dict(kind="hex", width=0.05, height=0.05, depth=0.012, cells_x=4, cells_y=4)
PAD = dict(lattice=HEAVY_BOX | {"wall_thickness": 8e-4}, material=dict(name="ninjaflex", loss=0.4))


def column(*how, **loading):
    """The spring, and a striker that falls on it."""
    fall = dict(mode="drop", drop_height=FALL, duration=3 * half_swing())
    return spring(half_swing(), *how, **fall | loading)


def test_a_drop_on_a_spring():
    """Travel d (1 - cos w t) + v / w sin w t with the sag d; G = 1 + sqrt(1 + 2 H / d) = 3."""
    result = run(column())
    history, swing = result.history, np.sqrt(STIFFNESS / STRIKER)
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
    fall = dict(mode="drop", striker_mass=0.1, drop_height=0.05, direction=direction)
    if direction == "in_plane":
        case = column(500, "backward_euler")
    else:
        upright = dict(cells_x=1, cells_y=1, nodes_per_wall=2, layers=2, depth=5e-3)
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


def test_a_heavy_box_set_down_hard():
    """544 g from 100 mm: 22 to 24 g0, by the curve of a crush at the speed of the touch.

    Impact and curve differ as the striker slows down, and the walls have mass.
    """
    fall = dict(mode="drop", striker_mass=0.544, drop_height=0.1, platen="contact")
    case = Case.of(loading=fall, solver={"time_step": 1e-4}, **PAD)
    pressed = dict(mode="displacement", strain=0.9, speed=1.4, quasi_static=True)
    pressed |= dict(unload=False, platen="contact")
    crush = simulate(Case.of(loading=pressed, solver={"load_steps": 100}, **PAD))
    summary = simulate(case).summary
    peak = summary["peak_deceleration_filtered_m_per_s2"] / STANDARD_GRAVITY
    static, curve = cushion_curve(crush_of(pd.DataFrame(crush.history), crush.summary), 0.1)
    width, depth = case.footprint
    estimate = np.interp(case.loading.weight / (width * depth), static, curve)
    assert 22.0 < peak < 24.0
    assert peak == pytest.approx(estimate, rel=0.15)


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
def test_drops_have_gravity_unless_they_hit_a_target(loading, gravity):
    case = Case.of(loading=loading)
    assert case.loading.gravity is gravity
    for change, then in (
        ({}, gravity),
        ({"drop_height": 0.3}, True),
        ({"drop_height": 0.3, "gravity": False}, False),
    ):
        assert case.changed(lattice={"cells_x": 2}, loading=change).loading.gravity is then
    if "gravity" not in loading:
        target = case.changed(loading={"target_mass": 1.36}, damping={"mass": 0.0})
        assert target.loading.gravity is False
        assert Case.of(loading=loading | {"target_mass": 1.36}).loading.gravity is False

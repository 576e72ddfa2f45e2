"""Structures of a user's own against closed forms: motion, contact with the floor, friction."""

import numpy as np
import pytest

from sweep.columns import Column, describe_history
from tests.studies.verify import MATERIAL
from tests.support.designs.scenes import unbalanced
from tests.support.designs.structures import (
    BEAM,
    GRAVITY,
    LENGTH,
    MASS,
    MM,
    PENDULUM,
    ROD,
    let_go,
    momentum,
    probe,
    swing,
)

L = LENGTH * MM
G = GRAVITY * MM
HEAVY = dict(model="rayleigh", mass=50.0, stiffness=1e-3)


def test_free_fall():
    """Backward Euler falls g dt^2 n (n + 1) / 2 in n steps."""
    result = let_go(ROD | {"gravity_mm_s2": [0, -GRAVITY]}, 0.1, 1e-3)
    n = np.arange(101)
    np.testing.assert_allclose(probe(result, 1, "y_m"), -0.5 * G * 1e-6 * n * (n + 1), atol=1e-12)
    assert result.history["kinetic_J"][-1] == pytest.approx(0.5 * MASS * (G * 0.1) ** 2, rel=1e-9)


def test_a_throw_keeps_its_velocity():
    result = let_go(ROD | {"initial_velocity_mm_s": [300, -40]}, 0.1, 1e-3)
    assert probe(result, 0, "x_m")[-1] == pytest.approx(0.03, rel=1e-9)
    assert probe(result, 0, "y_m")[-1] == pytest.approx(-0.004, rel=1e-9)
    assert result.history["work_in_J"][0] == result.history["kinetic_J"][0] > 0.0


ANGLE_OF_FOUR = {
    "nodes_mm": [[0, 0], [30, 0], [30, 20], [10, 35]],
    "walls": [[0, 1], [1, 2], [2, 3]],
    "subdivide": 1,
    "probes": [0, 1, 2, 3],
}


def test_momentum_of_a_free_body():
    """Backward Euler keeps momentum exactly, angular momentum to first order in dt."""
    masses = np.array([5.0, 3.0, 4.0, 6.0])
    parts = ANGLE_OF_FOUR | {
        "masses": [{"node": k, "mass_g": m} for k, m in enumerate(masses)],
        "initial_velocity_mm_s": [[100, 0], [0, 200], [-150, 50], [0, -100]],
    }
    light = MATERIAL.model_copy(update={"density": 1e-6})
    velocity = MM * np.array(parts["initial_velocity_mm_s"])
    x = MM * np.array(parts["nodes_mm"])
    given = 1e-3 * masses @ (x[:, 0] * velocity[:, 1] - x[:, 1] * velocity[:, 0])
    lost = []
    for dt in (1e-4, 5e-5):
        result = let_go(parts, 0.02, dt, material=light)
        whole, turning = momentum(result, 1e-3 * masses)
        wanted = np.tile(1e-3 * masses @ velocity, (len(whole), 1))
        np.testing.assert_allclose(whole, wanted, rtol=1e-6)
        lost.append(turning[-1] - given)
    assert abs(lost[1]) < 0.05 * abs(given)
    assert lost[0] == pytest.approx(2.0 * lost[1], rel=0.2)


def test_pendulum():
    """A rod on a pin falls through 10 degrees with the period of its compound pendulum."""
    result = let_go(PENDULUM, 0.3, 2.5e-4)
    x, time = probe(result, 1, "x_m"), result.history["time_s"]
    k = np.flatnonzero(x < 0.0)[0]
    quarter = time[k] - 2.5e-4 * x[k] / (x[k] - x[k - 1])
    lumped = 1.0 / 3.0 + 1.0 / (6.0 * PENDULUM["subdivide"] ** 2)
    assert 4.0 * quarter == pytest.approx(swing(lumped), rel=5e-3)


def test_rod_comes_to_rest_on_the_floor():
    parts = ROD | {"gravity_mm_s2": [0, -GRAVITY], "floor_y_mm": -2.0}
    result = let_go(parts, 0.4, 5e-4, dict(friction=0.3), HEAVY)
    assert result.history["reaction_bottom_N"][-1] == pytest.approx(MASS * G, rel=1e-4)
    assert not result.history["reaction_bottom_N"][:20].any()
    assert result.history["kinetic_J"][-1] < 1e-9 * result.history["kinetic_J"].max()
    assert -1.6 * MM < probe(result, 0, "y_m")[-1] < -1.5 * MM
    assert np.isnan(result.history["reaction_top_N"]).all()


def on_incline(slope, friction, duration):
    """Velocity (m/s) down an incline after a while of a block that rests on it at the start.

    Gravity is turned instead of the floor.
    """
    parts = {
        "nodes_mm": [[0, 0], [10, 0]],
        "walls": [[0, 1]],
        "wall_thickness_mm": 4.0,
        "subdivide": 2,
        "gravity_mm_s2": [GRAVITY * np.sin(slope), -GRAVITY * np.cos(slope)],
        "floor_y_mm": -2.0,
        "probes": [0],
    }
    result = let_go(parts, duration, 1e-3, dict(friction=friction))
    return np.diff(probe(result, 0, "x_m")[-2:])[0] / 1e-3


@pytest.mark.parametrize("friction", [0.1, 0.3, 0.6])
def test_block_on_an_incline(friction):
    """It sticks, except for a creep below the slip speed, up to atan(mu), and slides above."""
    below, above = (np.arctan(share * friction) for share in (0.99, 1.01))
    assert 0.0 < on_incline(below, friction, 0.4) < 1e-3
    assert on_incline(above, friction, 0.4) > 1.5e-3


def test_block_slides_as_fast_as_friction_lets_it():
    friction, slope = 0.3, np.arctan(0.6)
    fast = [on_incline(slope, friction, duration) for duration in (0.1, 0.2)]
    gained = G * (np.sin(slope) - friction * np.cos(slope)) * 0.1
    assert fast[1] - fast[0] == pytest.approx(gained, rel=1e-3)


def test_book_of_what_is_led_in_time():
    """A beam shaken at its end, with a weight on it and a speed to begin with."""
    parts = BEAM | {
        "prescribed": [
            {"node": 1, "direction": "y", "displacement_mm": 10.0},
            {"node": 1, "direction": "rotation", "angle_rad": 0.3},
        ],
        "initial_velocity_mm_s": [0.0, 50.0],
        "gravity_mm_s2": [0, -GRAVITY],
    }
    result = let_go(parts, 0.05, 5e-4, damping={})
    history = result.history
    np.testing.assert_allclose(probe(result, 1, "y_m"), 0.2 * history["time_s"], atol=1e-12)
    np.testing.assert_allclose(probe(result, 1, "rotation_rad"), 6.0 * history["time_s"])
    assert history["work_in_J"][0] == history["kinetic_J"][0] > 0.0
    assert unbalanced(history) < 1e-6
    assert probe(result, 0, "reaction_y_N")[-1] != 0.0


def test_column_of_a_probe_is_described():
    assert describe_history("probe_12_reaction_moment_Nm").units == "N m"
    assert describe_history("probe_12_x_m") == Column("m", "x at node 12")
    assert describe_history("load_factor").units == "1"
    assert describe_history("strain").units == "1"

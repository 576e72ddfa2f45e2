"""Structures of a user's own against closed forms: statics."""

from pathlib import Path

import numpy as np
import pytest

from sweep.config.grid import expand
from sweep.config.load import load_config
from tests.studies.validation.elastica import cantilever
from tests.support.converged import converged
from tests.support.designs.scenes import TIGHT
from tests.support.designs.structures import (
    AXIAL,
    BEAM,
    BENDING,
    CLAMPED,
    DEPTH,
    LENGTH,
    MM,
    ROD,
    THICKNESS,
    end_load,
    probe,
    pushed,
)

L = LENGTH * MM
CONFIGS = Path(__file__).parents[3] / "configs"


@pytest.mark.parametrize("size", [1.0, 10.0])
def test_cantilever_under_a_dead_load(size):
    drop, shortening, slope = cantilever(size)
    force = size * BENDING / L**2
    result = pushed(BEAM | end_load(-force))
    assert -probe(result, 1, "y_m")[-1] / L == pytest.approx(drop, rel=1e-3)
    assert 1 - probe(result, 1, "x_m")[-1] / L == pytest.approx(shortening, rel=1e-3)
    assert -probe(result, 1, "rotation_rad")[-1] == pytest.approx(slope, rel=1e-3)
    assert probe(result, 0, "reaction_y_N")[-1] == pytest.approx(force, rel=1e-6)
    arm = probe(result, 1, "x_m")[-1]
    assert probe(result, 0, "reaction_moment_Nm")[-1] == pytest.approx(force * arm, rel=1e-6)
    assert not probe(result, 1, "reaction_y_N").any()


@pytest.mark.parametrize("pieces", [[1, 1, 1], [4, 2, 1], [8, 8, 8]])
def test_t_joint_under_a_moment(pieces):
    """Three walls clamped at their far ends share a moment as 4 Y I / l."""
    lengths = np.array([100.0, 60.0, 40.0])
    joint = {
        "nodes_mm": [[0, 0], [-lengths[0], 0], [lengths[1], 0], [0, -lengths[2]]],
        "walls": [[1, 0], [0, 2], [0, 3]],
        "subdivide": pieces,
        "supports": [{"node": node, "fix": CLAMPED} for node in (1, 2, 3)],
        "loads": [{"node": 0, "moment_Nmm": 1e-3}],
        "probes": [0, 1, 2, 3],
    }
    result = pushed(joint, steps=1)
    stiffness = 4.0 * BENDING / (lengths * MM)
    assert probe(result, 0, "rotation_rad")[-1] == pytest.approx(1e-6 / stiffness.sum(), rel=1e-3)
    for node, share in zip((1, 2, 3), stiffness / stiffness.sum(), strict=True):
        moment = probe(result, node, "reaction_moment_Nm")[-1]
        assert moment == pytest.approx(0.5e-6 * share, rel=2e-3)


TRUSS = {
    "nodes_mm": [[-100, 0], [0, 20], [100, 0]],
    "walls": [[0, 1], [1, 2]],
    "subdivide": 1,
    "pins": [0, 1, 2],
    "supports": [{"node": node, "fix": ["x", "y"]} for node in (0, 2)],
    "probes": [0, 1, 2],
}


def truss_force(height):
    """Force (N) up on the apex that holds it at ``height`` (m), of linear bars.

    They stay straight, as a classical element does; a cubic one buckles.
    """
    rest, length = np.hypot(0.1, 0.02), np.hypot(0.1, height)
    return 2.0 * AXIAL * (length / rest - 1.0) * height / length


def test_two_bar_truss_is_led_through_its_snap():
    led = {"prescribed": [{"node": 1, "direction": "y", "displacement_mm": -50.0}]}
    result = pushed(TRUSS | led, steps=20, element="classical")
    height = probe(result, 1, "y_m")
    np.testing.assert_allclose(height, 0.02 - 0.05 * result.history["load_factor"], atol=1e-12)
    scale = np.abs(truss_force(height)).max()
    np.testing.assert_allclose(
        probe(result, 1, "reaction_y_N"), truss_force(height), atol=1e-6 * scale
    )
    feet = probe(result, 0, "reaction_y_N") + probe(result, 2, "reaction_y_N")
    np.testing.assert_allclose(feet, -truss_force(height), atol=1e-6 * scale)


@pytest.mark.parametrize(("share", "side"), [(0.95, 1.0), (1.05, -1.0)])
def test_two_bar_truss_snaps_where_its_force_is_greatest(share, side):
    force = share * np.abs(truss_force(np.linspace(0.0, 0.02, 1000))).max()
    load = {"loads": [{"node": 1, "force_N": [0.0, -force]}]}
    height = probe(pushed(TRUSS | load, element="classical"), 1, "y_m")[-1]
    assert side * height > 0.0
    assert truss_force(height) == pytest.approx(-force, rel=1e-5)


@pytest.mark.parametrize("pieces", [1, 8])
@pytest.mark.parametrize(("pins", "factor"), [([], 12.0), ([1], 3.0)])
def test_end_of_a_beam_is_led(pieces, pins, factor):
    """12 Y I / l^3 with its end clamped, 3 Y I / l^3 where that is a free hinge."""
    fix = [] if pins else [{"node": 1, "fix": ["rotation"]}]
    parts = BEAM | {"subdivide": pieces, "pins": pins, "supports": BEAM["supports"] + fix}
    led = [{"node": 1, "direction": "y", "displacement_mm": 0.01}]
    result = pushed(parts | {"prescribed": led}, steps=1)
    assert probe(result, 1, "reaction_y_N")[-1] == pytest.approx(
        factor * BENDING / L**3 * 1e-5, rel=1e-4
    )


def test_led_end_needs_the_force_that_moves_it_as_far():
    force = 4.0 * BENDING / L**2
    loaded = pushed(BEAM | end_load(-force))
    x, y, angle = (probe(loaded, 1, name)[-1] for name in ("x_m", "y_m", "rotation_rad"))
    moves = [
        {"node": 1, "direction": "y", "displacement_mm": y / MM},
        {"node": 1, "direction": "x", "displacement_mm": (x - L) / MM},
        {"node": 1, "direction": "rotation", "angle_rad": angle},
    ]
    led = pushed(BEAM | {"prescribed": moves[:1]}, **TIGHT)
    assert probe(led, 1, "reaction_y_N")[-1] == pytest.approx(-force, rel=1e-6)
    assert probe(led, 1, "x_m")[-1] == pytest.approx(x, rel=1e-7)
    led = pushed(BEAM | {"prescribed": moves}, steps=20)
    assert probe(led, 1, "reaction_y_N")[-1] == pytest.approx(-force, rel=1e-5)
    assert abs(probe(led, 1, "reaction_moment_Nm")[-1]) < 1e-5 * force * L
    assert abs(probe(led, 1, "reaction_x_N")[-1]) < 1e-4 * force


def test_work_of_what_is_led_is_its_reaction_times_its_way():
    led = [
        {"node": 1, "direction": "y", "displacement_mm": 20.0},
        {"node": 1, "direction": "rotation", "angle_rad": -0.5},
    ]
    result = pushed(BEAM | {"prescribed": led}, steps=40)
    work = 0.0
    for reaction, way in (("reaction_y_N", "y_m"), ("reaction_moment_Nm", "rotation_rad")):
        force, at = probe(result, 1, reaction), probe(result, 1, way)
        work += np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(at))
    assert result.history["work_in_J"][-1] == pytest.approx(work, rel=1e-9)
    stored = result.history["stretch_J"][-1] + result.history["bend_J"][-1]
    assert stored == pytest.approx(work, rel=1e-3)


@pytest.mark.parametrize("ends", ["clamped", "pinned"])
def test_beam_between_supports_sags(ends):
    """Under its own weight: w L^4 / 384 Y I, or five times that where it may turn."""
    weight = 1190.0 * THICKNESS * DEPTH * MM**2 * 0.01  # N/m under a hundredth of a m/s^2
    fix = CLAMPED if ends == "clamped" else ["x", "y"]
    half = {
        "nodes_mm": [[0, 0], [LENGTH / 2, 0], [LENGTH, 0]],
        "walls": [[0, 1], [1, 2]],
        "subdivide": 16,
        "supports": [{"node": node, "fix": fix} for node in (0, 2)],
        "gravity_mm_s2": [0, -10.0],
        "probes": [1],
    }
    result = pushed(half, steps=1)
    sag = (1.0 if ends == "clamped" else 5.0) * weight * L**4 / (384.0 * BENDING)
    assert -probe(result, 1, "y_m")[-1] == pytest.approx(sag, rel=6e-3)


def test_nothing_but_inner_nodes_moves():
    """A single wall clamped at both ends has no joint to solve for."""
    parts = ROD | {"supports": [{"node": n, "fix": CLAMPED} for n in (0, 1)]}
    result = pushed(parts | {"gravity_mm_s2": [0, -10.0], "probes": [0]}, steps=1)
    feet = 2.0 * probe(result, 0, "reaction_y_N")[-1]
    assert feet == pytest.approx(1190.0 * LENGTH * THICKNESS * DEPTH * MM**3 * 0.01, rel=1e-9)


def test_spring_bears_its_share():
    """A spring under the end of a beam, 3 Y I / l^3 compared with its own stiffness."""
    beam = 3.0 * BENDING / L**3
    parts = BEAM | {
        "nodes_mm": [[0, 0], [LENGTH, 0], [0, -50], [LENGTH, -50]],
        "walls": [[0, 1], [0, 2], [2, 3]],
        "subdivide": 8,
        "supports": [{"node": node, "fix": CLAMPED} for node in (0, 2, 3)],
        "springs": [{"nodes": [1, 3], "stiffness_N_mm": 2.0 * beam * MM}],
        "probes": [0, 1, 2, 3],
    }
    result = pushed(parts | end_load(-1e-4), steps=1)
    assert -probe(result, 1, "y_m")[-1] == pytest.approx(1e-4 / (3.0 * beam), rel=1e-4)
    assert probe(result, 3, "reaction_y_N")[-1] == pytest.approx(2e-4 / 3.0, rel=1e-4)


def test_stretched_spring_is_energy_brought_along():
    parts = BEAM | {
        "nodes_mm": [[0, 0], [LENGTH, 0], [0, -50]],
        "walls": [[0, 1], [0, 2]],
        "supports": [{"node": node, "fix": CLAMPED} for node in (0, 2)],
        "springs": [{"nodes": [2, 1], "stiffness_N_mm": 1e-4, "rest_length_mm": 60.0}],
    }
    result = pushed(parts, steps=4)
    history = result.history
    apart = (np.hypot(100.0, 50.0) - 60.0) * MM
    assert history["work_in_J"][0] == pytest.approx(0.05 * apart**2, rel=1e-9)
    assert history["energy_residual_J"] == pytest.approx(0.0, abs=1e-9)
    assert probe(result, 1, "y_m")[-1] < -0.001


@pytest.mark.parametrize(("load", "stands"), [(0.98, True), (1.02, False), (1.1, False)])
def test_slender_column_gives_way_beyond_its_euler_load(load, stands):
    """Although it has shortened by a hundredth of its thickness only when it does."""
    force = load * np.pi**2 * BENDING / L**2
    hinged = {
        "nodes_mm": [[0, 0], [LENGTH / 2, 0], [LENGTH, 0]],
        "walls": [[0, 1], [1, 2]],
        "subdivide": 16,
        "supports": [{"node": 0, "fix": ["x", "y"]}, {"node": 2, "fix": ["y"]}],
        "loads": [{"node": 2, "force_N": [-force, 0.0]}],
        "probes": [1],
    }
    result = pushed(hinged, steps=20)
    assert (abs(probe(result, 1, "y_m")[-1]) < 1e-6 * L) == stands


def test_shipped_arch_snaps_through():
    """Held at first by its compressed walls, it gives way to one side and pulls at the end."""
    (case,) = expand(load_config(CONFIGS / "custom.toml"))
    result = converged(case)
    assert result.history["work_in_J"][-1] == pytest.approx(8.442e-3, rel=1e-3)
    assert case.lattice.file == "custom.json"


def test_arms_that_close_touch():
    """Two fingers of a clamp, led towards one another, meet over their thickness."""
    clamp = {
        "nodes_mm": [[0, 0], [0, 10], [60, 0], [60, 10]],
        "walls": [[0, 1], [0, 2], [1, 3]],
        "subdivide": [4, 24, 24],
        "supports": [{"node": node, "fix": CLAMPED} for node in (0, 1)],
        "prescribed": [
            {"node": 2, "direction": "y", "displacement_mm": 6.0},
            {"node": 3, "direction": "y", "displacement_mm": -6.0},
        ],
        "probes": [0, 1, 2, 3],
    }
    result = pushed(clamp, steps=24, contact=dict(friction=0.0))
    gap = result.history["min_gap_m"]
    touching = result.history["contact_J"] > 0.0
    assert not touching[:12].any()
    assert touching[-1]
    assert 0.5 * MM * THICKNESS < gap[-1] < MM * THICKNESS
    whole = sum(probe(result, node, "reaction_y_N") for node in range(4))
    np.testing.assert_allclose(whole, 0.0, atol=1e-6 * probe(result, 2, "reaction_y_N").max())
    apart = pushed(clamp, steps=24)
    assert probe(apart, 2, "reaction_y_N")[-1] < 0.5 * probe(result, 2, "reaction_y_N")[-1]

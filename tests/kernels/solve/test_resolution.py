"""A loaded structure moves, however short its steps and small its load, or the run says why not."""

import numpy as np
import pytest
from scipy.linalg import eigh

from sweep.simulation.simulate import simulate
from tests.support.converged import converged
from tests.support.designs.structures import CLAMPED, UNDAMPED, case_of, probe, structure

LENGTH, THICKNESS, DEPTH, DENSITY, ELEMENTS = 30.0, 2.0, 12.0, 1190.0, 6
AREA = THICKNESS * DEPTH * 1e-6
PIECE = 1e-3 * LENGTH / ELEMENTS
WALL = {"subdivide": ELEMENTS, "wall_thickness_mm": THICKNESS, "depth_mm": DEPTH, "probes": [1]}
STEPS = 50
SCHEMES = {"newmark": 1e-2, "bdf2": 1e-2, "backward_euler": 5e-2}  # errors at `STEPS` steps


def pulled(integrator, modulus=12e6, force=1.0, time_step=1e-6):
    """A cantilever from rest, with a dead ``force`` (N) along itself."""
    parts = WALL | {
        "nodes_mm": [[0.0, 0.0], [LENGTH, 0.0]],
        "walls": [[0, 1]],
        "supports": [{"node": 0, "fix": CLAMPED}],
        "loads": [{"node": 1, "force_N": [force, 0.0]}],
    }
    in_time = integrator in SCHEMES
    steps = {"time_step": time_step} if in_time else {"load_steps": 40}
    material = dict(modulus=modulus, density=DENSITY, poisson=0.48, plane="stress")
    loading = dict(duration=STEPS * time_step) if in_time else {}
    solver = dict(integrator=integrator, **steps)
    return case_of(parts, material, loading=loading, damping=UNDAMPED, solver=solver)


def stretched(time, modulus=12e6, force=1.0):
    """Displacement (m) of the end after a ``time``: the modes of six lumped masses on springs."""
    n = ELEMENTS
    stiffness = modulus * AREA / PIECE * (2.0 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
    stiffness[-1, -1] *= 0.5
    mass = DENSITY * AREA * PIECE * np.append(np.ones(n - 1), 0.5)
    squares, modes = eigh(stiffness, np.diag(mass))
    return np.sum(modes[-1] ** 2 * force / squares * (1.0 - np.cos(np.sqrt(squares) * time)))


def end(result):
    """Displacement (m) of the loaded end."""
    return probe(result, 1, "x_m")[-1] - 1e-3 * LENGTH


@pytest.mark.parametrize("integrator", SCHEMES)
@pytest.mark.parametrize(
    ("modulus", "force", "time_step"),
    [(1.2e4, 1.0, 1e-7), (12e6, -1.0, 1e-6), (12e6, 1e-2, 1e-7), (70e9, 1.0, 1e-6)],
)
def test_a_cantilever_under_a_load_along_itself_moves(integrator, modulus, force, time_step):
    """It moves from rest, by the closed form, if a step is shorter than the fastest oscillation."""
    fastest = 2.0 / PIECE * np.sqrt(modulus / DENSITY)  # rad/s
    if fastest * time_step > 0.3:
        time_step = 0.1 / fastest
    result = converged(pulled(integrator, modulus, force, time_step))
    moved = stretched(STEPS * time_step, modulus, force)
    assert end(result) == pytest.approx(moved, rel=SCHEMES[integrator], abs=1e-16)
    assert np.all(np.diff(result.history["work_in_J"])[:5] > 0.0)
    assert result.summary["newton_iterations"] < 4 * STEPS


@pytest.mark.parametrize("integrator", SCHEMES)
@pytest.mark.parametrize("time_step", [1e-12, 1e-10])
def test_steps_too_short_for_round_off_are_a_failure(integrator, time_step):
    """In 1e-10 s the end moves by 1e-16 m, which its position does not resolve."""
    result = simulate(pulled(integrator, time_step=time_step))
    assert result.status == "stopped"
    assert "round-off" in result.message
    assert len(result.history["time_s"]) < STEPS


def drawn_by_a_spring(integrator, time_step):
    """The cantilever, pulled with 1 N by a strained spring instead of a load."""
    parts = WALL | {
        "nodes_mm": [[0.0, 0.0], [LENGTH, 0.0], [LENGTH + 10.0, 0.0], [LENGTH + 20.0, 0.0]],
        "walls": [[0, 1], [2, 3]],
        "supports": [{"node": node, "fix": CLAMPED} for node in (0, 2, 3)],
        "springs": [{"nodes": [1, 2], "stiffness_N_mm": 1.0, "rest_length_mm": 9.0}],
    }
    lattice = dict(kind="custom", structure=structure(**parts))
    return pulled(integrator, force=0.0, time_step=time_step).changed(lattice=lattice)


@pytest.mark.parametrize("integrator", SCHEMES)
@pytest.mark.parametrize("time_step", [1e-13, 1e-10, 1e-9, 1e-7])
def test_a_strained_spring_moves_what_no_load_moves(integrator, time_step):
    """It moves as the force of the spring demands, or stops: it is not left at rest."""
    result = simulate(drawn_by_a_spring(integrator, time_step))
    if result.status == "converged":
        assert end(result) == pytest.approx(stretched(STEPS * time_step), rel=SCHEMES[integrator])
    else:
        assert "round-off" in result.message
    assert result.status == "stopped" or time_step > 1e-12
    assert result.status == "converged" or time_step < 1e-7


@pytest.mark.parametrize("integrator", ["static", "arc_length"])
def test_a_small_load_is_borne_in_statics_unless_it_is_below_round_off(integrator):
    """However small it is compared with Y I / L^2, 0.1 N: u = F L / (Y A)."""
    for force in (1e-5, 1.0):
        u = force * 1e-3 * LENGTH / (12e6 * AREA)
        assert end(converged(pulled(integrator, force=force))) == pytest.approx(u, rel=1e-3)
    result = simulate(pulled(integrator, modulus=70e9, force=1e-12))  # moves the end by 1e-20 m
    assert result.status == "stopped"

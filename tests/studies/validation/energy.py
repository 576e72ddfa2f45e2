"""Energy of undamped structures under each integrator, in fifty steps a period."""

import numpy as np

from sweep.config.case import Case
from sweep.simulation.simulate import simulate
from tests.support.designs.scenes import STORED, UNDAMPED, summed
from tests.support.designs.structures import APART, GRAVITY, LENGTH, MATERIAL, set_off, structure

INTEGRATORS = ("backward_euler", "bdf2", "newmark")
HEAD = ("energy gained, %", *INTEGRATORS)
SOFT, STIFF = 12e6, 12e9  # Pa


def moving(parts, duration, steps, integrator, damping=UNDAMPED, material=MATERIAL, tolerance=1e-8):
    """A structure that moves for a while, s."""
    return Case.of(
        lattice=dict(kind="custom", structure=structure(**parts)),
        material=material,
        loading=dict(duration=duration),
        contact=APART,
        damping=damping,
        solver=dict(time_step=duration / steps, integrator=integrator, tolerance=tolerance),
    )


def cantilever(integrator):
    """A hundred periods of the first mode, 1 % of the length wide."""
    period, parts = set_off(8, 0.01)
    return simulate(moving(parts, 100 * period, 5000, integrator, tolerance=1e-11))


def pendulum(integrator, modulus):
    """Twenty swings of a rod that falls from the horizontal."""
    parts = {
        "nodes_mm": [[0, 0], [LENGTH, 0]],
        "walls": [[0, 1]],
        "wall_thickness_mm": 4.0,
        "subdivide": 1,
        "pins": [0],
        "supports": [{"node": 0, "fix": ["x", "y"]}],
        "gravity_mm_s2": [0, -GRAVITY],
    }
    period = 1.18 * 2 * np.pi * np.sqrt(2 / 3 * LENGTH / GRAVITY)
    material = MATERIAL.model_copy(update={"modulus": modulus})
    return simulate(moving(parts, 20 * period, 1000, integrator, material=material))


def gained(result):
    """Energy at every row less the work done, over the most kinetic energy."""
    history = result.history
    return (summed(history, STORED) - history["work_in_J"]) / history["kinetic_J"].max()


def rows():
    """Energy that remains at the end, by integrator; a run that is stopped says so."""
    scenes = {
        "cantilever, 100 periods of 1 %": cantilever,
        "pendulum, 20 swings": lambda integrator: pendulum(integrator, SOFT),
        "the same, 1,000 times as stiff": lambda integrator: pendulum(integrator, STIFF),
    }
    for name, scene in scenes.items():
        results = [scene(integrator) for integrator in INTEGRATORS]
        yield [name, *map(_told, results)]


def _told(result):
    end = f"{100.0 * gained(result)[-1]:.3f}"
    return end if result.status == "converged" else result.status

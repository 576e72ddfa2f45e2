"""Integrators in time: their orders, what becomes of the energy, and steps chosen by their error."""

from functools import cache

import numpy as np
import pytest

from sweep.params import Case, Contact, Damping, Lattice, Loading, Solver
from sweep.simulate import simulate
from tests.figures import MATERIAL
from tests.scenes import STORED, UNDAMPED, is_sound, pressed, run, slopes, summed, unbalanced
from tests.structures import (
    APART,
    BENDING,
    CLAMPED,
    GRAVITY,
    LENGTH,
    MASS,
    MM,
    probe,
    structure,
)

ORDERS = {"backward_euler": 1, "bdf2": 2, "newmark": 2}
INTEGRATORS = pytest.mark.parametrize("integrator", ORDERS)
FIRST_ROOT = 1.8751040687119611  # of cos k cosh k = -1
DRAG = Damping(model="rayleigh", mass=100.0, stiffness=0.0)
RAYLEIGH = Damping(model="rayleigh", mass=0.0, stiffness=5e-4)
VISCOUS = Damping(model="kelvin_voigt", relaxation_time=5e-4)
DAMPINGS = pytest.mark.parametrize(
    "damping", [UNDAMPED, DRAG, RAYLEIGH, VISCOUS], ids=["none", "drag", "rayleigh", "viscous"]
)
TIMES = 25  # at which runs are compared


def moving(parts, duration, steps, integrator, damping=UNDAMPED, material=MATERIAL, **solver):
    """A structure that moves for a while, s."""
    return Case(
        lattice=Lattice(kind="custom", structure=structure(**parts)),
        material=material,
        loading=Loading(duration=duration),
        contact=APART,
        damping=damping,
        solver=Solver(time_step=duration / steps, integrator=integrator, **solver),
    )


@cache
def cantilever(walls, amplitude, thickness=1.0):
    """Period (s) and parts of a beam set off in its first mode, amplitude in lengths."""
    z = np.linspace(0.0, 1.0, walls + 1)
    k = FIRST_ROOT
    ratio = (np.cosh(k) + np.cos(k)) / (np.sinh(k) + np.sin(k))
    mode = np.cosh(k * z) - np.cos(k * z) - ratio * (np.sinh(k * z) - np.sin(k * z))
    frequency = thickness * k**2 * np.sqrt(BENDING / MASS / (LENGTH * MM) ** 3)
    speed = amplitude * LENGTH * frequency * mode / mode[-1]
    return 2 * np.pi / frequency, {
        "nodes_mm": [[LENGTH * a, 0.0] for a in z],
        "walls": [[i, i + 1] for i in range(walls)],
        "wall_thickness_mm": thickness,
        "subdivide": 1,
        "supports": [{"node": 0, "fix": CLAMPED}],
        "initial_velocity_mm_s": [[0.0, v] for v in speed],
        "probes": [walls],
    }


def swing(damping, integrator, steps):
    """A quarter of a period of a thick beam that is bent far."""
    period, parts = cantilever(3, 0.2, 20.0)
    return moving(parts, 0.25 * period, steps, integrator, damping)


def orders(cases, column):
    """Slopes of the differences of runs with 1, 2, 4... times as many steps, rms over time."""
    results = [run(case) for case in cases]
    assert {result.status for result in results} == {"converged"}
    values = [result.history[column] for result in results]
    seen = [column[:: (len(column) - 1) // TIMES] for column in values]
    return slopes([np.sqrt(np.mean((b - a) ** 2)) for a, b in zip(seen, seen[1:])])


MOTION = ["probe_3_x_m", "probe_3_y_m", "probe_3_rotation_rad", "stretch_J", "bend_J", "kinetic_J"]


@INTEGRATORS
@DAMPINGS
def test_orders_of_a_beam_that_swings(damping, integrator):
    cases = [swing(damping, integrator, n) for n in (400, 800, 1600, 3200)]
    columns = [*MOTION, "dissipated_integrator_J"]
    columns += ["dissipated_material_J"] * (damping.model != "none")
    for column in columns:
        print(damping.model, integrator, column, orders(cases, column))

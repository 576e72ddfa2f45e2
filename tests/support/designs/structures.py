"""Structures of a few walls with closed forms, of a linear material in plane stress; units of SI.

The length unit of a file is the mm.
"""

import json

import numpy as np

from sweep.config.case import Case
from sweep.config.structures.structure import Structure
from tests.support.converged import converged
from tests.support.designs.tables import MATERIAL

MM = 1e-3
LENGTH, THICKNESS, DEPTH = 100.0, 1.0, 10.0  # mm
BENDING = 12e6 * DEPTH * THICKNESS**3 / 12 * MM**4  # Y I, N m^2
AXIAL = 12e6 * DEPTH * THICKNESS * MM**2  # Y A, N
MASS = 1190.0 * LENGTH * THICKNESS * DEPTH * MM**3  # of a wall of `LENGTH`, kg
GRAVITY = 9810.0  # mm/s^2
APART = dict(model="none")
UNDAMPED = dict(model="none")
FIRST_ROOT = 1.8751040687119611  # of cos k cosh k = -1: first mode of a cantilever
CLAMPED = ["x", "y", "rotation"]
ROD = {"nodes_mm": [[0, 0], [LENGTH, 0]], "walls": [[0, 1]], "probes": [0, 1]}
TILT = np.radians(10.0)
PENDULUM = {
    "nodes_mm": [[0, 0], [LENGTH * np.sin(TILT), -LENGTH * np.cos(TILT)]],
    "walls": [[0, 1]],
    "wall_thickness_mm": 4.0,
    "subdivide": 8,
    "pins": [0],
    "supports": [{"node": 0, "fix": ["x", "y"]}],
    "gravity_mm_s2": [0, -GRAVITY],
    "probes": [0, 1],
}
BEAM = ROD | {"supports": [{"node": 0, "fix": CLAMPED}], "subdivide": 32}


def structure(**parts):
    """A structure as its file would give it."""
    whole = {"wall_thickness_mm": THICKNESS, "depth_mm": DEPTH} | parts
    return Structure.model_validate_json(json.dumps(whole))


def case_of(parts, material=MATERIAL, contact=APART, **tables):
    """The case of a structure."""
    lattice = dict(kind="custom", structure=structure(**parts))
    return Case.of(lattice=lattice, material=material, contact=contact, **tables)


def pushed(parts, steps=10, contact=APART, integrator="static", **solver):
    """Result of a structure that is loaded in equal increments, or along arcs."""
    solver |= dict(integrator=integrator, load_steps=steps)
    return converged(case_of(parts, contact=contact, solver=solver))


def let_go(parts, duration, time_step, contact=APART, damping=UNDAMPED, material=MATERIAL):
    """Result of a structure that moves for a while, s."""
    tables = dict(loading=dict(duration=duration), solver=dict(time_step=time_step))
    return converged(case_of(parts, material, contact, damping=damping, **tables))


def set_off(walls, amplitude, thickness=THICKNESS):
    """Period (s) of a cantilever, and its parts, set off in its first mode.

    amplitude: in lengths. thickness: mm.
    """
    z, k = np.linspace(0.0, 1.0, walls + 1), FIRST_ROOT
    ratio = (np.cosh(k) + np.cos(k)) / (np.sinh(k) + np.sin(k))
    mode = np.cosh(k * z) - np.cos(k * z) - ratio * (np.sinh(k * z) - np.sin(k * z))
    frequency = thickness / THICKNESS * k**2 * np.sqrt(BENDING / MASS / (LENGTH * MM) ** 3)
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


def swing(inertia):
    """Period (s) of the pendulum whose moment of inertia is ``inertia`` m L^2."""
    return 2.0 * np.pi * np.sqrt(2.0 * inertia * LENGTH / GRAVITY) * (1.0 + TILT**2 / 16.0)


def probe(result, node, what):
    """A column of a probe, (rows,)."""
    return result.history[f"probe_{node}_{what}"]


def momentum(result, masses):
    """Momentum (rows - 1, 2) and angular momentum (rows - 1,) of point masses at probes."""
    at = np.stack([[probe(result, n, "x_m"), probe(result, n, "y_m")] for n in range(len(masses))])
    dt = np.diff(result.history["time_s"])
    velocity = np.diff(at, axis=2) / dt
    p = masses[:, None, None] * velocity
    x = at[:, :, 1:]
    return p.sum(axis=0).T, (x[:, 0] * p[:, 1] - x[:, 1] * p[:, 0]).sum(axis=0)


def end_load(force, moment=0.0):
    """Part of a structure: a force (N) up and a moment (N mm) at node 1."""
    return {"loads": [{"node": 1, "force_N": [0.0, force], "moment_Nmm": moment}]}

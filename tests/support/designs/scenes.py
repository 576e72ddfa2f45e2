"""The specimen of the acceptance tests, crushed and loaded, and values read from its results.

A 3 x 3 grid, 12.5 mm over centre lines, walls of 0.8 mm, of the linear material of `figures`.
"""

import numpy as np

from sweep.config.case import Case
from sweep.simulation.simulate import simulate
from tests.support.designs.tables import MATERIAL

UNDAMPED = dict(model="none")
SEED = {}  # Rayleigh, as light as the seed's
HEAVY = dict(model="rayleigh", mass=50.0, stiffness=1e-3)
VISCOUS = dict(model="kelvin_voigt", relaxation_time=1e-3)

STORED = ("kinetic_J", "stretch_J", "bend_J", "contact_J")
LOST = ("dissipated_material_J", "dissipated_friction_J", "dissipated_integrator_J")


TIGHT = {"tolerance": 1e-10}  # of a solver whose forces balance to 1e-8 of the largest


def pressed(
    elements,
    strain,
    steps,
    platen="glued",
    friction=0.0,
    contact="barrier",
    unload=False,
    imperfection=0.01,
    speed=None,
    damping=UNDAMPED,
    solver=None,
):
    """Crush to ``strain`` in equal steps, quasi-static without a ``speed`` (m/s); ``elements`` a
    wall, joints that are points.
    """
    return Case.of(
        lattice=dict(nodes_per_wall=elements - 1, imperfection=imperfection),
        material=MATERIAL,
        loading=dict(
            mode="displacement",
            strain=strain,
            speed=speed,
            quasi_static=speed is None,
            unload=unload,
            platen=platen,
        ),
        contact=dict(model=contact, friction=friction),
        damping=damping,
        solver=dict(load_steps=steps, **{"joints": "points"} | (solver or {})),
    )


def loaded(
    force,
    platen="none",
    friction=0.3,
    time_step=1e-3,
    damping=UNDAMPED,
    release_time=0.138,
    duration=0.2,
    element="cubic",
):
    """Sudden dead load, three elements a wall; contact only between platens in contact."""
    return Case.of(
        lattice=dict(nodes_per_wall=2),
        material=MATERIAL,
        loading=dict(
            mode="force",
            force=force,
            platen=platen,
            release_time=release_time,
            duration=duration,
        ),
        contact=dict(model="none") if platen == "none" else dict(friction=friction),
        damping=damping,
        solver=dict(time_step=time_step, element=element, joints="points"),
    )


_results = {}


def run(case):
    """Result of a case, simulated once in a test run."""
    if case.case_id not in _results:
        _results[case.case_id] = simulate(case)
    return _results[case.case_id]


def at(result, strain, column="reaction_top_N"):
    """Value of a column of the history at ``strain``, one of its rows."""
    row = np.flatnonzero(np.isclose(result.history["strain"], strain, rtol=0, atol=1e-9))[0]
    return result.history[column][row]


def summed(history, names):
    """Sum of columns of the energy book, (rows,) J."""
    return sum(history[name] for name in names)


def unbalanced(history):
    """Largest imbalance of the book in any row, as a share of the most work done so far."""
    paid = history["work_in_J"] + history["injected_by_projection_J"]
    return np.abs(paid - summed(history, STORED + LOST)).max() / history["work_in_J"].max()


def trapezoid(history):
    """Work (J) under the force-displacement curve of the upper platen."""
    force, travel = history["reaction_top_N"], history["top_displacement_m"]
    return np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(travel))


def slopes(errors):
    """Orders log2(e / e') of errors, each for half the step of the previous one."""
    errors = np.abs(np.asarray(errors))
    return np.log2(errors[:-1] / errors[1:])


def misshapen(result):
    """How far the last shape is from the first, best turned and shifted onto it, / height."""
    rest, last = (shape - shape.mean(axis=0) for shape in result.frames["position_m"][[0, -1]])
    u, _, vt = np.linalg.svd(rest.T @ last)
    turn = u @ np.diag([1.0, np.linalg.det(u @ vt)]) @ vt
    return np.linalg.norm(rest @ turn - last, axis=1).max() / np.ptp(rest[:, 1])


def is_sound(result):
    """True if the whole scene ran, without gaps in its numbers, in balance, and no walls cross."""
    gaps = [name for name, column in result.history.items() if not np.all(np.isfinite(column))]
    return (
        (result.status, result.message) == ("converged", "")
        and set(gaps) <= {"min_gap_m", "base_pressure_Pa", "base_pressure_x_m"}
        and np.all(np.isfinite(result.frames["position_m"]))
        and result.summary["max_crossings"] == 0
        and unbalanced(result.history) < 1e-6
    )


def grid(force, platen="none", contact="none", elements=3):
    """A 2 x 2 grid under a dead load."""
    return Case.of(
        lattice=dict(cells_x=2, cells_y=2, nodes_per_wall=elements - 1),
        material=MATERIAL,
        loading=dict(force=force, platen=platen),
        contact=dict(model=contact, friction=0.0),
        damping=dict(model="none"),
        solver=dict(time_step=1e-3, joints="points"),
    )

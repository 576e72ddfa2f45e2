"""Two straight walls without mass under a striker: a spring."""

import numpy as np

from sweep.config.case import Case
from tests.support.designs.tables import MATERIAL, lattice_with

WALL, STRIKER = 2e-3, 0.05  # m, kg
COLUMN = lattice_with(cells_x=1, cells_y=1, wall_thickness=WALL, imperfection=0.0)
STIFFNESS = 2 * MATERIAL.modulus * COLUMN.depth * WALL / COLUMN.height


def half_swing(mass=STRIKER):
    """Half of the period (s) of a mass on the spring."""
    return np.pi * np.sqrt(mass / STIFFNESS)


def spring(swing, steps=2000, integrator="newmark", damping=None, **loading):
    """The walls and a striker of 50 g; steps in half a ``swing`` (s)."""
    return Case.of(
        lattice=COLUMN,
        material=MATERIAL.model_copy(update={"density": 1e-3}),
        loading=dict(striker_mass=STRIKER) | loading,
        contact=dict(model="none"),
        damping=damping or dict(model="none"),
        solver=dict(joints="points", time_step=swing / steps, integrator=integrator),
    )

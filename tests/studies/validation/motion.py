"""Structures in motion: waves, vibrations, a pendulum. Backward Euler is of first order in time."""

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

from sweep.config.case import Case
from sweep.scene.custom import build_structure
from tests.studies.validation.problem import Problem
from tests.support.designs.structures import (
    AXIAL,
    BEAM,
    BENDING,
    GRAVITY,
    LENGTH,
    MASS,
    MATERIAL,
    MM,
    PENDULUM,
    ROD,
    TILT,
    let_go,
    probe,
    structure,
    swing,
)
from tests.support.kernels.solving import whole

L, G = LENGTH * MM, GRAVITY * MM
PASSAGE = L / np.sqrt(AXIAL * L / MASS)  # of a wave along a wall, s
PUSH = 1e-4  # of Y A


def wave(steps):
    """Move over P L / Y A of a rod's end 2.5 passages of a wave after a sudden pull P on it.

    It grows by 1 in each of two passages, until the wave is back from the support.
    """
    parts = {
        "subdivide": 4 * steps // 25,
        "supports": [{"node": 0, "fix": ["x", "y", "rotation"]}],
        "loads": [{"node": 1, "force_N": [PUSH * AXIAL, 0.0]}],
    }
    result = let_go(ROD | parts, 2.5 * PASSAGE, 2.5 * PASSAGE / steps)
    return (probe(result, 1, "x_m")[-1] / L - 1.0) / PUSH


def frequency(mode):
    """Angular frequency over sqrt(Y I / m L^3) of a cantilever, as a function of the mesh.

    From the Hessian at rest and the lumped masses.
    """

    def value(pieces):
        parts = BEAM | {"subdivide": pieces}
        lattice = dict(kind="custom", structure=structure(**parts))
        case = Case.of(
            lattice=lattice,
            material=MATERIAL,
            contact=dict(model="none"),
            solver=dict(integrator="static"),
        )
        scene = build_structure(case)
        n, leader = scene.x_rest.size, scene.terms.layout.leader
        free = np.flatnonzero(leader == np.arange(n))
        hessian = whole(scene, scene.x_rest).hessian(scene.x_rest)[np.ix_(free, free)]
        heavy = scene.terms.coordinates.mass[free] > 0.0
        stiff, mixed, light = (
            hessian[np.ix_(a, b)] for a, b in ((heavy, heavy), (heavy, ~heavy), (~heavy, ~heavy))
        )
        reduced = stiff - mixed @ np.linalg.solve(light, mixed.T)
        square = eigh(
            reduced, np.diag(scene.terms.coordinates.mass[free][heavy]), eigvals_only=True
        )
        return np.sqrt(square[mode] / (BENDING / (MASS * L**3)))

    return value


def roots():
    """Angular frequencies of the first three modes: squares of the roots of cos z cosh z = -1."""
    places = ((1.0, 3.0), (4.0, 5.0), (7.0, 8.0))
    return [brentq(lambda z: np.cos(z) * np.cosh(z) + 1.0, *place) ** 2 for place in places]


PERIOD = swing(1.0 / 3.0)


def kept(steps):
    """Energy left after a period of a pendulum let go at 10 degrees over that at the start."""
    result = let_go(PENDULUM, PERIOD, PERIOD / steps)
    start = 4.0 * MASS * G * 0.5 * L * (1.0 - np.cos(TILT))
    return 1.0 - result.history["dissipated_integrator_J"][-1] / start


PROBLEMS = (
    Problem(
        "rod suddenly pulled: move of its end", wave, 1.5, "d'Alembert",
        (200, 400, 800), 0, 1e-5,
    ),
    *(
        Problem(
            f"cantilever: frequency {mode + 1}", frequency(mode), square, "cos z cosh z = -1",
            (16, 32, 64), 2, 1e-3,
        )
        for mode, square in enumerate(roots())
    ),
    Problem(
        "pendulum, a period: energy left", kept, 1.0, "conservation",
        (800, 1600, 3200), 1, 0.02,
    ),
)  # fmt: skip

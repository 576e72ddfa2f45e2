"""The data of the arc-length method (`kernels.solve.arc_length`), and its columns of a history."""

import numpy as np

from kernels.solve import arc_length
from sweep.array_types import Floats
from sweep.config.case import Case
from sweep.config.kinds.solver import Arcs
from sweep.scene.scene import Scene


def arc_of(scene: Scene, case: Case) -> arc_length.Arc | None:
    """The data of `arc_length.follow`; None with other integrators.

    A node is weighted by its share of the length of all walls.
    """
    if not isinstance(case.solver, Arcs):
        return None
    mesh = scene.mesh
    share = mesh.node_length
    weight = np.zeros(scene.x_rest.size)
    weight[: 2 * len(share)] = np.repeat(share / share.sum(), 2)
    path = np.zeros(case.solver.load_steps + 1, arc_length.POINT)
    return arc_length.Arc(weight, case.solver.arc_length, path)


def path_columns(arc: arc_length.Arc | None, rows: int) -> dict[str, Floats]:
    """History columns of an equilibrium path, (rows,) each; none without arcs."""
    if arc is None:
        return {}
    return {
        "load_factor": arc.path["factor"][:rows].copy(),
        "unstable_modes": arc.path["unstable"][:rows].copy(),
    }

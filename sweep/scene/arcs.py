"""Arcs along the path of a structure: how long they are, and columns of what they found."""

import numpy as np

from kernels.solve import arc_length as arc
from sweep.scene.mesh import Floats
from sweep.config.case import Case, given
from sweep.scene.terms import Scene


def arc_of(scene: Scene, case: Case) -> arc.Arc | None:
    """What `arc.follow` needs, where a path is followed; nodes weigh by their share of walls."""
    if case.solver.integrator != "arc_length":
        return None
    mesh = scene.mesh
    share = mesh.node_length
    weight = np.zeros(scene.x_rest.size)
    weight[: 2 * len(share)] = np.repeat(share / share.sum(), 2)
    path = np.zeros((given(case.solver.load_steps) + 1, 2))
    return arc.Arc(weight, given(case.solver.arc_length), path)


def path_columns(of: arc.Arc | None, rows: int) -> dict[str, Floats]:
    """Columns of a path, (rows,)."""
    if of is None:
        return {}
    return {
        "load_factor": of.path[:rows, arc.FACTOR].copy(),
        "unstable_modes": of.path[:rows, arc.UNSTABLE].copy(),
    }

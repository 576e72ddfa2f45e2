"""Arcs along the path of a structure: how long they are, and columns of what they found."""

import numpy as np

from kernels.solve import arc_length
from sweep.config.case import Case, given
from sweep.scene.mesh import Floats
from sweep.scene.terms import Scene


def arc_of(scene: Scene, case: Case) -> arc_length.Arc | None:
    """What `arc_length.follow` needs, along a path; nodes weigh by their share of walls."""
    if case.solver.integrator != "arc_length":
        return None
    mesh = scene.mesh
    share = mesh.node_length
    weight = np.zeros(scene.x_rest.size)
    weight[: 2 * len(share)] = np.repeat(share / share.sum(), 2)
    path = np.zeros(given(case.solver.load_steps) + 1, arc_length.POINT)
    return arc_length.Arc(weight, given(case.solver.arc_length), path)


def path_columns(of: arc_length.Arc | None, rows: int) -> dict[str, Floats]:
    """Columns of a path, (rows,)."""
    if of is None:
        return {}
    return {
        "load_factor": of.path["factor"][:rows].copy(),
        "unstable_modes": of.path["unstable"][:rows].copy(),
    }

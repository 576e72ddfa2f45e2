"""History columns of a custom structure: its probes and its load factor."""

import numpy as np

from kernels.solve.problem import FREE
from sweep.array_types import Floats
from sweep.config.case import Case
from sweep.config.kinds.custom_loading import CustomLoading
from sweep.config.kinds.custom_structure import CustomStructure
from sweep.scene.scene import Scene

MOVES = ("x_m", "y_m", "rotation_rad")
REACTIONS = ("reaction_x_N", "reaction_y_N", "reaction_moment_Nm")
WITHOUT_PLATENS = ("strain", "top_displacement_m", "reaction_top_N")


def structure_columns(
    history: dict[str, Floats], probed: Floats, scene: Scene, case: Case
) -> dict[str, Floats]:
    """The history with the columns of a custom structure.

    probed (rows, 2, 3 probes): values and reactions, as in `rows.Output`. Reactions act on the
    structure; they are zero where it is free.
    """
    assert isinstance(case.lattice, CustomStructure)
    assert isinstance(case.loading, CustomLoading)
    structure = case.lattice.structure
    blank = np.full(len(probed), np.nan)
    history = history | dict.fromkeys(WITHOUT_PLATENS, blank)
    if structure.floor_y_mm is None:
        history["reaction_bottom_N"] = blank
    if case.solver.integrator == "static":
        history["load_factor"] = history["time_s"] / case.loading.duration
    free = scene.terms.coordinates.role[scene.probes] == FREE
    reactions = np.where(free, 0.0, probed[:, 1])
    for k, node in enumerate(structure.probes):
        for i, move in enumerate(MOVES):
            history[f"probe_{node}_{move}"] = probed[:, 0, 3 * k + i].copy()
        for i, reaction in enumerate(REACTIONS):
            history[f"probe_{node}_{reaction}"] = reactions[:, 3 * k + i].copy()
    return history

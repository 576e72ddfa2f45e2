"""A sweep of any number of crushes, and results invented for them without a simulation."""

from functools import cache

import numpy as np

from sweep.columns import HISTORY_COLUMNS, absorbed_energy_column
from sweep.ranking.curves import reached
from sweep.result import Result, Status, design_columns
from tests.support.results.specimens import HEIGHT, summary, there_and_back

CONFIG = """
name = "scale"
lattice.width = "60 mm"
lattice.height = "60 mm"
loading.mode = "displacement"
loading.allowed_forces = ["{0} N", "{1} N"]
rank.budgets = ["20 g", "40 g"]

[grid]
"lattice.kind" = ["square", "hex", "brick", "triangle", "diamond"]
"lattice.cells_x" = [4, 5, 6, 7, 8, 9, 10, 11, 12, 13]
"lattice.wall_thickness" = [{walls}]
"lattice.depth" = [{depths}]
"""
FORCES = (20.0, 50.0)
OF_A_DEPTH = 1000  # cases
ROWS = 200  # of a curve, each way
FRAMES, NODES = 41, 49
SECONDS = 0.05  # that a case is said to have taken
STOPPED = 0.02  # share of the cases


def write_config(folder, count):
    """The config of a sweep of ``count`` cases, a multiple of `OF_A_DEPTH`; returns its path."""
    walls, depths = (
        ", ".join(f'"{value:.6g} mm"' for value in np.linspace(*ends))
        for ends in ((0.4, 1.1, 20), (10.0, 30.0, count // OF_A_DEPTH))
    )
    path = folder / "scale.toml"
    path.write_text(CONFIG.format(*FORCES, walls=walls, depths=depths), "utf-8")
    return path


@cache
def _template():
    """A row, curves and shapes; every invented result has the same with other forces."""
    (row,) = summary({"peak_strain": 0.4, "height_m": HEIGHT}).to_dict("records")
    return row, there_and_back(ROWS), _shapes()


def _shapes():
    """A square of nodes in a chain that is pressed to 60 % of its height."""
    side = int(NODES**0.5)
    points = 1e-3 * np.stack(np.meshgrid(*2 * [np.arange(side)]), axis=-1).reshape(-1, 2)
    strain = np.linspace(0.0, 0.4, FRAMES)
    position = np.array([points * [1.0, 1.0 - pressed] for pressed in strain])
    return {
        "strain": strain,
        "time_s": strain,
        "position_m": position,
        "edges": np.column_stack([np.arange(NODES - 1), np.arange(1, NODES)]),
        "edge_thickness_m": np.full(NODES - 1, 5e-4),
        "plate_y_m": np.column_stack([0.0 * strain, 1e-3 * (side - 1) * (1.0 - strain)]),
    }


def invent(case, _=None):
    """The template with a mass and forces of its own, drawn by the id; some cases stop halfway."""
    row, curve, frames = _template()
    rng, lattice = np.random.default_rng(int(case.case_id, 16)), case.lattice
    size, length = lattice.wall_thickness / 0.8e-3, lattice.depth / 20e-3
    mass = 30.0 * size * length * rng.uniform(0.9, 1.1)
    strength = size**2.5 * length * rng.uniform(0.5, 1.5)
    stopped = rng.random() < STOPPED
    curve = curve[: ROWS // 2] if stopped else curve
    forced = [name for name in HISTORY_COLUMNS if name.endswith(("_J", "_N"))]
    curve = curve.assign(**{name: strength * curve[name] for name in forced})
    strain, force = (float(curve[name].max()) for name in ("strain", "reaction_top_N"))
    whole = float(curve["work_in_J"].max())
    energies = {absorbed_energy_column(limit): reached(curve, limit)[0] for limit in FORCES}
    for point in ("", "_at_densification", "_until_packed", "_within_model"):
        energies[f"absorbed_energy{point}_J"] = whole
    forces = {f"peak_force{point}_N": force for point in ("", "_at_densification", "_until_packed")}
    values = row | design_columns(case) | energies | forces
    values |= {"mass_g": mass, "cpu_s": SECONDS, "loaded": int(not stopped), "peak_strain": strain}
    values |= {"specific_absorption_J_per_g": whole / mass}
    for name in ("case_id", "status", "message"):
        del values[name]
    how = (Status.CONVERGED, "")
    if stopped:
        at = f"{strain:.3g} after {ROWS // 2} steps"
        how = (Status.STOPPED, f"no equilibrium while loading, at strain {at}; why")
    history = {name: curve[name].to_numpy() for name in curve}
    return Result(case, *how, values, history, frames)

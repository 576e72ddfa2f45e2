"""What a crush was worth: history columns, energies, plateau, densification, crossings."""

import numpy as np
from shapely import STRtree, linestrings

from kernels import march
from sweep.lattice import mass, relative_density
from sweep.mesh import Floats
from sweep.params import Case
from sweep.result import absorbed_energy_column, design_columns
from sweep.scene import Scene

BOOK = {
    "work_in_J": march.WORK,
    "kinetic_J": march.KINETIC,
    "stretch_J": march.STRETCH,
    "bend_J": march.BEND,
    "contact_J": march.CONTACT,
    "dissipated_material_J": march.MATERIAL,
    "dissipated_friction_J": march.FRICTION,
    "dissipated_integrator_J": march.INTEGRATOR,
    "energy_residual_J": march.RESIDUAL,
}
DISSIPATED = ("dissipated_material_J", "dissipated_friction_J", "dissipated_integrator_J")
PLATEAU_START = 0.05  # strain from which a plateau is averaged at the earliest


def history_columns(rows: Floats, scene: Scene, case: Case) -> dict[str, Floats]:
    """Columns of the history from the rows that the march wrote, (rows, N_COLUMNS)."""
    travel = rows[0, march.HEIGHT] - rows[:, march.HEIGHT]
    gap = np.where(np.isfinite(rows[:, march.GAP]), rows[:, march.GAP], np.nan)
    return {
        "time_s": rows[:, march.TIME].copy(),
        "strain": travel / case.lattice.height,
        "top_displacement_m": travel,
        "reaction_top_N": rows[:, march.REACTION_TOP].copy(),
        "reaction_bottom_N": rows[:, march.REACTION_BOTTOM].copy(),
        **{name: rows[:, column].copy() for name, column in BOOK.items()},
        "injected_by_projection_J": np.zeros(len(rows)),
        "newton_iterations": np.diff(rows[:, march.ITERATIONS_DONE], prepend=0.0),
        "min_gap_m": gap,
    }


def absorbed_until(force: float, transmitted: Floats, work: Floats) -> float:
    """Work in J done until ``transmitted`` (rows,) first exceeds ``force`` (N), interpolated."""
    over = np.flatnonzero(transmitted > force)
    if len(over) == 0:
        return float(work[-1])
    k = over[0]
    if k == 0:
        return float(work[0])
    share = (force - transmitted[k - 1]) / (transmitted[k] - transmitted[k - 1])
    return float(work[k - 1] + share * (work[k] - work[k - 1]))


def efficiency(strain: Floats, stress: Floats, work_density: Floats) -> Floats:
    """Energy-absorption efficiency: work density / largest stress so far, (rows,).

    Its maximum marks densification (Miltz & Gruenbaum 1981; Li, Magkiriadis & Harrigan 2006).
    """
    largest = np.maximum.accumulate(np.abs(stress))
    safe = np.where(largest > 0, largest, 1.0)
    return np.where(largest > 0, work_density / safe, 0.0)


def plateau(case: Case, strain: Floats, force: Floats, work: Floats) -> dict[str, float]:
    """Plateau stress (mean stress up to densification), densification strain and efficiency."""
    lattice = case.lattice
    area = (lattice.width + lattice.wall_thickness) * lattice.depth
    stress, density = force / area, work / (area * lattice.height)
    gained = efficiency(strain, stress, density)
    densified = int(np.argmax(gained))
    begun = int(np.searchsorted(strain, min(PLATEAU_START, 0.5 * strain[densified])))
    mean = np.nan
    if strain[densified] > strain[begun]:
        mean = (density[densified] - density[begun]) / (strain[densified] - strain[begun])
    return {
        "plateau_stress_Pa": float(mean),
        "densification_strain": float(strain[densified]),
        "efficiency": float(gained[densified]),
    }


def summarise(
    case: Case, scene: Scene, history: dict[str, Floats], loading_rows: int
) -> dict[str, float | int | str]:
    """Summary columns of a run from its history, whose first ``loading_rows`` rows are loading."""
    down = slice(0, min(loading_rows, len(history["strain"])))
    work, strain = history["work_in_J"], history["strain"]
    force = np.maximum(history["reaction_top_N"], history["reaction_bottom_N"])
    absorbed = float(work[down][-1])
    grams = 1e3 * mass(scene.network, case.lattice.depth, case.material.density)
    gaps = history["min_gap_m"][np.isfinite(history["min_gap_m"])]
    summary: dict[str, float | int | str] = {
        **design_columns(case),
        "mass_g": grams,
        "relative_density": relative_density(scene.network),
        "absorbed_energy_J": absorbed,
        "returned_energy_J": absorbed - float(work[-1]),
        "dissipated_energy_J": float(sum(history[name][-1] for name in DISSIPATED)),
        "dissipated_integrator_J": float(history["dissipated_integrator_J"][-1]),
        "energy_residual_J": float(history["energy_residual_J"][-1]),
        "specific_absorption_J_per_g": absorbed / grams,
        "peak_force_N": float(force.max()),
        "peak_strain": float(strain.max()),
        "residual_strain": float(strain[-1]),
        "min_gap_m": float(gaps.min()) if len(gaps) else np.nan,
    }
    summary |= {
        absorbed_energy_column(allowed): absorbed_until(allowed, force[down], work[down])
        for allowed in case.loading.allowed_forces or ()
    }
    return summary | plateau(case, strain[down], history["reaction_top_N"][down], work[down])


def crossings(frames: dict[str, Floats]) -> int:
    """Largest number of pairs of elements that pass through one another in any stored shape.

    Independent of the solver: shapely's exact predicates on the centre lines.
    """
    edges = frames["edges"]
    worst = 0
    for position in frames["position_m"]:
        lines = linestrings(position[edges])
        one, two = STRtree(lines).query(lines, predicate="intersects")
        apart = (one < two) & ~np.any(edges[one][:, :, None] == edges[two][:, None, :], axis=(1, 2))
        worst = max(worst, int(apart.sum()))
    return worst

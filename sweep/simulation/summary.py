"""Measures a run: columns of history, energies, plateau, densification and shapes."""

import numpy as np

from sweep.array_types import Floats
from sweep.columns import absorbed_energy_column
from sweep.config.case import Case
from sweep.config.kinds.crush import Crush
from sweep.config.kinds.custom_loading import CustomLoading
from sweep.config.kinds.dead_load import DeadLoad
from sweep.config.kinds.impact import Impact
from sweep.config.kinds.material import Material
from sweep.config.kinds.sliced import Sliced
from sweep.config.kinds.sliced_sheet import SlicedSheet
from sweep.config.kinds.table import given_or
from sweep.design.slicer.network import extruded_area
from sweep.numbers import in_unit
from sweep.result import design_columns
from sweep.scene.loading import CycleRows
from sweep.scene.plates.scene import Scene as PlateScene
from sweep.scene.scene import Scene
from sweep.simulation.base_load import base_columns, force_on_support, patch_width
from sweep.simulation.between_rows import between_rows
from sweep.simulation.cycles import columns_of_cycles
from sweep.simulation.densification import (
    efficiency,
    last_row,
    near_maxima,
    packed_row,
    span,
    weights,
)
from sweep.simulation.filter_class import without_blows
from sweep.simulation.iso_13314 import figures
from sweep.simulation.load_step_error import load_step_error, peak_step_error
from sweep.simulation.plate_shapes import surface_crossings
from sweep.simulation.shape_checks import (
    Frames,
    Strains,
    crossings,
    kept_area,
    moment_of,
    shortening,
    work_within_model,
)
from sweep.simulation.solid import drawn_mass, filled
from sweep.simulation.striker import (
    brought,
    rebound,
    striker_columns,
    striker_curves,
    work_on_lattice,
)
from sweep.simulation.time_resolution import integrator_share, known_peak, path_error
from sweep.simulation.up_to_force import absorbed_until

BOOK_COLUMNS = {
    "work_in_J": "work",
    "kinetic_J": "kinetic",
    "stretch_J": "stretch",
    "bend_J": "bend",
    "contact_J": "contact",
    "dissipated_material_J": "material",
    "dissipated_friction_J": "friction",
    "dissipated_integrator_J": "integrator",
    "injected_by_projection_J": "injected",
    "energy_residual_J": "residual",
}
"""Columns of the energy book, with their names in `kernels.shared.rows.ROW`."""
DISSIPATED = ("dissipated_material_J", "dissipated_friction_J", "dissipated_integrator_J")
PEAKS = ("peak_force_at_densification_N", "peak_force_until_packed_N")
TOUCHING = ("contact_J", "injected_by_projection_J")
OF_A_CRUSH = (
    "plateau_stress_Pa",
    "densification_strain",
    "packing_strain",
    "packing_span",
    "lowest_densification_strain",
    "highest_densification_strain",
    "lowest_absorbed_energy_at_densification_J",
    "highest_absorbed_energy_at_densification_J",
    "efficiency",
    "plateau_stress_iso_Pa",
    "plateau_stress_20_30_Pa",
    "plateau_end_strain",
    "quasi_elastic_gradient_Pa",
    "energy_to_50_J_per_m3",
    "efficiency_to_50",
    "energy_to_plateau_end_J_per_m3",
    "efficiency_to_plateau_end",
)
OF_THE_WHOLE_RUN = (
    *("returned_energy_J", "lost_energy_J", "lost_share", "lost_energy_J_per_g"),
    *("dissipated_energy_J", *DISSIPATED, "residual_strain", "second_cycle_share"),
    *("rebound_speed_m_per_s", "rebound_share"),
    *("target_speed_m_per_s", "base_impulse_Ns"),
)
"""Columns that need a run to its end: on unloading, and on losses until then."""
ROUND_OFF = 1e-9
PLATEAU_START = 0.05  # strain where the mean up to densification starts


def history_columns(rows: np.ndarray, case: Case) -> dict[str, Floats]:
    """Columns of the history, (rows,) each, from the rows of the march, (rows,) of `rows.ROW`."""
    travel = rows["height"][0] - rows["height"]
    # An endless lattice has one mean stress, so that both reactions are equal.
    below = "reaction_top" if case.lattice.endless else "reaction_bottom"
    time, loading, struck = rows["time"].copy(), case.loading, {}
    if isinstance(loading, Impact):
        struck = striker_curves(loading, time, rows["speed"], rows["base_speed"])
    return {
        "time_s": time,
        "strain": travel / (case.height or np.nan),
        "top_displacement_m": travel,
        "reaction_top_N": rows["reaction_top"].copy(),
        "reaction_bottom_N": rows[below].copy(),
        **{column: rows[name].copy() for column, name in BOOK_COLUMNS.items()},
        "newton_iterations": np.diff(rows["iterations"], prepend=0.0),
        "min_gap_m": np.where(np.isfinite(rows["gap"]), rows["gap"], np.nan),
        "base_pressure_Pa": rows["patch_force"] / (patch_width(case) * case.lattice.depth),
        "base_pressure_x_m": rows["patch_at"].copy(),
    } | struck


def plateau_stress(strain: Floats, density: Floats, row: int) -> float:
    """Mean stress (Pa) from about 5 % strain, or from half of a shorter crush, to a row.

    strain and density (work per volume, Pa): (rows,).
    """
    first = int(np.searchsorted(strain, min(PLATEAU_START, 0.5 * strain[row])))
    if strain[row] <= strain[first]:
        return np.nan
    return float((density[row] - density[first]) / (strain[row] - strain[first]))


def peaks_of(case: Case, rows: np.ndarray) -> tuple[float, float]:
    """Greatest strain and lower reaction (N) in the rows and all their shares."""
    travel = rows["height"][0] - rows["least_height"].min()
    return float(travel / (case.height or np.nan)), float(rows["most_force"].max())


def summarise(  # noqa: PLR0913  of one case each
    case: Case,
    scene: Scene | PlateScene,
    history: dict[str, Floats],
    frames: Frames,
    strains: Strains,
    cycles: list[CycleRows],
    peaks: tuple[float, float],
) -> dict[str, float | int | str]:
    """Summary columns of a run.

    cycles: rows at which each cycle is loaded and unloaded; energies and the curve of the loading
    belong to the first cycle. peaks: from `peaks_of`.
    """
    curves = history | {"work_in_J": work_on_lattice(case, history)}
    if moves(case):
        curves |= without_blows(history)
    elif isinstance(case.loading, Impact):
        curves["reaction_bottom_N"] = force_on_support(case.loading, history)
    loading = {name: column[: cycles[0].loaded + 1] for name, column in curves.items()}
    drawn = in_unit(drawn_mass(case, scene), "g")
    printed = printed_mass(case)
    grams = drawn if np.isnan(printed) else printed
    absorbed = float(loading["work_in_J"][-1])
    supplied = brought(case.loading, history) if isinstance(case.loading, Impact) else absorbed
    force = transmitted(case, curves)
    strain = max(peaks[0], float(history["strain"].max()))
    peak = greatest_force(case, curves, peaks[1])
    is_whole = np.isnan(peak) or isinstance(case.loading, DeadLoad | Impact)
    gaps = history["min_gap_m"][np.isfinite(history["min_gap_m"])]
    full = filled(case, scene)
    return {
        **design_columns(case),
        "mass_g": drawn,
        "printed_mass_g": printed,
        "relative_density": full,
        "solid_strain": 1.0 - full if case.shells else np.nan,
        "absorbed_energy_J": absorbed,
        **lost_columns(supplied, returned(case, history, cycles[0]), grams),
        "dissipated_energy_J": float(sum(history[name][-1] for name in DISSIPATED)),
        **{name: float(history[name][-1]) for name in DISSIPATED},
        "integrator_share": integrator_share(case.loading, loading if moves(case) else history),
        "path_error": path_error(case, history, strain),
        "load_step_error": load_step_error(case, loading),
        "peak_step_error": peak_step_error(case, loading),
        "injected_by_projection_J": float(history["injected_by_projection_J"][-1]),
        "energy_residual_J": float(history["energy_residual_J"][-1]),
        "specific_absorption_J_per_g": absorbed / grams,
        "peak_force_N": peak,
        "peak_strain": strain,
        "solid_joint_share": scene.solid_joint_share if case.solver.joints == "solid" else np.nan,
        "min_gap_m": float(gaps.min()) if len(gaps) else np.nan,
        "touched": int(any(np.any(history[name] != 0.0) for name in TOUCHING)),
        **columns_of_cycles(cycles, history["work_in_J"], force),
        **striker_columns(case, scene, history, strain * case.height),
        **base_columns(case, history),
        **crush_columns(case, loading),
        **(dict.fromkeys(PEAKS, peak) if is_whole else {}),
        **shape_columns(case, scene, frames, strains, loading),
    }


def printed_mass(case: Case) -> float:
    """Mass as a slicer extrudes it, g; NaN without a slicer."""
    lattice = case.lattice
    if isinstance(lattice, SlicedSheet):
        return in_unit(case.material.density * lattice.extruded, "g")
    if not isinstance(lattice, Sliced):
        return np.nan
    volume = lattice.depth * extruded_area(lattice.geometry)
    return in_unit(case.material.density * volume, "g")


def returned(case: Case, history: dict[str, Floats], cycle: CycleRows) -> float:
    """Work given back in a cycle to a platen or a striker that moves back up, J; NaN if nothing
    does.
    """
    if isinstance(case.loading, Impact):
        thrown = rebound(case.loading, history).energy
        return thrown + brought(case.loading, history) - case.loading.relative_energy
    work = history["work_in_J"][cycle.released : cycle.ended + 1]
    if isinstance(case.loading, DeadLoad) or len(work) < 2:
        return np.nan
    return float(work[0] - work[-1])


def lost_columns(supplied: float, back: float, grams: float) -> dict[str, float]:
    """Columns of the returned and the lost energy.

    supplied, back: work done, or brought by a striker, and work given back, J; negative if a glued
    platen has to pull the lattice back, which is no loss of the loading. grams: mass of the
    specimen, g.
    """
    lost = supplied - np.maximum(back, 0.0)  # NaN stays NaN
    return {
        "returned_energy_J": back,
        "lost_energy_J": float(lost),
        "lost_share": float(lost / supplied) if supplied else np.nan,
        "lost_energy_J_per_g": float(lost / grams),
    }


def moves(case: Case) -> bool:
    """Whether a platen crushes at a speed."""
    return isinstance(case.loading, Crush) and not case.loading.quasi_static


def greatest_force(case: Case, history: dict[str, Floats], most: float) -> float:
    """Greatest force on a platen, or of an impact on the support, N; NaN without platens, or if
    time steps are too long for it. most: from `peaks_of`.
    """
    loading = case.loading
    if isinstance(loading, CustomLoading):
        return np.nan  # its reactions are at its probes
    force = transmitted(case, history)
    if isinstance(loading, Impact):
        return float(force.max())
    if not moves(case):
        return known_peak(case, force, most)
    assert isinstance(loading, Crush)
    return float(force.max()) if loading.resolves_peaks(case.solver) else np.nan


def transmitted(case: Case, history: dict[str, Floats]) -> Floats:
    """The greater force of the two platens, (rows,) N; for an impact, the force on the support."""
    if isinstance(case.loading, Impact):
        return history["reaction_bottom_N"]
    return np.fmax(history["reaction_top_N"], history["reaction_bottom_N"])


def crush_columns(case: Case, loading: dict[str, Floats]) -> dict[str, float]:
    """Columns from the force-displacement curve of the loading; only a crush can densify."""
    force, work = transmitted(case, loading), loading["work_in_J"]
    until = {  # from the rows, as the stored curve gives it for any other force
        absorbed_energy_column(allowed): absorbed_until(allowed, force, work)
        for allowed in case.loading.allowed_forces
    }
    if isinstance(case.loading, Crush):
        loading = between_rows(loading)
    work, force = loading["work_in_J"], transmitted(case, loading)
    row, share = len(work) - 1, last_row(len(work))
    columns = dict.fromkeys(OF_A_CRUSH, np.nan)
    if isinstance(case.loading, Crush):
        row, share, columns = packing_columns(case, loading)
    peak = np.maximum.accumulate(force)
    columns |= {
        "absorbed_energy_at_densification_J": float(work[row]),
        "absorbed_energy_until_packed_J": float(share @ work),
        "peak_force_at_densification_N": float(peak[row]),
        "peak_force_until_packed_N": float(share @ peak),
    }
    return columns | ratios(case, loading, columns) | until


def ratios(case: Case, loading: dict[str, Floats], columns: dict[str, float]) -> dict[str, float]:
    """Ideality and cushion factor until densification (Miltz & Gruenbaum 1981), and mean force
    / greatest force of the whole loading; NaN under a dead load, or without any force.

    columns: values until densification; `packing_strain` is NaN unless the mode is displacement.
    """
    height = case.height or np.nan
    strain, greatest = loading["strain"].max(), transmitted(case, loading).max()
    work, peak = columns["absorbed_energy_until_packed_J"], columns["peak_force_until_packed_N"]
    driven = isinstance(case.loading, Crush | Impact)
    brought = greatest * strain * height if driven else np.nan
    packed = peak * columns["packing_strain"] * height
    return {
        "ideality": work / packed if packed > 0.0 else np.nan,
        "cushion_factor": peak * height / work if packed > 0.0 and work > 0.0 else np.nan,
        "crush_force_efficiency": loading["work_in_J"][-1] / brought if brought > 0.0 else np.nan,
    }


def packing_columns(case: Case, loading: dict[str, Floats]) -> tuple[int, Floats, dict[str, float]]:
    """The row of densification, the `weights` of the rows, and the columns `OF_A_CRUSH`.

    Without densification the row is the last one.
    """
    width, depth = case.footprint
    area = width * depth
    strain, density = loading["strain"], loading["work_in_J"] / (area * case.height)
    stress = loading["reaction_top_N"] / area
    eta = efficiency(stress, density)
    packed, share = packed_row(eta), weights(strain, eta)
    row = len(strain) - 1 if packed is None else packed
    maxima = near_maxima(eta)
    ends = [strain[end] for end in (min(maxima, default=row), max(maxima, default=row))]
    if packed is None:  # the efficiency is greatest at the end
        ends = [ends[0] if maxima else np.nan, np.nan]
    energies = loading["work_in_J"][[*maxima, row]]
    values = (
        plateau_stress(strain, density, row),
        np.nan if packed is None else strain[row],
        share @ strain,
        span(strain, eta),
        *ends,
        *(energies.min(), energies.max()),
        eta[row],
        *figures(strain, stress, density).values(),
    )
    return row, share, dict(zip(OF_A_CRUSH, map(float, values), strict=True))


def shape_columns(
    case: Case,
    scene: Scene | PlateScene,
    frames: Frames,
    strains: Strains,
    loading: dict[str, Floats],
) -> dict[str, float | int]:
    """Columns from the stored shapes, and the work done while the model holds."""
    least, greatest, surface = strains
    columns = {
        "residual_strain": np.nan,
        "least_element_strain": float(least.min()),
        "greatest_element_strain": float(greatest.max()),
        "kept_area": np.nan,
        "greatest_fibre_strain": float(surface.max()),
        "broke_at_strain": np.nan,
        "stretch_over_curve": stretch_over_curve(case.material, strains),
    }
    if isinstance(scene, PlateScene):
        return columns | plate_columns(case, scene, frames, loading)
    return columns | wall_columns(case, scene, frames, strains, loading)


def plate_columns(
    case: Case, scene: PlateScene, frames: Frames, loading: dict[str, Floats]
) -> dict[str, float | int]:
    """The columns of plates among `shape_columns`.

    The work within the model counts until the walls, whose volume is constant, fill the pressed
    area.
    """
    solid = 1.0 - filled(case, scene)
    strain, work = loading["strain"], loading["work_in_J"]
    within = work[-1] if strain[-1] <= solid else np.interp(solid, strain, work)
    height = np.ptp(frames["position_m"][..., 2], axis=1)
    return {
        "residual_strain": float(1.0 - height[-1] / height[0]),
        "absorbed_energy_within_model_J": float(within),
        "max_crossings": surface_crossings(frames["position_m"], scene.mesh),
    }


def wall_columns(
    case: Case, scene: Scene, frames: Frames, strains: Strains, loading: dict[str, Floats]
) -> dict[str, float | int]:
    """The columns of walls in the plane among `shape_columns`."""
    network, (least, _, surface) = scene.network, strains
    limit = given_or(case.material.fracture_strain, np.inf)
    broken = moment_of(surface.max(axis=1), limit, frames["time_s"])
    broke_at = np.interp(broken, loading["time_s"], loading["strain"])
    walls = np.concatenate([frames["edges"], scene.around])
    return {
        "residual_strain": shortening(frames, network.bottom, network.top),
        "kept_area": kept_area(frames),
        "broke_at_strain": float("nan") if np.isnan(broken) else float(broke_at),
        "absorbed_energy_within_model_J": work_within_model(
            least, broken, frames["time_s"], loading["time_s"], loading["work_in_J"]
        ),
        "max_crossings": crossings({**frames, "edges": walls}),
    }


def stretch_over_curve(material: Material, strains: Strains) -> float:
    """Greatest stretch for which the curve of a material gives the stress / last strain of the
    curve; the stretch of surfaces counts if bending follows the curve.

    NaN without a curve.
    """
    if not material.curve_strain:
        return float("nan")
    counted = strains[2] if material.through_fibres else strains[1]
    return float(counted.max()) / max(material.curve_strain)

"""The columns of results: units and a description of each.

`COLUMNS` has the columns of a summary, `HISTORY_COLUMNS` the columns of a curve. Columns of
energies up to a force, of cycles, errors and the like have derived names.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Literal

from sweep.loading_modes import MODES


@dataclass(frozen=True)
class Column:
    """Meaning of a column: its units ("1" for a pure number, "" for text) and a sentence.

    better: whether more or less of it makes a design better; None: neither.
    """

    units: str
    description: str
    better: Literal["more", "less"] | None = None


ALONG = "out_of_plane"  # a value of the column `direction`
TIED_SIDES = "tied"
"""First word of the column `sides` if the sides are tied to each other."""
SAME_EFFICIENCY = 0.02
"""Share of the greatest efficiency within which two strains of densification are as good."""

COLUMNS: dict[str, Column] = {
    "case_id": Column("", "hash of all parameters of the case"),
    "status": Column("", "converged, stopped, slipped, timed_out, unresolved or worker_died"),
    "message": Column(
        "", "why the case did not converge and what to try, or where it broke; else empty"
    ),
    "retry": Column(
        "",
        "what was changed in the retry that gave these numbers, because the original case stopped; "
        "empty if nothing was",
    ),
    "loaded": Column(
        "1",
        "1 if the first loading was completed, with energies that balance: full stroke, release, "
        "or the striker's stop; what it determines is ranked, whatever stopped the case later",
    ),
    "lattice_kind": Column(
        "", "family of the infill pattern, or pattern of the slicer, or file of a drawing"
    ),
    "cells_x": Column("1", "cells across the width"),
    "cells_y": Column("1", "cells over the height"),
    "wall_thickness_m": Column("m", "thickness of a wall"),
    "infill_share": Column("1", "share of infill in a slicer's words; NaN without lattice.slicer"),
    "slicer_settings": Column(
        "", "settings of the slicer; those nearest to a design without one, if there are any"
    ),
    "does_not_print": Column(
        "",
        "walls that are not a multiple of the line width, and narrower gaps; empty if all prints",
    ),
    "sides": Column(
        "",
        "free, tied or endless (lattice.sides, lattice.boundary); tied: the width of the period is "
        "fixed or free, and masses, forces and energies are those of one period",
    ),
    "direction": Column("", "in_plane: pressed across the cells; out_of_plane: along them"),
    "width_m": Column("m", "width over centre lines"),
    "height_m": Column(
        "m", "height that is pressed: over centre lines; along the cells, lattice.depth"
    ),
    "depth_m": Column(
        "m", "depth of the pressed area: of the walls; along the cells, height of the plan over all"
    ),
    "outer_width_m": Column("m", "width over all, walls included"),
    "material": Column("", 'name of the material; "by numbers" if it has none'),
    "material_modulus_Pa": Column(
        "Pa", "modulus of the material, to which figures of foams and lattices are related"
    ),
    "material_memory": Column(
        "", "what walls do that springs do not: relaxes, softens, yields; none if they are elastic"
    ),
    "loading_mode": Column("", ", ".join(MODES)),
    "platen": Column("", "none, contact, glued, sliding or clamped"),
    "striker": Column(
        "", "flat, or the shape that hits the whole depth of the lattice as a line, and where"
    ),
    "base": Column("", "flat, or the ribs on which the lattice lies"),
    "force_N": Column("N", "dead load on the top; NaN unless the mode is force"),
    "stroke_m": Column("m", "prescribed travel of the top; NaN unless the mode is displacement"),
    "striker_mass_g": Column("g", "mass of the striker; NaN unless the mode is impact"),
    "striker_speed_m_per_s": Column(
        "m/s", "speed of the striker at first contact; NaN unless the mode is impact"
    ),
    "impact_energy_J": Column(
        "J", "energy of the striker at first contact; NaN unless the mode is impact"
    ),
    "gravity": Column(
        "",
        "1 if the weight of the striker acts on the lattice, else 0; NaN unless the mode is impact",
    ),
    "target_mass_g": Column(
        "g", "mass of the base, if it moves freely away from the hit; NaN: the base is fixed"
    ),
    "contact_model": Column("", "how walls touch: none, barrier or position_based"),
    "mass_g": Column("g", "density x exact area of the printed walls x depth", "less"),
    "printed_mass_g": Column(
        "g",
        "mass as the slicer extrudes it, crossings twice; budgets and columns per gram count it; "
        "NaN without lattice.slicer",
        "less",
    ),
    "relative_density": Column("1", "printed area / area of the bounding box", "less"),
    "solid_strain": Column(
        "1",
        "strain at which walls of constant volume fill the pressed area, 1 - relative density, "
        "beyond which the plate model does not hold; NaN across the cells",
        "more",
    ),
    "absorbed_energy_J": Column(
        "J", "work done on the lattice until release, full stroke or stop", "more"
    ),
    "absorbed_energy_at_densification_J": Column(
        "J", "work done until densification; all of it if there is no densification", "more"
    ),
    "absorbed_energy_until_packed_J": Column(
        "J",
        "work done so far, mean over strains of nearly the greatest efficiency; all of it unless "
        "the mode is displacement",
        "more",
    ),
    "absorbed_energy_within_model_J": Column(
        "J",
        "work done until an element is shorter than 0.7 of its rest length or a wall breaks, along "
        "the cells until the strain is solid_strain; all of it if none of this happens",
        "more",
    ),
    "returned_energy_J": Column(
        "J",
        "work returned to the platen or striker as it moves back, less the work of a glued platen "
        "that pulls; NaN if none moves back",
        "less",
    ),
    "dissipated_energy_J": Column(
        "J", "dissipated by material, friction and time integrator", "more"
    ),
    "dissipated_material_J": Column(
        "J", "dissipated by the material and its damping in the whole run", "more"
    ),
    "dissipated_friction_J": Column("J", "dissipated by friction in the whole run", "more"),
    "dissipated_integrator_J": Column("J", "energy removed by the time integrator itself"),
    "integrator_share": Column(
        "1",
        "greatest energy that the time integrator has removed or created / greatest work: a "
        "measure of the error of the time steps; NaN in statics",
        "less",
    ),
    "path_error": Column(
        "1",
        "greatest local error of the time steps in the path of the top down under a dead load, or "
        "solver.step_error, / the length of that path; NaN of other loadings",
        "less",
    ),
    "load_step_error": Column(
        "1",
        "estimated error of the load steps in the work of a quasi-static crush / that work; NaN of "
        "other loadings",
        "less",
    ),
    "peak_step_error": Column(
        "1",
        "estimated error of the load steps of a quasi-static crush in a peak of the force that no "
        "force before it exceeds / that peak; NaN of other loadings",
        "less",
    ),
    "lost_energy_J": Column(
        "J",
        "absorbed energy - returned energy, if that is positive; of an impact, energy of the "
        "striker at first touch - that of its rebound, with work of its weight; NaN if none moves "
        "back",
        "more",
    ),
    "lost_share": Column(
        "1",
        "lost energy / absorbed energy; of an impact, / energy of the striker at first contact and "
        "work of its weight until it stops",
        "more",
    ),
    "lost_energy_J_per_g": Column("J/g", "lost energy / mass, as extruded if known", "more"),
    "second_cycle_share": Column(
        "1", "energy absorbed in the second cycle / in the first; NaN with a single cycle", "more"
    ),
    "injected_by_projection_J": Column(
        "J",
        "energy added between steps, by position-based contact or by contact of walls that thicken "
        "(pressed along their cells); negative if energy is removed",
    ),
    "energy_residual_J": Column("J", "residual of the energy book"),
    "specific_absorption_J_per_g": Column(
        "J/g", "absorbed energy / mass, as extruded if known", "more"
    ),
    "plateau_stress_Pa": Column(
        "Pa",
        "mean nominal stress from about 5 % strain to densification or the end; NaN for dead loads",
        "more",
    ),
    "plateau_stress_iso_Pa": Column(
        "Pa",
        "mean nominal stress from 20 to 40 % strain (ISO 13314); NaN for dead loads and shorter "
        "crushes",
        "more",
    ),
    "plateau_stress_20_30_Pa": Column(
        "Pa",
        "mean nominal stress from 20 to 30 % strain, the other mean of ISO 13314; NaN for dead "
        "loads and shorter crushes",
        "more",
    ),
    "plateau_end_strain": Column(
        "1",
        "first strain beyond 20 % where the stress rises to 1.3 x plateau_stress_iso_Pa "
        "(ISO 13314); NaN for dead loads and shorter crushes",
        "more",
    ),
    "quasi_elastic_gradient_Pa": Column(
        "Pa",
        "slope of the first rise of the stress, from 20 to 70 % of plateau_stress_iso_Pa "
        "(ISO 13314); NaN for dead loads and shorter crushes",
    ),
    "energy_to_50_J_per_m3": Column(
        "J/m^3",
        "work per volume up to 50 % strain (ISO 13314); NaN for dead loads and shorter crushes",
        "more",
    ),
    "efficiency_to_50": Column(
        "1", "energy_to_50_J_per_m3 / (greatest stress up to there x 50 %), of ISO 13314", "more"
    ),
    "energy_to_plateau_end_J_per_m3": Column(
        "J/m^3",
        "work per volume up to plateau_end_strain (ISO 13314); NaN for dead loads and shorter "
        "crushes",
        "more",
    ),
    "efficiency_to_plateau_end": Column(
        "1",
        "energy_to_plateau_end_J_per_m3 / (greatest stress up to there x plateau_end_strain), of "
        "ISO 13314",
        "more",
    ),
    "densification_strain": Column(
        "1",
        "strain of greatest efficiency; NaN if the efficiency still rises, and for dead loads",
        "more",
    ),
    "packing_strain": Column(
        "1", "mean of the strains of nearly the greatest efficiency; NaN for dead loads", "more"
    ),
    "packing_span": Column(
        "1",
        "from the first to the last strain with an efficiency within 2 % of the greatest; if it is "
        "long, densification_strain is uncertain; NaN for dead loads",
    ),
    "lowest_densification_strain": Column(
        "1",
        "least strain of a maximum of the efficiency within 2 % of the greatest; NaN if there is "
        "none before the end of the crush",
    ),
    "highest_densification_strain": Column(
        "1",
        "the greatest such strain; beyond lowest_densification_strain if there are two maxima, NaN "
        "as for densification_strain",
    ),
    "lowest_absorbed_energy_at_densification_J": Column(
        "J", "least work done until a maximum of the efficiency within 2 % of the greatest"
    ),
    "highest_absorbed_energy_at_densification_J": Column(
        "J", "the greatest such work; with two maxima, ranks treat the energy as this range"
    ),
    "efficiency": Column(
        "1", "greatest ratio of work per volume to peak stress so far; NaN for dead loads", "more"
    ),
    "ideality": Column(
        "1",
        "energy / (greatest force x stroke), all three until densification (Miltz & Gruenbaum "
        "1981); NaN for dead loads and impacts",
        "more",
    ),
    "cushion_factor": Column(
        "1",
        "greatest stress / energy per volume, both until densification (Miltz & Gruenbaum 1981); "
        "NaN for dead loads and impacts",
        "less",
    ),
    "crush_force_efficiency": Column(
        "1", "mean force / greatest force of the whole loading; NaN for dead loads", "more"
    ),
    "peak_force_N": Column(
        "N",
        "greatest force on a platen or support; in an impact on the support, filtered with "
        "loading.filter_class, in a crush with a speed with class 1000; NaN of a "
        "custom structure, and where time steps of a dead load or of a crush with a speed are too "
        "long for its peak",
        "less",
    ),
    "peak_force_at_densification_N": Column(
        "N", "greatest force on a platen or support until densification or release", "less"
    ),
    "peak_force_until_packed_N": Column(
        "N",
        "greatest force on a platen or support so far, mean over strains of nearly the greatest "
        "efficiency; of the whole loading unless the mode is displacement",
        "less",
    ),
    "peak_base_pressure_Pa": Column(
        "Pa",
        "greatest force on a patch of the base, loading.base_patch wide, / its area; NaN along the "
        "cells, on ribs, of a lattice that repeats, of a custom structure, and of a dead load as "
        "peak_force_N",
        "less",
    ),
    "peak_base_pressure_x_m": Column(
        "m", "x in the drawing of the centre of the forces on that patch; NaN without a force"
    ),
    "base_impulse_Ns": Column(
        "Ns",
        "impulse on the base until the striker rebounds; NaN unless the mode is impact",
        "less",
    ),
    "target_speed_m_per_s": Column(
        "m/s",
        "speed of the base when the striker rebounds; NaN unless loading.target_mass is given",
        "less",
    ),
    "peak_target_acceleration_m_per_s2": Column(
        "m/s^2",
        "greatest force on the base, filtered, / its mass; NaN unless loading.target_mass is given",
        "less",
    ),
    "peak_strain": Column("1", "greatest top displacement / height", "less"),
    "indentation_m": Column(
        "m",
        "greatest travel of platen or striker after its first touch, relative to the base; under a "
        "loose dead load, loss of height; NaN of a custom structure",
        "less",
    ),
    "peak_deceleration_m_per_s2": Column(
        "m/s^2",
        "greatest force on the striker / its mass, as an accelerometer on it measures: 0 in free "
        "fall; NaN without one",
        "less",
    ),
    "peak_deceleration_filtered_m_per_s2": Column(
        "m/s^2",
        "the same, filtered with loading.filter_class (SAE J211-1); NaN if rows are farther "
        "apart than a tenth of 1 / class in Hz",
        "less",
    ),
    "stroke_left_m": Column(
        "m",
        "stroke that closes all voids - greatest stroke of the striker or of a dead load on a "
        "platen; NaN if a platen crushes, and on ribs",
        "more",
    ),
    "bottomed_out": Column(
        "1",
        "1 if all voids below the striker or a loaded platen are closed, so that stroke_left_m is "
        "not positive; else 0; NaN without it",
        "less",
    ),
    "rebound_speed_m_per_s": Column(
        "m/s",
        "speed of the striker away from the base when the lattice no longer pushes it; NaN without "
        "one",
        "less",
    ),
    "rebound_share": Column(
        "1",
        "energy of the striker relative to the base at its rebound / at first contact, with "
        "gravity height of the rebound / of the fall; NaN without one",
        "less",
    ),
    "residual_strain": Column(
        "1",
        "decrease of the distance between top and bottom row in the last stored shape / height",
        "less",
    ),
    "least_element_strain": Column("1", "least element strain in any stored shape", "more"),
    "greatest_element_strain": Column("1", "greatest element strain in any stored shape", "less"),
    "greatest_fibre_strain": Column(
        "1", "greatest strain of the surface of a wall in any stored shape", "less"
    ),
    "broke_at_strain": Column(
        "1", "strain at which a fibre exceeds material.fracture_strain; NaN if none does", "more"
    ),
    "stretch_over_curve": Column(
        "1",
        "greatest stretch of a wall in any stored shape / that at the end of the measured curve, "
        "beyond which a straight line goes on; NaN without a curve",
        "less",
    ),
    "kept_area": Column(
        "1",
        "area covered by walls at the greatest strain / at rest; 1 for incompressible walls",
        "more",
    ),
    "min_gap_m": Column(
        "m",
        "least distance of a centre line from a near one or a loose platen; NaN if none is near",
    ),
    "touched": Column("1", "1 if contact acted in any row, else 0"),
    "max_crossings": Column("1", "walls that pass through one another in any stored frame", "less"),
    "solid_joint_share": Column(
        "1",
        'share of walls between solid joints, others end in points; NaN with joints = "points"',
    ),
    "steps": Column("1", "accepted time or load steps", "less"),
    "newton_iterations": Column("1", "Newton iterations of the whole run", "less"),
    "cpu_s": Column("s", "processor time of the run", "less"),
    "model_version": Column("1", "version of the model that computed this row"),
}
"""The columns that every summary has, in the order in which they are stored and shown."""

STORED_COLUMNS: dict[str, Column] = {
    "git_revision": Column("", 'commit of the source that this row was computed with, or ""'),
}
"""Further columns of a results file, about the run that wrote a row."""

HISTORY_COLUMNS: dict[str, Column] = {
    "time_s": Column("s", "time since the start"),
    "strain": Column("1", "top displacement / height"),
    "top_displacement_m": Column(
        "m", "travel of a driven platen or the top row; under a loose dead load, loss of height"
    ),
    "reaction_top_N": Column("N", "force on the upper platen or row, compression > 0"),
    "reaction_bottom_N": Column("N", "force on the lower platen or row, compression > 0"),
    "work_in_J": Column(
        "J", "work done on the lattice so far; of a striker, its energy and that of its weight"
    ),
    "kinetic_J": Column("J", "kinetic energy"),
    "stretch_J": Column("J", "stretching energy of the walls"),
    "bend_J": Column("J", "bending energy of the walls, fold barrier included"),
    "contact_J": Column("J", "energy stored in contacts"),
    "dissipated_material_J": Column("J", "dissipated by the material's damping so far"),
    "dissipated_friction_J": Column("J", "dissipated by friction so far"),
    "dissipated_integrator_J": Column("J", "removed by the time integrator so far"),
    "injected_by_projection_J": Column(
        "J", "energy added between steps so far, by contact; negative if energy is removed"
    ),
    "energy_residual_J": Column("J", "residual of the energy book so far"),
    "newton_iterations": Column("1", "Newton iterations since the previous row"),
    "min_gap_m": COLUMNS["min_gap_m"],
    "base_pressure_Pa": Column(
        "Pa",
        "greatest force on a patch of the base, loading.base_patch wide, / its area; NaN along the "
        "cells, on ribs, of a lattice that repeats and of a custom structure",
    ),
    "base_pressure_x_m": Column("m", "x of the centre of the forces on that patch"),
}
"""The columns that every history has, in the order in which they are stored."""

STRIKER_COLUMNS: dict[str, Column] = {
    "striker_speed_m_per_s": Column("m/s", "speed of the striker downwards"),
    "target_speed_m_per_s": Column("m/s", "speed of the base downwards, 0 if it is fixed"),
    "deceleration_m_per_s2": Column(
        "m/s^2", "force on the striker / its mass, mean since the previous row"
    ),
}
"""Further columns of the history of an impact."""

LOAD_COLUMNS: dict[str, Column] = {
    "load_factor": Column("1", "share of the loads and prescribed moves that is applied"),
    "unstable_modes": Column("1", "independent motions that lower the energy; 0 where stable"),
}
"""Further columns of the history of a custom structure in statics; the second only along arcs."""

RANKING_COLUMNS: dict[str, Column] = {
    "best_place": Column("1", "best place that a case which stopped could have had"),
    "least_place": Column(
        "1", "place that a case which stopped has at least; NaN if nothing is certain"
    ),
    "counted_mass_g": Column("g", "mass as extruded, or of the drawn walls without slicer", "less"),
    "panel_mass_g": Column("g", "mass of the specimens that fill the panel", "less"),
    "panel_energy_J": Column("J", "energy that the specimens of the panel absorb", "more"),
    "panel_specimens": Column("1", "number of specimens, or of periods, that fill the panel"),
    "panel_force_N": Column(
        "N",
        "greatest force of all specimens of the panel together while the usable energy is "
        "absorbed; in an impact, on the support",
        "less",
    ),
    "passed_on_N": Column("N", "greatest force while the usable energy is absorbed", "less"),
    "counted_stroke_m": Column("m", "stroke in which the usable energy is absorbed", "less"),
    "absorbed_energy_at_allowed_J": Column(
        "J", "work done until the allowed force of the panel is exceeded", "more"
    ),
    "stroke_at_allowed_m": Column("m", "stroke at which the allowed force is exceeded", "less"),
    "returned_share": Column("1", "returned energy / work of the whole crush", "less"),
}
"""Columns that a ranking adds to the columns of the summary, and by which it may sort."""

FRAME_COLUMNS: dict[str, Column] = {
    "strain": Column("1", "top displacement / height of a frame"),
    "time_s": Column("s", "time of a frame"),
    "plate_y_m": Column(
        "m", "height of the lower and the upper platen; NaN: no platen; -inf: an endless lattice"
    ),
    "position_m": Column("m", "x and y, of plates also z, of every node, frame after frame"),
    "striker_m": Column("m", "x and y above the upper platen, of the outline of a striker"),
    "base_m": Column("m", "x and y above the lower platen, of the outlines of both ribs of a base"),
    "quads": Column("", "the four nodes of every quad of a plate"),
    "quad_thickness_m": Column("m", "wall thickness of every quad"),
    "edges": Column("", "the two nodes of every element"),
    "edge_thickness_m": Column("m", "wall thickness of every element"),
    "json": Column("", "the case of every row as JSON in UTF-8, in SI, one byte per entry"),
}
"""The arrays of the frames of a case, and its text."""

GRID_KEY = re.compile(r"[a-z]+\.[a-z_]+")
PROBE = re.compile(r"probe_(\d+)_(.+)_(m|rad|N|Nm)")
ABSORBED_AT = re.compile(r"absorbed_energy_at_(.+)N_J")
IN_CYCLE = re.compile(r"(absorbed_energy|lost_energy|peak_force)_in_cycle_(\d+)_[JN]")
PER_GRAM = re.compile(r"specific_absorption_((?:at|until)_.+)_J_per_g")
CYCLED: dict[str, tuple[str, Literal["more", "less"], str]] = {
    "absorbed_energy": ("J", "more", "work done on the lattice as cycle {} loads it"),
    "lost_energy": ("J", "more", "work done in cycle {}, unloading included"),
    "peak_force": ("N", "less", "greatest force on a platen in cycle {}"),
}
"""Units, better values and meaning of the columns of a cycle."""
ERROR = re.compile(r"^error_(.+)")
CORRECTION = re.compile(r"^correction_(.+)")
ENDS = re.compile(r"^(lowest|highest)_(.+)")
UP_TO = re.compile(r"\bat ([\d.e-]+)N\b")
UNIT = re.compile(r"_(J_per_g|J_per_m3|m_per_s2|m_per_s|Pa|Ns|[JNgms])$")


def absorbed_energy_column(force: float) -> str:
    """Name of the column of the energy absorbed until `force` (N) is first transmitted."""
    return f"absorbed_energy_at_{force:.10g}N_J"


def cycle_columns(number: int) -> tuple[str, str, str]:
    """Names of the columns of the absorbed energy, the lost energy and the peak force of a cycle.

    number: of the cycle, from 1.
    """
    return (
        f"absorbed_energy_in_cycle_{number}_J",
        f"lost_energy_in_cycle_{number}_J",
        f"peak_force_in_cycle_{number}_N",
    )


def error_column(name: str) -> str:
    """Name of the column of the estimated discretisation error of a column."""
    return f"error_{name}"


def correction_column(name: str) -> str:
    """Name of the column of the estimated difference between the limit of fine meshes and short
    steps and the value.
    """
    return f"correction_{name}"


def end_columns(name: str) -> tuple[str, str]:
    """Names of the columns of the ends of the range of a value."""
    return f"lowest_{name}", f"highest_{name}"


def describe_array(group: str, name: str) -> Column:
    """Meaning of an array of curves or shapes."""
    return describe_history(name) if group == "/histories" else FRAME_COLUMNS[name]


def describe_history(name: str) -> Column:
    """Meaning of a column of a history, including probes of a custom structure."""
    if match := PROBE.fullmatch(name):
        node, what, unit = match.groups()
        return Column(unit.replace("Nm", "N m"), f"{what.replace('_', ' ')} at node {node}")
    return (HISTORY_COLUMNS | STRIKER_COLUMNS | LOAD_COLUMNS)[name]


def is_column(name: str) -> bool:
    """True for a column of results or of a ranking, fixed or derived from a name."""
    names = {*COLUMNS, *STORED_COLUMNS, *RANKING_COLUMNS}
    derived = (ABSORBED_AT, IN_CYCLE, PER_GRAM, ERROR, CORRECTION, ENDS)
    return name in names or any(pattern.fullmatch(name) for pattern in derived)


def is_grid_key(name: str) -> bool:
    """True for the column of a grid key, such as `lattice.wall_thickness`; a force in the name of a
    column has a point too, as in `absorbed_energy_at_1.5N_J`.
    """
    return GRID_KEY.fullmatch(name) is not None


def describe_column(name: str) -> Column:
    """Meaning of a column of a summary or a ranking: fixed, derived from a name, or a grid key."""
    if column := (COLUMNS | STORED_COLUMNS | RANKING_COLUMNS).get(name):
        return column
    if match := ERROR.fullmatch(name):
        units = describe_column(match[1]).units
        meaning = f"estimated discretisation error of {match[1]}, no bound; NaN: no estimate"
        return Column(units, meaning, "less")
    if match := CORRECTION.fullmatch(name):
        meaning = f"estimated limit of fine meshes and short steps - {match[1]}"
        return Column(describe_column(match[1]).units, meaning)
    if match := ENDS.fullmatch(name):
        meaning = f"{match[1]} {match[2]} at maxima of the efficiency within 2 % of one another"
        return Column(describe_column(match[2]).units, meaning)
    if match := ABSORBED_AT.fullmatch(name):
        meaning = f"work done until a force of {match[1]} N is exceeded; all of it if it never is"
        return Column("J", meaning, "more")
    if match := IN_CYCLE.fullmatch(name):
        what, number = match.groups()
        units, better, meaning = CYCLED[what]
        return Column(units, meaning.format(number), better)
    if match := PER_GRAM.fullmatch(name):
        return Column("J/g", f"energy absorbed {match[1].replace('_', ' ')} / mass", "more")
    return Column(_unit_of_key(name), f"grid key {name}")


def in_words(name: str) -> str:
    """A column as words with its unit: "peak_strain" -> "peak strain", "mass_g" -> "mass, in g"."""
    units = describe_column(name).units
    noun = UNIT.sub("", name).replace("_", " ").replace("until packed", "until densification")
    noun = UP_TO.sub(r"up to \1 N", noun)
    return f"{noun}, in {units}" if units not in ("", "1") else noun


def less_is_better(name: str) -> bool:
    """True for a column whose least value is the best."""
    return describe_column(name).better == "less"


def _unit_of_key(name: str) -> str:
    from sweep.config.keys import case_keys

    key = case_keys().get(name)
    return (key and key.unit) or ""


def nearest_names(name: str, columns: Iterable[str]) -> str:
    """A clause of a refusal: up to three columns of nearly this name; empty if there are none."""
    near = get_close_matches(name, [*columns], n=3, cutoff=0.5)
    return f"; the nearest {'are' if len(near) > 1 else 'is'} {', '.join(near)}" if near else ""

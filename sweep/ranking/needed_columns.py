"""The columns of a summary that decide places, so that large sweeps are ranked without the others.

A summary has some 130 columns. A ranking of 100,000 cases that copied all of them whenever it
sorts, groups or selects rows would spend most of its time and memory on them.
"""

from collections.abc import Collection, Iterable

from pandas import DataFrame, concat

from sweep.columns import ABSORBED_AT, COLUMNS, CORRECTION, ENDS, ERROR
from sweep.ranking.merit import AT_ALLOWED, STROKE_AT_ALLOWED
from sweep.ranking.question import RankError
from sweep.ranking.scenes import scene_keys

NEEDED = frozenset(
    {
        *("case_id", "status", "loaded", "loading_mode", "model_version"),
        *("lattice_kind", "cells_x", "cells_y", "sides", "direction", "platen", "striker", "base"),
        *("height_m", "depth_m", "outer_width_m", "stroke_m", "mass_g", "printed_mass_g"),
        *("force_N", "striker_mass_g", "striker_speed_m_per_s", "impact_energy_J"),
        *("gravity", "target_mass_g", "solid_joint_share"),
        *("absorbed_energy_J", "absorbed_energy_at_densification_J"),
        *("absorbed_energy_until_packed_J", "absorbed_energy_within_model_J"),
        *("returned_energy_J", "specific_absorption_J_per_g"),
        *("peak_force_N", "peak_force_at_densification_N", "peak_force_until_packed_N"),
        *("peak_strain", "densification_strain", "packing_strain", "stroke_left_m"),
        *("peak_deceleration_filtered_m_per_s2", "peak_base_pressure_Pa"),
        *("peak_target_acceleration_m_per_s2", "max_crossings", "stretch_over_curve"),
        *("integrator_share", "path_error", "load_step_error", "peak_step_error"),
    }
)
"""Columns of `COLUMNS` that rankings read, whatever the question."""


def needed_columns(summary: DataFrame, also: Iterable[str | None] = ()) -> DataFrame:
    """The columns that a ranking of the rows of a summary needs, and some others.

    They include the columns for every allowed force, and errors and ranges of all needed columns.
    """
    missing = next((name for name in COLUMNS if name in NEEDED and name not in summary), None)
    if missing:
        raise RankError(f"no {missing}; needed: all columns of a summary (`read_summary`)")
    kept = NEEDED | {AT_ALLOWED, STROKE_AT_ALLOWED, *also, *scene_keys(summary)}
    about = {name: _about(name) for name in summary}
    return summary[[k for k, of in about.items() if of in kept or ABSORBED_AT.fullmatch(of)]]


def _about(name: str) -> str:
    """The column whose error, correction or range a column contains; else its own name."""
    for pattern, group in ((ERROR, 1), (CORRECTION, 1), (ENDS, 2)):
        if match := pattern.fullmatch(name):
            return _about(match[group])
    return name


def widened(rows: DataFrame, summary: DataFrame, first: Collection[str] = ()) -> DataFrame:
    """Rows of `needed_columns` with all columns of the summary, which precede the added ones."""
    others = summary.columns.difference(rows.columns, sort=False)
    more = summary.loc[rows.index, others]
    whole = concat([rows, more.set_axis(rows.index)], axis=1)  # a row may be there twice
    leading = [name for name in first if name in whole]
    return whole[[*dict.fromkeys([*leading, *summary, *rows])]]

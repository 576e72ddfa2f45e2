"""CSV: the curves of a case, a row per stored step, with units in the headings."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sweep.loading_modes import MODES

if TYPE_CHECKING:
    from pandas import DataFrame

AFTER = "reaction_bottom_N"
DIGITS = "%.8g"  # single precision is stored


def write_curves(path: Path, history: DataFrame, row: Mapping[str, Any]) -> None:
    """Write the history of a case, with its nominal stress. row: of the case in the summary."""
    with_stress(history, row).to_csv(path, index=False, float_format=DIGITS, lineterminator="\n")


def with_stress(history: DataFrame, row: Mapping[str, Any]) -> DataFrame:
    """The history with the column `stress_Pa`: force on the top / (overall width x depth); without
    `time_s` if time has no meaning in the case.
    """
    stress = history["reaction_top_N"] / (row["outer_width_m"] * row["depth_m"])
    frame = history.copy()
    if not _takes_time(history, row):
        del frame["time_s"]
    frame.insert(frame.columns.get_loc(AFTER) + 1, "stress_Pa", stress)
    return frame


def _takes_time(history: DataFrame, row: Mapping[str, Any]) -> bool:
    """Whether time has a meaning; it has none in a slow crush of walls that do not relax."""
    slow = MODES[row["loading_mode"]].driven and not history["kinetic_J"].any()
    return not slow or "relaxes" in row["material_memory"]

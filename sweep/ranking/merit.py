"""The merit of a design: its counted energy, in all, per gram, and for a panel of specimens.

Energy is counted until the lattice has packed, or until the force exceeds the allowed force. A
packed lattice absorbs energy as a solid block does, at a multiple of the force, whatever its
infill. Where the loading sets the energy, the columns of `LEAST` are compared instead.

A panel consists of specimens side by side, of outer width w and depth b:
factor = panel area / (w b),  panel mass = factor mass,  panel energy = factor energy.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from sweep.result import (
    ABSORBED_AT,
    COLUMNS,
    OLDER,
    absorbed_energy_column,
    correction_column,
    error_column,
)

if TYPE_CHECKING:
    from pandas import DataFrame, Series

Quantity = float | str
"""A number in SI, or text with a unit such as "25 g"."""

LEAST = {"force": "peak_strain", "impact": "peak_force_N"}
"""Columns that are compared instead of energy, by `loading_mode`; the least value is the best.

Under a dead load, the design that gives way most absorbs most energy. Every design absorbs all the
energy of a striker; designs differ in the force on the support, which is large if the stroke is
used up.
"""

WHOLE_CRUSH = ("absorbed_energy_J", "specific_absorption_J_per_g")
AT_DENSIFICATION = (
    "absorbed_energy_at_densification_J",
    "specific_absorption_at_densification_J_per_g",
)
ROUND_OFF = 1e-9


class RankError(ValueError):
    """A ranking that cannot be made; the text is one sentence with the allowed values."""


class Compared(NamedTuple):
    """Names of the compared columns; `until`: up to which point energy is counted, in words."""

    mass: str
    energy: str
    per_gram: str
    until: str


def merits(
    finished: DataFrame,
    by: str | None,
    panel: Sequence[Quantity] | None,
    allowed_force: Quantity | None,
) -> tuple[DataFrame, Compared]:
    """Rows with the compared columns added, and the names of these columns.

    Other added columns: `passed_on_N`, the greatest force while that energy is absorbed;
    `returned_share`, returned energy / work of the whole crush; `beyond_model`; `crossed`; and
    errors and corrections of added columns, if the energy has them.
    """
    if missing := [name for name in COLUMNS if name not in finished and name not in OLDER]:
        raise RankError(
            f"no {missing[0]}: an older version wrote these results; run them again into a new file"
        )
    energy, force, until = _counted(finished, by, allowed_force)
    per_gram = f"{energy}_per_g".replace("absorbed_energy", "specific_absorption")
    within = finished["absorbed_energy_within_model_J"] * (1.0 + ROUND_OFF)
    added = {
        per_gram: finished[energy] / finished["mass_g"],
        "passed_on_N": force,
        "returned_share": finished["returned_energy_J"] / finished["absorbed_energy_J"],
        "beyond_model": (finished[energy] > within) | through_solid(finished),
        "crossed": finished["max_crossings"] > 0,
    }
    names = Compared("mass_g", energy, per_gram, until)
    factor = None if panel is None else panel_factor(finished, panel)
    for column in (error_column, correction_column):
        if (known := column(energy)) in finished:
            added[column(per_gram)] = finished[known] / finished["mass_g"]
            added[column("passed_on_N")] = finished[column(str(force.name))]
            if factor is not None:
                added[column("panel_energy_J")] = factor * finished[known]
    if factor is not None:
        added["panel_mass_g"] = factor * finished["mass_g"]
        added["panel_energy_J"] = factor * finished[energy]
        names = names._replace(mass="panel_mass_g", energy="panel_energy_J")
    return finished.assign(**added), names


def through_solid(finished: DataFrame) -> Series:
    """True for lattices compressed to less than their solid height, or to less than none."""
    sunk = (finished["loading_mode"] == "force") & (finished["peak_strain"] >= 1.0)
    return sunk | (finished["stroke_left_m"] < -ROUND_OFF)


def panel_factor(frame: DataFrame, panel: Sequence[Quantity]) -> Series:
    """Number of specimens, side by side, that fill the area of the panel."""
    if len(panel) != 2:
        raise RankError(f"a panel has two lengths, got {len(panel)}")
    area = in_si(panel[0], "m") * in_si(panel[1], "m")
    return area / (frame["outer_width_m"] * frame["depth_m"])


def greatest_mass(budget_g: float) -> float:
    """The greatest mass (g) within a budget: the budget, with a tolerance for round-off."""
    return budget_g * (1.0 + ROUND_OFF)


def in_si(value: Any, unit: str) -> float:
    """A positive number in SI, from a number or from text with a unit."""
    number = value
    if isinstance(value, str):
        from sweep.config.units import quantity

        number = quantity(value, unit)
    if not number > 0.0:
        written = value if isinstance(value, str) else f"{value:g} {unit}"
        raise RankError(f"{written}: budgets, panels and forces must be above zero")
    return float(number)


def _counted(
    finished: DataFrame, by: str | None, allowed_force: Quantity | None
) -> tuple[str, Series, str]:
    """The column of the counted energy, the greatest force meanwhile (N), and `Compared.until`."""
    if allowed_force is not None:
        limit = in_si(allowed_force, "N")
        energy, until = _energy_column(finished, limit), f"until the force exceeds {limit:g} N"
        return energy, finished["peak_force_N"].clip(upper=limit), until
    if by in WHOLE_CRUSH:
        return "absorbed_energy_J", finished["peak_force_N"], "to the end of the stroke"
    if by in AT_DENSIFICATION:
        force = finished["peak_force_at_densification_N"]
        return AT_DENSIFICATION[0], force, "until densification"
    force = finished["peak_force_until_packed_N"]
    return "absorbed_energy_until_packed_J", force, "until the lattice has packed"


def _energy_column(frame: DataFrame, force: float) -> str:
    """The column of the energy absorbed up to an allowed force (N), which the sweep must have."""
    name = absorbed_energy_column(force)
    if name in frame:
        return name
    held = [match[1] for key in frame if (match := ABSORBED_AT.fullmatch(key))]
    known = " or ".join(f"{text} N" for text in held) or "none (set loading.allowed_forces)"
    raise RankError(f"no energies up to {force:g} N in these results; allowed: {known}")

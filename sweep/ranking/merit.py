"""What counts for a design: which of its energies, per gram, and for a panel of specimens.

Energy is counted until the lattice has packed down, or until the allowed force is passed on: what a
solid block of TPU takes beyond that, at a multiple of the force, is no merit of its infill.
Where the energy is not the design's own doing, `LEAST` counts.

A specimen of outer width w and depth b stands for a panel when it is repeated side by
side:  factor = panel area / (w b),  panel mass = factor mass,  panel energy = factor energy.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from sweep.result import ABSORBED_AT, COLUMNS, OLDER, absorbed_energy_column, error_column

if TYPE_CHECKING:
    from pandas import DataFrame, Series

Quantity = float | str
"""A number in SI, or text with a unit such as "25 g"."""

LEAST = {"force": "peak_strain", "impact": "peak_force_N"}
"""What counts in place of energy, least first, by `loading_mode`.

Under a dead load whatever gives way absorbs most. A striker is stopped with all its energy by every
design: what tells them apart is the force on what they protect, and one that runs out of stroke
shows it there.
"""

WHOLE_CRUSH = ("absorbed_energy_J", "specific_absorption_J_per_g")
ROUND_OFF = 1e-9


class RankError(ValueError):
    """A ranking that cannot be made; the text is one sentence that says what is allowed."""


class Compared(NamedTuple):
    """Names of the columns that are compared; `until`: when energy ceases to count, in words."""

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
    """Rows with the columns that are compared, and the names of these.

    Added too: `passed_on_N`, the greatest force while that energy is absorbed; `returned_share`,
    what is given back of the work of the whole crush; `beyond_model`; `crossed`; and error bars of
    what is added, where the energy has one.
    """
    if missing := [name for name in COLUMNS if name not in finished and name not in OLDER]:
        raise RankError(
            f"no {missing[0]}: an older version wrote these results; run them anew into a new file"
        )
    energy, force, until = _counted(finished, by, allowed_force)
    per_gram = f"{energy}_per_g".replace("absorbed_energy", "specific_absorption")
    within = finished["absorbed_energy_within_model_J"] * (1.0 + ROUND_OFF)
    added = {
        per_gram: finished[energy] / finished["mass_g"],
        "passed_on_N": force,
        "returned_share": finished["returned_energy_J"] / finished["absorbed_energy_J"],
        "beyond_model": (finished[energy] > within) | _through_solid(finished),
        "crossed": finished["max_crossings"] > 0,
    }
    names = Compared("mass_g", energy, per_gram, until)
    if (bar := error_column(energy)) in finished:
        added[error_column(per_gram)] = finished[bar] / finished["mass_g"]
        added[error_column("passed_on_N")] = finished[error_column(str(force.name))]
    if panel is not None:
        factor = panel_factor(finished, panel)
        added["panel_mass_g"] = factor * finished["mass_g"]
        added["panel_energy_J"] = factor * finished[energy]
        if bar in finished:
            added[error_column("panel_energy_J")] = factor * finished[bar]
        names = names._replace(mass="panel_mass_g", energy="panel_energy_J")
    return finished.assign(**added), names


def _through_solid(finished: DataFrame) -> Series:
    """Which lattices are pressed into less height than their solid has, or through the ground."""
    sunk = (finished["loading_mode"] == "force") & (finished["peak_strain"] >= 1.0)
    return sunk | (finished["stroke_left_m"] < -ROUND_OFF)


def panel_factor(frame: DataFrame, panel: Sequence[Quantity]) -> Series:
    """Number of specimens, side by side, that fill the area of the panel."""
    if len(panel) != 2:
        raise RankError(f"a panel has two lengths, got {len(panel)}")
    area = in_si(panel[0], "m") * in_si(panel[1], "m")
    return area / (frame["outer_width_m"] * frame["depth_m"])


def greatest_mass(budget_g: float) -> float:
    """The mass (g) up to which a design is within a budget: the budget, with room for round-off."""
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
    """The column of the energy that counts, the greatest force passed on (N), until when."""
    if allowed_force is not None:
        limit = in_si(allowed_force, "N")
        energy, until = _energy_column(finished, limit), f"until {limit:g} N are passed on"
        return energy, finished["peak_force_N"].clip(upper=limit), until
    if by in WHOLE_CRUSH:
        return "absorbed_energy_J", finished["peak_force_N"], "to the end of the stroke"
    packed = finished["peak_force_at_densification_N"]
    return "absorbed_energy_at_densification_J", packed, "until it has packed down"


def _energy_column(frame: DataFrame, force: float) -> str:
    """The column of the energy absorbed up to an allowed force (N), which the sweep must hold."""
    name = absorbed_energy_column(force)
    if name in frame:
        return name
    held = [match[1] for key in frame if (match := ABSORBED_AT.fullmatch(key))]
    known = " or ".join(f"{text} N" for text in held) or "none (set loading.allowed_forces)"
    raise RankError(f"no energies up to {force:g} N in these results; allowed: {known}")

"""What a part must fulfil: limits on results, which only read them.

A requirement is of a specimen or of the panel. The force of a panel is that of its specimens
together, since all are pressed alike; stroke and deceleration are the same for both. No curve of a
force that stays below F absorbs an energy W in a stroke shorter than W / F, that of a rectangle.

The violation of a design is the sum over the requirements of the share of its limit by which it
misses each (K. Deb, An efficient constraint handling method for genetic algorithms, 2000).
"""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from pandas import Series

from sweep.ranking.merit import ROUND_OFF, Compared, Quantity, RankError, in_si

if TYPE_CHECKING:
    from pandas import DataFrame

STANDARD_GRAVITY = 9.80665  # m/s^2


class Measure(NamedTuple):
    """What a requirement limits. unit: in SI. shared: whether specimens of a panel add up.

    least: the limit is a least value; else it is a greatest one.
    """

    unit: str
    shared: bool
    least: bool = False


MEASURES = {
    "max_force": Measure("N", shared=True),
    "max_deceleration": Measure("m/s^2", shared=False),
    "max_mass": Measure("kg", shared=True),
    "min_absorbed": Measure("J", shared=True, least=True),
    "max_stroke": Measure("m", shared=False),
}
"""The requirements by their keys in [require]."""


@dataclass(frozen=True)
class Outcome:
    """How the designs of one scene meet the requirements; values in SI, per specimen or panel.

    designs, fulfil: number of designs, and of those that fulfil all requirements.
    failed: number of designs that fail each requirement. unknown: number of those among them that
        have no value of it.
    best: the value nearest to fulfilling each requirement, of all designs; NaN if none has one.
    left_out: requirements that are of a striker, in a scene without one.
    energy, force, stroke: energy that must be absorbed, the force that is allowed meanwhile, and
        the least stroke in which it does that; NaN if one of both is not given.
    height: of the highest lattice.
    nearest: id of the design of least violation, and its values; "" and none if none has all
        values.
    """

    designs: int
    fulfil: int
    failed: Mapping[str, int]
    unknown: Mapping[str, int]
    best: Mapping[str, float]
    left_out: tuple[str, ...]
    energy: float
    force: float
    stroke: float
    height: float
    nearest: tuple[str, Mapping[str, float]]


def limits(require: Mapping[str, Quantity | None] | None) -> dict[str, float]:
    """The limits (SI) of the requirements that are given, by name."""
    given = {name: value for name, value in (require or {}).items() if value is not None}
    for name in given:
        if name not in MEASURES:
            nearest = difflib.get_close_matches(name, MEASURES, n=1, cutoff=0.0)[0]
            raise RankError(f"unknown requirement {name}; the nearest is {nearest}")
    return {name: in_si(given[name], MEASURES[name].unit) for name in MEASURES if name in given}


def check(rows: DataFrame, required: Mapping[str, float]) -> None:
    """Refuse requirements that no row can be asked for."""
    if rows.empty:
        return
    if "max_deceleration" in required and not (rows["loading_mode"] == "impact").any():
        raise RankError("max_deceleration needs a striker, and these results have none")
    if "max_stroke" in required and rows["counted_stroke_m"].isna().all():
        raise RankError(
            "max_stroke is unknown up to an allowed force without the curves: rank the file itself"
        )


def judge(
    rows: DataFrame,
    names: Compared,
    required: Mapping[str, float],
    per: str,
    allowed: float = np.nan,
) -> tuple[Series, Outcome]:
    """Which rows of one scene fulfil all requirements, and the outcome.

    allowed: force (N) up to which energy is counted; NaN without one.
    """
    found = measured(rows, names, per)
    struck = (rows["loading_mode"] == "impact").all()
    left_out = tuple(name for name in required if name == "max_deceleration" and not struck)
    asked = {name: limit for name, limit in required.items() if name not in left_out}
    met = {name: _met(found[name], name, limit) for name, limit in asked.items()}
    fulfil = rows["mass_g"].notna()
    for one in met.values():
        fulfil &= one
    energy, force = _rectangle(rows, asked, per, allowed)
    return fulfil, Outcome(
        designs=len(rows),
        fulfil=int(fulfil.sum()),
        failed={name: int((~one).sum()) for name, one in met.items()},
        unknown={name: int(found[name].isna().sum()) for name in met},
        best={
            name: float(found[name].max() if MEASURES[name].least else found[name].min())
            for name in met
        },
        left_out=left_out,
        energy=energy,
        force=force,
        stroke=energy / force,
        height=float(rows["height_m"].max()) if len(rows) else np.nan,
        nearest=_nearest(rows, found, asked),
    )


def violation(rows: DataFrame, names: Compared, required: Mapping[str, float], per: str) -> Series:
    """The violation of each row: 0 where all requirements are met, inf where a value is missing."""
    return _violation(rows, measured(rows, names, per), required)


def _violation(
    rows: DataFrame, found: Mapping[str, Series], required: Mapping[str, float]
) -> Series:
    total = Series(0.0, rows.index)
    for name, limit in required.items():
        excess = found[name].astype(float) / limit - 1.0
        missed = -excess if MEASURES[name].least else excess
        total += missed.mask(_met(found[name], name, limit), 0.0).fillna(np.inf)
    return total


def _nearest(
    rows: DataFrame, found: Mapping[str, Series], asked: Mapping[str, float]
) -> tuple[str, dict[str, float]]:
    """The id of the row of least violation and its values; "" if no row has all values."""
    missed = _violation(rows, found, asked)
    if not np.isfinite(missed.min()):
        return "", {}
    at = missed.idxmin()
    return str(rows.loc[at, "case_id"]), {name: float(found[name][at]) for name in asked}


def measured(rows: DataFrame, names: Compared, per: str) -> dict[str, Series]:
    """The value (SI) of each row for each requirement, per specimen or per panel.

    Force and energy of a crush are those that are counted; of an impact or a dead load, of all of
    it. The deceleration is filtered.
    """
    crushed = rows["loading_mode"] == "displacement"
    together = rows.get("panel_specimens", 1.0)
    of_specimen = {
        "max_force": rows["passed_on_N"].where(crushed, rows["peak_force_N"]),
        "max_deceleration": rows["peak_deceleration_filtered_m_per_s2"],
        "max_mass": 1e-3 * rows[names.mass] / together,
        "min_absorbed": (rows[names.energy] / together).where(crushed, rows["absorbed_energy_J"]),
        "max_stroke": rows["counted_stroke_m"],
    }
    return {
        name: values * together if per == "panel" and MEASURES[name].shared else values
        for name, values in of_specimen.items()
    }


def _met(values: Series, name: str, limit: float) -> Series:
    """Whether a requirement is met, but for round-off; a missing value does not meet it."""
    if MEASURES[name].least:
        return values >= limit * (1.0 - ROUND_OFF)
    return values <= limit * (1.0 + ROUND_OFF)


def _rectangle(
    rows: DataFrame, asked: Mapping[str, float], per: str, allowed: float
) -> tuple[float, float]:
    """The energy (J) that must be absorbed and the force (N) that is allowed meanwhile.

    The energy is that of the striker; in a crush, the least that is asked for.
    """
    if rows.empty:
        return np.nan, np.nan
    energy = asked.get("min_absorbed", np.nan)
    force = float(np.fmin(asked.get("max_force", np.nan), allowed))
    if rows["loading_mode"].iloc[0] == "impact":
        together = rows["panel_specimens"] if per == "panel" else 1.0
        energy = float((rows["impact_energy_J"] * together).min())
    return energy, force

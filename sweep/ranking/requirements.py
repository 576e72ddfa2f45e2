"""What a part must fulfil: limits on results, which only read them.

A requirement is of a specimen or of the panel. The force of a panel is that of its specimens
together, since all are pressed alike; stroke and deceleration are the same for both. No curve of a
force that stays below F absorbs an energy W in a stroke shorter than W / F, that of a rectangle.

A loading that sets a quantity is not asked for it: the force and the energy under a dead load, and
the energy of a striker, are not those of the design.

The nearest design to requirements that none fulfils is the one whose greatest miss is the least: a
value v misses a greatest value L by v / L - 1, and a least value L by 1 - v / L.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from pandas import DataFrame

from sweep.ranking.merit import (
    ROUND_OFF,
    Compared,
    Quantity,
    RankError,
    doubtful,
    greatest_mass,
    in_si,
)

if TYPE_CHECKING:
    from pandas import Series

STANDARD_GRAVITY = 9.80665  # m/s^2
MODES = ("displacement", "impact", "force", "custom")
NEEDED = {"displacement": "a crush", "impact": "a striker", "force": "a dead load"}
"""Loadings that a requirement may need, in words."""


class Measure(NamedTuple):
    """What a requirement limits. unit: in SI. shared: whether specimens of a panel add up.

    asked_of: kinds of loading in which the design, not the loading, sets the value. least: the
    limit is a least value; else it is a greatest one.
    """

    unit: str
    shared: bool
    asked_of: tuple[str, ...]
    least: bool = False


MEASURES = {
    "max_force": Measure("N", True, ("displacement", "impact")),
    "max_deceleration": Measure("m/s^2", False, ("impact",)),
    "max_mass": Measure("kg", True, MODES),
    "min_absorbed": Measure("J", True, ("displacement",), least=True),
    "max_stroke": Measure("m", False, ("displacement", "impact", "force")),
}
"""The requirements by their keys in [require]."""


class Best(NamedTuple):
    """The value (SI) nearest to fulfilling a requirement; doubtful: of a design marked ! or x."""

    value: float
    doubtful: bool


@dataclass(frozen=True, eq=False)
class Outcome:
    """How the designs of one scene within one budget meet the requirements.

    Values are in SI, per specimen or panel.

    mode: of loading. budget_g: NaN without a budget.
    designs, fulfil: number of designs, and of those that fulfil all requirements. doubtful: number
        of those that fulfil them and are marked as beyond the model or as crossed.
    failed: number of designs that fail each requirement. unknown: number of those among them that
        have no value of it. open: number of those that fail only `min_absorbed` and may fulfil it
        in a longer crush, as theirs ended before the energy was counted to its end.
    best: the value nearest to fulfilling each requirement.
    left_out: requirements that this kind of loading is not asked for.
    nearest: where no design fulfils all, but for doubtful ones: the row of the nearest one, that of
        a doubtful one only if there is no other; no row if nothing is known. missed: what it
        misses, with its values. misses: by what share of the limit.
    lightest: the row of the lightest design to be trusted that fulfils all, of any mass; or no row.
    energy, stroke: energy that must be absorbed, and the least stroke in which a force of at most
        `max_force` does that; NaN if one of both is not given.
    height: of the highest lattice.
    """

    mode: str
    budget_g: float
    designs: int
    fulfil: int
    doubtful: int
    failed: Mapping[str, int]
    unknown: Mapping[str, int]
    open: int
    best: Mapping[str, Best]
    left_out: tuple[str, ...]
    nearest: DataFrame
    missed: Mapping[str, float]
    misses: Mapping[str, float]
    lightest: DataFrame
    energy: float
    stroke: float
    height: float


def limits(require: Mapping[str, Quantity | None] | None) -> dict[str, float]:
    """The limits (SI) of the requirements that are given, by name."""
    given = {name: value for name, value in (require or {}).items() if value is not None}
    for name in given:
        if name not in MEASURES:
            nearest = difflib.get_close_matches(name, MEASURES, n=1, cutoff=0.0)[0]
            raise RankError(f"unknown requirement {name}; the nearest is {nearest}")
    return {name: in_si(given[name], MEASURES[name].unit) for name in MEASURES if name in given}


def check_modes(required: Iterable[str], modes: Iterable[str]) -> None:
    """Refuse a requirement that none of these kinds of loading is asked for."""
    known = set(modes)
    for name in required:
        asked_of = MEASURES[name].asked_of
        if known and not known.intersection(asked_of):
            needed = " or ".join(NEEDED[mode] for mode in asked_of)
            raise RankError(f"{name} needs {needed}, and there is none")


def check(rows: DataFrame, required: Mapping[str, float]) -> None:
    """Refuse requirements that no row can be asked for."""
    if rows.empty:
        return
    check_modes(required, rows["loading_mode"])
    if "max_stroke" in required and rows["counted_stroke_m"].isna().all():
        raise RankError(
            "max_stroke is unknown up to an allowed force without the curves: rank the file itself"
        )


class Judged(NamedTuple):
    """The rows of one scene with what each of them has of the requirements, and meets.

    mass: name of the column that budgets limit. asked: limits (SI) of the requirements that this
    kind of loading is asked for; left_out: the others. found, met (rows, asked). fulfil (rows,).
    """

    rows: DataFrame
    mass: str
    asked: Mapping[str, float]
    left_out: tuple[str, ...]
    found: DataFrame
    met: DataFrame
    fulfil: Series

    def within(self, budget_g: float) -> Judged:
        """The same of the rows within a budget."""
        kept = self.rows[self.mass] <= greatest_mass(budget_g)
        parts = {name: getattr(self, name)[kept] for name in ("rows", "found", "met", "fulfil")}
        return self._replace(**parts)


def judge(
    rows: DataFrame,
    names: Compared,
    required: Mapping[str, float],
    per: str,
    budgets_g: Sequence[float],
) -> tuple[Series, tuple[Outcome, ...]]:
    """Which rows of one scene fulfil all requirements, and the outcome within each budget.

    budgets_g : masses in grams; infinite without a budget.
    """
    mode = str(rows["loading_mode"].iloc[0]) if len(rows) else ""
    asked = {k: limit for k, limit in required.items() if mode in MEASURES[k].asked_of}
    found = measured(rows, names, per)
    values = DataFrame({name: found[name] for name in asked}, index=rows.index)
    met = DataFrame({k: _met(found[k], k, v) for k, v in asked.items()}, index=rows.index)
    fulfil = rows["mass_g"].notna() & met.all(axis=1)
    left_out = tuple(name for name in required if name not in asked)
    judged = Judged(rows, names.mass, asked, left_out, values, met, fulfil)
    if not required or rows.empty:
        return fulfil, ()
    rectangle = _rectangle(rows, required, per)
    return fulfil, tuple(_outcome(judged, mode, g, *rectangle) for g in budgets_g)


def _outcome(judged: Judged, mode: str, budget_g: float, energy: float, stroke: float) -> Outcome:
    """The outcome within one budget."""
    every, part = judged.rows[judged.fulfil], judged.within(budget_g)
    sound = ~doubtful(part.rows)
    soundly = int((part.fulfil & sound).sum())
    nearest, misses = (part.rows[:0], {}) if soundly else _nearest(part)
    order = [part.mass, "case_id"]
    return Outcome(
        mode=mode,
        budget_g=budget_g if np.isfinite(budget_g) else np.nan,
        designs=len(part.rows),
        fulfil=int(part.fulfil.sum()),
        doubtful=int(part.fulfil.sum()) - soundly,
        failed={name: int((~part.met[name]).sum()) for name in part.asked},
        unknown={name: int(part.found[name].isna().sum()) for name in part.asked},
        open=_open(part),
        best={k: _best(part.found[k], sound, MEASURES[k].least) for k in part.asked},
        left_out=part.left_out,
        nearest=nearest,
        missed={name: float(part.found.loc[nearest.index[0], name]) for name in misses},
        misses=misses,
        lightest=every[~doubtful(every)].sort_values(order)[:1],
        energy=energy,
        stroke=stroke,
        height=float(judged.rows["height_m"].max()),
    )


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


def _best(values: Series, sound: Series, least: bool) -> Best:
    """The best value of the designs to be trusted, else of all; NaN if none has one."""
    trusted = values[sound].dropna()
    known = values if trusted.empty else trusted
    return Best(float(known.max() if least else known.min()), trusted.empty)


def _open(part: Judged) -> int:
    """Number of designs that fail `min_absorbed` alone, with an energy that is a lower bound."""
    if "min_absorbed" not in part.asked:
        return 0
    others = part.met.drop(columns="min_absorbed").all(axis=1)
    short = part.found["min_absorbed"].notna() & ~part.met["min_absorbed"]
    return int((part.rows["ends_early"] & short & others).sum())


def _nearest(part: Judged) -> tuple[DataFrame, dict[str, float]]:
    """The row with the least of the greatest misses, and its misses; no row if all are unknown.

    Designs to be trusted come before others; of equal misses the lightest is the first.
    """
    shares = DataFrame({k: _miss(part.found[k], k, limit) for k, limit in part.asked.items()})
    worst = shares.max(axis=1, skipna=False) if part.asked else part.rows[part.mass] * np.nan
    known = part.rows.assign(worst=worst, doubtful=doubtful(part.rows)).dropna(subset=["worst"])
    order = ["doubtful", "worst", *dict.fromkeys([part.mass, "case_id"])]
    index = known.sort_values(order).index[:1]
    misses = {name: float(shares.loc[i, name]) for i in index for name in part.asked}
    return part.rows.loc[index], {name: share for name, share in misses.items() if share > 0.0}


def _miss(values: Series, name: str, limit: float) -> Series:
    """By what share of the limit each value misses it; 0 if it is met, NaN if it is unknown."""
    share = 1.0 - values / limit if MEASURES[name].least else values / limit - 1.0
    return share.where(share > ROUND_OFF, 0.0).where(values.notna())


def _rectangle(rows: DataFrame, required: Mapping[str, float], per: str) -> tuple[float, float]:
    """The energy (J) that must be absorbed and the least stroke (m), energy / force.

    The energy is that of the striker; in a crush, the least that is asked for.
    """
    if "max_force" not in required or rows.empty:
        return np.nan, np.nan
    mode, energy = rows["loading_mode"].iloc[0], required.get("min_absorbed", np.nan)
    if mode not in MEASURES["max_force"].asked_of:
        return np.nan, np.nan
    if mode == "impact":
        together = rows["panel_specimens"] if per == "panel" else 1.0
        energy = float((rows["impact_energy_J"] * together).min())
    return energy, energy / required["max_force"]

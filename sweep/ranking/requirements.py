"""Requirements on a part: limits on its results, by which designs are excluded from a ranking.

A requirement applies to a specimen or to the panel. The force of a panel is the sum over its
specimens, since all are pressed alike; stroke and deceleration are the same for both. No curve with
a force below F absorbs an energy W in a stroke shorter than W / F, the stroke of a rectangle.

A requirement does not apply to a loading that sets its quantity: the force and the energy under a
dead load, and the energy of a striker, are no properties of the design.

If no design fulfils the requirements, the nearest one has the smallest worst miss: a value v misses
a greatest value L by v / L - 1, and a least value L by 1 - v / L.
"""

import difflib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from pandas import DataFrame, Series

from sweep.columns import SAME_EFFICIENCY, end_columns, error_column
from sweep.loading_modes import MODES, applies_to, has, mode_of
from sweep.numbers import text_in, to_si
from sweep.ranking.budget import ROUND_OFF, within_budget
from sweep.ranking.merit import Compared, doubtful
from sweep.ranking.question import Quantity, RankError, in_si
from sweep.ranking.requirement_table import MEASURES


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
        of designs that fulfil them and are marked as beyond the model or as crossed. coarse: number
        of others that fulfil them, with steps that are too long. close: the rows of trusted
        designs that meet or miss each requirement by less than the error of their value, nearest
        first, and that miss no other one by more.
    failed: number of designs that fail each requirement. unknown: number of these designs that
        have no value for it. open: number of designs that fail only `min_absorbed` and may fulfil
        it in a longer crush, as they were crushed too little for all energy to be counted.
    best: the value nearest to fulfilling each requirement.
    left_out: requirements that do not apply to this kind of loading.
    nearest: if no trusted design fulfils all: the row of the nearest one that does not, a doubtful
        one only if there is no other; no row if nothing is known. missed: the requirements that it
        misses, with its values. misses: by what share of the limit.
    lightest: the row of the lightest trusted design that fulfils all, of any mass; or no row.
    energy, force, stroke: energy that must be absorbed, the force that is allowed meanwhile, and
        the least stroke in which that is possible; NaN if one of the first two is not given.
    height: of the highest lattice.
    """

    mode: str
    budget_g: float
    designs: int
    fulfil: int
    doubtful: int
    coarse: int
    close: Mapping[str, DataFrame]
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
    force: float
    stroke: float
    height: float


def limits(require: Mapping[str, Quantity | None] | None) -> dict[str, float]:
    """The limits (SI) of the requirements that are given, by name."""
    required = {name: value for name, value in (require or {}).items() if value is not None}
    for name in required:
        if name not in MEASURES:
            nearest = difflib.get_close_matches(name, MEASURES, n=1, cutoff=0.0)[0]
            text = f'{name} = "{required[name]}"'
            raise RankError(f"{text}: unknown requirement; the nearest is {nearest}")
    return {
        name: in_si(required[name], MEASURES[name].unit) for name in MEASURES if name in required
    }


def unknown_of(name: str, limit: float, cases: str, needed: str) -> RankError:
    """The refusal of a requirement (SI) that these cases, in words, have no value for."""
    text = f'{name} = "{text_in(limit, MEASURES[name].shown)}"'
    return RankError(f"{text}: not known of {cases}; needed: {needed}")


def check_modes(required: Mapping[str, float], modes: Iterable[str]) -> None:
    """Refuse a requirement (SI) that applies to none of these kinds of loading."""
    kinds = set(modes)
    for name, limit in required.items():
        fitting = applies_to(name)
        if kinds and not kinds.intersection(fitting):
            loadings = " or ".join(sorted(MODES[mode].noun for mode in kinds))
            needed = " or ".join(MODES[mode].noun for mode in fitting)
            raise unknown_of(name, limit, loadings, needed)


def check(rows: DataFrame, required: Mapping[str, float]) -> None:
    """Refuse requirements that apply to no row."""
    if rows.empty:
        return
    check_modes(required, rows["loading_mode"].unique())
    if "max_stroke" in required and rows["counted_stroke_m"].isna().all():
        raise RankError(
            "max_stroke is unknown up to an allowed force without the curves: rank the file itself"
        )


class Judged(NamedTuple):
    """The rows of one scene with their values for the requirements, and whether they meet them.

    mass: name of the column that budgets limit. limits: the limits (SI) of the requirements that
    apply to this kind of loading; left_out: the other requirements. measures (rows, limits):
    measured values. shares (rows, limits): from `misses`. close (rows, limits): from `_distances`.
    fulfil (rows,).
    """

    rows: DataFrame
    mass: str
    limits: Mapping[str, float]
    left_out: tuple[str, ...]
    measures: DataFrame
    shares: DataFrame
    close: DataFrame
    fulfil: Series

    def within(self, budget_g: float) -> "Judged":
        """The same for the rows within a budget."""
        kept = within_budget(self.rows[self.mass], budget_g)
        tables = ("rows", "measures", "shares", "close", "fulfil")
        return self._replace(**{name: getattr(self, name)[kept] for name in tables})


def judge(
    rows: DataFrame,
    names: Compared,
    required: Mapping[str, float],
    per: str,
    budgets_g: Sequence[float],
    allowed: float,
) -> tuple[Series, tuple[Outcome, ...]]:
    """Which rows of one scene fulfil all requirements, and the outcome within each budget.

    budgets_g: masses in grams; infinite without a budget. allowed: force (N) up to which the
    energy of a crush is counted; NaN without one.
    """
    mode = str(rows["loading_mode"].iloc[0]) if len(rows) else ""
    mode_limits = {k: limit for k, limit in required.items() if mode in applies_to(k)}
    measures = measured(rows, names, per)
    values = DataFrame({name: measures[name] for name in mode_limits}, index=rows.index)
    shares = misses(rows, measures, mode_limits)
    fulfil = rows["mass_g"].notna() & (shares == 0.0).all(axis=1)
    left_out = tuple(name for name in required if name not in mode_limits)
    if not required or rows.empty:
        return fulfil, ()
    close = _distances(values, shares, relative_errors(rows, names), mode_limits)
    judged = Judged(rows, names.mass, mode_limits, left_out, values, shares, close, fulfil)
    rectangle = _rectangle(rows, required, per, allowed)
    return fulfil, tuple(_outcome(judged, mode, g, *rectangle) for g in budgets_g)


def _outcome(judged: Judged, mode: str, budget_g: float, energy: float, force: float) -> Outcome:
    """The outcome within one budget."""
    every, part = judged.rows[judged.fulfil], judged.within(budget_g)
    sound = ~doubtful(part.rows)
    soundly = int((part.fulfil & sound).sum())
    coarse = int((part.fulfil & sound & part.rows["coarse"]).sum())
    nearest, shares = (part.rows[:0], {}) if soundly else _nearest(part)
    order = [part.mass, "case_id"]
    return Outcome(
        mode=mode,
        budget_g=budget_g if np.isfinite(budget_g) else np.nan,
        designs=len(part.rows),
        fulfil=int(part.fulfil.sum()),
        doubtful=int(part.fulfil.sum()) - soundly,
        coarse=coarse,
        close={name: _close(part, name, sound) for name in part.limits},
        failed={name: int((part.shares[name] != 0.0).sum()) for name in part.limits},
        unknown={name: int(part.measures[name].isna().sum()) for name in part.limits},
        open=_open(part, energy, force),
        best={k: _best(part.measures[k], sound, MEASURES[k].least) for k in part.limits},
        left_out=part.left_out,
        nearest=nearest,
        missed={name: float(part.measures.loc[nearest.index[0], name]) for name in shares},
        misses=shares,
        lightest=every[~doubtful(every)].sort_values(order)[:1],
        energy=energy,
        force=force,
        stroke=energy / force,
        height=float(judged.rows["height_m"].max()),
    )


def measured(rows: DataFrame, names: Compared, per: str) -> dict[str, Series]:
    """The value (SI) of each row for each requirement, per specimen or per panel.

    For a crush, energy and force count while the usable energy is absorbed; an impact or a dead
    load counts as a whole. The deceleration is filtered.
    """
    crushed = has(rows, "driven")
    together = rows.get("panel_specimens", 1.0)
    of_specimen = {
        "max_force": rows["passed_on_N"].where(crushed, rows["peak_force_N"]),
        "max_deceleration": rows["peak_deceleration_filtered_m_per_s2"],
        "max_base_pressure": rows["peak_base_pressure_Pa"],
        "max_target_acceleration": rows["peak_target_acceleration_m_per_s2"],
        "max_mass": to_si(rows[names.mass], "g") / together,
        "min_absorbed": (rows[names.energy] / together).where(crushed, rows["absorbed_energy_J"]),
        "max_stroke": rows["counted_stroke_m"],
    }
    return {
        name: values * together if per == "panel" and MEASURES[name].shared else values
        for name, values in of_specimen.items()
    }


def relative_errors(rows: DataFrame, names: Compared) -> dict[str, Series]:
    """The error of the value of each row for each requirement, relative to that value: the greatest
    of the estimate of its load steps, of its error bar, and of its range where two strains of
    densification are as good. 0 where none is known.

    The efficiency energy / greatest force is nearly the same at both strains, so that their forces
    lie between the lower energy / efficiency and the higher one / (1 - `SAME_EFFICIENCY`) of it.
    The stroke follows from one of the strains.
    """
    crushed = has(rows, "driven")
    low, high = (rows.get(name, rows[names.energy]) for name in end_columns(names.energy))
    of_energy = np.fmax(rows[names.energy] - low, high - rows[names.energy]) / rows[names.energy]
    count = rows["panel_specimens"] if names.energy == "panel_energy_J" else 1.0
    force = rows["passed_on_N"] * count
    efficiency = rows["absorbed_energy_at_densification_J"] / rows["peak_force_at_densification_N"]
    most = high / ((1.0 - SAME_EFFICIENCY) * efficiency)
    twice = high > low * (1.0 + ROUND_OFF)
    of_force = (np.fmax(force - low / efficiency, most - force) / force).where(twice)
    packed = rows["packing_strain"]
    first, last = (rows.get(f"{end}_densification_strain", packed) for end in ("lowest", "highest"))
    of_stroke = (np.fmax(packed - first, last - packed) / packed).where(twice)
    whole = _bar(rows, "peak_force_N")
    none = Series(0.0, index=rows.index)
    errors = {
        "max_force": [_bar(rows, "passed_on_N").where(crushed, whole), of_force],
        "max_deceleration": [_bar(rows, "peak_deceleration_filtered_m_per_s2")],
        "max_target_acceleration": [whole],  # force / mass
        "min_absorbed": [_bar(rows, names.energy), of_energy],
        "max_stroke": [
            _bar(rows, "packing_strain").where(crushed, _bar(rows, "peak_strain")),
            of_stroke,
        ],
    }
    of_steps = {name: rows.get(one.step_error, none) for name, one in MEASURES.items()}
    each = {name: [none, of_steps[name], *errors.get(name, [])] for name in MEASURES}
    greatest = {name: np.fmax.reduce(some, dtype=float) for name, some in each.items()}
    return {name: Series(errors, rows.index) for name, errors in greatest.items()}


def _bar(rows: DataFrame, name: str) -> Series:
    """The error bar of a column relative to its values, 0 without one."""
    error = rows.get(error_column(name), Series(0.0, index=rows.index))
    return (error / rows[name]).fillna(0.0)


def _distances(
    values: DataFrame,
    shares: DataFrame,
    errors: Mapping[str, Series],
    required: Mapping[str, float],
) -> DataFrame:
    """By what share of its limit each value lies beside it, (rows, required): NaN unless that is
    less than its error, and in a row that misses another limit by more than its error.

    values, shares (rows, required): from `measured`, `misses`. errors: from `relative_errors`.
    """
    near = values.copy()
    for name, limit in required.items():
        apart = abs(MEASURES[name].share_missed(values[name], limit))
        near[name] = apart.where(apart < errors[name] * values[name] / limit)
    return near[(near.notna() | (shares == 0.0)).all(axis=1)].reindex(near.index)


def misses(
    rows: DataFrame, measures: Mapping[str, Series], required: Mapping[str, float]
) -> DataFrame:
    """By what share of its limit each row misses each requirement, (rows, required).

    0 if the requirement is met, up to round-off, or does not apply to this loading; NaN if the
    value is unknown. measures: from `measured`.
    """
    shares = DataFrame(index=rows.index)
    for name, limit in required.items():
        share = MEASURES[name].share_missed(measures[name].astype(float), limit)
        in_mode = rows["loading_mode"].isin(applies_to(name))
        shares[name] = share.mask(share <= ROUND_OFF, 0.0).where(in_mode, 0.0)
    return shares


def nearest_first(rows: DataFrame, mass: str, shares: DataFrame) -> Series:
    """The greatest miss of each row by its index, starting with the nearest design.

    Trusted designs come before others; the lightest comes first among equal misses. Infinite if a
    value is unknown. mass: name of the column that budgets limit. shares: from `misses`.
    """
    worst = shares.assign(none=0.0).max(axis=1, skipna=False).fillna(np.inf)
    order = rows.assign(worst=worst, doubtful=doubtful(rows))
    return worst[order.sort_values(["doubtful", "worst", mass, "case_id"]).index]


def _best(values: Series, sound: Series, least: bool) -> Best:
    """The best value of the trusted designs, else of all; NaN if none has one."""
    trusted = values[sound].dropna()
    candidates = values if trusted.empty else trusted
    return Best(float(candidates.max() if least else candidates.min()), trusted.empty)


def _close(part: Judged, name: str, sound: Series) -> DataFrame:
    """The trusted rows that are nearer to a limit than their errors, the nearest first, with their
    values (SI) and whether they meet it in columns: value, meets.
    """
    rows = part.rows.assign(value=part.measures[name], meets=part.shares[name] == 0.0)
    return rows.loc[part.close[name][sound].dropna().sort_values(kind="stable").index]


def _open(part: Judged, energy: float, force: float) -> int:
    """Number of designs that fail `min_absorbed` alone, with an energy that is a lower bound.

    A longer crush cannot absorb the required energy (J) if the allowed force (N) over the whole
    height, or over the greatest stroke, would not.
    """
    if "min_absorbed" not in part.limits:
        return 0
    others = (part.shares.drop(columns="min_absorbed") == 0.0).all(axis=1)
    short = part.shares["min_absorbed"] > 0.0
    stroke = part.rows["height_m"].clip(upper=part.limits.get("max_stroke", np.inf))
    impossible = force * stroke < energy
    return int((part.rows["ends_early"] & short & others & ~impossible).sum())


def _nearest(part: Judged) -> tuple[DataFrame, dict[str, float]]:
    """The row of the nearest design, and its misses; no row if nothing is known or required."""
    worst = nearest_first(part.rows, part.mass, part.shares)
    index = worst[np.isfinite(worst) & (worst > 0.0)].index[:1]
    shares = {name: float(part.shares.loc[i, name]) for i in index for name in part.limits}
    return part.rows.loc[index], {name: share for name, share in shares.items() if share > 0.0}


def _rectangle(
    rows: DataFrame, required: Mapping[str, float], per: str, allowed: float
) -> tuple[float, float]:
    """The energy (J) that must be absorbed and the force (N) that is allowed meanwhile.

    The energy is the energy of the striker relative to the base; in a crush, the least that is
    required.
    """
    mode, force = mode_of(rows), required.get("max_force", np.nan)
    if mode.driven:
        return required.get("min_absorbed", np.nan), float(np.fmin(force, allowed))
    if not mode.struck:
        return np.nan, np.nan
    together = rows["panel_specimens"] if per == "panel" else 1.0
    return float((relative_energy(rows) * together).min()), force


def relative_energy(rows: DataFrame) -> Series:
    """Energy (J) of the striker relative to the base, which the lattice must absorb.

    For a base that moves freely, m M / (m + M) v^2 / 2; the rest stays in the common motion.
    """
    ratio = (rows["striker_mass_g"] / rows["target_mass_g"]).fillna(0.0)
    return rows["impact_energy_J"] / (1.0 + ratio)

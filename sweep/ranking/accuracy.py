"""Error against run time: a sweep over numerical settings, compared with an extrapolated reference.

A method is a choice of settings without a size (integrator, element, contact model ...). It is
refined in time step, load steps or error of a step, and in elements per wall. Cases that differ in
anything other than numerical settings belong to different scenes.
"""

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import NamedTuple

import numpy as np
import pandas as pd
from pandas import DataFrame, Series

from sweep.array_types import Floats
from sweep.columns import is_grid_key
from sweep.config.faults import ReportedError
from sweep.loading_modes import MODES, Mode
from sweep.ranking.richardson import limit, rms
from sweep.result import Status
from sweep.store.read import read_history

MEASURES = ("energy", "peak", "path")
TARGETS = (0.01, 0.001)  # relative errors for which the cheapest settings are reported
FINER_IF_SMALLER = ("solver.time_step", "solver.step_error")
FINER_IF_GREATER = (
    *("solver.load_steps", "loading.load_steps"),
    *("lattice.nodes_per_wall", "lattice.layers"),
)
REFINED = (*FINER_IF_SMALLER, *FINER_IF_GREATER)
GAIN = 0.05  # share of an error: least gain of a more expensive setting on the front
EQUALS = 4  # first numbers of `_merit`; methods that agree in them should have the same limit
_ANY_OF = ", ".join(REFINED)
METHOD = ("solver.", "contact.model")
FORMAL_ORDER = {"newmark": 2, "bdf2": 2, "backward_euler": 1}
STORED = ("kinetic_J", "stretch_J", "bend_J", "contact_J")


class Reference(NamedTuple):
    """Limit of a measure.

    value (k,) and scale in SI; doubt: uncertainty of the value / scale; orders: key -> observed
    order.
    """

    value: Floats
    scale: float
    doubt: float
    orders: dict[str, float]


class Study(NamedTuple):
    """One scene.

    settings: a row per case, in the order of the sweep: the row of the summary, `method`, the
        relative errors `energy`, `peak` and `path`, the greatest of the resolved ones, `worst`, and
        `front`: True if no setting as cheap has a smaller `worst`.
    finest: row of the setting from which the references are extrapolated.
    orders: method -> measure -> key -> observed order.
    resolved: measures whose reference is certain enough for the coarsest target.
    """

    settings: DataFrame
    finest: Series
    references: dict[str, Reference]
    orders: dict[str, dict[str, dict[str, float]]]
    resolved: tuple[str, ...]


class AccuracyError(ReportedError, ValueError):
    """A sweep that is not an accuracy study."""


def studies(file: str | PathLike[str], summary: DataFrame) -> list[Study]:
    """One study for each scene of a sweep with a converged case.

    summary: the rows of the cases of the sweep, of any status.
    """
    status = summary["status"].where(summary["retry"] == "", Status.STOPPED)
    summary = summary.assign(status=status)  # a retry has other settings than its row
    refined = refined_keys(summary)
    keys = [key for key in summary if is_grid_key(key) and not key.startswith(METHOD + REFINED)]
    scenes = summary.groupby(keys, dropna=False, sort=False) if keys else [(None, summary)]
    converged = [rows for _, rows in scenes if (rows["status"] == Status.CONVERGED).any()]
    return [_study(file, rows, refined) for rows in converged]


def check_axes(axes: Sequence[Mapping[str, object]]) -> None:
    """Refuse, before it runs, a sweep that is not an accuracy study; `axes`: of every case."""
    refined_keys(DataFrame(axes))


def refined_keys(axes: DataFrame) -> list[str]:
    """Grid keys of a sweep that refine a method; refused if there is none."""
    refined = [key for key in REFINED if key in axes and varies(axes[key])]
    if not refined:
        raise AccuracyError(f"[grid] refines nothing; allowed: two values or more of {_ANY_OF}")
    return refined


def varies(column: Series) -> bool:
    """True if a column has more than one value, or a value in some rows only."""
    return len(column.unique()) > 1


def size(key: str, value: float) -> float:
    """The size that belongs to a value of a key: of a step, or of an element / length of its
    wall.
    """
    if key in FINER_IF_SMALLER:
        return value
    return 1.0 / (value + (key == "lattice.nodes_per_wall"))


def _study(file: str | PathLike[str], rows: DataFrame, refined: list[str]) -> Study:
    rows = rows.assign(method=_methods(rows))
    done = rows[rows["status"] == Status.CONVERGED]
    values = _values(file, done)
    by_method = {
        method: _references(group, values, refined) for method, group in done.groupby("method")
    }
    finest, references = _best_references(by_method, refined)
    errors = DataFrame(
        {
            name: {i: rms(values[name][i] - ref.value) / ref.scale for i in done.index}
            for name, ref in references.items()
        }
    )
    resolved = tuple(name for name in MEASURES if references[name].doubt < TARGETS[0])
    certain = [errors[name].clip(lower=references[name].doubt) for name in resolved]
    worst = np.max(certain, axis=0) if certain else np.nan
    settings = rows.join(errors.assign(worst=worst))
    orders = {
        method: {name: ref.orders for name, ref in each.items()}
        for method, (_, each) in by_method.items()
    }
    return Study(
        settings.assign(front=front(settings, "worst")), finest, references, orders, resolved
    )


def _best_references(
    by_method: dict[str, tuple[Series, dict[str, Reference]]], refined: list[str]
) -> tuple[Series, dict[str, Reference]]:
    """The references of the best method, with more doubt if equivalent methods have other
    limits.
    """
    merits = {method: _merit(*each, refined) for method, each in by_method.items()}
    best = min(merits, key=lambda method: merits[method])
    equals = [m for m in by_method if merits[m][:EQUALS] == merits[best][:EQUALS]]
    finest, references = by_method[best]
    return finest, {
        name: _doubted(ref, [by_method[method][1][name] for method in equals])
        for name, ref in references.items()
    }


def _methods(rows: DataFrame) -> Series:
    """The method of every row, in words."""
    parts = [
        rows[key].map(lambda value, key=key: _word(key, value))
        for key in rows
        if key.startswith(METHOD) and key not in REFINED and varies(rows[key])
    ]
    if "solver.step_error" in rows and rows["solver.step_error"].isna().any():
        parts.append(rows["solver.step_error"].map(lambda v: "" if pd.isna(v) else "by error"))
    words = [", ".join(filter(None, texts)) for texts in zip(*parts, strict=True)]
    return Series(words or "as set", index=rows.index)


def _word(key: str, value: object) -> str:
    """A choice in words; a number gets the name of its key."""
    text = value if isinstance(value, str) else f"{key.split('.')[-1]} {value:g}"
    return text.replace("_", " ")


def _references(
    rows: DataFrame, values: dict[str, dict[int, Floats]], refined: list[str]
) -> tuple[Series, dict[str, Reference]]:
    """The finest setting of a method, and the extrapolated limits of its measures."""
    keys = [key for key in refined if varies(rows[key].dropna())]
    sizes = DataFrame({key: rows[key].map(lambda v, key=key: size(key, v)) for key in keys})
    finest = sizes.sort_values(keys).index[0] if keys else rows.index[-1]
    series = {}
    for key in keys:
        others = sizes.drop(columns=key)
        alike = sizes[(others == others.loc[finest]).all(axis=1)].sort_values(key, ascending=False)
        if len(alike) > 1:
            series[key] = alike[key]
    return rows.loc[finest], {
        name: _extrapolated(series, values[name], finest) for name in MEASURES
    }


def _extrapolated(series: dict[str, Series], values: dict[int, Floats], finest: int) -> Reference:
    """The finest value, extrapolated to its limit along every series of sizes."""
    value, doubt, orders = values[finest], 0.0 if series else np.inf, {}
    for key, of_key in series.items():
        fit = limit(of_key.tolist(), [values[i] for i in of_key.index])
        value, doubt, orders[key] = value + fit.correction, doubt + fit.doubt, fit.order
    scale = float(np.ptp(value) if len(value) > 1 else np.abs(value[0])) or np.nan
    return Reference(value, scale, doubt / scale, orders)


def _doubted(reference: Reference, rivals: list[Reference]) -> Reference:
    """The reference with its doubt increased to cover the limits of methods that should share
    it.
    """
    gaps = [rms(rival.value - reference.value) / reference.scale - rival.doubt for rival in rivals]
    return reference._replace(doubt=max([reference.doubt, *gaps]))


def _merit(
    finest: Series, references: dict[str, Reference], refined: list[str]
) -> tuple[float, ...]:
    """Numbers that sort methods; the method with the least is the reference.

    Preferred are constant steps, refinement in all keys, high order, the barrier, cubic elements, a
    small tolerance and little doubt. Methods that agree in the first `EQUALS` numbers should have
    the same limit.
    """
    steps_by_error = "solver.step_error" in finest and np.isfinite(finest["solver.step_error"])
    doubts = [ref.doubt for ref in references.values()]
    return (
        float(steps_by_error),
        -float(sum(key in references["energy"].orders for key in refined)),
        -float(FORMAL_ORDER.get(finest.get("solver.integrator", ""), 0)),
        float(finest.get("contact.model") not in ("auto", "barrier")),
        float(finest.get("solver.element") != "cubic"),
        float(finest.get("solver.tolerance", 0.0)),
        float(np.nansum(np.minimum(doubts, 1.0))),
    )


def front(settings: DataFrame, error: str) -> Series:
    """True for settings whose error (a column) is below the errors of all cheaper ones by
    `GAIN`.
    """
    ordered = settings.sort_values(["cpu_s", error])[error]
    cheaper = ordered.cummin().shift(fill_value=np.inf)
    return (ordered < (1.0 - GAIN) * cheaper).reindex(settings.index)


def _values(file: str | PathLike[str], rows: DataFrame) -> dict[str, dict[int, Floats]]:
    """Every measure of every row; paths are interpolated at the same places."""
    curves = {i: read_history(file, row["case_id"]) for i, row in rows.iterrows()}
    paths = {i: path(MODES[rows.loc[i, "loading_mode"]], curve) for i, curve in curves.items()}
    coarsest = min((place for place, _ in paths.values()), key=len)
    end = min(place[-1] for place, _ in paths.values())
    at = coarsest[coarsest <= end * (1 + 1e-6)]
    return {
        "energy": {i: np.array([energy(rows.loc[i], curves[i])]) for i in rows.index},
        "peak": {i: np.array([peak(rows.loc[i], curves[i])]) for i in rows.index},
        "path": {
            i: np.concatenate([np.interp(at, place, curve) for curve in values] or [[np.nan]])
            for i, (place, values) in paths.items()
        },
    }


def energy(row: Series, history: DataFrame) -> float:
    """Energy absorbed (J); for a custom structure, its energy at the end."""
    if MODES[row["loading_mode"]].probed:
        return float(history[list(STORED)].iloc[-1].sum())
    return float(row["absorbed_energy_J"])


def peak(row: Series, history: DataFrame) -> float:
    """Greatest force (N), also under a dead load whose rows are too far apart to resolve it; for a
    custom structure, the greatest reaction at a probe.
    """
    if not MODES[row["loading_mode"]].probed:
        if np.isnan(row["peak_force_N"]):
            return float(history[["reaction_top_N", "reaction_bottom_N"]].max(axis=None))
        return float(row["peak_force_N"])
    across, along = (history.filter(regex=f"_reaction_{way}_N$").to_numpy() for way in "xy")
    return float(np.hypot(across, along).max()) if across.size else np.nan


def path(mode: Mode, history: DataFrame) -> tuple[Floats, list[Floats]]:
    """The abscissa of a path, (rows,), and the curves that are compared over it, (rows,) each.

    Force over the travel of a driven platen; strain over time under a dead load or a striker; moves
    of the probes of a custom structure over time.
    """
    if mode.driven:
        travel = history["top_displacement_m"].diff().abs().cumsum().fillna(0.0)
        return travel.to_numpy(), [history["reaction_top_N"].to_numpy()]
    time = history["time_s"].to_numpy()
    if mode.probed:
        places = history.filter(regex=r"^probe_\d+_[xy]_m$").to_numpy().T
        return time, [place - place[0] for place in places if np.ptp(place) > 0.0]
    return time, [history["strain"].to_numpy()]

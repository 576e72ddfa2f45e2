"""Which design absorbs the most energy: per gram, within a weight budget, below an allowed force.

A specimen of width w, wall thickness t and depth b stands for a panel when it is repeated side by
side:  factor = panel area / ((w + t) b),  panel mass = factor mass,  panel energy = factor energy.

Only cases of the same loading scene are compared: a block under a dead load of 5 N and one crushed
to half its height absorb energies that answer different questions.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Sequence
from os import PathLike
from typing import Any

import numpy as np
import pandas as pd
from pandas import DataFrame, Series

from sweep.result import Status, absorbed_energy_column

Quantity = float | str
"""A number in SI, or text with a unit such as "25 g"."""

NOTHING = "–"
ABSORBED_AT = re.compile(r"absorbed_energy_at_(.+)N_J")

SCENE = ["loading_mode", "platen", "force_N"]

HELD_BY_SCENE = ("loading.mode", "loading.platen", "loading.force", "loading.allowed_forces")
ASSUMPTIONS = (
    "loading.",
    "contact.",
    "damping.",
    "solver.",
    "lattice.nodes_per_wall",
    "lattice.imperfection",
    "material.stretch",
    "material.bend",
    "material.plane",
    "material.poisson",
)
"""Grid keys that say how a design was tested, not what it is: each value is a scene of its own."""

LEADING = ["budget_g", "scene", "place", "pareto", "case_id", "panel_mass_g", "panel_energy_J"]

LESS_IS_BETTER = frozenset(
    {
        "mass_g",
        "panel_mass_g",
        "relative_density",
        "peak_force_N",
        "returned_energy_J",
        "residual_strain",
        "cpu_s",
    }
)
"""Columns that `by` sorts upwards; all others count the greatest as the best."""


class RankError(ValueError):
    """A ranking that cannot be made; the text is one sentence that says what is allowed."""


def rank(
    source: str | PathLike[str] | DataFrame,
    budget: Quantity | Sequence[Quantity] | None = None,
    panel: Sequence[Quantity] | None = None,
    by: str | None = None,
    top: int | None = 10,
    allowed_force: Quantity | None = None,
) -> DataFrame:
    """Best designs of each loading scene, best first.

    Parameters
    ----------
    source : results file, or a summary as `read_summary` gives it.
    budget : greatest mass (kg, or text with a unit) of the panel, or of the specimen without one.
        Several budgets give a ranking each, told apart by the column `budget_g`.
    panel : the two lengths (m, or text with a unit) of the area that the specimens fill.
    by : column to sort by. Default: the absorbed energy where a budget or a panel is given (a
        budget is there to be spent), else the absorbed energy per gram.
    top : places kept for each scene and budget; None keeps all.
    allowed_force : count energy only up to this force (N, or text) passed on by one specimen, which
        needs the column `absorbed_energy_at_..N_J`.

    Returns
    -------
    The summary's rows that have a place, led by `budget_g`, `scene`, `place` (equal values share
    one) and `pareto` (True: no design of the scene is lighter without absorbing less, none absorbs
    more without being heavier), and with a panel `panel_mass_g`, `panel_energy_J`.
    `attrs`: names of the columns compared (`mass`, `energy`, `per_gram`, `by`), the counts `cases`,
    `failed`, `unranked` (finished, but without a value to sort by), `budgets_g`, and `lightest_g`,
    the smallest mass of each scene.
    """
    summary = source if isinstance(source, DataFrame) else _read(source)
    finished = summary[summary["status"] == Status.CONVERGED]
    compared, names = _scaled(finished, panel, allowed_force)
    usual = names["energy" if budget is not None or panel is not None else "per_gram"]
    names["by"] = _column(compared, by or usual)
    limits = [_si(mass, "kg") * 1e3 for mass in _several(budget)] or [np.inf]
    scenes = [_with_scene(rows, names) for rows in by_scene(compared)]
    parts = [_places(rows, names, limit, top) for rows in scenes for limit in limits]
    ranking = pd.concat(parts, ignore_index=True)
    ranking.attrs = names | {
        "cases": len(summary),
        "failed": len(summary) - len(finished),
        "unranked": int(compared[names["by"]].isna().sum()),
        "budgets_g": [limit for limit in limits if np.isfinite(limit)],
        "lightest_g": pd.concat(scenes).groupby("scene", sort=False)[names["mass"]].min().to_dict(),
    }
    return ranking


def by_scene(frame: DataFrame) -> list[DataFrame]:
    """The rows of each loading scene, in the order in which scenes first appear."""
    groups = frame.groupby(scene_keys(frame), dropna=False, sort=False)
    return [rows for _, rows in groups] or [frame]


def scene_keys(frame: DataFrame) -> list[str]:
    """Columns whose values make a loading scene: never compare rows that differ in one."""
    assumed = [key for key in frame if key.startswith(ASSUMPTIONS) and key not in HELD_BY_SCENE]
    return [key for key in SCENE if key in frame] + assumed


def scene_label(rows: DataFrame) -> str:
    """What was done to these cases of one scene, in words; different for every scene."""
    if rows.empty:
        return ""
    first = rows.iloc[0]
    said = set(SCENE)
    if first["loading_mode"] == "force":
        words = [f"dead load of {first['force_N']:g} N"]
    elif len(strains := (rows["stroke_m"] / rows["height_m"]).round(6).unique()) == 1:
        words = [f"crushed to {100 * strains[0]:g} %"]
        said |= {"loading.strain", "loading.stroke"}
    else:
        words = ["crushed"]
    platen = first["platen"]
    words.append("no platens" if platen in ("none", "") else f"{platen} platens")
    others = [key for key in scene_keys(rows) if key not in said]
    words += [f"{key.replace('.', ' ').replace('_', ' ')} {short(first[key])}" for key in others]
    return ", ".join(words)


def pareto(mass: Series, energy: Series) -> Series:
    """True where nothing lighter absorbs as much and nothing as light absorbs more."""
    best = energy.groupby(mass).max()
    lighter = best.cummax().shift(fill_value=-np.inf)
    return (energy == mass.map(best)) & (energy > mass.map(lighter))


def short(value: float | str | None) -> str:
    """A number with few digits, anything else as it is; a dash where there is nothing."""
    if pd.isna(value):
        return NOTHING
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def panel_factor(frame: DataFrame, panel: Sequence[Quantity]) -> Series:
    """Number of specimens, side by side, that fill the area of the panel."""
    if len(panel) != 2:
        raise RankError(f"a panel has two lengths, got {len(panel)}")
    area = _si(panel[0], "m") * _si(panel[1], "m")
    return area / ((frame["width_m"] + frame["wall_thickness_m"]) * frame["depth_m"])


def _scaled(
    finished: DataFrame, panel: Sequence[Quantity] | None, allowed_force: Quantity | None
) -> tuple[DataFrame, dict[str, str]]:
    """Rows with the columns that are compared, and the names of these."""
    names = {
        "mass": "mass_g",
        "energy": "absorbed_energy_J",
        "per_gram": "specific_absorption_J_per_g",
    }
    added: dict[str, Series] = {}
    if allowed_force is not None:
        names["energy"] = _energy_column(finished, _si(allowed_force, "N"))
        names["per_gram"] = f"{names['energy']}_per_g".replace(
            "absorbed_energy", "specific_absorption"
        )
        added[names["per_gram"]] = finished[names["energy"]] / finished["mass_g"]
    if panel is not None:
        factor = panel_factor(finished, panel)
        added["panel_mass_g"] = factor * finished["mass_g"]
        added["panel_energy_J"] = factor * finished[names["energy"]]
        names |= {"mass": "panel_mass_g", "energy": "panel_energy_J"}
    return finished.assign(**added), names


def _with_scene(rows: DataFrame, names: dict[str, str]) -> DataFrame:
    """Rows of one scene with its label and their Pareto flag."""
    front = pareto(rows[names["mass"]], rows[names["energy"]])
    return rows.assign(scene=scene_label(rows), pareto=front)


def _places(rows: DataFrame, names: dict[str, str], budget_g: float, top: int | None) -> DataFrame:
    """The first places among the rows of one scene within a budget, best first.

    Equal values share a place and are listed lighter first, then by id: the order never depends on
    the order of the rows.
    """
    by, mass = names["by"], names["mass"]
    upwards = by in LESS_IS_BETTER
    rows = rows[rows[mass] <= budget_g].dropna(subset=by)
    rows = rows.assign(
        budget_g=budget_g if np.isfinite(budget_g) else np.nan,
        place=rows[by].rank(method="min", ascending=upwards).astype(int),
    )
    order = ["place", *dict.fromkeys([mass, "case_id"])]
    rows = rows.sort_values(order).head(len(rows) if top is None else top)
    first = [name for name in LEADING if name in rows]
    return rows[first + [name for name in rows if name not in first]]


def _column(frame: DataFrame, by: str) -> str:
    """The column to sort by, refused with the nearest one unless it holds numbers."""
    allowed = [name for name in frame.select_dtypes("number") if "." not in name]
    if by in allowed:
        return by
    nearest = difflib.get_close_matches(by, allowed, n=1, cutoff=0.4)
    hint = f"did you mean {nearest[0]}? " if nearest else ""
    raise RankError(f'cannot sort by "{by}"; {hint}allowed: {", ".join(allowed)}')


def _energy_column(frame: DataFrame, force: float) -> str:
    """The column of the energy absorbed up to an allowed force (N), which the sweep must hold."""
    name = absorbed_energy_column(force)
    if name in frame:
        return name
    held = [match[1] for key in frame if (match := ABSORBED_AT.fullmatch(key))]
    known = " or ".join(f"{text} N" for text in held) or "none (set loading.allowed_forces)"
    raise RankError(f"no energies up to {force:g} N in these results; allowed: {known}")


def _several(budget: Quantity | Sequence[Quantity] | None) -> list[Quantity]:
    """No, one or several budgets as a list."""
    if budget is None:
        return []
    return [budget] if isinstance(budget, float | int | str) else list(budget)


def _si(value: Any, unit: str) -> float:
    """A positive number in SI, from a number or from text with a unit."""
    if isinstance(value, str):
        from sweep.config import quantity

        value = quantity(value, unit)
    if not value > 0.0:
        raise RankError(f"{value:g} {unit}: budgets, panels and forces must be above zero")
    return float(value)


def _read(path: str | PathLike[str]) -> DataFrame:
    """The summary of a results file; only here is the store needed."""
    from sweep.store import read_summary

    return read_summary(path)

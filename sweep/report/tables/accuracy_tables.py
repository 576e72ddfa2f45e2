"""Tables of an accuracy study: errors and run times, observed orders, recommended settings."""

from collections.abc import Iterable, Iterator
from textwrap import fill

import numpy as np
import pandas as pd
from pandas import DataFrame, Series

from sweep.columns import is_grid_key
from sweep.loading_modes import mode_of
from sweep.numbers import (
    NOTHING,
    counted,
    energy_text,
    in_unit,
    short,
    significant,
    text_in,
    three_digits,
)
from sweep.ranking.accuracy import REFINED, TARGETS, Study, varies
from sweep.ranking.scenes import HELD_BY_SCENE, key_words, scene_keys, scene_label
from sweep.report.tables.sheet import Sheet
from sweep.result import Status

WIDTH = 100  # letters of a line below a table
LEAST_SHOWN = 1e-5  # relative error; smaller ones are shown as "<" this value
MARKS = """\
*: on the front: no setting as cheap has a smaller greatest error. peak: of the stored rows. path:
rms over the history / its range. elements: per wall. <: below the uncertainty of the reference."""


def accuracy_sheets(study: Study, title: str) -> Iterator[Sheet]:
    """Two sheets: errors and processor times of all settings by method; observed orders."""
    numbers, _ = pd.factorize(study.settings["method"])
    rows = study.settings.iloc[np.argsort(numbers, kind="stable")]
    columns = {
        "method": list(rows["method"]),
        **{HEADS[key]: [_size(key, v, bare=True) for v in rows[key]] for key in _keys(rows)},
        **{
            f"{name} %": [_error(study, row, name) for _, row in rows.iterrows()]
            for name in study.references
        },
        "CPU s": [short(round(value, 4)) for value in rows["cpu_s"]],
        "": ["*" if best else "" for best in rows["front"]],
    }
    notes = tuple(fill(line, WIDTH) for line in answers(study))
    yield Sheet.of(title, columns, opens=_opens(rows["method"]), notes=notes)
    yield _orders(study)


def scene_title(study: Study, name: str) -> str:
    """The name of the study, its loading scene, and the keys that its cases share."""
    rows = study.settings
    keys = [key for key in rows if is_grid_key(key)]
    varied = [key for key in keys if varies(rows[key]) or rows[key].isna().all()]
    rows = rows.drop(columns=varied)
    shown = {*scene_keys(rows), *HELD_BY_SCENE, *varied}
    kept = [key for key in keys if key not in shown]
    return ", ".join([f"{name}: {scene_label(rows)}", *key_words(rows.iloc[0], kept)])


def answers(study: Study) -> list[str]:
    """Sentences: the reference and its uncertainty, the cheapest setting for every target."""
    lines = [_reference(study)]
    for name in study.references:
        if name not in study.resolved:
            uncertain = f"is uncertain by {_doubt(study, name)}"
            clause = uncertain if np.isfinite(study.references[name].doubt) else "is unknown"
            lines.append(f"Not resolved: {measure_noun(study, name)}, whose limit {clause}.")
    if study.resolved:
        lines += [line for target in TARGETS for line in _cheapest(study, target)]
    failed = study.settings[study.settings["status"] != Status.CONVERGED]
    if not failed.empty:
        first = failed["message"].iloc[0]
        lines.append(f"Failed: {counted(len(failed), 'setting')}; the first: {first}.")
    return lines


def _reference(study: Study) -> str:
    """A sentence with the origin of the reference and its values."""
    words = [f"{_value(study, name)} ± {_doubt(study, name)}" for name in study.resolved]
    values = f": {', '.join(words)}" if words else ""
    return f"Reference: the limit of {setting(study, study.finest)}{values}."


def _cheapest(study: Study, target: float) -> Iterator[str]:
    """The cheapest settings below a target: in all measures that are known well enough, and in
    energy alone.
    """
    names = [name for name in study.resolved if study.references[name].doubt < target]
    if not names:
        yield f"Errors below {percents(target)} are not resolved: the reference is too uncertain."
        return
    rows, where = study.settings, f"below {percents(target)} in {_measure_words(study, names)}"
    worst = rows[names].max(axis=1, skipna=False)
    good = rows[worst < target].sort_values("cpu_s")
    cheap = rows[rows["energy"] < target].sort_values("cpu_s")
    if good.empty:
        best = rows.loc[worst.idxmin()]
        yield f"No setting is {where}; {setting(study, best)} reaches {percents(worst.min())}."
    else:
        yield f"The cheapest setting {where} is {_with_cost(study, good.iloc[0])}."
    if "energy" in names and not cheap.index[:1].isin(good.index[:1]).all():
        yield f"For {measure_noun(study, 'energy')} alone it is {_with_cost(study, cheap.iloc[0])}."


def _with_cost(study: Study, row: Series) -> str:
    return f"{setting(study, row)}: {short(round(row['cpu_s'], 4))} s"


def setting(study: Study, row: Series) -> str:
    """A row in words, such as "bdf2, 20 us, 6 elements a wall"."""
    parts = [row["method"], *(_size(key, row[key]) for key in _keys(study.settings))]
    return ", ".join(filter(None, parts))


def percents(share: float) -> str:
    """A share in percent, two digits."""
    return text_in(share, "%", 2)


def _error(study: Study, row: Series, name: str) -> str:
    """An error in percent."""
    if row["status"] != Status.CONVERGED:
        return str(row["status"])
    doubt = max(study.references[name].doubt, LEAST_SHOWN)
    if not np.isfinite(doubt) or not np.isfinite(row[name]):
        return NOTHING
    text = significant(in_unit(max(row[name], doubt), "%"), 2)
    return f"< {text}" if row[name] < doubt else text


def _orders(study: Study) -> Sheet:
    """A row for each method and each refined key, with the other keys at their finest."""
    rows = []
    for method, measures in study.orders.items():
        for key in measures["energy"]:
            orders = [measures[name][key] for name in measures]
            texts = [NOTHING if np.isnan(order) else f"{order:.2f}" for order in orders]
            rows.append([method, HEADS[key], *texts])
    return Sheet("observed orders", ["method", "refined in", *study.references], rows)


HEADS = {
    "solver.time_step": "step",
    "solver.step_error": "step error",
    "solver.load_steps": "load steps",
    "loading.load_steps": "load steps",
    "lattice.nodes_per_wall": "elements",
}


def _keys(rows: DataFrame) -> list[str]:
    """The keys that are refined in these settings."""
    return [key for key in REFINED if key in rows and varies(rows[key])]


def _size(key: str, value: float, bare: bool = False) -> str:
    """A size with its unit."""
    if pd.isna(value):
        return ""
    if key == "lattice.nodes_per_wall":
        return f"{value + 1:.0f}" + ("" if bare else " elements a wall")
    if key.endswith("load_steps"):
        return f"{value:.0f}" + ("" if bare else " load steps")
    unit = "m" if key == "solver.step_error" else "s"
    text = text_in(value, f"{'m' if value >= 1e-4 else 'u'}{unit}")
    return text if unit == "s" or bare else f"error of a step {text}"


def measure_noun(study: Study, name: str) -> str:
    """A measure in words."""
    mode = mode_of(study.settings)
    if name == "path":
        return mode.path
    if name == "energy":
        return mode.energy
    return "peak force"


def _value(study: Study, name: str) -> str:
    """The value of a reference in words; only the noun for a path, which has many values."""
    value, noun = study.references[name].value[0], measure_noun(study, name)
    if name == "path":
        return noun
    return f"{noun} {energy_text(value) if name == 'energy' else three_digits(value) + ' N'}"


def _doubt(study: Study, name: str) -> str:
    return percents(max(study.references[name].doubt, LEAST_SHOWN))


def _measure_words(study: Study, names: Iterable[str]) -> str:
    """Measures in words: "absorbed energy, peak force and strain over time"."""
    *first, last = [measure_noun(study, name) for name in names]
    return f"{', '.join(first)} and {last}" if first else last


def _opens(methods: Series) -> frozenset[int]:
    """Rows at which a method begins."""
    return frozenset(np.flatnonzero((methods != methods.shift()).to_numpy()).tolist())

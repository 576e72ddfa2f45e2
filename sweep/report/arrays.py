"""Results as labelled arrays: a dataset of xarray, with units."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from pandas import DataFrame

from sweep.columns import HISTORY_COLUMNS, Column, describe_array, describe_column, is_grid_key
from sweep.store.read import StoreError, read_curves, read_history

if TYPE_CHECKING:
    from xarray import Dataset

Variables = dict[str, tuple[tuple[str, ...], np.ndarray, dict[str, str]]]
"""Dimensions, values and attributes of each variable."""

CASE, ROW = "case_id", "row"
OF_CURVES = "history_"  # prefix of a curve whose name a column of the summary also has
NEEDED = 'to_xarray needs xarray: pip install "crumple[xarray]"'


def dataset(path: Path, table: DataFrame, curves: Sequence[str] | str | bool) -> Dataset:
    """The rows of a summary as a dataset along `case_id`, with named curves along `row`."""
    curves = [curves] if isinstance(curves, str) else curves
    try:
        from xarray import Dataset
    except ImportError as error:
        raise ModuleNotFoundError(NEEDED, name="xarray") from error
    columns: Variables = {
        name: ((CASE,), table[name].to_numpy(), _about(describe_column(name)))
        for name in table
        if name != CASE
    }
    grid = {name: column for name, column in columns.items() if is_grid_key(name)}
    measures = {name: column for name, column in columns.items() if name not in grid}
    ids = table[CASE].to_numpy(dtype=str)
    measures |= _curves(path, ids.tolist(), curves, {*columns})
    return Dataset(measures, {CASE: ids, **grid}, {"source": str(path)})


def _curves(
    path: Path, ids: list[str], curves: Sequence[str] | bool, columns: set[str]
) -> Variables:
    """Named curves as arrays (cases, rows of the longest), NaN after the last row of a case."""
    if not curves:
        return {}
    stored = [name for each in ids[:1] for name in read_history(path, each)]
    names = stored if curves is True else [*curves]
    if unknown := [name for name in names if name not in {*HISTORY_COLUMNS, *stored}]:
        raise StoreError(f"no curve {unknown[0]}; allowed: {', '.join(stored)}")
    rows = dict(read_curves(path, ids, names))
    longest = max((len(arrays[names[0]]) for arrays in rows.values()), default=0)
    values = {name: np.full((len(ids), longest), np.nan) for name in names}
    for k, case_id in enumerate(ids):
        for name in names:
            curve = rows[case_id][name]
            values[name][k, : len(curve)] = curve
    return {
        f"{OF_CURVES}{name}" if name in columns else name: (
            (CASE, ROW),
            array,
            _about(describe_array("/histories", name)),
        )
        for name, array in values.items()
    }


def _about(column: Column) -> dict[str, str]:
    """Attributes named by the conventions for climate and forecast data (CF)."""
    return {"units": column.units, "long_name": column.description}

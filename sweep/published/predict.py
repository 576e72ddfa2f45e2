"""The prediction of a row: the range of a measure over the cases of a config."""

from collections.abc import Sequence
from dataclasses import replace
from hashlib import blake2b
from pathlib import Path

import numpy as np
from pandas import DataFrame, Series

from sweep.columns import nearest_names
from sweep.config.case import Case
from sweep.config.load import load_config
from sweep.published.table import PublishedError, Row
from sweep.ranking.comparison import Range
from sweep.result import MODEL_VERSION, Status

SAME = 0.01  # relative: predictions that differ by less are equal, also on another machine
DIGITS = 4
ALLOWED = 'a column of results, or "A / B" of two; several, whose range counts, with ";" between'


class NotConvergedError(PublishedError):
    """Cases of a row that have not converged; the text has a line for each."""

    exit_status = 1


def cases_of(row: Row, table: Path) -> list[Case]:
    """The cases of a row, whose config is a file beside the table, a path or an example."""
    beside = table.parent / row.config
    cases = load_config(beside if beside.is_file() else row.config).cases
    chosen = [case for case in cases if _is_chosen(case, row)]
    if not chosen:
        values = sorted({f"{key}={value}" for case in cases for key, value in case.axes.items()})
        raise PublishedError(
            f"{row.name}: where = {row.where} leaves no case; allowed: {', '.join(values)}"
        )
    if row.over and any(row.over not in case.axes for case in chosen):
        axes = ", ".join(chosen[0].axes)
        raise PublishedError(f"{row.name}: over = {row.over} is no axis; allowed: {axes}")
    return chosen


def _is_chosen(case: Case, row: Row) -> bool:
    pairs = [word.split("=") for word in row.where.split()]
    return all(str(case.axes.get(key)) == value for key, value in pairs)


def digest(cases: Sequence[Case]) -> str:
    """Eight hexadecimal digits that identify cases by their ids."""
    ids = " ".join(case.case_id for case in cases)
    return blake2b(ids.encode(), digest_size=4).hexdigest()


def predicted(row: Row, cases: Sequence[Case], summary: DataFrame) -> Row:
    """The row with its prediction. summary: of a results file that has all cases."""
    results = summary.set_index("case_id").loc[[case.case_id for case in cases]]
    stopped = results[results["status"] != Status.CONVERGED]
    if len(stopped):
        lines = [f"{row.name}: case {i}: {one['message']}" for i, one in stopped.iterrows()]
        raise NotConvergedError("\n".join(lines))
    parts = [_values(measure, results, row) for measure in row.measure.split(";")]
    values = np.concatenate([_ratios(row.over, cases, one) for one in parts]) / float(row.per)
    low, high = (f"{value:.{DIGITS}g}" for value in (values.min(), values.max()))
    about = {"cases": str(len(cases)), "ids": digest(cases), "model": str(MODEL_VERSION)}
    return replace(row, low=low, high=high, **about)


def _values(measure: str, results: DataFrame, row: Row) -> np.ndarray:
    """A measure of all cases, (cases,), in SI."""
    over, *below = (_column(name.strip(), results, row) for name in measure.split("/"))
    values = over / below[0] if below else over
    if not np.isfinite(values).all():
        raise PublishedError(f"{row.name}: measure = {measure.strip()} has no value in some case")
    return values.to_numpy(float)


def _column(name: str, results: DataFrame, row: Row) -> "Series[float]":
    if name not in results or results[name].dtype.kind not in "fiu":
        hint = nearest_names(name, map(str, results))
        raise PublishedError(f"{row.name}: measure = {name}; allowed: {ALLOWED}{hint}")
    return results[name]


def _ratios(over: str, cases: Sequence[Case], values: np.ndarray) -> np.ndarray:
    """The values, or their ratios between the last and the first value of a key."""
    if not over:
        return values
    groups: dict[str, list[float]] = {}
    for case, value in zip(cases, values, strict=True):
        others = str({key: one for key, one in case.axes.items() if key != over})
        groups.setdefault(others, []).append(value)
    return np.array([group[-1] / group[0] for group in groups.values()])


def is_repeated(old: Row, new: Row) -> bool:
    """Whether a prediction has been reproduced within `SAME`."""
    before, after = old.comparison.predicted, new.comparison.predicted
    if not isinstance(before, Range) or not isinstance(after, Range):
        return False
    return bool(np.allclose(before, after, rtol=SAME))

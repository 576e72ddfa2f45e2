"""The places of sorted designs, which designs may share because of errors."""

import numpy as np
from pandas import DataFrame, Series, concat

from sweep.columns import correction_column, end_columns, less_is_better
from sweep.ranking.merit import doubtful


def places_by(rows: DataFrame, by: str) -> Series:
    """Places of the rows of one scene, sorted by a column, the best first (`shared_places`).

    Doubtful rows follow the others and share no place with them.
    """
    doubt = doubtful(rows)
    sound, others = _shared(rows[~doubt], by), _shared(rows[doubt], by)
    return concat([sound, others + len(sound)]).reindex(rows.index)


def _shared(rows: DataFrame, by: str) -> Series:
    return shared_places(rows[by], rows.get(correction_column(by)), *reach(rows, by))


def passed_over(rows: DataFrame, by: str) -> Series:
    """Number of doubtful rows that follow each trusted row although their values are better."""
    sound = rows[~doubtful(rows)]
    places = (part[by].rank(method="min", ascending=less_is_better(by)) for part in (rows, sound))
    among_all, among_sound = places
    return (among_all - among_sound).reindex(rows.index).fillna(0.0).astype(int)


def reach(rows: DataFrame, by: str) -> tuple[Series, Series]:
    """How far the range of each value extends below and above it; 0 without a range."""
    low, high = (rows.get(name, rows[by]) for name in end_columns(by))
    return (rows[by] - low).clip(lower=0.0), (high - rows[by]).clip(lower=0.0)


def shared_places(
    values: Series,
    corrections: Series | None = None,
    below: Series | None = None,
    above: Series | None = None,
) -> Series:
    """Places of sorted values, the best first.

    A value shares a place if it differs from the first value of the place by no more than their
    corrections differ, so that an error that both have in common does not count. A missing
    correction is 0. A value also shares the place if its range, up to `above`, overlaps the range
    of the first value, down to `below`. Otherwise the value starts a new place, whose number is 1 +
    the number of values before it.
    """
    shifts = np.zeros(len(values)) if corrections is None else corrections.fillna(0.0)
    down, up = (np.zeros(len(values)) if one is None else one for one in (below, above))
    places: list[int] = []
    best = first = low = np.nan
    for value, correction, under, over in zip(values, shifts, down, up, strict=True):
        if abs(value - best) <= abs(correction - first) + low + over:
            places.append(places[-1])
        else:
            best, first, low = value, correction, under
            places.append(len(places) + 1)
    return Series(places, index=values.index, dtype=int)

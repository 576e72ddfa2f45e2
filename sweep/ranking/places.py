"""The places of sorted designs, which designs may share because of errors."""

import numpy as np
from pandas import DataFrame, Series, concat

from sweep.columns import correction_column, end_columns, error_column, less_is_better
from sweep.ranking.merit import doubtful

LARGE = 0.1  # error / value


def places_by(rows: DataFrame, by: str) -> Series:
    """Places of the rows of one scene, sorted by a column, the best first (`shared_places`).

    Doubtful rows follow the others and share no place with them.
    """
    doubt = doubtful(rows)
    sound, others = _shared(rows[~doubt], by), _shared(rows[doubt], by)
    return concat([sound, others + len(sound)]).reindex(rows.index)


def _shared(rows: DataFrame, by: str) -> Series:
    correction, error = rows.get(correction_column(by)), rows.get(error_column(by))
    return shared_places(rows[by], correction, error, *reach(rows, by))


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
    errors: Series | None = None,
    below: Series | None = None,
    above: Series | None = None,
) -> Series:
    """Places of sorted values, the best first.

    A value shares a place if it differs from the first value of the place by no more than their
    corrections or their errors differ, so that an error that both have in common does not count;
    if both errors are `LARGE`, by no more than the lesser one, as so much need not be common. A
    missing correction is 0, a missing error differs from none. A value also shares the place if its
    range, up to `above`, overlaps the range of the first value, down to `below`. Otherwise the
    value starts a new place, whose number is 1 + the number of values before it.
    """
    columns = (corrections, errors, below, above)
    shifts, bars, down, up = (np.zeros(len(values)) if one is None else one for one in columns)
    rows = zip(values, np.nan_to_num(shifts), bars, down, up, strict=True)
    places: list[int] = []
    best = shift = bar = low = np.nan
    for value, correction, error, under, over in rows:
        apart = np.fmax(abs(correction - shift), abs(error - bar))
        if error > LARGE * abs(value) and bar > LARGE * abs(best):
            apart = max(apart, min(error, bar))
        if abs(value - best) <= apart + low + over:
            places.append(places[-1])
        else:
            best, shift, bar, low = value, correction, error, under
            places.append(len(places) + 1)
    return Series(places, index=values.index, dtype=int)

"""Tables as dictionaries: column -> array (rows,); a column of text has the dtype `object`.

A missing value is NaN in a column of numbers and "" in a column of text.
"""

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from sweep.columns import COLUMNS, is_grid_key

Columns = dict[str, np.ndarray]
Axes = Mapping[str, Mapping[str, Any]]
"""Grid values of every case: case id -> dotted key -> value."""

_FIXED = list(COLUMNS)
_HEAD = ("case_id", "status", "message")


class Table(Mapping[str, np.ndarray]):
    """Columns by their names, each made when it is requested, and not kept.

    All columns of a large sweep at the same time would be most of the memory that a run takes.
    """

    def __init__(self, names: Iterable[str], make: Callable[[str], np.ndarray]) -> None:
        self._names, self._make = dict.fromkeys(names), make

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._names:
            raise KeyError(name)
        return self._make(name)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


def tabulate(rows: Sequence[Mapping[str, Any]]) -> Columns:
    """Table of rows, which may have different columns."""
    names = dict.fromkeys(name for row in rows for name in row)
    return {name: _column([row.get(name) for row in rows]) for name in names}


def take(table: Mapping[str, np.ndarray], index: np.ndarray) -> Table:
    """Rows of a table with the numbers `index`, in that order."""
    return Table(table, lambda name: table[name][index])


def slim(column: np.ndarray) -> np.ndarray:
    """The same column, read only; it takes the memory of one value if all have the same bits."""
    bits = column if column.dtype == object else column.view(f"u{column.itemsize}")
    if not len(column) or (bits != bits[0]).any():
        return column
    return np.broadcast_to(column[:1].copy(), column.shape)


def stack(tables: Sequence[Mapping[str, np.ndarray]]) -> Table:
    """Tables one below another, with the columns of all."""
    lengths = [len(table["case_id"]) for table in tables]
    names = dict.fromkeys(name for table in tables for name in table)
    return Table(names, lambda name: _join([table.get(name) for table in tables], lengths))


def relabel(table: Mapping[str, np.ndarray], axes: Axes) -> Table:
    """Table with the grid values of its cases replaced by those in `axes`.

    A case that an earlier sweep computed is part of this one too, with the values of this grid.
    Values that `axes` does not have stay unchanged.
    """
    ids = table["case_id"]
    labels = dict.fromkeys(name for case_id in ids for name in axes.get(case_id, ()))

    def make(name: str) -> np.ndarray:
        if name not in labels:
            return table[name]
        pairs = zip(ids, _list(table.get(name), len(ids)), strict=True)
        return _column([axes.get(case_id, {}).get(name, old) for case_id, old in pairs])

    return Table([*table, *labels], make)


def beyond(table: Mapping[str, np.ndarray], axes: Axes) -> int:
    """Number of rows whose case is not in `axes`; 0 if `axes` is empty."""
    return sum(case_id not in axes for case_id in table["case_id"]) if axes else 0


def arrange(table: Mapping[str, np.ndarray]) -> Table:
    """Columns in the order: id and status, grid keys, the columns of `COLUMNS`, others."""
    return Table(sorted(table, key=_place), table.__getitem__)


def rows_in_order(ids: Iterable[str], order: Iterable[str]) -> np.ndarray:
    """Row numbers that bring `ids` into this `order`; other ids follow in their order."""
    place = {case_id: number for number, case_id in enumerate(order)}
    return np.argsort([place.get(case_id, len(place)) for case_id in ids], kind="stable")


def _place(name: str) -> tuple[int, int]:
    if name in _HEAD:
        return 0, _FIXED.index(name)
    if name in COLUMNS:
        return 2, _FIXED.index(name)
    return (1, 0) if is_grid_key(name) else (3, 0)


def _column(values: Sequence[Any]) -> np.ndarray:
    """A column: text if any value is text, integers if all values are, else float64."""
    if any(isinstance(value, str) for value in values):
        return np.array([_text(value) for value in values], dtype=object)
    if all(isinstance(value, int | np.integer) for value in values):
        return np.array(values, dtype=np.int64)
    return np.array([np.nan if value is None else value for value in values], dtype=np.float64)


def _join(parts: Sequence[np.ndarray | None], lengths: Sequence[int]) -> np.ndarray:
    kinds = {"f" if part is None else part.dtype.kind for part in parts}
    if "O" in kinds and len(kinds) > 1:
        return _column([v for part, n in zip(parts, lengths, strict=True) for v in _list(part, n)])
    blank = [np.full(n, np.nan) for n in lengths]
    return np.concatenate([b if p is None else p for p, b in zip(parts, blank, strict=True)])


def _list(part: np.ndarray | None, length: int) -> list[Any]:
    return [None] * length if part is None else part.tolist()


def _text(value: Any) -> str:
    """A value of a text column, one object for all equal texts; "" for None and NaN."""
    return "" if value is None or value != value else sys.intern(str(value))

"""Writes a sealed file: blocks are added one after another, the summary is written at the end.

The layout is described in `read`. The file has a temporary name until it is sealed. Texts have a
fixed length: HDF5 keeps texts of variable length in heaps without checksums, and a damaged heap can
send a reader into an endless loop.
"""

from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from h5py import h5ds

from sweep.columns import Column, describe_array, describe_column
from sweep.store.batch import FORMAT, GROUPS, TEXT, Block, Ragged, digits, newest_rows
from sweep.store.checksum import CHECKSUM, attribute_checksum, checked_columns, row_checksums
from sweep.store.parts import Unsealed
from sweep.store.tables import (
    Axes,
    Columns,
    arrange,
    beyond,
    relabel,
    rows_in_order,
    slim,
    stack,
    take,
)

CHUNK = 4096  # rows of a chunk that is compressed and has a checksum
LARGE_CHUNK = 16384  # rows of a chunk that has only a checksum
TEXT_CHUNK = 1 << 16  # bytes of a chunk of cases: it holds the texts of many, which are alike
CACHE = 1 << 18  # bytes of unfinished chunks that HDF5 keeps in memory for each array


@dataclass(frozen=True)
class About:
    """The contents of a sealed file besides its rows.

    axes: case id -> grid values (dotted key -> value in SI), in the order of the rows of the file.
    attributes: config, versions and the like. last: number of the last batch in the file.
    """

    axes: Axes = field(default_factory=dict)
    attributes: Mapping[str, Any] = field(default_factory=dict)
    last: int = 0


def seal_blocks(target: Path, blocks: Iterable[Block], about: About, packed: bool) -> None:
    """Seal the union of blocks, oldest first, under the name `target`; one block is used at a
    time.
    """
    with closing(Growing(target, packed)) as growing:
        for block in blocks:
            growing.add(*newest_rows([block])[0])
        growing.seal(about)


class Growing:
    """A file that will be sealed as `target`.

    packed: True for a file that stays: it is compressed and describes every array.
    """

    def __init__(self, target: Path, packed: bool) -> None:
        self._packed = packed
        self._disk = Unsealed(target)
        self._file = h5py.File(self._disk, "w", libver=("v110", "v110"), rdcc_nbytes=CACHE)
        self._tables: list[Columns] = []
        self._known: dict[str, None] = {}  # ids of the cases, in the order of the tables
        self._ragged = {name: _Ragged(self._file.create_group(name), packed) for name in GROUPS}

    def add(self, block: Block, rows: np.ndarray) -> None:
        """Add rows of a block, by their numbers. They replace earlier rows of the same cases."""
        self._known |= dict.fromkeys(block.summary["case_id"][rows])
        stored = block.as_stored(rows)
        self._tables.append({k: slim(v) for k, v in take(block.summary, stored).items()})
        for name, ragged in self._ragged.items():
            ragged.add(block.ragged[name], stored)
        self._disk.raise_error()

    def add_older(self, blocks: Sequence[Block]) -> None:
        """Add the rows of blocks, oldest first, whose cases the file does not hold yet."""
        newer, self._known = self._known, {}
        for block, rows in newest_rows(blocks):
            ids = block.summary["case_id"][rows]
            self.add(block, rows[[case_id not in newer for case_id in ids]])
        self._known |= newer

    def seal(self, about: About) -> None:
        """Write the summary, with rows in the order of `about.axes`, and seal the file."""
        table = stack(self._tables)
        newest = {case_id: row for row, case_id in enumerate(table["case_id"])}
        places = rows_in_order(newest, dict.fromkeys([*about.axes, *self._known]))
        order = np.array(list(newest.values()), dtype=np.int64)[places]
        summary = self._file.create_group("summary", track_order=True)
        rows = arrange(relabel(take(table, order), about.axes))
        for name, column in rows.items():
            data = _write_column(summary, name, column, self._packed)
            if self._packed:
                _describe(data, describe_column(name))
        if self._packed:
            _name_rows(summary, "case_id")
        ranges = {name: ragged.finish(order) for name, ragged in self._ragged.items()}
        self._file["checksums"] = row_checksums(checked_columns(rows, ranges))
        counts = {
            "folded": about.last,
            "asked_cases": len(about.axes),
            "other_cases": beyond(rows, about.axes),
        }
        attributes = {**about.attributes, "format": FORMAT, **counts}
        _write_attributes(self._file, attributes | {CHECKSUM: attribute_checksum(attributes)})
        self._tables.clear()
        self._file.close()
        self._disk.seal()

    def close(self) -> None:
        """Delete the file if it is not sealed."""
        self._file.close()
        self._disk.abandon()


class _Ragged:
    """A group of arrays; each holds the values of all cases, one after another."""

    def __init__(self, group: h5py.Group, packed: bool) -> None:
        self._group, self._packed = group, packed
        self._values = group.create_group("values", track_order=True)
        self._data: dict[str, h5py.Dataset] = {}
        self._rows: list[np.ndarray] = []
        self._total = 0

    def add(self, ragged: Ragged, kept: np.ndarray) -> None:
        """Copy the rows of the kept cases; an array that a block does not have stays NaN."""
        rows = ragged.rows[kept]
        at, self._total = self._total, self._total + int(rows.sum())
        self._rows.append(rows)
        for name, array in ragged.arrays.items():
            data = self._array(name, array, self._total - at)
            data.resize(self._total, axis=0)
            end = at
            for first, last in ragged.ranges(kept):
                end += last - first
                data[end - last + first : end] = array[first:last]

    def finish(self, order: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Write and return the range of rows of each case, in the order of the summary."""
        rows = np.concatenate(self._rows)
        ranges = (np.cumsum(rows) - rows)[order], rows[order]
        self._group["start"], self._group["rows"] = ranges
        for name, data in self._data.items():
            if len(data) < self._total:
                data.resize(self._total, axis=0)
            if self._packed:
                _describe(data, describe_array(self._group.name, name))
        self._data.clear()  # a file with open datasets takes long to close
        return ranges

    def _array(self, name: str, like: Any, rows: int) -> h5py.Dataset:
        if name not in self._data:
            packed = self._packed and name != "position_m"
            chunk = TEXT_CHUNK if name == TEXT else CHUNK if packed else LARGE_CHUNK
            self._data[name] = self._values.create_dataset(
                name,
                (0, *like.shape[1:]),
                maxshape=(None, *like.shape[1:]),
                chunks=(chunk if self._packed else min(max(rows, 1), chunk), *like.shape[1:]),
                dtype=digits(like.dtype),
                fillvalue=np.nan if like.dtype.kind == "f" else 0,
                **_filters(packed),
            )
        return self._data[name]


def _filters(packed: bool) -> dict[str, Any]:
    """Compression, or level 0: only a checksum, which a file of zeros does not pass.

    Positions are not compressed: they shrink by only a third and take most of the time.
    """
    return {"compression": "gzip", "compression_opts": int(packed), "shuffle": packed}


def _write_column(group: h5py.Group, name: str, column: np.ndarray, packed: bool) -> h5py.Dataset:
    if column.dtype == object:
        small = len(column) <= 1 or not packed
        how = {} if small else {"chunks": (min(len(column), CHUNK),), **_filters(packed)}
        return group.create_dataset(name, data=_fixed([*column]), **how)
    return group.create_dataset(name, data=np.ascontiguousarray(column))


def _fixed(texts: list[str]) -> np.ndarray:
    """Texts as UTF-8 of the length of the longest, filled with zeros."""
    encoded = [text.encode() for text in texts]
    length = max([1, *map(len, encoded)])
    return np.array(encoded, dtype=h5py.string_dtype("utf-8", length))


def _describe(data: h5py.Dataset, column: Column) -> None:
    _write_attributes(data, {"units": column.units, "description": column.description})


def _name_rows(group: h5py.Group, name: str) -> None:
    """Make a column the scale of the rows of all others (HDF5 dimension scales), so that xarray and
    other readers name the dimension. Crumple itself reads no attribute of a column.
    """
    scale = group[name].id
    h5ds.set_scale(scale, name.encode())
    for other in group:
        if other != name:
            h5ds.attach_scale(group[other].id, scale, 0)


def _write_attributes(of: h5py.HLObject, attributes: Mapping[str, Any]) -> None:
    for name, value in attributes.items():
        of.attrs[name] = _fixed([value])[0] if isinstance(value, str) else value

"""Checksums of the rows of a results file, and of its attributes.

HDF5 itself keeps a checksum of each compressed chunk (curves, shapes, texts of cases), but none of
the columns of the summary and of the attributes. The checksum of a row mixes its values, column by
column, with steps that lose no information, h -> rotated(h ^ value) x odd number: whatever changes
one value, or the name of a column, changes the checksum of the row for certain.
"""

from collections.abc import Mapping
from typing import Any
from zlib import crc32

import numpy as np

from sweep.store.tables import Table

CHECKSUM = "checksum"
"""The attribute of a results file with the checksum of the others."""

ODD = np.uint64(0x9E3779B97F4A7C15)  # 2^64 / golden ratio
ROTATION = np.uint64(23)


def checked_columns(
    summary: Mapping[str, np.ndarray], ranges: Mapping[str, tuple[np.ndarray, np.ndarray]]
) -> Table:
    """The columns of a summary, and the start and length of the curves and shapes of each row, by
    group.
    """
    parts = {f"{name}/{k}": part for name, pair in ranges.items() for k, part in enumerate(pair)}
    return Table([*summary, *parts], lambda name: parts[name] if name in parts else summary[name])


def row_checksums(columns: Mapping[str, np.ndarray]) -> np.ndarray:
    """Checksums (n,) of the rows of named columns (n,), whatever the order of the columns."""
    count = len(next(iter(columns.values())))
    sums = np.full(count, ODD)
    for name in sorted(columns):
        values = _bits(columns[name]) ^ np.uint64(crc32(name.encode()))
        sums = sums ^ values
        sums = (sums << ROTATION | sums >> np.uint64(64) - ROTATION) * ODD
    return sums


def _bits(column: np.ndarray) -> np.ndarray:
    """The values of a column as 64 bits each; for a text, its length and its checksum."""
    if column.dtype == object:
        encoded = {text: text.encode() for text in {*column}}
        bits = {name: len(text) << 32 | crc32(text) for name, text in encoded.items()}
        return np.array([bits[text] for text in column], np.uint64)
    wide = np.float64 if column.dtype.kind == "f" else np.int64
    return np.ascontiguousarray(column, wide).view(np.uint64)


def attribute_checksum(attributes: Mapping[str, Any]) -> int:
    """Checksum of all attributes except the checksum itself."""
    pairs = [(name, str(value)) for name, value in attributes.items() if name != CHECKSUM]
    return crc32(repr(sorted(pairs)).encode())

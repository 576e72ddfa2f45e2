"""Damage of a results file: rows that differ from what was written, and errors of HDF5.

What is damaged is refused in one line, which names it and says what computes it again.
"""

import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from sweep.columns import COLUMNS
from sweep.result import LOADED
from sweep.store.batch import Block, Ragged, newest
from sweep.store.checksum import checked_columns, row_checksums
from sweep.store.errors import StoreError
from sweep.store.tables import Table

SHOWN = 3  # most damaged cases that are named
FOREIGN = "is not a results file of Crumple; allowed: a file that `crumple run` has written"
RUN_AGAIN = "`crumple run` computes them again"
AGAIN = "move it away, and `crumple run` computes its cases again"
RENEWED = "`crumple verify` names its cases, and `crumple run CONFIG --renew` computes these again"
ID = re.compile(r"[0-9a-f]{1,16}")
NOT_SO = "has values of another kind, or rows of another length"
ELSEWHERE = (
    "is open for writing in another program: close it there, or run `h5clear -s` on it if that "
    "program has crashed"
)
HERE = "is open in this process by another reader, such as xarray, with other locks: close it there"
DAMAGE = (OSError, RuntimeError, LookupError, ValueError, TypeError, MemoryError)


def changed_rows(
    path: Path, columns: Mapping[str, np.ndarray], ragged: Mapping[str, Ragged], written: np.ndarray
) -> frozenset[int]:
    """Numbers of the rows whose checksums differ from those written, or whose id is no id of
    Crumple: ids become names of files.
    """
    ranges = {name: (group.start, group.rows) for name, group in ragged.items()}
    checked = checked_columns(columns, ranges)

    def sound(name: str) -> np.ndarray:
        column, described = checked[name], COLUMNS.get(name)
        is_text = column.dtype == object
        if described and is_text != (described.units == "") and (is_text or name not in LOADED):
            raise StoreError(f"{path} is damaged: /summary/{name} {NOT_SO}: {AGAIN}.")
        if column.shape != written.shape:
            raise ValueError("columns of other lengths")
        return column

    same = row_checksums(Table(checked, sound)) == written
    same &= [bool(ID.fullmatch(case_id)) for case_id in columns["case_id"]]
    if not all(group.is_whole(same) for group in ragged.values()):
        raise ValueError("ranges beyond the end of their arrays")
    return frozenset(np.flatnonzero(~same).tolist())


def damaged_cases(blocks: list[Block]) -> list[str]:
    """Ids of the damaged rows that no other row replaces, as stored."""
    usable = {*newest(blocks)["case_id"]}
    ids = [block.summary["case_id"][row] for block in blocks for row in sorted(block.damaged)]
    return [case_id for case_id in ids if case_id not in usable]


def refuse_damaged(path: Path, blocks: list[Block]) -> None:
    """Refuse a file that has damaged rows, and name their cases."""
    if ids := damaged_cases(blocks):
        named = ", ".join(ascii(case_id)[1:-1] for case_id in ids[:SHOWN])
        more = f" and {len(ids) - SHOWN} more" if len(ids) > SHOWN else ""
        raise StoreError(f"{path}: damaged rows of cases {named}{more}; {RUN_AGAIN}.")


@contextmanager
def undamaged(path: Path, damaged: str = "") -> Iterator[None]:
    """Turn every error of HDF5 in reading a sealed file into a `StoreError` of one line. damaged:
    the name of what is read, if other parts of the file may be whole.
    """
    try:
        yield
    except FileNotFoundError:
        raise
    except DAMAGE as error:
        if isinstance(error, OSError) and error.errno:
            raise StoreError(f"{path} cannot be read: {os.strerror(error.errno)}.") from error
        if "open for write" in str(error):  # a mark of HDF5 in the file
            raise StoreError(f"{path} {ELSEWHERE}.") from error
        if "locking flag" in str(error):
            raise StoreError(f"{path} {HERE}.") from error
        if "signature not found" in str(error) and _is_foreign(path):
            raise StoreError(f"{path} {FOREIGN}.") from error
        if damaged:
            raise StoreError(f"{path}: {damaged} is damaged: {RENEWED}.") from error
        raise StoreError(f"{path} is damaged: {AGAIN}.") from error


def _is_foreign(path: Path) -> bool:
    """Whether a file does not begin as results do: what a full disk or a power cut leaves is empty,
    or begins with zeros.
    """
    with path.open("rb") as file:
        return bool(file.read(8).strip(b"\0"))

"""Opens one sealed file, a part or a whole results file; arrays are read as they are needed."""

import os
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from sweep.store.batch import FORMAT, GROUPS, Block, Ragged, is_as_written
from sweep.store.checksum import CHECKSUM, attribute_checksum
from sweep.store.damage import AGAIN, FOREIGN, NOT_SO, changed_rows, undamaged
from sweep.store.errors import StoreError
from sweep.store.tables import Table

CACHE = 1 << 16  # bytes of chunks kept of each array: a merge has 64 files open, of 30 arrays each
FEW = 4096  # rows of a column that is kept in memory while its file is open
FILES_REMEMBERED = 4096
_DAMAGED: dict[tuple[int, ...], frozenset[int]] = {}
"""Damaged rows of files that this process has checked: a sealed file never changes."""


def open_sealed(path: Path, stack: ExitStack) -> Block:
    """A sealed file as a block, open until `stack` closes."""
    with undamaged(path):
        if not (path.is_file() or path.is_dir()) and path.exists():
            raise StoreError(f"{path} cannot be read: it is no regular file.")
        # A sealed file never changes, so it needs no lock, which would block other readers.
        file = stack.enter_context(h5py.File(path, "r", locking=False, rdcc_nbytes=CACHE))
        if "format" not in file.attrs and "summary" not in file:
            raise StoreError(f"{path} {FOREIGN}.")
        if (written := _attribute(file, "format")) != FORMAT:
            needed = f"this Crumple reads format {FORMAT}: {AGAIN}"
            raise StoreError(f"{path} is a results file of format {written}; {needed}.")
        attributes = {name: _attribute(file, name) for name in file.attrs}
        if attribute_checksum(attributes) != attributes[CHECKSUM]:
            raise ValueError("attributes other than those written")
        ragged = {name: _open_ragged(path, _inside(file, name, h5py.Group)) for name in GROUPS}
        columns = _members(path, _inside(file, "summary", h5py.Group), _column)
        if (content := _identity(file)) not in _DAMAGED:
            while len(_DAMAGED) >= FILES_REMEMBERED:
                _DAMAGED.pop(next(iter(_DAMAGED)), None)
            _DAMAGED[content] = changed_rows(path, columns, ragged, _numbers(file, "checksums"))
        return Block(columns, ragged, attributes, _DAMAGED[content])


def _attribute(file: h5py.File, name: str) -> Any:
    """A text, or a whole number."""
    if file.attrs.get_id(name).dtype.kind == "O":
        raise ValueError("a text in a heap, as in `_inside`")
    value = file.attrs[name]
    return value.decode() if isinstance(value, bytes) else int(value)


def _inside(group: h5py.Group, name: str, kind: type) -> Any:
    """The group or dataset (``kind``) of this name, as Crumple writes it.

    A results file is complete, so no link to another file is followed. Nothing of variable length
    is read: HDF5 can loop forever in a damaged heap.
    """
    if not isinstance(group.get(name, getlink=True), h5py.HardLink):
        raise ValueError("a link")
    inner = group[name]
    if not isinstance(inner, kind):
        raise TypeError("a group for a dataset, or a dataset for a group")
    if isinstance(inner, h5py.Dataset) and (inner.dtype.kind == "O" or inner.is_virtual):
        raise ValueError("values of variable length, or of another file")
    return inner


def _numbers(group: h5py.Group, name: str) -> np.ndarray:
    return _inside(group, name, h5py.Dataset)[:]


def _identity(file: h5py.File) -> tuple[int, ...]:
    """A value that changes with the content of a file."""
    about = os.fstat(file.id.get_vfd_handle())
    return about.st_dev, about.st_ino, about.st_size, about.st_mtime_ns, about.st_ctime_ns


def _open_ragged(path: Path, group: h5py.Group) -> Ragged:
    values = _inside(group, "values", h5py.Group)
    arrays = _members(path, values, partial(_Array, path, group.name.strip("/")))
    return Ragged(_numbers(group, "start"), _numbers(group, "rows"), arrays)


class _Array:
    """An array of a sealed file, which is read when it is indexed."""

    def __init__(self, path: Path, group: str, data: h5py.Dataset) -> None:
        self._path, self._data = path, data
        self.dtype, self.shape = data.dtype, data.shape
        name = data.name.rsplit("/", 1)[-1]
        if not is_as_written(group, name, data.dtype, data.shape):
            raise StoreError(f"{path} is damaged: {data.name} {NOT_SO}: {AGAIN}.")

    def __getitem__(self, rows: slice) -> np.ndarray:
        with undamaged(self._path, self._data.name):
            return self._data[rows]


def _members(path: Path, group: h5py.Group, take: Callable[[h5py.Dataset], Any]) -> Table:
    """The datasets of a group of a sealed file, each opened or read when it is indexed.

    Texts are kept, as they take long to read, and so are small datasets, since there may be many
    files.
    """
    kept: dict[str, Any] = {}

    def member(name: str) -> Any:
        if name in kept:
            return kept[name]
        with undamaged(path):
            taken = take(_inside(group, name, h5py.Dataset))
        if not isinstance(taken, np.ndarray) or taken.dtype == object or len(taken) <= FEW:
            kept[name] = taken
        return taken

    return Table(group, member)


def _column(data: h5py.Dataset) -> np.ndarray:
    if not h5py.check_string_dtype(data.dtype):
        return data[:]
    encoded = data[:].tolist()
    texts = {text: text.decode() for text in {*encoded}}  # most are equal, and share one object
    return np.array([texts[text] for text in encoded], dtype=object)

"""The results file: HDF5 that a kill cannot hurt and that can be read while it grows.

A finished batch is sealed as a file of its own, a part in `NAME.parts/` beside `NAME.h5`: written
under a temporary name, synchronised, renamed, never touched again. Parts are folded into the one
file at the end. A results file and a part have the same layout, and what is read back is the union
of them all; of two rows with the same case id, the newer one.

    /summary/COLUMN            (n,) a row per case; attributes `units` and `description`
    /histories/values/COLUMN   (sum of rows,) float32, the curves of all cases end to end
    /histories/start, rows     (n,) where the curves of a case begin, and how many rows they have
    /frames, /points, /edges   likewise: a row is a frame, a node of a frame, an element
"""

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from io import FileIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from sweep.block import FRAME_GROUPS, GROUPS, Block, Ragged, block_of, joined, newest, newest_rows
from sweep.columns import arrange, relabel, rows_in_order, take
from sweep.parts import list_parts, seal
from sweep.result import HISTORY_COLUMNS, Column, Result, Status, describe_array, describe_column

if TYPE_CHECKING:
    from pandas import DataFrame

FORMAT = 1  # of the layout above
CHUNK = 4096  # rows of a piece that is compressed and checked by itself
ATTEMPTS = 100  # at a set of files that holds still while it is opened
DAMAGE = (OSError, RuntimeError, LookupError, ValueError, TypeError)

Axes = Mapping[str, Mapping[str, Any]]


class StoreError(Exception):
    """A results file that cannot be read or written; the text is one clear line."""


@dataclass(frozen=True)
class About:
    """What a sealed file says besides its rows.

    axes: case id -> grid values (dotted key -> value in SI), in the order that the rows shall have.
    attributes: config, versions and the like. last: number of the last batch in it.
    """

    axes: Axes = field(default_factory=dict)
    attributes: Mapping[str, Any] = field(default_factory=dict)
    last: int = 0


def exists(path: str | os.PathLike[str]) -> bool:
    """True if there is a results file, or at least a part of one."""
    return Path(path).exists() or bool(list_parts(Path(path)))


def read_summary(path: str | os.PathLike[str]) -> "DataFrame":
    """Table of all finished cases, a row each."""
    from pandas import DataFrame

    with _union(Path(path)) as blocks:
        return DataFrame(arrange(newest(blocks)))


def finished_ids(path: str | os.PathLike[str], retry_failed: bool = False) -> set[str]:
    """Ids of the cases that need not run again; none where there is no file."""
    if not exists(path):
        return set()
    with _union(Path(path)) as blocks:
        table = newest(blocks, ("case_id", "status"))
    done = table["status"] == Status.CONVERGED if retry_failed else slice(None)
    return set(table["case_id"][done])


def read_attributes(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Config, versions, git revision and time of the last run that wrote into the file."""
    with _union(Path(path)) as blocks:
        return dict(blocks[-1].attributes)


def read_history(path: str | os.PathLike[str], case_id: str) -> "DataFrame":
    """Curves of one case, a row per stored step; no rows if the case left none."""
    from pandas import DataFrame

    curves = _read_case(Path(path), case_id, ["histories"])
    return DataFrame(curves, columns=list(HISTORY_COLUMNS | curves), dtype=np.float64)


def read_frames(path: str | os.PathLike[str], case_id: str) -> dict[str, np.ndarray]:
    """Stored shapes of one case, the arrays of `Result.frames`; none if the case left none."""
    frames = _read_case(Path(path), case_id, FRAME_GROUPS)
    if "position_m" in frames:
        frames["position_m"] = frames["position_m"].reshape(len(frames["strain"]), -1, 2)
    return frames


def folded_batches(path: Path) -> int:
    """Number of the last batch that is in the one file (the newer ones are in parts)."""
    with ExitStack() as held:
        return _open(path, held).attributes["folded"] if path.exists() else 0


def seal_results(target: Path, results: Sequence[Result], about: About) -> None:
    """Seal a finished batch under the name `target`."""
    _seal(target, [block_of(results)], about)


def seal_parts(target: Path, parts: Sequence[Path], about: About) -> None:
    """Seal the union of some parts under the name `target`."""
    with ExitStack() as held:
        _seal(target, [_open(part, held) for part in parts], about)


def seal_union(path: Path, about: About) -> None:
    """Seal all that is known of a results file under its own name."""
    with _union(path) as blocks:
        _seal(path, blocks, about)


def is_labelled(path: Path, axes: Axes) -> bool:
    """True if the rows have the order and the grid values of `axes` already."""
    with _union(path) as blocks:
        table = newest(blocks)
    wanted = relabel(take(table, rows_in_order(table["case_id"], axes)), axes)
    same = (np.array_equal(table[n], c, equal_nan=c.dtype != object) for n, c in wanted.items())
    return wanted.keys() == table.keys() and all(same)


@contextmanager
def _union(path: Path) -> Iterator[list[Block]]:
    """All sealed blocks of a results file, oldest first, held open."""
    for _ in range(ATTEMPTS):
        with ExitStack() as held:
            try:
                blocks = _open_all(path, held)
            except FileNotFoundError:
                continue  # the writer has just merged or folded what was listed
            yield blocks
            return
    raise StoreError(f"{path} changes faster than it can be read.")


def _open_all(path: Path, held: ExitStack) -> list[Block]:
    # Parts before the file: what a fold takes away between the two is then in the file.
    parts = [(part.last, _open(part.path, held)) for part in list_parts(path)]
    whole = [_open(path, held)] if path.exists() else []
    folded = whole[0].attributes["folded"] if whole else 0
    blocks = whole + [block for last, block in parts if last > folded]
    if not blocks:
        raise StoreError(f"{path} does not exist.")
    return blocks


def _open(path: Path, held: ExitStack) -> Block:
    with _undamaged(path):
        # A sealed file never changes, and a lock on it could only hinder others.
        file = held.enter_context(h5py.File(path, "r", locking=False))
        ragged = {name: _open_ragged(path, file[name]) for name in GROUPS}
        attributes = {**file.attrs, "folded": int(file.attrs["folded"])}
        return Block(_Columns(path, file["summary"]), ragged, attributes)


@contextmanager
def _undamaged(path: Path) -> Iterator[None]:
    """Turn whatever HDF5 stumbles over while it reads a sealed file into one clear line."""
    try:
        yield
    except FileNotFoundError:
        raise
    except DAMAGE as error:
        if isinstance(error, OSError) and error.errno:
            raise StoreError(f"{path} cannot be read: {os.strerror(error.errno)}.") from error
        advice = "move it away, and `crumple run` computes its cases anew"
        line = f"{path} is not a results file of Crumple, or is damaged: {advice}."
        raise StoreError(line) from error


def _open_ragged(path: Path, group: h5py.Group) -> Ragged:
    arrays = {name: _Array(path, data) for name, data in dict(group["values"]).items()}
    ragged = Ragged(group["start"][:], group["rows"][:], arrays)
    if not ragged.is_whole():
        raise ValueError("stretches that lie beyond the end of their arrays")
    return ragged


class _Array:
    """An array of a sealed file, read where it is asked for."""

    def __init__(self, path: Path, data: h5py.Dataset) -> None:
        self._path, self._data = path, data
        self.dtype, self.shape = data.dtype, data.shape

    def __getitem__(self, rows: slice) -> np.ndarray:
        with _undamaged(self._path):
            return self._data[rows]


class _Columns(Mapping[str, np.ndarray]):
    """Columns of a sealed file, read when they are asked for."""

    def __init__(self, path: Path, group: h5py.Group) -> None:
        self._path, self._data = path, group

    def __getitem__(self, name: str) -> np.ndarray:
        with _undamaged(self._path):
            data = self._data[name]
            return data.asstr()[:] if h5py.check_string_dtype(data.dtype) else data[:]

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)


def _read_case(path: Path, case_id: str, groups: Iterable[str]) -> dict[str, np.ndarray]:
    with _union(path) as blocks:
        for block in reversed(blocks):
            found = np.flatnonzero(block.summary["case_id"] == case_id)
            if found.size:
                arrays = [block.ragged[group].case(found[-1]) for group in groups]
                return {k: v for named in arrays for k, v in named.items() if len(v)}
    raise StoreError(f"{path} holds no case {case_id}.")


def _seal(target: Path, blocks: Sequence[Block], about: About) -> None:
    def write(disk: FileIO) -> None:
        with h5py.File(disk, "w", libver=("v110", "v110")) as file:
            file.attrs.update({**about.attributes, "format": FORMAT, "folded": about.last})
            _write(file, blocks, about.axes)

    seal(target, write)


def _write(file: h5py.File, blocks: Sequence[Block], axes: Axes) -> None:
    """Write the union of the blocks, its rows in the order of `axes` and labelled with it."""
    rows = newest_rows(blocks)
    kept = [block.as_stored(numbers) for block, numbers in zip(blocks, rows, strict=True)]
    table = joined(blocks, kept)
    known = joined(blocks, rows, ["case_id"])["case_id"]
    order = rows_in_order(table["case_id"], dict.fromkeys([*axes, *known]))
    summary = file.create_group("summary", track_order=True)
    for name, column in arrange(relabel(take(table, order), axes)).items():
        _describe(_write_column(summary, name, column), describe_column(name))
    for name in GROUPS:
        pieces = [(block.ragged[name], rows) for block, rows in zip(blocks, kept, strict=True)]
        _write_ragged(file.create_group(name), pieces, order)


def _write_column(group: h5py.Group, name: str, column: np.ndarray) -> h5py.Dataset:
    text = h5py.string_dtype("utf-8") if column.dtype == object else None
    return group.create_dataset(name, data=column, dtype=text)


def _write_ragged(
    group: h5py.Group, pieces: Sequence[tuple[Ragged, np.ndarray]], order: np.ndarray
) -> None:
    rows = np.concatenate([ragged.rows[kept] for ragged, kept in pieces])
    group["start"] = (np.cumsum(rows) - rows)[order]
    group["rows"] = rows[order]
    values = group.create_group("values", track_order=True)
    for name in dict.fromkeys(name for ragged, _ in pieces for name in ragged.arrays):
        data = _write_values(values, name, int(rows.sum()), pieces)
        _describe(data, describe_array(group.name, name))


def _write_values(
    group: h5py.Group, name: str, total: int, pieces: Sequence[tuple[Ragged, np.ndarray]]
) -> h5py.Dataset:
    """Copy the kept stretches of one array; what a block lacks stays NaN."""
    like = next(ragged.arrays[name] for ragged, _ in pieces if name in ragged.arrays)
    data = group.create_dataset(name, (total, *like.shape[1:]), **_compact(name, like, total))
    at = 0
    for ragged, kept in pieces:
        for begin, end in ragged.stretches(kept):
            if name in ragged.arrays:
                data[at : at + end - begin] = ragged.arrays[name][begin:end]
            at += end - begin
    return data


def _compact(name: str, like: Any, total: int) -> dict[str, Any]:
    """How an array is stored: half the digits; compressed once it comes from another file."""
    real = like.dtype.kind == "f"
    kind = {"dtype": np.float32 if real else np.int32, "fillvalue": np.nan if real else 0}
    # Positions would shrink by a third only, and take most of the time of a fold.
    level = 0 if name == "position_m" or isinstance(like, np.ndarray) else 4  # 0: a checksum
    packed = {"shuffle": True, "compression": "gzip", "compression_opts": level}
    pieces = {"chunks": (min(CHUNK, total), *like.shape[1:])}
    return kind | pieces | packed if total else kind


def _describe(data: h5py.Dataset, column: Column) -> None:
    data.attrs.update({"units": column.units, "description": column.description})

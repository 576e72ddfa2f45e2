"""The results file: HDF5 that a kill cannot hurt and that can be read while it grows.

A finished batch is sealed as a file of its own, a part in `NAME.parts/` beside `NAME.h5`: written
under a temporary name, synchronised, renamed, never touched again. The one file grows meanwhile as
`NAME.h5.tmp`, and gets its name at the end, when the parts are deleted. A results file and a part
have the same layout, and what is read back is the union of them all; of two rows with the same case
id, the newer one.

    /summary/COLUMN            (n,) a row per case; attributes `units` and `description`
    /histories/values/COLUMN   (sum of rows,) float32, the curves of all cases end to end
    /histories/start, rows     (n,) where the curves of a case begin, and how many rows they have
    /frames, /points, /edges   likewise: a row is a frame, a node of a frame, an element
"""

import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import h5py
import numpy as np

from sweep.result import HISTORY_COLUMNS, MODEL_VERSION, OLDER, Status
from sweep.store.batch import FRAME_GROUPS, GROUPS, Block, Ragged, newest
from sweep.store.columns import Axes, arrange, beyond, relabel, rows_in_order, take
from sweep.store.parts import list_parts

if TYPE_CHECKING:
    from pandas import DataFrame

ATTEMPTS = 100  # at a set of files that holds still while it is opened
DAMAGE = (OSError, RuntimeError, LookupError, ValueError, TypeError)


class Rerun(NamedTuple):
    """Which cases run once more though they have a row: failed ones, those of an older model."""

    failed: bool = False
    older: bool = False


ONLY_MISSING = Rerun()


class StoreError(Exception):
    """A results file that cannot be read or written; the text is one clear line."""


def exists(path: str | os.PathLike[str]) -> bool:
    """True if there is a results file, or at least a part of one."""
    return Path(path).exists() or bool(list_parts(Path(path)))


def read_summary(path: str | os.PathLike[str]) -> "DataFrame":
    """Table of all finished cases, a row each."""
    from pandas import DataFrame

    with _union(Path(path)) as blocks:
        return DataFrame(arrange(newest(blocks)))


def read_statuses(path: str | os.PathLike[str]) -> dict[str, str]:
    """Status of every finished case, by its id; empty where there is no file."""
    return _read_by_case(path, "status")


def _read_by_case(path: str | os.PathLike[str], name: str) -> dict[str, Any]:
    """A column of the summary, by case id; empty where there is no file."""
    if not exists(path):
        return {}
    with _union(Path(path)) as blocks:
        table = newest(blocks, ("case_id", name))
    return dict(zip(table["case_id"], table[name], strict=True))


def finished_ids(path: str | os.PathLike[str], rerun: Rerun = ONLY_MISSING) -> set[str]:
    """Ids of the cases that need not run again; none where there is no file."""
    statuses, old = read_statuses(path), older_ids(path) if rerun.older else set()
    kept = {i for i, status in statuses.items() if not rerun.failed or status == Status.CONVERGED}
    return kept - old


def older_ids(path: str | os.PathLike[str]) -> set[str]:
    """Ids of the finished cases that an older version of the model has computed."""
    versions = _read_by_case(path, "model_version")
    return {case_id for case_id, version in versions.items() if version < MODEL_VERSION}


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
        return open_sealed(path, held).attributes["folded"] if path.exists() else 0


def is_labelled(path: Path, axes: Axes) -> bool:
    """True if rows have the order and the grid values of `axes`, and others are counted right."""
    with _union(path) as blocks:
        table, others = newest(blocks), blocks[-1].attributes.get("other_cases", 0)
    wanted = relabel(take(table, rows_in_order(table["case_id"], axes)), axes)
    same = (np.array_equal(table[n], c, equal_nan=c.dtype != object) for n, c in wanted.items())
    return wanted.keys() == table.keys() and all(same) and others == beyond(table, axes)


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
    parts = [(part.last, open_sealed(part.path, held)) for part in list_parts(path)]
    whole = [open_sealed(path, held)] if path.exists() else []
    folded = whole[0].attributes["folded"] if whole else 0
    blocks = whole + [block for last, block in parts if last > folded]
    if not blocks:
        raise StoreError(f"{path} does not exist.")
    return blocks


def open_sealed(path: Path, held: ExitStack) -> Block:
    """A sealed file, open until `held` closes."""
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
    """Columns of a sealed file, read when they are asked for; what it is too old for is `OLDER`."""

    def __init__(self, path: Path, group: h5py.Group) -> None:
        self._path, self._data = path, group

    def __getitem__(self, name: str) -> np.ndarray:
        with _undamaged(self._path):
            if name in OLDER and name not in self._data:
                value = OLDER[name]
                kind = object if isinstance(value, str) else type(value)
                return np.full(self._data["case_id"].shape, value, kind)
            data = self._data[name]
            return data.asstr()[:] if h5py.check_string_dtype(data.dtype) else data[:]

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys([*self._data, *OLDER]))

    def __len__(self) -> int:
        return len({*self._data, *OLDER})


def _read_case(path: Path, case_id: str, groups: Iterable[str]) -> dict[str, np.ndarray]:
    with _union(path) as blocks:
        for block in reversed(blocks):
            found = np.flatnonzero(block.summary["case_id"] == case_id)
            if found.size:
                arrays = [block.ragged[group].case(found[-1]) for group in groups]
                return {k: v for named in arrays for k, v in named.items() if len(v)}
    raise StoreError(f"{path} holds no case {case_id}.")

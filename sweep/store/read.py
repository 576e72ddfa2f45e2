"""Reads a results file: HDF5 that survives a kill and that can be read while a sweep runs.

A finished batch is sealed as a file of its own, a part in `NAME.parts/` beside `NAME.h5`: it is
written under a temporary name, synchronised, renamed, and never changed again. Meanwhile the
results file grows as `NAME.h5.tmp`; at the end it gets its name and the parts are deleted. A
results file and a part have the same layout. A reader sees the union of all of them; of two rows
with the same case id it takes the newer one.

    /summary/COLUMN            (n,) a row per case; attributes `units` and `description`
    /histories/values/COLUMN   (sum of rows,) float32, the curves of all cases one after another
    /histories/start, rows     (n,) first row of the curves of a case, and their number of rows
    /frames, /points, /edges   the same; a row is a frame, a node of a frame, an element
    /plate_points, /quads      the same for plates
    /strikers, /bases          the same; a row is a point of an outline
    /cases                     the same; a row is a byte of the case as JSON (`Case.to_json`)
    /checksums                 (n,) of the rows of the summary, with `start` and `rows`; the
                               attribute `checksum` covers the other attributes
"""

import json
import os
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from sweep.columns import HISTORY_COLUMNS
from sweep.result import MODEL_VERSION, Status
from sweep.store.batch import (
    FRAME_GROUPS,
    GROUPS,
    TEXT,
    Block,
    newest,
    newest_rows,
)
from sweep.store.damage import RENEWED, damaged_cases, refuse_damaged
from sweep.store.errors import StoreError as StoreError
from sweep.store.parts import list_parts
from sweep.store.sealed_file import open_sealed
from sweep.store.tables import Axes, arrange, beyond, relabel, rows_in_order, take

if TYPE_CHECKING:
    from pandas import DataFrame

    from sweep.config.case import Case

ATTEMPTS = 100  # attempts to open all files of a set before the writer changes the set


class Rerun(NamedTuple):
    """Which cases run again although they have a row: failed, of another model, or damaged in
    their curves, shapes or stored case.
    """

    failed: bool = False
    older: bool = False
    damaged: bool = False


ONLY_MISSING = Rerun()


class StoredRun(NamedTuple):
    """Curves of a case, a row per stored step, and its shapes; both empty if it has none."""

    case_id: str
    history: "DataFrame"
    frames: dict[str, np.ndarray]


def exists(path: str | os.PathLike[str]) -> bool:
    """True if there is a results file, or at least a part of one."""
    return Path(path).exists() or bool(list_parts(Path(path)))


def read_summary(
    path: str | os.PathLike[str], needed: Callable[[str], bool] | None = None
) -> "DataFrame":
    """Table of all finished cases, one row per case; of its columns only those that are needed."""
    from pandas import DataFrame

    with _union(Path(path)) as blocks:
        refuse_damaged(Path(path), blocks)
        table = arrange(newest(blocks))
        names = [name for name in table if needed is None or needed(name)]
        return DataFrame({name: table[name] for name in names})


def read_statuses(path: str | os.PathLike[str]) -> dict[str, str]:
    """Status of every finished case, by its id; empty if there is no file."""
    return dict(zip(*_read_columns(path, "case_id", "status"), strict=True))


def _read_columns(path: str | os.PathLike[str], *names: str) -> list[np.ndarray]:
    """Columns of the summary; empty if there is no file."""
    if not exists(path):
        return [np.zeros(0, object) for _ in names]
    with _union(Path(path)) as blocks:
        table = newest(blocks)
        return [table[name] for name in names]


def finished_ids(path: str | os.PathLike[str], rerun: Rerun = ONLY_MISSING) -> set[str]:
    """Ids of the cases that need not run again; empty if there is no file."""
    ids, statuses, versions = _read_columns(path, "case_id", "status", "model_version")
    again = (statuses != Status.CONVERGED) & rerun.failed | (versions < MODEL_VERSION) & rerun.older
    damaged = unreadable(path) if rerun.damaged and len(ids) else {}
    return {*ids[~again]} - damaged.keys()


def older_ids(path: str | os.PathLike[str]) -> set[str]:
    """Ids of the finished cases computed with an older version of the model."""
    ids, versions = _read_columns(path, "case_id", "model_version")
    return {*ids[versions < MODEL_VERSION]}


def read_attributes(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Config, versions, git revision and time of the last run that wrote to the file."""
    with _union(Path(path)) as blocks:
        return dict(blocks[-1].attributes)


def read_case(path: str | os.PathLike[str], case_id: str) -> "Case":
    """The case that a row was computed from, with the labels of the sweep that computed it."""
    return _case(path, case_id, _read_arrays(Path(path), case_id, ["cases"]))


def read_cases(path: str | os.PathLike[str], case_ids: Iterable[str]) -> "Iterator[Case]":
    """`read_case` of many cases, one after another; the files are opened only once."""
    for case_id, arrays in _arrays_of(Path(path), case_ids):
        yield _case(path, case_id, arrays(["cases"]))


def unreadable(path: str | os.PathLike[str]) -> dict[str, StoreError]:
    """The rows whose curves, shapes or case cannot be read, or whose case has another id: their
    ids, each with the fault.
    """
    with _union(Path(path)) as blocks:
        faults = (_unreadable(path, block, rows) for block, rows in newest_rows(blocks))
        return dict(chain.from_iterable(faults))


def _unreadable(
    path: str | os.PathLike[str], block: Block, rows: np.ndarray
) -> Iterator[tuple[str, StoreError]]:
    """The unreadable rows of a block, which are read in runs, and one by one from the first damaged
    run on.
    """
    ids, stored = block.summary["case_id"], block.as_stored(rows)
    cache: dict[Any, Any] = {}
    number = 0
    try:
        for row, arrays in _arrays_in_runs(block, stored):
            if wrong := _unusable(path, ids[row], arrays, cache):
                yield ids[row], wrong
            number += 1
    except StoreError:
        for row in stored[number:]:
            try:
                wrong = _unusable(path, ids[row], _arrays(block, row, GROUPS), cache)
            except StoreError as error:
                wrong = error
            if wrong:
                yield ids[row], wrong


def _unusable(
    path: str | os.PathLike[str],
    case_id: str,
    arrays: dict[str, np.ndarray],
    cache: dict[Any, Any],
) -> StoreError | None:
    """The fault in the shapes or the case of a row; cache: see `Case.from_json`."""
    try:
        _frames(path, case_id, arrays)
        _case(path, case_id, arrays, cache)
    except StoreError as error:
        return error
    return None


def changed_cases(
    path: str | os.PathLike[str], ids: Collection[str], case_of: Callable[[str], "Case"]
) -> set[str]:
    """The ids whose row holds another case than ``case_of`` returns; ids without a row are left
    out.

    Texts are compared, which takes 30 us each; if they differ, the ids of the cases are.
    """
    if not exists(path):
        return set()
    with _union(Path(path)) as blocks:
        texts = _in_file_order(blocks, ids, "cases", [TEXT])
        return {
            case_id
            for case_id, arrays in texts
            if not _is_of(bytes(arrays.get(TEXT, b"")), case_of(case_id))
        }


def _is_of(text: bytes, case: "Case") -> bool:
    """Whether a stored text describes a case; labels, the last table, may come from another
    sweep.
    """
    own, mark = case.to_json().encode(), b',"axes":'
    (body, _, labels), (own_body, _, own_labels) = text.rpartition(mark), own.rpartition(mark)
    try:
        if body == own_body:
            return labels == own_labels or [*json.loads(b'{"axes":' + labels)] == ["axes"]
        return type(case).model_validate_json(text).case_id == case.case_id
    except (ValueError, ArithmeticError):
        return False


def _case(
    path: str | os.PathLike[str],
    case_id: str,
    arrays: dict[str, np.ndarray],
    cache: dict[Any, Any] | None = None,
) -> "Case":
    from sweep.config.case import Case
    from sweep.config.faults import MisfitError

    text = bytes(arrays.get(TEXT, b""))
    try:
        case = Case.from_json(text.decode(), cache)
        if case.case_id != case_id:
            raise MisfitError(f"it is case {case.case_id}")
    except (ValueError, ArithmeticError) as error:
        why = str(error) if isinstance(error, MisfitError) else "its numbers make no drawing"
        raise StoreError(f"{path} holds no usable case {case_id}: {why}.") from error
    return case


def read_history(path: str | os.PathLike[str], case_id: str) -> "DataFrame":
    """Curves of one case, a row per stored step; no rows if the case has no curves."""
    return _history(_read_arrays(Path(path), case_id, ["histories"]))


def read_frames(path: str | os.PathLike[str], case_id: str) -> dict[str, np.ndarray]:
    """Stored shapes of one case, the arrays of `Result.frames`; empty if the case has none."""
    return _frames(path, case_id, _read_arrays(Path(path), case_id, FRAME_GROUPS))


def read_runs(path: str | os.PathLike[str], case_ids: Iterable[str]) -> Iterator[StoredRun]:
    """Curves and shapes of many cases, one after another; the files are opened only once."""
    for case_id, arrays in _arrays_of(Path(path), case_ids):
        frames = _frames(path, case_id, arrays(FRAME_GROUPS))
        yield StoredRun(case_id, _history(arrays(["histories"])), frames)


def read_curves(
    path: str | os.PathLike[str], case_ids: Collection[str], names: Sequence[str]
) -> Iterator[tuple[str, dict[str, np.ndarray]]]:
    """Named columns of the curves of many cases, in their order in the file; no rows if a case has
    no curves.
    """
    left, none = {*case_ids}, {name: np.zeros(0) for name in names}
    with _union(Path(path)) as blocks:
        for case_id, curves in _in_file_order(blocks, {*case_ids}, "histories", names):
            left.discard(case_id)
            yield case_id, none | {k: v.astype(np.float64) for k, v in curves.items()}
    for case_id in left:
        raise StoreError(f"{path} holds no case {case_id}.")


def _in_file_order(
    blocks: list[Block], ids: Collection[str], group: str, names: Sequence[str]
) -> Iterator[tuple[str, dict[str, np.ndarray]]]:
    """The named arrays of a group, as far as a block has them, of each of these cases that has a
    row.
    """
    for block, newest_row in newest_rows(blocks):
        stored, ragged = block.summary["case_id"], block.ragged[group]
        rows = newest_row[[stored[row] in ids for row in newest_row]]
        for row, arrays in ragged.cases(rows, [name for name in names if name in ragged.arrays]):
            yield stored[row], arrays


def _history(curves: dict[str, np.ndarray]) -> "DataFrame":
    from pandas import DataFrame

    return DataFrame(curves, columns=list(HISTORY_COLUMNS | curves), dtype=np.float64)


def _frames(
    path: str | os.PathLike[str], case_id: str, arrays: dict[str, np.ndarray]
) -> dict[str, np.ndarray]:
    """The arrays of `Result.frames` as they were before positions became rows of a table."""
    if "position_m" not in arrays:
        return arrays
    rows = arrays["position_m"]
    nodes, rest = divmod(len(rows), len(arrays.get("strain", ())) or len(rows) + 1)
    named = [arrays[name] for name in ("edges", "quads") if name in arrays]
    if rest or not named or any(each.min() < 0 or each.max() >= nodes for each in named):
        why = "elements of nodes that they do not have" if not rest else "frames without all nodes"
        raise StoreError(f"{path} holds no usable shapes of case {case_id}: {why}; {RENEWED}.")
    return arrays | {"position_m": rows.reshape(-1, nodes, rows.shape[1])}


def folded_batches(path: Path) -> int:
    """Number of the last batch in the results file itself; newer batches are in parts."""
    with ExitStack() as stack:
        return open_sealed(path, stack).attributes["folded"] if path.exists() else 0


def is_labelled(path: Path, axes: Axes, config: Any) -> bool:
    """True if the rows have the order and grid values of `axes`, and the count of other cases, and
    if the file has this config: an edited [rank] or [require] changes no row.
    """
    with _union(path) as blocks:
        table, others = newest(blocks), blocks[-1].attributes["other_cases"]
        if blocks[-1].attributes.get("config") != config:
            return False
        columns = relabel(take(table, rows_in_order(table["case_id"], axes)), axes)
        if columns.keys() != table.keys() or others != beyond(table, axes):
            return False
        pairs = ((table[name], column) for name, column in columns.items())
        return all(np.array_equal(a, b, equal_nan=b.dtype != object) for a, b in pairs)


@contextmanager
def _union(path: Path) -> Iterator[list[Block]]:
    """All sealed blocks of a results file, oldest first; they stay open inside the block."""
    for _ in range(ATTEMPTS):
        with ExitStack() as stack:
            try:
                blocks = _open_all(path, stack)
            except FileNotFoundError:
                continue  # the writer has just merged or folded parts of the list
            yield blocks
            return
    raise StoreError(f"{path} changes faster than it can be read.")


def _open_all(path: Path, stack: ExitStack) -> list[Block]:
    # The parts are opened first: if a fold deletes them before the file is opened, it holds them.
    parts = [(part.last, open_sealed(part.path, stack)) for part in list_parts(path)]
    whole = [open_sealed(path, stack)] if path.exists() else []
    folded = whole[0].attributes["folded"] if whole else 0
    blocks = whole + [block for last, block in parts if last > folded]
    if not blocks:
        raise StoreError(f"{path} does not exist.")
    return blocks


def open_whole(path: Path, stack: ExitStack) -> list[Block]:
    """All sealed blocks of a results file, none of whose rows is damaged; open as in
    `open_sealed`.
    """
    blocks = _open_all(path, stack)
    refuse_damaged(path, blocks)
    return blocks


def damaged_ids(path: str | os.PathLike[str]) -> list[str]:
    """Ids, as stored, of rows that differ from what was written and that no other row replaces."""
    if not exists(path):
        return []
    with _union(Path(path)) as blocks:
        return damaged_cases(blocks)


def _read_arrays(path: Path, case_id: str, groups: Iterable[str]) -> dict[str, np.ndarray]:
    """The arrays of one case in some groups."""
    [arrays] = [arrays(groups) for _, arrays in _arrays_of(path, [case_id])]
    return arrays


def _arrays_of(
    path: Path, case_ids: Iterable[str]
) -> Iterator[tuple[str, Callable[[Iterable[str]], dict[str, np.ndarray]]]]:
    """Of each case: its id, and what reads its arrays of some groups."""
    ids = [*case_ids]
    some = {*ids}
    with _union(path) as blocks:
        arrays_of = {
            case_id: partial(_arrays, block, row)
            for block in blocks
            for row, case_id in enumerate(block.summary["case_id"])
            if case_id in some and row not in block.damaged
        }
        for case_id in ids:
            if case_id not in arrays_of:
                raise StoreError(f"{path} holds no case {case_id}.")
            yield case_id, arrays_of[case_id]


def _arrays(block: Block, row: int, groups: Iterable[str]) -> dict[str, np.ndarray]:
    """Arrays of the case in one row of a block; arrays without rows are left out."""
    arrays = [block.ragged[group].case(row) for group in groups]
    return {k: v for named in arrays for k, v in named.items() if len(v)}


def _arrays_in_runs(block: Block, rows: np.ndarray) -> Iterator[tuple[int, dict[str, np.ndarray]]]:
    """The arrays that `_arrays` reads from all groups, row by row, for rows in the order in which
    they are stored; a `StoreError` if a group stores them in another order.
    """
    groups = [block.ragged[name] for name in GROUPS]
    for cases in zip(*(group.cases(rows, [*group.arrays]) for group in groups), strict=True):
        numbers = {row for row, _ in cases}
        if len(numbers) > 1:
            raise StoreError("groups in different orders")
        yield numbers.pop(), {k: v for _, named in cases for k, v in named.items() if len(v)}

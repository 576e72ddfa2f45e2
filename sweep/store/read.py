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
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import h5py
import numpy as np

from sweep.columns import COLUMNS, HISTORY_COLUMNS
from sweep.result import LOADED, MODEL_VERSION, Status
from sweep.store.batch import (
    FORMAT,
    FRAME_GROUPS,
    GROUPS,
    TEXT,
    Block,
    Ragged,
    is_as_written,
    newest,
    newest_rows,
)
from sweep.store.checksum import CHECKSUM, attribute_checksum, checked_columns, row_checksums
from sweep.store.errors import StoreError as StoreError
from sweep.store.parts import list_parts
from sweep.store.tables import Axes, Table, arrange, beyond, relabel, rows_in_order, take

if TYPE_CHECKING:
    from pandas import DataFrame

    from sweep.config.case import Case

SHOWN = 3  # most damaged cases that are named
ATTEMPTS = 100  # attempts to open all files of a set before the writer changes the set
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

CACHE = 1 << 16  # bytes of chunks kept of each array: a merge has 64 files open, of 30 arrays each
FEW = 4096  # rows of a column that is kept in memory while its file is open
FILES_REMEMBERED = 4096
_DAMAGED: dict[tuple[int, ...], frozenset[int]] = {}
"""Damaged rows of files that this process has checked: a sealed file never changes."""


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
        _refuse_damaged(Path(path), blocks)
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
        pairs = zip(blocks, newest_rows(blocks), strict=True)
        return {k: v for block, rows in pairs for k, v in _unreadable(path, block, rows)}


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
        texts = _texts(blocks, ids)
        return {case_id for case_id, text in texts if not _is_of(text, case_of(case_id))}


def _texts(blocks: list[Block], ids: Collection[str]) -> Iterator[tuple[str, bytes]]:
    """The stored text of each of these cases that has a row, by its id."""
    for block, newest_row in zip(blocks, newest_rows(blocks), strict=True):
        names = block.summary["case_id"]
        rows = newest_row[[names[row] in ids for row in newest_row]]
        for row, arrays in block.ragged["cases"].cases(rows, [TEXT]):
            yield names[row], arrays[TEXT].tobytes()


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


def read_runs(
    path: str | os.PathLike[str], case_ids: Iterable[str], shapes: bool = True
) -> Iterator[StoredRun]:
    """Curves and shapes of many cases, one after another; the files are opened only once.

    shapes: False leaves the shapes unread, and `frames` empty.
    """
    for case_id, arrays in _arrays_of(Path(path), case_ids):
        frames = _frames(path, case_id, arrays(FRAME_GROUPS)) if shapes else {}
        yield StoredRun(case_id, _history(arrays(["histories"])), frames)


def read_curves(
    path: str | os.PathLike[str], case_ids: Collection[str], names: Sequence[str]
) -> Iterator[tuple[str, dict[str, np.ndarray]]]:
    """Named columns of the curves of many cases, in their order in the file; no rows if a case has
    no curves.
    """
    ids = {*case_ids}
    with _union(Path(path)) as blocks:
        for block, newest_row in zip(blocks, newest_rows(blocks), strict=True):
            stored, curves = block.summary["case_id"], block.ragged["histories"]
            rows = newest_row[[stored[row] in ids for row in newest_row]]
            stored_names = [name for name in names if name in curves.arrays]
            none = {name: np.zeros(0) for name in names}
            for row, arrays in curves.cases(rows, stored_names):
                ids.discard(stored[row])
                yield stored[row], none | {k: v.astype(np.float64) for k, v in arrays.items()}
    for case_id in ids:
        raise StoreError(f"{path} holds no case {case_id}.")


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
    _refuse_damaged(path, blocks)
    return blocks


def open_sealed(path: Path, stack: ExitStack) -> Block:
    """A sealed file as a block, open until `stack` closes."""
    with _undamaged(path):
        if not (path.is_file() or path.is_dir()) and path.exists():
            raise StoreError(f"{path} cannot be read: it is no regular file.")
        # A sealed file never changes, so it needs no lock, which would block other readers.
        file = stack.enter_context(h5py.File(path, "r", locking=False, rdcc_nbytes=CACHE))
        if (written := _attribute(file, "format")) != FORMAT:
            needed = f"this Crumple reads format {FORMAT}: {AGAIN}"
            raise StoreError(f"{path} is a results file of format {written}; {needed}.")
        attributes = {name: _attribute(file, name) for name in file.attrs}
        if attribute_checksum(attributes) != attributes[CHECKSUM]:
            raise ValueError("attributes other than those written")
        ragged = {name: _open_ragged(path, _inside(file, name, h5py.Group)) for name in GROUPS}
        columns = _Members(path, _inside(file, "summary", h5py.Group), _column)
        if (content := _identity(file)) not in _DAMAGED:
            while len(_DAMAGED) >= FILES_REMEMBERED:
                _DAMAGED.pop(next(iter(_DAMAGED)), None)
            _DAMAGED[content] = _changed_rows(path, columns, ragged, _numbers(file, "checksums"))
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


def _changed_rows(
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


def damaged_ids(path: str | os.PathLike[str]) -> list[str]:
    """Ids, as stored, of rows that differ from what was written and that no other row replaces."""
    if not exists(path):
        return []
    with _union(Path(path)) as blocks:
        return _damaged(blocks)


def _damaged(blocks: list[Block]) -> list[str]:
    usable = {*newest(blocks)["case_id"]}
    ids = [block.summary["case_id"][row] for block in blocks for row in sorted(block.damaged)]
    return [case_id for case_id in ids if case_id not in usable]


def _refuse_damaged(path: Path, blocks: list[Block]) -> None:
    if ids := _damaged(blocks):
        named = ", ".join(ascii(case_id)[1:-1] for case_id in ids[:SHOWN])
        more = f" and {len(ids) - SHOWN} more" if len(ids) > SHOWN else ""
        raise StoreError(f"{path}: damaged rows of cases {named}{more}; {RUN_AGAIN}.")


@contextmanager
def _undamaged(path: Path, damaged: str = "") -> Iterator[None]:
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
        if damaged:
            raise StoreError(f"{path}: {damaged} is damaged: {RENEWED}.") from error
        line = f"{path} is not a results file of Crumple, or is damaged: {AGAIN}."
        raise StoreError(line) from error


def _open_ragged(path: Path, group: h5py.Group) -> Ragged:
    values = _inside(group, "values", h5py.Group)
    arrays = _Members(path, values, partial(_Array, path, group.name.strip("/")))
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
        with _undamaged(self._path, self._data.name):
            return self._data[rows]


class _Members(Mapping[str, Any]):
    """The datasets of a group of a sealed file, each opened or read when it is indexed.

    Texts are kept, as they take long to read, and so are small datasets, since there may be many
    files.
    """

    def __init__(self, path: Path, group: h5py.Group, take: Callable[[h5py.Dataset], Any]) -> None:
        self._path, self._group, self._take = path, group, take
        self._taken: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        if name in self._taken:
            return self._taken[name]
        with _undamaged(self._path):
            taken = self._take(_inside(self._group, name, h5py.Dataset))
        if not isinstance(taken, np.ndarray) or taken.dtype == object or len(taken) <= FEW:
            self._taken[name] = taken
        return taken

    def __iter__(self) -> Iterator[str]:
        return iter(self._group)

    def __len__(self) -> int:
        return len(self._group)


def _column(data: h5py.Dataset) -> np.ndarray:
    if not h5py.check_string_dtype(data.dtype):
        return data[:]
    encoded = data[:].tolist()
    texts = {text: text.decode() for text in {*encoded}}  # most are equal, and share one object
    return np.array([texts[text] for text in encoded], dtype=object)


def _read_arrays(path: Path, case_id: str, groups: Iterable[str]) -> dict[str, np.ndarray]:
    with _union(path) as blocks:
        for block in reversed(blocks):
            rows = np.flatnonzero(block.summary["case_id"] == case_id)
            if rows.size and rows[-1] not in block.damaged:
                return _arrays(block, rows[-1], groups)
    raise StoreError(f"{path} holds no case {case_id}.")


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

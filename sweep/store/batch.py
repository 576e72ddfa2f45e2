"""Blocks of rows of a results file, in memory or in a sealed file, and the union of blocks.

The curves and shapes of cases have different lengths: the arrays of all cases are stored one after
another, and `start` and `rows` give the range of each case.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sweep.result import Result
from sweep.store.tables import Table, stack, tabulate, take

FRAME_GROUPS: dict[str, dict[str, tuple[int, ...]]] = {
    "frames": {"strain": (), "time_s": (), "plate_y_m": (2,)},
    "points": {"position_m": (2,)},
    "edges": {"edges": (2,), "edge_thickness_m": ()},
    "strikers": {"striker_m": (2,)},
    "bases": {"base_m": (2,)},
    "plate_points": {"position_m": (3,)},
    "quads": {"quads": (4,), "quad_thickness_m": ()},
}
"""Arrays of `Result.frames` with the shapes of their rows, grouped by the meaning of a row: frame,
node of a frame, element.

Nodes and elements of plates have groups of their own, as their rows are longer.
"""

TEXT = "json"
"""The array of the group of cases: `Case.to_json` of all of them, a row per byte."""

WHOLE = ("edges", "quads", TEXT)
"""Arrays of whole numbers; the others are of fractions."""

FORMAT = 10
"""Version of the layout and of the columns of a file; `read` refuses files of another."""

GROUPS = ("cases", "histories", *FRAME_GROUPS)

CHUNK = 1 << 18  # rows copied at a time


def is_as_written(group: str, name: str, dtype: np.dtype, shape: tuple[int, ...]) -> bool:
    """Whether an array of a group has the type and row shape that a writer gives it."""
    row = FRAME_GROUPS.get(group, {}).get(name, ())
    return dtype.kind in ("iu" if name in WHOLE else "f") and shape[1:] == row


@dataclass(frozen=True)
class Ragged:
    """Arrays of all cases, one after another.

    The case in row i of the summary has the rows from `start[i]` to `start[i] + rows[i]`.
    start, rows: int64 (n,). arrays: name -> array or dataset (sum of rows, ...).
    """

    start: np.ndarray
    rows: np.ndarray
    arrays: Mapping[str, Any]

    def is_whole(self, kept: np.ndarray) -> bool:
        """True if the ranges of the cases for which `kept` (n,) is true lie within every array."""
        start, rows = self.start[kept], self.rows[kept]
        end = (start + rows).max(initial=0)
        return min(start.min(initial=0), rows.min(initial=0)) >= 0 and all(
            array.shape[0] >= end for array in self.arrays.values()
        )

    def case(self, row: int) -> dict[str, np.ndarray]:
        """The arrays of one case."""
        begin = self.start[row]
        end = begin + self.rows[row]
        return {name: array[begin:end] for name, array in self.arrays.items()}

    def cases(
        self, kept: np.ndarray, names: Sequence[str]
    ) -> Iterator[tuple[int, dict[str, np.ndarray]]]:
        """The number of each kept row and its named arrays, in the order of the file; many cases
        are read at once.
        """
        order = kept[np.argsort(self.start[kept], kind="stable")]
        begins, ends = self.start[order], np.maximum.accumulate((self.start + self.rows)[order])
        first = 0
        while first < len(order):
            begin = begins[first]
            last = max(int(np.searchsorted(ends, begin + CHUNK, "right")), first + 1)
            read = {name: self.arrays[name][begin : ends[last - 1]] for name in names}
            for row in order[first:last]:
                own = slice(self.start[row] - begin, self.start[row] + self.rows[row] - begin)
                yield int(row), {name: array[own] for name, array in read.items()}
            first = last

    def ranges(self, kept: np.ndarray) -> Iterator[tuple[int, int]]:
        """Begin and end of ranges of rows that together hold the kept cases, in their order."""
        begins, ends = self.start[kept], self.start[kept] + self.rows[kept]
        breaks = np.flatnonzero(begins[1:] != ends[:-1]) + 1
        for run in np.split(np.arange(len(kept)), breaks) if len(kept) else []:
            end = int(ends[run[-1]])
            for begin in range(int(begins[run[0]]), end, CHUNK):
                yield begin, min(begin + CHUNK, end)


@dataclass(frozen=True)
class Block:
    """The rows of one sealed file, or of one batch in memory."""

    summary: Mapping[str, np.ndarray]
    ragged: Mapping[str, Ragged]
    attributes: Mapping[str, Any]
    damaged: frozenset[int] = frozenset()  # numbers of the rows that differ from what was written

    def as_stored(self, rows: np.ndarray) -> np.ndarray:
        """Row numbers in the order in which the file stores their texts, curves and shapes."""
        return rows[np.argsort(self.ragged["cases"].start[rows])]


def block_of(results: Sequence[Result], revision: str) -> Block:
    """A finished batch as a block; `revision`: git revision of the source that ran it."""
    by = {"git_revision": revision}
    who = [
        {"case_id": r.case_id, "status": str(r.status), "message": r.message} | by for r in results
    ]
    table = tabulate([row | dict(r.summary) for row, r in zip(who, results, strict=True)])
    texts = [result.case.to_json().encode() for result in results]
    ragged = {
        "cases": _ragged([{TEXT: np.frombuffer(text, np.uint8)} for text in texts]),
        "histories": _ragged([result.history for result in results]),
    }
    for group, rows in FRAME_GROUPS.items():
        ragged[group] = _ragged([_flat_frames(result, rows) for result in results])
    return Block(table, ragged, {})


def newest_rows(blocks: Sequence[Block]) -> list[tuple[Block, np.ndarray]]:
    """Each block (oldest first) and its row numbers, without rows that a later row of the same case
    replaces, and without damaged rows.
    """
    newest = {
        case_id: (number, row)
        for number, block in enumerate(blocks)
        for row, case_id in enumerate(block.summary["case_id"])
        if row not in block.damaged
    }
    rows: list[list[int]] = [[] for _ in blocks]
    for number, row in newest.values():
        rows[number].append(row)
    pairs = zip(blocks, rows, strict=True)
    return [(block, np.array(sorted(numbers), dtype=np.int64)) for block, numbers in pairs]


def newest(blocks: Sequence[Block]) -> Table:
    """The summary of the union of the blocks."""
    return stack([take(block.summary, rows) for block, rows in newest_rows(blocks)])


def _flat_frames(result: Result, rows: Mapping[str, tuple[int, ...]]) -> dict[str, np.ndarray]:
    """The arrays with rows of these shapes, nodes of all frames one after another."""
    arrays = {name: np.asarray(result.frames[name]) for name in rows if name in result.frames}
    if "position_m" in arrays:
        position = arrays.pop("position_m")
        if position.shape[2:] == rows["position_m"]:
            arrays["position_m"] = position.reshape(-1, position.shape[2])
    return arrays


def _ragged(cases: Sequence[Mapping[str, np.ndarray]]) -> Ragged:
    rows = np.array([len(next(iter(case.values()), ())) for case in cases], dtype=np.int64)
    names = dict.fromkeys(name for case in cases for name in case)
    values = {name: _end_to_end(name, cases, rows) for name in names}
    return Ragged(np.cumsum(rows) - rows, rows, values)


def _end_to_end(name: str, cases: Sequence[Mapping], rows: np.ndarray) -> np.ndarray:
    """One array of all cases, in the precision of the file; NaN for a case without it."""
    like = next(case[name] for case in cases if name in case)
    values = [
        case[name] if name in case else np.full((n, *like.shape[1:]), np.nan)
        for case, n in zip(cases, rows, strict=True)
        if case
    ]
    return np.concatenate(values or [like[:0]], dtype=digits(like.dtype), casting="same_kind")


def digits(dtype: np.dtype) -> type[np.number]:
    """The array in the precision that a file keeps: single precision, short integers, or bytes."""
    kinds: dict[str, type[np.number]] = {"f": np.float32, "i": np.int32, "u": np.uint8}
    return kinds[dtype.kind]

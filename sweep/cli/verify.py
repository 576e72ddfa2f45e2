"""The verb `verify`: whether a results file is undamaged, and whether its numbers can be
reproduced.
"""

from collections.abc import Iterator, Sequence
from math import isclose
from typing import Any

import numpy as np
from pandas import DataFrame

from sweep.cli.status import failed_cases
from sweep.cli.terminal import say, say_all
from sweep.numbers import counted
from sweep.result import Result
from sweep.running.warming import real_simulate
from sweep.store.damage import RENEWED
from sweep.store.errors import StoreError
from sweep.store.read import read_cases, read_frames, read_history, read_summary, unreadable

SEED = 0  # seed for the choice of cases that run again
SAME = 1e-6  # relative difference of numbers that count as equal
ROUNDED = 1e-6  # the same for curves and shapes, which are stored with seven digits
SHOWN = 10  # most faults that are listed
VARYING = ("cpu_s", "git_revision")  # not compared


def verify(file: str, again: int) -> bool:
    """Print the faults of a results file, and return whether there are none.

    Checksums, curves, shapes and stored cases of all rows are read, the ids are computed anew, and
    ``again`` cases that converged, drawn at random, are simulated again.
    """
    summary = read_summary(file)
    ids = list(summary["case_id"])
    errors = unreadable(file)
    wrong = [f"case {key}: {_fault(errors[key])}" for key in ids if key in errors]
    say_all(wrong[:SHOWN])
    if len(wrong) > SHOWN:
        say(f"{len(wrong) - SHOWN} more cases cannot be read")
    say(f"{file}: {len(ids) - len(wrong)} of {counted(len(ids), 'case')} intact")
    if wrong:
        say("`crumple run CONFIG --renew` computes these again, and keeps the others")
        return False
    chosen = _sample(summary["case_id"].drop(failed_cases(summary).index), again)
    different = list(_different(file, summary.set_index("case_id").loc[chosen]))
    say_all(different)
    same = len(chosen) - len(different)
    say(f"{same} of {counted(len(chosen), 'case')} simulated again: identical")
    return not different


def _fault(error: StoreError) -> str:
    """What is damaged, without the advice to call this verb."""
    return str(error).partition(RENEWED)[0].rstrip(" :;")


def _sample(ids: Sequence[str], count: int) -> list[str]:
    rng = np.random.default_rng(SEED)
    return sorted(rng.choice(ids, min(count, len(ids)), replace=False).tolist())


def _different(file: str, rows: DataFrame) -> Iterator[str]:
    """A sentence for each case whose numbers, or whose end, now differ."""
    cases = [*read_cases(file, rows.index)]
    simulate = real_simulate(cases)
    for case in cases:
        case_id, row = case.case_id, rows.loc[case.case_id]
        result = simulate(case, np.zeros(3, np.int64))
        new = result.summary
        others = [
            name
            for name in new.keys() & set(row.index)
            if name not in VARYING and not _equal(new[name], row[name])
        ]
        if others:
            first = min(others, key=list(new).index)
            more = f" and {len(others) - 1} more columns" if len(others) > 1 else ""
            stored = f"stored {row[first]} by model version {row['model_version']}"
            yield f"case {case_id}: {first} is {new[first]}, {stored}{more}"
        elif name := _other_array(file, result):
            yield f"case {case_id}: the stored {name} is not what comes out"


def _other_array(file: str, result: Result) -> str:
    """The first curve or array of shapes that differs from the stored one; empty if none does."""
    curves, shapes = read_history(file, result.case_id), read_frames(file, result.case_id)
    pairs = [(name, new, curves.get(name, np.nan)) for name, new in result.history.items()]
    pairs += [(name, new, shapes.get(name, np.nan)) for name, new in result.frames.items()]
    for name, computed, stored in pairs:
        new, old = np.asarray(computed, float), np.asarray(stored, float)
        size = np.nanmax(np.abs(new), initial=0.0)
        near = {"rtol": ROUNDED, "atol": ROUNDED * size, "equal_nan": True}
        if new.shape != old.shape or not np.allclose(new, old, **near):
            return name
    return ""


def _equal(one: Any, other: Any) -> bool:
    if isinstance(one, str) or isinstance(other, str):
        return str(one) == str(other)
    unknown = one != one and other != other
    return unknown or isclose(one, other, rel_tol=SAME)

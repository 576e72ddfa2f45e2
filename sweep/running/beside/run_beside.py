"""Runs cases that accompany a sweep, into a results file of their own beside the results of the
sweep.
"""

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Literal, NamedTuple

from sweep.config.case import Case
from sweep.running.child_process import Simulate
from sweep.running.cluster import Scheduler
from sweep.running.progress import announce
from sweep.running.sweep import run_sweep
from sweep.store.read import ONLY_MISSING, Rerun, finished_ids


class How(NamedTuple):
    """How cases run: the arguments of `run_sweep` after the results file."""

    workers: int = 2
    scheduler: Scheduler = None
    rerun: Rerun = ONLY_MISSING
    simulate: Simulate | None = None


def file_beside(
    out: str | os.PathLike[str], kind: Literal["companions", "screen", "spread"]
) -> Path:
    """The results file of the cases that accompany those in `out`: `armor.spread.h5`."""
    return Path(out).with_suffix(f".{kind}.h5")


def run_beside(cases: Mapping[str, Case], beside: Path, what: str, how: How) -> None:
    """Run the cases, by id, that the file `beside` does not contain; what: the beginning of a
    message.
    """
    if cases.keys() - finished_ids(beside, how.rerun):
        announce(f"{what}, in {beside}")
        run_sweep(list(cases.values()), beside, *how)

"""Kills runs at random moments, and looks whether anything finished is lost or computed twice."""

import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
from pandas import DataFrame

from sweep.report.tables.sheet import Sheet
from sweep.store.read import exists, read_summary

CASES = 30
CONFIG = """
name = "killed"
[lattice]
cells = 2
[loading]
strain = 0.3
[solver]
load_steps = 40
[grid]
"lattice.imperfection" = {imperfections}
"""


class Killed(NamedTuple):
    """Of a sweep that was killed again and again: kills, rows that were lost or computed twice."""

    kills: int
    lost: int
    twice: int


def write_config(folder: Path) -> Path:
    """A sweep of many short cases."""
    path = folder / "killed.toml"
    values = [round(0.01 + 0.001 * n, 4) for n in range(CASES)]
    path.write_text(CONFIG.format(imperfections=values))
    return path


def rows(out: Path) -> DataFrame:
    """The finished cases, by id."""
    return read_summary(out).set_index("case_id") if exists(out) else DataFrame()


def kill(config: Path, out: Path, rng: np.random.Generator, longest: float) -> bool:
    """Start the run and kill it within `longest` seconds; return whether it was still running."""
    words = [sys.executable, "-m", "sweep", "run", str(config), "--out", str(out)]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        time.sleep(rng.uniform(0.0, longest))
        running = process.poll() is None
        process.kill()
    return running


def torture(folder: Path, kills: int, longest: float = 6.0, seed: int = 1) -> Killed:
    """Kill runs of a sweep, which begins anew whenever it is complete.

    The processor time of two runs is never the same: a row that has another one was computed twice.
    """
    rng, config, out = np.random.default_rng(seed), write_config(folder), folder / "killed.h5"
    done = lost = twice = 0
    before = rows(out)
    while done < kills:
        done += kill(config, out, rng, longest)
        after = rows(out)
        lost += len(before.index.difference(after.index))
        same = before.index.intersection(after.index)
        if len(same):
            twice += int((before.loc[same, "cpu_s"] != after.loc[same, "cpu_s"]).sum())
        before = after
        if len(after) == CASES and out.exists():
            out.unlink()
            before = rows(out)
    return Killed(done, lost, twice)


def sheet(found: Killed) -> Sheet:
    """The table of `torture`."""
    heads = ["killed runs", "rows lost", "rows computed twice"]
    return Sheet("Killed runs", heads, [[str(count) for count in found]])

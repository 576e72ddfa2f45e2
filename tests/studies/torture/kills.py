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

LONGEST = 6.0  # seconds until a kill
CRUSH = """
name = "killed"
[lattice]
cells_y = 2
depth = "20 mm"
[material]
name = "ninjaflex"
[loading]
strain = 0.3
[solver]
load_steps = 40
"""
GRID = f'[grid]\n"lattice.imperfection" = {[round(0.01 + 0.001 * n, 4) for n in range(30)]}\n'
SEARCH = """[search]
"lattice.cells_x" = {from = 2, to = 5}
"lattice.wall_thickness" = {from = "0.4 mm", to = "1.2 mm"}
"""
VERBS = {
    "run": (GRID, ("run",)),
    "run --error-bars": (GRID, ("run", "--error-bars")),
    "run --spread": (GRID, ("run", "--spread")),
    "run --processes 2": (GRID, ("run", "--processes", "2")),
    "optimize": (SEARCH, ("optimize", "--evaluations", "30")),
}
"""What is killed: the axes of the config, and the words of the command."""


class Killed(NamedTuple):
    """A command that was killed again and again.

    Counts kills while it ran, rows that were lost or computed twice, and how often it came to its
    end.
    """

    kills: int
    lost: int
    twice: int
    ends: int


def rows(folder: Path) -> dict[str, DataFrame]:
    """The finished cases of each results file of a folder, by id."""
    parts = {path.with_suffix(".h5") for path in folder.glob("*.parts")}
    files = parts | set(folder.glob("*.h5"))
    return {
        path.name: read_summary(path).set_index("case_id") for path in sorted(files) if exists(path)
    }


def kill(words: list[str], longest: float, rng: np.random.Generator) -> bool:
    """Start a command and kill it within `longest` seconds; return whether it was still running."""
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        time.sleep(rng.uniform(0.0, longest))
        running = process.poll() is None
        process.kill()
    return running


def difference(before: dict[str, DataFrame], after: dict[str, DataFrame]) -> tuple[int, int]:
    """How many rows are lost, and how many have been computed twice.

    The processor time of two runs is never the same: a row that has another one was computed twice.
    """
    lost = twice = 0
    for name, old in before.items():
        new = after.get(name, old.iloc[:0])
        lost += len(old.index.difference(new.index))
        same = old.index.intersection(new.index)
        twice += int((old.loc[same, "cpu_s"] != new.loc[same, "cpu_s"]).sum())
    return lost, twice


def torture(folder: Path, verb: str, kills: int, longest: float = LONGEST) -> Killed:
    """Kill a command in an empty folder, which begins anew whenever it has come to its end."""
    axes, words = VERBS[verb]
    config, out = folder / "killed.toml", folder / "killed.h5"
    config.write_text(CRUSH + axes, "utf-8")
    command = [sys.executable, "-m", "sweep", words[0], str(config), "--out", str(out), *words[1:]]
    rng, count = np.random.default_rng(1), Killed(0, 0, 0, 0)
    before: dict[str, DataFrame] = {}
    while count.kills < kills:
        running = kill(command, longest, rng)
        after = rows(folder)
        lost, twice = difference(before, after)
        ended = not running
        count = Killed(
            count.kills + running, count.lost + lost, count.twice + twice, count.ends + ended
        )
        before = after
        if ended:
            for path in folder.glob("*.h5"):
                path.unlink()
            before = {}
    return count


def sheet(counts: dict[str, Killed]) -> Sheet:
    """The table of `torture`, for each command."""
    heads = ["command", "kills", "rows lost", "rows computed twice", "ends"]
    lines = [[verb, *(str(number) for number in killed)] for verb, killed in counts.items()]
    return Sheet("Killed commands", heads, lines)

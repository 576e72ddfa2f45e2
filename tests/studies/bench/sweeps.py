"""A whole sweep on two cores: designs a second."""

import os
import tempfile
import time
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import NamedTuple

import numpy as np

from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.running.beside.refinement import refined
from sweep.running.sweep import run_sweep
from sweep.store.read import read_summary
from tests.studies.bench.measuring.clock import seconds
from tests.studies.bench.table import Table
from tests.support.converged import converged, demand

CONFIG = Path(__file__).parents[3] / "configs/thousand.toml"
FINER = 4  # times the load steps and the elements, to see what they leave out
IDLE, WAITING = 3, 4  # columns of /proc/stat
RATIO = "times the ideal"  # wall clock, had no other program run, over CPU of the cases / workers


def thousand():
    """All designs of the config."""
    return expand(load_config(CONFIG))


class Swept(NamedTuple):
    """Seconds of a sweep: on the clock, of processors that other programs had meanwhile, and so of
    the clock that they took; CPU of the cases alone.
    """

    wall: float
    others: float
    lost: float
    own: float

    @property
    def free(self):
        """Wall-clock seconds if no other program had run."""
        return self.wall - self.lost


def busy():
    """CPU seconds so far, used by all programs of this machine or taken by its host."""
    ticks = [int(word) for word in Path("/proc/stat").read_text("utf-8").split()[1:9]]
    return (sum(ticks) - ticks[IDLE] - ticks[WAITING]) / os.sysconf("SC_CLK_TCK")


def lost(others, wall, workers, cores):
    """Seconds of a time ``wall`` that workers lose to other programs, which used processors for
    ``others`` s, starting with processors that no worker needs.
    """
    return max(others - (cores - workers) * wall, 0.0) / workers


def swept(designs, workers):
    """Sweep through designs into a file that is thrown away."""
    with tempfile.TemporaryDirectory() as folder:
        file, wall, before = f"{folder}/bench.h5", time.perf_counter(), busy()
        with redirect_stdout(StringIO()):  # its progress
            spent = seconds(lambda: run_sweep(designs, file, workers=workers))
        wall, others = time.perf_counter() - wall, max(busy() - before - spent, 0.0)
        summary = read_summary(file)
    demand(summary.to_dict("records"))
    taken = lost(others, wall, workers, os.cpu_count())
    return Swept(wall, others, taken, float(summary["cpu_s"].sum()))


def errors(sample, elements=1):
    """Share by which the absorbed energy of each design changes with `FINER` times its load steps
    and so many times its elements.
    """
    fine = [refined(case, elements, FINER) for case in sample]
    energies = [
        [converged(case).summary["absorbed_energy_J"] for case in cases] for cases in (sample, fine)
    ]
    return np.abs(np.divide(*energies) - 1.0)


def kinds(designs):
    """The designs with friction and without."""
    smooth = [case.changed(contact={"friction": 0.0}) for case in designs]
    return {"with friction": designs, "without friction": smooth}


def throughput(designs, every):
    """Designs a second with friction and without, and the error of a sample of them."""
    times = ("per s", "wall, s", "others, s", "CPU, ms", RATIO)
    finer = {"error, %": FINER, "of steps": 1}  # times the elements
    found = Table(f"{len(designs):,} designs", (*times, *finer))
    for name, chosen in kinds(designs).items():
        sweep, sample = swept(chosen, 2), chosen[::every]
        each = 1e3 * sweep.own / len(chosen)
        ratio = 2.0 * sweep.free / sweep.own
        figures = len(chosen) / sweep.free, sweep.wall, sweep.others, each, ratio
        for column, figure in zip(times, figures, strict=True):
            found.put(name, column, figure)
        for column, elements in finer.items():
            off = 100.0 * errors(sample, elements)
            found.put(name, column, float(np.median(off)), f"{off.max():.2g}")
    return found

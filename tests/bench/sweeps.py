"""Whole sweeps on two cores: what comes on top of the cases, and designs a second."""

import tempfile
import time
from pathlib import Path

import numpy as np

from sweep.config import load_config
from sweep.grid import expand
from sweep.params import Case
from sweep.run import run_sweep
from sweep.simulate import simulate
from sweep.store import read_summary
from tests.bench.clock import seconds
from tests.bench.table import Table

CONFIG = Path(__file__).parents[2] / "configs/thousand.toml"
FINER = 4  # times the load steps, to see what they leave out
WORKERS = (1, 2)


def thousand():
    """All designs of the config."""
    return expand(load_config(CONFIG))


def changed(case, **tables):
    """A case with some keys of some tables changed."""
    given = {name: getattr(case, name).model_copy(update=keys) for name, keys in tables.items()}
    kept = {name: getattr(case, name) for name in Case.model_fields if name not in given}
    return Case(**kept, **given)


def swept(designs, workers):
    """Wall seconds of a sweep, CPU seconds of all of it, and of its cases alone."""
    with tempfile.TemporaryDirectory() as folder:
        file, wall = f"{folder}/bench.h5", time.perf_counter()
        spent = seconds(lambda: run_sweep(designs, file, workers=workers))
        wall, summary = time.perf_counter() - wall, read_summary(file)
    if not (summary["status"] == "converged").all():
        raise RuntimeError(f"a sweep of {len(designs)} cases left some that did not converge")
    return wall, spent, float(summary["cpu_s"].sum())


def overhead(designs, count):
    """Two workers against one."""
    columns = ("wall, s", "CPU of the cases, s", "wall / (CPU / workers)", "other CPU, %")
    found = Table(f"a sweep of {len(designs)} cases", columns)
    samples = [[swept(designs, workers) for workers in WORKERS] for _ in range(count)]
    for workers, rounds in zip(WORKERS, np.array(samples).swapaxes(0, 1), strict=True):
        wall, spent, own = rounds.T
        name = f"{workers} workers" if workers > 1 else "1 worker"
        shares = wall, own, wall * workers / own, 100.0 * (spent / own - 1.0)
        for column, share in zip(columns, shares, strict=True):
            found.put(name, column, float(np.median(share)))
    return found


def errors(sample):
    """Share by which the absorbed energy of each design changes with `FINER` times its steps."""
    energies = []
    for factor in (1, FINER):
        finer = [changed(c, solver={"load_steps": factor * c.solver.load_steps}) for c in sample]
        energies.append([simulate(case).summary["absorbed_energy_J"] for case in finer])
    return np.abs(np.divide(*energies) - 1.0)


def throughput(designs, every):
    """Designs a second with friction and without, and what a sample of them is off by."""
    columns = ("designs a second", "wall, s", "CPU of a case, ms", "error, % (greatest)")
    found = Table(f"{len(designs):,} designs to 60 %, two workers", columns)
    smooth = [changed(case, contact={"friction": 0.0}) for case in designs]
    for name, chosen in (("with friction", designs), ("without friction", smooth)):
        wall, _, own = swept(chosen, 2)
        off = 100.0 * errors(chosen[::every])
        found.put(name, columns[0], len(chosen) / wall)
        found.put(name, columns[1], wall)
        found.put(name, columns[2], 1e3 * own / len(chosen))
        found.put(name, columns[3], float(np.median(off)), f"{off.max():.2g}")
    return found

"""From `crumple run` to the end of a small sweep in a new process: all that is to be loaded."""

import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tests.studies.bench.table import Table

ROOT = Path(__file__).parents[3]
CONFIG = ROOT / "configs/smoke.toml"
RESULT = re.compile(r"[1-9]\d*/\d+ cases")
CACHES = ("no kernel compiled", "all compiled")


def run(cache, out):
    """Seconds on the clock to the first result and to the end, and CPU seconds, of a run that keeps
    its kernels in the folder cache.
    """
    before, started, first = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter(), None
    with subprocess.Popen(
        [sys.executable, "-m", "sweep", "run", CONFIG, "--out", out],
        env=os.environ | {"CRUMPLE_CACHE_DIR": str(cache)},
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,  # progress
        text=True,
    ) as process:
        for line in process.stdout:
            if first is None and RESULT.match(line):
                first = time.perf_counter() - started
    wall, after = time.perf_counter() - started, resource.getrusage(resource.RUSAGE_CHILDREN)
    if process.returncode != 0 or first is None:
        raise RuntimeError("the run that is to be timed failed")
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return first, wall, used


def table():
    """A row for each state of compilation before the start."""
    columns = ("first result, s", "end, s", "CPU, s")
    found = Table("`crumple run configs/smoke.toml`", columns)
    with tempfile.TemporaryDirectory() as folder:
        for name in CACHES:
            for column, figure in zip(columns, run(folder, f"{folder}/{name}.h5"), strict=True):
                found.put(name, column, figure)
    return found

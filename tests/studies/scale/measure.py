"""Verbs on sweeps of many cases, each in a process of its own, with its time and memory.

    python -m tests.studies.scale.measure FOLDER ACTION

The last line of its output is {"cpu_s", "wall_s", "peak_MB"}.
"""

import json
import subprocess
import sys
import time
from pathlib import Path

from sweep.__main__ import main as crumple
from sweep.config.load import load_config
from sweep.running.sweep import run_sweep
from tests.studies.scale.invented import invent


def run(folder):
    """Run the cases that the file does not hold, with invented results, on one thread."""
    run_sweep(load_config(folder / "scale.toml"), folder / "scale.h5", 1, simulate=invent)


def half(folder):
    """Run every second case."""
    cases = load_config(folder / "scale.toml").cases[::2]
    run_sweep(cases, folder / "scale.h5", 1, simulate=invent)


def _verb(*words):
    """Run a verb of the command line on the results file."""

    def act(folder):
        crumple([words[0], str(folder / "scale.h5"), *words[1:]])

    return act


ACTIONS = {
    "expand": lambda folder: load_config(folder / "scale.toml"),
    "run of every second case": half,
    "run of the rest": run,
    "run, nothing missing": run,
    "status": _verb("status"),
    "rank": _verb("rank"),
    "rank --allowed-force": _verb("rank", "--allowed-force", "33 N"),
    "show": _verb("show"),
    "show 1": _verb("show", "1"),
    "report": _verb("report"),
    "verify": _verb("verify", "--again", "0"),
}
"""In the order in which they need each other."""


def measured(folder, action):
    """CPU and wall time (s) and peak memory (MB) of an action, in a process of its own."""
    command = [sys.executable, "-m", __name__, str(folder), action]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(done.stdout.splitlines()[-1])


def _peak():
    """Peak memory of this process, MB; `getrusage` would count the process that started it."""
    lines = Path("/proc/self/status").read_text("utf-8").splitlines()
    return int(next(line.split()[1] for line in lines if line.startswith("VmHWM"))) / 1024


if __name__ == "__main__":
    started = time.perf_counter()
    ACTIONS[sys.argv[2]](Path(sys.argv[1]))
    wall = time.perf_counter() - started
    told = {"cpu_s": time.process_time(), "wall_s": wall, "peak_MB": _peak()}
    sys.stdout.write(f"\n{json.dumps(told)}\n")

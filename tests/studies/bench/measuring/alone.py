"""A case in a process of its own: only there can its memory be measured.

    python -m tests.studies.bench.measuring.alone < case > summary

Read from /proc: the result of `getrusage` includes the process that started this one.
"""

import json
import pickle
import subprocess
import sys
from pathlib import Path

from sweep.simulation.simulate import simulate

MEMORY = "peak_memory_MB"


def alone(case):
    """Summary of a case, and the peak memory of the process that simulated it in MB."""
    command = [sys.executable, "-m", "tests.studies.bench.measuring.alone"]
    asked = pickle.dumps(case)
    return json.loads(subprocess.run(command, input=asked, check=True, capture_output=True).stdout)


def _peak():
    status = Path("/proc/self/status").read_text("utf-8").splitlines()
    return int(next(line.split()[1] for line in status if line.startswith("VmHWM"))) / 1024


if __name__ == "__main__":
    result = simulate(pickle.load(sys.stdin.buffer))
    json.dump(result.summary | {MEMORY: _peak()}, sys.stdout)

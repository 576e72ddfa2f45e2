"""Put a wrong sign into the kernels, many times, and look which test turns red: `make mutants`.

python -m tests.studies.mutants FOLDER [EACH]: so many mutants of every file, by default one. The
table is printed and written into the folder. The exit status is 1 if a mutant survives: a test is
missing then, or the sign is of no consequence.
"""

import os
import queue
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from rich.console import Console
from rich.progress import track

from sweep.report.tables.sheet import Sheet
from tests.studies.mutants.flips import sample
from tests.studies.mutants.trial import Copy, StudyError
from tests.studies.tables import publish

HEADS = ["file", "line", "in", "wrong", "first red test", "s", "as"]


def tried(mutants):
    """The verdicts on ``mutants``, as many at a time as there are processors."""
    workers, copies = os.cpu_count(), queue.SimpleQueue()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(workers) as pool:
        for worker in range(workers):
            copies.put(Copy(Path(folder) / str(worker)))

        def one(mutant):
            copy = copies.get()
            try:
                return copy.tried(mutant)
            finally:
                copies.put(copy)

        found = pool.map(one, mutants)
        return list(track(found, "mutants", len(mutants), console=Console(stderr=True)))


def sheet(verdicts):
    """The table, the survivors first."""
    rows = []
    for mutant, red, seconds, compiled in sorted(verdicts, key=lambda verdict: verdict.red or ""):
        how = "machine code" if compiled else "plain Python"
        told = [red or "none: it survives", f"{seconds:.1f}", how]
        rows.append([mutant.path, str(mutant.line), mutant.function, mutant.change, *told])
    killed = sum(verdict.red is not None for verdict in verdicts)
    note = f"{killed} of {len(verdicts)} turn a test red."
    return Sheet("Mutants", HEADS, rows, notes=(note,))


def main(folder, each=1):
    """Print and write the table; return whether a mutant survives."""
    try:
        verdicts = tried(list(sample(each)))
    except StudyError as error:
        sys.exit(str(error))
    publish([sheet(verdicts)], folder / "mutants.md")
    return any(verdict.red is None for verdict in verdicts)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), *map(int, sys.argv[2:])))

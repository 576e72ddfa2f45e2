"""Flip a sign in the kernels, many times, and find the test that fails: `make mutants`.

python -m tests.studies.mutants FOLDER [EACH]: so many mutants of every file, by default one. The
table is printed as it is found, and written into the folder. The exit status is 1 if a mutant
survives: a test is missing then, or the sign is of no consequence.
"""

import os
import queue
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tests.studies.mutants.flips import sample
from tests.studies.mutants.trial import Copy, StudyError
from tests.studies.tables import head, line, tell

HEADS = ("file", "line", "in", "wrong", "first red test", "s", "as")


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

        yield from pool.map(one, mutants)


def table(verdicts, survivors):
    """Lines, each as soon as its mutant is tried; mutants that survive are added to a list."""
    killed = 0
    yield from head(HEADS)
    for mutant, red, seconds, compiled in verdicts:
        killed += red is not None
        survivors += [] if red else [mutant]
        how = "machine code" if compiled else "plain Python"
        found = [red or "none: it survives", f"{seconds:.1f}", how]
        yield line([mutant.path, mutant.line, mutant.function, mutant.change, *found])
    yield f"\n{killed} of {killed + len(survivors)} turn a test red."


def main(folder, each=1):
    """Print and write the table; return whether a mutant survives."""
    survivors = []
    try:
        tell(table(tried(sample(each)), survivors), folder / "mutants.md")
    except StudyError as error:
        sys.exit(str(error))
    return len(survivors) > 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), *map(int, sys.argv[2:])))

"""Cases that cost nothing and a `simulate` that invents their results, to test the code around
it.
"""

import os
import subprocess
import sys
import time
from contextlib import ExitStack
from pathlib import Path
from unittest.mock import patch

import h5py
import numpy as np

from sweep.columns import COLUMNS, HISTORY_COLUMNS, absorbed_energy_column
from sweep.config.case import Case
from sweep.result import Result, Status, design_columns
from sweep.store.checksum import checked_columns, row_checksums
from sweep.store.sealed_file import open_sealed
from sweep.store.write import Writer

NODES = 5
ROOT = Path(__file__).parents[3]


class Kept(list):
    """A sink that remembers the batches."""

    def __call__(self, results):
        """Remember a batch."""
        self.append(results)

    @property
    def results(self):
        """All results by their case."""
        return {result.case_id: result for batch in self for result in batch}


class Logged(list):
    """A simulation, and the ids of the cases that it has run; false before the first."""

    def __init__(self, simulate):
        self.simulate = simulate

    def __call__(self, case, control=None):
        """Run a case, and remember its id."""
        self.append(case.case_id)
        return self.simulate(case)


def cases(count, first=0):
    """Cases that differ in one number, which is also their only grid key."""
    values = [0.001 * number for number in range(first, first + count)]
    axes = [{"lattice.imperfection": value} for value in values]
    return [
        Case.of(lattice=dict(imperfection=v), axes=a) for v, a in zip(values, axes, strict=True)
    ]


def number_of(case):
    return round(case.lattice.imperfection / 0.001)


def simulate(case, stop=None, seconds=None):
    """A result whose every number follows from the case; case 7 fails."""
    number = number_of(case)
    measures = dict.fromkeys(list(COLUMNS)[3:], float(number)) | design_columns(case)
    measures |= {"steps": 10 + number, "newton_iterations": 3, absorbed_energy_column(50): 0.5}
    failed = number == 7
    measures |= {"loaded": int(not failed), "retry": ""}
    return Result(
        case,
        Status.STOPPED if failed else Status.CONVERGED,
        "No step was short enough: try a smaller time_step." if failed else "",
        measures,
        {name: number + np.linspace(0.0, 1.0, 10 + number) for name in HISTORY_COLUMNS},
        frames(number),
    )


def frames(number):
    """Three frames, or four where the number of the case is odd."""
    count = 3 + number % 2
    points = np.arange(count * NODES * 2, dtype=np.float64).reshape(count, NODES, 2)
    return {
        "strain": np.linspace(0.0, 0.6, count),
        "time_s": np.linspace(0.0, 0.1, count),
        "position_m": 1e-3 * (points + number),
        "edges": np.column_stack([np.arange(NODES - 1), np.arange(1, NODES)]),
        "edge_thickness_m": np.full(NODES - 1, 8e-4),
        "plate_y_m": np.full((count, 2), np.nan),
    }


def slow(case, stop=None):
    """Like `simulate`, in 20 ms, and with a line in the file that $EXECUTIONS names."""
    time.sleep(0.02)
    with Path(os.environ["EXECUTIONS"]).open("a") as file:
        file.write(f"{case.case_id}\n")
    return simulate(case)


def killed(program, executions, count):
    """Run a program in a process until `slow` has begun so many cases, then kill -9."""
    places = os.environ | {"PYTHONPATH": str(ROOT)}
    with subprocess.Popen([sys.executable, "-c", program], env=places) as process:
        limit = time.monotonic() + 20
        while len(executions.read_text().split()) < count:
            assert time.monotonic() < limit
            time.sleep(0.01)
        process.kill()


def write(path, batch, fold=False, size=2, **about):
    """Append results of a batch in pieces, as one run."""
    with Writer(path, {case.case_id: case.axes for case in batch}, about) as writer:
        for begin in range(0, len(batch), size):
            writer.append([simulate(case) for case in batch[begin : begin + size]])
        if fold:
            writer.fold()


def write_older(path, batch):
    """A results file of rows of an older model."""
    write(path, batch, fold=True)
    make_older(path)


def make_older(path):
    """Change the rows of a results file to the first version of the model."""
    forge(path, "summary/model_version", lambda versions: versions.__setitem__(slice(None), 1))


def forge(path, name, change):
    """Change an array of a file, and the checksums of its rows to fit."""
    with h5py.File(path, "r+") as file:
        change(file[name])
    with ExitStack() as stack, patch("sweep.store.batch.Ragged.is_whole", lambda *_: True):
        block = open_sealed(Path(path), stack)
        ranges = {name: (group.start, group.rows) for name, group in block.ragged.items()}
        sums = row_checksums(checked_columns(block.summary, ranges))
    with h5py.File(path, "r+") as file:
        file["checksums"][:] = sums


def blank(path, name="cases/values/json"):
    """Write zeros over the first chunk of an array, which its checksum tells from others."""
    with h5py.File(path) as file:
        piece = file[name].id.get_chunk_info(0)
    content = bytearray(path.read_bytes())
    content[piece.byte_offset : piece.byte_offset + piece.size] = bytes(piece.size)
    path.write_bytes(content)


def parts_of(path):
    """The sealed parts of a results file, in order."""
    return sorted(path.with_suffix(".parts").glob("*"))

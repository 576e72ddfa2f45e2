"""A disk that fills up: one line, no crash, and sealed results stay."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from sweep.store.read import finished_ids
from tests.support.results.standin import parts_of, write

pytest.importorskip("resource")  # Windows has none
ROOT = Path(__file__).parents[3]
MERGE_AT = 6  # parts are merged into one, in place of 64
PROGRAM = """
import resource
from sweep.store import parts
from tests.support.results.standin import cases, write
from sweep.store.read import StoreError

parts.MERGE_AT = {merge_at}
resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))
try:
    write({path!r}, cases({count}), size={size})
except StoreError as error:
    print(error)
"""


def fill(path, count, limit, size=2):
    """Write results of cases, `size` at a time, where no file may be longer than `limit` bytes."""
    program = PROGRAM.format(path=str(path), count=count, limit=limit, size=size, merge_at=MERGE_AT)
    done = subprocess.run(
        [sys.executable, "-c", program],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
    )
    assert done.stderr == ""
    assert done.returncode == 0
    assert done.stdout == f"{path} cannot be written: File too large.\n"


@pytest.mark.parametrize("limit", [0, 20_000])
def test_no_part_fits(path, limit):
    fill(path, 9, limit)
    assert finished_ids(path) == set()


def test_the_one_part_of_many_does_not_fit(path, monkeypatch):
    """Each of them does, so that nothing is lost."""
    monkeypatch.setattr("sweep.store.parts.MERGE_AT", MERGE_AT)
    fill(path, 40, 200_000, size=5)
    assert not path.with_name("armor.h5.tmp").exists()
    assert len(parts_of(path)) == MERGE_AT
    assert len(finished_ids(path)) == 5 * MERGE_AT
    write(path, [], fold=True)
    assert not parts_of(path)

"""kill -9 in the middle of a real `crumple run`: the same command completes it, to the same table.

`test_sweep` kills sweeps of a stand-in; here the kernels run and the command line speaks.
"""

import subprocess
import sys
import time
from pathlib import Path

import pandas as pd
import pytest

from sweep.config.grid import expand
from sweep.config.load import load_config
from sweep.running.sweep import run_sweep
from sweep.simulation.warm_up import warm_up
from sweep.store.read import finished_ids, read_history, read_summary
from tests.support.command import crumple

ROOT = Path(__file__).parents[3]
CASES = 12
CONFIG = """
name = "killed"
[material]
modulus = "12 MPa"
density = "1190 kg/m^3"
[loading]
mode = "displacement"
strain = 0.4
[contact]
friction = 0.0
[grid]
"lattice.imperfection" = {imperfections}
"""


@pytest.fixture
def config(tmp_path):
    """A sweep of a few seconds, and kernels that the command only needs to load."""
    warm_up()
    path = tmp_path / "killed.toml"
    path.write_text(CONFIG.format(imperfections=[round(0.01 + 0.001 * n, 4) for n in range(CASES)]))
    return path


def words(config, out):
    """The command, on one thread: the next run has one suspect."""
    return ["run", str(config), "--out", str(out), "--workers", "1"]


def killed(config, out, least):
    """Run until ``least`` cases are finished, then kill -9."""
    command = [sys.executable, "-W", "error", "-m", "sweep", *words(config, out)]
    pipe = subprocess.DEVNULL
    with subprocess.Popen(command, cwd=ROOT, stdout=pipe, stderr=pipe) as process:
        limit = time.monotonic() + 60
        while len(finished_ids(out)) < least and time.monotonic() < limit:
            time.sleep(0.02)
        process.kill()
    return read_summary(out)


def test_killed_run_is_completed_to_the_same_table(config, tmp_path, capsys):
    out, reference = tmp_path / "killed.h5", tmp_path / "reference.h5"
    before = killed(config, out, least=1)
    assert 1 <= len(before) < CASES
    assert not out.exists()  # only sealed parts: the run was in its middle
    status, _, told = crumple(capsys, *words(config, out))
    assert status == 0, told
    assert run_sweep(expand(load_config(config)), reference) == 0

    after, expected = read_summary(out), read_summary(reference)
    assert len(after) == CASES
    assert set(after["status"]) == {"converged"}
    pd.testing.assert_frame_equal(after.drop(columns="cpu_s"), expected.drop(columns="cpu_s"))
    for case_id in (before["case_id"].iloc[0], after["case_id"].iloc[-1]):
        one, other = (read_history(path, case_id) for path in (out, reference))
        pd.testing.assert_frame_equal(one, other)

    # The processor time of a run is never the same twice: finished rows were not computed again.
    times = after.set_index("case_id")["cpu_s"]
    assert (times[before["case_id"]].to_numpy() == before["cpu_s"].to_numpy()).all()

"""The limit of memory: the free memory of the machine and of the control groups of the process."""

from resource import RLIMIT_DATA, getrlimit
from types import SimpleNamespace

import numpy as np
import psutil
import pytest

from sweep.running import memory
from sweep.running.memory import limited_memory, most_data

GB = 1 << 30


@pytest.fixture
def machine(tmp_path, monkeypatch):
    """Files of a machine with 8 GB free, in which this process has 1 GB, in a group without limits;
    returns the folder of all groups.
    """
    own, groups = tmp_path / "cgroup", tmp_path / "groups"
    (groups / "job/step").mkdir(parents=True)
    own.write_text("4:memory:/old\n0::/job/step\n")
    (groups / "job/step/memory.max").write_text("max\n")
    monkeypatch.setattr("psutil.virtual_memory", lambda: SimpleNamespace(available=8 * GB))
    monkeypatch.setattr("psutil.Process.memory_info", lambda _: SimpleNamespace(data=GB))
    monkeypatch.setattr(memory, "OWN_GROUPS", own)
    monkeypatch.setattr(memory, "GROUPS", groups)
    return groups


def test_what_is_free_is_added_to_what_the_process_has(machine):
    assert most_data() == 9 * GB


@pytest.mark.parametrize(
    "file", ["job/step/memory.max", "job/memory.max", "memory/old/memory.limit_in_bytes"]
)
def test_a_control_group_or_one_above_it_has_a_limit(machine, file):
    (machine / file).parent.mkdir(parents=True, exist_ok=True)
    (machine / file).write_text(f"{2 * GB}\n")
    assert most_data() == pytest.approx(0.95 * 2 * GB, abs=1)


def test_beyond_the_limit_an_array_is_an_error_and_the_limit_ends_with_the_block(monkeypatch):
    before, has = getrlimit(RLIMIT_DATA), psutil.Process().memory_info().data
    monkeypatch.setattr(memory, "most_data", lambda: has + GB // 4)
    with limited_memory(), pytest.raises(MemoryError):
        np.empty(GB // 2, np.uint8)
    assert getrlimit(RLIMIT_DATA) == before
    assert np.empty(GB // 2, np.uint8).nbytes == GB // 2

"""Requests that a worker fulfils, and requests of another run that it refuses."""

import pytest

from sweep.running.fingerprint import fingerprint
from sweep.running.on_worker import Kernels, OtherSourceError, checked, inspect_kernels


def test_a_task_of_the_same_source_runs():
    assert checked(fingerprint(), divmod, 7, 2) == (3, 1)


def test_a_task_of_another_source_does_not():
    ran = []
    with pytest.raises(OtherSourceError, match=r"numba \S+ \(this run: 0\.1\)"):
        checked({**fingerprint(), "numba": "0.1"}, ran.append, 1)
    assert ran == []


@pytest.mark.parametrize("lasting", [True, False])
def test_cold_kernels_are_found(monkeypatch, lasting):
    monkeypatch.setattr("kernels.compile.cache.is_lasting", lambda: lasting)
    monkeypatch.setattr("kernels.compile.cache.is_cold", lambda name: name == "plates")
    assert inspect_kernels(["marches", "plates"]) == Kernels(["plates"], lasting)
